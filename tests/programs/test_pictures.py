"""Tests `seiche render` and `seiche plot` as they are typed: formats, options, messages."""
import os
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

SCENE = """dimension = {dimension}
[domain]
lower = {lower}
upper = {upper}
cell_size = 0.0625
[time]
end = 0.1
frame_rate = 20.0
[liquid]
[[liquid.region]]
shape = "box"
lower = {lower}
upper = {half}
[[solid]]
name = "post"
kind = "static"
shape = "box"
lower = {post_lower}
upper = {post_upper}
[[probe]]
name = "toe"
kind = "front"
"""
FLAT = dict(dimension=2, lower=[0.0, 0.0], upper=[1.0, 0.5], half=[0.4, 0.4], post_lower=[0.7, 0.0],
            post_upper=[0.77, 0.21])
SOLID = dict(dimension=3, lower=[0.0, 0.0, 0.0], upper=[1.0, 0.5, 0.5], half=[0.4, 0.4, 0.5],
             post_lower=[0.7, 0.0, 0.1], post_upper=[0.77, 0.21, 0.3])


class Program:
    def __init__(self, path, work):
        self.path, self.work, self.faults = path, work, []

    def call(self, *words, code=0, says=(), environment=None):
        """Runs the program; notes a fault where code or text are not as wanted."""
        done = subprocess.run([self.path, *map(str, words)], cwd=self.work, capture_output=True, text=True, check=False,
                              env={**os.environ, **(environment or {})})
        text = done.stdout + done.stderr
        if done.returncode != code or not all(part in text for part in says):
            self.faults.append(f"seiche {' '.join(map(str, words))}: code {done.returncode}, wanted {code} with {says}:\n{text}")

    def expect(self, condition, message):
        if not condition:
            self.faults.append(message)

    def starts(self, name, magic):
        file = self.work / name
        self.expect(file.is_file() and file.read_bytes().startswith(magic), f"{name} is missing or of another format")


def run_scene(program, name, values):
    (program.work / f"{name}.toml").write_text(SCENE.format(**values), encoding="utf-8")
    program.call("run", f"{name}.toml", "--out", name, "--quiet", "--threads", "1")


def flat_pictures(program):
    program.call("render", "flat", "--frames", "1,2", "--size", "480x320", "--contact-sheet", says=["frame.0002.png"])
    program.starts("flat/pictures/frame.0001.png", b"\x89PNG")
    program.call("render", "flat", "--frames", "2", "--format", "svg", "--streamlines", "--color", "vorticity",
                 "--per-frame", says=["frame.0002.svg"])
    root = xml.parse(program.work / "flat/pictures/frame.0002.svg").getroot()
    program.expect(root.tag.endswith("svg") and root.get("viewBox") == "0 0 1280 720", f"svg: {root.attrib}")
    program.call("render", "flat", "--frames", "2", "--format", "pdf", "--range", "0,3", "--colors", "gray")
    program.starts("flat/pictures/frame.0002.pdf", b"%PDF")
    program.call("render", "flat", "--color", "presure", code=2, says=["did you mean 'pressure'?", "none, speed,"])
    program.call("render", "flat", "--color", "pressure", code=2, says=['"pressure" in output.frames'])
    program.call("render", "flat", "--colors", "jet", code=2, says=["maps are viridis, magma,"])
    program.call("render", "flat", "--format", "jpg", code=2, says=["formats are png, svg, pdf, exr"])
    program.call("render", "flat", "--transparent", code=2, says=["--transparent is for 3D runs"])


def solid_pictures(program):
    small = ["--frames", "2", "--size", "160x120"]
    program.call("render", "solid", *small, "--foam", "--material", "blood", "--turntable", "3", says=["turn.0002.png"])
    program.call("render", "solid", *small, "--format", "exr", "--transparent", says=["frame.0002.exr"])
    program.starts("solid/pictures/frame.0002.exr", b"\x76\x2f\x31\x01")
    program.call("render", "solid", *small, "--streamlines", code=2, says=["--streamlines is for 2D runs"])
    program.call("render", "solid", *small, "--format", "svg", code=2, says=["take png or exr"])
    (program.work / "path.csv").write_text("time,eye_x\n0,3,1,3,0.5,0,0\n0,3,1,3,0.5,0,0\n", encoding="utf-8")
    program.call("render", "solid", *small, "--camera-path", "path.csv", code=2, says=["path.csv:3: its time 0"])


def plots(program):
    program.call("plot", "flat", says=["flat/pictures/plot.png"])
    program.starts("flat/pictures/plot.png", b"\x89PNG")
    program.call("plot", "flat", "solid", "--columns", "volume,energy", "--out", "two.svg")
    xml.parse(program.work / "two.svg")
    program.call("plot", "flat", "--file", "probes", "--names", "toe", "--out", "toe.pdf")
    program.starts("toe.pdf", b"%PDF")
    program.call("plot", "flat", "--columns", "enrgy", code=2, says=["did you mean 'energy'?", "stats.csv has step,"])
    program.call("plot", "flat", "--file", "joints", code=2, says=["has no joints.csv"])
    program.call("plot", "nowhere", code=2, says=["there is no such folder"])


def without_fonts(program):
    """Without fonts there is a message, and no picture."""
    (program.work / "fonts.conf").write_text('<?xml version="1.0"?><fontconfig/>', encoding="utf-8")
    bare = {"FONTCONFIG_FILE": str(program.work / "fonts.conf")}
    remedy = ["there is no font for the texts of pictures", "fonts-dejavu-core"]
    program.call("render", "flat", "--out", "bare", code=2, says=remedy, environment=bare)
    program.expect(not (program.work / "bare").exists(), "a folder was made for pictures without a font")
    program.call("plot", "flat", code=2, says=remedy, environment=bare)
    program.call("render", "flat", "--font", "No Such Font", code=2, says=["there is no font 'No Such Font'"])


def main(seiche, work):
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    program = Program(pathlib.Path(seiche).resolve(), work)
    run_scene(program, "flat", FLAT)
    run_scene(program, "solid", SOLID)
    for test in (flat_pictures, solid_pictures, plots, without_fonts):
        test(program)
    print("\n".join(program.faults) or "passed")
    return 1 if program.faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve()))
