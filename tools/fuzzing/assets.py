"""Valid files for scenes: surfaces, elements and a level set of a body of size 1 about the origin."""
import itertools
import math
import pathlib
import struct
import zlib

from fuzzing.program import Program
from fuzzing.shapes import BEATS

LEVEL_SET_SCENE = """\
dimension = {dim}
[domain]
lower = {lower}
upper = {upper}
cell_size = 0.25
[time]
end = 0.0
[[liquid.region]]
shape = "sphere"
center = {center}
radius = 0.8
"""


def ball_points(cells):
    """Points and quadrilaterals of a cube's surface, cells x cells squares a side, moved half-way towards a ball."""
    index, points, squares = {}, [], []

    def corner(i):
        if i not in index:
            x = [2 * n / cells - 1 for n in i]
            length = sum(v * v for v in x) ** 0.5
            index[i] = len(points)
            points.append([0.5 * v + 0.4 * v / length for v in x])
        return index[i]

    for axis, side in itertools.product(range(3), (0, cells)):
        for a, b in itertools.product(range(cells), repeat=2):
            square = []
            for da, db in ((0, 0), (1, 0), (1, 1), (0, 1)):
                i = [0, 0, 0]
                i[axis], i[(axis + 1) % 3], i[(axis + 2) % 3] = side, a + da, b + db
                square.append(corner(tuple(i)))
            squares.append(square if side else square[::-1])
    return points, squares


def surface(cells=3):
    """Points and triangles of a closed surface, oriented outward."""
    points, squares = ball_points(cells)
    return points, [t for s in squares for t in ((s[0], s[1], s[2]), (s[0], s[2], s[3]))]


def elements(dim, cells=2):
    """Points and triangles or tetrahedra (Kuhn's six per cube) of a square or cube."""
    index = {i: n for n, i in enumerate(itertools.product(range(cells + 1), repeat=dim))}
    points = [[1.4 * v / cells - 0.7 for v in i] + [0.0] * (3 - dim) for i in index]
    found = []
    for cell in itertools.product(range(cells), repeat=dim):
        for order in itertools.permutations(range(dim)):
            corners, at = [index[cell]], list(cell)
            for axis in order:
                at[axis] += 1
                corners.append(index[tuple(at)])
            odd = sum(order[i] > order[j] for i in range(dim) for j in range(i + 1, dim)) % 2
            found.append(corners[:-2] + corners[:-3:-1] if odd else corners)
    return points, found


def rows(table, first=0):
    return "".join(" ".join(str(v + first if isinstance(v, int) else v) for v in row) + "\n" for row in table)


def obj(points, triangles):
    return ("".join("v " + r + "\n" for r in rows(points).splitlines()) +
            "".join("f " + r + "\n" for r in rows(triangles, 1).splitlines())).encode()


def ply(points, triangles):
    head = (f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    return (head + rows(points) + "".join("3 " + r + "\n" for r in rows(triangles).splitlines())).encode()


def outline(size=1.0, points=12):
    """Points of a star about the origin, of size 1."""
    found = []
    for n in range(points):
        angle, far = 2 * math.pi * n / points, 0.8 if n % 2 == 0 else 0.6
        found.append([size * far * math.cos(angle), far * math.sin(angle)])
    return found


def csv(points):
    return ("x, y\n" + "".join(f"{x!r}, {y!r}\n" for x, y in points)).encode()


def lines(points):
    last = len(points)
    return ("".join(f"v {x!r} {y!r} 0\n" for x, y in points)
            + "".join(f"l {n + 1} {n + 2 if n + 1 < last else 1}\n" for n in range(last))).encode()


def stl(points, triangles):
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(v for n in t for v in points[n]), 0) for t in triangles)
    return b"made by tools/fuzz".ljust(80) + struct.pack("<I", len(triangles)) + body


def msh(points, cells):
    kind = {3: 2, 4: 4}[len(cells[0])]
    nodes = "".join(f"{n + 1} {r}\n" for n, r in enumerate(rows(points).splitlines()))
    body = "".join(f"{n + 1} {kind} 2 1 1 {r}\n" for n, r in enumerate(rows(cells, 1).splitlines()))
    return (f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(points)}\n{nodes}$EndNodes\n"
            f"$Elements\n{len(cells)}\n{body}$EndElements\n").encode()


def medit(points, cells):
    dim = len(cells[0]) - 1
    word = {3: "Triangles", 4: "Tetrahedra"}[len(cells[0])]
    nodes = "".join(" ".join(map(str, p[:dim])) + " 0\n" for p in points)
    body = "".join(r + " 0\n" for r in rows(cells, 1).splitlines())
    return (f"MeshVersionFormatted 2\nDimension {dim}\nVertices {len(points)}\n{nodes}"
            f"{word} {len(cells)}\n{body}End\n").encode()


def vtu(points, cells):
    kind = {3: 5, 4: 10}[len(cells[0])]
    offsets = " ".join(str((n + 1) * len(cells[0])) for n in range(len(cells)))
    array = '<DataArray type="{}" Name="{}" {}format="ascii">{}</DataArray>\n'
    return ('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">\n'
            f'<UnstructuredGrid>\n<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n<Points>\n'
            + array.format("Float64", "Points", 'NumberOfComponents="3" ', rows(points)) + "</Points>\n<Cells>\n"
            + array.format("Int64", "connectivity", "", rows(cells)) + array.format("Int64", "offsets", "", offsets)
            + array.format("UInt8", "types", "", " ".join([str(kind)] * len(cells)))
            + "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n").encode()


def make_level_set(program: Program, folder: pathlib.Path, dim):
    """First frame of a run with a ball of liquid."""
    at = folder / f"level_set{dim}"
    at.mkdir()
    scene = LEVEL_SET_SCENE.format(dim=dim, lower=[-1.5] * dim, upper=[1.5] * dim, center=[0.0] * dim)
    (at / "scene.toml").write_text(scene)
    done = program.run("run", "scene.toml", "--out", "out", folder=at)
    if done.code != 0:
        raise RuntimeError(f"the scene of a level set did not run:\n{done.errors}")
    return (at / "out/frames/frame.0000.vdb").read_bytes()


def png(rows):
    """A grey picture of 16 bits a pixel."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    lines = b"".join(b"\0" + struct.pack(f">{len(row)}H", *row) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 16, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines))
            + chunk(b"IEND", b""))


def hills(columns, rows):
    return [[int(32767 * (1 + math.sin(1.3 * i) * math.cos(j))) for i in range(columns)] for j in range(rows)]


def make_assets(program, folder):
    """Contents of the files by name: "ball.obj", "block2.msh", ..."""
    files = {"ball.obj": obj(*surface()), "ball.ply": ply(*surface()), "ball.stl": stl(*surface())}
    points, triangles = surface()
    for n in range(BEATS):
        size = 0.8 + 0.2 * math.sin(2 * math.pi * n / BEATS)
        files[f"beat.{n}.obj"] = obj([[size * x, y, z] for x, y, z in points], triangles)
        files[f"beat2.{n}.csv"] = csv(outline(size))
    files["ring2.csv"], files["ring2.obj"] = csv(outline()), lines(outline())
    files["hills2.png"], files["hills3.png"] = png(hills(7, 1)), png(hills(5, 6))
    for dim in (2, 3):
        for ending, write in (("msh", msh), ("mesh", medit), ("vtu", vtu)):
            files[f"block{dim}.{ending}"] = write(*elements(dim))
        files[f"ball{dim}.vdb"] = make_level_set(program, folder, dim)
    return files
