"""Properties that must hold for every scene and every run."""
import re
import sys
import pathlib

import numpy

from fuzzing.program import OTHER_HEAP
from fuzzing.tables import Fault, check_finite, overlap, read_stats, read_summary, read_surfaces, same_stats

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "faults"))
from read_frames import frame_faults  # noqa: E402

DEEPEST = 0.02        # cells; frames show faceted surfaces, while contact is exact
LOST_VOLUME = 0.05    # relative; LOST_CELLS is allowed in addition, since tiny scenes are mostly surface
LOST_CELLS = 3
MEMORY = 2 << 30      # bytes, for a scene of a few hundred cells
MANY_STEPS, LONG_STEP = 10, 15.0    # a run that goes on to make so many steps, each within so many s, does not hang
STARTUP = 10.0        # seconds outside of steps
WORKS = ("work_gravity", "work_tension", "work_sides", "work_solids", "lost_viscous")
CREATED = 0.25        # relative; the first steps of bodies a few cells across set liquid going with blows
CUT_OFF = -1          # such a run, at the end of its processor time


def check_end(done, codes, verb):
    """Requires a documented exit code, and exactly one message unless it is a success."""
    if done.code is None:
        raise Fault("time", f"{verb} did not end within {done.cpu:.0f} s of processor time")
    if "ERROR: AddressSanitizer" in done.said or "runtime error:" in done.said or "LeakSanitizer" in done.said:
        raise Fault("sanitizer", done.errors[-1500:])
    if done.code not in codes:
        raise Fault(f"code {done.code}", f"{verb} ended with {done.code}, not {codes}: {done.errors[-600:]}")
    if done.printed > 4 << 20:
        raise Fault("flood", f"{verb} printed {done.printed} bytes")
    if done.memory > MEMORY and "AddressSanitizer" not in done.said:
        raise Fault("memory", f"{verb} took {done.memory >> 20} MiB")
    messages = [line for line in done.errors.splitlines() if line.startswith("seiche: ")]
    if done.code in (2, 3, 4, 5, 6) and not messages:
        raise Fault("message", f"{verb} ended with {done.code} and no message")
    if done.code == 3 and not re.search(r"\d", messages[0]):
        raise Fault("message", f"no figure in: {messages[0]}")


def is_constant(value):
    return all(not isinstance(v, str) or re.fullmatch(r"[-+.\de]+", v) for v in value)


def is_fed(scene):
    """True if energy may enter from outside."""
    sides = scene["domain"].get("boundary", {})
    kinds = {s if isinstance(s, str) else s["type"] for s in sides.values()}
    liquid = scene.get("liquid", {})
    if kinds & {"inflow", "outflow", "moving_wall"} or "source" in liquid or "prescribed_velocity" in liquid:
        return True
    if not is_constant(scene.get("gravity", [0.0])):
        return True
    for solid in scene.get("solid", []):
        pins = solid.get("pinned", [])
        moved = any("motion" in p for p in (pins if isinstance(pins, list) else [pins]))
        if moved or solid["kind"] == "kinematic" or "body_force" in solid or "traction" in solid:
            return True
    return False


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


def energy_margin(scene, stats, given):
    """Energy, J, that the finite cells leave open in each step.

    A twentieth of the initial kinetic energy, plus the following. The surface is known to about a cell: all mass is
    lifted by half a cell, and the volume error is lifted through the domain. Liquid that transport adds or the volume
    control puts back moves at most at the run's highest speed, as far as that is possible: features below a cell gain
    or lose a share of their energy with their volume. Surface tension adds at most sigma per cell face."""
    g = [float(v) for v in scene.get("gravity", [0.0, -9.81, 0.0]) if is_constant([v])]
    h, gravity = scene["domain"]["cell_size"], float(numpy.linalg.norm(g))
    extent = numpy.subtract(scene["domain"]["upper"], scene["domain"]["lower"])
    volume, liquid = float(numpy.prod(extent)), {"density": 1000.0, **scene.get("liquid", {})}
    mass = liquid["density"] * float(stats["liquid_volume"].max())
    mass += sum(s.get("density", 0) * volume * 0.3 for s in scene.get("solid", []))
    amiss = numpy.abs(stats["liquid_volume"] - stats["liquid_volume"][0])
    moved = liquid["density"] * (amiss + numpy.abs(stats["volume_corrected"]))
    speed = numpy.minimum(stats["max_speed"], fastest(scene, stats, given))
    return (0.05 * stats["kinetic_energy"][0] + gravity * (0.5 * mass * h + liquid["density"] * amiss * extent.sum())
            + 0.5 * moved * speed ** 2 + liquid.get("surface_tension", 0) * volume / h)


def check_energy(scene, stats):
    """E = E_kin + E_pot + E_el of a closed scene must stay below its initial value, up to `energy_margin`."""
    g = [float(v) for v in scene.get("gravity", [0.0, -9.81, 0.0])][:scene["dimension"]]
    if periodic_along(scene, g):
        return
    energy = stats["kinetic_energy"] + stats["potential_energy"] + stats["elastic_energy"]
    given = stats["kinetic_energy"][0] + stats["elastic_energy"][0]
    margin = energy_margin(scene, stats, given) + 1e-9 * numpy.abs(energy[0])
    gained = energy - energy[0] - margin
    if (gained > 0).any():
        n, kinetic = int(gained.argmax()), stats["kinetic_energy"]
        raise Fault("energy", f"{energy[0]:.6g} J at the start, {energy[n]:.6g} J at t = {stats['time'][n]:.6g} s "
                              f"(kinetic {kinetic[0]:.4g}, {kinetic[n]:.4g}; margin {numpy.max(margin):.3g})")


