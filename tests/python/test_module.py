"""Tests of the Python module against the program.

Usage: test_module.py PROGRAM TEST    Exit code 0 if the test passes."""
import csv
import pathlib
import subprocess
import sys
import tempfile

import numpy

import seiche

TANK = """
dimension = 2
[domain]
upper = [1.0, 0.5]
cell_size = 0.03125
[time]
end = 0.2
frame_rate = 10
[[liquid.region]]
shape = "box"
lower = [0.0, 0.0]
upper = [0.4, 0.3]
[[solid]]
name = "box"
kind = "rigid"
density = 300.0
shape = "box"
lower = [0.6, 0.02]
upper = [0.7, 0.12]
[[probe]]
name = "level"
kind = "surface_height"
position = [0.2, 0.1]
"""

ARM = """
dimension = 2
gravity = [0.0, 0.0]
[signals]
wanted = 0.0
[domain]
upper = [1.0, 1.0]
cell_size = 0.0625
[time]
end = 2.0
fixed_step = 0.01
[[solid]]
name = "arm"
kind = "rigid"
density = 500.0
shape = "box"
lower = [0.5, 0.45]
upper = [0.8, 0.55]
[[joint]]
name = "shoulder"
kind = "hinge"
between = ["arm", "world"]
at = [0.5, 0.5]
motor = { target = "wanted", stiffness = 200.0, damping = 20.0, torque = 100.0 }
"""


SPLASH = """
dimension = 2
[domain]
upper = [1.0, 1.0]
cell_size = 0.03125
[time]
end = 0.9
frame_rate = 20
[liquid]
volume = "cells"
[[liquid.region]]
shape = "box"
lower = [0.0, 0.0]
upper = [0.3, 0.7]
[[liquid.region]]
shape = "box"
lower = [0.75, 0.0]
upper = [1.0, 0.6]
"""


def expect(truth, text):
    if not truth:
        raise AssertionError(text)


def refused(call, *words):
    try:
        call()
    except (seiche.Error, KeyError) as error:
        expect(all(word in str(error) for word in words), f"the message is: {error}")
    else:
        raise AssertionError(f"not refused: {words}")


def scenes(_):
    """Scenes are read with overrides of all types, and their faults are told."""
    scene = seiche.Scene.parse(TANK, set={"time.end": 0.5, "title": "a tank", "gravity": [0.0, "-9.81*cos(t)"],
                                          "liquid.separates": True, "output.frames": ["surface"]})
    expect(scene.end == 0.5 and scene.title == "a tank" and scene.dimension == 2, scene.text)
    expect('"-9.81*cos(t)"' in scene.text and "separates = true" in scene.text, scene.text)
    expect(seiche.Scene.parse(scene.text).text == scene.text, "a written scene reads back otherwise")
    expect(numpy.array_equal(scene.upper, [1.0, 0.5, 0.0]) and scene.cell_size == 0.03125, str(scene.upper))
    refused(lambda: seiche.Scene.parse(TANK.replace("upper =", "uper =", 1)), "uper", "did you mean 'upper'?")
    refused(lambda: seiche.Scene.parse(TANK, set={"time.frame_rate": -1}), "time.frame_rate")
    refused(lambda: seiche.Scene.read("/not/there.toml"), "/not/there.toml")
    expect(seiche.materials()["oak"]["density"] == 680, "oak")


