#!/usr/bin/python3
"""Faults of files, signals, memory, ranks and checkpoints, and awkward domains, driven through the built program.

Usage: run_faults.py PROGRAM GROUP [CASE ...]. The docstring of each case names the fault and the required outcome."""
import base64
import csv
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import time
from xml.etree import ElementTree

import numpy
import pyopenvdb

from harness import (DAM, crc32c, expect, frame_files, frame_voxels, frames_are_good, lines_of, newest_checkpoint,
                     rank_processes, recommit, root_process, run_table, same_frames, same_tables, stats, summary,
                     wait_for_steps)

LONG = DAM.replace("end = 0.2", "end = 50.0")   # longer than any test waits


def box_scene(cells, liquid, extra="", end=0.05):
    """A domain of unit cells scaled to 1/16 m; `liquid` is the text of its regions."""
    h = 0.0625
    upper = ", ".join(str(n * h) for n in cells)
    lower = ", ".join(["0.0"] * len(cells))
    return (f"dimension = {len(cells)}\n[domain]\nlower = [{lower}]\nupper = [{upper}]\ncell_size = {h}\n"
            f"[time]\nend = {end}\nframe_rate = 20.0\n[liquid]\ndensity = 1000.0\nviscosity = 0.0\n{liquid}\n{extra}\n")


def region(shape):
    return f"[[liquid.region]]\n{shape}\n"


EVERYWHERE = region('shape = "expression"\nphi = "-1"')


# --- awkward domains -------------------------------------------------------------------------------------------------

def no_liquid_at_all(bench):
    """No liquid in the domain: the run is empty but complete."""
    outside = region('shape = "sphere"\ncenter = [9.0, 9.0]\nradius = 0.1')
    bench.simulate(text=box_scene([16, 16], outside)).needs(0)
    expect(float(stats(bench.path("out"))[-1]["liquid_volume"]) == 0, "there is liquid")


def liquid_drains_away(bench):
    """All liquid leaves through an open floor."""
    drop = region('shape = "box"\nlower = [0.3, 0.05]\nupper = [0.6, 0.3]')
    open_floor = '[domain.boundary]\ny_lower = { type = "outflow", pressure = 0.0 }\n'
    bench.simulate(text=box_scene([16, 16], drop, open_floor, end=1.0)).needs(0)
    # A film on the floor may stay, below the cell centres: a tenth of a layer of cells.
    expect(float(stats(bench.path("out"))[-1]["liquid_volume"]) < 0.1 * 0.0625, "liquid is left")


def no_solids_no_container(bench):
    """A drop in a periodic box."""
    periodic = '[domain.boundary]\n' + "".join(f'{s} = "periodic"\n' for s in ("x_lower", "x_upper", "y_lower", "y_upper"))
    bench.simulate(text=box_scene([16, 16], region('shape = "sphere"\ncenter = [0.5, 0.5]\nradius = 0.2'), periodic)).needs(0)


def full_closed_container(bench):
    """Filled to the lid, at rest, with odd and even sizes: stays at rest without divergence."""
    for cells in ([16, 16], [24, 20], [33, 17], [17, 13], [17, 13, 11], [1, 16, 9]):
        out = "out" + "x".join(map(str, cells))
        bench.simulate("--set", "solver.tolerance=1e-12", text=box_scene(cells, EVERYWHERE), out=out).needs(0)
        last = stats(bench.path(out))[-1]
        # The solver's tolerance times g dt = 0.5 m/s, with a margin for the number of cells; below, the same over h.
        expect(float(last["max_speed"]) < 1e-10, f"{cells}: speed {last['max_speed']}")
        expect(float(last["max_divergence"]) < 1e-8, f"{cells}: divergence {last['max_divergence']}")


def full_container_with_moving_solid(bench):
    """A solid that moves inside a full container."""
    mover = ('[[solid]]\nname = "mover"\nkind = "kinematic"\nshape = "sphere"\ncenter = [0.5, 0.5]\nradius = 0.15\n'
             'motion = { translate = ["0.1*sin(6*t)", "0"] }\n')
    bench.simulate(text=box_scene([17, 16], EVERYWHERE, mover, end=0.2)).needs(0)


def inflow_without_outlet(bench):
    """A full closed container with an inflow is impossible."""
    inflow = '[domain.boundary]\nx_lower = { type = "inflow", velocity = ["1", "0"] }\n'
    result = bench.simulate(text=box_scene([16, 16], EVERYWHERE, inflow))
    expect(result.code in (2, 3), f"exit code {result.code}")
    result.needs(result.code)


def inflow_balanced_to_round_off(bench):
    """Inflow on one side equals outflow on the other up to the last bit."""
    sides = ('[domain.boundary]\nx_lower = { type = "inflow", velocity = ["0.1+0.2", "0"] }\n'
             'x_upper = { type = "inflow", velocity = ["0.3", "0"] }\n')
    bench.simulate(text=box_scene([16, 17], EVERYWHERE, sides)).needs(0)


def droplets_and_enclosed_cells(bench):
    """Droplets of a cell or less, and cells enclosed by solids."""
    drops = "".join(region(f'shape = "sphere"\ncenter = [{x}, {y}]\nradius = {r}')
                    for x, y, r in [(0.2, 0.8, 0.04), (0.5, 0.81, 0.03), (0.7, 0.6, 0.07), (0.22, 0.4, 0.05)])
    blocks = "".join(f'[[solid]]\nname = "b{n}"\nkind = "static"\nshape = "box"\nlower = [{x}, {y}]\nupper = [{x + 0.2}, {y + 0.2}]\n'
                     for n, (x, y) in enumerate([(0.1, 0.3), (0.3001, 0.3), (0.6, 0.1)]))
    bench.simulate(text=box_scene([16, 16], drops, blocks, end=0.2)).needs(0)
    frames_are_good(bench.path("out"), 5)


def odd_and_thin_grids(bench):
    """Odd, prime and long thin grids, also one cell thick."""
    for cells in ([17, 13], [31, 7], [2, 2], [4, 4, 500], [3, 5, 7], [1, 16], [16, 1], [1, 9, 8], [9, 1, 8], [9, 8, 1], [1, 16, 1]):
        upper = ", ".join(str(n * 0.0625 / 2) if axis < 2 and n > 1 else "99.0" for axis, n in enumerate(cells))
        pool = region(f'shape = "box"\nlower = [{", ".join(["-1.0"] * len(cells))}]\nupper = [{upper}]')
        thin = "xyz"[cells.index(1)] if 1 in cells else ""
        for name, sides in {"walls": "", "periodic": f'[domain.boundary]\n{thin}_lower = "periodic"\n{thin}_upper = "periodic"\n'}.items():
            if sides and not thin:
                continue
            bench.simulate("--frames", "1", text=box_scene(cells, pool, sides), ranks=3 if sides else 0,
                           out=f"out_{name}_" + "x".join(map(str, cells))).needs(0)
    bench.simulate(text=box_scene([1, 1, 1], ""), out="single").needs(2, "single cell")


def outlines_are_accounted_for(bench):
    """Corners that the grid cuts off are no loss; what lies beyond a side is."""
    for lift, told in ((0.0, False), (-0.35, True)):
        points = [[0.1, 0.3 + lift], [0.9, 0.3 + lift], [0.5, 0.4 + lift]]
        text = box_scene([32, 32], region(f'shape = "polygon"\npoints = {points}'))
        output = bench.run("check", bench.scene(text)).needs(0).output
        expect(("lies outside of the domain" in output) == told, f"lifted by {lift}:\n{output}")


def scene_is_accounted_for(bench):
    """`check` and the start of `run` report liquid, masses, sizes and positions, and the parts that are lost."""
    pool = region('shape = "box"\nlower = [0.0, 0.0]\nupper = [1.0, 0.5]')
    lost = region('shape = "box"\nlower = [0.7, 0.55]\nupper = [0.8, 0.65]') + region('shape = "sphere"\ncenter = [5.0, 5.0]\nradius = 0.1')
    block = '[[solid]]\nname = "block"\nkind = "static"\nshape = "box"\nlower = [0.6, 0.25]\nupper = [1.4, 0.75]\n'
    far = '[[solid]]\nname = "far"\nkind = "static"\nshape = "sphere"\ncenter = [3.0, 0.5]\nradius = 0.2\n'
    ball = '[[solid]]\nname = "ball"\nkind = "rigid"\nshape = "box"\nlower = [0.2, 0.6]\nupper = [0.4, 0.8]\ndensity = 250.0\n'
    sheet = ('[[solid]]\nname = "sheet"\nkind = "static"\nshape = "expression"\n'
             'phi = "max(abs(x+0.3*y-0.5)-0.008,abs(y-0.8)-0.15)"\n')
    sources = ('[[liquid.source]]\nshape = "box"\nlower = [1.2, 0.2]\nupper = [1.5, 0.5]\n'
               '[[liquid.source]]\nshape = "box"\nlower = [0.8, 0.3]\nupper = [0.9, 0.4]\n')
    text = box_scene([16, 16], pool + lost, sources + block + far + ball + sheet)
    lost = ("liquid.source.0 has no room at the start: it lies outside", "liquid.source.1 has no room at the start: all of its",
            "liquid.region.1 holds no liquid: all of its", "liquid.region.2 holds no liquid: it lies outside",
            "solid 'far' lies outside of the domain, from (2.8, 0.3)",
            "solid 'sheet' has parts thinner than a cell of 0.0625 m")
    logged = ("solid   'block', static: 0.4 m^2, from (0.6, 0.25) to (1.4, 0.75) m; 50 % of it lies outside of the domain",
              "solid   'ball', rigid: 0.04 m^2, 10 kg/m, centre of mass (0.3, 0.7), from (0.2, 0.6) to (0.4, 0.8) m")
    rows = (("'block'", "static", "0.4", "(1, 0.5)", "0.8 x 0.5", "50 % lies outside of the domain"),
            ("'ball'", "rigid", "10", "250", "0.04", "(0.3, 0.7)", "0.2 x 0.2", "floats, 0.05 m"))
    for ranks in (0, 2):
        checked = bench.run("check", bench.scene(text), ranks=ranks)
        for row in rows:
            matching = [line for line in checked.output.splitlines() if line.startswith(row[0])]
            expect(len(matching) == 1 and all(word in matching[0] for word in row), f"{row} is not once in\n{checked.output}")
        for result in (checked.needs(0, *lost),
                       bench.simulate("--frames", "0", "--overwrite", text=text, ranks=ranks).needs(0, *lost, *logged)):
            figures = re.search(r"liquid  (\S+) m\^2, (\S+) kg/m; (\S+) m\^2 of its regions lies inside solids", result.output)
            expect(figures, f"no line on the liquid in\n{result.output}")
            for figure, right in zip(figures.groups(), (0.4, 400.0, 0.11)):   # corners are cut off within their cells
                expect(abs(float(figure) - right) < 0.05 * right, f"{figure} where {right} is right")
    outlines_are_accounted_for(bench)
    thin = '[[solid]]\nname = "sheet"\nkind = "static"\nshape = "box"\nlower = [0.5, 0.2]\nupper = [0.51, 0.9]\n'
    bench.run("check", bench.scene(box_scene([16, 16], pool, thin))).needs(0, "off: leapfrog of surface and velocity (because of: solids thinner than a cell)")


