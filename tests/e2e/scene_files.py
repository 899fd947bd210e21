"""Writes small files in scene formats: a box of 1 x 2 x 3 units with a corner at the origin, as a minimal file of each
format."""

import base64
import io
import json
import struct
import zipfile

POINTS = [(x, y, z) for z in (0, 3) for y in (0, 2) for x in (0, 1)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [triangle for a, b, c, d in QUADS for triangle in ((a, b, c), (a, c, d))]


def spaced(rows, end="\n"):
    return end.join(" ".join(map(str, row)) for row in rows)



def gltf():
    positions = b"".join(struct.pack("<3f", *p) for p in POINTS)
    indices = b"".join(struct.pack("<3H", *t) for t in TRIANGLES)
    data = positions + indices
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "box"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": len(positions)},
                        {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 2, 3]}, {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
    }).encode()


def dae(up="Y_UP", metres=1):
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="{metres}"/><up_axis>{up}</up_axis></asset>
<library_geometries><geometry id="g" name="box"><mesh>
<source id="p"><float_array id="pa" count="24">{spaced(POINTS, " ")}</float_array><technique_common>
<accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="6"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4 4 4 4 4 4</vcount>
<p>{spaced(QUADS, " ")}</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="box"><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
""".encode()


def ply_head(kind):
    return f"""ply
