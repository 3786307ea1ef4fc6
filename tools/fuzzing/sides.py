"""Generators for the sides of the domain."""
import math

from fuzzing.shapes import AXES, number

CLOSED = ("free_slip", "no_slip")


def boundary(c, _):
    """Periodic sides in pairs; an inflow has an outflow on the opposite side; waves pass upright sides."""
    sides = {}
    waves = ["waves"] if c.acceleration and not c.prescribes else []
    for axis in AXES[:c.dim]:
        low, high = f"{axis}_lower", f"{axis}_upper"
        what = c.rng.choice(["", "", "walls", "periodic", "through", "open", *(waves if axis != "y" else [])])
        if what == "periodic":
            sides[low] = sides[high] = "periodic"
            c.periodic.append(axis)
        elif what == "waves":
            c.has_waves = True
            sides[low], sides[high] = side(c, low, "waves"), side(c, high, c.rng.choice(("waves", *CLOSED)))
        elif what == "walls":
            sides[low], sides[high] = side(c, low, c.rng.choice((*CLOSED, "moving_wall"))), side(c, high, "no_slip")
        elif what:
            sides[high] = side(c, high, "outflow")
            sides[low] = side(c, low, "inflow") if what == "through" else "free_slip"
    for name, value in sides.items():
        c.use("side", "type", value if isinstance(value, str) else value["type"])
        c.use("domain.boundary", name)
    return sides or None


def side(c, name, kind):
    if kind in (*CLOSED, "periodic") and c.rng.random() < 0.7:
        return kind
    table = {"type": kind}
    c.side = name
    c.fill("side", table)
    return table


def side_velocity(c, here):
    """Into the domain for inflows; along the wall for moving walls."""
    axis = AXES.index(c.side[0])
    speed = number(c.speed * c.rng.uniform(0.1, 0.6))
    values = [0.0] * c.dim
    if here["type"] == "moving_wall":
        values[(axis + 1) % c.dim] = c.rng.choice([speed, f"{speed!r}*min(1,t/{c.end!r})"])
        return values
    across = AXES[(axis + 1) % c.dim]
    middle = number(c.lower[AXES.index(across)] + c.length / 2)
    values[axis] = c.rng.choice([speed, f"{speed!r}*min(1,10*t/{c.end!r})", f"{across} < {middle!r} ? {speed!r} : 0"])
    return values


def side_waves(c, _):
    """Long waves, far from breaking; none enter in one of four. Theories of nonlinear ones hold for shorter ones."""
    depth = number(c.extent[1] * c.rng.uniform(0.3, 0.8))
    kind = c.rng.choice(["airy", "stokes", "nonlinear", "jonswap", "pierson_moskowitz"])
    longest = 1.5 if kind in ("stokes", "nonlinear") else 4
    period = number(2 * math.pi * math.sqrt(depth / c.acceleration) * c.rng.uniform(1, longest))
    table = {"depth": depth, "height": number(depth * c.rng.choice([0.0, 0.01, 0.05, 0.2])), "period": period}
    table["theory" if kind in ("airy", "stokes", "nonlinear") else "spectrum"] = kind
    table["ramp"] = number(c.end * c.rng.choice([0.0, 0.3, 1.0]))
    if table["height"] > 0:
        table["absorbs"] = c.rng.random() < 0.8
    return table


def side_pressure(c, _):
    head = number(c.pressure * c.rng.uniform(0, 0.3))
    return c.rng.choice([0.0, head, f"{head!r}*sin(t/{c.end!r})"])
