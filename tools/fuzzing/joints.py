"""Random joints between the solids of a scene."""
from fuzzing.shapes import number, point, unit_vector

ONLY_3D = {"ball", "cylindrical", "universal", "planar"}
WITH_AXIS = {"hinge", "slider", "cylindrical", "universal", "planar"}
ALONG = {"hinge", "slider", "cylindrical", "distance"}   # kinds whose coordinate forces act along


def log_uniform(c, low, high):
    return number(low * (high / low) ** c.rng.random())


def size(c, turns):
    """The force, or torque, that a solid of the joint's size feels; along the coordinate's scale."""
    force = c.density_scale * c.radius ** c.dim * max(c.acceleration, c.speed ** 2 / c.length)
    return force * c.radius if turns else force


def perpendicular(c, axis):
    other = unit_vector(c.rng, 3)
    along = sum(a * b for a, b in zip(axis, other)) / sum(a * a for a in axis)
    return [b - along * a for a, b in zip(axis, other)]


def wave(c, most):
    return f"{number(most)!r}*sin({number(c.rng.uniform(1, 6) / c.end)!r}*t)"


def way(c, here):
    """A motion along the coordinate that is zero at t = 0: degrees, or metres."""
    return wave(c, c.rng.uniform(-30, 30)) if here["kind"] == "hinge" else wave(c, 0.2 * c.radius)


def axis_of(c, here):
    if here["kind"] not in WITH_AXIS or (c.dim == 2 and here["kind"] == "hinge"):
        return None
    if c.dim == 2:
        return [*unit_vector(c.rng, 2), 0.0]
    return c.rng.choice([[0.0, 0.0, 1.0], unit_vector(c.rng, 3)])


def limits(c, here):
    if here["kind"] == "hinge":
        return [number(-c.rng.uniform(5, 90)), number(c.rng.uniform(5, 400))]
    if here["kind"] == "distance":
        length = sum((a - b) ** 2 for a, b in zip(here["at"], here["to"])) ** 0.5
        return [number(0.7 * length), number(1.5 * length)]
    return [number(-c.rng.uniform(0.1, 1) * c.radius), number(c.rng.uniform(0.1, 1) * c.radius)]


def spring(c, here):
    turns = here["kind"] == "hinge"
    table = {"stiffness": number(size(c, turns) / (1 if turns else c.radius) * log_uniform(c, 0.1, 100))}
    if c.rng.random() < 0.5:
        table["damping"] = number(table["stiffness"] * c.end * c.rng.choice([0.01, 0.3]))
    if c.rng.random() < 0.3:
        table["rest"] = number(c.rng.uniform(-40, 40) if turns else c.rng.uniform(0, 0.5) * c.radius)
    return table


def motor(c, here):
    turns = here["kind"] == "hinge"
    most = {"torque" if turns else "force": number(size(c, turns) * log_uniform(c, 0.1, 10))}
    if c.rng.random() < 0.5:
        return {"speed": number(c.rng.uniform(-1, 1) * c.speed / (c.radius if turns else 2)), **most}
    table = {"target": way(c, here), "stiffness": number(size(c, turns) * log_uniform(c, 1, 100)),
             "damping": number(size(c, turns) * c.end * 0.1)}
    return {**table, **(most if c.rng.random() < 0.5 else {})}


def add_forces(c, here):
    for key, make in (("limits", limits), ("spring", spring)):
        if c.rng.random() < c.often:
            here[key] = make(c, here)
    if c.rng.random() < c.often:
        if c.rng.random() < 0.5:
            here["motor"] = motor(c, here)
        else:
            here["drive"] = {"degrees" if here["kind"] == "hinge" else "translate": way(c, here)}
            here.pop("limits", None)
    if c.rng.random() < 0.3 * c.often:
        here["friction"] = c.rng.choice([0.1, 1.0])
        if here["kind"] == "hinge":
            here["radius"] = number(0.1 * c.radius)


def region(c, at):
    return {"shape": "sphere", "center": point(at), "radius": number(c.radius * c.rng.choice([0.4, 0.8, 1.5]))}


def joint(c, number_of, between, kinds_of, at, to):
    kinds = [k for k in c.choices("joint[]", "kind") if k != "gear" and (c.dim == 3 or k not in ONLY_3D)]
    here = {"name": f"joint {number_of}", "kind": c.rng.choice(kinds), "between": between, "at": point(at)}
    if axis := axis_of(c, here):
        here["axis"] = point(axis)
    if here["kind"] == "universal":
        here["second_axis"] = point(perpendicular(c, axis))
    if here["kind"] in ("distance", "rope"):
        here["to"] = point(to)
        if here["at"] == here["to"]:
            return None
    if here["kind"] == "rope" and c.rng.random() < 0.5:
        here["length"] = number(2 * sum((a - b) ** 2 for a, b in zip(at, to)) ** 0.5)
    if here["kind"] in ALONG:
        add_forces(c, here)
    if here["kind"] != "rope" and c.rng.random() < 0.2 * c.often:
        turns = here["kind"] != "distance" and c.rng.random() < 0.5
        here["breaks_at"] = {"torque" if turns else "force": number(size(c, turns) * log_uniform(c, 0.3, 10))}
    if "elastic" in kinds_of:
        here["region"] = region(c, at if kinds_of[0] == "elastic" or "to" not in here else to)
        if kinds_of == ["elastic", "elastic"]:
            here["second_region"] = region(c, to if "to" in here else at)
    return here


def make_joints(c, solids, centers):
    """Joints of rigid and elastic solids with others; sometimes a gear of two."""
    able = [(s.get("name", f"solid{n + 1}"), s["kind"], center) for n, (s, center) in enumerate(zip(solids, centers))
            if s["kind"] in ("rigid", "elastic", "kinematic", "static") and not s.get("invert")
            and "plane" not in s["shape"]]
    rigid = [a for a in able if a[1] in ("rigid", "elastic")]
    if not rigid or c.rng.random() > 0.4:
        return []
    found = []
    for _ in range(c.rng.choice([1, 1, 2, 3])):
        first = c.rng.choice(rigid)
        others = [a for a in able if a[0] != first[0]] + [("world", "", [l + e / 2 for l, e in zip(c.lower, c.extent)])]
        second = c.rng.choice(others)
        share = c.rng.choice([0.0, 0.5, 1.0])
        at = [a + share * (b - a) for a, b in zip(first[2], second[2])]
        made = joint(c, len(found), [first[0], second[0]], [first[1], second[1]], at, second[2])
        if made:
            found.append(made)
    turning = [j["name"] for j in found if j["kind"] in ("hinge", "slider", "cylindrical", "distance")]
    if len(turning) > 1 and c.rng.random() < 0.5:
        found.append({"name": "gear", "kind": "gear", "between": turning[:2],
                      "ratio": c.rng.choice([1.0, -1.0, 2.0, -0.3])})
    for made in found:
        count_keys(c, "joint[]", made)
    return found


def count_keys(c, table, here):
    for key, value in here.items():
        c.use(table, key, value if key == "kind" else None)
        if isinstance(value, dict):
            count_keys(c, f"{table}.{key}", value)


def feeds(joints):
    """True if joints may bring energy: motors, drives, springs that start bent, and what they break."""
    return any({"motor", "drive", "breaks_at"} & set(j) or "rest" in j.get("spring", {}) for j in joints)
