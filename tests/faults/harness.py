"""Helpers for tests of the built program: scenes, runs with or without mpirun, and readers of the output."""
import contextlib
import csv
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import numpy
import pyopenvdb

from read_frames import frame_faults, read_all

MPI_ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
                   "OMPI_MCA_mpi_yield_when_idle": "1"}
LONGEST_RUN = 180  # s; the slowest takes 30 s alone on two cores, and a busy machine is several times slower

DAM = """\
dimension = 2
[domain]
lower = [0.0, 0.0]
upper = [1.0, 0.5]
cell_size = 0.03125
[time]
end = 0.2
frame_rate = 20.0
[liquid]
density = 1000.0
viscosity = 0.0
[[liquid.region]]
shape = "box"
lower = [0.0, 0.0]
upper = [0.4, 0.3]
[[solid]]
name = "step"
kind = "static"
shape = "box"
lower = [0.6, 0.0]
upper = [0.7, 0.1]
[[probe]]
name = "p"
kind = "pressure"
position = [0.1, 0.05]
every = 0.02
[output]
checkpoint_every = 1
"""


class Failed(Exception):
    pass


def expect(condition, text):
    if not condition:
        raise Failed(text)


class Result:
    def __init__(self, process, output, errors, seconds):
        self.code, self.output, self.errors, self.seconds = process.returncode, output, errors, seconds

    def needs(self, code, *texts):
        """Requires the exit code, and texts that the program must have printed (on either stream)."""
        said = f"\n--- output\n{self.output}\n--- errors\n{self.errors}"
        expect(self.code == code, f"exit code {self.code}, not {code}{said}")
        for text in texts:
            expect(text in self.output + self.errors, f"'{text}' was not said{said}")
        own = [line for line in self.errors.splitlines() if line.startswith("seiche: ")]
        expect(len(own) == (0 if code in (0, 75, 124) else 1), f"{len(own)} error messages instead of one{said}")
        return self


