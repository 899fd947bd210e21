"""Imports materials as principled shaders, with their images."""

import os
import tempfile

import bpy

from ..to_document.materials import EXTENSIONS
from ..to_document.shader_nodes import Nodes


def make_materials(document, folder, findings):
    """{id: material}."""
    images = {texture.id: make_image(texture, folder, findings) for texture in document.textures}
    return {record.id: make_material(record, images) for record in document.materials}


def make_material(record, images):
    material = bpy.data.materials.new(record.name or record.id)
    material.soft_body_format.identity = record.id
    material.use_nodes = True
    material.diffuse_color = record.base_color
    material.use_backface_culling = not record.double_sided
    nodes = Nodes(material)
    color, opacity = record.base_color[:3], record.base_color[3]
    base = images.get(record.base_color_texture)
    nodes.input("Base Color").default_value = (*color, 1.0)
    if base is not None:
        nodes.link(nodes.color_times(nodes.image(base).outputs["Color"], color), nodes.input("Base Color"))
    fill_opacity(material, record, nodes, base, opacity)
    fill_roughness(record, nodes, images.get(record.metallic_roughness_texture))
    bumps = images.get(record.normal_texture)
    if bumps is not None:
        node = nodes.new("ShaderNodeNormalMap", location=(-300, -500))
        nodes.link(nodes.image(bumps, False).outputs["Color"], node.inputs["Color"])
        nodes.link(node.outputs["Normal"], nodes.input("Normal"))
    nodes.input("Emission Color", "Emission").default_value = (*record.emissive, 1.0)
    if nodes.input("Emission Strength") and any(record.emissive):
        nodes.input("Emission Strength").default_value = 1.0
    return material


def fill_opacity(material, record, nodes, base, opacity):
    """Sets the opacity; uses nodes for an image or a cutoff. Older versions of Blender also need a blend method."""
    socket = nodes.input("Alpha")
    socket.default_value = opacity
    if record.alpha_mode == "opaque":
        return
    start = nodes.times(nodes.image(base).outputs["Alpha"], opacity) if base is not None else float(opacity)
    if record.alpha_mode == "mask":
        start = nodes.by(start, record.alpha_cutoff, "GREATER_THAN")
    if not isinstance(start, float):
        nodes.link(start, socket)
    if hasattr(material, "blend_method") and bpy.app.version < (4, 2, 0):
        material.blend_method = "CLIP" if record.alpha_mode == "mask" else "BLEND"
        material.alpha_threshold = record.alpha_cutoff


def fill_roughness(record, nodes, image):
    """Green is roughness and blue metallic, as in glTF."""
    nodes.input("Metallic").default_value, nodes.input("Roughness").default_value = record.metallic, record.roughness
    if image is None:
        return
    channels = nodes.new("ShaderNodeSeparateColor", location=(-550, -200))
    nodes.link(nodes.image(image, False).outputs["Color"], channels.inputs[0])
    nodes.link(nodes.times(channels.outputs[1], record.roughness), nodes.input("Roughness"))
    nodes.link(nodes.times(channels.outputs[2], record.metallic), nodes.input("Metallic"))


def make_image(texture, folder, findings):
    """Loads an image from the file beside the bundle, or packs the bundle's embedded bytes into the .blend."""
    image = from_bytes(texture) if texture.bytes else from_file(texture, folder, findings)
    if image is not None:
        image.name = texture.name or texture.id
        image.soft_body_format.identity, image.soft_body_format.path = texture.id, texture.path
    return image


def from_bytes(texture):
    handle, path = tempfile.mkstemp(suffix=EXTENSIONS.get(texture.media_type, ".png"))
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(texture.bytes)
        image = bpy.data.images.load(path)
        image.pack()
        return image
    finally:
        os.unlink(path)


def from_file(texture, folder, findings):
    path = os.path.join(folder, *texture.path.split("/"))
    if os.path.isfile(path):
        return bpy.data.images.load(path, check_existing=True)
    findings.warning(f"the image {texture.path} is not beside the file: put it there and import again")
    return None
