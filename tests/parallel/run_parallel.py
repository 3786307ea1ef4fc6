#!/usr/bin/python3
"""The same scene on different numbers of ranks, and runs that are killed at random moments and resumed.

Usage: run_parallel.py PROGRAM GROUP [CASE ...]"""
import contextlib
import json
import os
import pathlib
import random
import signal
import sys
import time

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "faults"))
from harness import (DAM, expect, frame_files, frame_voxels, frames_are_good, rank_processes,  # noqa: E402
                     run_table, same_frames, same_tables, stats, table)

TOLERANCE = 1e-10   # of each solve
# Twenty steps, each of which may amplify the difference between two solves: a factor of 1e3.
AFTER_TWENTY_STEPS = 1e-7

TWENTY_STEPS = DAM.replace("end = 0.2", "end = 0.1\nfixed_step = 0.005").replace("frame_rate = 20.0", "frame_rate = 10.0")
TWENTY_STEPS += f'formats = ["vdb"]\nframes = ["surface", "velocity", "pressure"]\n[solver]\ntolerance = {TOLERANCE}\n'

# Twenty steps of an eighth of h^2/nu, so that all that acts beside no-slip walls before the solve counts.
STREAM = f"""\
dimension = 2
gravity = [0.0, -9.81]
[domain]
lower = [0.0, 0.0]
upper = [1.2, 0.5]
cell_size = 0.02
[domain.boundary]
x_lower = {{ type = "inflow", velocity = ["0.6", "0.0"] }}
x_upper = "outflow"
[time]
end = 0.1
frame_rate = 10.0
fixed_step = 0.005
[liquid]
density = 1000.0
viscosity = 10.0
[[liquid.region]]
shape = "expression"
phi = "-1"
[[solid]]
name = "rest"
shape = "sphere"
center = [0.31, 0.27]
radius = 0.07
slip = "no_slip"
[[solid]]
name = "turns"
kind = "kinematic"
shape = "sphere"
center = [0.61, 0.22]
radius = 0.06
slip = "no_slip"
motion = {{ rotate = {{ center = [0.61, 0.22], degrees = "300*t" }} }}
[[solid]]
name = "sinks"
kind = "rigid"
shape = "sphere"
center = [0.9, 0.33]
radius = 0.06
density = 1500.0
slip = "no_slip"
[output]
formats = ["vdb"]
frames = ["velocity", "pressure"]
[solver]
tolerance = {TOLERANCE}
"""

SPLASH = f"""\
dimension = 3
[domain]
lower = [0.0, 0.0, 0.0]
upper = [1.0, 0.75, 0.6875]
cell_size = 0.0625
[time]
end = 0.2
frame_rate = 5.0
fixed_step = 0.01
[liquid]
density = 1000.0
viscosity = 0.0
[[liquid.region]]
shape = "box"
lower = [0.0, 0.0, 0.0]
upper = [0.5, 0.4, 0.6875]
[[liquid.region]]
shape = "sphere"
center = [0.7, 0.5, 0.35]
radius = 0.12
[[solid]]
name = "paddle"
kind = "kinematic"
shape = "sphere"
center = [0.6, 0.2, 0.3]
radius = 0.12
motion = {{ translate = ["0.1*sin(6*t)", "0", "0"] }}
[[probe]]
name = "h"
kind = "surface_height"
position = [0.2, 0.0, 0.3]
[output]
frames = ["surface", "velocity"]
[solver]
tolerance = {TOLERANCE}
"""

def rigid(name, shape, density):
    return f'[[solid]]\nname = "{name}"\nkind = "rigid"\ndensity = {density}\nfriction = 0.3\n{shape}\n'


# Two stacked boxes, which the water of the dam reaches, and a floating ball; all within one solve.
BOXES = TWENTY_STEPS + rigid("lower", 'shape = "box"\nlower = [0.44, 0.002]\nupper = [0.56, 0.09]', 1200.0)
BOXES += rigid("upper", 'shape = "box"\nlower = [0.45, 0.092]\nupper = [0.55, 0.17]', 300.0)
BOXES += rigid("ball", 'shape = "sphere"\ncenter = [0.2, 0.3]\nradius = 0.07', 300.0)

# Two arms on a driven and a sprung hinge, with a stop, and a box on a strut with a motor, in the way of the water.
LINKS = TWENTY_STEPS.replace("fixed_step = 0.005", "fixed_step = 0.004")
LINKS += rigid("arm", 'shape = "box"\nlower = [0.2, 0.2]\nupper = [0.26, 0.36]', 700.0)
LINKS += rigid("hand", 'shape = "box"\nlower = [0.2, 0.06]\nupper = [0.26, 0.21]', 400.0)
LINKS += rigid("box", 'shape = "box"\nlower = [0.44, 0.05]\nupper = [0.56, 0.14]', 900.0)
LINKS += """
[[joint]]
name = "shoulder"
kind = "hinge"
between = ["arm", "world"]
at = [0.23, 0.36]
drive = { degrees = "20*sin(9*t)" }
[[joint]]
name = "elbow"
kind = "hinge"
between = ["hand", "arm"]
at = [0.23, 0.205]
limits = [-10, 20]
spring = { stiffness = 3, damping = 0.05 }
[[joint]]
name = "strut"
kind = "distance"
between = ["box", "hand"]
at = [0.44, 0.1]
to = [0.26, 0.1]
motor = { speed = 0.1, force = 20 }
breaks_at = { force = 1e4 }
"""

TUMBLE = SPLASH + rigid("box", 'shape = "box"\nlower = [0.15, 0.003, 0.2]\nupper = [0.4, 0.25, 0.45]', 1500.0)
TUMBLE += rigid("rider", 'shape = "box"\nlower = [0.2, 0.253, 0.22]\nupper = [0.35, 0.45, 0.4]', 300.0)
TUMBLE += rigid("ball", 'shape = "sphere"\ncenter = [0.8, 0.12, 0.35]\nradius = 0.1', 700.0)

