"""Writes an OBJ box with an image of one or two colours as its texture, for tests that find it in pictures."""
import os
import struct
import zlib


def png_of(width, height, rgb, below=None):
    """All of one colour, or of another in the lower half."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    rows = b"".join(b"\0" + bytes(below if below and row >= height // 2 else rgb) * width for row in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


BOX = """mtllib box.mtl
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 -1\nv 1 0 -1\nv 1 1 -1\nv 0 1 -1
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1
usemtl skin
f 1/1 2/2 3/3 4/4\nf 6/1 5/2 8/3 7/4\nf 5/1 1/2 4/3 8/4\nf 2/1 6/2 7/3 3/4\nf 4/1 3/2 7/3 8/4\nf 5/1 6/2 2/3 1/4
"""


def write(folder, image):
    """The path of box.obj; its material and, if any, its image are beside it."""
    material = b"newmtl skin\nKd 1 1 1\nmap_Kd red.png\n"
    for name, data in (("box.obj", BOX.encode()), ("box.mtl", material), ("red.png", image)):
        if data is not None:
            with open(os.path.join(folder, name), "wb") as stream:
                stream.write(data)
    return os.path.join(folder, "box.obj")