def start_in_numbers(bench):
    """`check`: draughts of bodies that float or sink, one object of JSON, trial steps that leave nothing, sources in liquid."""
    pool = region('shape = "box"\nlower = [0.0, 0.0]\nupper = [1.0, 0.5]') + region('shape = "box"\nlower = [0.5, 0.5]\nupper = [1.5, 0.6]')
    def solid(name, density, x, more=""):
        return (f'[[solid]]\nname = "{name}"\nkind = "rigid"\nshape = "box"\nlower = [{x}, 0.7]\nupper = [{x + 0.1}, 0.8]\n'
                f'density = {density}\n{more}')
    joint = '[[joint]]\nname = "pin"\nkind = "hinge"\nbetween = ["hung", "world"]\nat = [0.75, 0.75]\n'
    source = '[[liquid.source]]\nshape = "box"\nlower = [0.2, 0.1]\nupper = [0.4, 0.3]\n'
    text = box_scene([16, 16], pool, source + solid("light", 300, 0.1) + solid("stone", 2000, 0.3)
                     + solid("held", 300, 0.5, 'fixed = ["y"]\n') + solid("hung", 300, 0.7) + joint)
    scene = bench.scene(text)
    for ranks in (0, 2):
        result = bench.run("check", scene, "--json", ranks=ranks).needs(0)
        found = json.loads(result.output[result.output.index("{"):result.output.rindex("}") + 1])
        solids = {one["name"]: one for one in found["solids"]}
        expect(abs(solids["light"]["draught"] - 0.03) < 1e-6, f"draught of a box: {solids['light']}")
        expect(solids["stone"]["sinks"] and "draught" not in solids["stone"], f"{solids['stone']}")
        expect(all("sinks" not in solids[name] for name in ("held", "hung")), "draughts of bodies that are not free")
        expect(any("lies wholly inside the liquid" in text for text in found["warnings"]), f"{found['warnings']}")
        outside = [re.match(r"liquid.region.1: about (\S+) % of its 0.1 m\^2 lies outside", text) for text in found["notes"]]
        expect(outside[0] and abs(float(outside[0].group(1)) - 50) < 5, f"{found['notes']}")   # corners are cut off
        expect(found["ranks"] == max(1, ranks) and found["estimate"]["memory_bytes"] > 5e7, f"{found['estimate']}")
    before = sorted(bench.path(".").rglob("*"))
    result = bench.run("check", scene, "--set", "time.end=1.0", "--measure", "4").needs(0, "4 trial steps")
    expect(result.output.count("no errors") == 1, "not one table")
    expect(sorted(bench.path(".").rglob("*")) == before, "trial steps left files")
    bench.run("check", scene, "--picture", "start.png", ranks=2).needs(0, "picture start.png")
    expect(bench.path("start.png").read_bytes().startswith(b"\x89PNG"), "no picture")
    bench.run("check", scene, "--picture", "/proc/none/start.png").needs(4, "/proc/none")
    bench.run("check", scene, "--measure", "0").needs(2, "--measure")


def nothing_to_do(bench):
    """An end at or before the start: a note, headers, and success."""
    bench.simulate("--set", "time.end=0", out="zero").needs(0, "note")
    frames_are_good(bench.path("zero"), 1)
    bench.simulate("--frames", "0", out="none").needs(0)
    for end, text in (("0", "nothing is simulated"), ("-1", "note: the end time (time.end) is not after the start")):
        bench.run("check", bench.scene(), "--set", "time.end=" + end).needs(0, text)
        bench.simulate("--set", "time.end=" + end, out="end" + end).needs(0, text)
        expect(lines_of(bench.path("end" + end) / "stats.csv")[0].startswith("step,time,dt"), "no header")
    expect(lines_of(bench.path("none") / "stats.csv")[0].startswith("step,time,dt"), "no header")


# --- formulas and pinned steps ---------------------------------------------------------------------------------------

BAD_AT_START = {
    "liquid.velocity[0]": ("liquid.velocity", '["sqrt(x-0.2)", "0"]'),
    "liquid.region.0.velocity[1]": ("liquid.region.0.velocity", '["0", "1/(0*x)"]'),
    "domain.boundary.x_upper.velocity[0]":
        ("domain.boundary.x_upper", '{ type = "inflow", velocity = ["log(y-0.1)", "0"] }'),
    "domain.boundary.y_upper.pressure":
        ("domain.boundary.y_upper", '{ type = "outflow", pressure = "sqrt(-1-x)" }'),
}


def formula_not_finite_at_start(bench):
    """A formula that is NaN or infinite at the start: 2, key, position and value, on any number of ranks."""
    for key, (path, value) in BAD_AT_START.items():
        for ranks in (0, 3):
            result = bench.simulate("--set", f"{path}={value}", ranks=ranks).needs(2, key, " at (")
            expect(re.search(r"is (nan|infinite) at", result.errors), result.errors)
            expect(not bench.path("out/stats.csv").exists(), "the run had begun")
        bench.run("check", bench.scene(), "--set", f"{path}={value}").needs(2, key, " at (")


def shape_not_finite(bench):
    """A shape whose formula is not finite on one rank's cells: 2, with the line of the shape."""
    shape = region('shape = "expression"\nphi = "sqrt(0.9-x)-1"')
    for ranks in (0, 3):
        bench.simulate(text=box_scene([16, 16], shape), ranks=ranks).needs(2, "scene.toml:", "phi = ", "is nan at (")


def formula_not_finite_later(bench):
    """A side's formula becomes NaN: 3 in that step, naming the side; no NaN on disk; resume reports the same."""
    later = 'domain.boundary.y_upper={ type = "outflow", pressure = "0*sqrt(0.1-t)" }'
    for ranks in (0, 3):
        out = f"later{ranks}"
        bench.simulate("--set", later, out=out, ranks=ranks).needs(3, "domain.boundary.y_upper.pressure", "is nan at (")
        expect(0 < float(stats(bench.path(out))[-1]["time"]) <= 0.1, "not stopped in time")
        for name in ("stats.csv", "solids.csv", "probes.csv"):
            expect("nan" not in bench.path(f"{out}/{name}").read_text(), f"NaN in {name}")
        frames_are_good(bench.path(out), 3 if float(stats(bench.path(out))[-1]["time"]) == 0.1 else 2)
        bench.run("resume", out, ranks=ranks).needs(3, "domain.boundary.y_upper.pressure")


def pinned_step_too_long(bench):
    """fixed_step above the limit of the flow: 2 if the start shows it, else 3 with figures and a checkpoint."""
    bench.simulate("--set", "time.fixed_step=0.02", "--set", "liquid.velocity=[3.0, 0.0]", out="start").needs(
        2, "time.fixed_step", "cells", "lower fixed_step")
    bench.simulate("--set", "time.fixed_step=0.05", out="later").needs(3, "time.fixed_step", "cells", "lower fixed_step")
    last = stats(bench.path("later"))[-1]
    expect(f"{int(last['step']):08d}" == newest_checkpoint(bench.path("later")).name, "not the last good step")


# --- ranks -------------------------------------------------------------------------------------------------------------

def more_ranks_than_cells(bench):
    """2 x 2 cells on five ranks; some ranks idle."""
    bench.simulate("--frames", "1", text=box_scene([2, 2], EVERYWHERE.replace("-1", "y-0.07")), ranks=5).needs(0)


def more_ranks_than_liquid(bench):
    """All liquid in one corner: ranks without liquid."""
    drop = region('shape = "sphere"\ncenter = [0.1, 0.1]\nradius = 0.09')
    bench.simulate(text=box_scene([24, 24], drop), ranks=7).needs(0)


def many_oversubscribed_ranks(bench):
    """16 ranks on any number of cores."""
    bench.simulate("--frames", "1", ranks=16, limit=120).needs(0)


def liquid_moves_between_ranks(bench):
    """Ranks lose all liquid and receive some again."""
    drop = region('shape = "box"\nlower = [0.0, 0.8]\nupper = [1.0, 0.95]')
    bench.simulate(text=box_scene([8, 32], drop, end=0.5), ranks=3).needs(0)


