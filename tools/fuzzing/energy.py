"""Bounds of the energy that a run may have."""
import re

import numpy

from fuzzing.joints import feeds
from fuzzing.tables import Fault

WORKS = ("work_gravity", "work_tension", "work_sides", "work_solids", "lost_viscous")
SMALL_CELLS = 3       # cells of features below the grid: holes that close, flecks that gas carries along
BEGUN = 5             # steps from which on energy from nowhere counts
CREATED = 0.25        # relative; the first steps of bodies a few cells across set liquid going with blows


def is_constant(value):
    return all(not isinstance(v, str) or re.fullmatch(r"[-+.\de]+", v) for v in value)


def is_fed(scene):
    """True if energy may enter from outside."""
    sides = scene["domain"].get("boundary", {})
    kinds = {s if isinstance(s, str) else s["type"] for s in sides.values()}
    liquid = scene.get("liquid", {})
    if kinds & {"inflow", "outflow", "moving_wall", "waves"} or "source" in liquid or "prescribed_velocity" in liquid:
        return True
    if "force" in scene or "sponge" in liquid:
        return True
    if not is_constant(scene.get("gravity", [0.0])):
        return True
    if feeds(scene.get("joint", []) + [j for robot in scene.get("robot", []) for j in robot.get("joint", [])]):
        return True
    for solid in scene.get("solid", []):
        pins = solid.get("pinned", [])
        moved = any("motion" in p for p in (pins if isinstance(pins, list) else [pins]))
        if moved or solid["kind"] in ("kinematic", "deforming") or "body_force" in solid or "traction" in solid:
            return True
    return False


def is_driven_round_an_edge(scene):
    """True if outflow sides of different pressures meet. The flow from one to the other turns within a cell at their
    edge, and its energy is not known: 0.5 uJ from nowhere with cells of 0.5 mm, 0.014 with half of that."""
    sides = scene["domain"].get("boundary", {})
    outflows = {name: side.get("pressure", 0) for name, side in sides.items()
                if not isinstance(side, str) and side["type"] == "outflow"}
    return any(a[0] != b[0] and outflows[a] != outflows[b] for a in outflows for b in outflows)


def energy_of_films(scene, stats):
    """Kinetic energy, J, that liquid without a pressure may have at inflow sides: half a cell, none of whose centres is
    wet. It moves as the side does, at about the mean speed of all liquid, and no pressure does the work this takes."""
    extent, h = numpy.subtract(scene["domain"]["upper"], scene["domain"]["lower"]), scene["domain"]["cell_size"]
    sides = scene["domain"].get("boundary", {})
    inflows = [name for name, side in sides.items() if not isinstance(side, str) and side["type"] == "inflow"]
    film = sum(0.5 * h * float(numpy.prod(extent)) / float(extent["xyz".index(name[0])]) for name in inflows)
    return stats["kinetic_energy"] * numpy.minimum(1, film / numpy.maximum(stats["liquid_volume"], 1e-300))


def periodic_along(scene, g):
    sides = scene["domain"].get("boundary", {})
    return any(g[n] != 0 and "periodic" in str(sides.get(f"{axis}_lower", ""))
               for n, axis in enumerate("xyz"[:scene["dimension"]]))


def fastest(scene, stats, given):
    """A bound of the speed, m/s, in each step: three times that of a fall through the domain from the highest speed at
    the start with the energy `given` (J) in the liquid, or of a capillary wave of one cell if that is more."""
    liquid = {"density": 1000.0, **scene.get("liquid", {})}
    g = [float(v) for v in scene.get("gravity", [0.0, -9.81, 0.0]) if is_constant([v])]
    extent = numpy.subtract(scene["domain"]["upper"], scene["domain"]["lower"])
    fall = 2 * float(numpy.linalg.norm(g)) * float(extent.sum())
    capillary = 2 * liquid.get("surface_tension", 0) / (liquid["density"] * scene["domain"]["cell_size"])
    cell = scene["domain"]["cell_size"] ** scene["dimension"]
    mass = liquid["density"] * numpy.maximum(stats["liquid_volume"], cell)
    return 3 * numpy.sqrt(stats["max_speed"][0] ** 2 + fall + capillary + 2 * given / mass)


