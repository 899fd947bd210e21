"""Meshes with their texture coordinates, materials, weights and shape keys."""

import os
import tempfile

import bpy
import numpy


def make_mesh(name, record, space):
    """A mesh of polygons and points; broken polygons, which Blender has no place for, are left out by its own check."""
    mesh = bpy.data.meshes.new(name)
    points = space.points_back(record.positions)
    sizes = numpy.array(record.polygon_sizes, dtype=numpy.int32)
    starts = numpy.cumsum(sizes, dtype=numpy.int32) - sizes
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.ravel())
    mesh.loops.add(len(record.polygon_points))
    mesh.loops.foreach_set("vertex_index", numpy.array(record.polygon_points, dtype=numpy.int32))
    mesh.polygons.add(len(sizes))
    mesh.polygons.foreach_set("loop_start", starts)
    if bpy.app.version < (4, 1, 0):
        mesh.polygons.foreach_set("loop_total", sizes)
    mesh.update(calc_edges=True)
    return mesh


def fill_uv_sets(mesh, record):
    for number, uv_set in enumerate(record.uv_sets):
        layer = mesh.uv_layers.new(name=uv_set.name or f"UV{number}", do_init=False)
        coordinates = numpy.array(uv_set.coordinates, dtype=numpy.float32).reshape(-1, 2)
        corners = uv_set.corners if len(uv_set.corners) else record.mesh.polygon_points
        layer.data.foreach_set("uv", coordinates[numpy.array(corners, dtype=numpy.int64)].ravel())


def fill_normals(mesh, record, space):
    """As stated; where they agree along every edge the mesh is drawn smooth."""
    normals = numpy.array(record.normals, dtype=numpy.float32).reshape(-1, 3)
    if not len(normals):
        return
    corners = numpy.array(record.normal_corners if len(record.normal_corners) else record.mesh.polygon_points, dtype=numpy.int64)
    if not len(record.normal_corners) or len(normals) != len(mesh.polygons):
        mesh.polygons.foreach_set("use_smooth", numpy.ones(len(mesh.polygons), dtype=bool))
    turned = space.points_back(normals[corners]) * space.unit_m
    if hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth = True
    mesh.normals_split_custom_set(turned.tolist())


def fill_materials(mesh, record, materials):
    for slot in record.material_slots:
        mesh.materials.append(materials.get(slot.material))
    if len(record.polygon_materials):
        mesh.polygons.foreach_set("material_index", numpy.array(record.polygon_materials, dtype=numpy.int32))


def fill_skin(made, record, bone_names):
    """One vertex group a bone, with its weights."""
    groups, first = {}, 0
    for vertex, count in enumerate(record.skin.influence_counts):
        for at in range(first, first + count):
            name = bone_names[record.skin.bones[at]]
            group = groups.get(name) or groups.setdefault(name, made.vertex_groups.new(name=name))
            group.add([vertex], record.skin.weights[at], "REPLACE")
        first += count


def fill_shape_keys(made, record, space):
    if not record.shape_keys:
        return
    made.shape_key_add(name="Basis", from_mix=False)
    for key in record.shape_keys:
        block = made.shape_key_add(name=key.name, from_mix=False)
        offsets = space.points_back(key.offsets)
        for point, offset in zip(key.points, offsets.tolist()):
            for axis in range(3):
                block.data[point].co[axis] += offset[axis]


def make_materials(document, folder, findings):
    """{id: material}, with a principled shader each."""
    images = {texture.id: make_image(texture, folder, findings) for texture in document.textures}
    made = {}
    for record in document.materials:
        material = made[record.id] = bpy.data.materials.new(record.name or record.id)
        material.use_nodes = True
        material.diffuse_color = record.base_color
        material.use_backface_culling = not record.double_sided
        shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
        inputs = shader.inputs
        inputs["Base Color"].default_value = (*record.base_color[:3], 1.0)
        inputs["Alpha"].default_value = record.base_color[3]
        inputs["Metallic"].default_value, inputs["Roughness"].default_value = record.metallic, record.roughness
        emission = inputs.get("Emission Color") or inputs.get("Emission")
        emission.default_value = (*record.emissive, 1.0)
        if "Emission Strength" in inputs and any(record.emissive):
            inputs["Emission Strength"].default_value = 1.0
        image = images.get(record.base_color_texture)
        if image is not None:
            node = material.node_tree.nodes.new("ShaderNodeTexImage")
            node.image = image
            material.node_tree.links.new(node.outputs["Color"], inputs["Base Color"])
    return made


def make_image(texture, folder, findings):
    """From the file beside the bundle, or from the bytes in it, packed into the .blend."""
    if texture.bytes:
        handle, path = tempfile.mkstemp(suffix=".png" if texture.media_type == "image/png" else ".jpg")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(texture.bytes)
            image = bpy.data.images.load(path)
            image.pack()
            image.name = texture.name or texture.id
            return image
        finally:
            os.unlink(path)
    path = os.path.join(folder, *texture.path.split("/"))
    if not os.path.isfile(path):
        findings.warning(f"the image {texture.path} is not beside the file: put it there and import again")
        return None
    image = bpy.data.images.load(path, check_existing=True)
    image.name = texture.name or image.name
    return image
