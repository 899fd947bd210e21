"""USD text that export writes: as many of everything as info counts, in units that it states; read again by our own small reader and by one
that others wrote, TinyUSDZ, with equal prims and values."""

import math
import os
import xml.etree.ElementTree as ElementTree

import play_files
import usda_files
from sbfmt_program import ProgramTest, ROOT, example, main, read_text, write_bytes

FIGURE = os.path.join(ROOT, "examples", "bones", "figure.sbf")
EVERYTHING = os.path.join(ROOT, "spec", "samples", "valid", "everything.sbf")
BAR = os.path.join(ROOT, "spec", "samples", "dialect2012", "bar.xml")
FACES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))  # of a tetrahedron, seen from outside


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def turned(quaternion, v):
    w, u = quaternion[0], quaternion[1:]
    t = [2 * c for c in cross(u, v)]
    return [a + w * b + c for a, b, c in zip(v, t, cross(u, t))]


def flat(value):
    return [one for item in value for one in flat(item)] if isinstance(value, list) else [value]


class Usda(ProgramTest):
    def exported(self, path, *options):
        """The prims, after checks that every file passes, and the source's `info`."""
        out = self.path("out.usda")
        self.said = self.good("export", path, "-o", out, *options).err
        layer, self.prims = usda_files.read(out)
        self.assertEqual((layer["defaultPrim"], layer["metersPerUnit"], layer["kilogramsPerUnit"], layer["upAxis"]),
                         ("asset", 1, 1, "Y"))
        for prim in self.prims.values():
            for name, value in prim.values.items():
                for target in [one for one in flat(value) if isinstance(one, str) and one.startswith("<")]:
                    self.assertIn(target[1:-1].split(".")[0], self.prims, f"{prim.path}.{name}")
            if prim.kind in ("Mesh", "TetMesh"):
                self.check_geometry(prim)
        return self.json_of("info", path)

    def check_geometry(self, prim):
        points = prim.values["points"]
        for k in range(3):
            self.assertAlmostEqual(min(p[k] for p in points), prim.values["extent"][0][k], delta=1e-6)
            self.assertAlmostEqual(max(p[k] for p in points), prim.values["extent"][1][k], delta=1e-6)
        if prim.kind == "TetMesh":
            return
        corners = prim.values["faceVertexIndices"]
        self.assertEqual(sum(prim.values["faceVertexCounts"]), len(corners), prim.path)
        self.assertLess(max(corners), len(points))
        for name, value in prim.values.items():
            interpolation, size = prim.meta[name].get("interpolation"), prim.meta[name].get("elementSize", 1)
            if interpolation and not f"{name}:indices" in prim.values:
                self.assertEqual(len(value), size * {"vertex": len(points), "faceVarying": len(corners)}[interpolation], name)
        weights = prim.values.get("primvars:skel:jointWeights")
        if weights:
            size = int(prim.meta["primvars:skel:jointWeights"]["elementSize"])
            for i in range(0, len(weights), size):
                self.assertAlmostEqual(sum(weights[i:i + size]), 1, delta=1e-4)

    def of_kind(self, *kinds):
        return [prim for prim in self.prims.values() if prim.kind in kinds]

    def with_schema(self, name):
        return [prim for prim in self.prims.values() if name in prim.schemas]

    def check_counts(self, info):
        shown = [prim for prim in self.of_kind("Mesh") if "/meshes/" in prim.path]
        self.assertEqual(sorted((len(prim.values["points"]), len(prim.values["faceVertexCounts"])) for prim in shown),
                         sorted((mesh["vertices"], mesh["polygons"]) for mesh in info["render_meshes"]))
        self.assertEqual(sum(len(prim.values["joints"]) for prim in self.of_kind("Skeleton")), len(info["bones"]))
        self.assertEqual(len(self.with_schema("PhysicsRigidBodyAPI")), info["rigid_bodies"])
        self.assertEqual(sum(len(prim.values["tetVertexIndices"]) for prim in self.of_kind("TetMesh")), info["tetrahedra"])

    def check_lattice(self, prim):
        """Positive tetrahedra, the skin around them, their mass, and rest shape."""
        points, tetrahedra = prim.values["points"], prim.values["tetVertexIndices"]
        inner = set()
        for t in tetrahedra:
            a, b, c, d = (points[int(i)] for i in t)
            self.assertGreater(dot(cross(minus(b, a), minus(c, a)), minus(d, a)), 0)
            for f in FACES:
                face = tuple(sorted(t[i] for i in f))
                inner.symmetric_difference_update([face])
        skin = prim.values["surfaceFaceVertexIndices"]
        self.assertEqual(sorted(tuple(sorted(face)) for face in skin), sorted(inner))
        volume = sum(dot(points[int(a)], cross(points[int(b)], points[int(c)])) / 6 for a, b, c in skin)
        whole = sum(dot(cross(minus(points[int(b)], points[int(a)]), minus(points[int(c)], points[int(a)])),
                        minus(points[int(d)], points[int(a)])) / 6 for a, b, c, d in tetrahedra)
        self.assertAlmostEqual(volume / whole, 1, delta=1e-4)
        self.assertEqual(prim.values["physics:restShapePoints"], points)
        self.assertEqual(len(prim.values["physics:masses"]), len(points))
        return whole, sum(prim.values["physics:masses"])

    def check_attachments(self):
        """Where each point is at rest is where its frame has it; how many there are."""
        held = 0
        for prim in self.of_kind("PhysicsAttachment"):
            body, frame = (self.prims[prim.values[f"physics:src{i}"][1:-1]] for i in range(2))
            positions, points = prim.values["physics:coords1"], prim.values["physics:indices0"]
            self.assertEqual(len(positions), len(points))
            held += len(points)
            for at, p in zip(positions, points):
                at = turned(frame.values.get("xformOp:orient", [1, 0, 0, 0]), at)
                at = [a + b for a, b in zip(at, frame.values.get("xformOp:translate", [0, 0, 0]))]
                self.assertLess(math.dist(at, body.values["points"][int(p)]), 2e-5, prim.path)
        return held

    def check_skeleton(self):
        """Rest transforms, one on the other along the joints' paths, are the bind transforms."""
        skeleton, = self.of_kind("Skeleton")
        joints = skeleton.values["joints"]
        for name, bind, rest in zip(joints, skeleton.values["bindTransforms"], skeleton.values["restTransforms"]):
            parent = name.rpartition("/")[0]
            above = skeleton.values["bindTransforms"][joints.index(parent)] if parent else None
            for got, want in zip(flat(product(rest, above) if above else rest), flat(bind)):
                self.assertAlmostEqual(got, want, delta=2e-5)

    def test_a_figure_with_a_soft_body(self):
        self.good("build", FIGURE, "-o", self.path("figure.sbf"))
        info = self.exported(self.path("figure.sbf"))
        self.check_counts(info)
        lattice, = self.of_kind("TetMesh")
        volume, mass = self.check_lattice(lattice)
        built = ElementTree.parse(self.path("figure.sbf")).getroot().find("soft_body/level/tetrahedron_mesh")
        self.assertAlmostEqual(mass / (volume * float(built.find("densities").text)), 1, delta=1e-3)
        matter = self.prims[lattice.values["material:binding:physics"][1:-1]]
        self.assertEqual((matter.values["physics:density"], matter.values["physics:poissonsRatio"]), (500, 0.4))
        self.assertEqual(self.check_attachments(), info["pins"])
        joints = self.of_kind("PhysicsJoint", "PhysicsRevoluteJoint", "PhysicsSphericalJoint", "PhysicsFixedJoint")
        self.assertEqual(len(joints), info["joints"])
        source = ElementTree.parse(self.path("figure.sbf")).getroot()
        limits = {node.get("id"): [(one.get("target"), float(one.get("min")), float(one.get("max"))) for one in node.iter("limit")]
                  for node in source.find("joints")}
        checked = 0
        for prim in joints:
            reported = prim.values
            for target, minimum, maximum in limits[prim.path.rpartition("/")[2]]:
                axis = {"twist": "rotX", "swing_y": "rotY", "swing_z": "rotZ"}.get(target)
                low = reported.get(f"limit:{axis}:physics:low", reported.get("physics:lowerLimit"))
                high = reported.get(f"limit:{axis}:physics:high", reported.get("physics:upperLimit"))
                if axis is None:
                    low, high = -reported.get("physics:coneAngle0Limit", reported.get("limit:rotY:physics:high")), None
                    minimum = -maximum
                if high is not None:
                    self.assertAlmostEqual(math.radians(high), maximum, delta=1e-5)
                self.assertAlmostEqual(math.radians(low), minimum, delta=1e-5, msg=prim.path)
                checked += 1
        self.assertGreater(checked, 14)
        # Hulls stand where the file has them.
        hulls = {node.get("id"): node.find("polygon_mesh") for node in source.iter("rigid_body")}
        for prim in self.with_schema("PhysicsRigidBodyAPI"):
            at = prim.values["xformOp:translate"]
            want = [float(word) for word in hulls[prim.path.rpartition("/")[2]].find("positions").text.split()]
            got = [a + b for p in self.prims[prim.path + "/hull"].values["points"] for a, b in zip(p, at)]
            self.assertLess(max(abs(a - b) for a, b in zip(got, want)), 1e-5)

    def test_sections_of_a_lizard(self):
        info = self.exported(example(self.class_folder.name))
        self.check_counts(info)
        self.check_skeleton()
        self.assertIn("neither lattices nor sheets of springs: 22", self.said)
        self.assertIn("gaits: 1", self.said)

    def test_parts_kept_of_the_complete_sample(self):
        info = self.exported(EVERYTHING)
        self.check_counts(info)
        self.check_skeleton()
        kinds = sorted(prim.kind for prim in self.prims.values() if prim.path.startswith("/asset/joints/"))
        self.assertEqual(len(kinds), info["joints"] - 1)  # but the pulley
        for left in ("pulleys: 1", "goal springs: 4", "clips: 1", "force fields: 4", "images of materials: 3"):
            self.assertIn(left, self.said)
        self.assertEqual(len(self.of_kind("BlendShape")), 1)
        lattice, = self.of_kind("TetMesh")
        self.check_lattice(lattice)
        sheet, = self.with_schema("PhysicsSurfaceDeformableSimAPI")
        self.assertEqual(set(sheet.values["faceVertexCounts"]), {3})
        self.check_attachments()
        full = len(self.prims["/asset/character/meshes/coat"].values["faceVertexCounts"])
        scene, = self.of_kind("PhysicsScene")
        self.assertAlmostEqual(scene.values["physics:gravityMagnitude"], 1.62, delta=1e-6)
        self.exported(EVERYTHING, "--render-level", "1")
        self.assertLess(len(self.prims["/asset/character/meshes/coat"].values["faceVertexCounts"]), full)

    def test_ids_that_are_invalid_names(self):
        text = read_text(FIGURE)
        for name, odd in (("chest", "a.b"), ("head", "a_b"), ("pelvis", "1-a"), ("left_thigh", "a__0")):
            text = text.replace(f'"{name}"', f'"{odd}"')
        write_bytes(self.path("odd.sbf"), text.encode())
        self.check_counts(self.exported(self.path("odd.sbf")))
        for name in ("a_b", "a_b__1", "_1_a__0", "a__0__9"):
            self.assertIn("/asset/rigid/" + name, self.prims)

    @play_files.needs_node
    def test_other_readers_read_the_same(self):
        self.good("convert", BAR, "-o", self.path("bar.sbf"))
        self.good("build", FIGURE, "-o", self.path("figure.sbf"))
        for path in (EVERYTHING, self.path("bar.sbf"), self.path("figure.sbf"), example(self.class_folder.name)):
            info = self.exported(path)
            drawn = play_files.node("read_usda.mjs", self.path("out.usda"), self.path("again.usda"))
            layer, again = usda_files.read(self.path("again.usda"))
            self.assertEqual((layer["metersPerUnit"], layer["kilogramsPerUnit"], layer["upAxis"]), (1, 1, "Y"))
            self.assertEqual({name: prim.kind for name, prim in again.items()},
                             {name: prim.kind for name, prim in self.prims.items()})
            for name, prim in self.prims.items():
                for key, value in prim.values.items():
                    if value is None:
                        continue
                    got, want = flat(again[name].values[key]), flat(value)
                    self.assertEqual(len(got), len(want), f"{name}.{key}")
                    for a, b in zip(got, want):
                        close = a == b if isinstance(b, str) else math.isclose(a, b, rel_tol=2e-5, abs_tol=2e-6)
                        self.assertTrue(close, f"{name}.{key}: {a} is no {b}")
            shown = [mesh for mesh in drawn if "/meshes/" in mesh["path"]]
            self.assertEqual(sum(mesh["triangles"] for mesh in shown), sum(mesh["triangles"] for mesh in info["render_meshes"]))

    def test_nothing_to_write(self):
        write_bytes(self.path("empty.sbf"), b'<sbf version="1.0"></sbf>')
        said = self.fails(1, "export", self.path("empty.sbf"), "-o", self.path("none.usda"))
        self.assertIn("nothing to write", said)
        self.assertFalse(os.path.exists(self.path("none.usda")))

    def test_the_same_call_gives_the_same_bytes(self):
        for name in "ab":
            self.good("export", EVERYTHING, "-o", self.path(name + ".usda"))
        self.assertEqual(read_text(self.path("a.usda")), read_text(self.path("b.usda")))


if __name__ == "__main__":
    main()