def openmp_environment(bench):
    """Absurd OMP_NUM_THREADS: a warning, the same result, and a record of it."""
    bench.simulate(out="plain").needs(0)
    bench.simulate(out="many", env={"OMP_NUM_THREADS": "640"}).needs(0, "OMP_NUM_THREADS")
    bench.simulate("--threads", "3", out="three").needs(0)
    same_frames(bench.path("plain"), bench.path("many"))
    same_frames(bench.path("plain"), bench.path("three"))
    expect(summary(bench.path("many"))["omp_num_threads"] == "640", "not recorded")
    expect(summary(bench.path("three"))["threads"] == 3, "threads not recorded")


def ranks_share_a_processor(bench):
    """More ranks or threads than allowed processors: a warning; else none."""
    allowed = os.sched_getaffinity(0)
    words = ("2 ranks with 1 thread each on 1 processor", "1 rank with 2 threads each on 1 processor")
    try:
        os.sched_setaffinity(0, {min(allowed)})
        bench.simulate("--frames", "0", out="ranks", ranks=2).needs(0, words[0])
        bench.simulate("--frames", "0", "--threads", "2", out="threads").needs(0, words[1])
        bench.simulate("--frames", "0", out="one").needs(0)
    finally:
        os.sched_setaffinity(0, allowed)
    expect("processor" not in (bench.path("one") / "log.txt").read_text(), "a warning on one rank")


def openmp_differs_between_ranks(bench):
    """OMP_NUM_THREADS different on two ranks: a warning."""
    scene = bench.scene()
    script = bench.path("start.sh")
    script.write_text(f'#!/bin/sh\nOMP_NUM_THREADS=$((OMPI_COMM_WORLD_RANK + 1)) exec {bench.program} "$@"\n')
    script.chmod(0o755)
    bench.program = str(script)
    bench.run("run", scene, "--out", "out", "--frames", "1", ranks=2).needs(0, "OMP_NUM_THREADS")


# --- output ------------------------------------------------------------------------------------------------------------

def output_folder_created(bench):
    """A missing output folder is created with its parents."""
    bench.simulate("--frames", "1", out="a/b/c").needs(0)
    frames_are_good(bench.path("a/b/c"), 2)


def output_is_a_file(bench):
    """The output folder is a file, or lies below a file."""
    bench.path("file").write_text("x")
    bench.simulate(out="file").needs(4, "file")
    bench.simulate(out="file/sub").needs(4, "file")
    expect(bench.path("file").read_text() == "x", "the file was touched")


def output_not_writable(bench):
    """A folder without permission, or on a read-only file system."""
    bench.simulate(out="/proc/none").needs(4, "/proc/none")
    locked = bench.path("locked")
    locked.mkdir()
    locked.chmod(0o555)
    if os.access(locked, os.W_OK):
        return "may write everywhere; only /proc was tried"
    bench.simulate(out="locked/run").needs(4, "locked")


def existing_output_refused(bench):
    """A folder with a run or other files needs --overwrite, which keeps foreign files."""
    bench.simulate("--frames", "1").needs(0)
    before = lines_of(bench.path("out/stats.csv"))
    bench.simulate("--frames", "1").needs(2, "--overwrite")
    expect(lines_of(bench.path("out/stats.csv")) == before, "the refused run changed the tables")
    bench.path("out/mine.txt").write_text("mine")
    bench.simulate("--frames", "2", "--overwrite").needs(0)
    frames_are_good(bench.path("out"), 3)
    expect(bench.path("out/mine.txt").exists(), "a stranger's file is gone")


def options_without_a_value(bench):
    """An empty word is refused, but for options that need none."""
    bench.simulate(out="").needs(2, "--out: is empty")
    bench.simulate("--frames", "1").needs(0)
    bench.run("render", "out", "--frames", "0", "--size", "160x120", "--contact-sheet").needs(0)
    expect(bench.path("out/pictures/contact_sheet.png").exists(), "no contact sheet")


def two_jobs_in_one_folder(bench):
    """The second job in a folder, and resuming a folder in use."""
    first = bench.start("run", bench.scene(LONG), "--out", "out")
    wait_for_steps(bench)
    bench.simulate("--overwrite").needs(4, "in use")
    bench.run("resume", "out").needs(4, "in use")
    first.send_signal(signal.SIGTERM)
    bench.finish(first).needs(75)


def file_size_limit(bench):
    """A frame, then a table, reaches the limit of file sizes: a message with path and free bytes, no truncated file
    under a final name, a valid last checkpoint. (The limit is set on the running process: MPI's own files need more.)"""
    for out, cell_size, limit in (("frame", "0.0078125", 20000), ("table", "0.03125", 3000)):
        text = LONG.replace("0.03125", cell_size).replace("checkpoint_every = 1", "checkpoint_every = 1000")
        process = bench.start("run", bench.scene(text), "--out", out)
        wait_for_steps(bench, out)
        resource.prlimit(root_process(bench, out), resource.RLIMIT_FSIZE, (limit, limit))
        bench.finish(process).needs(4, "bytes free", f"/{out}/", "File too large")
        frames_are_good(bench.path(out))
        bench.run("resume", out, "--end", "0.05").needs(0)


def full_device(bench):
    """/dev/full in place of each growing file, and of the folders of frames and checkpoints."""
    bench.simulate("--frames", "1").needs(0)
    for name in ("stats.csv", "solids.csv", "probes.csv", "log.txt"):
        shutil.copytree(bench.path("out"), bench.path("copy"))
        file = bench.path("copy") / name
        file.unlink()
        file.symlink_to("/dev/full")
        bench.run("resume", "copy", "--frames", "3").needs(4, name, "No space left")
        file.unlink()
        if name != "log.txt":
            bench.run("resume", "copy", "--frames", "3").needs(6, name + " is missing")
        bench.run("resume", "copy", "--frames", "3", *([] if name == "log.txt" else ["--force"])).needs(0)
        shutil.rmtree(bench.path("copy"))


def full_disk(bench):
    """A small file system fills up during the run."""
    disk = bench.path("disk")
    disk.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", str(disk)], capture_output=True).returncode:
        return "mounting a small file system is not permitted"
    try:
        process = bench.start("run", bench.scene(LONG), "--out", "disk/run")
        wait_for_steps(bench, "disk/run")
        with open(disk / "ballast", "wb", buffering=0) as ballast:
            try:
                while True:
                    ballast.write(bytes(4096))
            except OSError:
                pass
        bench.finish(process).needs(4, "No space left", "bytes free")
        frames_are_good(disk / "run")
        (disk / "ballast").unlink()
        bench.run("resume", "disk/run", "--end", "0.05").needs(0)
    finally:
        subprocess.run(["umount", str(disk)])


def few_file_handles(bench):
    """ulimit -n 16: a failure with a message, or none."""
    limit = lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (16, 16))
    result = bench.simulate("--frames", "1", limits=limit)
    expect(result.code != 0 or not frames_are_good(bench.path("out"), 2), "frames are missing")
    expect(result.code in (0, 4, 5) or "MPI" in result.errors + result.output or "open" in result.errors,
           f"exit code {result.code}: {result.errors}")


# --- memory -----------------------------------------------------------------------------------------------------------

def grid_larger_than_any_machine(bench):
    """1e5 cells an axis: refused with an estimate before anything is allocated."""
    text = box_scene([100000, 100000, 100000], region('shape = "plane"\npoint = [0, 1, 0]\nnormal = [0, 1, 0]'))
    result = bench.simulate(text=text).needs(2)
    expect(result.seconds < 10, "took long to refuse")
    expect(not bench.path("out").exists(), "left a folder")


def address_space_limit(bench):
    """ulimit -v below the need."""
    text = DAM.replace("cell_size = 0.03125", "cell_size = 0.00048828125")   # 2 M cells, 2 GB or so
    limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
    bench.simulate("--frames", "1", text=text, limits=limit).needs(5, "out of memory")
    little = lambda: resource.setrlimit(resource.RLIMIT_AS, (170 << 20, 170 << 20))   # with less, libraries abort (134) or are not loaded (127)
    bench.simulate("--frames", "1", text=text, limits=little).needs(5, "limit of address space")


def allocation_fails_on_one_rank(bench):
    """bad_alloc in the middle of a step, on one of three ranks."""
    bench.simulate("--inject", "solve:1:badalloc:3", ranks=3).needs(5, "out of memory", "rank 1")


# --- stopping -------------------------------------------------------------------------------------------------------

def unbroken(bench):
    bench.simulate(out="whole").needs(0)
    return bench.path("whole")


def resumed_equals(bench, out, whole):
    bench.run("resume", out).needs(0)
    same_tables(bench.path(out), whole)
    same_frames(bench.path(out), whole)


def stop_by_signal(bench):
    """SIGUSR1, SIGINT, SIGTERM: a checkpoint at the next step, and the same bits after resuming."""
    fine = DAM.replace("cell_size = 0.03125", "cell_size = 0.0078125")
    bench.simulate(text=fine, out="whole").needs(0)
    for number in (signal.SIGUSR1, signal.SIGINT, signal.SIGTERM):
        out = f"out{int(number)}"
        process = bench.start("run", bench.scene(fine), "--out", out)
        wait_for_steps(bench, out)
        process.send_signal(number)
        bench.finish(process).needs(75, "stopped: " + number.name)
        expect(summary(bench.path(out))["exit_code"] == 75, "the summary does not say it")
        resumed_equals(bench, out, bench.path("whole"))