def elastic(name, shape, keys):
    return (f'[[solid]]\nname = "{name}"\nkind = "elastic"\ndensity = 1100.0\nfriction = 0.3\n{shape}\n{keys}\n'
            'material = { youngs_modulus = 1.0e5, poisson_ratio = 0.4 }\n')


# A gate that the dam bends, with a soft box and a rigid ball beside it.
SOFT = TWENTY_STEPS + elastic("gate", 'shape = "box"\nlower = [0.41, 0.0]\nupper = [0.48, 0.25]',
                              'element_size = 0.04\npinned = { shape = "box", lower = [0.4, -0.1], upper = [0.5, 0.0] }')
SOFT += elastic("lump", 'shape = "box"\nlower = [0.76, 0.002]\nupper = [0.9, 0.1]', "element_size = 0.06")
SOFT += rigid("ball", 'shape = "sphere"\ncenter = [0.2, 0.3]\nradius = 0.07', 300.0)

# The same with a gate of a seventh of a cell.
SHEET = SOFT.replace("lower = [0.41, 0.0]\nupper = [0.48, 0.25]", "lower = [0.41, 0.0]\nupper = [0.4145, 0.25]")

SOFT_3D = SPLASH.replace("end = 0.2", "end = 0.1").replace("frame_rate = 5.0", "frame_rate = 10.0")
SOFT_3D += elastic("lump", 'shape = "box"\nlower = [0.2, 0.003, 0.2]\nupper = [0.42, 0.25, 0.45]',
                   "element_size = 0.125")
SOFT_3D += rigid("ball", 'shape = "sphere"\ncenter = [0.8, 0.12, 0.35]\nradius = 0.1', 700.0)


# A ball on a spring in the water of the dam.
SPRUNG = TWENTY_STEPS + """\
[[solid]]
name = "ball"
kind = "sprung"
density = 500.0
shape = "sphere"
center = [0.2, 0.3]
radius = 0.07
velocity = [0.2, 0.1]
spring_stiffness = 2000.0
spring_damping = 1.0
"""


# A ball that bounces off the floor in the water of the dam, and off a second one that falls onto it. A third one hits the
# wall as the tenth step ends.
BOUNCE = TWENTY_STEPS + rigid("ball", 'shape = "sphere"\ncenter = [0.2, 0.09]\nradius = 0.07\nvelocity = [0.0, -1.0]', 900.0)
BOUNCE += rigid("pebble", 'shape = "sphere"\ncenter = [0.2, 0.37]\nradius = 0.05\nvelocity = [0.1, -1.5]', 2500.0)
BOUNCE += rigid("shot", 'shape = "sphere"\ncenter = [0.865, 0.35]\nradius = 0.04\nvelocity = [2.0, 0.0]', 2500.0)
BOUNCE += """\
[[contact]]
between = ["ball", "pebble"]
restitution = 0.8
[[contact]]
between = ["*", "domain"]
restitution = 0.9
"""

# A diamond that beats in the splash, in place of the ball; a rigid ball lies in its way.
BEATING = (SPLASH.replace("end = 0.2", "end = 0.1").replace("frame_rate = 5.0", "frame_rate = 10.0")
           .replace('kind = "kinematic"\nshape = "sphere"\ncenter = [0.6, 0.2, 0.3]\nradius = 0.12\n',
                    'kind = "deforming"\nshape = "mesh"\nfile = "beat.0.obj"\nsequence = { meshes = 4, rate = 10.0, loop = true }\n')
           .replace('motion = { translate = ["0.1*sin(6*t)", "0", "0"] }\n', ""))
BEATING += rigid("ball", 'shape = "sphere"\ncenter = [0.86, 0.2, 0.3]\nradius = 0.1', 700.0)


def write_beats(folder):
    """Octahedra whose first axis grows and shrinks."""
    corners = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(a, b, c) if (a + b + c) % 2 == 0 else (a, c, b) for a in (1, 2) for b in (3, 4) for c in (5, 6)]
    for n, size in enumerate((0.12, 0.14, 0.15, 0.13)):
        rows = [f"v {0.6 + size * x} {0.2 + 0.14 * y} {0.3 + 0.14 * z}" for x, y, z in corners]
        rows += ["f {} {} {}".format(*face) for face in faces]
        (folder / f"beat.{n}.obj").write_text("\n".join(rows) + "\n")


