"""Tests the script for Blender: what it makes of a run, its pictures, its faults."""
import json

from programs import HERE, SHARE, bounds, call, expect, expect_near, expect_picture, main, need, small_run

import seiche_meshes as meshes
import seiche_run as runs

UP = runs.quaternion_to_z((0, 1, 0))


def turned(points):
    """Points of the scene in Blender's axes."""
    return [runs.rotate(UP, p) for p in points]


def importing(blender, *arguments, code=0):
    """Runs the script in Blender without a window."""
    return call([blender, "-b", "-t", "1", "--python", SHARE / "blender/import_seiche.py", "--", *arguments],
                "import in Blender", code)


def facts_of(blender, saved, run):
    """What a saved file holds, opened without the script."""
    target = saved.with_suffix(".json")
    call([blender, "-b", saved, "--python-exit-code", "1", "--python", HERE / "blender_facts.py", "--", target,
          run.folder / "export"], "reading of the saved file")
    return json.loads(target.read_text(encoding="utf-8"))


def wanted_mesh(run, solid, number):
    """Points of a solid in a frame, in Blender's axes."""
    return turned(meshes.read_ply(runs.mesh_file(run.folder / "export", solid.stem,
                                                 number if solid.moves else None)).points.tolist())


def expect_frame(run, number, shown):
    """One liquid, closed, and all solids where the tables and meshes have them."""
    liquids = [name for name in shown if name.startswith("liquid")]
    expect(liquids == [f"liquid.{number:04d}"], f"frame {number} shows {liquids}")
    liquid = shown[liquids[0]]
    source = meshes.read_ply(runs.mesh_file(run.folder / "export", "liquid", number))
    expect(liquid["open"] == 0, f"frame {number}: the liquid has {liquid['open']} open edges")
    expect(liquid["points"] == len(source.points) and 0.045 < liquid["volume"] < 0.056, f"liquid of frame {number}")
    expect({"velocity", "pressure"} <= set(liquid["attributes"]), f"attributes are {liquid['attributes']}")
    expect(liquid["materials"] == ["water"], f"materials are {liquid['materials']}")
    expect_near(liquid["bounds"], bounds(turned(source.points.tolist())), 1e-6, f"bounds of the liquid, {number}")
    for solid in run.solids:
        expect(shown[solid.name]["open"] == 0, f"frame {number}: {solid.name} is open")
        expect_near(shown[solid.name]["bounds"], bounds(wanted_mesh(run, solid, number)), 1e-6,
                    f"bounds of {solid.name}, frame {number}")
    pose = runs.Poses(run).at("wood box", run.times()[number])
    expect_near(shown["wood box"]["place"], runs.rotate(UP, pose.position), 1e-6, f"place of the box, {number}")


def expect_imported(run, facts):
    """Blender's own importers read the meshes closed and in place."""
    for name, found in facts.items():
        source = meshes.read_ply(run.folder / "export" / name.replace(".obj", ".ply"))
        expect(found["open"] == 0 and found["volume"] > 0, f"{name} is open or inside out in Blender")
        expect_near(found["bounds"], bounds(source.points), 1e-6, f"bounds of {name} in Blender")


def test_volume(blender, run, work):
    """The OpenVDB sequence gives the surface of the meshes."""
    saved = work / "volume.blend"
    importing(blender, run.folder, "--volume", "--save", saved)
    for number, shown in facts_of(blender, saved, run)["frames"].items():
        source = meshes.read_ply(runs.mesh_file(run.folder / "export", "liquid", int(number)))
        liquid = shown["liquid"]
        expect(liquid["open"] == 0 and liquid["volume"] > 0, f"the volume's surface is open or inside out in {number}")
        expect_near(liquid["bounds"], bounds(turned(source.points.tolist())), 1e-5, f"bounds of the volume, {number}")


def test_faults(blender, run):
    """Faults end with code 2 and say what to do."""
    for arguments, part in (([run.folder / "nothing"], "give the directory of a run"),
                            ([run.folder, "--frames", "7"], "there is no frame 7; the run has 0 to 4"),
                            ([run.folder, "--size", "big"], "is no size")):
        text = importing(blender, *arguments, code=2)
        expect(part in text, f"the fault does not say '{part}':\n{text[-500:]}")


def test(seiche, work):
    """Import, picture, saved file, volume, faults."""
    blender = need("blender", "blender")
    run = small_run(seiche, work)
    saved, picture = work / "small.blend", work / "small.png"
    importing(blender, run.folder, "--seiche", seiche, "--save", saved, "--render", picture, "--frame", "3",
              "--samples", "4", "--size", "160x90", "--motion-blur")
    expect_picture(picture)
    facts = facts_of(blender, saved, run)
    expect(facts["rate"] == 24 and facts["handlers"] == 0, "rate of frames, or handlers that the file would need")
    for number in run.frames:
        expect_frame(run, number, facts["frames"][str(number)])
    expect_imported(run, facts["imported"])
    test_volume(blender, run, work)
    test_faults(blender, run)


main(test)