def handles(pid, number):
    """True if the process has a handler for the signal."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    caught = next(line.split()[1] for line in status.splitlines() if line.startswith("SigCgt"))
    return bool(int(caught, 16) >> (number - 1) & 1)


def stop_in_the_first_moments(bench):
    """SIGTERM 0 to 0.3 s after the start: 75 and a message. The signal may kill only before there is a handler, while the
    system loads libraries, which a busy machine prolongs; nothing is written by then."""
    scene, heard = bench.scene(LONG), 0
    for n in range(15):
        process = bench.start("run", scene, "--out", f"out{n}")
        time.sleep(0.02 * n)
        handled = handles(process.pid, signal.SIGTERM)
        process.send_signal(signal.SIGTERM)
        result = bench.finish(process)
        if result.code == -signal.SIGTERM:
            expect(not bench.path(f"out{n}").exists() and not handled, f"after {0.02 * n} s the run died of the signal")
            continue
        heard += 1
        result.needs(75, "stopped: SIGTERM")
        if bench.path(f"out{n}").exists():
            expect(summary(bench.path(f"out{n}"))["exit_code"] == 75, "the summary does not say it")
    expect(heard > 0, "no signal was heard")
    for verb in ("check", "info"):   # verbs that do not handle signals do not block them
        expect(bench.run(verb, scene if verb == "check" else ".").code in (0, 2), verb)


def run_folder_removed(bench):
    """The run directory removed while running: 4, and never 0."""
    short = DAM.replace("cell_size = 0.03125", "cell_size = 0.0078125").replace("frame_rate = 20.0", "frame_rate = 5.0")
    process = bench.start("run", bench.scene(short), "--out", "gone")
    wait_for_steps(bench, "gone")
    shutil.rmtree(bench.path("gone"), ignore_errors=True)
    bench.finish(process).needs(4)


def stop_by_file_and_walltime(bench):
    """A file named stop, and --walltime."""
    whole = unbroken(bench)
    bench.simulate("--walltime", "0", out="walltime").needs(75, "wall time")
    resumed_equals(bench, "walltime", whole)
    process = bench.start("run", bench.scene(LONG), "--out", "file")
    wait_for_steps(bench, "file")
    bench.path("file/stop").write_text("")
    bench.finish(process).needs(75, "stop file")
    expect(not bench.path("file/stop").exists(), "the stop file is still there")


def stop_under_mpirun(bench):
    """SIGUSR1 to mpirun is forwarded; SIGTERM to one rank stops all; SIGTERM to mpirun kills, resume continues."""
    for number, to_rank in ((signal.SIGUSR1, False), (signal.SIGTERM, True)):
        out = f"out{int(number)}"
        process = bench.start("run", bench.scene(LONG), "--out", out, ranks=2)
        wait_for_steps(bench, out)
        if to_rank:
            os.kill(rank_processes(process)[-1], number)
        else:
            process.send_signal(number)
        bench.finish(process).needs(75)
    process = bench.start("run", bench.scene(LONG), "--out", "killed", ranks=2)
    wait_for_steps(bench, "killed")
    process.send_signal(signal.SIGTERM)
    expect(bench.finish(process).code != 0, "mpirun was killed but reports success")
    bench.run("resume", "killed", "--end", "0.2", ranks=2).needs(0)


def hung_rank(bench):
    """SIGSTOP to one rank, and a hang inside a phase: the watchdog ends the job with 124 and names the phase."""
    process = bench.start("run", bench.scene(LONG), "--out", "out", "--watchdog", "3", ranks=3)
    wait_for_steps(bench)
    os.kill(rank_processes(process)[1], signal.SIGSTOP)
    bench.finish(process).needs(124, "no progress", "phase")
    bench.simulate("--inject", "solve:0:hang:2", "--watchdog", "2", out="hang").needs(124, "phase 'solve'")
    frames_are_good(bench.path("out"))


def killed_and_resumed(bench):
    """SIGKILL in the middle of the run, a few times, then the end: the same bits."""
    whole = unbroken(bench)
    bench.simulate("--inject", "solve:0:kill:5")
    bench.run("resume", "out", "--inject", "checkpoint:0:kill:1")
    bench.run("resume", "out", "--inject", "frame:0:kill:1")
    resumed_equals(bench, "out", whole)


def resume_of_finished_run(bench):
    """Nothing to do, unless a later end is given; the result then equals a run with that end from the start."""
    bench.simulate("--set", "time.end=0.1").needs(0)
    bench.run("resume", "out").needs(0, "finished")
    bench.simulate(out="whole").needs(0)
    bench.run("resume", "out", "--end", "0.2").needs(0)
    same_tables(bench.path("out"), bench.path("whole"))
    same_frames(bench.path("out"), bench.path("whole"))
    bench.run("resume", "nowhere").needs(2, "nowhere")


def resume_keeps_volumes_as_they_were(bench):
    """Where "auto" would choose anew, a run goes on with cells or the shift as it began: no drop is lost."""
    high = region('shape = "box"\nlower = [0.3, 0.6]\nupper = [0.5, 0.61]')
    pool = region('shape = "box"\nlower = [0.0, 0.0]\nupper = [1.0, 0.3]')
    bench.simulate("--frames", "1", text=box_scene([32, 32], pool + high)).needs(0, "volume  carried by cells")
    drops = float(stats(bench.path("out"))[-1]["drops"])
    expect(drops > 0, "no drop flies")
    bench.run("resume", "out", "--frames", "2", "--set", "time.cfl=5").needs(0)
    rows = stats(bench.path("out"))
    expect(float(rows[-1]["drops"]) > 0.5 * drops, f"{rows[-1]['drops']} drops of {drops} are left")
    expect(all(float(row["volume_corrected"]) == 0 for row in rows), "a shift moved the surface")
    bench.simulate("--frames", "1", "--set", "time.cfl=8", text=box_scene([32, 32], pool), out="long").needs(
        0, "volume  kept by a shift of the liquid's surface, since time.cfl is above 4")
    bench.run("resume", "long", "--frames", "2", "--set", "time.cfl=1").needs(0)


# --- injected faults -------------------------------------------------------------------------------------------------

PHASES = ("transport", "geometry", "solve", "restore", "frame", "checkpoint", "stats")


def exception_in_every_phase(bench):
    """One of three ranks throws: the same code, its message, and the job ends within ten seconds."""
    for phase in PHASES:
        result = bench.simulate("--inject", f"{phase}:1:throw:2", out=phase, ranks=3)
        result.needs(1, f"injected fault in phase {phase}", "rank 1")
        expect(result.seconds < 10, f"{phase}: took {result.seconds:.0f} s to end")
        frames_are_good(bench.path(phase))


def rank_killed(bench):
    """One of three ranks is killed: the job ends, and can be resumed."""
    result = bench.simulate("--inject", "solve:2:kill:6", ranks=3)
    expect(result.code != 0 and result.seconds < 10, f"exit code {result.code} after {result.seconds:.0f} s")
    bench.run("resume", "out", ranks=3).needs(0)


def nan_once_in_numerics(bench):
    """A NaN that appears once is detected in the same step, and half the step is tried instead."""
    for phase in ("transport", "geometry", "solve", "restore"):
        result = bench.simulate("--inject", f"{phase}:0:nan:3", out=phase)
        expect(result.code in (0, 3), f"{phase}: exit code {result.code}\n{result.errors}")
        result.needs(result.code)
        expect("nan" not in bench.path(f"{phase}/stats.csv").read_text(), "NaN in the table")
        frames_are_good(bench.path(phase))


FALLING_DROP = """\
dimension = 2
gravity = [0.0, -10.0]
[domain]
lower = [0.0, 0.0]
upper = [1.0, 1.0]
cell_size = 0.0625
[domain.boundary]
x_lower = "periodic"
x_upper = "periodic"
y_lower = "periodic"
y_upper = "periodic"
[time]
end = 0.05
frame_rate = 20.0
fixed_step = 0.02
cfl = 4.0
[liquid]
velocity = [1.0, 0.0]
[[liquid.region]]
shape = "sphere"
center = [0.5, 0.5]
radius = 0.3
"""


def energy_beyond_the_budget(bench):
    """A step that gains more energy than there is is tried again at half its length, told and counted."""
    for ranks in (1, 2):
        out = f"blown_{ranks}"
        result = bench.simulate("--break", "gravity:20", text=FALLING_DROP, out=out, ranks=ranks).needs(0)
        expect("kinetic energy grows" in result.errors and "trying half the step" in result.errors, result.errors)
        with open(bench.path(f"{out}/stats.csv")) as file:
            rejected = [int(row["rejected"]) for row in csv.DictReader(file)]
        expect(sum(rejected) == result.errors.count("trying half the step") > 0, f"rejected: {rejected}")
        frames_are_good(bench.path(out))


def nan_that_stays(bench):
    """A NaN in every attempt ends the run with 3, field and cell, and a checkpoint of the last good step."""
    for phase in ("transport", "solve", "frame", "checkpoint", "stats"):
        result = bench.simulate("--inject", f"{phase}:0:nan:4+", out=phase).needs(3)
        if phase in ("transport", "frame"):
            expect(re.search(r"cell \(", result.errors), f"{phase}: no cell named\n{result.errors}")
        expect("nan" not in bench.path(f"{phase}/stats.csv").read_text(), "NaN in the table")
        frames_are_good(bench.path(phase))
        bench.run("resume", phase).needs(0)


# --- checkpoints ---------------------------------------------------------------------------------------------------

def stopped_run(bench, ranks=0):
    bench.simulate("--set", "time.end=0.15", ranks=ranks).needs(0)
    return bench.path("out")


def damaged_checkpoints(bench):
    """Each kind of damage to the newest checkpoint: the one before is used, with a warning, to the same end."""
    whole = unbroken(bench)
    stopped_run(bench)

    def flip(offset):
        def damage(folder):
            file = folder / "rank.00000"
            data = bytearray(file.read_bytes())
            data[offset if offset >= 0 else len(data) + offset] ^= 0x40
            file.write_bytes(data)
        return damage

    def cut(share):
        def damage(folder):
            file = folder / "rank.00000"
            data = file.read_bytes()
            file.write_bytes(data[:int(len(data) * share)])
        return damage

    def other_step(folder):
        shutil.copy(min(folder.parent.iterdir()) / "rank.00000", folder / "rank.00000")

    damages = {"magic": flip(0), "version": flip(12), "dimensions": flip(24), "data": flip(5000), "CRC": flip(-1),
               "cut at 0": cut(0), "cut at 50 %": cut(0.5), "cut at 99 %": cut(0.99), "other step": other_step,
               "missing file": lambda f: (f / "rank.00000").unlink(), "missing COMMIT": lambda f: (f / "COMMIT").unlink(),
               "COMMIT": lambda f: (f / "COMMIT").write_text((f / "COMMIT").read_text().replace("step", "stop"))}
    for name, damage in damages.items():
        copy = bench.path("copy")
        shutil.copytree(bench.path("out"), copy)
        damage(newest_checkpoint(copy))
        bench.run("resume", "copy", "--end", "0.2").needs(0, "not usable")
        same_tables(copy, whole)
        same_frames(copy, whole)
        shutil.rmtree(copy)


def damaged_tables(bench):
    """stats.csv, solids.csv or probes.csv missing, truncated or changed: 6 with the name; --force uses the remains."""
    out = stopped_run(bench)
    for name in ("stats.csv", "solids.csv", "probes.csv"):
        table = out / name
        original = table.read_bytes()
        for text, damage in (("is missing", None), ("bytes where", original[:-7]), ("checksum", b"X" + original[1:])):
            if damage is None:
                table.unlink()
            else:
                table.write_bytes(damage)
            for ranks in (0, 2):
                bench.run("resume", "out", "--end", "0.2", ranks=ranks).needs(6, name, text, "--force")
            table.write_bytes(original)
    table = out / "stats.csv"
    rows = len(lines_of(table))
    table.write_bytes(table.read_bytes()[:-7])
    bench.run("resume", "out", "--end", "0.2", "--force").needs(0, "stats.csv has")
    expect(len(lines_of(table)) >= rows and all(line.count(",") == lines_of(table)[0].count(",") for line in lines_of(table)),
           "the table has broken rows")


def no_checkpoint_left(bench):
    """All checkpoints damaged or missing: 6."""
    out = stopped_run(bench)
    for folder in (out / "checkpoints").iterdir():
        file = folder / "rank.00000"
        file.write_bytes(file.read_bytes()[:-1])
    bench.run("resume", "out", "--end", "0.2").needs(6, "no usable checkpoint")
    shutil.rmtree(out / "checkpoints")
    bench.run("resume", "out", "--end", "0.2").needs(6)


def extra_file_is_ignored(bench):
    """A foreign file in a checkpoint changes nothing."""
    out = stopped_run(bench)
    (newest_checkpoint(out) / "rank.00007").write_text("stranger")
    bench.run("resume", "out", "--end", "0.2").needs(0)


def swapped_rank_files(bench):
    """The files of two ranks exchanged: never loaded unchanged."""
    out = stopped_run(bench, ranks=2)
    folder = newest_checkpoint(out)
    a, b = folder / "rank.00000", folder / "rank.00001"
    one, other = a.read_bytes(), b.read_bytes()
    a.write_bytes(other)
    b.write_bytes(one)
    bench.run("resume", "out", "--end", "0.2", ranks=2).needs(0, "not usable")


def foreign_checkpoints(bench):
    """Another version, byte order or precision, otherwise intact: 6, both named."""
    out = stopped_run(bench)
    for offset, value, words in ((12, 3, ("format 3", "format 2")), (12, 0, ("format 0", "format 2")),
                                 (8, 0x04030201, ("big-endian", "little-endian")), (16, 4, ("4 bytes", "8"))):
        copy = bench.path("copy")
        shutil.copytree(out, copy)
        folder = newest_checkpoint(copy)
        file = folder / "rank.00000"
        data = bytearray(file.read_bytes())
        struct.pack_into("<I", data, offset, value)
        struct.pack_into("<I", data, len(data) - 4, crc32c(data[:-4]))
        file.write_bytes(data)
        recommit(folder)
        bench.run("resume", "copy", "--end", "0.2").needs(6, *words)
        shutil.rmtree(copy)


def other_rank_counts(bench):
    """1 -> 2, 2 -> 1, 2 -> 3 ranks at resume: the same result within the solver's tolerance."""
    bench.simulate(out="whole").needs(0)
    reference = stats(bench.path("whole"))[-1]
    for before, after in ((1, 2), (2, 1), (2, 3)):
        out = f"out{before}{after}"
        bench.simulate("--set", "time.end=0.1", out=out, ranks=before).needs(0)
        bench.run("resume", out, "--end", "0.2", ranks=after).needs(0, f"written by {before} rank")
        last = stats(bench.path(out))[-1]
        for column in ("liquid_volume", "kinetic_energy", "potential_energy"):
            a, b = float(last[column]), float(reference[column])
            # Solves agree to 1e-8 each; differences add up over some twenty steps of a splashing flow.
            expect(abs(a - b) <= 1e-5 * abs(b), f"{before}->{after}: {column} {a} instead of {b}")


