"""Imports a run of Seiche into Blender 3.4 or newer: liquid, solids and their motion, materials, camera and light.

    blender --python share/blender/import_seiche.py -- RUN [options]
    blender -b --python share/blender/import_seiche.py -- RUN --render picture.png --frame 12

docs/other-programs.md describes what it makes; `-- --help` lists the options."""
import argparse
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "common")]

import bpy  # noqa: E402
import mathutils  # noqa: E402

import seiche_look as look  # noqa: E402
import seiche_meshes as meshes  # noqa: E402
import seiche_run as runs  # noqa: E402


def options_of(arguments):
    """Options after the `--` of Blender's command line."""
    parser = argparse.ArgumentParser(prog="import_seiche.py", description="Imports a run of Seiche into Blender.")
    parser.add_argument("run", help="directory of a run")
    parser.add_argument("--frames", default="all", help="all, 0-24, or 0,10,20")
    parser.add_argument("--volume", action="store_true",
                        help="take the liquid from the OpenVDB files as they are; smaller, without motion blur")
    parser.add_argument("--up", choices=list(runs.UP_AXES), help="axis of the scene that points up")
    parser.add_argument("--seiche", metavar="PATH", help="the program seiche")
    parser.add_argument("--save", metavar="FILE.blend", help="save what was imported")
    parser.add_argument("--render", metavar="OUT.png", help="render a picture")
    parser.add_argument("--frame", type=int, help="frame of the picture; default: the last one")
    parser.add_argument("--engine", choices=("CYCLES", "BLENDER_EEVEE"), default="CYCLES")
    parser.add_argument("--samples", type=int, default=128)
    parser.add_argument("--size", default="1280x720", help="width and height of pictures")
    parser.add_argument("--motion-blur", action="store_true", help="blur of a shutter open for half a frame")
    return parser.parse_args(arguments)


def empty_scene(run, frames):
    """An empty Blender scene with the run's frames and rate."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.name = run.folder.name
    scene.frame_start, scene.frame_end = frames[0], frames[-1]
    scene.render.fps = max(1, round(run.frame_rate))
    scene.render.fps_base = scene.render.fps / run.frame_rate
    scene.unit_settings.system = "METRIC"
    return scene


def add_object(name, data, parent, collection=None):
    """An object in the scene, or in a collection of it, below a parent."""
    item = bpy.data.objects.new(name, data)
    (collection or bpy.context.scene.collection).objects.link(item)
    item.parent = parent
    return item


def add_root(run, up):
    """An empty that turns the run's axes so that up is Blender's z."""
    root = add_object(run.folder.name, None, None)
    root.rotation_mode = "QUATERNION"
    root.rotation_quaternion = runs.quaternion_to_z(up)
    root.empty_display_size = 0.1 * max(b - a for a, b in zip(run.lower, run.upper))
    bpy.context.view_layer.update()
    return root


def make_mesh(name, source, smooth):
    """A Blender mesh with numbers at points as attributes; velocities are in m/s, as Cycles takes them."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(source.points.tolist(), [], source.triangles.tolist())
    mesh.polygons.foreach_set("use_smooth", [smooth] * len(mesh.polygons))
    for key, values in source.attributes.items():
        is_vector = values.ndim == 2
        attribute = mesh.attributes.new(key, "FLOAT_VECTOR" if is_vector else "FLOAT", "POINT")
        attribute.data.foreach_set("vector" if is_vector else "value", values.ravel().astype("f4"))
    mesh.update()
    return mesh


def set_constant(item):
    """Keys of an object hold their value until the next one."""
    for curve in item.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "CONSTANT"


def show_between(item, first, end):
    """Keys that show an object from a frame on until another one; None: until the end."""
    keys = [(first - 1, True), (first, False)] + ([(end, True)] if end is not None else [])
    for frame, hidden in keys:
        item.hide_viewport = item.hide_render = hidden
        item.keyframe_insert("hide_viewport", frame=frame)
        item.keyframe_insert("hide_render", frame=frame)
    set_constant(item)


def add_liquid(run, folder, frames, root, material):
    """One mesh a frame, each shown at its frame alone."""
    collection = bpy.data.collections.new("liquid")
    bpy.context.scene.collection.children.link(collection)
    for number, following in zip(frames, [*frames[1:], None]):
        name = f"liquid.{number:04d}"
        mesh = make_mesh(name, meshes.read_ply(runs.mesh_file(folder, "liquid", number)), True)
        mesh.materials.append(material)
        item = add_object(name, mesh, root, collection)
        if len(frames) > 1:
            show_between(item, number, following)


def add_volume(run, frames, root, material):
    """The OpenVDB sequence, hidden, and a mesh that follows its `surface`."""
    volume = bpy.data.volumes.new("liquid volume")
    volume.filepath = str(run.vdb(frames[0]))
    volume.is_sequence = len(frames) > 1
    volume.frame_start, volume.frame_duration = frames[0], frames[-1] - frames[0] + 1
    volume.frame_offset = frames[0] - 1  # Blender counts files from 1
    source = add_object("liquid volume", volume, root)
    source.hide_render = True
    source.location = [-0.5 * float(run.scene["domain"]["cell_size"])] * 3  # Volume to Mesh adds half a cell
    source.hide_set(True)
    mesh = bpy.data.meshes.new("liquid")
    mesh.materials.append(material)
    item = add_object("liquid", mesh, root)
    modifier = item.modifiers.new("surface of the liquid", "VOLUME_TO_MESH")
    modifier.object, modifier.grid_name, modifier.threshold = source, "surface", 0.0
    modifier.use_smooth_shade = True


