"""Height of a disc that sinks towards a wall in Stokes flow, for height.csv. Not part of the build.

Jeffrey and Onishi (1981): a cylinder of radius 1 whose centre is h above a plane wall and moves towards it at U feels
4 pi mu U/(a - tanh a), cosh a = h, per metre. With its weight less buoyancy W, V = W/(4 pi mu): dh/dt = -V (a - tanh a).
"""

import math

V = 0.01
START = 1.5
ROWS = [20.0 * k for k in range(1, 23)]


def speed(h):
    a = math.acosh(h)
    return -V * (a - math.tanh(a))


def step(h, dt):
    k1 = speed(h)
    k2 = speed(h + dt / 2 * k1)
    k3 = speed(h + dt / 2 * k2)
    return h + dt / 6 * (k1 + 2 * k2 + 2 * k3 + speed(h + dt * k3))


print("# Made by make_reference.py: h over time by Jeffrey and Onishi (1981), Runge-Kutta steps of 0.02 s")
print("t,height")
h, t = START, 0.0
for row in ROWS:
    while t < row - 1e-9:
        h, t = step(h, 0.02), t + 0.02
    print(f"{row:.0f},{h:.7f}")
