"""Random shapes that fit into a ball: all shapes and transformations of the registry, in 2D and 3D."""
import math

AXES = "xyz"
GEOMETRY = {"box": ("lower", "upper"), "sphere": ("center", "radius"), "cylinder": ("from", "to", "radius"),
            "capsule": ("from", "to", "radius"), "plane": ("point", "normal"), "mesh": ("file",), "polygon": ("points",),
            "expression": ("phi",), "level_set": ("file",), "height_map": ("lower", "upper", "file", "up")}
TRANSFORM = ("invert", "scale", "rotate", "translate")
KEYS = {"shape", *TRANSFORM, *(key for keys in GEOMETRY.values() for key in keys)}
SURFACES = {2: ("ring2.csv", "ring2.obj"), 3: ("ball.obj", "ball.ply", "ball.stl")}
BEATS = 5   # meshes of a sequence
FIRST_BEAT = {2: "beat2.0.csv", 3: "beat.0.obj"}


def unit_vector(rng, dim):
    v = [rng.gauss(0, 1) for _ in range(dim)]
    length = math.sqrt(sum(x * x for x in v)) or 1.0
    return [x / length for x in v]


def number(x):
    """Rounds to six digits, as people write."""
    return float(f"{x:.6g}")


def point(values):
    return [number(v) for v in values]


def box(rng, dim, center, r):
    half = [r / math.sqrt(dim) * rng.uniform(0.5, 1.0) for _ in range(dim)]
    return {"lower": point(c - a for c, a in zip(center, half)), "upper": point(c + a for c, a in zip(center, half))}


def ball(rng, dim, center, r):
    return {"center": point(center), "radius": number(r * rng.uniform(0.7, 1.0))}


def rod(rng, dim, center, r):
    along, half, radius = unit_vector(rng, dim), 0.6 * r, 0.4 * r * rng.uniform(0.7, 1.0)
    return {"from": point(c - half * a for c, a in zip(center, along)),
            "to": point(c + half * a for c, a in zip(center, along)), "radius": number(radius)}


def plane(rng, dim, center, r):
    return {"point": point(center), "normal": point(unit_vector(rng, dim))}


def formula(rng, dim, center, r):
    away = [f"({AXES[a]}-({number(center[a])!r}))" for a in range(dim)]
    squares = "+".join(f"{x}^2" for x in away)
    half = number(0.6 * r)
    return {"phi": rng.choice([f"sqrt({squares})-{number(r)!r}", f"{squares}-{number(r * r)!r}",
                               "max(" + ", ".join(f"abs({x})-{half!r}" for x in away) + ")",
                               f"sqrt({squares})-{number(0.8 * r)!r}*(1+0.2*sin(3*atan2({away[1]},{away[0]})))"])}


def height_map(rng, dim, center, r):
    """A surface through the center, up to half of r high."""
    up = rng.randrange(dim)
    wide = [2 * r if a != up else 0.5 * r for a in range(dim)]
    return {"file": f"hills{dim}.png",
            "lower": point(c - w for c, w in zip(center, wide)), "upper": point(c + w for c, w in zip(center, wide)),
            "up": rng.choice(["", "-"]) + AXES[up]}


def polygon(rng, dim, center, r):
    """A star about the center: corners at rising angles, from half of r to r away."""
    count = rng.randint(3, 9)
    turns = [2 * math.pi * (n + rng.uniform(0, 0.5)) / count for n in range(count)]
    away = [r * rng.uniform(0.5, 1.0) for _ in range(count)]
    corners = [point((center[0] + d * math.cos(t), center[1] + d * math.sin(t))) for d, t in zip(away, turns)]
    return {"points": corners[::rng.choice((1, -1))]}


MAKERS = {"polygon": polygon, "box": box, "sphere": ball, "cylinder": rod, "capsule": rod, "plane": plane, "expression": formula,
          "height_map": height_map}


def rotation(rng, dim, degrees):
    if rng.random() < 0.2:
        return {"euler": [0.0] * (2 if dim == 2 else 0) + [degrees] * (1 if dim == 2 else 3)}
    if rng.random() < 0.1:
        return {"quaternion": [1.0, *([0.0, 0.0] if dim == 2 else [0.3, -0.2]), 0.5]}
    turn = {"degrees": degrees}
    if dim == 3:
        turn["axis"] = point(unit_vector(rng, 3))
    elif rng.random() < 0.3:
        turn["axis"] = [0.0, 0.0, 1.0]
    return turn


def from_file(rng, dim, kind, center, r, files):
    """Bodies from files have size 1 about the origin (balls of radius 0.8, blocks with corners at 0.7)."""
    if kind == "level_set":
        name = f"ball{dim}.vdb"
    else:
        name = rng.choice([f for f in files if f in SURFACES[dim] or f.startswith("beat") or f"block{dim}" in f])
    return {"shape": kind, "file": name, "scale": number(0.8 * r),
            "rotate": rotation(rng, dim, rng.choice([0, 30, 200])), "translate": point(center)}


def fit_shape(rng, dim, kind, center, r, files=()):
    """A shape of that kind within r of the center; `files`: names for meshes."""
    if kind in ("mesh", "level_set"):
        return from_file(rng, dim, kind, center, r, files)
    if rng.random() < 0.6:
        return {"shape": kind, **MAKERS[kind](rng, dim, center, r)}
    scale = rng.choice([0.001, 0.5, 2.0, 1000.0])
    shape = {"shape": kind, **MAKERS[kind](rng, dim, [0.0] * dim, r / scale), "scale": scale}
    if rng.random() < 0.7:
        shape["rotate"] = rotation(rng, dim, rng.choice([0.0, 45.0, -30, rng.uniform(-360, 360)]))
    return {**shape, "translate": point(center)}
