"""Look of an imported run in Blender: materials, stage, light, camera, settings of the renderer."""
import math

import bpy
import mathutils

import seiche_run as runs

HONEY = 1.0  # Pa s; liquids of a higher viscosity look like honey
WATER_TINT, HONEY_TINT = (0.10, 0.62, 0.84), (0.95, 0.48, 0.06)  # colour of the light that depth leaves
BACKDROP = (0.30, 0.30, 0.30)


def new_material(name):
    """A material with a node of its output alone."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    return material, nodes, material.node_tree.links, nodes.new("ShaderNodeOutputMaterial")


def liquid_material(viscosity, depth):
    """Water, or honey above 1 Pa s: clear, tinted by its depth (m). Its shadow lets light through, without caustics."""
    is_honey = viscosity > HONEY
    material, nodes, links, output = new_material("honey" if is_honey else "water")
    body = nodes.new("ShaderNodeBsdfPrincipled")
    body.inputs["Base Color"].default_value = (1, 1, 1, 1)
    body.inputs["Transmission" if "Transmission" in body.inputs else "Transmission Weight"].default_value = 1
    body.inputs["Roughness"].default_value = 0.05 if is_honey else 0.0
    body.inputs["IOR"].default_value = 1.49 if is_honey else 1.333
    tint = HONEY_TINT if is_honey else WATER_TINT
    shadow = nodes.new("ShaderNodeBsdfTransparent")
    shadow.inputs["Color"].default_value = (*(0.75 + 0.22 * t for t in tint), 1)
    path, mix = nodes.new("ShaderNodeLightPath"), nodes.new("ShaderNodeMixShader")
    links.new(path.outputs["Is Shadow Ray"], mix.inputs[0])
    links.new(body.outputs[0], mix.inputs[1])
    links.new(shadow.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], output.inputs["Surface"])
    tinting = nodes.new("ShaderNodeVolumeAbsorption")
    tinting.inputs["Color"].default_value = (*tint, 1)
    tinting.inputs["Density"].default_value = (0.6 if is_honey else 0.32) / depth
    links.new(tinting.outputs[0], output.inputs["Volume"])
    material.diffuse_color = (*tint, 0.6)
    return material


def solid_material(solid):
    """Matt paint in the colour of `seiche render`."""
    material, nodes, links, output = new_material(solid.name)
    body = nodes.new("ShaderNodeBsdfPrincipled")
    body.inputs["Base Color"].default_value = (*solid.color, 1)
    body.inputs["Roughness"].default_value = 0.45
    links.new(body.outputs[0], output.inputs["Surface"])
    material.diffuse_color = (*solid.color, 1)
    return material


def shade_by_angle(mesh, degrees):
    """Smooth shading that keeps edges sharper than an angle."""
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    if hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth, mesh.auto_smooth_angle = True, math.radians(degrees)
    else:
        mesh.set_sharp_from_angle(angle=math.radians(degrees))


def domain_corners(run, root):
    """Corners of the domain in Blender's axes."""
    places = [(x, y, z) for x in (run.lower[0], run.upper[0]) for y in (run.lower[1], run.upper[1])
              for z in (run.lower[2], run.upper[2])]
    return [root.matrix_world @ mathutils.Vector(p) for p in places]


def extent(corners):
    """Lowest and highest coordinates of points, and the centre."""
    low = mathutils.Vector([min(c[a] for c in corners) for a in range(3)])
    high = mathutils.Vector([max(c[a] for c in corners) for a in range(3)])
    return low, high, 0.5 * (low + high)


def add_object(name, data):
    """An object in the scene."""
    item = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(item)
    return item


