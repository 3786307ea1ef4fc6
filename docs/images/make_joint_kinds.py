#!/usr/bin/env python3
"""Draws joint_kinds.svg, the kinds of joints in docs/joints.md: grey the second solid, blue the first, red what is free."""
import math
import pathlib

WIDTH, HEIGHT, SCALE = 190, 150, 34
GREY, BLUE, RED = ("#c9c9c9", "#adadad", "#8f8f8f"), ("#9cc3ea", "#6fa3d8", "#4a80b8"), "#c8321e"


def flat(p):
    """Isometric picture of a point, y up."""
    x, y, z = p
    return (0.866 * (x - z) * SCALE, (0.5 * (x + z) - y) * SCALE)


def path(points, style, close=False):
    text = "M" + " L".join("{:.1f} {:.1f}".format(*flat(p)) for p in points) + (" Z" if close else "")
    return f'<path d="{text}" {style}/>'


def box(center, size, shades):
    (x, y, z), (a, b, c) = center, [0.5 * s for s in size]
    top = [(x - a, y + b, z - c), (x + a, y + b, z - c), (x + a, y + b, z + c), (x - a, y + b, z + c)]
    right = [(x + a, y - b, z - c), (x + a, y + b, z - c), (x + a, y + b, z + c), (x + a, y - b, z + c)]
    left = [(x - a, y - b, z + c), (x + a, y - b, z + c), (x + a, y + b, z + c), (x - a, y + b, z + c)]
    edge = 'stroke="#444" stroke-width="0.8" stroke-linejoin="round"'
    return "".join(path(face, f'fill="{shade}" {edge}', True) for face, shade in zip((top, right, left), shades))


def line(p, q, style=f'stroke="{RED}" stroke-width="1.4"'):
    return path([p, q], f'fill="none" {style}')


def axis(p, q):
    return line(p, q, f'stroke="{RED}" stroke-width="1" stroke-dasharray="5 3"')


def arrow(p, q):
    """Both ways."""
    return path([p, q], f'fill="none" stroke="{RED}" stroke-width="2" marker-start="url(#head)" marker-end="url(#head)"')


def turn(center, radius, normal, start=20, end=300):
    """An arc about an axis of space, 0, 1 or 2, with a head."""
    points = []
    for n in range(25):
        angle = math.radians(start + (end - start) * n / 24)
        p = list(center)
        p[(normal + 1) % 3] += radius * math.cos(angle)
        p[(normal + 2) % 3] += radius * math.sin(angle)
        points.append(p)
    return path(points, f'fill="none" stroke="{RED}" stroke-width="2" marker-end="url(#head)"')


def dot(p, radius=4):
    x, y = flat(p)
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{RED}"/>'


def wheel(center, radius, shade):
    points = [(center[0] + radius * math.cos(a), center[1] + radius * math.sin(a), center[2])
              for a in [2 * math.pi * n / 40 for n in range(40)]]
    spoke = [(center[0], center[1], center[2]), points[5]]
    edge = 'stroke="#444" stroke-width="0.8"'
    return path(points, f'fill="{shade}" {edge}', True) + path(spoke, f'fill="none" {edge}') + dot(center, 3)


POST, ARM = ((-0.75, 0, 0), (0.9, 0.9, 0.9)), ((0.75, 0, 0), (1.5, 0.55, 0.55))


def pair(*extra, first=ARM):
    return box(*POST, GREY) + box(*first, BLUE) + "".join(extra)


def kinds():
    o = (-0.15, 0.1, 0.25)
    yield "weld", pair()
    yield "hinge", pair(axis((0, 0.1, 1.3), (0, 0.1, -1.2)), turn((0, 0.1, 0.9), 0.5, 2, -60, 60))
    yield "ball", pair(dot((0, 0.3, 0.3), 6), turn((1.2, 0, 0), 0.6, 0), turn((0, 0.9, 0), 0.5, 1, 20, 250),
                       turn((0, 0.1, 0.9), 0.5, 2, -60, 60))
    yield "slider", pair(axis((-1.6, 0.1, 0.3), (2.2, 0.1, 0.3)), arrow((0.4, 0.75, 0), (1.6, 0.75, 0)))
    yield "cylindrical", pair(axis((-1.6, 0.1, 0.3), (2.2, 0.1, 0.3)), arrow((0.4, 0.75, 0), (1.6, 0.75, 0)),
                              turn((1.7, 0, 0), 0.55, 0))
    yield "universal", pair(axis((0, 0.1, 1.3), (0, 0.1, -1.2)), axis((0, 1.2, 0), (0, -1, 0)),
                            turn((0, 0.1, 0.9), 0.5, 2, -60, 60), turn((0, 0.8, 0), 0.4, 1, 20, 250))
    yield "planar", (box((0, -0.4, 0), (2.6, 0.25, 1.8), GREY) + box((0, 0, 0), (0.9, 0.55, 0.6), BLUE)
                     + arrow((0.55, 0.0, 0), (1.25, 0.0, 0)) + arrow((0, 0.0, 0.4), (0, 0.0, 1.0))
                     + axis((0, 0.3, 0), (0, 1.2, 0)) + turn((0, 0.75, 0), 0.45, 1, 20, 290))
    yield "distance", (box((-1.1, 0.3, 0), (0.7, 0.7, 0.7), GREY) + box((1.1, -0.2, 0), (0.7, 0.7, 0.7), BLUE)
                       + line((-1.1, 0.65, 0.3), (1.1, 0.1, 0.3), f'stroke="{RED}" stroke-width="3"')
                       + dot((-1.1, 0.65, 0.3)) + dot((1.1, 0.1, 0.3)))
    sag = [(-1.1 + 2.2 * n / 20, 0.65 - 0.55 * n / 20 - 1.2 * (n / 20) * (1 - n / 20), 0.3) for n in range(21)]
    yield "rope", (box((-1.1, 0.3, 0), (0.7, 0.7, 0.7), GREY) + box((1.1, -0.2, 0), (0.7, 0.7, 0.7), BLUE)
                   + path(sag, f'fill="none" stroke="{RED}" stroke-width="2"') + dot(sag[0]) + dot(sag[-1]))
    yield "gear", (wheel((-0.65, 0, 0), 0.6, GREY[0]) + wheel((0.85, 0, 0), 0.9, BLUE[0])
                   + turn((-0.65, 0, 0), 0.4, 2, 60, 200) + turn((0.85, 0, 0), 0.65, 2, 300, 160))


def picture():
    head = ('<defs><marker id="head" viewBox="0 0 8 8" refX="5" refY="4" markerWidth="4" markerHeight="4" '
            f'orient="auto-start-reverse"><path d="M0 0 L8 4 L0 8 Z" fill="{RED}"/></marker></defs>')
    panels = ""
    for n, (name, shapes) in enumerate(kinds()):
        x, y = WIDTH * (n % 5), HEIGHT * (n // 5)
        panels += (f'<g transform="translate({x + WIDTH / 2} {y + HEIGHT / 2 - 8})">{shapes}</g>'
                   f'<text x="{x + WIDTH / 2}" y="{y + HEIGHT - 8}" text-anchor="middle" font-family="sans-serif" '
                   f'font-size="14">{name}</text>\n')
    size = f'width="{5 * WIDTH}" height="{2 * HEIGHT}" viewBox="0 0 {5 * WIDTH} {2 * HEIGHT}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size}>\n<rect width="100%" height="100%" fill="white"/>{head}\n{panels}</svg>\n'


if __name__ == "__main__":
    pathlib.Path(__file__).with_name("joint_kinds.svg").write_text(picture(), encoding="utf-8")
