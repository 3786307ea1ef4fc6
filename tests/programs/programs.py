"""Shared by the tests of other programs: a small run, other programs, pictures."""
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parent.parent
SHARE = TOP / "share"
sys.path[:0] = [str(SHARE / "common")]

import numpy  # noqa: E402

import seiche_run as runs  # noqa: E402


class Failure(Exception):
    """What a test found wrong."""


def expect(condition, message):
    """Fails with a message unless a condition holds."""
    if not condition:
        raise Failure(message)


def expect_near(found, wanted, tolerance, what):
    """Fails unless numbers agree."""
    difference = float(numpy.max(numpy.abs(numpy.asarray(found, float) - numpy.asarray(wanted, float))))
    expect(difference <= tolerance, f"{what}: {found} in place of {wanted}, off by {difference:.3g} > {tolerance:g}")


def need(program, package):
    """Path of a program; fails naming its Debian package if it is missing."""
    path = shutil.which(program)
    expect(path, f"{program} is missing: it is in the package {package} ([full] in packages.txt; ./check --full)")
    return path


def call(command, what, code=0):
    """Output of a program; fails with it unless the exit code is as wanted."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, errors="replace", check=False)
    text = done.stdout + done.stderr
    expect(done.returncode == code, f"{what}: code {done.returncode} in place of {code}\n{text[-3000:]}")
    return text


def small_run(seiche, work):
    """A new run of small.toml with its meshes and fields."""
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    call([seiche, "run", HERE / "small.toml", "--out", work / "small", "--quiet", "--threads", "1"], "the small run")
    for form in ("ply", "obj", "xdmf"):
        call([seiche, "export", work / "small", "--format", form], f"export to {form}")
    return runs.Run(work / "small")


def expect_picture(path):
    """Fails where a picture is missing or of one colour."""
    expect(path.is_file(), f"{path} was not written")
    done = subprocess.run([need("ffmpeg", "ffmpeg"), "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "gray",
                           "-"], capture_output=True, check=True)
    levels = numpy.frombuffer(done.stdout, numpy.uint8)
    expect(levels.std() > 8, f"{path} is blank: its levels spread by {levels.std():.1f} of 255")


def bounds(points):
    """Lowest and highest coordinates of points."""
    return numpy.concatenate([numpy.min(points, axis=0), numpy.max(points, axis=0)])


def open_edges(triangles):
    """Number of edges that do not have one triangle on each side."""
    edges = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    _, counts = numpy.unique(edges, axis=0, return_counts=True)
    return int((counts != 2).sum())


def main(test):
    """Runs a test(seiche, work folder) with the command line's arguments."""
    try:
        test(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
    except (Failure, runs.RunFault) as failure:
        sys.exit(f"FAILED: {failure}")
    print("passed")
