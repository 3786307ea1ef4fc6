"""Random scenes on tiny grids, made from every key of the registry."""
import math
import random

from fuzzing import shapes
from fuzzing.forces import make_contacts, make_forces
from fuzzing.joints import make_joints
from fuzzing.robots import make_robots
from fuzzing.shapes import AXES, fit_shape, number, point
from fuzzing.values import VALUES, table_of

# Keys that the plan of a scene sets: dimension, grid and duration.
PLANNED = {("", "dimension"), ("", "include"), ("", "parameters"), ("", "signals"), ("", "curves"), ("", "domain"), ("", "time"), ("", "liquid"), ("", "gas"), ("", "solid"),
           ("", "joint"), ("", "robot"), ("", "force"), ("", "contact"), ("", "probe"), ("", "tracking"), ("", "solver"), ("", "output"), ("domain", "lower"), ("domain", "upper"),
           ("domain", "cell_size"), ("liquid", "volume"), ("liquid", "spray"), ("time", "end"), ("time", "frame_rate"),
           *(("domain.boundary", f"{a}_{end}") for a in AXES for end in ("lower", "upper"))}
SHAPES = ("liquid.region[]", "liquid.source[]", "liquid.drain[]", "solid[]", "solid[].pinned", "solid[].traction")
MAKEABLE = {*shapes.GEOMETRY}


def uncovered(registry):
    """Keys without a generator: a new key of the program needs one."""
    for table, keys in registry.items():
        for key in keys:
            simple = key.choices or key.kind == "true or false"
            is_shape = table in SHAPES and key.name in shapes.KEYS
            if table in SHAPES and key.name == "shape" and set(key.choices) - MAKEABLE:
                yield f"{key.label}: {', '.join(set(key.choices) - MAKEABLE)}"
            turn = table.endswith(".rotate") and key.name in ("axis", "degrees", "euler", "quaternion")
            mechanic = table.startswith(("joint[]", "robot[]", "force[]", "contact[]"))   # joints.py, robots.py, forces.py
            copies = table.endswith((".waves", ".array", ".scatter"))   # left out: see VALUES
            if not (simple or mechanic or copies or is_shape or turn or (table, key.name) in VALUES or (table, key.name) in PLANNED):
                yield key.label


SIZES = ("0.05", "0.0625", "0.01", "1", "30", "0.0005")   # cell sizes, m


class Case:
    """A random scene under construction: grid, scales, and positions of its objects."""

    def __init__(self, registry, rng):
        self.registry, self.rng, self.used = registry, rng, set()
        self.dim = rng.choice([2, 2, 3])
        self.often = rng.choice([0.1, 0.3, 0.5])   # probability of an optional key
        most = 20 if self.dim == 2 else 8
        self.cells = [rng.randint(6 if self.dim == 2 else 4, most) for _ in range(self.dim)]
        self.h = float(rng.choice(SIZES))
        self.lower = [number(self.h * rng.choice([0, 0, -3, 7.5])) for _ in range(self.dim)]
        self.extent = [n * self.h for n in self.cells]
        self.upper = [l + e for l, e in zip(self.lower, self.extent)]
        self.length = min(self.extent)
        self.acceleration = rng.choice([9.81, 9.81, 9.81, 0.0, 1.5])
        self.speed = number(math.sqrt((self.acceleration or 1.0) * self.length))
        self.end = number(rng.uniform(1.5, 6) * self.h / self.speed)
        self.density_scale = rng.choice([1000.0, 1000.0, 1.0, 13600.0])
        self.pressure = self.density_scale * self.speed ** 2
        self.prescribes = rng.random() < 0.04
        self.has_gas = not self.prescribes and rng.random() < 0.3
        self.has_waves = False   # at sides: gravity lies along y then
        self.periodic, self.bodies, self.followed = [], [], {}

    def use(self, table, name, value=None):
        self.used.add((table, name, value))

    def use_shape(self, table, shape):
        for key in shape:
            self.use(table, key, shape[key] if key == "shape" else None)

    def choices(self, table, name):
        return next(key.choices for key in self.registry[table] if key.name == name)

    def value(self, key, here):
        make = VALUES.get((key.table, key.name))
        if make:
            return make(self, here)
        if key.takes_many:
            return [w for w in key.choices if self.rng.random() < 0.5] or [key.choices[0]]
        return self.rng.choice(key.choices or [True, False])

    def fill(self, table, here):
        """Adds keys of the table to `here`; deciding keys come first."""
        for key in sorted(self.registry[table], key=lambda k: (k.table, k.name) in LAST):
            made_by_shape = table in SHAPES and key.name in shapes.KEYS and (table, key.name) not in VALUES
            if key.name in here or made_by_shape or (table, key.name) in PLANNED or not key.applies(here):
                continue
            if not key.required and self.rng.random() > self.often and (table, key.name) not in ALWAYS:
                continue
            value = self.value(key, here)
            if value is not None:
                here[key.name] = value
                for word in (value if key.takes_many else [value if key.choices else None]):
                    self.use(table, key.name, word)


