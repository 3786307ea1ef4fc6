"""Random robots: a hull with an arm that turns or slides, written in URDF."""
import re

from fuzzing.joints import count_keys
from fuzzing.shapes import number, point, unit_vector

NAME = re.compile(r'"(robot_(revolute|continuous|prismatic|fixed)_([0-9.e+-]+)_([0-9.e+-]+)\.urdf)"')


def link(name, size, density):
    x, y, z = size
    mass = density * x * y * z
    moments = " ".join(f'i{a}{a}="{mass / 12 * m!r}"' for a, m in (("x", y * y + z * z), ("y", x * x + z * z),
                                                                  ("z", x * x + y * y)))
    products = " ".join(f'i{a}="0"' for a in ("xy", "xz", "yz"))
    inertial = f'<inertial><mass value="{mass!r}"/><inertia {moments} {products}/></inertial>' if density else ""
    return (f'<link name="{name}">{inertial}<collision><geometry><box size="{x!r} {y!r} {z!r}"/></geometry>'
            "</collision></link>")


def urdf(kind, size, density):
    """Bytes of a robot about `size` long; its arm has no mass of its own in the file if density is 0."""
    limit = f'<limit lower="{-0.3 * (size if kind == "prismatic" else 1)!r}" upper="1" effort="0" velocity="0"/>'
    text = ('<robot name="r">' + link("hull", [0.5 * size, 0.3 * size, 0.3 * size], density)
            + link("arm", [0.4 * size, 0.2 * size, 0.2 * size], density)
            + f'<joint name="shoulder" type="{kind}"><parent link="hull"/><child link="arm"/>'
            f'<origin xyz="{0.45 * size!r} 0 0" rpy="0 0 0.3"/><axis xyz="0 0 1"/>'
            + (limit if kind in ("revolute", "prismatic") else "") + "</joint></robot>")
    return text.encode()


def files_in(text):
    """Name and bytes of each robot that a scene names."""
    return [(name, urdf(kind, float(size), float(density))) for name, kind, size, density in NAME.findall(text)]


def forces(c, kind):
    here = {"name": "shoulder"}
    if c.rng.random() < 0.3:
        here["start"] = number(c.rng.uniform(-15, 40) if kind != "prismatic" else 0.1 * c.radius)
    if c.rng.random() < 0.5:
        stiffness = number(c.density_scale * c.radius ** 5 / c.end ** 2)
        here["motor"] = {"target": f"{number(0.2 * c.radius if kind == 'prismatic' else 20)!r}*sin(5*t/{c.end!r})",
                         "stiffness": stiffness, "damping": number(0.1 * c.end * stiffness)}
    return here


def make_robots(c, center):
    """At most one robot, about a place for a solid."""
    kind = c.rng.choice(["revolute", "continuous", "prismatic", "fixed"])
    density = c.rng.choice([0.0, number(0.1 * c.density_scale), number(2 * c.density_scale)])
    here = {"file": f"robot_{kind}_{number(c.radius)!r}_{density!r}.urdf", "translate": point(center),
            "rotate": {"axis": point(unit_vector(c.rng, 3)), "degrees": number(c.rng.uniform(0, 360))}}
    if density == 0:
        here["density"] = number(0.5 * c.density_scale)
    if c.rng.random() < 0.5:
        here["base"] = c.rng.choice(["free", "fixed"])
    if kind != "fixed" and c.rng.random() < 0.7:
        here["joint"] = [forces(c, kind)]
        count_keys(c, "robot[].joint[]", here["joint"][0])
    count_keys(c, "robot[]", {key: value for key, value in here.items() if key != "joint"})
    return [here]
