"""Tests `export`, and reading and writing the 2012 dialect: its values in SI units, and round trips."""

import os
import re
import unittest
import xml.etree.ElementTree as ElementTree

from sbfmt_program import ProgramTest, ROOT, call_limited, example, main, read_bytes, read_text, shared, write_bytes

BAR = os.path.join(ROOT, "spec", "samples", "dialect2012", "bar.xml")
TICK = 1 / 60


def floats(node, name):
    return [float(word) for word in node.find(name).text.split()]


class Dialect2012(ProgramTest):
    def converted(self, text, *options):
        self.good("convert", write_bytes(self.path("in.xml"), text.encode()), "-o", self.path("out.sbf"), *options)
        return ElementTree.parse(self.path("out.sbf")).getroot()

    def test_values_round_trip(self):
        for options in ((), ("--no-build",)):
            for ending in ("sbf", "sbfz"):
                path = self.path("bar." + ending)
                self.good("convert", BAR, "-o", path, *options)
                self.good("validate", "--strict", path)
                self.good("export", path, "-o", self.path("back.xml"))
                self.assertEqual(read_bytes(self.path("back.xml")), read_bytes(BAR))

    def test_sliders_have_their_meaning_in_si(self):
        root = self.converted(read_text(BAR))
        body = root.find("soft_body")
        level = body.find("level")
        numbers = floats(level, "positions")
        points = [numbers[i:i + 3] for i in range(0, len(numbers), 3)]
        corners = [int(word) for word in level.find("tetrahedron_mesh").find("tetrahedra").text.split()]
        edges = {tuple(sorted((a, b))) for i in range(0, len(corners), 4)
                 for a in corners[i:i + 4] for b in corners[i:i + 4] if a != b}
        squares = sum(sum((p - q) ** 2 for p, q in zip(points[a], points[b])) for a, b in edges)
        volume, mass, count = 0.4 * 0.2 * 0.2, 16, len(points)
        stretch, keep = 1 - (1 - 0.3) ** 4, 1 - (1 - 0.4) ** 4
        attributes = {key: float(value) for key, value in body.find("attributes").attrib.items()}
        self.assertAlmostEqual(attributes["density"], mass / volume, delta=1e-2)
        modulus = mass / count / (2 * TICK ** 2) * stretch / (1 - stretch) * squares / (6 * volume)
        self.assertAlmostEqual(attributes["young_modulus"] / modulus, 1, delta=1e-5)
        self.assertAlmostEqual(attributes["poisson_ratio"], 0.25 + 0.24 * keep, delta=1e-6)
        self.assertAlmostEqual(attributes["friction"], 0.7, delta=1e-6)
        self.assertEqual(body.find("collision").get("particle_radius"), "0.05")
        self.assertEqual(dict(body.find("legacy").attrib), {
            "mass": "16", "volume_stiffness": "0.4", "stretching_stiffness": "0.3", "friction": "0.7",
            "particle_radius": "0.05", "solver_iterations": "4"})

    def test_angles_are_radians_here(self):
        root = self.converted(read_text(BAR))
        limits = {limit.get("target"): limit for limit in root.find("joints").iter("limit")}
        self.assertEqual(limits["swing"].get("min"), "0")
        self.assertAlmostEqual(float(limits["swing"].get("max")), 0.6108652381980153, delta=1e-7)
        self.assertAlmostEqual(float(limits["twist"].get("min")), -0.2181661564992912, delta=1e-7)

    def test_every_angle_and_kind_of_joint_round_trips(self):
        text = read_text(BAR)
        kinds = ("prismatic", "revolute", "cylindrical", "spherical", "point_on_line", "point_in_plane", "distance",
                 "pulley", "fixed", "six_dof")
        targets = {"prismatic": "linear_x", "revolute": "twist", "distance": "distance", "spherical": "swing"}
        joints = "".join(
            f'      <{kind}_joint r1="1" r2="2">\n        <limits>\n          <limit target="{targets.get(kind, "twist")}"'
            f' angle="{angle}"/>\n        </limits>\n      </{kind}_joint>\n'
            for kind, angle in zip(kinds, ("0.35", "45", "0.1", "179.9", "33.333", "1e-05", "2.5", "90", "17.25", "60")))
        text = re.sub(r" *<spherical_joint.*</spherical_joint>\n", joints, text, flags=re.DOTALL)
        self.converted(text, "--no-build")
        self.good("validate", self.path("out.sbf"))
        self.good("export", self.path("out.sbf"), "-o", self.path("back.xml"))
        self.assertEqual(read_text(self.path("back.xml")), text)

    def test_unit_and_axis(self):
        root = self.converted(read_text(BAR), "--unit", "0.01", "--up", "z", "--no-build")
        level = root.find("soft_body").find("level")
        numbers = floats(level, "positions")
        self.assertAlmostEqual(max(numbers[0::3]), 0.004, delta=1e-8)
        self.assertAlmostEqual(min(numbers[2::3]), -0.002, delta=1e-8)
        self.assertEqual(root.find("soft_body").find("legacy").get("particle_radius"), "0.05")
        self.assertEqual(float(root.find("soft_body").find("collision").get("particle_radius")), 0.0005)

    def test_a_rig_is_refused(self):
        self.assertIn("its own skeleton", self.fails(2, "convert", BAR, "--rig", BAR, "-o", self.path("a.sbf")))

    def test_faults_name_the_line(self):
        text = read_text(BAR).replace('y="0.2"', 'y="high"', 1)
        message = self.fails(1, "convert", write_bytes(self.path("bad.xml"), text.encode()), "-o", self.path("a.sbf"))
        self.assertIn("bad.xml:8:", message)
        self.assertIn("high", message)

    def test_without_legacy_the_sliders_are_found_from_si(self):
        text = read_text(BAR)
        self.converted(text, "--no-build")
        plain = re.sub(r" *<legacy[^>]*/>\n", "", read_text(self.path("out.sbf")))
        self.good("export", write_bytes(self.path("plain.sbf"), plain.encode()), "-o", self.path("back.xml"))
        self.good("convert", self.path("back.xml"), "-o", self.path("again.sbf"), "--no-build")
        before = ElementTree.parse(self.path("plain.sbf")).getroot().find("soft_body").find("attributes")
        after = ElementTree.parse(self.path("again.sbf")).getroot().find("soft_body").find("attributes")
        for name in ("density", "young_modulus", "poisson_ratio", "friction"):
            self.assertAlmostEqual(float(after.get(name)) / float(before.get(name)), 1, delta=1e-4)