def edited_scene(bench):
    """A scene edited between stop and resume: rejected with the keys; numerical settings pass, output with --force."""
    out = stopped_run(bench)
    scene = out / "scene.toml"
    original = scene.read_text()

    def edit(key, pattern, replacement):
        text = re.sub(pattern, replacement, original, count=1, flags=re.M)
        expect(text != original, f"{key}: nothing to edit in\n{original}")
        scene.write_text(text)

    edit("density", r"^(density *= *).*", r"\g<1>900.0")
    bench.run("resume", "out", "--end", "0.2").needs(2, "density")
    bench.run("resume", "out", "--end", "0.2", "--force").needs(2, "density")
    edit("tolerance", r"^(tolerance *= *).*", r"\g<1>1e-9")
    bench.run("resume", "out", "--end", "0.2").needs(0, "solver.tolerance")
    numerical = ["--set", "solver.tolerance=1e-7", "--set", "time.cfl=0.5", "--set", "solver.preconditioner=boomeramg"]
    bench.run("resume", "out", "--end", "0.25", *numerical).needs(0, "solver.preconditioner", "time.cfl")
    expect("cfl = 0.5" in scene.read_text(), "scene.toml does not hold the new cfl")
    output = ["--set", "output.formats=[\"vtk\"]"]
    bench.run("resume", "out", "--end", "0.3", *output, "--set", "liquid.density=900").needs(2, "liquid.density")
    bench.run("resume", "out", "--end", "0.3", *output).needs(2, "output.formats", "--force")
    bench.run("resume", "out", "--end", "0.3", *output, "--force").needs(0)
    edit("broken", r"^\[domain\]", "[domian]")
    bench.run("resume", "out", "--end", "0.3").needs(2)


# --- frames ----------------------------------------------------------------------------------------------------------

ALL_FIELDS = ["--set", 'output.frames=["surface", "velocity", "pressure", "vorticity", "solids"]', "--set",
              'output.formats=["vdb", "vtk"]']
BALL = DAM.replace("dimension = 2", "dimension = 3").replace("[0.0, 0.0]", "[0.0, 0.0, 0.0]")
BALL = BALL.replace("[1.0, 0.5]", "[1.0, 0.5, 0.25]").replace("[0.4, 0.3]", "[0.4, 0.3, 0.25]")
BALL = BALL.replace("[0.1, 0.05]", "[0.1, 0.05, 0.1]").replace('shape = "box"\nlower = [0.6, 0.0]\nupper = [0.7, 0.1]',
                                                             'shape = "sphere"\ncenter = [0.6, 0.1, 0.1]\nradius = 0.08')


def vtk_array(element):
    """A DataArray with base64 numbers: 8 bytes of length, then the numbers."""
    data = base64.b64decode(element.text)
    kind = {"Float32": "<f4", "Float64": "<f8", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}[element.get("type")]
    expect(struct.unpack("<Q", data[:8])[0] == len(data) - 8, f"{element.get('Name')}: wrong length")
    return numpy.frombuffer(data[8:], dtype=kind)


def surface_encloses_the_liquid(frame, volume):
    """`surface` as pyopenvdb meshes it: each edge has a facet on both sides, and the volume within is the liquid's."""
    points, quads = pyopenvdb.read(str(frame), "surface").convertToQuads()
    edges = sorted((q[k], q[(k + 1) % 4]) for q in quads.tolist() for k in range(4))
    expect(edges == sorted((b, a) for a, b in edges), "the surface is open")
    a, b, c, d = (points[quads[:, k]].astype(float) for k in range(4))
    within = abs((a * (numpy.cross(b, c) + numpy.cross(c, d))).sum()) / 6
    expect(abs(within - volume) < 0.04 * volume,  # a point a voxel cuts h^2/4 off 3.8 m of edges, 3.1 %, and corners
           f"{within} m^3 within the surface, {volume} m^3 of liquid")


