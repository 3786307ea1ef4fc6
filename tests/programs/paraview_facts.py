"""Writes what one of ParaView's readers finds in an .xdmf as JSON. Run by pvbatch.

    pvbatch paraview_facts.py FILE.xdmf READER FACTS.json"""
import json
import pathlib
import sys

from paraview import simple as pv


def leaves(data):
    """The meshes of nested blocks."""
    if not data.IsA("vtkCompositeDataSet"):
        return [data]
    count, part = ((data.GetNumberOfPieces, data.GetPieceAsDataObject) if data.IsA("vtkMultiPieceDataSet") else
                   (data.GetNumberOfBlocks, data.GetBlock))
    return [leaf for n in range(count()) for leaf in leaves(part(n))]


def facts_of(mesh):
    """Size, bounds and arrays of a mesh."""
    arrays = {}
    for place, data in (("node", mesh.GetPointData()), ("cell", mesh.GetCellData())):
        for n in range(data.GetNumberOfArrays()):
            values = data.GetArray(n)
            arrays[f"{place} {values.GetName()}"] = [values.GetNumberOfTuples(), values.GetNumberOfComponents()]
    return {"points": mesh.GetNumberOfPoints(), "cells": mesh.GetNumberOfCells(), "bounds": mesh.GetBounds(),
            "arrays": arrays}


def main():
    """Reads all times."""
    path, reader_name, target = sys.argv[1:]
    files = {"FileNames" if reader_name == "XDMFReader" else "FileName": [path]}
    reader = getattr(pv, reader_name)(**files)
    reader.UpdatePipelineInformation()
    facts = []
    for time in reader.TimestepValues:
        reader.UpdatePipeline(time)
        meshes = [facts_of(m) for m in leaves(reader.GetClientSideObject().GetOutputDataObject(0))]
        facts.append({"time": time, "meshes": sorted(meshes, key=lambda m: -m["cells"])})
    pathlib.Path(target).write_text(json.dumps(facts), encoding="utf-8")


main()