class Forms(ProgramTest):
    def test_obj_round_trips(self):
        source = example(self.class_folder.name)
        result = self.good("export", source, "-o", self.path("a.obj"))
        self.assertIn("bones: ", result.err)
        self.good("convert", self.path("a.obj"), "-o", self.path("b.sbf"), "--no-build")
        self.good("export", self.path("b.sbf"), "-o", self.path("b.obj"))

        def geometry(path):
            return [line for line in read_text(path).splitlines() if line.split()[0] in ("o", "v", "vt", "vn", "f")]
        self.assertEqual(geometry(self.path("b.obj")), geometry(self.path("a.obj")))
        before, after = (self.json_of("info", path) for path in (source, self.path("b.sbf")))
        self.assertEqual([mesh["polygons"] for mesh in after["render_meshes"]],
                         [mesh["polygons"] for mesh in before["render_meshes"]])
        self.assertIn("mtllib a.mtl", read_text(self.path("a.obj")))
        self.assertEqual(read_text(self.path("a.mtl")).count("newmtl"), 9)

    def test_a_failed_obj_leaves_no_material_library(self):
        source = example(self.class_folder.name)
        result = call_limited(4096, "export", source, "-o", self.path("a.obj"))
        self.assertEqual(result.status, 2)
        self.assertIn("a.obj: cannot write the file", result.err)
        self.assert_empty_folder()

    def test_tet_round_trips(self):
        self.good("convert", BAR, "-o", self.path("a.sbf"))
        self.good("export", self.path("a.sbf"), "-o", self.path("a.tet"))
        self.good("convert", self.path("a.tet"), "-o", self.path("b.sbf"))
        self.good("export", self.path("b.sbf"), "-o", self.path("b.tet"))
        self.assertEqual(read_bytes(self.path("b.tet")), read_bytes(self.path("a.tet")))

    def test_other_tetrahedra_round_trip(self):
        self.good("convert", BAR, "-o", self.path("a.sbf"))
        before = self.json_of("info", self.path("a.sbf"))
        self.good("export", self.path("a.sbf"), "-o", self.path("a.tet"))
        for ending, read in (("node", "node"), ("ele", "ele"), ("msh", "msh"), ("vtu", "vtu")):
            for name in ("b.node", "b.ele"):
                if os.path.exists(self.path(name)):
                    os.remove(self.path(name))
            printed = self.good("export", self.path("a.sbf"), "-o", self.path("b." + ending)).err
            self.assertIn("rigid bodies: 2", printed)
            self.good("convert", self.path("b." + read), "-o", self.path("c.sbf"))
            after = self.json_of("info", self.path("c.sbf"))
            for key in ("tetrahedra", "bounds"):
                self.assertEqual(after[key], before[key], ending)
            # The same points and tetrahedra, in the same order.
            self.good("export", self.path("c.sbf"), "-o", self.path("c.tet"))
            self.assertEqual(read_bytes(self.path("c.tet")), read_bytes(self.path("a.tet")), ending)

    @unittest.skipUnless(os.path.exists(shared("tets", "ball.vtk")), "the files of ../shared/data/tets are not there")
    def test_a_converted_lattice_as_the_2012_dialect(self):
        self.good("convert", shared("tets", "ball.vtk"), "-o", self.path("a.sbf"))
        self.good("export", self.path("a.sbf"), "-o", self.path("a.xml"))
        self.good("convert", self.path("a.xml"), "-o", self.path("b.sbf"))
        before, after = (self.json_of("info", self.path(name)) for name in ("a.sbf", "b.sbf"))
        for key in ("tetrahedra", "embedded_vertices", "bounds"):
            self.assertEqual(after[key], before[key])

    def test_faults(self):
        source = example(self.class_folder.name)
        self.assertIn("nothing to write", self.fails(1, "export", source, "-o", self.path("a.tet")))
        self.assertIn("ending", self.fails(2, "export", source, "-o", self.path("a.stl")))
        self.assertIn("-o", self.fails(2, "export", source))
        self.fails(2, "export", self.path("none.sbf"), "-o", self.path("a.obj"))
        self.fails(2, "export", source, "-o", self.path("no/folder/a.obj"))
        self.assert_empty_folder()


if __name__ == "__main__":
    main()
