"""VTK XML files of an unstructured grid, in every way that VTK writes their numbers."""

import base64
import itertools
import struct
import zlib

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
CELLS = [(10, (0, 1, 2, 3)), (5, (0, 1, 2)), (10, (1, 2, 3, 4))]  # a triangle between two tetrahedra
ENCODINGS = ("ascii", "binary", "appended raw", "appended base64")


def arrays(points, cells):
    """(where, name, type, letter, numbers)"""
    ends = list(itertools.accumulate(len(c) for _, c in cells))
    return [("Points", "Points", "Float32", "f", [n for p in points for n in p]),
            ("Cells", "connectivity", "Int64", "q", [i for _, c in cells for i in c]),
            ("Cells", "offsets", "Int32", "i", ends), ("Cells", "types", "UInt8", "B", [t for t, _ in cells])]


def packed(data, order, word, compress, text, block):
    """Header and data, as bytes or as base64."""
    wrap = base64.b64encode if text else bytes
    if not compress:
        return wrap(struct.pack(order + word, len(data)) + data)
    blocks = [data[i:i + block] for i in range(0, len(data), block)]
    last = len(blocks[-1]) if blocks and len(blocks[-1]) < block else 0
    stored = [zlib.compress(b) for b in blocks]
    header = struct.pack(f"{order}{3 + len(blocks)}{word}", len(blocks), block, last, *map(len, stored))
    return wrap(header) + wrap(b"".join(stored))


def vtu(encoding="ascii", compress=False, big=False, wide=False, block=48, pieces=((POINTS, CELLS),)):
    order, word, appended, body = ">" if big else "<", "Q" if wide else "I", b"", []
    for points, cells in pieces:
        body.append(f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n'
                    '<PointData><DataArray type="Float32" Name="t" format="ascii">1 2</DataArray></PointData>\n')
        rows = arrays(points, cells)
        for where in ("Points", "Cells"):
            body.append(f"<{where}>\n")
            for position, name, kind, letter, numbers in rows:
                if position != where:
                    continue
                parts = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{3 if name == "Points" else 1}"'
                data = struct.pack(f"{order}{len(numbers)}{letter}", *numbers)
                if encoding == "ascii":
                    body.append(f'{parts} format="ascii">\n{" ".join(map(str, numbers))}\n</DataArray>\n')
                elif encoding == "binary":
                    text = packed(data, order, word, compress, True, block).decode()
                    body.append(f'{parts} format="binary">\n  {text}\n</DataArray>\n')
                else:
                    body.append(f'{parts} format="appended" offset="{len(appended)}"/>\n')
                    appended += packed(data, order, word, compress, encoding.endswith("base64"), block)
            body.append(f"</{where}>\n")
        body.append("</Piece>\n")
    compressor = ' compressor="vtkZLibDataCompressor"' if compress else ""
    head = (f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" '
            f'byte_order="{"Big" if big else "Little"}Endian" header_type="UInt{64 if wide else 32}"{compressor}>\n'
            "<UnstructuredGrid>\n")
    whole = (head + "".join(body) + "</UnstructuredGrid>\n").encode()
    if encoding.startswith("appended"):
        whole += f'<AppendedData encoding="{encoding.split()[1]}">\n_'.encode() + appended + b"\n</AppendedData>\n"
    return whole + b"</VTKFile>\n"


def every_way():
    for encoding, compress, big, wide in itertools.product(ENCODINGS, (False, True), (False, True), (False, True)):
        if encoding != "ascii" or not (compress or big or wide):
            name = " ".join([encoding] + ["zlib"] * compress + ["big"] * big + ["wide"] * wide)
            yield name, vtu(encoding, compress, big, wide)
