"""Tests what the scripts for Blender, Houdini and ParaView share, and the script for Houdini with a stand-in for it."""
import math
import re
import sys
import unittest.mock

from programs import SHARE, TOP, bounds, expect, expect_near, main, open_edges, small_run

import seiche_meshes as meshes
import seiche_run as runs


def expect_fault(action, part):
    """Fails unless an action ends with a fault whose text has a part."""
    try:
        action()
    except runs.RunFault as fault:
        expect(part in str(fault), f"the fault '{fault}' does not say '{part}'")
        return
    expect(False, f"there was no fault with '{part}'")


def test_names_and_colors():
    """File names are as src/files/point_cache.cpp makes them, colours as src/render/palette.cpp has them."""
    expect(runs.file_stems(["a b", "a_b", ".x", "é"]) == ["a_b", "a_b_", "_x", "__"], "file stems")
    text = (TOP / "src/render/palette.cpp").read_text(encoding="utf-8")
    colors = tuple(tuple(float(x) for x in m) for m in re.findall(r"Vec3f\{([\d.]+)f, ([\d.]+)f, ([\d.]+)f\}", text))
    expect(colors == runs.BODY_COLORS, f"colours are {colors} in palette.cpp")
    expect("? 0.28f : 0.52f" in text, "greys of palette.cpp")


def test_rotations():
    """Quaternions, angles and the turn to z agree."""
    half = math.sqrt(0.5)
    for name, axis in runs.UP_AXES.items():
        expect_near(runs.rotate(runs.quaternion_to_z(axis), axis), (0, 0, 1), 1e-15, f"{name} turned to z")
    q = runs.product((half, 0, 0, half), (half, half, 0, 0))  # about x, then z
    expect_near(runs.rotate(q, (0, 1, 0)), (0, 0, 1), 1e-15, "product of quaternions")
    angles = (0.0, 0.0, 0.0)
    for n in range(80):
        turn = 0.1 * n
        axis = (math.cos(turn / 2), *(math.sin(turn / 2) * a for a in (0.6, 0.0, 0.8)))
        angles = runs.angles_xyz(axis, angles)
        back = (1, 0, 0, 0)
        for k, angle in enumerate(angles):
            part = [math.cos(math.radians(angle) / 2), 0, 0, 0]
            part[k + 1] = math.sin(math.radians(angle) / 2)
            back = runs.product(part, back)
        for v in ((1, 0, 0), (0, 1, 0)):
            expect_near(runs.rotate(back, v), runs.rotate(axis, v), 1e-12, f"angles of a turn by {turn:g}")


def test_frames(run):
    """Frames, their times and faults in naming them."""
    expect(run.frames == [0, 1, 2, 3, 4], f"frames are {run.frames}")
    expect(run.choose_frames("0,2-3") == [0, 2, 3], "choice of frames")
    expect_fault(lambda: run.choose_frames("3-9"), "there is no frame 9; the run has 0 to 4")
    expect_fault(lambda: run.choose_frames("x"), "give all, 0-24, or 0,10,20")
    expect_near(run.times()[4], 4 / 24, 1e-15, "time of frame 4")
    expect(run.up == (0, 1, 0) and run.viscosity == 0 and not run.is_flat, "facts of the scene")
    expect_fault(lambda: runs.Run(run.folder / "frames"), "give the directory of a run")


def test_meshes(run):
    """Meshes are closed, in place, and as large as the tables say."""
    poses, times, folder = runs.Poses(run), run.times(), run.folder / "export"
    expect_fault(lambda: poses.at("wood box", 0.0123), "there is no row of 'wood box'")
    rest = None
    for number in run.frames:
        liquid = meshes.read_ply(runs.mesh_file(folder, "liquid", number))
        expect(open_edges(liquid.triangles) == 0, f"the liquid of frame {number} is open")
        expect(0.045 < meshes.volume(liquid) < 0.056, f"volume of the liquid in frame {number}")
        expect(liquid.attributes["velocity"].shape == liquid.points.shape, "velocities")
        pose = poses.at("wood box", times[number])
        box = meshes.read_ply(runs.mesh_file(folder, "wood_box", number))
        local = [pose.to_body(p) for p in box.points.tolist()]
        rest = local if rest is None else rest
        expect_near(local, rest, 1e-6, f"the box in its own frame, frame {number}")
        cached = meshes.read_cache_sample(run.cache(run.solids[2])[1], number)
        block = meshes.read_ply(runs.mesh_file(folder, "jelly", number))
        expect_near(bounds(cached), bounds(block.points), 1e-6, f"the cache of the block, frame {number}")
    expect(max(abs(runs.Poses(run).at("wood box", times[4]).quaternion[k]) for k in (1, 2, 3)) > 1e-3,
           "the box does not turn, so that its rotation is not tested")