def write_outlines(folder):
    """Diamonds whose first axis grows and shrinks."""
    for n, size in enumerate((0.12, 0.14, 0.15, 0.13)):
        rows = [f"{0.4 + size * x}, {0.2 + 0.14 * y}" for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
        (folder / f"beat.{n}.csv").write_text("\n".join(rows) + "\n")


def viscous(text, viscosity):
    return text.replace("viscosity = 0.0", f"viscosity = {viscosity}").replace("friction =", 'slip = "no_slip"\nfriction =')


# The same with gas and surface tension. Pressure residuals move the gas 800 times as much as the liquid, and gas is
# fast where bodies meet.
def gassy(text):
    text = viscous(text, 0.1).replace("density = 1000.0", "density = 1000.0\nsurface_tension = 0.07", 1)
    text = text.replace(f"tolerance = {TOLERANCE}", "tolerance = 1e-12")
    return text + "[gas]\ndensity = 1.2\nviscosity = 1e-4\n"


# The same with enclosed air under a lid.
def airy(text):
    return text + '[gas]\nbubbles = "volume_conserving"\n'


# A disc deformed by a prescribed flow.
SWIRL = TWENTY_STEPS[:TWENTY_STEPS.index("[liquid]")].replace("fixed_step = 0.005", "") + """\
[liquid]
prescribed_velocity = ["sin(pi*x)^2*sin(2*pi*y)*cos(3*t)", "-sin(pi*y)^2*sin(2*pi*x)*cos(3*t)"]
[[liquid.region]]
shape = "sphere"
center = [0.52, 0.3]
radius = 0.15
[output]
checkpoint_every = 1
"""

# A column of liquid without solids, whose volumes are carried in cells.
DAM_IN_CELLS = f"""\
dimension = 2
[domain]
lower = [0.0, 0.0]
upper = [1.0, 0.8]
cell_size = 0.04
[time]
end = 0.2
frame_rate = 5.0
fixed_step = 0.01
[liquid]
volume = "cells"
[[liquid.region]]
shape = "box"
lower = [0.0, 0.0]
upper = [0.38, 0.5]
[output]
formats = ["vdb"]
frames = ["surface", "velocity", "pressure"]
[solver]
tolerance = {TOLERANCE}
"""
DAM_IN_CELLS_3D = (DAM_IN_CELLS.replace("dimension = 2", "dimension = 3").replace("[0.0, 0.0]", "[0.0, 0.0, 0.0]")
                   .replace("[1.0, 0.8]", "[1.0, 0.8, 0.65]").replace("[0.38, 0.5]", "[0.38, 0.5, 0.42]")
                   .replace("cell_size = 0.04", "cell_size = 0.05"))

# Balls of little more than a cell, thrown into each other, a pool, a post and out of an open side: they fly as drops.
def spray(dimension):
    x = "sqrt((x-{})^2+(y-{})^2{})-0.03"
    at = [(0.1 + 0.16 * n, 0.42 + 0.08 * (n % 4)) for n in range(6)]
    balls = [x.format(f"{a:.2f}", f"{b:.2f}", "" if dimension == 2 else f"+(z-{0.1 + 0.12 * (n % 4):.2f})^2")
             for n, (a, b) in enumerate(at)]
    phi = "y-0.17"
    for ball in balls:
        phi = f"min({phi}, {ball})"
    text = DAM_IN_CELLS if dimension == 2 else DAM_IN_CELLS_3D
    start, end = text.index("[[liquid.region]]"), text.index("[output]")
    text = text[:start] + f"""\
velocity = ["y > 0.25 ? 2*sin(9*x) : 0", "y > 0.25 ? -1.5 : 0"{', "y > 0.25 ? 0.5 : 0"' if dimension == 3 else ''}]
[[liquid.region]]
shape = "expression"
phi = "{phi}"
[[solid]]
name = "post"
kind = "static"
shape = "sphere"
center = [0.5, 0.25{', 0.3' if dimension == 3 else ''}]
radius = 0.12
""" + text[end:]
    return text.replace("[time]", '[domain.boundary]\nx_upper = "outflow"\n[time]').replace("cell_size = 0.05", "cell_size = 0.04").replace(
        "0.65]", "0.64]")


GAS_IN_CELLS = DAM_IN_CELLS + "[gas]\ndensity = 1.2\n"
BUBBLE_IN_CELLS = DAM_IN_CELLS.replace(
    'shape = "box"\nlower = [0.0, 0.0]\nupper = [0.38, 0.5]',
    'shape = "expression"\nphi = "max(0.14-sqrt((x-0.42)^2+(y-0.25)^2), y-0.5)"') + '[gas]\nbubbles = "volume_conserving"\n'
PARTING_IN_CELLS = (DAM_IN_CELLS.replace("dimension = 2", "dimension = 2\ngravity = [6.0, 9.81]")
                    .replace("[liquid]\n", "[liquid]\nseparates = true\n"))

# A stream that sets off at once below a surface off the faces, and liquid that parts beside a paddle: cells of the
# surface among full ones, whose planes rounding chose.
SET_OFF_IN_CELLS = f"""\
dimension = 2
[domain]
lower = [0.0, 0.0]
upper = [1.4, 0.7]
cell_size = 0.05
[domain.boundary]
x_lower = {{ type = "inflow", velocity = ["y < 0.33 ? 1.0 : 0", "0"] }}
x_upper = "outflow"
[time]
end = 0.2
frame_rate = 5.0
[liquid]
volume = "cells"
[[liquid.region]]
shape = "box"
lower = [0.0, 0.0]
upper = [1.4, 0.33]
[solver]
tolerance = {TOLERANCE}
"""
PARTING_BESIDE_PADDLE = f"""\
dimension = 2
[domain]
lower = [0.0, 0.0]
upper = [1.0, 0.76]
cell_size = 0.04
[time]
end = 0.2
frame_rate = 5.0
[liquid]
volume = "cells"
separates = true
[[liquid.region]]
shape = "box"
lower = [0.0, 0.0]
upper = [0.3, 0.5]
[[liquid.region]]
shape = "box"
lower = [0.0, 0.0]
upper = [1.0, 0.2]
[[solid]]
name = "paddle"
kind = "kinematic"
shape = "box"
lower = [-0.2, -0.1]
upper = [0.06, 0.8]
motion = {{ translate = ["0.12*sin(12*t)", "0"] }}
[solver]
tolerance = {TOLERANCE}
""" + rigid("box", 'shape = "box"\nlower = [0.5, 0.2]\nupper = [0.7, 0.35]', 300.0)

# Outlines in 2D that beat beside a rigid ball in the flood.
BEATING_2D = (DAM_IN_CELLS.replace("end = 0.2", "end = 0.1").replace("frame_rate = 5.0", "frame_rate = 10.0")
              .replace("fixed_step = 0.01", "fixed_step = 0.005").replace("upper = [0.38, 0.5]", "upper = [0.7, 0.5]")
              + '[[solid]]\nkind = "deforming"\nshape = "mesh"\nfile = "beat.0.csv"\n'
              + "sequence = { meshes = 4, rate = 10.0, loop = true }\n"
              + rigid("ball", 'shape = "sphere"\ncenter = [0.66, 0.2]\nradius = 0.1', 700.0))

POST_IN_CELLS = DAM_IN_CELLS.replace("fixed_step = 0.01", "fixed_step = 0.005") + """\
[[solid]]
name = "post"
kind = "static"
shape = "sphere"
center = [0.52, 0.1]
radius = 0.12
"""

# A jet and a source, whose volumes are carried in cells, above an open bottom.
POURED_IN_CELLS = (DAM_IN_CELLS.replace("[time]", """\
[domain.boundary]
x_lower = { type = "inflow", velocity = ["y > 0.4 && y < 0.64 ? 1.5 : 0", "y > 0.4 && y < 0.64 ? 0.5 : 0"] }
y_lower = "outflow"
[time]""").replace("fixed_step = 0.01", "fixed_step = 0.005").replace("[output]", """\
[[liquid.source]]
shape = "sphere"
center = [0.72, 0.6]
radius = 0.09
velocity = [-0.5, -1.0]
from = 0.03
[output]"""))

# A basin with a spring and a pump below the surface, with rates that change, and a source above it, which brings
# nothing.
FED = f"""\
dimension = 2
[domain]
lower = [0.0, 0.0]
upper = [1.0, 0.8]
cell_size = 0.04
[time]
end = 0.1
fixed_step = 0.005
frame_rate = 10.0
[[liquid.region]]
shape = "box"
lower = [0.0, 0.0]
upper = [1.0, 0.42]
[[liquid.source]]
shape = "sphere"
center = [0.47, 0.2]
radius = 0.13
rate = "0.3*(1+5*t)"
[[liquid.drain]]
shape = "box"
lower = [0.7, 0.02]
upper = [0.93, 0.21]
rate = 0.1
from = 0.0275
[[liquid.source]]
shape = "sphere"
center = [0.2, 0.65]
radius = 0.08
rate = 0.1
[output]
formats = ["vdb"]
checkpoint_every = 1
frames = ["surface", "velocity", "pressure"]
[solver]
tolerance = {TOLERANCE}
"""
FED_3D = (FED.replace("dimension = 2", "dimension = 3").replace("[0.0, 0.0]", "[0.0, 0.0, 0.0]")
          .replace("[1.0, 0.8]", "[1.0, 0.8, 0.6]").replace("[1.0, 0.42]", "[1.0, 0.42, 0.6]")
          .replace("[0.47, 0.2]", "[0.47, 0.2, 0.3]").replace("[0.2, 0.65]", "[0.2, 0.65, 0.3]")
          .replace("[0.7, 0.02]", "[0.7, 0.02, 0.1]").replace("[0.93, 0.21]", "[0.93, 0.21, 0.4]")
          .replace("cell_size = 0.04", "cell_size = 0.05").replace("0.3*(1+5*t)", "0.1*(1+5*t)"))

# Waves enter on the left, meet a post, and leave on the right.
SEA = f"""\
dimension = 2
[domain]
lower = [0.0, 0.0]
upper = [2.0, 0.8]
cell_size = 0.05
[domain.boundary]
x_lower = {{ type = "waves", waves = {{ depth = 0.5, height = 0.08, period = 0.9, ramp = 0.0, theory = "nonlinear" }} }}
x_upper = {{ type = "waves", waves = {{ depth = 0.5, height = 0.0, period = 0.9 }} }}
[time]
end = 0.1
fixed_step = 0.005
frame_rate = 10.0
[[liquid.region]]
shape = "box"
lower = [0.0, 0.0]
upper = [2.0, 0.5]
[[solid]]
name = "post"
shape = "sphere"
center = [1.02, 0.3]
radius = 0.12
[output]
formats = ["vdb"]
checkpoint_every = 1
frames = ["surface", "velocity", "pressure"]
[solver]
tolerance = {TOLERANCE}
"""
# The same from the side in 3D, aslant.
SEA_3D = (SEA.replace("dimension = 2", "dimension = 3").replace("[0.0, 0.0]", "[0.0, 0.0, 0.0]")
          .replace("[2.0, 0.8]", "[2.0, 0.8, 0.6]").replace("[2.0, 0.5]", "[2.0, 0.5, 0.6]")
          .replace("[1.02, 0.3]", "[1.02, 0.3, 0.25]").replace('"nonlinear"', '"stokes", direction = [1.0, 0.0, 0.4]')
          .replace('x_upper = {', 'z_upper = { type = "waves", waves = { depth = 0.5, height = 0.0, period = 0.9 } }\n'
                   'x_upper = {').replace("cell_size = 0.05", "cell_size = 0.1"))

# A slanted jet with its upper rim between one and two halo widths beyond the cells of the lowest of three ranks.
JET = f"""\
dimension = 2
[domain]
lower = [0.0, 0.0]
upper = [0.4, 1.2]
cell_size = 0.025
[domain.boundary]
x_lower = {{ type = "inflow", velocity = ["(y > 0.2 && y < 0.5) ? 2 : 0", "(y > 0.2 && y < 0.5) ? 1.9 : 0"] }}
x_upper = {{ type = "outflow", pressure = 0.0 }}
y_lower = {{ type = "outflow", pressure = 0.0 }}
[time]
end = 0.1
fixed_step = 0.005
frame_rate = 10.0
[liquid]
density = 1000.0
viscosity = 0.0
[solver]
tolerance = {TOLERANCE}
[output]
frames = ["surface", "velocity"]
"""

# Pressure and viscosity in one solve, with bodies dragged along; mud with a yield stress.
THICK = viscous(SOFT, 20.0)
MUD = TWENTY_STEPS.replace("viscosity = 0.0",
                           'rheology = { model = "bingham", viscosity = 5.0, yield_stress = 40.0, regularisation = 0.5 }')
THICK_3D = viscous(TUMBLE, 50.0).replace("end = 0.2", "end = 0.1").replace("frame_rate = 5.0", "frame_rate = 10.0")

COMPARED = ("time", "liquid_volume", "kinetic_energy", "potential_energy", "momentum_x", "momentum_y", "momentum_z",
            "max_speed")


def largest(rows, column):
    return max(abs(float(row[column])) for row in rows)


def scale_of(rows, column):
    """Scale of differences in this column; momenta share the largest of the three."""
    if column.startswith("momentum"):
        return max(largest(rows, f"momentum_{axis}") for axis in "xyz")
    return largest(rows, column)


def same_to_tolerance(one, other, what):
    a, b = stats(one), stats(other)
    expect(len(a) == len(b), f"{what}: {len(b)} rows, not {len(a)}")
    for column in COMPARED:
        bound = AFTER_TWENTY_STEPS * scale_of(a, column)
        worst = max(abs(float(x[column]) - float(y[column])) for x, y in zip(a, b))
        expect(worst <= bound, f"{what}: {column} differs by {worst}, bound {bound}")
    for file in frame_files(one):
        voxels, others = frame_voxels(file), frame_voxels(pathlib.Path(other) / "frames" / file.name)
        for name, array in voxels.items():
            worst, top = numpy.abs(array - others[name]).max(), numpy.abs(array).max()
            # Frames add the round-off of single precision.
            expect(worst <= (AFTER_TWENTY_STEPS + 2e-7) * top, f"{what}, {file.name}: {name} differs by {worst} of {top}")


def pins_agree(one, other, what):
    """Forces and moments of the pins in solids.csv."""
    a, b = table(one, "solids.csv"), table(other, "solids.csv")
    for columns in (("pin_fx", "pin_fy", "pin_fz"), ("pin_tx", "pin_ty", "pin_tz")):
        top = max(largest(a, column) for column in columns)
        for column in columns:
            worst = max(abs(float(x[column]) - float(y[column])) for x, y in zip(a, b, strict=True))
            expect(worst <= AFTER_TWENTY_STEPS * top, f"{what}: {column} differs by {worst} of {top}")


def ranks_agree(bench, text, counts=(2, 3, 4)):
    bench.simulate(text=text, out="one").needs(0)
    frames_are_good(bench.path("one"), 2)
    for ranks in counts:
        out = f"ranks{ranks}"
        bench.simulate(text=text, out=out, ranks=ranks).needs(0)
        same_to_tolerance(bench.path("one"), bench.path(out), f"{ranks} ranks")
        if "[[solid]]" in text:
            pins_agree(bench.path("one"), bench.path(out), f"{ranks} ranks")


def ranks_agree_2d(bench):
    """A dam break over a step on 1, 2, 3, 4 ranks."""
    ranks_agree(bench, TWENTY_STEPS)


def ranks_agree_3d(bench):
    """A splash around a moving sphere on 1, 2, 3, 4 ranks."""
    ranks_agree(bench, SPLASH)


def rigid_ranks_agree_2d(bench):
    """Boxes in contact and a floating ball on 1, 3 and 4 ranks."""
    ranks_agree(bench, BOXES, (3, 4))
    expect(max(int(row["contacts"]) for row in stats(bench.path("one"))) > 0, "nothing is in contact")


def joints_ranks_agree_2d(bench):
    """Driven, sprung and stopped joints on 1, 3 and 4 ranks."""
    ranks_agree(bench, LINKS, (3, 4))
    expect((bench.path("one") / "joints.csv").exists(), "there is no table of joints")


def rigid_ranks_agree_3d(bench):
    """The same in 3D, with a paddle."""
    ranks_agree(bench, TUMBLE, (3, 4))
    expect(max(int(row["contacts"]) for row in stats(bench.path("one"))) > 0, "nothing is in contact")


def elastic_ranks_agree_2d(bench):
    """A gate, a soft box on the floor and a floating ball on 1, 2 and 3 ranks."""
    ranks_agree(bench, SOFT, (2, 3))
    expect(largest(table(bench.path("one"), "solids.csv"), "pin_fx") > 0, "pins do nothing")
    expect(largest(stats(bench.path("one")), "elastic_energy") > 0, "nothing is deformed")


def sheet_ranks_agree(bench):
    """A gate thinner than a cell, a soft box on the floor and a floating ball on 1, 2 and 3 ranks."""
    ranks_agree(bench, SHEET, (2, 3))


def elastic_ranks_agree_3d(bench):
    """A soft box, a ball and a paddle in 3D on 1, 2 and 3 ranks."""
    ranks_agree(bench, SOFT_3D, (2, 3))
    expect(largest(stats(bench.path("one")), "elastic_energy") > 0, "nothing is deformed")


def shared_elements_ranks_agree(bench):
    """A soft box of 800 elements, which the ranks share, on 1, 2 and 3 ranks."""
    ranks_agree(bench, SOFT.replace("element_size = 0.06", "element_size = 0.006"), (2, 3))


def shared_unknowns_ranks_agree(bench):
    """Elastic solids without factors, whose matrix the ranks share, on 1, 2 and 3 ranks; three resume with the same
    bits."""
    text = SOFT.replace("[solver]\n", '[solver]\nelastic = "iterate"\n')
    ranks_agree(bench, text, (2, 3))
    expect(largest(table(bench.path("one"), "solids.csv"), "pin_fx") > 0, "pins do nothing")
    resumed_ranks_agree(bench, text)


def twins_ranks_agree(bench):
    """Two equal soft boxes without factors: each of two ranks has the unknowns of one."""
    text = TWENTY_STEPS.replace("[solver]\n", '[solver]\nelastic = "iterate"\n')
    for name, low, high in (("left", 0.42, 0.56), ("right", 0.76, 0.9)):
        box = f'shape = "box"\nlower = [{low}, 0.002]\nupper = [{high}, 0.1]'
        text += elastic(name, box, "element_size = 0.007")
    ranks_agree(bench, text, (2,))


def resumed_ranks_agree(bench, text):
    text = text.replace("frame_rate = 10.0", "frame_rate = 20.0")
    bench.simulate(text=text, out="whole", ranks=3).needs(0)
    bench.simulate("--frames", "1", text=text, out="parts", ranks=3).needs(0)
    bench.run("resume", "parts", "--frames", "2", ranks=3).needs(0)
    same_tables(bench.path("parts"), bench.path("whole"))
    same_frames(bench.path("parts"), bench.path("whole"))


def sprung_ranks_agree_2d(bench):
    """A ball on a spring in the flood on 1 and 3 ranks; three ranks resume from a checkpoint with the same bits."""
    ranks_agree(bench, SPRUNG, (3,))
    expect(largest(stats(bench.path("one")), "elastic_energy") > 0, "the spring does nothing")
    resumed_ranks_agree(bench, SPRUNG)


def bounces_ranks_agree_2d(bench):
    """Rigid balls with restitution on 1 and 3 ranks; three ranks resume with the same bits."""
    ranks_agree(bench, BOUNCE, (3,))
    expect(max(int(row["contacts"]) for row in stats(bench.path("one"))) > 0, "nothing is in contact")
    resumed_ranks_agree(bench, BOUNCE)
    impacts = impacts_in(bench.path("parts") / "checkpoints" / "00000010" / "rank.00000")
    expect(len(impacts) > 0 and impacts[2] < 2, f"no impact is under way at the checkpoint: {impacts}")


def impacts_in(checkpoint):
    """Numbers of the impacts in a checkpoint, as coupling/state/impact_numbers.h packs them."""
    data = checkpoint.read_bytes()
    key = b"impacts.due"
    at = data.index(key) + len(key)
    return numpy.frombuffer(data, count=int.from_bytes(data[at:at + 8], "little") // 8, offset=at + 8)


def beating_ranks_agree_3d(bench):
    """A deforming solid beside a rigid ball on 1 and 3 ranks; three ranks resume with the same bits."""
    write_beats(bench.folder)
    ranks_agree(bench, BEATING, (3,))
    expect(largest(table(bench.path("one"), "solids.csv"), "pin_fx") > 0, "nothing drives the solid")
    resumed_ranks_agree(bench, BEATING)


def beating_ranks_agree_2d(bench):
    """The same with outlines in 2D."""
    write_outlines(bench.folder)
    ranks_agree(bench, BEATING_2D, (3,))
    expect(largest(table(bench.path("one"), "solids.csv"), "pin_fx") > 0, "nothing drives the solid")
    resumed_ranks_agree(bench, BEATING_2D)


def viscous_ranks_agree_2d(bench):
    """Thick liquid that bends a gate and drags a box and a ball, on 1, 2 and 3 ranks."""
    ranks_agree(bench, THICK, (2, 3))
    expect(largest(stats(bench.path("one")), "viscous_dissipation") > 0, "nothing is dissipated")


def streams_past_discs_agree(bench):
    """Gently viscous liquid past a disc at rest, one that turns and one that sinks, on 1 and 3 ranks and resumed."""
    ranks_agree(bench, STREAM, (3,))
    resumed_ranks_agree(bench, STREAM)
    expect(largest(table(bench.path("one"), "solids.csv"), "tz") > 0, "nothing acts on the discs")


def mud_ranks_agree_2d(bench):
    """A dam of yield-stress liquid on 1 and 3 ranks, with a converged outer iteration."""
    ranks_agree(bench, MUD + "rheology_tolerance = 1e-9\nrheology_iterations = 100\n", (3,))
    expect(largest(stats(bench.path("one")), "rheology_iterations") > 1, "one solve sufficed")


def viscous_ranks_agree_3d(bench):
    """Bodies and a paddle in thick liquid in 3D, on 1 and 3 ranks."""
    ranks_agree(bench, THICK_3D, (3,))


def gas_ranks_agree_2d(bench):
    """Boxes and a ball in liquid and gas, with surface tension, on 1, 2 and 3 ranks."""
    text = gassy(BOXES).replace("end = 0.1\nfixed_step = 0.005", "end = 0.04\nfixed_step = 0.002")
    ranks_agree(bench, text.replace("frame_rate = 10.0", "frame_rate = 25.0"), (2, 3))
    expect(largest(stats(bench.path("one")), "gas_volume") > 0, "there is no gas")


def gas_ranks_agree_3d(bench):
    """A splash under gas in 3D, on 1 and 3 ranks."""
    ranks_agree(bench, gassy(SPLASH).replace("surface_tension = 0.07", "surface_tension = 0.0"), (3,))


def tension_ranks_agree_3d(bench):
    """The same with surface tension, on 1, 2 and 4 ranks."""
    ranks_agree(bench, gassy(SPLASH), (2, 4))


def air_ranks_agree_2d(bench):
    """Boxes and a ball under enclosed air, on 1, 2 and 3 ranks."""
    ranks_agree(bench, airy(BOXES), (2, 3))
    expect(largest(stats(bench.path("one")), "bubbles") > 0, "no air is enclosed")


def viscous_air_ranks_agree_2d(bench):
    """Thick liquid under enclosed air, on 1 and 2 ranks."""
    ranks_agree(bench, airy(viscous(TWENTY_STEPS, 300.0).replace("[solver]", '[solver]\nviscosity = "coupled"')), (2,))
    expect(largest(stats(bench.path("one")), "bubbles") > 0, "no air is enclosed")


def prescribed_ranks_agree(bench):
    """A disc in a prescribed vortex on 1, 2, 3 and 4 ranks."""
    ranks_agree(bench, SWIRL)


def volumes_ranks_agree_2d(bench):
    """A dam break with volumes in cells on 1, 2 and 3 ranks."""
    ranks_agree(bench, DAM_IN_CELLS, (2, 3))


def volumes_under_gas_agree(bench):
    """A dam break with volumes in cells into gas, on 1, 2 and 3 ranks."""
    ranks_agree(bench, GAS_IN_CELLS, (2, 3))


def volumes_round_bubble_agree(bench):
    """An enclosed bubble with volumes in cells, on 1, 2 and 3 ranks."""
    ranks_agree(bench, BUBBLE_IN_CELLS, (2, 3))


def volumes_that_part_agree(bench):
    """Liquid with volumes in cells that leaves walls, on 1, 2 and 3 ranks."""
    ranks_agree(bench, PARTING_IN_CELLS, (2, 3))


def volumes_beside_post_agree(bench):
    """A dam break with volumes in cells that meets a post, on 1, 2 and 3 ranks."""
    ranks_agree(bench, POST_IN_CELLS, (2, 3))


def volumes_ranks_agree_3d(bench):
    """A dam break with volumes in cells in 3D, on 1, 2 and 3 ranks."""
    ranks_agree(bench, DAM_IN_CELLS_3D, (2, 3))


def volumes_that_set_off_agree(bench):
    """A stream whose inflow starts at once, with volumes in cells, on 1, 2 and 3 ranks."""
    ranks_agree(bench, SET_OFF_IN_CELLS, (2, 3))


def parting_volumes_beside_paddle_agree(bench):
    """Liquid with volumes in cells that leaves walls beside a paddle and a box, on 1 and 3 ranks."""
    ranks_agree(bench, PARTING_BESIDE_PADDLE, (3,))


def poured_volumes_agree(bench):
    """A jet and a source with volumes in cells above an open bottom, on 1, 2 and 3 ranks."""
    ranks_agree(bench, POURED_IN_CELLS, (2, 3))


def drops_agree(bench, dimension):
    text = spray(dimension)
    ranks_agree(bench, text, (2, 3))
    expect(largest(stats(bench.path("one")), "drops") >= 5, "there are few drops")
    rows, others = stats(bench.path("one")), stats(bench.path("ranks3"))
    expect([row["drops"] for row in rows] == [row["drops"] for row in others], "the ranks have other drops")
    text = text.replace("end = 0.2", "end = 0.1").replace("fixed_step = 0.01", "fixed_step = 0.005")
    resumed_ranks_agree(bench, text.replace("frame_rate = 5.0", "frame_rate = 10.0\n"))
    expect(int(stats(bench.path("parts"))[10]["drops"]) > 0, "no drop flies at the checkpoint")


def drops_agree_2d(bench):
    """Drops on 1, 2 and 3 ranks, and resumed on three half-way with the same bits."""
    drops_agree(bench, 2)


def drops_agree_3d(bench):
    """The same in 3D."""
    drops_agree(bench, 3)


def integral_of_rates(t, scale):
    """Volume that FED's spring brings and its pump takes until t."""
    return scale * 0.3 * (t + 2.5 * t * t) - 0.1 * max(0.0, t - 0.0275)


def follows_rates(bench, run, scale):
    """The expected volume of a run of FED is the integral of its rates, and its log tells of the dry source once."""
    rows = stats(bench.path(run))
    start = json.loads((bench.path(run) / "summary.json").read_text())["initial_volume"]
    expected = json.loads((bench.path(run) / "summary.json").read_text())["expected_volume"]
    brought = integral_of_rates(float(rows[-1]["time"]), scale)
    expect(abs(expected - start - brought) < 1e-8, f"{run}: rates bring {expected - start}, not {brought}")
    log = (bench.path(run) / "log.txt").read_text()
    expect(log.count("liquid.source.1 brings nothing") == 1, f"{run}: the log has\n{log}")


def fed_ranks_agree_2d(bench):
    """A spring and a pump with rates on 1, 2 and 3 ranks, and resumed half-way."""
    ranks_agree(bench, FED, (2, 3))
    for run in ("one", "ranks2", "ranks3"):
        follows_rates(bench, run, 1.0)
    resumed_ranks_agree(bench, FED)


def fed_ranks_agree_3d(bench):
    """The same in 3D on 1 and 3 ranks."""
    ranks_agree(bench, FED_3D, (3,))
    follows_rates(bench, "ranks3", 1 / 3)


def waves_ranks_agree_2d(bench):
    """Waves through sides on 1, 2 and 3 ranks, and resumed half-way."""
    ranks_agree(bench, SEA, (2, 3))
    resumed_ranks_agree(bench, SEA)


def waves_under_gas_agree(bench):
    """The same below gas, on 1 and 3 ranks, and resumed half-way."""
    text = SEA.replace(f"tolerance = {TOLERANCE}", "tolerance = 1e-11") + "[gas]\ndensity = 1.2\n"
    ranks_agree(bench, text, (3,))
    resumed_ranks_agree(bench, text)


def waves_ranks_agree_3d(bench):
    """The same aslant in 3D, on 1 and 3 ranks."""
    ranks_agree(bench, SEA_3D, (3,))


def jet_ranks_agree(bench):
    """A slanted jet on 1, 2 and 3 ranks; its rim lies beyond the halo of a rank that it enters."""
    ranks_agree(bench, JET, (2, 3))


def moved_blocks_agree(bench):
    """A dam break whose ranks get blocks of equal work, also after resuming, with the same bits."""
    ranks_agree(bench, TWENTY_STEPS, (3,))
    summary = json.loads((bench.path("ranks3") / "summary.json").read_text())
    expect("balance" in summary["wall_seconds_by_phase"], "no block moved")
    resumed_ranks_agree(bench, TWENTY_STEPS)


def same_bits_twice(bench, text):
    for out in ("one", "two"):
        bench.simulate(text=text, out=out, ranks=3).needs(0)
    same_tables(bench.path("one"), bench.path("two"))
    same_frames(bench.path("one"), bench.path("two"))


def same_ranks_same_bits(bench):
    """Two runs on three ranks, rigid bodies among them."""
    same_bits_twice(bench, TUMBLE)


def elastic_same_ranks_same_bits(bench):
    """Two runs on three ranks, elastic bodies among them."""
    same_bits_twice(bench, SOFT)


def killed_at_random(bench, ranks, kills, solids="", kind=lambda text: text):
    """SIGKILL of a random rank at random moments; the final result equals that of an uninterrupted run."""
    seed = random.SystemRandom().randrange(10**6)
    rng = random.Random(seed)
    text = kind(DAM.replace("0.03125", "0.015625").replace("end = 0.2", "end = 0.4") + solids)
    started = time.monotonic()
    bench.simulate(text=text, out="whole", ranks=ranks).needs(0)
    duration = time.monotonic() - started
    scene = bench.scene(text)

    def verb():
        begun = (bench.path("out") / "scene.toml").exists() and any((bench.path("out") / "checkpoints").glob("*/COMMIT"))
        return ["resume", "out"] if begun else ["run", scene, "--out", "out", "--overwrite"]

    for _ in range(kills):
        process = bench.start(*verb(), ranks=ranks)
        time.sleep(rng.uniform(0.2, 1.0) * duration)
        if process.poll() is None:
            victims = rank_processes(process)
            if victims:
                with contextlib.suppress(ProcessLookupError):  # it may have ended since it was listed
                    os.kill(rng.choice(victims), signal.SIGKILL)
        bench.finish(process, limit=10 + duration)
        if bench.path("out").exists():
            frames_are_good(bench.path("out"))
    bench.run(*verb(), ranks=ranks).needs(0)
    try:
        same_tables(bench.path("out"), bench.path("whole"))
        same_frames(bench.path("out"), bench.path("whole"))
    except Exception:
        print(f"seed {seed}")
        raise


def one_rank_killed_at_random(bench):
    """kill -9 of the only rank."""
    killed_at_random(bench, 1, 4)


def two_ranks_killed_at_random(bench):
    """kill -9 of one of two ranks."""
    killed_at_random(bench, 2, 4)


def rigid_bodies_killed_at_random(bench):
    """kill -9 of one of two ranks while boxes lie on each other in the flood."""
    killed_at_random(bench, 2, 3, BOXES[len(TWENTY_STEPS):])


def joints_killed_at_random(bench):
    """kill -9 of one of two ranks while joints hold, drive and brake bodies in the flood."""
    killed_at_random(bench, 2, 3, LINKS[len(TWENTY_STEPS):])


def elastic_bodies_killed_at_random(bench):
    """kill -9 of one of two ranks while the flood bends a gate and carries a ball."""
    killed_at_random(bench, 2, 3, SOFT[len(TWENTY_STEPS):])


def sheet_killed_at_random(bench):
    """The same with a gate thinner than a cell."""
    killed_at_random(bench, 2, 2, SHEET[len(TWENTY_STEPS):])


def viscous_flow_killed_at_random(bench):
    """kill -9 of one of two ranks of a dam break of thick liquid."""
    killed_at_random(bench, 2, 2, kind=lambda text: viscous(text, 20.0))


def gas_killed_at_random(bench):
    """kill -9 of one of two ranks of a dam break under gas."""
    killed_at_random(bench, 2, 2, kind=gassy)


def air_killed_at_random(bench):
    """kill -9 of one of two ranks of a dam break under enclosed air."""
    killed_at_random(bench, 2, 2, kind=airy)


def drops_killed_at_random(bench):
    """kill -9 of one of three ranks of a splash whose volumes are carried in cells, with drops."""
    killed_at_random(bench, 3, 2, kind=lambda text: text.replace("end = 0.4", "end = 0.7").replace(
        "[liquid]", '[liquid]\nvolume = "cells"'))
    expect(largest(stats(bench.path("whole")), "drops") > 0, "there are no drops")


TABLES = {"equality": [moved_blocks_agree, ranks_agree_2d, ranks_agree_3d, rigid_ranks_agree_2d, joints_ranks_agree_2d,
                       rigid_ranks_agree_3d,
                       elastic_ranks_agree_2d, sheet_ranks_agree, sprung_ranks_agree_2d, bounces_ranks_agree_2d,
                       beating_ranks_agree_3d, beating_ranks_agree_2d, viscous_ranks_agree_2d,
                       streams_past_discs_agree, mud_ranks_agree_2d, gas_ranks_agree_2d, gas_ranks_agree_3d, air_ranks_agree_2d,
                       viscous_air_ranks_agree_2d, prescribed_ranks_agree, volumes_ranks_agree_2d,
                       volumes_beside_post_agree, volumes_ranks_agree_3d, volumes_under_gas_agree,
                       volumes_round_bubble_agree, volumes_that_part_agree, volumes_that_set_off_agree,
                       parting_volumes_beside_paddle_agree, poured_volumes_agree, drops_agree_2d,
                       drops_agree_3d, jet_ranks_agree,
                       fed_ranks_agree_2d, fed_ranks_agree_3d, waves_ranks_agree_2d, waves_under_gas_agree,
                       waves_ranks_agree_3d,
                       same_ranks_same_bits, elastic_same_ranks_same_bits],
          "long_equality": [shared_elements_ranks_agree, shared_unknowns_ranks_agree, twins_ranks_agree,
                            elastic_ranks_agree_3d, viscous_ranks_agree_3d, tension_ranks_agree_3d],
          "killing": [one_rank_killed_at_random, two_ranks_killed_at_random, rigid_bodies_killed_at_random,
                      joints_killed_at_random,
                      elastic_bodies_killed_at_random, sheet_killed_at_random, viscous_flow_killed_at_random,
                      gas_killed_at_random, air_killed_at_random, drops_killed_at_random]}

if __name__ == "__main__":
    sys.exit(1 if run_table(TABLES, sys.argv[1:]) else 0)
