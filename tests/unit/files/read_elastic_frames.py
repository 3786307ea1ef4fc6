#!/usr/bin/python3
"""Reads a run's output of elastic solids, independently of Seiche's code, and checks that it is consistent:
elastic.NNNN.vtu (types, fields, positive volumes), elastic.pvd, and for each point cache NAME.pc2 with NAME.obj: one
sample per frame, each point at the position of a node in the frame, the .obj at the nodes' rest positions.

Usage: read_elastic_frames.py FRAMES_FOLDER    Exit code 0 if all is well, else 1 with a line for each fault."""
import base64
import pathlib
import re
import struct
import sys
import xml.etree.ElementTree as xml

import numpy

TYPES = {"Float64": "<f8", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}
NODES = {5: 3, 10: 4, 22: 6, 24: 10}  # by VTK's cell type


def array(element):
    data = base64.b64decode(element.text)
    size = struct.unpack("<Q", data[:8])[0]
    values = numpy.frombuffer(data[8:8 + size], TYPES[element.get("type")])
    assert len(data) == 8 + size, element.get("Name")
    components = int(element.get("NumberOfComponents"))
    return values.reshape(-1, components) if components > 1 else values


def read_vtu(file):
    root = xml.parse(file).getroot()
    return {e.get("Name"): array(e) for e in root.iter("DataArray") if e.get("format") == "binary"}


def volumes(points, cells, kind):
    corners = points[cells[:, :3 if kind in (5, 22) else 4]]
    edges = corners[:, 1:] - corners[:, :1]
    if edges.shape[1] == 2:
        return numpy.cross(edges[:, 0, :2], edges[:, 1, :2]) / 2
    return numpy.linalg.det(edges) / 6


def frame_faults(name, frame):
    count = len(frame["Points"])
    for field, shape in [("displacement", (count, 3)), ("velocity", (count, 3)), ("von_mises", (count,))]:
        if frame[field].shape != shape or not numpy.isfinite(frame[field]).all():
            yield f"{name}: {field} has shape {frame[field].shape} or is not finite"
    if (frame["von_mises"] < 0).any():
        yield f"{name}: negative stress"
    starts = numpy.concatenate([[0], frame["offsets"][:-1]])
    for kind in numpy.unique(frame["types"]):
        chosen = frame["types"] == kind
        if (frame["offsets"] - starts)[chosen].tolist() != [NODES[kind]] * int(chosen.sum()):
            yield f"{name}: cells of type {kind} do not have {NODES[kind]} nodes"
            continue
        cells = frame["connectivity"][starts[chosen][:, None] + numpy.arange(NODES[kind])]
        if (volumes(frame["Points"] - frame["displacement"], cells, kind) <= 0).any():
            yield f"{name}: elements of type {kind} have no volume at rest"


def read_cache(file):
    data = file.read_bytes()
    magic, version, points, start, rate, samples = struct.unpack("<12siiffi", data[:32])
    assert magic == b"POINTCACHE2\0" and version == 1 and rate == 1, file
    numbers = numpy.frombuffer(data[32:], "<f4")
    return int(start), numbers.reshape(samples, points, 3)


def cache_faults(file, frames):
    start, samples = read_cache(file)
    if start != 0 or len(samples) != len(frames):
        yield f"{file.name}: {len(samples)} samples from frame {start}, but {len(frames)} frames"
        return
    rest = numpy.array([[float(x) for x in line.split()[1:]]
                        for line in file.with_suffix(".obj").read_text().splitlines() if line.startswith("v ")])
    faces = re.findall(r"^[fl] .*$", file.with_suffix(".obj").read_text(), re.M)
    if len(rest) != samples.shape[1] or not faces:
        yield f"{file.name}: {samples.shape[1]} points, but {len(rest)} in its .obj, {len(faces)} faces"
        return
    undeformed = frames[0]["Points"] - frames[0]["displacement"]
    size = numpy.ptp(undeformed, axis=0).max()
    # Each sample point must follow the node whose rest position is nearest to the point of the .obj.
    nodes = numpy.linalg.norm(undeformed[None] - rest[:, None], axis=2).argmin(axis=1)
    if numpy.abs(undeformed[nodes] - rest).max() > 1e-6 * size:
        yield f"{file.name}: its .obj is not the surface at rest"
    for number, (sample, frame) in enumerate(zip(samples, frames)):
        if numpy.abs(frame["Points"][nodes] - sample).max() > 1e-6 * (size + numpy.abs(sample).max()):
            yield f"{file.name}: sample {number} is not where the frame has its nodes"


def faults(folder):
    files = sorted(folder.glob("elastic.*.vtu"))
    listed = [e.get("file") for e in xml.parse(folder / "elastic.pvd").getroot().iter("DataSet")]
    if listed != [file.name for file in files] or not files:
        yield f"elastic.pvd lists {listed}, there are {[file.name for file in files]}"
    frames = [read_vtu(file) for file in files]
    for file, frame in zip(files, frames):
        yield from frame_faults(file.name, frame)
    caches = sorted(folder.glob("*.pc2"))
    if not caches:
        yield "there are no point caches"
    for cache in caches:
        yield from cache_faults(cache, frames)


if __name__ == "__main__":
    found = list(faults(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