def add_backdrop(low, high, center, size):
    """A floor that bends up into a wall behind the domain, as in a photographer's studio.

    The floor cuts a hair off the liquid, so that no film of air mirrors between them."""
    floor, back, bend = low.z + 5e-4 * size, high.y + 2.5 * size, 1.5 * size
    turns = [math.radians(6 * n) for n in range(16)]
    profile = [(low.y - 8 * size, floor)]
    profile += [(back + bend * math.sin(t), floor + bend * (1 - math.cos(t))) for t in turns]
    profile.append((back + bend, floor + 10 * size))
    points = [(center.x + side * 14 * size, y, z) for y, z in profile for side in (-1, 1)]
    faces = [(2 * n, 2 * n + 1, 2 * n + 3, 2 * n + 2) for n in range(len(profile) - 1)]
    mesh = bpy.data.meshes.new("backdrop")
    mesh.from_pydata(points, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    material, nodes, links, output = new_material("backdrop")
    paint = nodes.new("ShaderNodeBsdfDiffuse")
    paint.inputs["Color"].default_value = (*BACKDROP, 1)
    links.new(paint.outputs[0], output.inputs["Surface"])
    mesh.materials.append(material)
    add_object("backdrop", mesh)


def add_stage(corners):
    """Backdrop, sun, sky, and a bright window behind that the liquid mirrors."""
    low, high, center = extent(corners)
    size = max(high - low)
    add_backdrop(low, high, center, size)
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle, sun.color = 4.2, math.radians(5), (1.0, 0.94, 0.86)
    add_object("sun", sun).rotation_euler = (math.radians(42), math.radians(-14), math.radians(38))
    window = bpy.data.lights.new("window", "AREA")
    window.size, window.energy = 2.0 * size, 12.0 * size * size
    item = add_object("window", window)
    item.location = center + mathutils.Vector((-1.2, 1.6, 2.2)) * size
    item.rotation_euler = (center - item.location).to_track_quat("-Z", "Y").to_euler()
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    world.use_nodes = True
    sky = world.node_tree.nodes["Background"]
    sky.inputs["Color"].default_value, sky.inputs["Strength"].default_value = (0.72, 0.86, 1.0, 1), 0.50


def add_camera(corners):
    """A camera before the domain, a little to the left and above, that sees all of it."""
    lens = bpy.data.cameras.new("camera")
    lens.lens = 50
    camera = add_object("camera", lens)
    scene = bpy.context.scene
    scene.camera = camera
    low, high, _ = extent(corners)
    direction = mathutils.Vector((0.42, 1.0, -0.42))
    camera.rotation_mode = "QUATERNION"
    camera.rotation_quaternion = direction.to_track_quat("-Z", "Y")
    bpy.context.view_layer.update()
    numbers = [x for corner in corners for x in corner]
    place, _ = camera.camera_fit_coords(bpy.context.evaluated_depsgraph_get(), numbers)
    camera.location = place - 0.05 * max(high - low) * direction
    lens.clip_end = 100 * (camera.location - low).length


def set_render(scene, options):
    """Engine, size, samples and colours of pictures."""
    try:
        width, height = (int(n) for n in options.size.split("x"))
    except ValueError as fault:
        raise runs.RunFault(f"--size: '{options.size}' is no size; give for example 1280x720") from fault
    scene.render.engine = options.engine
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.image_settings.file_format, scene.render.image_settings.color_mode = "PNG", "RGB"
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = options.motion_blur, 0.5
    if options.engine == "CYCLES":
        cycles = scene.cycles
        cycles.samples, cycles.device = options.samples, "CPU"
        cycles.max_bounces, cycles.transmission_bounces, cycles.transparent_max_bounces = 16, 16, 16
        cycles.caustics_refractive = cycles.caustics_reflective = False
        cycles.sample_clamp_indirect, cycles.use_adaptive_sampling = 4.0, True
        cycles.use_denoising = "OPENIMAGEDENOISE" in denoisers(cycles)
    else:
        scene.eevee.taa_render_samples = options.samples
        if hasattr(scene.eevee, "use_ssr"):
            scene.eevee.use_ssr = scene.eevee.use_ssr_refraction = True
    scene.view_settings.look = "High Contrast"


def denoisers(cycles):
    """Names of the denoisers in this Blender; Debian's has none."""
    try:
        cycles.denoiser = "OPENIMAGEDENOISE"
    except TypeError:
        return ()
    return (cycles.denoiser,)
