"""Writes Collada files of several skinned tubes, each with a skeleton of two joints of its own."""


def source(name, kind, numbers, stride, parameter, of="float"):
    return (f'<source id="{name}"><{kind}_array id="{name}_a" count="{len(numbers)}">{" ".join(map(str, numbers))}</{kind}_array>'
            f'<technique_common><accessor source="#{name}_a" count="{len(numbers) // stride}" stride="{stride}">'
            f'<param name="{parameter}" type="{of}"/></accessor></technique_common></source>')


class Tube:
    """2 m high at x = `place`; `sids` are what its skin calls its joints, `named` its object."""

    def __init__(self, number, place, sids=("root", "tip"), named=None, skeletons=1):
        self.number, self.place, self.sids, self.named, self.skeletons = number, place, sids, named or f"tube{number}", skeletons

    def geometry(self):
        n = self.number
        points = [(x + self.place, y, z) for y in (0, 1, 2) for x in (-.1, .1) for z in (-.1, .1)]
        sides = ((0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6))
        faces = [[4 * ring + side[k] for k in fan] for ring in (0, 1) for side in sides for fan in ((0, 1, 2), (0, 2, 3))]
        faces += [(0, 2, 3), (0, 3, 1), (8, 9, 11), (8, 11, 10)]
        numbers = [round(c, 3) for p in points for c in p]
        return (f'<geometry id="g{n}"><mesh>{source(f"p{n}", "float", numbers, 3, "X")}'
                f'<vertices id="v{n}"><input semantic="POSITION" source="#p{n}"/></vertices><triangles count="{len(faces)}">'
                f'<input semantic="VERTEX" source="#v{n}" offset="0"/><p>{" ".join(str(i) for f in faces for i in f)}</p>'
                '</triangles></mesh></geometry>').replace('type="float"/></accessor>', 'type="float"/><param name="Y" type="float"/>'
                                                          '<param name="Z" type="float"/></accessor>')

    def controller(self):
        n = self.number
        binds = [c for y in (0, 1) for c in (1, 0, 0, -self.place, 0, 1, 0, -y, 0, 0, 1, 0, 0, 0, 0, 1)]
        weights = [w for y in (0, .5, 1) for _ in range(4) for w in (1 - y, y)]
        return (f'<controller id="c{n}"><skin source="#g{n}"><bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1'
                f'</bind_shape_matrix>{source(f"j{n}", "Name", self.sids, 1, "JOINT", "name")}'
                f'{source(f"b{n}", "float", binds, 16, "TRANSFORM", "float4x4")}{source(f"w{n}", "float", weights, 1, "WEIGHT")}'
                f'<joints><input semantic="JOINT" source="#j{n}"/><input semantic="INV_BIND_MATRIX" source="#b{n}"/></joints>'
                f'<vertex_weights count="12"><input semantic="JOINT" source="#j{n}" offset="0"/>'
                f'<input semantic="WEIGHT" source="#w{n}" offset="1"/><vcount>{"2 " * 12}</vcount>'
                f'<v>{" ".join(f"0 {2 * i} 1 {2 * i + 1}" for i in range(12))}</v></vertex_weights></skin></controller>')

    def nodes(self):
        n, matrix = self.number, '<matrix>1 0 0 {} 0 1 0 {} 0 0 1 0 0 0 0 1</matrix>'
        root, tip = self.sids
        skeleton = "".join(f"<skeleton>#s{n + k}_root</skeleton>" for k in range(self.skeletons))
        return (f'<node id="s{n}_root" name="{root}" sid="{root}" type="JOINT">{matrix.format(self.place, 0)}'
                f'<node id="s{n}_tip" name="{tip}" sid="{tip}" type="JOINT">{matrix.format(0, 1)}</node></node>'
                f'<!-- <node id="none" sid="{root}"> --><node id="m{n}" name="{self.named}" type="NODE">'
                f'<instance_controller url="#c{n}">{skeleton}</instance_controller></node>')


def write(path, tubes, last_first=False):
    order = tubes[::-1] if last_first else tubes
    with open(path, "w", encoding="utf-8") as stream:
        stream.write('<?xml version="1.0" encoding="utf-8"?>\n<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" '
                     'version="1.4.1"><asset><up_axis>Y_UP</up_axis></asset>'
                     f'<library_geometries>{"".join(t.geometry() for t in tubes)}</library_geometries>\n'
                     f'<library_controllers>{"".join(t.controller() for t in tubes)}</library_controllers>\n'
                     f'<library_visual_scenes><visual_scene id="scene">{"".join(t.nodes() for t in order)}</visual_scene>'
                     '</library_visual_scenes>\n<scene><instance_visual_scene url="#scene"/></scene></COLLADA>\n')
    return path
