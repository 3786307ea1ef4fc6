"""Swing of a disc on a spring in a concentric container full of viscous liquid, for swing.csv. Not part of the build.

Linear: with s for the rate of change, the liquid's force -Z(s) v is that of ../disc_shaken_in_container/make_reference.py
at i w = s. Released at rest from X, m (s^2 x - s X) + Z (s x - X) + k x = 0. The Laplace transform is turned back by
sums along a line right of all poles, with Euler's averages of the last ones (Abate and Whitt 1995).
"""

import cmath
import importlib.util
import math
import pathlib

here = pathlib.Path(__file__).resolve().parent
spec = importlib.util.spec_from_file_location("shaken", here.parent / "disc_shaken_in_container/make_reference.py")
shaken = importlib.util.module_from_spec(spec)
spec.loader.exec_module(shaken)

MASS = 100.0 * math.pi * shaken.A**2
STIFFNESS = 20000.0


def transform(s):
    """Of the displacement over the first one."""
    z = -shaken.force_over_velocity(s)
    return (MASS * s + z) / (MASS * s * s + z * s + STIFFNESS)


def at(t, terms=60, averaged=12):
    """Error e^-18 or so."""
    real = 18.4 / (2 * t)
    total = transform(complex(real, 0)).real / 2
    sums = []
    for k in range(1, terms + averaged + 1):
        total += (-1)**k * transform(complex(real, k * math.pi / t)).real
        if k >= terms:
            sums.append(total)
    return math.exp(9.2) / t * sum(math.comb(averaged, j) * s for j, s in enumerate(sums)) / 2**averaged


print("# Made by make_reference.py: exact for small amplitudes, over the first displacement")
print("t,swing")
for k in range(1, 61):
    print(f"{k / 20:.2f},{at(k / 20):.6f}")
