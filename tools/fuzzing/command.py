"""The command line of tools/fuzz: modes, counts, and what is kept of a failure."""
import argparse
import collections
import concurrent.futures
import pathlib
import random
import shutil
import sys
import tempfile
import time

from fuzzing import checkpoints, frames, kills, meshes, scene_mode
from fuzzing.program import Program
from fuzzing.registry import read_registry
from fuzzing.scenes import uncovered
from fuzzing.tables import Fault

MODES = {"scenes": scene_mode, "meshes": meshes, "frames": frames, "checkpoints": checkpoints, "kills": kills}
# Shares of the modes in the count of mode `all`.
SHARES = {"scenes": 0.55, "meshes": 0.2, "frames": 0.15, "checkpoints": 0.05, "kills": 0.05}


class Bench:
    """Shared by the cases of a mode: program, options, scratch folder and the mode's own data."""

    def __init__(self, mode, options, scratch):
        self.mode, self.options = mode, options
        self.folder = scratch / mode
        self.folder.mkdir()
        self.program = Program(options.seiche, scratch, options.ranks, options.cpu)
        self.things = MODES[mode].prepare(self)

    def random(self, index):
        return random.Random(f"{self.mode}:{self.options.seed}:{index}")

    def attempt(self, index):
        """(outcome, fault or None); keeps a failed case, shrunk if the mode supports it."""
        folder = self.folder / str(index)
        folder.mkdir()
        fault = None
        try:
            outcome = MODES[self.mode].attempt(self, index, folder)
        except Fault as found:
            outcome, fault = "failed", found
            if hasattr(MODES[self.mode], "shrink") and not self.options.no_shrink:
                MODES[self.mode].shrink(self, index, folder, found)
            if self.options.keep:
                kept = pathlib.Path(self.options.keep) / f"{self.mode}-{self.options.seed}-{index}"
                shutil.copytree(folder, kept, dirs_exist_ok=True, symlinks=True)
        shutil.rmtree(folder, ignore_errors=True)
        return outcome, fault


def run_mode(mode, count, options, scratch):
    """Runs the cases of a mode; returns the number of failures."""
    bench, started, outcomes = Bench(mode, options, scratch), time.monotonic(), collections.Counter()
    indices = [options.only] if options.only is not None else range(options.first, options.first + count)
    in_time = lambda: not options.seconds or time.monotonic() - started < options.seconds  # noqa: E731

    def one(index):
        return (index, *bench.attempt(index)) if in_time() else (index, "left out", None)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for index, outcome, fault in pool.map(one, indices):
            outcomes[outcome] += 1
            if fault:
                print(f"FAILED {mode} --seed {options.seed} --only {index}: {fault}", flush=True)
            elif options.verbose:
                print(f"{mode} {index}: {outcome}", flush=True)
    left_out = outcomes.pop("left out", 0)
    note = f", {left_out} left out for time" if left_out else ""
    print(f"{mode}: {sum(outcomes.values())} cases in {time.monotonic() - started:.0f} s: " +
          ", ".join(f"{n} {word}" for word, n in sorted(outcomes.items())) + note, flush=True)
    for line in MODES[mode].remarks(bench):
        print(f"{mode}: {line}", flush=True)
    return outcomes["failed"]


def parse(arguments):
    parser = argparse.ArgumentParser(prog="tools/fuzz", description=__doc__)
    parser.add_argument("mode", choices=[*MODES, "all"])
    parser.add_argument("--seiche", default="build/release/seiche", help="the program under test")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=100, help="cases; of all modes together with `all`")
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--only", type=int, help="this one case")
    parser.add_argument("--seconds", type=float, default=0, help="begins no case of a mode after so many seconds")
    parser.add_argument("--cpu", type=float, default=60, help="seconds of processor time that a run may take")
    parser.add_argument("--ranks", type=int, default=1, choices=[1, 2, 3])
    parser.add_argument("--jobs", type=int, default=1, help="cases at once")
    parser.add_argument("--keep", help="folder for the inputs of failures")
    parser.add_argument("--no-shrink", action="store_true", help="keep failing scenes as they are")
    parser.add_argument("--verbose", action="store_true", help="a line a case")
    return parser.parse_args(arguments)


def main(arguments):
    options = parse(arguments)
    missing = list(uncovered(read_registry()))
    if missing:
        sys.exit("no values for keys of docs/scene-reference.md; add them to tools/fuzzing/values.py:\n  " +
                 "\n  ".join(missing))
    shares = SHARES if options.mode == "all" else {options.mode: 1.0}
    with tempfile.TemporaryDirectory(prefix="seiche_fuzz_") as scratch:
        failures = sum(run_mode(mode, max(1, round(share * options.count)), options, pathlib.Path(scratch))
                       for mode, share in shares.items())
    print("fuzz: all clean" if not failures else f"fuzz: {failures} failed")
    return 1 if failures else 0
