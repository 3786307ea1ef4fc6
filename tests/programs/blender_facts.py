"""Writes what a saved import holds, and what Blender's own importers make of the meshes, as JSON. Run by Blender.

    blender -b FILE.blend --python blender_facts.py -- FACTS.json EXPORT_FOLDER"""
import json
import pathlib
import sys

import bmesh
import bpy


def facts_of(item, graph):
    """Places and closedness of an object as the renderer sees it."""
    shown = item.evaluated_get(graph)
    mesh = bmesh.new()
    mesh.from_mesh(shown.to_mesh())
    mesh.transform(shown.matrix_world)
    points = [tuple(v.co) for v in mesh.verts]
    return {"points": len(points), "open": sum(len(e.link_faces) != 2 for e in mesh.edges),
            "volume": mesh.calc_volume(signed=True), "place": list(shown.matrix_world.translation),
            "attributes": [a.name for a in item.data.attributes], "materials": [m.name for m in item.data.materials],
            "bounds": [f(p[a] for p in points) for f in (min, max) for a in range(3)]}


def visible(number):
    """Facts on all meshes that a picture of a frame shows."""
    scene = bpy.context.scene
    scene.frame_set(number)
    graph = bpy.context.evaluated_depsgraph_get()
    return {o.name: facts_of(o, graph) for o in scene.objects
            if o.type == "MESH" and not o.hide_render and o.name != "backdrop"}


def imported(path):
    """Facts on a mesh as Blender's own importer reads it."""
    before = set(bpy.data.objects)
    if path.suffix == ".ply":
        bpy.ops.import_mesh.ply(filepath=str(path))
    else:
        bpy.ops.wm.obj_import(filepath=str(path), forward_axis="Y", up_axis="Z")
    new, = set(bpy.data.objects) - before
    return facts_of(new, bpy.context.evaluated_depsgraph_get())


def main():
    """Collects all facts."""
    target, folder = sys.argv[sys.argv.index("--") + 1:]
    scene = bpy.context.scene
    numbers = range(scene.frame_start, scene.frame_end + 1)
    facts = {"rate": scene.render.fps / scene.render.fps_base, "handlers": len(bpy.app.handlers.frame_change_pre),
             "frames": {n: visible(n) for n in numbers}}
    facts["imported"] = {n: imported(pathlib.Path(folder) / n) for n in
                         ("liquid.0003.ply", "liquid.0003.obj", "wood_box.0003.obj", "post.ply")}
    pathlib.Path(target).write_text(json.dumps(facts), encoding="utf-8")


main()
