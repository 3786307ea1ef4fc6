"""Imports a run of Seiche into Houdini: liquid as polygons with velocity, solids with keys of their motion.

    hython share/houdini/import_seiche.py RUN [--frames 0-24] [--save FILE.hip]

or in Houdini's Python shell, with this folder on sys.path:

    import import_seiche; import_seiche.main(["RUN"])

It was not run: Houdini cannot be had freely, so that no test covers it. Its arithmetic is tested without Houdini."""
import argparse
import pathlib
import sys

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent.parent / "common")]

import hou  # noqa: E402

import seiche_run as runs  # noqa: E402

FRAME = "$F4"  # Houdini's frame in four digits, as in the names of files
# m/s; the second input has the fields, one of these names; the other gives 0
VELOCITY = 'v@v = volumesamplev(1, "vel", v@P) + volumesamplev(1, "velocity", v@P);'


def options_of(arguments):
    """Options of the command line."""
    parser = argparse.ArgumentParser(prog="import_seiche.py", description="Imports a run of Seiche into Houdini.")
    parser.add_argument("run", help="directory of a run")
    parser.add_argument("--frames", default="all", help="all, 0-24, or 0,10,20")
    parser.add_argument("--seiche", metavar="PATH", help="the program seiche")
    parser.add_argument("--save", metavar="FILE.hip", help="save what was imported")
    return parser.parse_args(arguments)


def node(parent, kind, name, values=None, source=None):
    """A node with values of parameters, after another one."""
    made = parent.createNode(kind, name)
    for key, value in (values or {}).items():
        made.parm(key).set(value)
    if source is not None:
        made.setInput(0, source)
    return made


def add_geometry(parent, name):
    """An object that holds geometry; spaces and the like in names become '_'."""
    return parent.createNode("geo", hou.text.variableName(name))


def add_liquid(run, parent):
    """Polygons of the grid `surface` in each frame, with velocities of `vel` for motion blur."""
    geometry = add_geometry(parent, "liquid")
    path = str(run.vdb(run.frames[0])).replace(f"{run.frames[0]:04d}.vdb", f"{FRAME}.vdb")
    fields = node(geometry, "file", "fields", {"file": path})
    surface = node(geometry, "convertvdb", "surface", {"group": "@name=surface", "conversion": "poly"}, fields)
    flow = node(geometry, "attribwrangle", "velocity", {"snippet": VELOCITY}, surface)
    flow.setInput(1, fields)
    smooth = node(geometry, "normal", "normals", None, flow)
    smooth.setDisplayFlag(True)
    smooth.setRenderFlag(True)
    geometry.layoutChildren()


def set_key(parameter, frame, value):
    """A key with a straight line to the next one."""
    key = hou.Keyframe()
    key.setFrame(frame)
    key.setValue(value)
    key.setExpression("linear()", hou.exprLanguage.Hscript)
    parameter.setKeyframe(key)


def motion_from_first(poses):
    """Shifts and angles (degrees) that move a mesh of the first pose, turned about its centre of mass."""
    first, angles, moves = poses[0], (0.0, 0.0, 0.0), []
    back = (first.quaternion[0], *(-q for q in first.quaternion[1:]))
    for pose in poses:
        shift = tuple(a - b for a, b in zip(pose.position, first.position))
        angles = runs.angles_xyz(runs.product(pose.quaternion, back), angles)
        moves.append((shift, angles))
    return moves


def add_rigid(geometry, poses, frames):
    """Keys of an object whose mesh is that of the first frame."""
    for axis, place in zip("xyz", poses[0].position):
        geometry.parm("p" + axis).set(place)
    for number, (shift, angles) in zip(frames, motion_from_first(poses)):
        for axis, length, angle in zip("xyz", shift, angles):
            set_key(geometry.parm("t" + axis), number, length)
            set_key(geometry.parm("r" + axis), number, angle)


def add_solids(run, folder, frames, parent):
    """All solids: meshes in place, with keys, or one a frame where they deform; containers are hidden."""
    poses = runs.Poses(run) if any(s.moves and not s.deforms for s in run.solids) else None
    times = run.times()
    for solid in run.solids:
        geometry = add_geometry(parent, solid.name)
        number = frames[0] if solid.moves else None
        path = str(runs.mesh_file(folder, solid.stem, number, "obj"))
        if solid.deforms:
            path = path.replace(f"{number:04d}.obj", f"{FRAME}.obj")
        elif solid.moves:
            add_rigid(geometry, poses.along(solid.name, [times[n] for n in frames]), frames)
        mesh = node(geometry, "file", "mesh", {"file": path})
        color = node(geometry, "color", "color", dict(zip(("colorr", "colorg", "colorb"), solid.color)), mesh)
        color.setDisplayFlag(True)
        color.setRenderFlag(True)
        geometry.setDisplayFlag(not solid.is_container)
        geometry.layoutChildren()


def turn_up(parent, up):
    """Turns the run so that up is y, as in Houdini."""
    x, y, z = up
    if y < -0.5:
        parent.parm("rx").set(180)
    else:
        parent.parm("rx").set(-90 * z)
        parent.parm("rz").set(90 * x)


def main(arguments=None):
    """Imports a run; faults end hython with code 2."""
    options = options_of(sys.argv[1:] if arguments is None else arguments)
    try:
        run = runs.Run(options.run)
        frames = run.choose_frames(options.frames)
        folder = runs.export_meshes(run, frames, options.seiche, "obj")
        hou.setFps(run.frame_rate)
        hou.playbar.setFrameRange(frames[0], frames[-1])
        hou.playbar.setPlaybackRange(frames[0], frames[-1])
        parent = hou.node("/obj").createNode("subnet", hou.text.variableName(run.folder.name))
        turn_up(parent, run.up)
        add_liquid(run, parent)
        add_solids(run, folder, frames, parent)
        parent.layoutChildren()
        if options.save:
            hou.hipFile.save(options.save)
    except runs.RunFault as fault:
        runs.end_with(fault)


if __name__ == "__main__":
    main()
