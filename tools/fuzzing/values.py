"""Generators for every scene key that is not a choice of words, by table and key; None omits the key."""
import math

from fuzzing.shapes import AXES, BEATS, SURFACES, fit_shape, number, point, rotation, unit_vector
from fuzzing.sides import boundary, side_pressure, side_velocity, side_waves


def log_uniform(c, low, high):
    return number(low * (high / low) ** c.rng.random())


def spring_scale(c):
    """The stiffness with which liquid of the solid's size swings about once in the run, N/m."""
    return number(c.density_scale * c.radius ** c.dim / c.end ** 2)


def vector(c, size):
    return point(size * c.rng.random() * x for x in unit_vector(c.rng, c.dim))


def formulas_of_time(c, size):
    """A vector that is zero at t = 0."""
    wave = f"{number(size / c.dim)!r}*sin({number(c.rng.uniform(1, 6) / c.end)!r}*t)"
    return [c.rng.choice([wave, 0.0, "0"]) for _ in range(c.dim)]


def flow(c, size):
    """Numbers, or formulas in space and time."""
    if c.rng.random() < 0.6:
        return vector(c, size)
    x = f"({c.rng.choice(AXES[:c.dim])}-({number(c.lower[0])!r}))/{number(c.length)!r}"
    return [c.rng.choice([f"{number(size / c.dim)!r}*sin(6*{x})", f"{number(size / c.dim)!r}*cos(t/{c.end!r})", 0.0])
            for _ in range(c.dim)]


# --- top level, time -------------------------------------------------------------------------------------------------

def gravity(c, _):
    if c.has_waves:
        return [0.0, -c.acceleration] + [0.0] * (c.dim - 2)
    if c.acceleration == 0:
        return [0.0] * c.dim
    if c.rng.random() < 0.7:
        return [0.0, -c.acceleration] + [0.0] * (c.dim - 2)
    if c.rng.random() < 0.5:
        return point(c.acceleration * x for x in unit_vector(c.rng, c.dim))
    return [f"{c.acceleration / 2!r}*sin(t/{c.end!r})", f"-{c.acceleration / 2!r}"] + [0.0] * (c.dim - 2)


def fixed_step(c, _):
    return number(c.end / c.rng.randint(12, 40)) if c.rng.random() < 0.2 else None


# --- liquid and gas --------------------------------------------------------------------------------------------------

def density(c):
    return log_uniform(c, c.density_scale * 0.01, c.density_scale * 10)


def viscosity(c, here):
    if c.prescribes:
        return None
    value = c.density_scale * c.speed * c.length / log_uniform(c, 0.1, 1e5)
    if c.rng.random() < 0.7:
        return c.rng.choice([0.0, number(value), number(value)])
    return f"{number(value)!r}*(1.5+sin({c.rng.choice(AXES[:c.dim])}/{number(c.length)!r}))"


def surface_tension(c, _):
    if c.prescribes:
        return None
    return number(c.density_scale * c.h * c.speed ** 2 * log_uniform(c, 1e-3, 0.3))


def rheology(c, here):
    if "viscosity" in here or c.prescribes:
        return None
    table = {}
    c.fill("liquid.rheology", table)
    return table


def stress_scale(c):
    return c.density_scale * c.speed ** 2


def viscosity_scale(c):
    return stress_scale(c) * c.length / c.speed


def region_center(c):
    return [l + e * c.rng.uniform(0.1, 0.9) for l, e in zip(c.lower, c.extent)]


def pool(c):
    """Lower part of the domain, up to a random height."""
    upper = list(c.upper)
    upper[1] = c.lower[1] + c.extent[1] * c.rng.uniform(0.2, 1.0)
    return {"shape": "box", "lower": point(c.lower), "upper": point(upper)}


def random_shape(c, table, center, r, files=None):
    kind = c.rng.choice([k for k in c.choices(table, "shape") if k != "polygon" or c.dim == 2])
    shape = fit_shape(c.rng, c.dim, kind, center, r, files or SURFACES[c.dim])
    c.use_shape(table, shape)
    return shape


