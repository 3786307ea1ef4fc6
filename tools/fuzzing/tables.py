"""Tables and surfaces in the output of a run."""
import base64
import csv
import json
import re
import struct

import numpy

COLUMNS = {"solids.csv": 21, "probes.csv": 6}   # documented columns; reactions of pins and the like come later


class Fault(Exception):
    """A violated property: a word for the property, and a text."""

    def __init__(self, what, text):
        super().__init__(f"{what}: {text}")
        self.what = what


def read_table(path):
    """Rows as strings by column name; every row must have all columns."""
    with open(path, newline="", encoding="utf-8", errors="replace") as file:
        lines = list(csv.reader(file))
    if not lines:
        raise Fault("table", f"{path.name} is empty")
    for number, line in enumerate(lines, 1):
        if len(line) != len(lines[0]):
            raise Fault("table", f"{path.name}:{number}: {len(line)} columns, the head has {len(lines[0])}")
    if len(lines[0]) < COLUMNS.get(path.name, 0):
        raise Fault("table", f"{path.name}: {len(lines[0])} columns")
    return lines[0], lines[1:]


def check_finite(path):
    head, rows = read_table(path)
    for number, row in enumerate(rows, 2):
        for name, text in zip(head, row):
            if name != "name" and text and not numpy.isfinite(float(text)):
                raise Fault("finite", f"{path.name}:{number}: {name} is {text}")


def read_stats(folder):
    head, rows = read_table(folder / "stats.csv")
    values = numpy.array([[float(v) for v in row] for row in rows]).reshape(len(rows), len(head))
    return {name: values[:, n] for n, name in enumerate(head)}


def same_stats(one, other):
    """True if two runs took the same steps, bit for bit; wall times are ignored."""
    def rows(folder):
        head, lines = read_table(folder / "stats.csv")
        skip = head.index("wall_seconds")
        return [head] + [line[:skip] + line[skip + 1:] for line in lines]
    return rows(one) == rows(other)


def read_summary(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


ARRAY = re.compile(r'<DataArray type="(\w+)" Name="(\w+)"[^>]*format="binary">([^<]*)<')
TYPES = {"Float64": "<f8", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}


def read_surfaces(path, dim):
    """Points and facets (Dim point numbers a row) of each solid's surface in a frame, by the solid's number."""
    arrays = {}
    for kind, name, text in ARRAY.findall(path.read_text(encoding="utf-8")):
        raw = base64.b64decode(text)
        arrays[name] = numpy.frombuffer(raw[8:8 + struct.unpack("<Q", raw[:8])[0]], TYPES[kind])
    points = arrays["Points"].reshape(-1, 3)[:, :dim]
    facets = arrays["connectivity"].reshape(-1, dim)
    return {int(n): (points, facets[arrays["solid"] == n]) for n in numpy.unique(arrays["solid"])}


def winding(x, points, facets):
    """Winding number of a closed surface at each row of x."""
    a = [points[facets[:, n]][None] - x[:, None] for n in range(facets.shape[1])]
    if len(a) == 2:
        turn = numpy.arctan2(a[0][..., 0] * a[1][..., 1] - a[0][..., 1] * a[1][..., 0], (a[0] * a[1]).sum(-1))
        return turn.sum(1) / (2 * numpy.pi)
    r = [numpy.linalg.norm(v, axis=-1) for v in a]
    volume = (a[0] * numpy.cross(a[1], a[2])).sum(-1)
    below = r[0] * r[1] * r[2] + sum((a[n] * a[(n + 1) % 3]).sum(-1) * r[(n + 2) % 3] for n in range(3))
    return 2 * numpy.arctan2(volume, below).sum(1) / (4 * numpy.pi)


def samples(points, facets):
    """Corners, centres, and points between them on the facets."""
    corners = points[facets]
    middle = corners.mean(1)
    between = 0.7 * corners + 0.3 * middle[:, None]
    return numpy.concatenate([middle, *(part.reshape(-1, points.shape[1]) for part in (corners, between))])


def overlap(one, other):
    """Largest depth of one surface's points within another, a lower bound by planes; 0 if no point is inside."""
    x = samples(*one)
    points, facets = other
    low, high = points[facets].min((0, 1)), points[facets].max((0, 1))
    x = x[((x > low) & (x < high)).all(1)]
    if not len(x):
        return 0.0
    x = x[numpy.abs(winding(x, points, facets)) > 0.5]
    return float(plane_distance(x, points, facets).max()) if len(x) else 0.0


def plane_distance(x, points, facets):
    """Distance from inner points to the plane of the nearest facet: a lower bound of their depth."""
    corners = points[facets]
    edge = corners[:, 1] - corners[:, 0]
    if points.shape[1] == 2:
        normal = numpy.stack([edge[:, 1], -edge[:, 0]], 1)
    else:
        normal = numpy.cross(edge, corners[:, 2] - corners[:, 0])
    size = numpy.linalg.norm(normal, axis=1)
    normal, corners = normal[size > 0] / size[size > 0, None], corners[size > 0]
    return numpy.abs(((x[:, None] - corners[None, :, 0]) * normal[None]).sum(-1)).min(1)
