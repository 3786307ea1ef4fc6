"""Properties that must hold for every scene and every run."""
import re
import sys
import pathlib
from fnmatch import fnmatchcase

from fuzzing.energy import check_energies
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


def may_overlap(scene, i, j):
    """True if a joint holds two solids, or the last contact that names them lets them pass through each other."""
    a, b = (scene["solid"][k].get("name", f"solid{k + 1}") for k in (i, j))
    if any(set(joint["between"]) == {a, b} and not joint.get("collide") for joint in scene.get("joint", [])):
        return True
    collides = True
    for contact in scene.get("contact", []):
        one, other = contact["between"][0], contact["between"][-1]
        if any(fnmatchcase(x, one) and fnmatchcase(y, other) for x, y in ((a, b), (b, a))):
            collides = contact.get("collide", True)
    return not collides


def check_overlaps(scene, folder):
    """No freely moving body may lie within another solid."""
    solids = scene.get("solid", [])
    moves = [s["kind"] in ("rigid", "elastic", "sprung") for s in solids]
    if not any(moves):
        return
    for path in sorted((folder / "frames").glob("solids.*.vtu")):
        found = read_surfaces(path, scene["dimension"])
        listed = [i for i in found if i < len(solids)]   # links of robots come after them
        for i, j in ((i, j) for i in listed for j in listed if i != j and (moves[i] or moves[j])):
            if solids[i].get("invert") or solids[j].get("invert") or may_overlap(scene, i, j):
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


def check_result(scene, folder, energy=True):
    """Checks all output of a run; the energies only on request, since they need the whole scene."""
    for name in ("stats.csv", "solids.csv", "probes.csv", "joints.csv"):
        if (folder / name).exists():
            check_finite(folder / name)
    if energy:
        check_energies(scene, read_stats(folder))
    if "liquid" in scene:
        check_volume(scene, folder)
    check_overlaps(scene, folder)
    check_frames(scene, folder)


def goes_on(folder, seconds, ranks):
    """True if a run that was cut off after so many seconds advanced to the end: stiff springs and thin surfaces need
    thousands of steps, walls that separate from viscous liquid beside elastic solids up to fifty solves a step. Ranks
    may share one core."""
    if not (folder / "stats.csv").exists():
        return False
    stats = read_stats(folder)
    longest, since = stats["wall_seconds"].max(), seconds - stats["wall_seconds"].sum()
    advances = stats["dt"][-1] > 0 and since < 2 * longest + STARTUP
    return advances and len(stats["time"]) > MANY_STEPS and longest < LONG_STEP * ranks


def check_cut_off(scene, folder):
    """Checks the tables of a run that was cut off."""
    check_finite(folder / "stats.csv")
    check_energies(scene, read_stats(folder))


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
    if done.code is None and goes_on(folder / "out", done.seconds, program.ranks):
        check_cut_off(scene, folder / "out")
        return CUT_OFF
    check_end(done, (0, 3) if checked.code == 0 else (2,), "run")
    if done.code in (0, 3):
        check_result(scene, folder / "out")
        if twice:
            check_repeated(program, folder, name)
    return done.code