def frames_open_elsewhere(bench):
    """Every frame, 2D and 3D, with every field: pyopenvdb and vdb_print read it; VTK files hold all announced data."""
    for out, text in (("flat", DAM), ("solid", BALL)):
        bench.simulate("--frames", "2", *ALL_FIELDS, text=text, out=out).needs(0)
        frames_are_good(bench.path(out), 3)
        grids = frame_voxels(bench.path(out) / "frames/frame.0002.vdb")
        expect(set(grids) == {"surface", "free_surface", "vel", "pressure", "vorticity"}, f"grids {sorted(grids)}")
        if shutil.which("vdb_print"):
            for file in frame_files(bench.path(out)):
                said = subprocess.run(["vdb_print", str(file)], capture_output=True, text=True)
                expect(said.returncode == 0 and "surface" in said.stdout, f"vdb_print: {said.stdout}{said.stderr}")
        if out == "solid":
            volume = float(stats(bench.path(out))[-1]["liquid_volume"])
            surface_encloses_the_liquid(bench.path(out) / "frames/frame.0002.vdb", volume)
        image = ElementTree.parse(bench.path(out) / "frames/fluid.0002.vti").getroot()
        cells = grids["surface"].size
        for array in image.iter("DataArray"):
            if array.get("format") == "binary":
                values = vtk_array(array)
                expect(values.size == cells * int(array.get("NumberOfComponents")), f"{array.get('Name')}: {values.size} values")
                expect(numpy.isfinite(values).all(), f"{array.get('Name')} holds values that are not numbers")
        surface = next(a for a in image.iter("DataArray") if a.get("Name") == "surface")
        expect(numpy.array_equal(vtk_array(surface) < 0, (grids["surface"] < 0).flatten(order="F")), ".vti and .vdb disagree")
        mesh = ElementTree.parse(bench.path(out) / "frames/solids.0002.vtu").getroot()
        arrays = {a.get("Name"): vtk_array(a) for a in mesh.iter("DataArray") if a.get("format") == "binary"}
        expect(arrays["offsets"][-1] == arrays["connectivity"].size, "elements and their offsets disagree")
        expect(arrays["connectivity"].max() < arrays["Points"].size // 3, "an element names a point that is not there")
        for series in ("fluid.pvd", "solids.pvd"):
            names = [d.get("file") for d in ElementTree.parse(bench.path(out) / "frames" / series).getroot().iter("DataSet")]
            expect(len(names) == 3 and all((bench.path(out) / "frames" / n).exists() for n in names), f"{series}: {names}")


# --- rigid bodies ----------------------------------------------------------------------------------------------------

POOL = region('shape = "box"\nlower = [0.0, 0.0]\nupper = [1.0, 0.5]')
AIR = region('shape = "sphere"\ncenter = [9.0, 9.0]\nradius = 0.1')
OPEN_SIDE = '[domain.boundary]\nx_upper = { type = "outflow", pressure = 0.0 }\n'


def box(lower, upper):
    return f'shape = "box"\nlower = {list(lower)}\nupper = {list(upper)}'


def ball(center, radius):
    return f'shape = "sphere"\ncenter = {list(center)}\nradius = {radius}'


def rigid(name, shape, density=500.0, extra=""):
    return f'[[solid]]\nname = "{name}"\nkind = "rigid"\ndensity = {density}\n{shape}\n{extra}\n'


def kinematic(name, shape, motion):
    return f'[[solid]]\nname = "{name}"\nkind = "kinematic"\n{shape}\nmotion = {{ translate = {motion} }}\n'


def motion_of(folder, name):
    """Rows of solids.csv of one solid."""
    with open(folder / "solids.csv", newline="") as file:
        return [row for row in csv.DictReader(file) if row["name"] == name]


def rest_of(bench, name="a", out="out"):
    return {key: float(value) for key, value in motion_of(bench.path(out), name)[-1].items() if key != "name"}


def bodies_overlap_at_start(bench):
    """Row 21: two bodies that overlap by 1e-9, by 1e-3 or fully, or touch: 2, both named."""
    first = rigid("first", box((0.2, 0.2), (0.4, 0.4)))
    for other in (box((0.4 - 1e-9, 0.2), (0.6, 0.4)), box((0.4 - 1e-3, 0.25), (0.6, 0.35)), ball((0.3, 0.3), 0.05),
                  box((0.4, 0.2), (0.6, 0.4))):
        bench.simulate(text=box_scene([16, 16], POOL, first + rigid("other", other))).needs(2, "'first' and 'other'", " m")
        expect(not bench.path("out/frames").exists(), "something was run")


def body_overlaps_wall(bench):
    """Row 22: a body partly or fully outside closed walls: 2; it may cross or lie beyond an open side."""
    bench.simulate(text=box_scene([16, 16], POOL, rigid("a", box((-0.1, 0.2), (0.4, 0.4))))).needs(2, "'a' and the side ", "overlap")
    for shape in (box((1.1, 0.2), (1.4, 0.4)), ball((0.5, 1.5), 0.2)):
        bench.simulate(text=box_scene([16, 16], POOL, rigid("a", shape))).needs(2, "'a' lies outside of the domain")
    for shape in (box((0.8, 0.2), (1.2, 0.4)), box((1.1, 0.2), (1.4, 0.4))):
        bench.simulate("--overwrite", text=box_scene([16, 16], POOL, OPEN_SIDE + rigid("a", shape))).needs(0)


def body_far_outside(bench):
    """A body fully outside the domain, or far larger than it, is reported as such; a container is not thin."""
    for corners, text in (("lower = [400.0, 0.2]\nupper = [400.1, 0.3]", "lies outside of the domain: it spans [400, 0.2]"),
                          ("lower = [0.1, 0.1]\nupper = [156.0, 120.0]", "is far larger than the domain")):
        body = f'[[solid]]\nname = "block"\nkind = "rigid"\nshape = "box"\n{corners}\ndensity = 500.0\n'
        bench.simulate(text=box_scene([16, 16], body)).needs(2, "solid 'block' " + text)
    vessel = ('[[solid]]\nname = "vessel"\nkind = "static"\nshape = "box"\nlower = [0.1, 0.1]\nupper = [0.9, 0.9]\n'
              'invert = true\n')
    result = bench.simulate("--frames", "0", text=box_scene([16, 16], vessel), out="vessel").needs(0)
    expect("thinner than a cell" not in result.output + result.errors, "a container is called thin")


def mesh_in_millimetres(bench):
    """`check` and `run` report a static mesh far wider than the domain, with the scale that would fit."""
    corners = [(9, 5, 5), (1, 5, 5), (5, 9, 5), (5, 1, 5), (5, 5, 9), (5, 5, 1)]
    lines = ["v {} {} {}".format(*(20 * x for x in c)) for c in corners]
    lines += [f"f {a} {b} {c}" for a, b, c in ((1, 3, 5), (3, 2, 5), (2, 4, 5), (4, 1, 5), (3, 1, 6), (2, 3, 6), (4, 2, 6), (1, 4, 6))]
    bench.path("wide.obj").write_text("\n".join(lines) + "\n")
    solid = '[[solid]]\nname = "wide"\nkind = "static"\nshape = "mesh"\nfile = "wide.obj"\n'
    scene = bench.scene(box_scene([8, 8, 8], solid))
    for arguments in (("check", scene), ("run", scene, "--out", "out", "--frames", "0")):
        result = bench.run(*arguments).needs(0)
        text = result.output + result.errors
        expect(text.count("'wide' is 160 m wide") == 1, f"{arguments[0]} says: {text}")


def body_leaves_the_domain(bench):
    """Row 23: through an open side, slowly or at 500 m/s: moves on freely, and no longer shortens the steps."""
    for speed in (5.0, 500.0):
        extra = f"velocity = [{speed}, 0.0]\nangular_velocity = 20.0"
        text = box_scene([16, 16], POOL, OPEN_SIDE + rigid("a", box((0.6, 0.7), (0.8, 0.9)), extra=extra), end=0.5)
        bench.simulate("--overwrite", text=text).needs(0)
        last = rest_of(bench)
        # round-off of mass times velocity over the same mass, per step
        expect(abs(last["vx"] / speed - 1) < 1e-12, f"vx is {last['vx']}: nothing acted on it along x")
        expect(abs(last["x"] - 0.7 - 0.5 * speed) < 1e-9 * speed, f"x is {last['x']}")
        expect(len(stats(bench.path("out"))) < 200, f"{len(stats(bench.path('out')))} steps")
        # The sum still contains the momentum of the body.
        mass = 500 * 0.04
        expect(float(stats(bench.path("out"))[-1]["momentum_x"]) > 0.99 * mass * speed - 500, "momentum is lost")
        frames_are_good(bench.path("out"), 11)


def body_thinner_than_a_cell(bench):
    """Row 24: 0.01 to 0.9 cells thick: reported once; liquid on one side of a wall stays there."""
    for share in (0.01, 0.5, 0.9):
        plate = rigid("plate", box((0.2, 0.22), (0.6, 0.22 + share * 0.0625)))
        bench.simulate("--overwrite", text=box_scene([16, 16], POOL, plate)).needs(0)
        log = bench.path("out/log.txt").read_text()
        expect(log.count("thinner than a cell of ") == 1 and "'plate'" in log, f"{share} cells: not told once")
    bench.simulate("--overwrite", text=box_scene([16, 16], POOL, rigid("block", box((0.2, 0.2), (0.4, 0.4))))).needs(0)
    expect("thinner" not in bench.path("out/log.txt").read_text(), "a block of three cells counts as thin")
    for share in (0.01, 0.1, 0.5, 0.9):
        wall = '[[solid]]\nname = "wall"\nkind = "static"\n' + box((0.41, -0.1), (0.41 + share * 0.0625, 1.1)) + "\n"
        water = region('shape = "box"\nlower = [0.0, 0.0]\nupper = [%r, 0.5]' % (0.41 + share * 0.03))
        bench.simulate("--overwrite", text=box_scene([16, 16], water, wall, end=0.5)).needs(0)
        # Liquid that leaked out of the tank would be faster than 1 m/s.
        fastest = max(float(row["max_speed"]) for row in stats(bench.path("out")))
        expect(fastest < 0.2, f"{share} cells: {fastest} m/s")


def body_smaller_than_a_cell(bench):
    """Row 25: a tenth of a cell, in water and in air."""
    for y in (0.3, 0.8):
        text = box_scene([16, 16], POOL, rigid("a", ball((0.3, y), 0.05 * 0.0625)), end=0.3)
        bench.simulate("--overwrite", text=text).needs(0)
        expect(0 < rest_of(bench)["y"] <= y, "it rose")


def too_many_bodies(bench):
    """Row 25: more bodies than the limit: 2, with the limit."""
    many = "".join(rigid(f"b{n}", ball((0.005 * (n % 200), 0.005 * (n // 200)), 0.002)) for n in range(30000))
    bench.simulate(text=box_scene([16, 16], POOL, many)).needs(2, "at most 20000")
    many = "".join(rigid(f"b{n}", ball((0.01 * (n % 100), 0.01 * (n // 100)), 0.004)) for n in range(10000))
    bench.simulate(text=box_scene([16, 16], POOL, many)).needs(2, "at most 1000 can be rigid", ".toml:")


def fast_body_and_thin_wall(bench):
    """Row 26: a body that moves by its length per step or more, against a wall of a twelfth of a cell."""
    wall = '[[solid]]\nname = "wall"\nkind = "static"\n' + box((0.7, 0.0), (0.705, 1.0)) + "\n"
    for speed in (60.0, 2000.0):
        text = box_scene([16, 16], AIR, wall + rigid("a", box((0.2, 0.5), (0.25, 0.55)),
                                                     extra=f"velocity = [{speed}, 0.0]"), end=0.1)
        bench.simulate("--overwrite", text=text).needs(0)
        farthest = max(float(row["x"]) for row in motion_of(bench.path("out"), "a"))
        expect(0.6 < farthest < 0.675, f"got to {farthest}")


def body_squeezed_between_solids(bench):
    """Row 34: a press descends on a body on the floor, first through water: contact takes over; the run ends with 3."""
    press = kinematic("press", box((0.3, 0.8), (0.7, 1.0)), '["0", "-0.5*t"]')
    text = box_scene([16, 16], POOL, press + rigid("a", box((0.35, 0.01), (0.65, 0.2)), 1500.0), end=1.4)
    bench.simulate(text=text).needs(3)
    rows = stats(bench.path("out"))
    expect(float(rows[-1]["time"]) > 1.19, f"stopped at {rows[-1]['time']}: the gap closes at 1.2 s")
    expect("nan" not in bench.path("out/stats.csv").read_text() + bench.path("out/solids.csv").read_text(), "NaN")


def piston_in_a_full_tank(bench):
    """Row 35: a piston moves into a rigid full container with a free body: 3, the piston named."""
    piston = kinematic("piston", box((-0.5, -0.5), (0.1, 1.5)), '["0.1*t", "0"]')
    text = box_scene([16, 16], EVERYWHERE, piston + rigid("a", ball((0.5, 0.5), 0.15), 1500.0))
    bench.simulate(text=text).needs(3, "incompressible container, prescribed volume change 0.1 m^2/s", "'piston'")


def density_ratios(bench):
    """Row 36: 1e-4 to 1e4: buoyancy right, speeds bounded, iterations at most three times those of ratio 1."""
    water = region('shape = "box"\nlower = [0.0, 0.0]\nupper = [2.0, 1.5]')
    most = {}
    for ratio in (1.0, 1e-4, 1e-3, 1e3, 1e4):
        text = box_scene([32, 32], water, rigid("a", ball((1.0, 0.75), 0.25), 1000.0 * ratio), end=0.5)
        bench.simulate("--overwrite", text=text).needs(0)
        rows = stats(bench.path("out"))
        most[ratio] = max(int(row["solver_iterations"]) for row in rows if int(row["contacts"]) == 0)
        expect(most[ratio] <= 3 * most[1.0], f"{most[ratio]} iterations at {ratio}, {most[1.0]} at 1")
        # Upper bound: twice 9.81 m/s^2 for half a second.
        expect(max(float(row["max_speed"]) for row in rows) < 9.81, "too fast")
        # Archimedes, for a neutrally buoyant body.
        first = motion_of(bench.path("out"), "a")[1]
        if ratio == 1.0:
            weight = 1000 * 9.81 * 3.14159265 * 0.0625
            expect(abs(float(first["fy"]) / weight - 1) < 0.02, f"buoyancy {first['fy']} N/m, weight {weight} N/m")


def no_gravity_and_too_much(bench):
    """Row 41: without gravity nothing moves; 1e6 m/s^2 runs with short steps, and a floating body stays in place."""
    floating = rigid("a", ball((0.5, 0.5), 0.15), 500.0)
    for gravity, bound in (("[0.0, 0.0]", 0), ("[0.0, -1e6]", 1e-3)):
        text = box_scene([16, 16], POOL, floating)
        bench.simulate("--overwrite", "--set", f"gravity={gravity}", text=text).needs(0)
        last = rest_of(bench)
        # Half of the disc is below the level, in equilibrium with its density.
        expect(abs(last["y"] - 0.5) <= bound and abs(last["x"] - 0.5) <= bound, f"moved to {last['x']}, {last['y']}")


def gravity_flips(bench):
    """Row 41: gravity that changes its sign each step: each step cancels the motion of the one before."""
    floating = rigid("a", box((0.4, 0.4), (0.6, 0.6)), 500.0)
    # A step takes gravity at its midpoint, where the sine is one or minus one.
    flips = '["0", "9.81*sign(sin(pi*t/0.005))"]'
    text = box_scene([16, 16], POOL, floating, end=0.2).replace("[time]", "[time]\nfixed_step = 0.005")
    bench.simulate("--overwrite", "--set", f"gravity={flips}", text=text).needs(0)
    bench.run("resume", bench.path("out"), "--end", "0.4", "--quiet").needs(0)
    last = rest_of(bench)
    expect(abs(last["x"] - 0.5) < 1e-3 and abs(last["y"] - 0.5) < 0.01, f"moved to {last['x']}, {last['y']}")
    text = box_scene([16, 16], POOL, floating)
    bench.simulate("--overwrite", "--set", 'gravity=["0", "1/t"]', text=text).needs(2, "gravity[1]", "t = 0 s")
    bench.simulate("--overwrite", "--set", 'gravity=["0", "-sqrt(0.03-t)"]', text=text).needs(3, "gravity[1]")


def prescribed_motion_jumps(bench):
    """Row 42: a jump of 0.4 m is reported at load or when it occurs; a fast motion is divided into steps."""
    jump = kinematic("p", box((0.1, 0.1), (0.3, 0.3)), '["t < 0.1 ? 0 : 0.4", "0"]')
    other = rigid("a", ball((0.7, 0.7), 0.1))
    for solids in (jump, jump + other):
        result = bench.simulate("--overwrite", text=box_scene([16, 16], POOL, solids, end=0.4))
        expect(result.code in (2, 3), f"exit code {result.code}")
        result.needs(result.code, "solid")
    fast = kinematic("p", box((0.1, 0.1), (0.3, 0.3)), '["0.4*min(max(t - 0.1, 0)/0.01, 1)", "0"]')
    bench.simulate("--overwrite", text=box_scene([16, 16], POOL, fast + other, end=0.2)).needs(0)


# --- the command line ------------------------------------------------------------------------------------------------

def elastic(shape, material="youngs_modulus = 1e6, poisson_ratio = 0.3", extra="element_size = 0.05"):
    return (f'[[solid]]\nname = "soft"\nkind = "elastic"\ndensity = 1100.0\n{shape}\n'
            f'material = {{ {material} }}\n{extra}\n')


def elastic_out_of_range(bench):
    """Rows 9 and 39: unknown materials and impossible elements: 2 with the reason, on any number of ranks."""
    block = box((0.3, 0.1), (0.5, 0.4))
    pin = 'pinned = { shape = "sphere", center = [0.4, 0.8], radius = 0.1 }'
    for said, solid in {
            "youngs_modulus must be > 0 Pa": elastic(block, "youngs_modulus = 0, poisson_ratio = 0.3"),
            "modulus E / (3 (1 - 2 nu)) is infinite": elastic(block, "youngs_modulus = 1e6, poisson_ratio = 0.5"),
            "poisson_ratio must be below 0.5": elastic(block, "youngs_modulus = 1e6, poisson_ratio = 0.6"),
            "element_size must be > 0 m": elastic(block, extra="element_size = 0"),
            "element_size = 0.5 m is larger than the solid": elastic(block, extra="element_size = 0.5"),
            "would make about": elastic(block, extra="element_size = 1e-5"),
            "nodes; the nearest lies 0.3 m outside": elastic(block, extra="element_size = 0.05\n" + pin)}.items():
        bench.run("check", bench.scene(box_scene([16, 16], POOL, solid))).needs(2, "scene.toml:", said)


def elastic_meshes_at_fault(bench):
    """Row 20: inverted, flat or disconnected elements, or a missing node: 2 with the first ids."""
    corners = ["0.3 0.1 0", "0.5 0.1 0", "0.5 0.4 0", "0.3 0.4 0", "0.8 0.8 0", "0.9 0.8 0", "0.9 0.9 0", "0.4 0.1 0"]

    def mesh(*triangles):
        nodes = "".join(f"{n + 1} {x}\n" for n, x in enumerate(corners))
        cells = "".join(f"{n + 1} 2 2 0 0 {' '.join(map(str, t))}\n" for n, t in enumerate(triangles))
        return (f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(corners)}\n{nodes}$EndNodes\n"
                f"$Elements\n{len(triangles)}\n{cells}$EndElements\n")

    scene = bench.scene(box_scene([16, 16], POOL, elastic('shape = "mesh"\nfile = "body.msh"', extra="")))
    for said, triangles in {"1 elements are inverted: 1": [(1, 2, 3), (1, 4, 3)],
                            "1 elements have no volume: 1": [(1, 2, 3), (1, 8, 2)],
                            "1 elements do not hang together with element 0: 1": [(1, 2, 3), (5, 6, 7)],
                            "there is no node 9": [(1, 2, 3), (1, 3, 9)]}.items():
        bench.path("body.msh").write_text(mesh(*triangles))
        bench.run("check", scene).needs(2, "body.msh", said)


def command_line(bench):
    """Help and version succeed everywhere; mistakes give 2 and one message, on any number of ranks."""
    for verb in ([], ["run"], ["resume"], ["check"]):
        bench.run(*verb, "--help").needs(0)
    bench.run("--version").needs(0, "seiche ")
    scene = bench.scene()
    for mistake in ([], ["sail"], ["run"], ["run", scene, "--frames", "-1"], ["run", scene, "--set", "nonsense"],
                    ["run", scene, "--threads", "0"], ["run", scene, "--inject", "x"], ["run", "none.toml"]):
        bench.run(*mistake).needs(2)
    bench.run("run", "none.toml", ranks=3).needs(2, "none.toml")
    bench.run("check", scene).needs(0, "cells", "memory", "frames")
    bench.run("run", scene, "--quiet", "--frames", "1").needs(0)
    expect(bench.path("out/scene/stats.csv").exists(), "the default folder is not out/<scene name>")


def first_scenes(bench):
    """`init` copies examples with their files, keeps what is there, and names examples that are near."""
    bench.run("init", "--list").needs(0, "dam_break_2d", "floating_boxes_2d")
    bench.run("init", "mine.toml").needs(0, "written: mine.toml", "seiche check mine.toml")
    bench.run("check", "mine.toml").needs(0, "no errors")
    bench.run("init", "mine.toml", "--example", "floating_boxes_2d").needs(2, "mine.toml: is there already")
    bench.run("init", "mine.toml", "--example", "floating_boxes_2d", "--overwrite").needs(0)
    bench.run("init", "x/robot.toml", "--example", "paddling_robot").needs(0, "x/robot.toml", ".urdf")
    bench.run("check", "x/robot.toml").needs(0, "no errors")
    bench.run("init", "y.toml", "--example", "dam_brake_2d").needs(2, "did you mean 'dam_break_2d'?")


def exported_runs(bench):
    """`export` says what is wrong with a folder or a run; what it writes has all frames."""
    bench.simulate("--frames", "2").needs(0)
    bench.run("export", "out", "--format", "ply").needs(2, "is a run in 2D", "--format xdmf")
    bench.run("export", "out", "--format", "xdmf").needs(0, "3 frames")
    bench.run("export", "out").needs(2, "--format")
    bench.run("export", "out", "--format", "stl").needs(2, "stl")
    bench.run("export", ".", "--format", "usd").needs(2, "there are no frames")
    bench.simulate("--frames", "1", text=BALL, out="solid").needs(0)
    for form in ("ply", "obj", "usd"):
        bench.run("export", "solid", "--format", form, "--frames", "0-1", "--up", "z").needs(0, "2 frames")
    names = {file.name for file in bench.path("solid/export").iterdir()}
    expect({"liquid.0001.ply", "liquid.0001.obj", "solid.usda"} <= names, f"{names}")
    bench.run("export", "solid", "--format", "ply", "--frames", "7").needs(2, "7")
    turned = ("--set", 'output.up="z"', "--set", 'output.velocity_name="velocity"')
    bench.simulate("--frames", "1", *turned, text=BALL, out="turned").needs(0)
    expect("velocity" in frame_voxels(bench.path("turned/frames/frame.0001.vdb")), "no grid is named velocity")
    bench.run("export", "turned", "--format", "usd").needs(0)
    expect('upAxis = "Z"' in bench.path("turned/export/turned.usda").read_text(), "z is not up")
    bench.run("export", "turned", "--format", "usd", "--up", "scene").needs(0)
    expect('upAxis = "Y"' in bench.path("turned/export/turned.usda").read_text(), "--up does not overrule the scene")
    bench.run("export", "turned", "--format", "xdmf").needs(0, "keep the scene's axes")
    (bench.path("solid") / "solids.csv").write_text("time,name,x\n")
    bench.run("export", "solid", "--format", "usd").needs(2, "solids.csv", "there is no column")


def misspelt_words(bench):
    """Misspelt verbs and options are reported with the right ones; so is a scene in place of a run's folder."""
    scene = bench.scene()
    bench.run("rn", scene).needs(2, "unknown verb 'rn'; did you mean 'run'?")
    bench.run("sail").needs(2, "unknown verb 'sail'; verbs: run, resume, check")
    bench.run("run", scene, "--thread", "2").needs(2, "unknown option '--thread'; did you mean '--threads'?")
    for option, value in (("--watchdog", "nan"), ("--walltime", "inf")):
        bench.run("run", scene, option, value).needs(2, option, "must be a number of seconds from")
    for value in ("nan", "inf", "1e300"):
        bench.run("resume", "out", "--end", value).needs(2, "--end", "must be a number of seconds from 0 to 1e+15")
    bench.run("run", scene, "--ot=x").needs(2, "unknown option '--ot'; did you mean '--out'?", "seiche run --help")
    bench.run("run", scene, "other.toml").needs(2, "other.toml")
    bench.run("resume", scene).needs(2, "is a file; resume takes the directory of a run, such as out/scene")
    bench.run("run", scene, "--frames", "1").needs(0)
    bench.run("resume", scene).needs(2, "did you mean `seiche resume out/scene`?")


def pictures_and_overwriting(bench):
    """Overwriting removes the pictures, and reports it before and after; a stop reports how to resume."""
    bench.simulate("--frames", "1").needs(0)
    pictures = bench.path("out") / "pictures"
    pictures.mkdir()
    (pictures / "frame.0001.png").write_text("x")
    held = "2 frames to t = 0.05 s, 2 checkpoints, 1 picture; "
    bench.simulate("--frames", "1").needs(2, f"already holds a run ({held}", "give --overwrite to replace it")
    bench.simulate("--frames", "1", "--overwrite", ranks=2).needs(0, f"note: --overwrite removes the run in out: {held}")
    expect(not pictures.exists(), "the pictures are still there")
    bench.path("mine").mkdir()
    (bench.path("mine") / "scene.toml").write_text("# by hand")
    bench.simulate("--overwrite", out="mine").needs(2, "holds scene.toml, but no run of Seiche", "another folder")
    expect((bench.path("mine") / "scene.toml").exists(), "a stranger's scene is gone")
    bench.simulate("--walltime", "0", out="with space").needs(75, "`seiche resume '", "with space'` continues it")


TABLES = {
    "domains": [no_liquid_at_all, liquid_drains_away, no_solids_no_container, full_closed_container,
                full_container_with_moving_solid, inflow_without_outlet, inflow_balanced_to_round_off,
                droplets_and_enclosed_cells, odd_and_thin_grids, scene_is_accounted_for, start_in_numbers, nothing_to_do],
    "formulas": [formula_not_finite_at_start, shape_not_finite, formula_not_finite_later, pinned_step_too_long],
    "ranks": [ranks_share_a_processor, more_ranks_than_cells, more_ranks_than_liquid, many_oversubscribed_ranks, liquid_moves_between_ranks,
              openmp_environment, openmp_differs_between_ranks],
    "output": [output_folder_created, output_is_a_file, output_not_writable, options_without_a_value, existing_output_refused,
               two_jobs_in_one_folder, file_size_limit, full_device, full_disk, few_file_handles],
    "memory": [grid_larger_than_any_machine, address_space_limit, allocation_fails_on_one_rank],
    "stopping": [stop_by_signal, stop_in_the_first_moments, run_folder_removed, stop_by_file_and_walltime, stop_under_mpirun, hung_rank, killed_and_resumed,
                 resume_of_finished_run, resume_keeps_volumes_as_they_were],
    "injection": [exception_in_every_phase, rank_killed, nan_once_in_numerics, energy_beyond_the_budget, nan_that_stays],
    "checkpoints": [damaged_checkpoints, damaged_tables, no_checkpoint_left, extra_file_is_ignored, swapped_rank_files,
                    foreign_checkpoints, other_rank_counts, edited_scene],
    "frames": [frames_open_elsewhere],
    "command_line": [command_line, first_scenes, exported_runs, misspelt_words, pictures_and_overwriting],
    "rigid": [bodies_overlap_at_start, body_overlaps_wall, body_far_outside, mesh_in_millimetres, body_leaves_the_domain, body_thinner_than_a_cell,
              body_smaller_than_a_cell, too_many_bodies, fast_body_and_thin_wall, body_squeezed_between_solids,
              piston_in_a_full_tank, density_ratios, no_gravity_and_too_much, gravity_flips, prescribed_motion_jumps],
    "elastic": [elastic_out_of_range, elastic_meshes_at_fault],
}

if __name__ == "__main__":
    sys.exit(1 if run_table(TABLES, sys.argv[1:]) else 0)
