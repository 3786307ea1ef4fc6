"""Reading of the meshes of a Seiche run: PLY of `seiche export`, OBJ and PC2 of elastic solids. Needs numpy."""
import struct

import numpy

from seiche_run import RunFault

NUMBERS = {"float": "<f4", "double": "<f8", "int": "<i4", "uint": "<u4", "uchar": "u1"}


class Mesh:
    """Points (n x 3), triangles (m x 3), and arrays of numbers at points by name."""

    def __init__(self, points, triangles, attributes=None):
        self.points, self.triangles, self.attributes = points, triangles, attributes or {}


def ply_header(file, path):
    """Counts of vertices and faces, and the type of a vertex."""
    counts, columns, element = {}, [], None
    if file.readline().strip() != b"ply":
        raise RunFault(f"{path}: is no PLY file")
    while (line := file.readline()) and line.strip() != b"end_header":
        words = line.decode().split()
        if words[0] == "format" and words[1] != "binary_little_endian":
            raise RunFault(f"{path}: has the format {words[1]}; Seiche writes binary_little_endian")
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        if words[0] == "property" and element == "vertex":
            columns.append((words[2], NUMBERS[words[1]]))
    return counts.get("vertex", 0), counts.get("face", 0), numpy.dtype(columns)


def read_ply(path):
    """Mesh of a PLY file of Seiche: triangles, `velocity` of vx, vy, vz, and further numbers at points."""
    face = numpy.dtype([("count", "u1"), ("corners", "<i4", 3)])
    try:
        with open(path, "rb") as file:
            points, faces, vertex = ply_header(file, path)
            vertices = numpy.frombuffer(file.read(points * vertex.itemsize), vertex)
            triangles = numpy.frombuffer(file.read(faces * face.itemsize), face)
    except (OSError, ValueError) as fault:
        raise RunFault(f"{path}: cannot be read ({fault})") from fault
    if len(vertices) != points or len(triangles) != faces or (triangles["count"] != 3).any():
        raise RunFault(f"{path}: is cut off, or has faces that are no triangles")
    joined = {"velocity": ("vx", "vy", "vz")} if "vx" in vertex.names else {}
    attributes = {name: stacked(vertices, parts) for name, parts in joined.items()}
    attributes |= {n: vertices[n] for n in vertex.names if n not in ("x", "y", "z", "vx", "vy", "vz")}
    return Mesh(stacked(vertices, ("x", "y", "z")), triangles["corners"], attributes)


def stacked(rows, names):
    """Columns of a table beside each other."""
    return numpy.stack([rows[name] for name in names], axis=-1)


def volume(mesh):
    """Volume within a closed mesh whose triangles face outwards."""
    a, b, c = (mesh.points[mesh.triangles[:, k]].astype(float) for k in range(3))
    return float(numpy.einsum("ij,ij->", a, numpy.cross(b, c)) / 6)


def read_obj(path):
    """Mesh of an OBJ file of Seiche, points in the order of the file."""
    points, triangles = [], []
    try:
        with open(path, encoding="utf-8") as file:
            for line in file:
                words = line.split()
                if words[:1] == ["v"]:
                    points.append([float(w) for w in words[1:4]])
                elif words[:1] == ["f"]:
                    triangles.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
    except OSError as fault:
        raise RunFault(f"{path}: cannot be read") from fault
    return Mesh(numpy.array(points).reshape(-1, 3), numpy.array(triangles, dtype=int).reshape(-1, 3))


def read_cache_header(path):
    """Number of points, first frame and number of samples of a PC2 file."""
    try:
        with open(path, "rb") as file:
            mark, version, points, first, rate, samples = struct.unpack("<12siiffi", file.read(32))
    except (OSError, struct.error) as fault:
        raise RunFault(f"{path}: cannot be read") from fault
    if mark != b"POINTCACHE2\0" or version != 1 or rate != 1:
        raise RunFault(f"{path}: is no point cache of Seiche")
    return points, int(first), samples


def read_cache_sample(path, number):
    """Points (n x 3) of frame `number` in a PC2 file."""
    points, first, samples = read_cache_header(path)
    if not first <= number < first + samples:
        raise RunFault(f"{path}: has no frame {number}; it holds {first} to {first + samples - 1}")
    values = numpy.fromfile(path, "<f4", 3 * points, offset=32 + 12 * points * (number - first))
    return values.reshape(-1, 3)
