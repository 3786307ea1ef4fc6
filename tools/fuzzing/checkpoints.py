"""Mode `checkpoints`: damages a killed run and resumes it. Resume must refuse, warn, or be right to the last bit."""
import shutil
import threading

from fuzzing.damage import damage
from fuzzing.midway import RUN, expect_same, kill_after, scene_text, steps_done, unbroken
from fuzzing.oracle import check_end
from fuzzing.tables import Fault

COPIES = 8       # damaged copies of one killed run
MOST_KILLS = 40  # until a kill leaves two checkpoints and remaining steps
OTHERS = ("scene.toml", "stats.csv", "solids.csv", "probes.csv", "log.txt", "summary.json")


def prepare(bench):
    return {"runs": {}, "lock": threading.Lock()}


def killed_run(bench, number):
    """Killed run for cases of this number: stopped at a random step with a checkpoint and remaining steps."""
    with bench.things["lock"]:
        if number not in bench.things["runs"]:
            bench.things["runs"][number] = kill_a_run(bench, number)
        return bench.things["runs"][number]


def kill_a_run(bench, number):
    rng = bench.random(f"run {number}")
    folder = bench.folder / f"run{number}"
    folder.mkdir()
    kind, text = scene_text(rng)
    (folder / "scene.toml").write_text(text)
    whole, _ = unbroken(bench, folder)
    last = steps_done(whole)
    for _ in range(MOST_KILLS):
        kill_after(bench, folder, RUN, rng.randint(2, max(2, last - 5)))
        if len(list(folder.glob("out/checkpoints/*/COMMIT"))) > 1 and steps_done(folder / "out") < last:
            return kind, whole, folder / "out"
    raise RuntimeError(f"{kind}: no kill found the run with two checkpoints and steps to do")


def harm(rng, out):
    """Damages or removes one or two files; returns (description, True if a checkpoint was hit)."""
    checkpoints = sorted(p for p in out.glob("checkpoints/*/*"))
    newest = [p for p in checkpoints if p.parent == checkpoints[-1].parent]
    others = [out / name for name in OTHERS if (out / name).exists()]
    told = []
    for file in {rng.choice(rng.choice([newest, newest, checkpoints, others])) for _ in range(rng.choice([1, 1, 2]))}:
        if rng.random() < 0.1:
            file.unlink()
            how = "removal"
        else:
            how, data = damage(rng, file.read_bytes(), text=file.suffix in (".csv", ".toml", ".txt", ".json"))
            file.write_bytes(data)
        told.append(f"{how} of {file.relative_to(out)}")
    return ", ".join(sorted(told))


def attempt(bench, index, folder):
    rng = bench.random(index)
    kind, whole, killed = killed_run(bench, index // COPIES)
    out = folder / "out"
    shutil.copytree(killed, out)
    what = f"{kind}: {harm(rng, out)}"
    (folder / "damage.txt").write_text(what + "\n")
    shutil.copytree(out, folder / "damaged")
    for verb in ("info", "resume"):
        done = bench.program.run(verb, "out", *(("--threads", "1") if verb == "resume" else ()), folder=folder)
        check_end(done, (0, 2, 6), f"{verb} ({what})")
    if done.code != 0:
        return "refused"
    try:
        expect_same(whole, out, what)
    except Fault:
        if "warning" not in done.said:
            raise
        return "resumed, not the same, and told"
    return "resumed, the same" + (", told" if "warning" in done.said else "")


def remarks(bench):
    return []