# Keys whose values depend on keys further down.
LAST = {("probe[]", "position")}
# Keys with generators that decide themselves whether to omit the key.
ALWAYS = {("probe[]", "position"), ("solid[]", "fixed"), ("solid[]", "density"), ("solid[]", "pinned"), ("liquid", "region"), ("", "gravity"),
          ("liquid", "prescribed_velocity"), ("liquid", "density"), ("domain", "boundary"),
          *((f"{t}.motion.rotate", key) for t in ("solid[]", "solid[].pinned", "liquid.source[]", "liquid.drain[]")
            for key in ("axis", "center"))}


def slots(c):
    """Positions for up to three solids side by side along the longest axis, and the radius available to each."""
    count = c.rng.choice([0, 1, 1, 2, 3]) if not c.prescribes else 0
    count = min(count, max(c.cells) // 4)
    along = c.extent.index(max(c.extent))
    width = c.extent[along] / max(count, 1)
    radius = 0.5 * min(0.8 * width, 0.8 * c.length)
    for n in range(count):
        center = [l + e * c.rng.uniform(0.45, 0.55) for l, e in zip(c.lower, c.extent)]
        center[along] = c.lower[along] + (n + 0.5) * width
        yield center, radius * c.rng.choice([0.4, 0.6, 0.8, 1.15])   # the last one almost touches


def solid(c, center, radius):
    c.slot, c.radius = center, radius
    here = {"kind": c.rng.choice(c.choices("solid[]", "kind"))}
    c.use("solid[]", "kind", here["kind"])
    if c.rng.random() < 0.9 or here["kind"] == "elastic":
        here = {"name": VALUES["solid[]", "name"](c, here), **here}
    elastic = here["kind"] == "elastic"
    kinds = [k for k in c.choices("solid[]", "shape") if k != "polygon" or c.dim == 2]
    if here["kind"] != "static":
        kinds = [k for k in kinds if k not in ("plane", "height_map")]
    files = [f"block{c.dim}.{e}" for e in ("msh", "mesh", "vtu")] if elastic else []
    files += shapes.SURFACES[c.dim]
    if here["kind"] == "deforming":
        kinds, files = ["mesh"], [shapes.FIRST_BEAT[c.dim]]
    kind = c.rng.choice(kinds)
    shape = fit_shape(c.rng, c.dim, kind, center, radius, files)
    if kind == "plane":   # at a corner of the domain, since in the middle it would cut into other solids
        at = point(l + 0.1 * e for l, e in zip(c.lower, c.extent))
        shape = {"shape": "plane", "point": at, "normal": [1.0] * c.dim}
    if kind == "height_map":   # the lowest tenth of the domain, likewise
        top = [u if a != 1 else l + 0.1 * e for a, (l, u, e) in enumerate(zip(c.lower, c.upper, c.extent))]
        shape = {"shape": kind, "file": f"hills{c.dim}.png", "lower": point(c.lower), "upper": point(top), "up": "y"}
    c.use_shape("solid[]", shape)
    here.update(shape)
    own_elements = str(here.get("file", "")).startswith("block")
    if own_elements:
        here["element_size"] = None
    elif elastic:
        here["element_size"] = VALUES["solid[]", "element_size"](c, here)
        c.use("solid[]", "element_size")
    c.fill("solid[]", here)
    if elastic and c.rng.random() < 0.9 and kind not in ("mesh", "polygon"):
        c.followed[here["name"]] = center
    c.bodies.append(here)
    return {key: value for key, value in here.items() if value is not None}


def container(c):
    """Sometimes an inverted static ball or box around everything else."""
    middle = [l + e / 2 for l, e in zip(c.lower, c.extent)]
    kind = c.rng.choice(["sphere", "box", "expression"])
    shape = fit_shape(c.rng, c.dim, kind, middle, 0.75 * max(c.extent))
    c.use("solid[]", "invert")
    return {"name": "vessel", "kind": "static", **shape, "invert": True}


def within(c):
    """A place in the domain."""
    return point(l + e * c.rng.uniform(0.05, 0.95) for l, e in zip(c.lower, c.extent))


def points(c, kind):
    """Keys of a probe at several points, or of its box."""
    low, high = within(c), within(c)
    if kind in ("flux", "volume"):
        low, high = [min(p) for p in zip(low, high)], [max(p) for p in zip(low, high)]
        high = [b if b > a else a + c.h for a, b in zip(low, high)]
        if kind == "flux":
            axis = c.rng.randrange(c.dim)
            high[axis] = low[axis]
        return {"lower": low, "upper": high}
    if kind not in ("pressure", "velocity", "surface_height") or c.rng.random() < 0.6:
        return {}
    if c.rng.random() < 0.5:
        return {"from": low, "to": high, "count": c.rng.randint(2, 5)}
    middle = [0.5 * (a + b) for a, b in zip(low, high)]
    half = [number(0.4 * (b - a)) for a, b in zip(low, high)]
    edges = [[half[0], *[0.0] * (c.dim - 1)], [0.0, half[1], *[0.0] * (c.dim - 2)]]
    return {"corner": point(m - h / 2 for m, h in zip(middle, half)), "edge_a": edges[0], "edge_b": edges[1],
            "counts": [c.rng.randint(2, 3), 2]}


def probes(c):
    found = []
    for _ in range(c.rng.choice([0, 0, 1, 3])):
        kinds = [k for k in c.choices("probe[]", "kind") if k != "displacement" or c.followed]
        here = {"kind": c.rng.choice(kinds)}
        c.use("probe[]", "kind", here["kind"])
        for key, value in points(c, here["kind"]).items():
            here[key] = value
            c.use("probe[]", key)
        c.fill("probe[]", here)
        found.append(here)
    return found


def probe_joint(c, probe, joints, solids):
    """Gives a joint probe a joint. False if there is none, or no solid whose loads are summed."""
    if probe["kind"] in ("force", "torque"):
        return bool(solids)
    if probe["kind"] == "joint":
        if not joints:
            return False
        one = c.rng.choice(joints)
        probe["joint"] = one["name"]
        if one["kind"] not in ("hinge", "slider", "cylindrical", "distance", "rope") and "quantity" in probe:
            del probe["quantity"]
    return True


def make_scene(registry, rng: random.Random):
    """(scene, used keys and words of the registry, the Case)."""
    c = Case(registry, rng)
    scene = {"dimension": c.dim}
    domain = {"lower": point(c.lower), "cell_size": c.h}
    domain["upper"] = [number(l + e) for l, e in zip(domain["lower"], c.extent)]
    if not c.prescribes:
        c.fill("domain", domain)
    frames = rng.randint(1, 3)
    scene.update({"domain": domain, "time": {"end": c.end, "frame_rate": number(frames / c.end)}})
    c.fill("", scene)
    c.fill("time", scene["time"])
    scene["liquid"] = table_of("liquid")(c, None)
    if c.has_gas:
        scene["gas"] = table_of("gas")(c, None)
    places = list(slots(c))
    scene["solid"] = [solid(c, center, radius) for center, radius in places]
    if not scene["solid"] and not c.prescribes and rng.random() < 0.1:
        scene["solid"] = [container(c)]
    found = probes(c)
    mechanics = random.Random(str(scene["solid"]))   # joints leave all other choices as they were
    c.rng, usual = mechanics, c.rng
    if places and not c.periodic:
        c.radius = max(radius for _, radius in places)
        scene["joint"] = make_joints(c, scene["solid"], [center for center, _ in places])
        if c.dim == 3 and not scene["joint"] and mechanics.random() < 0.3:
            scene["solid"].pop()
            scene["robot"] = make_robots(c, places[-1][0])
    scene["force"], scene["contact"] = make_forces(c, scene["solid"]), make_contacts(c, scene["solid"])
    names = [None] + [s.get("name") for s in scene["solid"]]
    scene["probe"] = [p for p in found if probe_joint(c, p, scene.get("joint"), scene["solid"]) and p.get("solid") in names]
    c.rng = usual
    for table in ("tracking", "solver", "output"):
        if rng.random() < 0.5:
            scene[table] = table_of(table)(c, None)
    choose_volume(c, scene)
    return {key: value for key, value in scene.items() if value not in ([], {})}, c


def is_thick(c, solid):
    """Solids beside which volumes in cells work: surely thicker than a cell."""
    least = 2 * c.h
    thick = (solid.get("invert") or solid.get("radius", 0) > least
             or ("upper" in solid and min(u - l for u, l in zip(solid["upper"], solid["lower"])) > 2 * least))
    return thick and "scale" not in solid


def choose_volume(c, scene):
    """How the liquid is kept: by cells only where nothing in the scene stands against it."""
    liquid = scene["liquid"]
    against = not all(is_thick(c, s) for s in scene["solid"])
    words = [w for w in c.choices("liquid", "volume") if not (w == "cells" and against)]
    if against and c.rng.random() < 0.9:
        return
    liquid["volume"] = c.rng.choice(words if against else [*words, "cells", "cells"])
    c.use("liquid", "volume", liquid["volume"])
    flows = c.has_gas and scene["gas"].get("bubbles", "resolved") == "resolved"
    if liquid["volume"] == "cells" and not flows and not c.prescribes and c.rng.random() < 0.4:
        liquid["spray"] = c.rng.random() < 0.3
        c.use("liquid", "spray")