format {kind} 1.0
element vertex 8
property float x
property float y
property float z
element face 6
property list uchar int vertex_indices
end_header
"""


def ply():
    return (ply_head("ascii") + spaced(POINTS) + "\n" + spaced((4, *q) for q in QUADS) + "\n").encode()


def ply_binary():
    return (ply_head("binary_little_endian").encode() + b"".join(struct.pack("<3f", *p) for p in POINTS) +
            b"".join(struct.pack("<B4i", 4, *q) for q in QUADS))


def stl():
    facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % POINTS[i] for i in t) +
                     "endloop\nendfacet\n" for t in TRIANGLES)
    return f"solid box\n{facets}endsolid box\n".encode()


def stl_binary():
    return (b"\0" * 80 + struct.pack("<I", 12) +
            b"".join(struct.pack("<12fH", 0, 0, 0, *POINTS[a], *POINTS[b], *POINTS[c], 0) for a, b, c in TRIANGLES))


def off():
    return ("OFF\n8 6 12\n" + spaced(POINTS) + "\n" + spaced((4, *q) for q in QUADS) + "\n").encode()


def x():
    positions = ",\n".join("%g; %g; %g;" % p for p in POINTS)
    faces = ",\n".join("4; %d, %d, %d, %d;" % q for q in QUADS)  # clockwise from outside, in its left-handed axes
    return f"xof 0303txt 0032\nMesh box {{\n8;\n{positions};\n6;\n{faces};\n}}\n".encode()


def ac():
    surfaces = "".join("SURF 0x10\nmat 0\nrefs 4\n" + "".join(f"{i} 0 0\n" for i in q) for q in QUADS)
    return ('AC3Db\nMATERIAL "m" rgb 1 1 1  amb 0.2 0.2 0.2  emis 0 0 0  spec 0 0 0  shi 10  trans 0\n'
            'OBJECT world\nkids 1\nOBJECT poly\nname "box"\nnumvert 8\n' + spaced(POINTS) +
            f"\nnumsurf 6\n{surfaces}kids 0\n").encode()


def chunk(kind, body):
    return struct.pack("<HI", kind, 6 + len(body)) + body


def max_3ds():
    points = chunk(0x4110, struct.pack("<H", 8) + b"".join(struct.pack("<3f", *p) for p in POINTS))
    faces = chunk(0x4120, struct.pack("<H", 12) + b"".join(struct.pack("<4H", *t, 7) for t in TRIANGLES))
    thing = chunk(0x4000, b"box\0" + chunk(0x4100, points + faces))
    return chunk(0x4D4D, chunk(0x3D3D, thing))


def smd():
    triangles = "".join("m\n" + "".join("0 %g %g %g 0 0 1 0 0\n" % POINTS[i] for i in t) for t in TRIANGLES)
    return ("version 1\nnodes\n0 \"root\" -1\n1 \"tip\" 0\nend\nskeleton\ntime 0\n0 0 0 0 0 0 0\n1 0 1 0 0 0 0\nend\n"
            f"triangles\n{triangles}end\n").encode()


def raw():
    return (spaced(sum((POINTS[i] for i in t), ()) for t in TRIANGLES) + "\n").encode()


def nff():
    return ("".join(f"p 4\n{spaced(POINTS[i] for i in q)}\n" for q in QUADS)).encode()


def amf():
    vertices = "".join("<vertex><coordinates><x>%g</x><y>%g</y><z>%g</z></coordinates></vertex>" % p for p in POINTS)
    triangles = "".join("<triangle><v1>%d</v1><v2>%d</v2><v3>%d</v3></triangle>" % t for t in TRIANGLES)
    return (f'<?xml version="1.0"?>\n<amf unit="meter"><object id="0"><mesh><vertices>{vertices}</vertices>'
            f"<volume>{triangles}</volume></mesh></object></amf>\n").encode()


def threemf():
    vertices = "".join('<vertex x="%g" y="%g" z="%g"/>' % p for p in POINTS)
    triangles = "".join('<triangle v1="%d" v2="%d" v3="%d"/>' % t for t in TRIANGLES)
    model = ('<?xml version="1.0" encoding="UTF-8"?><model unit="millimeter" '
             'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type="model">'
             f"<mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object></resources>"
             '<build><item objectid="1"/></build></model>')
    relations = ('<?xml version="1.0" encoding="UTF-8"?><Relationships xmlns="http://schemas.openxmlformats.org/package/'
                 '2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com'
                 '/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("_rels/.rels", relations)
        archive.writestr("3D/3dmodel.model", model)
    return packed.getvalue()


def ase():
    vertices = "".join("*MESH_VERTEX %d %g %g %g\n" % (i, *p) for i, p in enumerate(POINTS))
    faces = "".join("*MESH_FACE %d: A: %d B: %d C: %d AB: 1 BC: 1 CA: 1 *MESH_SMOOTHING 1 *MESH_MTLID 0\n" % (i, *t)
                    for i, t in enumerate(TRIANGLES))
    return ('*3DSMAX_ASCIIEXPORT 200\n*GEOMOBJECT {\n*NODE_NAME "box"\n*NODE_TM {\n*NODE_NAME "box"\n'
            "*TM_ROW0 1 0 0\n*TM_ROW1 0 1 0\n*TM_ROW2 0 0 1\n*TM_ROW3 0 0 0\n}\n*MESH {\n*TIMEVALUE 0\n"
            f"*MESH_NUMVERTEX 8\n*MESH_NUMFACES 12\n*MESH_VERTEX_LIST {{\n{vertices}}}\n"
            f"*MESH_FACE_LIST {{\n{faces}}}\n}}\n}}\n").encode()


def dxf():
    faces = ""
    for quad in QUADS:
        faces += "0\n3DFACE\n8\nbox\n"
        for k, i in enumerate(quad):
            faces += "".join(f"{10 * (axis + 1) + k}\n{POINTS[i][axis]}\n" for axis in range(3))
    return f"0\nSECTION\n2\nENTITIES\n{faces}0\nENDSEC\n0\nEOF\n".encode()


FILES = {
    "box.gltf": gltf, "box.dae": dae, "box.ply": ply, "binary.ply": ply_binary, "box.stl": stl,
    "binary.stl": stl_binary, "box.off": off, "box.x": x, "box.ac": ac, "box.3ds": max_3ds, "box.smd": smd,
    "box.raw": raw, "box.nff": nff, "box.amf": amf, "box.3mf": threemf, "box.ase": ase, "box.dxf": dxf,
}
