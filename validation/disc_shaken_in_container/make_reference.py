"""Force on a disc that is shaken in a concentric container full of viscous liquid, for disc_shaken_in_container_lag.

Linear in the displacement D sin(w t): velocity U e^(i w t) of the disc of radius A, container of radius B at rest. The
stream function f(r) sin(angle), f = c1 r + c2/r + c3 I1(m r) + c4 K1(m r), m^2 = i w/nu, meets both walls; the force is
pi A (rho i w (c1 A - c2/A) + rho nu f''(A)) (Stokes 1851 without, Chen, Wambsganss and Jendrzejczyk 1976 with container).
"""

import cmath
import math

A, B, RHO, NU, W, D = 0.25, 0.5, 1000.0, 0.0078539816339744831, 2 * math.pi, 0.005
POINTS = 400


def bessel_i(n, z, scale):
    """Times e^-scale: the trapezoidal rule over a period converges faster than any power."""
    return sum(cmath.exp(z * math.cos(2 * math.pi * k / POINTS) - scale) * math.cos(2 * math.pi * n * k / POINTS)
               for k in range(POINTS)) / POINTS


def bessel_k(n, z, scale):
    """Times e^scale."""
    step = 8.0 / POINTS
    return step * (cmath.exp(scale - z) / 2 + sum(cmath.exp(scale - z * math.cosh(k * step)) * math.cosh(n * k * step)
                                                  for k in range(1, POINTS)))


def shapes(r, m):
    """Values, slopes and curvatures of the four shapes at r; I over its size at B, K over its at A."""
    z, i, k = m * r, m.real * B, m.real * A
    i0, i1, k0, k1 = bessel_i(0, z, i), bessel_i(1, z, i), bessel_k(0, z, k), bessel_k(1, z, k)
    values = [r, 1 / r, i1, k1]
    slopes = [1, -1 / r**2, m * (i0 - i1 / z), m * (-k0 - k1 / z)]
    curvatures = [0, 2 / r**3, m**2 * i1 + i1 / r**2 - slopes[2] / r, m**2 * k1 + k1 / r**2 - slopes[3] / r]
    return values, slopes, curvatures


def solve(rows, right):
    """Gaussian elimination with pivots."""
    m = [list(row) + [r] for row, r in zip(rows, right)]
    n = len(m)
    for i in range(n):
        pivot = max(range(i, n), key=lambda j: abs(m[j][i]))
        m[i], m[pivot] = m[pivot], m[i]
        for j in range(n):
            if j != i:
                share = m[j][i] / m[i][i]
                m[j] = [a - share * b for a, b in zip(m[j], m[i])]
    return [m[i][n] / m[i][i] for i in range(n)]


def force_over_velocity(rate):
    """On the disc, where all goes as e^(rate t)."""
    m = cmath.sqrt(rate / NU)
    at_disc, slope_at_disc, curvature_at_disc = shapes(A, m)
    at_wall, slope_at_wall, _ = shapes(B, m)
    c = solve([at_disc, slope_at_disc, at_wall, slope_at_wall], [A, 1, 0, 0])
    bend = sum(x * y for x, y in zip(c, curvature_at_disc))
    return math.pi * A * (RHO * rate * (c[0] * A - c[1] / A) + RHO * NU * bend)


def main():
    z = force_over_velocity(1j * W) * D * W
    print("# Made by make_reference.py: exact for small amplitudes, over that of the force, in the fourth period")
    print(f"# amplitude {abs(z):.6f} N/m, added mass {-z.imag / (D * W**2):.4f} kg/m, "
          f"damping {-z.real / (D * W):.4f} kg/(m s)")
    print("t,force")
    for k in range(64):
        t = 3 + k / 64
        print(f"{t:.6f},{(z * cmath.exp(1j * W * t)).real / abs(z):.7f}")


if __name__ == "__main__":
    main()
