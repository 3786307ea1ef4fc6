#!/usr/bin/env python3
"""Period of a swing in solids.csv against potential flow, one row a run: period.py RUN_DIRECTORY..."""
import csv
import json
import math
import pathlib
import sys
import tomllib

INNER, OUTER, STIFFNESS, LIQUID = 0.1, 0.2, 20e3, 1000.0    # as in sprung_cylinder.toml


def swing(run):
    """Times and places of the cylinder."""
    with open(run / "solids.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["name"] == "cylinder"]
    return [float(row["time"]) for row in rows], [float(row["x"]) for row in rows]


def period(times, places):
    """Mean time between upward crossings of x = 0, each found by a straight line between two steps."""
    ups = []
    for i in range(len(times) - 1):
        if places[i] < 0.0 <= places[i + 1]:
            ups.append(times[i] + (times[i + 1] - times[i]) * -places[i] / (places[i + 1] - places[i]))
    return (ups[-1] - ups[0]) / (len(ups) - 1)


def exact(ratio):
    area = math.pi * INNER**2
    added = (OUTER**2 + INNER**2) / (OUTER**2 - INNER**2)
    return 2.0 * math.pi * math.sqrt(LIQUID * area * (ratio + added) / STIFFNESS)


def ratio_of(run):
    """Density of the cylinder over that of the liquid, from the scene as it was run."""
    scene = tomllib.loads((run / "scene.toml").read_text())
    (cylinder,) = [solid for solid in scene["solid"] if solid["name"] == "cylinder"]
    return cylinder["density"] / LIQUID


print("run                    cells  steps  period, s  exact, s   error  order")
before = None
for run in map(pathlib.Path, sys.argv[1:]):
    summary = json.loads((run / "summary.json").read_text())
    measured, wanted = period(*swing(run)), exact(ratio_of(run))
    error = measured / wanted - 1.0
    order = ""
    if before and summary["cells"] != before[1]:    # log of the ratio of errors over that of cell sizes; 2D
        order = f"{math.log(abs(before[0] / error)) / (0.5 * math.log(summary['cells'] / before[1])):5.2f}"
    print(f"{run.name:22} {summary['cells']:6} {summary['steps']:6} {measured:10.5f} {wanted:9.5f} "
          f"{100.0 * error:6.2f}% {order}".rstrip())
    before = error, summary["cells"]