def regions(c, _):
    found = []
    for n in range(c.rng.choice([1, 1, 2, 3])):
        if n == 0 and c.rng.random() < 0.6:
            here = pool(c)
        elif c.rng.random() < 0.1:
            level = number(c.lower[1] + c.length / 3)
            here = {"shape": "expression", "phi": c.rng.choice([-1, "-1", f"y-({level!r})"])}
        else:
            here = random_shape(c, "liquid.region[]", region_center(c), c.length * c.rng.uniform(0.15, 0.4))
            if c.rng.random() < 0.1:
                here["invert"] = True
                c.use("liquid.region[]", "invert")
        c.fill("liquid.region[]", here)
        found.append(here)
    return found


def openings(c, table):
    """A source or a drain."""
    here = random_shape(c, table, region_center(c), c.length * c.rng.uniform(0.1, 0.2))
    if c.rng.random() < 0.05:
        here["invert"] = True
        c.use(table, "invert")
    c.slot, c.radius = region_center(c), 0.2 * c.length
    c.fill(table, here)
    if "rate" in here:
        here.pop("velocity", None)
    return [here]


def rate(c, _):
    """At most a tenth of a filled domain in a run; closed ones without a surface stop the run, which is right."""
    most = 0.02 * math.prod(c.extent) / c.end
    return None if c.prescribes else c.rng.choice([number(most), f"{number(most)!r}*(1+sin(t/{c.end!r}))"])


def sponges(c, _):
    """Along a side, or everywhere; from slow to stiff against a step."""
    if c.prescribes:
        return None
    here = {}
    c.fill("liquid.sponge[]", here)
    if c.rng.random() < 0.5:
        axis = c.rng.randrange(c.dim)
        here["side"] = f"{'xyz'[axis]}_{c.rng.choice(['lower', 'upper'])}"
        here["length"] = number(c.extent[axis] * c.rng.uniform(0.1, 1.5))
        for key in ("side", "length"):
            c.use("liquid.sponge[]", key, here[key] if key == "side" else None)
    return [here]


def prescribed(c, _):
    """Divergence-free velocity; only in scenes with liquid alone."""
    if not c.prescribes:
        return None
    s = number(c.speed / c.length)
    middle = [number(l + e / 2) for l, e in zip(c.lower, c.extent)]
    return c.rng.choice([[f"-{s!r}*(y-({middle[1]!r}))", f"{s!r}*(x-({middle[0]!r}))"] + [0.0] * (c.dim - 2),
                         vector(c, c.speed / 2), [f"{c.speed / 2!r}*cos(t/{c.end!r})", "0"] + ["0"] * (c.dim - 2)])


# --- solids and probes -----------------------------------------------------------------------------------------------

def motion(c, table, size):
    """Zero at t = 0, and at most of this size."""
    c.reach = size
    here = {}
    c.fill(table, here)
    return here


def motion_rotate(c, table):
    here = {}
    c.fill(table, here)
    return here


def motion_axis(c, _):
    return unit_vector(c.rng, 3) if c.dim == 3 else None


def angular_velocity(c, _):
    turn = c.rng.uniform(-1, 1) * c.speed / c.length
    return number(turn) if c.dim == 2 else point([turn, 0.0, turn])


def fixed(c, here):
    """Bodies must not cross periodic sides, and have no velocity along or about fixed axes."""
    turns = c.rng.choice([("rotation",), ("rotation_x", "rotation_y", "rotation_z") if c.dim == 3 else ()])
    names = {n for n in (*AXES[:c.dim], *turns) if c.rng.random() < 0.3} | set(c.periodic)
    if "velocity" in here:
        here["velocity"] = [0.0 if AXES[a] in names else v for a, v in enumerate(here["velocity"])]
    if any(n.startswith("rotation") for n in names):
        here.pop("angular_velocity", None)
    return sorted(names) or None


