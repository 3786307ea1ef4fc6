"""Angular frequency, decay and period of a small wave between two viscous fluids of unbounded depth.

Velocity along z is A exp(kz) + C exp(mz) in the liquid (z < 0) and B exp(-kz) + D exp(-nz) in the gas, times exp(st),
with m^2 = k^2 + s/nu of each fluid. Velocities, shear stress and normal stress with tension are continuous at z = 0
(Lamb, Hydrodynamics, article 349, for two fluids). The determinant of these four conditions is zero.
"""
import cmath
import math


def determinant(rows):
    product = 1
    for i in range(len(rows)):
        pivot = max(range(i, len(rows)), key=lambda r: abs(rows[r][i]))
        if pivot != i:
            rows[i], rows[pivot] = rows[pivot], rows[i]
            product = -product
        product *= rows[i][i]
        for r in range(i + 1, len(rows)):
            factor = rows[r][i] / rows[i][i]
            rows[r] = [x - factor * y for x, y in zip(rows[r], rows[i])]
    return product


def determinant_at(s, k, rho, gas, mu, mu_gas, sigma):
    m, n = cmath.sqrt(k * k + s * rho / mu), cmath.sqrt(k * k + s * gas / mu_gas)
    spring = sigma * k * k / s
    rows = [[1, 1, -1, -1],
            [k, m, k, n],
            [2 * mu * k * k, mu * (m * m + k * k), -2 * mu_gas * k * k, -mu_gas * (n * n + k * k)],
            [rho * s / k + 2 * mu * k + spring, 2 * mu * m + spring, gas * s / k + 2 * mu_gas * k, 2 * mu_gas * n]]
    scales = [max(abs(x) for x in row) for row in rows]
    return determinant([[x / scale for x in row] for row, scale in zip(rows, scales)])


def root(first, second, f):
    for _ in range(60):
        low, high = f(first), f(second)
        if low == high or abs(second - first) < 1e-13 * abs(second):
            break
        first, second = second, second - high * (second - first) / (high - low)
    return second


def rate(k, rho, gas, mu, mu_gas, sigma):
    free = cmath.sqrt(-sigma * k**3 / (rho + gas))
    guess = free - 2 * mu / rho * k * k
    return root(guess, 1.001 * guess, lambda s: determinant_at(s, k, rho, gas, mu, mu_gas, sigma))



if __name__ == "__main__":
    s = rate(200 * math.pi, 998.2, 1.204, 1.002e-3, 1.82e-5, 0.0728)
    print(f"rate {s:.10g} 1/s, period {2 * math.pi / abs(s.imag):.12g} s")
    # capillary_wave_1000: its wave.csv, from Prosperetti's closed form, late on swings at 15.523 and decays at 1.224 1/s.
    print(f"check {rate(2 * math.pi, 1, 1e-3, 0.0182571749236, 1.82571749236e-5, 1):.10g}")
