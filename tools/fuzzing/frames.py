"""Mode `frames`: `info`, `render` and level sets must handle damaged frames in bounded time and memory."""
import shutil

from fuzzing.damage import damage
from fuzzing.oracle import check_end
from fuzzing.tables import Fault

SCENE = """\
dimension = {dim}
[domain]
lower = {lower}
upper = {upper}
cell_size = 0.125
[time]
end = 0.04
frame_rate = 50.0
[liquid]
surface_tension = 0.07
viscosity = 1.0
[[liquid.region]]
shape = "box"
lower = {lower}
upper = {surface}
velocity = {velocity}
[[solid]]
kind = "rigid"
density = 500.0
shape = "sphere"
center = {center}
radius = 0.2
[output]
frames = ["surface", "velocity", "pressure", "viscosity", "vorticity", "solids"]
formats = ["vdb", "vtk"]
"""
LEVEL_SET = """\
dimension = {dim}
[domain]
lower = {lower}
upper = {upper}
cell_size = 0.25
[time]
end = 0.0
[[liquid.region]]
shape = "level_set"
file = "frame.vdb"
"""
MOST_PRINTED = 1 << 20   # bytes
COLORS = ["auto", "speed", "pressure", "none", "vorticity", "divergence"]
# Further options of render, by dimension.
LOOKS = {2: [["--streamlines"], ["--format", "svg", "--per-frame", "--color", "vorticity"], ["--format", "pdf"]],
         3: [["--foam", "--color", "none"], ["--format", "exr", "--transparent"], ["--frames", "0", "--turntable", "2"]]}


def numbers(dim):
    return {"dim": dim, "lower": [0.0] * dim, "upper": [1.0] * dim, "surface": [1.0, 0.4, 1.0][:dim],
            "velocity": [1.0, 0.5, 0.0][:dim], "center": [0.5, 0.7, 0.5][:dim]}


def prepare(bench):
    """Finished runs in 2D and 3D."""
    runs = {}
    for dim in (2, 3):
        at = bench.folder / f"good{dim}"
        at.mkdir()
        (at / "scene.toml").write_text(SCENE.format(**numbers(dim)))
        done = bench.program.run("run", "scene.toml", "--out", "out", folder=at)
        if done.code != 0:
            raise RuntimeError(f"the run to be damaged did not end well:\n{done.errors}")
        runs[dim] = at / "out"
    return runs


def attempt(bench, index, folder):
    rng = bench.random(index)
    dim = rng.choice([2, 2, 3])
    out = folder / "out"
    shutil.copytree(bench.things[dim], out)
    files = sorted(out.glob("frames/*.vdb"))
    if rng.random() < 0.25:   # files that render and info also read
        files = [p for p in sorted(out.glob("frames/*")) + sorted(out.glob("*.*")) if p.is_file()]
    file = rng.choice(files)
    done, data = damage(rng, file.read_bytes(), text=file.suffix != ".vdb")
    file.write_bytes(data)
    what = f"{done} of {file.name}"
    (folder / "damage.txt").write_text(what + "\n")
    (folder / "frame.vdb").write_bytes(data)
    (folder / "scene.toml").write_text(LEVEL_SET.format(**numbers(dim)))
    verbs = [("info", f"out/{file.relative_to(out)}"), ("info", "out"),
             ("render", "out", "--size", "160x120", "--color", rng.choice(COLORS)),
             ("render", "out", "--size", "160x120", *rng.choice(LOOKS[dim])),
             ("plot", "out"), ("check", "scene.toml")]
    ends = []
    for words in verbs:
        ended = bench.program.run(*words, folder=folder, ranks=1)
        allowed = (0, 2, 6) if words[0] == "info" else (0, 2)
        check_end(ended, allowed, f"{words[0]} {words[1]} ({what})")
        if ended.printed > MOST_PRINTED:
            raise Fault("flood", f"{words[0]} printed {ended.printed} bytes ({what})")
        ends.append(ended.code)
    return "noticed" if any(ends) else "read all the same"


def remarks(bench):
    return []
