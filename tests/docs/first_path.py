#!/usr/bin/env python3
"""The way of a first reader, by the documents' own commands: first_path.py SEICHE WORK [FOLDER OF THE PYTHON MODULE]

README.md (first scene), docs/running.md (own scene, info, export), docs/other-programs.md (Blender, ParaView),
docs/python.md (module). Each step takes its commands from the page; a page that loses one fails the test. Runs stop
after a few frames, pictures are small."""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

import commands
import test_commands as tests
from commands import TOP, pages

# Changes that shorten commands of docs/other-programs.md: their runs end after frame 2.
SHORTER = ((r"--frame \d+", "--frame 2"), (r"--samples \d+", "--samples 4"), (r"--size \d+x\d+", "--size 160x90"),
           (r"^(seiche run .*)$", r"\1 --frames 2 --overwrite"))
NEEDED = {"blender": "blender", "pvbatch": "paraview, python3-paraview", "xvfb-run": "xvfb, xauth"}


class Lost(Exception):
    """A page no longer has a command of the path, or the command failed."""


class Reader:
    """Types commands in a folder."""

    def __init__(self, work, module):
        self.work = work
        self.env = tests.environment(work)
        if module:
            self.env["PYTHONPATH"] = str(module)

    def type(self, text, places=()):
        """Runs a command; all of the places (patterns of files) must hold something then."""
        words = shlex.split(text, comments=True)
        if words[0] == "python3":  # the one that the module was built for
            words[0] = sys.executable
        for word in words[:5]:
            if word in NEEDED and not shutil.which(word):
                raise Lost(f"{word} is missing: Debian's packages {NEEDED[word]} ([full] in packages.txt)")
        if words[:4] == ["xvfb-run", "-a", "-s", "-noreset"]:  # displays of several tests may collide
            words = [sys.executable, str(TOP / "tests/programs/virtual_display.py"), *words[4:]]
        print("$", text, flush=True)
        done = subprocess.run(words, cwd=self.work, env=self.env, capture_output=True, text=True, check=False,
                              errors="replace")
        said = done.stdout + done.stderr
        if done.returncode:
            raise Lost(f"{text}: exit code {done.returncode}\n{said[-3000:]}")
        for place in places:
            if not any(file.stat().st_size > 0 for file in self.work.glob(place)):
                raise Lost(f"{text}: wrote no {place}\n{said[-1500:]}")
        return said


def typed(page, pattern):
    """The first command of a page that fits a pattern, as a text."""
    for command in commands.commands_of(TOP / page):
        text = shlex.join(command.words)
        if re.search(pattern, text):
            return text
    raise Lost(f"{page} has no command like '{pattern}'")


def block(page, language, heading):
    """The first block of a language below a heading."""
    text = (TOP / page).read_text(encoding="utf-8")
    if heading not in text:
        raise Lost(f"{page} has no heading '{heading}'")
    for _, found, _, content in pages.fenced(text[text.index(heading):]):
        if found == language:
            return content
    raise Lost(f"{page}: no block of {language} below '{heading}'")


def shortened(text):
    """A command of docs/other-programs.md with fewer frames and smaller pictures."""
    for pattern, replacement in SHORTER:
        text = re.sub(pattern, replacement, text)
    return text


def first_scene(reader):
    """README.md: the scene is saved, checked, run and drawn."""
    reader.type(typed("docs/tutorials/README.md", "^seiche --version"))
    (reader.work / "splash.toml").write_text(block("README.md", "toml", "## A first scene"), encoding="utf-8")
    reader.type(typed("README.md", "seiche check splash.toml"))
    reader.type(typed("README.md", "seiche run splash.toml$"), ["out/splash/frames/frame.0024.vdb"])
    reader.type(typed("README.md", "seiche render out/splash"), ["out/splash/pictures/frame.0024.png"])
    reader.type(typed("README.md", "mpirun -n 2 .*seiche run"), ["out/splash/summary.json"])


def own_scene(reader):
    """docs/running.md: a scene of one's own from an example; its picture, run, facts and files."""
    reader.type(typed("docs/running.md", "^seiche init pool.toml"), ["pool.toml"])
    reader.type(typed("docs/running.md", "^seiche check pool.toml --picture"), ["pool.png"])
    reader.type(typed("docs/running.md", "^seiche run SCENE").replace("SCENE.toml", "pool.toml") + " --frames 3")
    for pattern, more in (("^seiche render NAME|^seiche render out/NAME", ""), ("^seiche info PATH", ""),
                          ("^seiche export out/NAME --format", "")):
        text = typed("docs/running.md", pattern).replace("out/NAME", "out/pool").replace("PATH", "out/pool") + more
        reader.type(text.replace("--format ply", "--format xdmf"))  # ply is for 3D
    if not (reader.work / "out/pool/export/pool.xdmf").is_file():
        raise Lost("seiche export wrote no pool.xdmf")


def other_programs(reader):
    """docs/other-programs.md: a run in 3D opened and drawn in Blender and ParaView."""
    page = "docs/other-programs.md"
    reader.type(shortened(typed(page, "^seiche run scenes/dam_break_obstacle")))
    reader.type(shortened(typed(page, "^blender -b ")).replace("picture.png", "blender.png"), ["blender.png"])
    reader.type(typed(page, "^seiche export .* --format xdmf"), ["out/dam_break_obstacle/export/*.xdmf"])
    reader.type(shortened(typed(page, "pvbatch ")).replace("picture.png", "paraview.png"), ["paraview.png"])


def python_module(reader):
    """docs/python.md: the module says its version, and the page's first program runs."""
    reader.type(typed("docs/python.md", "^python3 -c"))
    program = reader.work / "program.py"
    program.write_text(block("docs/python.md", "python", "# Python").replace("0.5}", "0.1}"), encoding="utf-8")
    if len(reader.type("python3 program.py").splitlines()) < 3:
        raise Lost("the program of docs/python.md printed no steps")


def main():
    work = pathlib.Path(sys.argv[2]).resolve()
    module = pathlib.Path(sys.argv[3]).resolve() if len(sys.argv) > 3 else None
    reader = Reader(tests.scratch_clone(work, sys.argv[1]), module)
    try:
        first_scene(reader)
        own_scene(reader)
        other_programs(reader)
        if module:
            python_module(reader)
    except Lost as fault:
        print(f"FAILED: {fault}")
        return 1
    shutil.rmtree(work, ignore_errors=True)
    return 0


if __name__ == "__main__":
    os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT", "1")
    os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
    sys.exit(main())