def add_rigid(run, folder, solid, frames, poses, root):
    """A mesh about the centre of mass, with keys of its place."""
    times = run.times()
    along = poses.along(solid.name, [times[n] for n in frames])
    source = meshes.read_ply(runs.mesh_file(folder, solid.stem, frames[0]))
    first = mathutils.Matrix.LocRotScale(along[0].position, mathutils.Quaternion(along[0].quaternion), None)
    mesh = make_mesh(solid.name, source, False)
    mesh.transform(first.inverted())
    item = add_object(solid.name, mesh, root)
    item.rotation_mode = "QUATERNION"
    for number, pose in zip(frames, along):
        item.location, item.rotation_quaternion = pose.position, pose.quaternion
        item.keyframe_insert("location", frame=number)
        item.keyframe_insert("rotation_quaternion", frame=number)
    for curve in item.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    return item


def add_elastic(run, solid, root):
    """The mesh at rest, moved by the run's point cache."""
    obj, cache = run.cache(solid)
    mesh = make_mesh(solid.name, meshes.read_obj(obj), True)
    points, first, _ = meshes.read_cache_header(cache)
    if points != len(mesh.vertices):
        raise runs.RunFault(f"{cache}: has {points} points, {obj.name} {len(mesh.vertices)}")
    item = add_object(solid.name, mesh, root)
    modifier = item.modifiers.new("motion", "MESH_CACHE")
    modifier.cache_format, modifier.filepath = "PC2", str(cache)
    modifier.frame_start, modifier.interpolation = first, "LINEAR"
    return item


def add_solids(run, folder, frames, root):
    """All solids of the run; containers are frames of lines that no picture shows."""
    poses = runs.Poses(run) if any(s.moves and not s.deforms for s in run.solids) else None
    for solid in run.solids:
        if solid.deforms:
            item = add_elastic(run, solid, root)
        elif solid.moves:
            item = add_rigid(run, folder, solid, frames, poses, root)
        else:
            item = add_object(solid.name, make_mesh(solid.name, meshes.read_ply(
                runs.mesh_file(folder, solid.stem)), False), root)
        look.shade_by_angle(item.data, 50 if solid.deforms else 35)
        item.data.materials.append(look.solid_material(solid))
        if solid.is_container:
            item.hide_render, item.display_type = True, "WIRE"


def settled_depth(run, folder, number, up):
    """Depth of the liquid of a frame if it were spread over the floor; at least a twentieth of the domain."""
    sides = [b - a for a, b in zip(run.lower, run.upper)]
    height = sum(abs(u) * s for u, s in zip(up, sides))
    floor = sides[0] * sides[1] * sides[2] / height
    liquid = meshes.volume(meshes.read_ply(runs.mesh_file(folder, "liquid", number)))
    return max(liquid / floor, 0.05 * height)


def import_run(options):
    """The whole run as a Blender scene."""
    run = runs.Run(options.run)
    frames = run.choose_frames(options.frames)
    folder = runs.export_meshes(run, frames, options.seiche)
    scene = empty_scene(run, frames)
    up = runs.UP_AXES[options.up] if options.up else run.up
    root = add_root(run, up)
    material = look.liquid_material(run.viscosity, settled_depth(run, folder, frames[-1], up))
    if options.volume:
        add_volume(run, frames, root, material)
    else:
        add_liquid(run, folder, frames, root, material)
    add_solids(run, folder, frames, root)
    corners = look.domain_corners(run, root)
    look.add_stage(corners)
    look.set_render(scene, options)
    look.add_camera(corners)
    scene.frame_set(frames[0] if options.frame is None else options.frame)
    print(f"imported {run.folder.name}: {len(frames)} frames, {len(run.solids)} solids")
    return frames


def render(options, frames):
    """Renders one frame to a PNG."""
    if options.engine == "BLENDER_EEVEE" and bpy.app.background and not os.environ.get("DISPLAY"):
        raise runs.RunFault("--engine BLENDER_EEVEE needs a display; take CYCLES, or xvfb-run")
    scene = bpy.context.scene
    scene.frame_set(frames[-1] if options.frame is None else options.frame)
    scene.render.filepath = str(pathlib.Path(options.render).resolve())
    bpy.ops.render.render(write_still=True)
    if not pathlib.Path(scene.render.filepath).is_file():
        raise runs.RunFault(f"{scene.render.filepath}: was not written")


def main():
    """Runs the import; in batch, faults end Blender with code 2 and others with 1."""
    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    try:
        options = options_of(arguments)
        frames = import_run(options)
        if options.save:
            bpy.ops.wm.save_as_mainfile(filepath=str(pathlib.Path(options.save).resolve()))
        if options.render:
            render(options, frames)
    except runs.RunFault as fault:
        runs.end_with(fault)
    except Exception:
        if bpy.app.background:
            sys.excepthook(*sys.exc_info())
            sys.stderr.flush()
            sys.exit(1)
        raise


if __name__ == "__main__":
    main()
