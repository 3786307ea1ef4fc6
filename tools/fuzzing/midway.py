"""Runs that are killed before their end, and the same runs undisturbed."""
import time

from fuzzing.program import kill_session
from fuzzing.tables import Fault, same_stats

SCENE = """\
dimension = {dim}
[domain]
lower = {lower}
upper = {upper}
cell_size = {h}
[time]
end = {end}
frame_rate = {rate}
[liquid]
viscosity = {viscosity}
[[liquid.region]]
shape = "box"
lower = {lower}
upper = {surface}
{more}
[output]
checkpoint_every = {every}
"""
RIGID = '[[solid]]\nkind = "rigid"\ndensity = 500.0\nshape = "box"\nlower = {low}\nupper = {high}\n'
ELASTIC = ('[[solid]]\nkind = "elastic"\ndensity = 900.0\nshape = "box"\nlower = {low}\nupper = {high}\n'
           'element_size = 0.1\nmaterial = {{ youngs_modulus = 1e5, poisson_ratio = 0.3 }}\n')
PROBE = '[[probe]]\nkind = "pressure"\nposition = {place}\nevery = 0.011\n'
KINDS = {"liquid": "", "rigid": RIGID, "elastic": ELASTIC, "gas": "[gas]\ndensity = 100.0\n",
         "air": '[gas]\nbubbles = "volume_conserving"\n',
         "source": '[[liquid.source]]\nshape = "box"\nlower = {low}\nupper = {high}\n'}
RUN = ("run", "scene.toml", "--out", "out", "--overwrite")


def scene_text(rng):
    """A run of some tens of steps with many frames."""
    dim, kind = rng.choice([2, 2, 2, 3]), rng.choice(list(KINDS))
    cells, end = (16, 0.4) if dim == 2 else (8, 0.3)
    more = KINDS[kind].format(low=[0.6, 0.55, 0.4][:dim], high=[0.8, 0.75, 0.6][:dim]) + PROBE.format(place=[0.2] * dim)
    return kind, SCENE.format(dim=dim, lower=[0.0] * dim, upper=[1.0] * dim, h=1 / cells, end=end, more=more,
                              rate=rng.choice([50.0, 100.0]), viscosity=rng.choice([0.0, 0.0, 1.0]),
                              surface=[0.5, 0.5, 1.0][:dim], every=rng.choice([1, 2, 4]))


def steps_done(out):
    path = out / "stats.csv"
    return max(0, path.read_bytes().count(b"\n") - 2) if path.exists() else 0


def kill(process):
    """Kills a run and all its ranks at once, and returns when none is left."""
    kill_session(process.pid)
    process.wait()


def kill_after(bench, folder, words, steps=None, seconds=None, ranks=None):
    """Starts the program and kills it after a number of steps or seconds; True if it was still running."""
    process = bench.program.start(*words, "--threads", "1", folder=folder, ranks=ranks)
    started = time.monotonic()
    while process.poll() is None:
        if steps is not None and steps_done(folder / "out") >= steps:
            break
        if seconds is not None and time.monotonic() - started >= seconds:
            break
        if time.monotonic() - started > 8 * bench.program.cpu:
            kill(process)
            raise Fault("time", f"{words[0]} did not come to its step {steps}")
        time.sleep(0.002)
    alive = process.poll() is None
    kill(process)
    return alive


def unbroken(bench, folder, ranks=None):
    """The same scene without interruption; (folder of the run, seconds)."""
    done = bench.program.run("run", "scene.toml", "--out", "whole", "--threads", "1", folder=folder, ranks=ranks)
    if done.code != 0:
        raise Fault(f"code {done.code}", f"the run that nothing disturbs: {done.errors[-500:]}")
    return folder / "whole", done.seconds


def expect_same(whole, out, what):
    if not same_stats(whole, out):
        raise Fault("silent", f"{what}: stats.csv differs from that of the run that nothing disturbed")
    for name in ("solids.csv", "probes.csv"):
        if (whole / name).exists() and (whole / name).read_bytes() != (out / name).read_bytes():
            raise Fault("silent", f"{what}: {name} differs from that of the run that nothing disturbed")