def test_export(run, seiche):
    """Meshes are exported once, and again when a frame is newer."""
    said = []
    for _ in range(2):
        runs.export_meshes(run, run.frames, str(seiche), say=said.append)
    expect(not said, "meshes that are there were exported again")
    (run.folder / "export/post.ply").unlink()
    runs.export_meshes(run, run.frames, str(seiche), say=said.append)
    expect(len(said) == 1 and (run.folder / "export/post.ply").exists(), "a missing mesh was not exported")


def test_turned_exports(run, seiche):
    """Scripts turn meshes by themselves: they take them in the scene's axes where the scene has exports turned."""
    as_they_are = meshes.read_ply(runs.mesh_file(run.folder / "export", "liquid", run.frames[-1]))
    scene = run.folder / "scene.toml"
    text = scene.read_text()
    scene.write_text(text.replace('up = "scene"', 'up = "z"'))
    turning = runs.Run(run.folder)
    expect(turning.scene["output"]["up"] == "z", "the scene does not turn")
    folder = runs.export_meshes(turning, turning.frames, str(seiche), say=lambda _: None)
    again = meshes.read_ply(runs.mesh_file(folder, "liquid", run.frames[-1]))
    scene.write_text(text)
    expect(folder.name == "export_scene_axes", f"meshes are in {folder}")
    expect_near(bounds(again.points), bounds(as_they_are.points), 1e-6, "meshes for scripts")


def stand_in(keys, places):
    """A module in place of Houdini's that keeps what is set at parameters: values in places, keys in keys."""

    def node(_, name=None):
        """Any node."""
        item = unittest.mock.MagicMock()
        item.createNode.side_effect = node
        item.parm.side_effect = lambda key: unittest.mock.MagicMock(
            set=lambda value: places.__setitem__((name, key), value),
            setKeyframe=lambda k: keys.setdefault((name, key), []).append(k.setValue.call_args[0][0]))
        return item

    hou = unittest.mock.MagicMock()
    hou.node.side_effect = lambda path: node(None, path)
    hou.Keyframe.side_effect = unittest.mock.MagicMock
    hou.text.variableName.side_effect = lambda text: text.replace(" ", "_")
    return hou


def test_houdini_script(run, seiche):
    """Keys of the script for Houdini move the box as the table says. Nodes are stand-ins: this is not Houdini."""
    keys, places = {}, {}
    sys.path.insert(0, str(SHARE / "houdini"))
    with unittest.mock.patch.dict(sys.modules, {"hou": stand_in(keys, places)}):
        import import_seiche
        import_seiche.main([str(run.folder), "--seiche", str(seiche)])
    poses, times = runs.Poses(run), run.times()
    first, last = poses.at("wood box", 0.0), poses.at("wood box", times[4])
    expect_near([places["wood_box", "p" + a] for a in "xyz"], first.position, 1e-12, "pivot of the box")
    moved = [places["wood_box", "p" + a] + keys["wood_box", "t" + a][4] for a in "xyz"]
    expect_near(moved, last.position, 1e-12, "place of the box")
    angles = [keys["wood_box", "r" + a][4] for a in "xyz"]
    expect_near(angles, runs.angles_xyz(last.quaternion), 1e-9, "angles of the box")
    expect(places["fields", "file"].endswith("frame.$F4.vdb"), "sequence of the liquid")
    expect(places["mesh", "file"].endswith("jelly.$F4.obj"), "sequence of the soft block")


def test(seiche, work):
    """All of them."""
    test_names_and_colors()
    test_rotations()
    run = small_run(seiche, work)
    test_frames(run)
    test_meshes(run)
    test_export(run, seiche)
    test_turned_exports(run, seiche)
    test_houdini_script(run, seiche)


main(test)