def check_created(scene, stats):
    """Energy from nowhere in any scene: a share of what it has and of the work done on it, beside `energy_margin`."""
    works = sum(numpy.abs(stats[name]) for name in WORKS)
    largest = numpy.maximum.accumulate(stats["kinetic_energy"] + stats["elastic_energy"] + works)
    gained = -stats["lost_numerical"] - CREATED * largest - energy_margin(scene, stats, largest)
    if (gained > 0).any():
        n = int(gained.argmax())
        raise Fault("created", f"{-stats['lost_numerical'][n]:.6g} J from nowhere at t = {stats['time'][n]:.6g} s, where "
                               f"there are {largest[n]:.6g} J at most, with all work done")


def check_volume(scene, folder):
    """The liquid's volume must follow the account of sources and flow through the sides, or the run must warn."""
    summary = read_summary(folder)
    amiss = abs(summary["liquid_volume"] - summary["expected_volume"])
    cell = scene["domain"]["cell_size"] ** scene["dimension"]
    allowed = LOST_VOLUME * max(summary["initial_volume"], abs(summary["expected_volume"])) + LOST_CELLS * cell
    warned = re.search("warning: .*volume", (folder / "log.txt").read_text(encoding="utf-8"))
    if amiss > allowed and not warned:
        raise Fault("volume", f"{summary['liquid_volume']:.6g} of {summary['expected_volume']:.6g} "
                              f"m^{scene['dimension']}, {amiss / cell:.3g} cells amiss, without a warning")


def check_overlaps(scene, folder):
    """No freely moving body may lie within another solid."""
    solids = scene.get("solid", [])
    moves = [s["kind"] in ("rigid", "elastic", "sprung") for s in solids]
    if not any(moves):
        return
    for path in sorted((folder / "frames").glob("solids.*.vtu")):
        found = read_surfaces(path, scene["dimension"])
        for i, j in ((i, j) for i in found for j in found if i != j and (moves[i] or moves[j])):
            if solids[i].get("invert") or solids[j].get("invert"):
                continue
            depth = overlap(found[i], found[j]) / scene["domain"]["cell_size"]
            if depth > DEEPEST:
                raise Fault("overlap", f"{path.name}: solid {i} lies {depth:.3g} cells within solid {j}")


def no_field_asked(scene):
    """Frames of solids only hold no grid: solids go to files of their own."""
    return scene.get("output", {}).get("frames") == ["solids"]


def check_frames(scene, folder):
    for path in sorted((folder / "frames").glob("*.vdb")):
        faults = frame_faults(str(path))
        if no_field_asked(scene) and faults == ["file: no grids"]:
            continue
        if faults:
            raise Fault("frame", f"{path.name}: {faults}")


def check_result(scene, folder):
    """Checks all output of a run."""
    for name in ("stats.csv", "solids.csv", "probes.csv"):
        if (folder / name).exists():
            check_finite(folder / name)
    stats = read_stats(folder)
    if not is_fed(scene):
        check_energy(scene, stats)
    check_created(scene, stats)
    if "liquid" in scene:
        check_volume(scene, folder)
    check_overlaps(scene, folder)
    check_frames(scene, folder)


def goes_on(folder, seconds):
    """True if a run that was cut off after so many seconds advanced to the end: stiff springs and thin surfaces need
    thousands of steps, walls that separate from viscous liquid beside elastic solids up to fifty solves a step."""
    if not (folder / "stats.csv").exists():
        return False
    stats = read_stats(folder)
    longest, since = stats["wall_seconds"].max(), seconds - stats["wall_seconds"].sum()
    advances = stats["dt"][-1] > 0 and since < 2 * longest + STARTUP
    return advances and len(stats["time"]) > MANY_STEPS and longest < LONG_STEP


def check_cut_off(scene, folder):
    """Checks the tables of a run that was cut off."""
    check_finite(folder / "stats.csv")
    if not is_fed(scene):
        check_energy(scene, read_stats(folder))


def check_repeated(program, folder, name):
    """A second run with other values in fresh memory must take the same steps, bit for bit."""
    done = program.run("run", name, "--out", "again", "--threads", "1", folder=folder, heap=OTHER_HEAP)
    if done.code not in (0, 3) or not same_stats(folder / "out", folder / "again"):
        raise Fault("repeat", f"the same run a second time ended with {done.code}, with other rows in stats.csv")


def judge(program, scene, folder, name="scene.toml", twice=False):
    """Checks and runs a scene; returns the exit code or CUT_OFF, or raises the first fault."""
    checked = program.run("check", name, folder=folder, ranks=1)
    check_end(checked, (0, 2), "check")
    done = program.run("run", name, "--out", "out", "--threads", "1", folder=folder)
    if done.code is None and goes_on(folder / "out", done.seconds):
        check_cut_off(scene, folder / "out")
        return CUT_OFF
    check_end(done, (0, 3) if checked.code == 0 else (2,), "run")
    if done.code in (0, 3):
        check_result(scene, folder / "out")
        if twice:
            check_repeated(program, folder, name)
    return done.code
