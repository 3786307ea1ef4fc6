"""Tests .xdmf files in both of ParaView's readers, and the script that draws them."""
import json
import sys

from programs import (HERE, SHARE, TOP, bounds, call, expect, expect_near, expect_picture, main, need, small_run)

import seiche_meshes as meshes
import seiche_run as runs

FLAT = ["--set", "time.end=0.1", "--set", "domain.cell_size=0.0625"]


def pvbatch(*arguments, code=0):
    """Runs pvbatch with a display of its own."""
    need("Xvfb", "xvfb")
    return call([sys.executable, HERE / "virtual_display.py", need("pvbatch", "paraview (and python3-paraview)"),
                 *arguments], "pvbatch", code)


def flat_run(seiche, work):
    """A short run in 2D with its fields."""
    call([seiche, "run", TOP / "scenes/floating_boxes_2d.toml", "--out", work / "flat", "--quiet", "--threads", "1",
          *FLAT], "the run in 2D")
    call([seiche, "export", work / "flat", "--format", "xdmf"], "export of the run in 2D")
    return runs.Run(work / "flat")


def expect_read(run, reader, work, cells, nodes):
    """All times, arrays of cells and nodes, and solids are there."""
    target = work / f"{run.folder.name}_{reader}.json"
    text = pvbatch(HERE / "paraview_facts.py", run.folder / f"export/{run.folder.name}.xdmf", reader, target)
    expect("ERR|" not in text and "Error" not in text, f"{reader} complains:\n{text[-2000:]}")
    facts = json.loads(target.read_text(encoding="utf-8"))
    expect_near([f["time"] for f in facts], [run.times()[n] for n in run.frames], 1e-12, f"times of {reader}")
    for number, frame in zip(run.frames, facts):
        what = f"{reader}, {run.folder.name}, frame {number}"
        expect(len(frame["meshes"]) == 2, f"{what}: {len(frame['meshes'])} meshes in place of fluid and solids")
        fluid, solids = frame["meshes"]
        expect([fluid["cells"], fluid["points"]] == [cells, nodes], f"{what}: size of the grid")
        for name, width in (("surface", 1), ("velocity", 3)):
            expect(fluid["arrays"].get(f"cell {name}") == [cells, width], f"{what}: {name} of cells")
            expect(fluid["arrays"].get(f"node {name}_at_nodes") == [nodes, width], f"{what}: {name} of nodes")
        expect_near(fluid["bounds"][:4], [run.lower[0], run.upper[0], run.lower[1], run.upper[1]], 1e-7, what)
        expect(solids["arrays"].get("cell solid", [0])[0] == solids["cells"], f"{what}: numbers of solids")


def test_picture(run, work):
    """The script's contour lies where the mesh of the liquid is, up to a cell, and its picture shows something."""
    picture = work / "small.png"
    text = pvbatch(SHARE / "paraview/show_run.py", run.folder / "export/small.xdmf", picture, "--frame", "3",
                   "--size", "320x180")
    expect_picture(picture)
    found = [float(x) for x in text.split("bounds of the liquid")[1].split()[:6]]
    source = bounds(meshes.read_ply(runs.mesh_file(run.folder / "export", "liquid", 3)).points)
    cell = run.scene["domain"]["cell_size"]
    expect_near([found[1], found[3], found[5]], source[3:], cell, "upper bounds of the contour")
    expect_near([found[0], found[4]], source[[0, 2]], cell, "lower bounds of the contour")
    fault = pvbatch(SHARE / "paraview/show_run.py", work / "no.xdmf", picture, code=2)
    expect("there is no such file" in fault, f"the fault of a missing file says:\n{fault[-500:]}")


def test(seiche, work):
    """Both readers in 3D and 2D, then a picture."""
    need("pvbatch", "paraview (and python3-paraview)")
    small, flat = small_run(seiche, work), flat_run(seiche, work)
    for reader in ("XDMFReader", "Xdmf3ReaderS"):
        expect_read(small, reader, work, 24 ** 3, 25 ** 3)
        expect_read(flat, reader, work, 32 * 16, 33 * 17)
    test_picture(small, work)
    pvbatch(SHARE / "paraview/show_run.py", flat.folder / "export/flat.xdmf", work / "flat.png", "--size", "320x180")
    expect_picture(work / "flat.png")


main(test)