def steps(_):
    """Steps go on to a time, a callback may stop them, and refusals leave the simulation as it is."""
    simulation = seiche.Simulation(seiche.Scene.parse(TANK), threads=1)
    expect(simulation.time == 0 and simulation.stats["step"] == 0, "the start")
    simulation.step()
    expect(simulation.step_count == 1 and simulation.stats["time"] == simulation.time > 0, "one step")
    seen = []
    count = simulation.run(0.1, lambda s: seen.append(s.time))
    expect(seen[-1] == 0.1 and count == len(seen) == simulation.step_count - 1, f"{seen}")
    simulation.run(callback=lambda s: s.time < 0.15)
    expect(0.15 <= simulation.time < 0.2, f"stopped at {simulation.time}")
    refused(lambda: simulation.step(0.1), "later")
    box = simulation.solids["box"]
    expect(box["position"].shape == (3,) and abs(box["orientation"][0]) <= 1, f"{box}")
    expect(0.1 < simulation.probe("level") < 0.35, "level")
    refused(lambda: simulation.probe("levle"), "levle")
    refused(lambda: simulation.solid_mesh("x"), "x")
    raised = False
    try:
        simulation.run(callback=lambda s: 1 / 0)
    except ZeroDivisionError:
        raised = True
    expect(raised, "an exception of the callback is lost")


def fields(_):
    """Arrays are the simulation's own memory; they keep the values of their moment when steps go on."""
    simulation = seiche.Simulation(seiche.Scene.parse(TANK), threads=1)
    simulation.step()
    first, again = simulation.field("surface"), simulation.field("surface")
    address = first.__array_interface__["data"][0]
    expect(address == again.__array_interface__["data"][0] and first.base is not None, "the field is a copy")
    expect(first.shape == (32, 16) and not first.flags.writeable, f"{first.shape}")
    expect(first[0, 0] < 0 < first[-1, -1], "signs")
    velocity = simulation.field("velocity_x")
    expect(velocity.shape == (33, 16), f"{velocity.shape}")
    kept, kept_velocity = first.copy(), velocity.copy()
    simulation.run(0.1)
    expect(numpy.array_equal(first, kept) and numpy.array_equal(velocity, kept_velocity), "a field changed afterwards")
    later = simulation.field("surface")
    expect(not numpy.array_equal(later, kept), "the new field is the old one")
    area = numpy.clip(0.5 - later / 0.03125, 0, 1).sum() * 0.03125 ** 2
    expect(abs(area - 0.12) < 0.01, f"liquid of {area} m^2")
    last = later.copy()
    del simulation
    other = seiche.Simulation(seiche.Scene.parse(TANK), threads=1)   # takes memory that was given back
    other.run(0.05)
    expect(numpy.array_equal(later, last) and numpy.array_equal(first, kept), "a field did not outlive its simulation")
    refused(lambda: seiche.Simulation(seiche.Scene.parse(TANK)).field("surfce"), "surfce", "pressure")


def meshes(program):
    """Frames and the liquid's mesh, against what the program's tables say."""
    text = TANK.replace("dimension = 2", "dimension = 3").replace("0.5]", "0.5, 0.25]").replace("[0.0, 0.0]", "[0.0, 0.0, 0.0]")
    text = text.replace("[0.4, 0.3]", "[0.4, 0.3, 0.25]").replace("[0.6, 0.02]", "[0.6, 0.02, 0.1]")
    text = text.replace("[0.7, 0.12]", "[0.7, 0.12, 0.2]").replace("[0.2, 0.1]", "[0.2, 0.1, 0.1]")
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "tank.toml"
        scene.write_text(text)
        subprocess.run([program, "run", scene, "--out", f"{folder}/out", "--quiet", "--threads", "1"], check=True)
        frame = f"{folder}/out/frames/frame.0002.vdb"
        read = seiche.read_frame(frame)
        expect(read["grids"]["surface"].shape == (32, 16, 8) and read["grids"]["vel"].shape == (32, 16, 8, 3), "shapes")
        expect(abs(read["time"] - 0.2) < 1e-12 and read["cell_size"] == 0.03125, f"{read['time']}")
        points, triangles, velocity = seiche.liquid_mesh(frame)
        expect(velocity.shape == points.shape and points[:, 0].min() == 0.0, "the mesh does not reach the wall")
        a, b, c = (points[triangles[:, k]] for k in range(3))
        volume = (a * numpy.cross(b, c)).sum() / 6
        with open(f"{folder}/out/stats.csv", newline="") as file:
            exact = float(list(csv.DictReader(file))[-1]["liquid_volume"])
        expect(abs(volume - exact) < 0.02 * exact, f"{volume} m^3 within the mesh, {exact} m^3 of liquid")


