"""Materials: the principled shader's base colour, metallic, roughness, emission, opacity and images."""

import os
import tempfile

import bpy

MEDIA_TYPES = {"PNG": "image/png", "JPEG": "image/jpeg", "WEBP": "image/webp"}
EXTENSIONS = {"image/png": ".png", "image/jpeg": ".jpg", "image/webp": ".webp"}


def principled(material):
    """The principled shader that feeds the output, or None."""
    if not material.use_nodes or material.node_tree is None:
        return None
    output = material.node_tree.get_output_node("ALL")
    link = output.inputs["Surface"].links[0] if output and output.inputs["Surface"].links else None
    node = link.from_node if link else None
    return node if node is not None and node.type == "BSDF_PRINCIPLED" else None


def image_of(socket):
    """The image that a socket gets, through a normal map or a separated channel, or None."""
    while socket is not None and socket.links:
        node = socket.links[0].from_node
        if node.type == "TEX_IMAGE":
            return node.image
        names = [name for name in ("Color", "Image", "Vector") if name in node.inputs]
        socket = node.inputs[names[0]] if names else None
    return None


class Materials:
    """Writes each material and image once, when the first mesh asks for it."""

    def __init__(self, asset, identifiers, textures, out_folder, findings):
        self.asset, self.identifiers, self.findings = asset, identifiers, findings
        self.textures, self.out_folder = textures, out_folder

    def id(self, material):
        known = self.identifiers.known("material", material.name)
        if known:
            return known
        found = self.asset.add("materials", id=self.identifiers.of("material", material.name, material.name),
                               name=material.name)
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
        red, green, blue = inputs["Base Color"].default_value[:3]
        opacity = inputs["Alpha"].default_value
        base = image_of(inputs["Base Color"])
        found.base_color = (1, 1, 1, opacity) if base else tuple(clamp(one) for one in (red, green, blue, opacity))
        found.metallic, found.roughness = clamp(inputs["Metallic"].default_value), clamp(inputs["Roughness"].default_value)
        emission = inputs.get("Emission Color") or inputs.get("Emission")
        strength = inputs["Emission Strength"].default_value if "Emission Strength" in inputs else 1.0
        found.emissive = tuple(max(0.0, one) * strength for one in emission.default_value[:3])
        self.fill_opacity(found, material, opacity, inputs["Alpha"])
        for name, image in (("base_color_texture", base), ("metallic_roughness_texture", image_of(inputs["Roughness"])),
                            ("normal_texture", image_of(inputs["Normal"]))):
            if image is not None:
                setattr(found, name, self.texture(image, material))

    @staticmethod
    def fill_opacity(found, material, opacity, socket):
        method = getattr(material, "blend_method", "OPAQUE")
        if method == "CLIP":
            found.alpha_mode, found.alpha_cutoff = "mask", material.alpha_threshold
        elif opacity < 1.0 or socket.links:
            found.alpha_mode = "blend"

    def texture(self, image, material):
        """The id of an image, embedded or copied beside the file; None where it can't be read."""
        known = self.identifiers.known("texture", image.name)
        if known:
            return known
        media, data = self.bytes_of(image)
        if data is None:
            self.findings.error(f"the image {image.name} of material {material.name} is missing ({image.filepath}): find it with "
                                "File > External Data > Find Missing Files, or take it out of the material")
            return None
        identity = self.identifiers.of("texture", image.name, image.name)
        texture = self.asset.add("textures", id=identity, name=image.name, media_type=media)
        if self.textures == "EMBED":
            texture.bytes = data
        else:
            texture.path = self.copy(identity, media, data)
        return identity

    def copy(self, identity, media, data):
        name = "textures/" + identity.split(".", 1)[1].rsplit(".", 1)[0] + EXTENSIONS[media]
        path = os.path.join(self.out_folder, *name.split("/"))
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(data)
        return name

    @staticmethod
    def bytes_of(image):
        """(media type, the file's own bytes), or, of a painted or foreign one, those of a PNG made of it."""
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

    if not image.has_data:
        return None
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "image.png")
        image.save(filepath=path) if image.file_format == "PNG" else image.save_render(path)
        with open(path, "rb") as file:
            return file.read()


def clamp(value):
    return min(1.0, max(0.0, value))
