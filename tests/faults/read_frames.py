#!/usr/bin/python3
"""Reads frames with OpenVDB's own Python module, which shares no code with Seiche's reader, and checks what other
programs rely on: classes, types, metadata, finite values, active voxels within the domain, signs of the level set.

Usage: read_frames.py FILE...    Exit code 0 if all frames are good, else 1 with a line for each fault."""
import math
import sys

import numpy
import pyopenvdb as vdb

FILE_METADATA = {"time": float, "frame": int, "dt": float, "dimension": int, "cell_size": float,
                 "lower": tuple, "cells": tuple, "creator": str}
STATISTICS = ["file_bbox_min", "file_bbox_max", "file_voxel_count", "file_mem_bytes"]


FIELDS = ("surface", "free_surface", "vel", "velocity", "pressure", "vorticity", "viscosity")


def read_all(path):
    """Grids and metadata of a file. readAll() of Debian's module refuses files with points, as drops are."""
    try:
        return vdb.readAll(path)
    except TypeError as error:
        if "ptdataidx" not in str(error):
            raise
    grids = []
    for name in FIELDS:
        try:
            grids.append(vdb.read(path, name))
        except KeyError:
            continue
    return grids, vdb.readMetadata(path)


def metadata_faults(owner, metadata):
    for key, kind in FILE_METADATA.items():
        if key not in metadata:
            yield f"{owner}: no metadata '{key}'"
        elif not isinstance(metadata[key], kind):
            yield f"{owner}: metadata '{key}' is a {type(metadata[key]).__name__}, not {kind.__name__}"


def transform_faults(grid, metadata):
    """Voxel (i, j, k) lies at lower + (i + 1/2) h."""
    size, lower = metadata["cell_size"], metadata["lower"]
    for index in [(0, 0, 0), (3, 5, 7)]:
        world = grid.transform.indexToWorld(index)
        expected = [low + (i + 0.5) * size for low, i in zip(lower, index)]
        if not numpy.allclose(world, expected, rtol=0, atol=1e-9 * size * (1 + max(map(abs, expected)) / size)):
            yield f"{grid.name}: voxel {index} lies at {world}, not at {expected}"


def bounds_faults(grid, cells):
    """A closed surface has three layers of voxels beyond the domain."""
    if grid.activeVoxelCount() == 0:
        return
    beyond = 3 if grid.name == "surface" else 0
    low, high = grid.evalActiveVoxelBoundingBox()
    if any(l < -beyond for l in low) or any(h >= n + beyond for h, n in zip(high, cells)):
        yield f"{grid.name}: active voxels {low} to {high} leave the domain of {cells} cells"


def dense(grid, cells):
    shape = tuple(cells) + ((3,) if isinstance(grid, vdb.Vec3SGrid) else ())
    values = numpy.zeros(shape, dtype=numpy.float32)
    grid.copyToArray(values)
    return values


def level_set_faults(grid, values):
    if grid.gridClass != vdb.GridClass.LEVEL_SET:
        yield f"{grid.name}: class {grid.gridClass}, not a level set"
    band = grid.background
    if not band > 0 or numpy.abs(values).max() > band:
        yield f"{grid.name}: values beyond the background {band}"
    for axis in range(3):  # neighbours must not jump from deep inside to far outside
        steps = numpy.abs(numpy.diff(values, axis=axis))
        if steps.size and steps.max() >= 2 * band:
            yield f"{grid.name}: inside meets outside along axis {axis} without a surface between"


def value_faults(grid, cells):
    values = dense(grid, cells)
    if not numpy.isfinite(values).all():
        yield f"{grid.name}: values that are not finite"
    if grid.name == "surface" or grid.gridClass == vdb.GridClass.LEVEL_SET:
        yield from level_set_faults(grid, values)
    if isinstance(grid, vdb.Vec3SGrid):
        if grid.gridClass != vdb.GridClass.STAGGERED or grid.vectorType != "contravariant relative":
            yield f"{grid.name}: a vector grid of class {grid.gridClass}, type {grid.vectorType}"


def grid_faults(grid, metadata):
    yield from metadata_faults(grid.name, grid.metadata)
    yield from (f"{grid.name}: no statistics '{key}'" for key in STATISTICS if key not in grid.metadata)
    yield from transform_faults(grid, metadata)
    yield from bounds_faults(grid, metadata["cells"])
    yield from value_faults(grid, metadata["cells"])


def frame_faults(path):
    grids, metadata = read_all(path)
    faults = list(metadata_faults("file", metadata))
    if faults:
        return faults
    if not all(math.isfinite(metadata[key]) for key in ("time", "dt", "cell_size")):
        faults.append("file: time, dt or cell_size is not finite")
    if not grids:
        faults.append("file: no grids")
    for grid in grids:
        faults += grid_faults(grid, metadata)
    return faults


def main(paths):
    if not paths:
        print(__doc__)
        return 2
    code = 0
    for path in paths:
        try:
            faults = frame_faults(path)
        except Exception as error:  # any exception of the reader is a fault
            faults = [f"cannot be read: {error}"]
        for fault in faults:
            print(f"{path}: {fault}")
            code = 1
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
