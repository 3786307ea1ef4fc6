"""Mode `kills`: SIGKILL at random moments, then resume. The tables must equal those of an unbroken run bit for bit."""
import os
import pathlib
import signal
import time

from fuzzing.midway import RUN, expect_same, kill, scene_text, unbroken
from fuzzing.tables import Fault

MOST_KILLS = 3


def prepare(bench):
    return {"alive": 0}


def children(pid):
    found = []
    for thread in pathlib.Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            found += map(int, thread.read_text().split())
        except (FileNotFoundError, ProcessLookupError):
            pass
    return found


def strike(rng, process, ranks):
    """Kills the whole job, or one of its ranks, whose death `mpirun` must propagate."""
    own = children(process.pid) if ranks > 1 else []
    if not own or rng.random() < 0.5:
        return kill(process)
    try:
        os.kill(rng.choice(own), signal.SIGKILL)
    except ProcessLookupError:
        pass
    until = time.monotonic() + 60
    while process.poll() is None and time.monotonic() < until:
        time.sleep(0.01)
    late = process.poll() is None
    kill(process)
    if late:
        raise Fault("time", "the job did not end within 60 s of the death of a rank")


def next_words(out):
    """A run killed before its first checkpoint must start anew."""
    return ("resume", "out") if any(out.glob("checkpoints/*/COMMIT")) else RUN


def attempt(bench, index, folder):
    rng = bench.random(index)
    ranks = max(bench.options.ranks, rng.choice([1, 1, 2]))
    kind, text = scene_text(rng)
    (folder / "scene.toml").write_text(text)
    whole, seconds = unbroken(bench, folder, ranks)
    out, what, struck = folder / "out", f"{kind}, {ranks} ranks", 0
    for _ in range(rng.randint(1, MOST_KILLS)):
        words = next_words(out)
        process = bench.program.start(*words, "--threads", "1", folder=folder, ranks=ranks)
        until = time.monotonic() + rng.uniform(0, 1.1) * seconds
        while process.poll() is None and time.monotonic() < until:
            time.sleep(0.001)
        struck += process.poll() is None
        strike(rng, process, ranks)
        what += f", killed in {words[0]} of {seconds:.1f} s"
    words = next_words(out)
    done = bench.program.run(*words, "--threads", "1", folder=folder, ranks=ranks)
    if done.code != 0:
        raise Fault(f"code {done.code}", f"{what}; then {words[0]}: {done.errors[-500:]}")
    expect_same(whole, out, what)
    bench.things["alive"] += struck
    return "the same"


def remarks(bench):
    yield f"{bench.things['alive']} kills hit a run that was going on"
