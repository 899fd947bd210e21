"""Writes materials: the principled shader's base colour, metallic, roughness, emission, opacity and images."""

import os
import re
import tempfile

import bpy
import numpy

from .shader_nodes import source_of

MEDIA_TYPES = {"PNG": "image/png", "JPEG": "image/jpeg", "WEBP": "image/webp"}
EXTENSIONS = {"image/png": ".png", "image/jpeg": ".jpg", "image/webp": ".webp"}
IMAGE_ENDINGS = (".png", ".jpg", ".jpeg", ".webp", ".tga", ".tif", ".tiff", ".bmp", ".exr", ".hdr")


def principled(material):
    """The principled shader that feeds the output, or None."""
    if not material.use_nodes or material.node_tree is None:
        return None
    output = material.node_tree.get_output_node("ALL")
    link = output.inputs["Surface"].links[0] if output and output.inputs["Surface"].links else None
    node = link.from_node if link else None
    return node if node is not None and node.type == "BSDF_PRINCIPLED" else None


class Materials:
    """Writes each material and image once, when the first mesh uses it. `files` holds the images to copy, by their paths relative to
    the bundle. They are written together with the bundle, so a failed export leaves none behind."""

    def __init__(self, asset, identifiers, textures, findings):
        self.asset, self.identifiers, self.textures, self.findings = asset, identifiers, textures, findings
        self.files, self.missing = {}, set()

    def id(self, material):
        known = self.identifiers.known("material", key_of(material))
        if known:
            return known
        found = self.asset.add("materials", name=material.name, id=self.identifiers.of(
            "material", key_of(material), material.name, material.soft_body_format.identity))
        self.fill(found, material)
        return found.id

    def fill(self, found, material):
        shader = principled(material)
        found.double_sided = not material.use_backface_culling
        if shader is None:
            found.base_color = tuple(material.diffuse_color)
            found.metallic, found.roughness = material.metallic, material.roughness
            return
        inputs = shader.inputs
        base, rough, metal = (source_of(inputs[name]) for name in ("Base Color", "Roughness", "Metallic"))
        self.fill_color(found, material, inputs, base)
        found.metallic, found.roughness = (clamp(factor_of(inputs[name], source)) for name, source in (
            ("Metallic", metal), ("Roughness", rough)))
        emission = inputs.get("Emission Color") or inputs.get("Emission")
        strength = inputs["Emission Strength"].default_value if "Emission Strength" in inputs else 1.0
        found.emissive = tuple(max(0.0, one) * strength for one in emission.default_value[:3])
        for name, image in (("base_color_texture", base.image), ("metallic_roughness_texture", rough.image or metal.image),
                            ("normal_texture", source_of(inputs["Normal"]).image)):
            if image is not None:
                setattr(found, name, self.texture(image, material))

    @staticmethod
    def fill_color(found, material, inputs, base):
        """Writes colour and opacity. An image replaces the constant; only a factor on the image counts."""
        alpha = source_of(inputs["Alpha"])
        opacity = factor_of(inputs["Alpha"], alpha)
        if base.image is None:
            color = inputs["Base Color"].default_value[:3]
        else:
            color = base.factor if isinstance(base.factor, tuple) else (base.factor, ) * 3
        found.base_color = tuple(clamp(one) for one in (*color, opacity))
        clips = getattr(material, "blend_method", "") == "CLIP"
        if alpha.cutoff is not None or clips:
            found.alpha_mode, found.alpha_cutoff = "mask", material.alpha_threshold if alpha.cutoff is None else alpha.cutoff
        elif opacity < 1.0 or inputs["Alpha"].links:
            found.alpha_mode = "blend"

    def texture(self, image, material):
        """The id of an image, embedded or copied beside the file; None where it can't be read."""
        known = self.identifiers.known("texture", key_of(image))
        if known or key_of(image) in self.missing:
            return known
        media, data = self.bytes_of(image)
        if data is None:
            self.missing.add(key_of(image))
            self.findings.error(f"the image {image.name} of material {material.name} is missing ({image.filepath}): find it with "
                                "File > External Data > Find Missing Files, or take it out of the material")
            return None
        settings = image.soft_body_format
        identity = self.identifiers.of("texture", key_of(image), image.name, settings.identity)
        texture = self.asset.add("textures", id=identity, name=image.name, media_type=media)
        if self.textures == "EMBED":
            texture.bytes = data
        else:
            texture.path = self.free_path(settings.path or f"textures/{plain_name(image.name)}{EXTENSIONS[media]}", data)
            self.files[texture.path] = data
        return identity

    def free_path(self, path, data):
        """The path, with a number if another image has the same."""
        stem, extension = os.path.splitext(path)
        number = 2
        while self.files.get(path, data) != data:
            path, number = f"{stem}.{number}{extension}", number + 1
        return path

    @staticmethod
    def bytes_of(image):
        """(media type, bytes). The file's own bytes, or a PNG of an image that is painted or of another type."""
        media = MEDIA_TYPES.get(image.file_format)
        path = bpy.path.abspath(image.filepath_raw, library=image.library)
        if image.packed_file and media and not image.is_dirty:
            return media, bytes(image.packed_file.data)
        if image.source == "FILE" and not image.packed_file:
            if not os.path.isfile(path):
                return None, None
            if media and not image.is_dirty:
                with open(path, "rb") as file:
                    return media, file.read()
        return "image/png", png_of(image)


def png_of(image):
    """A PNG of the pixels; None if Blender has no pixels. Saves a copy, because saving the image itself changes its format."""
    width, height = image.size
    if not width or not height:
        return None
    pixels = numpy.empty(width * height * 4, dtype=numpy.float32)
    image.pixels.foreach_get(pixels)
    copy = bpy.data.images.new(image.name, width, height, alpha=True)
    try:
        copy.colorspace_settings.name = image.colorspace_settings.name
        copy.pixels.foreach_set(pixels)
        with tempfile.TemporaryDirectory() as folder:
            copy.filepath_raw, copy.file_format = os.path.join(folder, "image.png"), "PNG"
            copy.save()
            with open(copy.filepath_raw, "rb") as file:
                return file.read()
    finally:
        bpy.data.images.remove(copy)


def key_of(data):
    """A unique key: a local object and one of a linked library may have the same name."""
    return (data.name, data.library.filepath if data.library else "")


def plain_name(name):
    """A file's name from an image's, without an image's extension."""
    stem, extension = os.path.splitext(name)
    stem = stem if extension.lower() in IMAGE_ENDINGS else name
    return re.sub(r"[\\/:*?\"<>|\s]+", "_", stem).strip(".") or "image"


def factor_of(socket, source):
    """The number in a socket, or the factor on its input."""
    return source.factor if socket.links and not isinstance(source.factor, tuple) else \
        1.0 if socket.links else socket.default_value


def clamp(value):
    return min(1.0, max(0.0, value))
