"""Parts of screenshots as small PNGs."""

import struct
import zlib

import numpy


def save_part(screen, out, box, trim_bottom=False):
    """The pixels within `box` (low x, low y, high x, high y, from the bottom left) of a screen's file, an X window dump. `trim_bottom`
    cuts the empty end off."""
    with open(screen, "rb") as file:
        dump = file.read()
    header = struct.unpack(">25I", dump[:100])
    width, height, row_bytes = header[4], header[5], header[12]
    pixels = numpy.frombuffer(dump, numpy.uint8, height * row_bytes, header[0] + 12 * header[19]).reshape(height, row_bytes)
    pixels = pixels[:, :4 * width].reshape(height, width, 4)[:, :, 2::-1]  # least significant first: blue, green, red
    shown = pixels[height - box[3]:height - box[1], box[0]:box[2]]
    if trim_bottom:
        inner = shown[:-12, 6:-20]  # without borders and the scroll bar
        rows = numpy.flatnonzero((inner != inner[:, :1]).any(axis=(1, 2)))
        shown = shown[:min(len(shown), int(rows[-1]) + 16)] if len(rows) else shown
    write_png(out, shown)


def write_png(path, pixels):
    """An 8-bit PNG with a palette: the colours as they are where there are few, else those that occur, coarser."""
    bits = 8
    while True:
        coarse = (pixels >> (8 - bits)) << (8 - bits)
        packed = (coarse[..., 0].astype(numpy.uint32) << 16) | (coarse[..., 1].astype(numpy.uint32) << 8) | coarse[..., 2]
        colors, which, counts = numpy.unique(packed, return_inverse=True, return_counts=True)
        if len(colors) <= 256 or bits <= 5:
            break
        bits -= 1
    which = which.reshape(packed.shape)
    if len(colors) > 256:  # the rest take the nearest of the most frequent
        kept = numpy.sort(numpy.argsort(counts)[-256:])
        rgb = numpy.stack([(colors >> shift) & 255 for shift in (16, 8, 0)], axis=1).astype(numpy.int32)
        nearest = ((rgb[:, None] - rgb[kept][None]) ** 2).sum(axis=2).argmin(axis=1)
        colors, which = colors[kept], nearest[which]
    palette = b"".join(struct.pack(">I", int(color))[1:] for color in colors)
    rows = numpy.concatenate([numpy.zeros((len(which), 1), dtype=numpy.uint8), which.astype(numpy.uint8)], axis=1)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 3, 0, 0, 0)
        for kind, data in ((b"IHDR", header), (b"PLTE", palette), (b"IDAT", zlib.compress(rows.tobytes(), 9)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))