def drops(program):
    """Drops of a frame have the volume that the program's table says."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "splash.toml"
        scene.write_text(SPLASH)
        subprocess.run([program, "run", scene, "--out", f"{folder}/out", "--quiet", "--threads", "1"], check=True)
        with open(f"{folder}/out/stats.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file)]
        most = 0
        for n in range(19):
            frame = seiche.read_frame(f"{folder}/out/frames/frame.{n:04d}.vdb")
            row = min(rows, key=lambda r: abs(float(r["time"]) - frame["time"]))
            found = frame["drops"]
            volume = numpy.pi * (found["radius"] ** 2).sum()
            expect(len(found["id"]) == int(row["drops"]), f"frame {n} has {len(found['id'])} drops")
            expect(abs(volume - float(row["volume_drops"])) < 1e-5 * volume + 1e-12, f"{volume} m^2 in drops")   # float
            expect(numpy.isfinite(found["velocity"]).all() and found["place"].shape == found["velocity"].shape, "velocity")
            most = max(most, len(found["id"]))
        expect(most > 2, f"at most {most} drops")


def signals(_):
    """A motor follows a signal; what signals may not do is refused."""
    simulation = seiche.Simulation(seiche.Scene.parse(ARM), threads=1)
    simulation.run(0.3)
    expect(abs(simulation.joints["shoulder"]["q"]) < 1e-9, "the arm moved by itself")
    simulation.set_signal("wanted", 30.0)
    simulation.run(2.0)
    angle = numpy.degrees(simulation.joints["shoulder"]["q"])
    expect(abs(angle - 30) < 0.1, f"the arm is at {angle} degrees")
    refused(lambda: simulation.set_signal("wnted", 1.0), "wnted")
    moved = ARM.replace('kind = "rigid"\ndensity = 500.0', 'kind = "kinematic"\nmotion = { translate = ["wanted", 0.0] }')
    refused(lambda: seiche.Scene.parse(moved[:moved.index("[[joint]]")]), "uses the signal wanted, which jumps")
    refused(lambda: seiche.Scene.parse(ARM.replace("density = 500.0", 'density = "wanted"')), "only formulas in t")
    refused(lambda: seiche.Scene.parse(ARM.replace("wanted = 0.0", "sin = 0.0")), "signals.sin")
    refused(lambda: seiche.Scene.parse(ARM.replace("[signals]\nwanted = 0.0\n", "")), "wanted")


def equality(program):
    """The module takes the program's steps, to the last bit."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "tank.toml"
        scene.write_text(TANK.replace("frame_rate = 10", "frame_rate = 5"))
        subprocess.run([program, "run", scene, "--out", f"{folder}/out", "--quiet", "--threads", "1"], check=True)
        with open(f"{folder}/out/stats.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        simulation = seiche.Simulation(seiche.Scene.read(scene), threads=1)
        simulation.run(0.2)
        mine = simulation.stats
        differing = [k for k, v in rows[-1].items() if k != "wall_seconds" and float(v) != mine[k]]
        expect(not differing and len(mine) == len(rows[-1]), f"they differ in {differing}")


def ranks(_):
    """Two ranks share the domain; each sees its block, and both the same tables."""
    expect(seiche.rank_count() == 2, f"{seiche.rank_count()} ranks")
    simulation = seiche.Simulation(seiche.Scene.parse(TANK), threads=1)
    simulation.run(0.05)
    shape = simulation.field("surface").shape
    expect(shape[1] == 16 and 0 < shape[0] < 32, f"rank {seiche.rank()} has {shape}")   # shared by work
    expect(simulation.stats["cells_liquid"] > 100, "stats")


if __name__ == "__main__":
    globals()[sys.argv[2]](sys.argv[1])
