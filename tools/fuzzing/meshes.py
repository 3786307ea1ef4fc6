"""Mode `meshes`: broken or unusual mesh files. `check` and `run` must report them in bounded time."""
import math

from fuzzing.assets import make_assets, obj, ply, stl, surface
from fuzzing.damage import damage
from fuzzing.oracle import check_end, check_result
from fuzzing.tables import Fault

SECONDS = 20   # processor time limit of a check
WRITERS = {"obj": obj, "ply": ply, "stl": stl}


def prepare(bench):
    return make_assets(bench.program, bench.folder)


def spike(rng, points, triangles):
    points = [list(p) for p in points]
    points[rng.randrange(len(points))] = [rng.choice([1.01, 3.0, 1e3, 1e7, -1e15]) * v for v in points[0]]
    return points, triangles


def move_point(rng, points, triangles):
    points = [list(p) for p in points]
    points[rng.randrange(len(points))] = list(points[rng.randrange(len(points))])
    return points, triangles


def jitter(rng, points, triangles):
    size = rng.choice([1e-12, 0.01, 0.1, 1.0])
    return [[v + size * rng.gauss(0, 1) for v in p] for p in points], triangles


def change_triangles(rng, points, triangles):
    triangles, n = list(triangles), rng.randrange(len(triangles))
    what = rng.choice(["drop", "flip", "twice", "flat", "index"])
    a, b, c = triangles[n]
    if what == "drop":
        del triangles[n]
    elif what == "twice":
        triangles.append(triangles[n])
    else:
        triangles[n] = {"flip": (a, c, b), "flat": (a, b, b), "index": (a, b, rng.randrange(len(points)))}[what]
    return points, triangles


def resize(rng, points, triangles):
    factor = rng.choice([1e-9, 1e-3, 25.4, 1000, 1e6, 1e12, -1])
    return [[factor * v for v in p] for p in points], triangles


def shift(rng, points, triangles):
    by = rng.choice([1e-7, 0.3, 5.0, 1e6, 1e12])
    return [[v + by for v in p] for p in points], triangles


def fan(rng, points, triangles):
    """A cone with very many triangles at one point."""
    n = rng.choice([10, 300, 1000])
    rim = [[math.cos(2 * math.pi * i / n), -0.7, math.sin(2 * math.pi * i / n)] for i in range(n)]
    sides = [(i, (i + 1) % n, n) for i in range(n)]
    return (rim + [[0.0, 0.9, 0.0], [0.0, -0.7, 0.0]],
            [(b, a, c) for a, b, c in sides] + [(i, (i + 1) % n, n + 1) for i in range(n)])


def fine(rng, points, triangles):
    return surface(rng.choice([12, 24]))


def two_bodies(rng, points, triangles):
    """Adds a second body: apart, touching or inside."""
    by, factor = rng.choice([(5, 1), (1.8, 1), (0.3, 1), (0, 0.5), (0, 1)])
    more = [[factor * v + by for v in p] for p in points]
    return [*points, *more], [*triangles, *([n + len(points) for n in t] for t in triangles)]


GEOMETRY = (spike, move_point, jitter, change_triangles, resize, shift, fan, fine, two_bodies)

SCENE = """\
dimension = {dim}
[domain]
lower = {lower}
upper = {upper}
cell_size = 0.25
[time]
end = 0.05
frame_rate = 40.0
[[liquid.region]]
shape = "box"
lower = {lower}
upper = {surface}
{use}shape = "{shape}"
file = "{file}"
{keys}
"""
USES = {"region": ("[[liquid.region]]\n", ""), "static": ('[[solid]]\nkind = "static"\n', ""),
        "rigid": ('[[solid]]\nkind = "rigid"\n', "density = 500.0"),
        "elastic": ('[[solid]]\nkind = "elastic"\n',
                    "density = 500.0\nmaterial = { youngs_modulus = 1e5, poisson_ratio = 0.3 }")}


def make_file(bench, rng):
    """(name, bytes, description of the change)."""
    name = rng.choice([n for n in bench.things])
    ending = name.split(".")[-1]
    if ending in WRITERS and "2." not in name and rng.random() < 0.5:
        way = rng.choice(GEOMETRY)
        points, triangles = way(rng, *surface())
        return name, WRITERS[ending](points, triangles), way.__name__
    done, data = damage(rng, bench.things[name], text=ending not in ("stl", "vdb"))
    return name, data, done


def attempt(bench, index, folder):
    rng = bench.random(index)
    name, data, done = make_file(bench, rng)
    elements, dim = name.startswith("block"), 2 if "2." in name else 3
    use = "elastic" if elements else rng.choice(list(USES))
    start, keys = USES[use]
    if use == "elastic" and not elements:
        keys += "\nelement_size = 0.4"
    (folder / name).write_bytes(data)
    (folder / "scene.toml").write_text(SCENE.format(
        dim=dim, lower=[-1.5] * dim, upper=[1.5] * dim, surface=[1.5, 0.0, 1.5][:dim], use=start, file=name, keys=keys,
        shape="level_set" if name.endswith("vdb") else "mesh"))
    (folder / "damage.txt").write_text(done + "\n")
    checked = bench.program.run("check", "scene.toml", folder=folder, ranks=1)
    check_end(checked, (0, 2), f"check ({done} of {name}, {use})")
    if checked.cpu > SECONDS and not bench.program.sanitized:
        raise Fault("slow", f"check took {checked.cpu:.0f} s of processor time ({done} of {name}, {use})")
    if checked.code == 2:
        return "refused"
    ran = bench.program.run("run", "scene.toml", "--out", "out", "--threads", "1", folder=folder)
    check_end(ran, (0, 3), f"run ({done} of {name}, {use})")
    if ran.code == 0:
        check_result({"domain": {"cell_size": 0.25}, "dimension": dim}, folder / "out", energy=False)
    return "done" if ran.code == 0 else "stopped with figures"


def remarks(bench):
    return []