def pins(c, _):
    """One side of the body, or two opposite ones. Unpinned bodies must not occur with periodic sides."""
    if not c.periodic and c.rng.random() < 0.4:
        return None
    two, axis, found = c.rng.random() < 0.3, c.rng.randrange(c.dim), []
    for side_of in ((-1, 1) if two else (c.rng.choice([-1, 1]),)):
        center = list(c.slot)
        center[axis] += side_of * c.radius * (0.9 if two else 0.6)
        left_out = ("plane", "height_map") * two
        kinds = [k for k in c.choices("solid[].pinned", "shape") if k not in left_out and (k != "polygon" or c.dim == 2)]
        here = fit_shape(c.rng, c.dim, c.rng.choice(kinds), center, (0.8 if two else 1.4) * c.radius, SURFACES[c.dim])
        if here["shape"] == "plane" and "translate" not in here:
            here["point"] = point(c.slot)
        c.use_shape("solid[].pinned", here)
        c.fill("solid[].pinned", here)
        found.append(here)
    return found if two or c.rng.random() < 0.5 else found[0]


def tractions(c, _):
    here = random_shape(c, "solid[].traction", c.slot, 1.5 * c.radius)
    c.fill("solid[].traction", here)
    return c.rng.choice([here, [here]])


def table_of(name):
    def make(c, _):
        here = {}
        c.fill(name, here)
        return here
    return make


def probe_position(c, here):
    if here["kind"] == "displacement":
        return point(c.followed[here["solid"]])
    if "count" in here or "counts" in here:
        return None
    return point(l + e * c.rng.uniform(0.0, 1.0) for l, e in zip(c.lower, c.extent))


