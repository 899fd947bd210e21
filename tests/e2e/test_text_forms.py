"""Tests errors that assimp does not report in text files: joints of a second skeleton in Collada, and NaN or infinity as
Microsoft's libraries print them."""

import os
import xml.etree.ElementTree as ElementTree

import collada_files
from bundle_file import numbers, rows
from collada_files import Tube
from sbfmt_program import ProgramTest, call, main, write_bytes

FBX = """; FBX 7.3.0 project file
FBXHeaderExtension:  {{
    FBXHeaderVersion: 1003
    FBXVersion: 7300
    Creator: "one that says 1.#QNAN"
}}
Objects:  {{
    Geometry: 1, "Geometry::panel", "Mesh" {{
        Vertices: *12 {{
            a: 0,0,0,1,0,0,1,1,0,0,{},0
        }}
        PolygonVertexIndex: *4 {{
            a: 0,1,2,-4
        }}
    }}
    Model: 2, "Model::panel", "Mesh" {{
        Version: 232
    }}
}}
Connections:  {{
    C: "OO",2,0
    C: "OO",1,2
}}
"""
NO_NUMBERS = ("1.#QNAN", "-1.#IND", "1.#INF", "1.#SNAN", "nan", "inf")


class Skeletons(ProgramTest):
    def skins(self, *tubes, **options):
        """Of each skinned mesh: mean x and z of its points, and x of the bones that move it."""
        source, out = self.path("in.dae"), self.path("out.sbf")
        collada_files.write(source, tubes, **options)
        self.good("convert", source, "--no-build", "-o", out)
        root = ElementTree.parse(out).getroot()
        heads = [numbers(bone, "head") if bone.find("head") is not None else [float(n) for n in bone.get("head").split()]
                 for bone in root.iter("bone")]
        found = []
        for mesh in root.iter("render_mesh"):
            points = rows(numbers(mesh.find("polygon_mesh"), "positions"), 3)
            bones = {int(n) for n in numbers(mesh.find("skin"), "bones")}
            found.append((round(sum(p[0] for p in points) / len(points), 3), {round(heads[b][0], 3) for b in bones}))
        return sorted(found, key=lambda skin: skin[0])

    def test_each_skin_has_the_joints_of_its_own_skeleton(self):
        expected = [(-1, {-1}), (3, {3})]
        for last_first in (False, True):
            for sids in (("root", "tip"), ("other", "end")):
                with self.subTest(sids=sids, last_first=last_first):
                    tubes = Tube(0, -1), Tube(1, 3, sids)
                    self.assertEqual(self.skins(*tubes, last_first=last_first), expected)

    def test_three_of_them(self):
        self.assertEqual(self.skins(Tube(0, -1), Tube(1, 3), Tube(2, 5)), [(-1, {-1}), (3, {3}), (5, {5})])

    def test_an_object_named_as_a_joint(self):
        self.assertEqual(self.skins(Tube(0, -1, named="tip"), Tube(1, 3, ("low", "high"), named="root"), last_first=True),
                         [(-1, {-1}), (3, {3})])

    def test_ambiguous_names_are_rejected(self):
        for skeletons, printed in ((0, "does not say which one it uses"), (2, "is used with several")):
            with self.subTest(skeletons):
                source = collada_files.write(self.path("in.dae"), (Tube(0, -1, skeletons=skeletons), Tube(1, 3)))
                result = call("convert", source, "-o", self.path("out.sbf"))
                self.assertEqual(result.status, 1)
                self.assertIn("IMPORT_REFUSED", result.err)
                self.assertIn(printed, result.err)
                self.assertFalse(os.path.exists(self.path("out.sbf")))


class NoNumbers(ProgramTest):
    def refused(self, name, text, printed):
        result = call("convert", write_bytes(self.path(name), text.encode()), "-o", self.path("out.sbf"))
        self.assertEqual(result.status, 1, printed)
        self.assertIn("IMPORT_NOT_FINITE", result.err)
        self.assertIn(printed, result.err)
        self.assertFalse(os.path.exists(self.path("out.sbf")))

    def test_fbx(self):
        self.good("convert", write_bytes(self.path("in.fbx"), FBX.format("0.5").encode()), "--no-build", "-o", self.path("x.sbf"))
        for number in NO_NUMBERS:
            with self.subTest(number):
                printed = f"line 10 has {number.lstrip('-')}" if "#" in number else "is infinite or NaN"
                self.refused("in.fbx", FBX.format(number), printed)

    def test_collada(self):
        with open(collada_files.write(self.path("whole.dae"), (Tube(0, 0),)), encoding="utf-8") as stream:
            text = stream.read()
        for number in NO_NUMBERS:
            with self.subTest(number):
                self.refused("in.dae", text.replace("0.1 2 0.1", f"0.1 {number} 0.1"), number.lstrip("-") if "#" in number else "NaN")


if __name__ == "__main__":
    main()