class Bench:
    """A scratch folder and the program under test."""

    def __init__(self, program):
        self.program = str(pathlib.Path(program).resolve())
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="seiche_faults_"))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder, ignore_errors=True)

    def scene(self, text=DAM, name="scene.toml"):
        path = self.folder / name
        path.write_text(text)
        return path

    def start(self, *arguments, ranks=0, env=None, limits=None):
        command = [self.program, *map(str, arguments)]
        if ranks:
            command = ["mpirun", "--oversubscribe", "--allow-run-as-root", "-n", str(ranks)] + command
        environment = {**os.environ, **MPI_ENVIRONMENT, **(env or {})}
        return subprocess.Popen(command, cwd=self.folder, env=environment, text=True, preexec_fn=limits,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def finish(self, process, limit=LONGEST_RUN):
        started = time.monotonic()
        try:
            output, errors = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            process.kill()
            output, errors = process.communicate()
            raise Failed(f"did not end within {limit} s\n--- output\n{output}\n--- errors\n{errors}")
        return Result(process, output, errors, time.monotonic() - started)

    def run(self, *arguments, limit=LONGEST_RUN, **how):
        return self.finish(self.start(*arguments, **how), limit)

    def simulate(self, *options, text=DAM, out="out", **how):
        return self.run("run", self.scene(text), "--out", out, *options, **how)

    def path(self, name):
        return self.folder / name


def wait_for(condition, what, limit=LONGEST_RUN):
    """Waits until the condition holds; fails after `limit` seconds with a text that contains `what`."""
    until = time.monotonic() + limit
    while not condition():
        expect(time.monotonic() < until, f"waited {limit} s for {what}")
        time.sleep(0.01)


def lines_of(path):
    return path.read_text().splitlines() if path.exists() else []


def wait_for_steps(bench, out="out", steps=3):
    wait_for(lambda: len(lines_of(bench.path(out) / "stats.csv")) >= steps + 2, f"{steps} steps of {out}")


def root_process(bench, out="out"):
    """Process id of rank 0, from the run directory's lock."""
    return int((bench.path(out) / "lock").read_text())


def rank_processes(mpirun):
    """Process ids of the ranks, without threads that end meanwhile."""
    children = []
    for thread in pathlib.Path(f"/proc/{mpirun.pid}/task").glob("*/children"):
        with contextlib.suppress(FileNotFoundError, ProcessLookupError):
            children += thread.read_text().split()
    return sorted({int(child) for child in children})


def table(folder, name):
    """Rows of a table as dictionaries of texts."""
    with open(pathlib.Path(folder) / name, newline="") as file:
        return list(csv.DictReader(file))


def stats(folder, without=("wall_seconds",)):
    """Rows of stats.csv as dictionaries of texts, without the columns that differ between any two runs."""
    return [{k: v for k, v in row.items() if k not in without} for row in table(folder, "stats.csv")]


def summary(folder):
    return json.loads((pathlib.Path(folder) / "summary.json").read_text())


def frame_files(folder):
    return sorted((pathlib.Path(folder) / "frames").glob("frame.*.vdb"))


def frame_voxels(path):
    """Every grid of a frame by name, as a dense array over the domain."""
    grids, metadata = read_all(str(path))
    cells = [int(n) for n in metadata["cells"]]
    arrays = {}
    for grid in grids:
        shape = cells if not isinstance(grid, pyopenvdb.Vec3SGrid) else cells + [3]
        array = numpy.zeros(shape, dtype=numpy.float32)
        grid.copyToArray(array)
        arrays[grid.name] = array
    return arrays


def frames_are_good(folder, count=None):
    """Every frame under a final name is complete, finite and within the domain, by OpenVDB's own module."""
    files = frame_files(folder)
    if count is not None:
        expect(len(files) == count, f"{len(files)} frames, not {count}")
    for file in files:
        faults = frame_faults(str(file))
        expect(not faults, f"{file.name}: {faults}")


def same_frames(one, other):
    names = [file.name for file in frame_files(one)]
    expect(names == [file.name for file in frame_files(other)], "the two runs wrote different frames")
    for name in names:
        a, b = (frame_voxels(pathlib.Path(folder) / "frames" / name) for folder in (one, other))
        expect(a.keys() == b.keys(), f"{name}: different grids")
        for grid in a:
            expect(numpy.array_equal(a[grid], b[grid]), f"{name}: {grid} differs by {abs(a[grid] - b[grid]).max()}")


def same_tables(one, other):
    expect(stats(one) == stats(other), "stats.csv differs")
    for name in ("solids.csv", "probes.csv", *(["joints.csv"] if (pathlib.Path(one) / "joints.csv").exists() else [])):
        a, b = ((pathlib.Path(folder) / name).read_text() for folder in (one, other))
        expect(a == b, f"{name} differs")


def newest_checkpoint(folder):
    return max(p for p in (pathlib.Path(folder) / "checkpoints").iterdir() if (p / "COMMIT").exists())


def crc32c(data):
    """CRC-32C bit by bit: slow, and independent of the program's tables."""
    c = 0xFFFFFFFF
    for byte in data:
        c ^= byte
        for _ in range(8):
            c = c >> 1 ^ (0x82F63B78 if c & 1 else 0)
    return c ^ 0xFFFFFFFF


def recommit(checkpoint):
    """Updates COMMIT to match files that a test has changed on purpose."""
    head = (checkpoint / "COMMIT").read_text().splitlines()[:2]
    for file in sorted(checkpoint.glob("rank.*")):
        data = file.read_bytes()
        head.append(f"file {file.name} {len(data)} {crc32c(data):08x}")
    text = "\n".join(head) + "\n"
    (checkpoint / "COMMIT").write_text(text + f"crc32c {crc32c(text.encode()):08x}\n")


def run_table(tables, arguments):
    """Runs PROGRAM GROUP [CASE ...] with a new bench for each function of the group. Returns the number of failures."""
    if len(arguments) < 2 or arguments[1] not in tables:
        sys.exit(f"usage: PROGRAM GROUP [CASE ...]; groups: {', '.join(tables)}")
    program, group, chosen = arguments[0], arguments[1], arguments[2:]
    failures = 0
    for case in tables[group]:
        if chosen and case.__name__ not in chosen:
            continue
        started = time.monotonic()
        try:
            with Bench(program) as bench:
                note = case(bench)
            verdict = f"skipped: {note}" if note else "ok"
        except Failed as failure:
            failures += 1
            verdict = f"FAILED: {failure}"
        print(f"{case.__name__:45} {time.monotonic() - started:5.1f} s  {verdict}", flush=True)
    return failures