VALUES = {
    ("", "title"): lambda c, _: c.rng.choice(["", "fuzz", "Wässer \"7\" \\ ü", "a" * 300]),
    ("", "gravity"): gravity,
    ("domain", "boundary"): boundary,
    ("side", "waves"): side_waves,
    ("side", "velocity"): side_velocity,
    ("side", "pressure"): side_pressure,
    ("time", "cfl"): lambda c, _: number(c.rng.choice([0.3, 0.9, 1.0, 2.0, 4.0, c.rng.uniform(0.2, 8)])),
    ("time", "max_step"): lambda c, _: number(c.end / c.rng.randint(3, 20)),
    ("time", "fixed_step"): fixed_step,
    ("liquid", "density"): lambda c, _: c.density_scale,
    ("liquid", "viscosity"): viscosity,
    ("liquid", "surface_tension"): surface_tension,
    ("liquid", "contact_angle"): lambda c, _: number(c.rng.uniform(20, 160)),
    ("liquid", "rheology"): rheology,
    ("liquid", "velocity"): lambda c, _: None if c.prescribes else flow(c, 0.5 * c.speed),
    ("liquid", "prescribed_velocity"): prescribed,
    ("liquid", "separates"): lambda c, _: not c.has_gas and not c.prescribes and c.rng.random() < 0.3,
    ("liquid", "region"): regions,
    ("liquid", "source"): lambda c, _: openings(c, "liquid.source[]"),
    ("liquid", "drain"): lambda c, _: openings(c, "liquid.drain[]"),
    ("liquid.rheology", "viscosity_zero"): lambda c, _: number(viscosity_scale(c) * log_uniform(c, 1e-2, 10)),
    ("liquid.rheology", "viscosity_infinity"): lambda c, _: number(viscosity_scale(c) * log_uniform(c, 1e-5, 1e-2)),
    ("liquid.rheology", "time"): lambda c, _: number(c.length / c.speed * log_uniform(c, 0.1, 10)),
    ("liquid.rheology", "viscosity"): lambda c, _: number(viscosity_scale(c) * log_uniform(c, 1e-3, 1)),
    ("liquid.rheology", "consistency"): lambda c, _: number(viscosity_scale(c) * log_uniform(c, 1e-3, 1)),
    ("liquid.rheology", "exponent"): lambda c, _: number(c.rng.choice([0.5, 1.0, c.rng.uniform(0.2, 2)])),
    ("liquid.rheology", "yield_stress"): lambda c, _: number(
        stress_scale(c) * c.rng.choice([0.0, 0.3 * c.rng.random()])),
    ("liquid.rheology", "regularisation"): lambda c, _: number(c.speed / c.length * log_uniform(c, 1e-4, 1e-1)),
    ("liquid.region[]", "velocity"): lambda c, _: None if c.prescribes else flow(c, c.speed),
    ("liquid", "sponge"): sponges,
    ("liquid.sponge[]", "rate"): lambda c, _: c.rng.choice([number(log_uniform(c, 0.1, 1e3) / c.end), f"{1 / c.end!r}*(1+sin(x))"]),
    ("liquid.sponge[]", "velocity"): lambda c, _: flow(c, c.speed),
    ("liquid.sponge[]", "side"): lambda c, _: None,   # with length, by sponges()
    ("liquid.sponge[]", "length"): lambda c, _: None,
    ("liquid.source[]", "velocity"): lambda c, _: None if c.prescribes else flow(c, c.speed),
    ("liquid.source[]", "from"): lambda c, _: number(c.end * c.rng.uniform(0, 0.5)),
    ("liquid.source[]", "start"): lambda c, _: number(c.end * c.rng.uniform(0, 0.5)),
    ("liquid.source[]", "until"): lambda c, _: number(c.end * c.rng.uniform(0.6, 1.5)),
    **{(f"liquid.drain[]", key): (lambda part: lambda c, _: number(c.end * c.rng.uniform(*part)))(part)
       for key, part in (("from", (0, 0.5)), ("start", (0, 0.5)), ("until", (0.6, 1.5)))},
    **{(f"liquid.{name}[]", key): make for name in ("source", "drain")
       for key, make in (("rate", rate), ("attached_to", lambda c, _: None),   # by tests of moving sources
                         ("motion", lambda c, _, name=name: motion(c, f"liquid.{name}[].motion", 0.3 * c.radius)))},
    ("gas", "bubbles"): lambda c, _: "resolved" if c.has_waves else c.rng.choice(c.choices("gas", "bubbles")),
    ("gas", "density"): lambda c, _: log_uniform(c, c.density_scale * 1e-3, c.density_scale),
    ("gas", "viscosity"): lambda c, _: c.rng.choice([0.0, number(c.density_scale * c.speed * c.length * 1e-4)]),
    ("gas", "velocity"): lambda c, _: flow(c, 0.5 * c.speed),
    ("solid[]", "name"): lambda c, _: c.rng.choice(["body", "Körper", "a b", "../up", "x" * 60]) + str(len(c.bodies)),
    ("solid[]", "motion"): lambda c, _: motion(c, "solid[].motion", 0.3 * c.radius),
    ("solid[]", "sequence"): table_of("solid[].sequence"),
    ("solid[].sequence", "meshes"): lambda c, _: BEATS,
    ("solid[].sequence", "rate"): lambda c, _: number(BEATS / c.end),
    ("solid[].sequence", "start"): lambda c, _: number(c.end * c.rng.choice([-0.3, 0.5])),
    ("solid[]", "density"): lambda c, here: None if "mass" in here else density(c),
    ("solid[]", "mass"): lambda c, here: None if "density" in here else number(density(c) * c.radius ** c.dim),
    ("solid[]", "center_of_mass"): lambda c, _: None,   # by tests/unit/scene/robots.cpp
    ("solid[]", "inertia"): lambda c, _: None,
    ("solid[]", "products_of_inertia"): lambda c, _: None,
    ("solid[]", "velocity"): lambda c, _: vector(c, 0.3 * c.speed),
    ("solid[]", "angular_velocity"): angular_velocity,
    ("solid[]", "fixed"): fixed,
    ("solid[]", "array"): lambda c, _: None,   # copies by tests/unit/scene/copies.cpp
    ("solid[]", "scatter"): lambda c, _: None,
    ("solid[]", "spring_stiffness"): lambda c, _: number(log_uniform(c, 0.1, 1e3) * spring_scale(c)),
    ("solid[]", "spring_damping"): lambda c, _: c.rng.choice([0.0, number(spring_scale(c) * c.end)]),
    ("solid[]", "friction"): lambda c, _: c.rng.choice([0.0, 0.3, 1.0, 1e4]),
    ("solid[]", "contact_angle"): lambda c, _: number(c.rng.uniform(20, 160)),
    ("solid[]", "material"): table_of("solid[].material"),
    ("solid[]", "element_size"): lambda c, _: number(c.radius / c.rng.uniform(1.2, 2.5)),
    ("solid[]", "element_order"): lambda c, _: c.rng.choice([1, 2]),
    ("solid[]", "pinned"): pins,
    ("solid[]", "body_force"): lambda c, _: flow(c, c.density_scale * max(c.acceleration, c.speed ** 2 / c.length)),
    ("solid[]", "traction"): tractions,
    ("solid[].traction", "stress"): lambda c, _: flow(c, 0.3 * stress_scale(c)),
    ("solid[].material", "youngs_modulus"): lambda c, _: number(stress_scale(c) * log_uniform(c, 3, 1e5)),
    ("solid[].material", "poisson_ratio"): lambda c, _: c.rng.choice([0, 0.3, 0.45, 0.499]),
    ("solid[].material", "damping"): lambda c, _: number(c.end * c.rng.choice([0, 0.01, 0.1])),
    ("solid[].material", "mass_damping"): lambda c, _: number(c.rng.choice([0, 0.1, 1]) / c.end),
    ("solid[].pinned", "motion"): lambda c, _: motion(c, "solid[].pinned.motion", 0.1 * c.radius),
    ("probe[]", "joint"): lambda c, _: "",   # named once the joints are made
    ("probe[]", "name"): lambda c, _: f"probe {c.rng.random()}",
    ("probe[]", "position"): probe_position,
    **{("probe[]", key): lambda c, _: None   # in place of a position, by points()
       for key in ("from", "to", "count", "corner", "edge_a", "edge_b", "counts")},
    ("probe[]", "lower"): lambda c, _: None,   # of a box, by points()
    ("probe[]", "upper"): lambda c, _: None,
    ("probe[]", "solids"): lambda c, _: c.rng.choice([["*"], ["*", "?*"]]),
    ("probe[]", "about"): lambda c, _: vector(c, c.length),
    ("probe[]", "every"): lambda c, _: number(c.end / c.rng.uniform(1, 15)),
    ("probe[]", "solid"): lambda c, _: c.rng.choice(list(c.followed)),
    ("solver", "tolerance"): lambda c, _: log_uniform(c, 1e-11, 1e-4),
    ("solver", "rheology_tolerance"): lambda c, _: log_uniform(c, 1e-5, 1e-1),
    ("solver", "rheology_iterations"): lambda c, _: c.rng.choice([30, 60, 200]),
    ("output", "checkpoint_every"): lambda c, _: c.rng.choice([1, 2, 1000]),
}
for _prefix in ("solid[].motion", "solid[].pinned.motion", "liquid.source[].motion", "liquid.drain[].motion"):
    VALUES[_prefix, "translate"] = lambda c, _: formulas_of_time(c, c.reach)
    VALUES[_prefix, "waves"] = lambda c, _: None   # by tests/unit/scene/waves.cpp
    VALUES[_prefix, "rotate"] = lambda c, _, table=_prefix + ".rotate": motion_rotate(c, table)
    VALUES[_prefix + ".rotate", "axis"] = motion_axis
    VALUES[_prefix + ".rotate", "center"] = lambda c, _: point(c.slot)
    VALUES[_prefix + ".rotate", "degrees"] = lambda c, _: f"{number(c.rng.uniform(-20, 20))!r}*sin(t/{c.end!r})"