def energy_margin(scene, stats, given, amiss):
    """Energy, J, that the finite cells leave open in each step; `amiss`: error of the liquid's volume.

    A twentieth of the initial kinetic energy, plus the following. The surface is known to about a cell: all mass is
    lifted by half a cell, and the volume error is lifted through the domain. Where the surface moves before the solve
    (`off: leapfrog`), it lags half a step behind. Liquid that transport adds or the volume control puts back moves at
    most at the run's highest speed, as far as that is possible: features below a cell gain or lose a share of their
    energy with their volume. All mass moves by a millionth of a cell a step. Surface tension adds at most sigma per cell face."""
    g = [float(v) for v in scene.get("gravity", [0.0, -9.81, 0.0]) if is_constant([v])]
    h, gravity = scene["domain"]["cell_size"], float(numpy.linalg.norm(g))
    extent = numpy.subtract(scene["domain"]["upper"], scene["domain"]["lower"])
    volume, liquid = float(numpy.prod(extent)), {"density": 1000.0, **scene.get("liquid", {})}
    mass = liquid["density"] * float(stats["liquid_volume"].max())
    mass += sum(s.get("density", 0) * volume * 0.3 for s in scene.get("solid", []))
    moved = liquid["density"] * (amiss + numpy.abs(stats["volume_corrected"]) + stats["volume_spilled"])
    speed = numpy.minimum(stats["max_speed"], fastest(scene, stats, given))
    lag = numpy.maximum.accumulate(speed * stats["dt"])
    step = numpy.maximum(stats["dt"], 1e-3 * stats["dt"].max())
    jitter = numpy.divide(1e-6 * h, step, out=numpy.zeros_like(step), where=step > 0)  # speed by the solver's tolerance
    return (0.05 * stats["kinetic_energy"][0] + 0.5 * mass * jitter ** 2
            + gravity * (0.5 * mass * (h + lag) + liquid["density"] * amiss * extent.sum())
            + 0.5 * moved * speed ** 2 + liquid.get("surface_tension", 0) * volume / h)


def check_energies(scene, stats):
    """All bounds that hold for this scene."""
    if not is_driven_round_an_edge(scene):
        check_created(scene, stats)
    if not is_fed(scene):
        check_energy(scene, stats)


def check_energy(scene, stats):
    """E = E_kin + E_pot + E_el of a closed scene must stay below its initial value, up to `energy_margin`."""
    g = [float(v) for v in scene.get("gravity", [0.0, -9.81, 0.0])][:scene["dimension"]]
    if periodic_along(scene, g):
        return
    energy = stats["kinetic_energy"] + stats["potential_energy"] + stats["elastic_energy"]
    given = stats["kinetic_energy"][0] + stats["elastic_energy"][0]
    amiss = numpy.abs(stats["liquid_volume"] - stats["liquid_volume"][0])
    if scene.get("liquid", {}).get("volume") == "cells":   # energies are those of the level set, which knows a cell less
        amiss = amiss + scene["domain"]["cell_size"] ** scene["dimension"]
    margin = energy_margin(scene, stats, given, amiss) + 1e-9 * numpy.abs(energy[0])
    gained = energy - energy[0] - margin
    if (gained > 0).any():
        n, kinetic = int(gained.argmax()), stats["kinetic_energy"]
        raise Fault("energy", f"{energy[0]:.6g} J at the start, {energy[n]:.6g} J at t = {stats['time'][n]:.6g} s "
                              f"(kinetic {kinetic[0]:.4g}, {kinetic[n]:.4g}; margin {numpy.max(margin):.3g})")


def check_created(scene, stats):
    """Energy from nowhere in any scene: a share of what it has and of the work done on it, beside `energy_margin`.

    Works are means of a step's two ends. The first steps after a sudden start do not count."""
    works = sum(numpy.abs(stats[name]) for name in WORKS)
    given = stats["kinetic_energy"][0] + stats["elastic_energy"][0] + works
    largest = numpy.maximum.accumulate(stats["kinetic_energy"] + stats["elastic_energy"] + works)
    small = SMALL_CELLS * scene["domain"]["cell_size"] ** scene["dimension"]
    gained = -stats["lost_numerical"] - CREATED * largest - energy_margin(scene, stats, given, small)
    gained -= numpy.maximum.accumulate(energy_of_films(scene, stats))
    if (gained[BEGUN:] > 0).any():
        n = BEGUN + int(gained[BEGUN:].argmax())
        raise Fault("created", f"{-stats['lost_numerical'][n]:.6g} J from nowhere at t = {stats['time'][n]:.6g} s, "
                               f"where there are {largest[n]:.6g} J at most, with all work done")
