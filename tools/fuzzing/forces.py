"""Forces and contact pairs of random scenes."""
from fuzzing.shapes import fit_shape, number, point
from fuzzing.values import flow, log_uniform, vector

FREE = ("rigid", "elastic", "sprung")


def names_of(solids, kinds):
    return [s["name"] for s in solids if s.get("kind") in kinds and "name" in s]


def acceleration_scale(c):
    return max(c.acceleration, c.speed ** 2 / c.length)


def whirl(c, here):
    """Centre, radius and strength of points and vortices."""
    here["center"] = point(l + e * c.rng.uniform(-0.2, 1.2) for l, e in zip(c.lower, c.extent))
    here["radius"] = number(c.length * log_uniform(c, 0.1, 1))
    strength = number(acceleration_scale(c) * c.rng.uniform(-2, 2))
    here["strength"] = c.rng.choice([strength, f"{strength!r}*sin(t/{c.end!r})"])
    if here["kind"] == "vortex" and c.dim == 3:
        here["axis"] = c.rng.choice([[0.0, 1.0, 0.0], [1.0, 1.0, 1.0]])


def force(c, solids):
    kinds = [k for k in c.choices("force[]", "kind") if not (k == "wind" and c.has_gas)]
    here = {"kind": c.rng.choice(kinds)}
    movable = names_of(solids, FREE)
    if here["kind"] == "load":
        movable = names_of(solids, ("rigid", "sprung"))
        if not movable:
            return None
        here["solids"] = [c.rng.choice(movable)]
        here["force"] = vector(c, c.density_scale * c.length ** c.dim * acceleration_scale(c))
        here["torque"] = number(c.density_scale * c.length ** (c.dim + 1) * acceleration_scale(c) * 0.1)
        here["turns_with_solid"] = c.rng.random() < 0.5
    elif here["kind"] == "acceleration":
        here["acceleration"] = flow(c, acceleration_scale(c))
    elif here["kind"] in ("point", "vortex"):
        whirl(c, here)
    else:
        here["velocity"] = flow(c, c.speed)
        if here["kind"] == "drag":
            here["rate"] = number(log_uniform(c, 0.1, 1e3) / c.end)
    if here["kind"] != "load":
        here["acts_on"] = c.rng.choice([w for w in c.choices("force[]", "acts_on") if w != "solids" or movable])
        if c.rng.random() < 0.3:
            middle = [l + e / 2 for l, e in zip(c.lower, c.extent)]
            here["region"] = fit_shape(c.rng, c.dim, c.rng.choice(["sphere", "box"]), middle, 0.6 * max(c.extent))
    for key in here:
        c.use("force[]", key, here[key] if key in ("kind", "acts_on") else None)
    return here


def make_forces(c, solids):
    if c.prescribes or c.rng.random() < 0.6:
        return []
    return [f for f in (force(c, solids) for _ in range(c.rng.choice([1, 1, 2]))) if f]


def make_contacts(c, solids):
    """Friction of a pair; pairs that pass through each other would overlap at the start in too few scenes to matter."""
    names = names_of(solids, FREE)
    if not names or c.rng.random() < 0.7:
        return []
    here = {"between": [c.rng.choice([*names, "*"]), c.rng.choice(["domain", "?*"])]}
    if here["between"][1] != "domain" and c.rng.random() < 0.4:
        here["collide"] = False
    else:
        here["friction"] = c.rng.choice([0.0, 0.4, 2.0])
    made = [here] + bounces(c, solids)
    for contact in made:
        for key in contact:
            c.use("contact[]", key)
    return made


def bounces(c, solids):
    """Restitution of all rigid solids with each other and with the sides, or of one with the sides."""
    rigid = names_of(solids, ("rigid",))
    if not rigid or c.rng.random() < 0.5:
        return []
    if c.rng.random() < 0.5:
        return [{"between": [c.rng.choice(rigid), "domain"], "restitution": c.rng.choice([0.0, 0.5, 1.0])}]
    pairs = [[a, b] for n, a in enumerate(rigid) for b in rigid[n + 1:]] + [[a, "domain"] for a in rigid]
    return [{"between": pair, "restitution": c.rng.choice([0.0, 0.5, 0.9, 1.0])} for pair in pairs[:20]]
