"""Writes a panel of 1 m that faces +Z, with a given material, as binary glTF."""
import struct
import zlib

from skinned_glb import SkinnedGlb

QUARTERS = ((224, 0, 0), (0, 224, 0), (0, 0, 224), (224, 224, 0))  # upper left, upper right, lower left, lower right


def png_of_quarters(alphas=(255,) * 4, side=32):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    half = side // 2
    rows = b"".join(b"\0" + b"".join(bytes(QUARTERS[2 * (y >= half) + k] + (alphas[2 * (y >= half) + k],)) * half
                                     for k in range(2)) for y in range(side))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 6, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Panel:
    def __init__(self):
        self.file = SkinnedGlb()

    def image(self, content, media_type="image/png"):
        """The number of a texture that shows the image."""
        made = self.file.json
        self.file.binary += b"\0" * (-len(self.file.binary) % 4)
        made["bufferViews"].append({"buffer": 0, "byteOffset": len(self.file.binary), "byteLength": len(content)})
        self.file.binary += content
        made.setdefault("images", []).append({"bufferView": len(made["bufferViews"]) - 1, "mimeType": media_type})
        made.setdefault("textures", []).append({"source": len(made["images"]) - 1})
        return len(made["textures"]) - 1

    def add(self, name, material, depth=0.0, colours=None, coordinates=((0, 1), (1, 1), (1, 0), (0, 0))):
        """A square of 1 m at z = `depth`; corners from the lower left one on, seen from +Z."""
        made = self.file
        made.json.setdefault("materials", []).append(material)
        points = [(-0.5, 0.5, depth), (0.5, 0.5, depth), (0.5, 1.5, depth), (-0.5, 1.5, depth)]
        mesh = made.mesh(points, [(0, 1, 2), (0, 2, 3)], material=len(made.json["materials"]) - 1)
        attributes = made.json["meshes"][mesh]["primitives"][0]["attributes"]
        attributes["TEXCOORD_0"] = made.accessor(coordinates, "f", "VEC2")
        if colours:
            attributes["COLOR_0"] = made.accessor(colours, "f", f"VEC{len(colours[0])}")
        made.node(name, mesh=mesh)

    def write(self, path):
        return self.file.write(path)


def material(colour=(1, 1, 1, 1), texture=None, transform=None, **more):
    made = {"pbrMetallicRoughness": {"baseColorFactor": list(colour), "metallicFactor": 0}, **more}
    if texture is not None:
        made["pbrMetallicRoughness"]["baseColorTexture"] = {"index": texture}
        if transform:
            made["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {"KHR_texture_transform": transform}
    return made
