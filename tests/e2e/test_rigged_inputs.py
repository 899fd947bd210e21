"""Tests unusual contents of an OBJ and its rig: several characters, vertex colours, free-form curves, objects named like bones,
an OBJ that is another skin, several skins."""

import json
import os

import obj_variants as variants
from bundle_file import Bundle
from rigged_weights import weights_by_vertex
from skinned_glb import SkinnedGlb, box, inverse_binds, tube
from sbfmt_program import SOURCE_PARTS, ProgramTest, call, main, read_text
from test_computed_weights import write_arm, write_bones


def at(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def obj_of(objects):
    """{name: (points, triangles)} as an OBJ."""
    points, faces = [], []
    for name, (places, triangles) in objects.items():
        faces += [(name, None, [(len(points) + p, None, None) for p in t]) for t in triangles]
        points += places
    return variants.Obj(points, [], [], faces)


class Column:
    """A column of two bones with a skin, and a hat with a skin of its own, which a third bone bends."""

    def __init__(self, names=("low", "high", "plume")):
        self.glb = SkinnedGlb()
        self.body, self.hat = tube(0, 2, 0.2), tube(2.1, 2.5, 0.3, 5)
        worlds = [at(0, 0, 0), at(0, 1, 0), at(0, 2.2, 0)]
        self.joints = []
        for name, world, offset in zip(names, worlds, (0, 1, 1.2)):
            self.joints.append(self.glb.node(name, self.joints[-1] if self.joints else None, at(0, offset, 0)))
        self.wanted = {}
        for name, (points, triangles), bones, cut in (("body", self.body, (0, 1), 1.0), ("hat", self.hat, (1, 2), 2.3)):
            chosen = [0 if p[1] < cut else 1 for p in points]
            mesh = self.glb.mesh(points, triangles, [(c, 0, 0, 0) for c in chosen], [(1, 0, 0, 0)] * len(points))
            skin = self.glb.skin([self.joints[b] for b in bones], inverse_binds([worlds[b] for b in bones], at(0, 0, 0)))
            self.glb.node(name, mesh=mesh, skin=skin)
            self.wanted[name] = [names[bones[c]] for c in chosen]

    def objects(self):
        return {"body": self.body, "hat": self.hat}


class RiggedInputs(ProgramTest):
    def convert(self, obj, rig, *options):
        if isinstance(obj, variants.Obj):
            variants.write(obj, self.path("in.obj"))
            obj = self.path("in.obj")
        done = self.good("convert", obj, "--rig", rig, *SOURCE_PARTS, *options, "-o", self.path("out.sbf"))
        return [max(w, key=w.get) for _, (w, _) in sorted(weights_by_vertex(self.path("out.sbf")).items())], done.err

    def test_a_rig_with_two_skins(self):
        column = Column()
        rig = column.glb.write(self.path("rig.glb"))
        wanted = column.wanted["body"] + column.wanted["hat"]
        for name, obj in {"two objects": obj_of(column.objects()),
                          "one object, in centimetres": variants.moved(variants.one_object(obj_of(column.objects())), 0.01),
                          }.items():
            with self.subTest(name):
                found, printed = self.convert(obj, rig)
                self.assertEqual(found, wanted)
                self.assertIn(f"{len(wanted)} from the same positions of the rig's mesh", printed)
        found, _ = self.convert(obj_of({"hat": column.hat}), rig)
        self.assertEqual(found, column.wanted["hat"])

    def test_an_object_of_several_shells_in_pieces(self):
        """They have no border in common, and yet are one object where they lie on one of the rig."""
        column = Column()
        bag = [box((0.3, 0.2, -0.1), (0.5, 0.6, 0.1)), box((0.35, 0.65, -0.05), (0.45, 0.7, 0.05))]
        points = bag[0][0] + bag[1][0]
        triangles = bag[0][1] + [tuple(i + 8 for i in t) for t in bag[1][1]]
        column.glb.node("bag", column.joints[0], mesh=column.glb.mesh(points, triangles))
        rig = column.glb.write(self.path("rig.glb"))
        objects = {**column.objects(), "a": bag[0], "b": bag[1]}
        found, _ = self.convert(obj_of(objects), rig)
        self.assertEqual(found[-16:], ["low"] * 16)
        self.assertEqual(self.meshes(), {"body": 72, "hat": 40, "bag": 16})
        self.convert(obj_of({**objects, "b": box((0.35, 0.65, -0.05), (0.45, 0.72, 0.05))}), rig)
        self.assertEqual(self.meshes(), {"body": 72, "hat": 40, "a": 8, "b": 8})

    def meshes(self):
        """Numbers of points by name."""
        bundle = Bundle(self.path("out.sbf"))
        return {mesh.get("name"): len(bundle.positions(mesh)) for mesh in bundle.meshes}

    def test_several_files_with_one_rig(self):
        column = Column()
        rig = column.glb.write(self.path("rig.glb"))
        for name, mesh in column.objects().items():
            variants.write(obj_of({name: mesh}), self.path(name + ".obj"))
        os.mkdir(self.path("out"))
        self.good("convert", self.path("body.obj"), self.path("hat.obj"), "--rig", rig, *SOURCE_PARTS, "--out-dir",
                  self.path("out"))
        for name, wanted in column.wanted.items():
            found = weights_by_vertex(os.path.join(self.path("out"), name + ".sbf"))
            self.assertEqual([max(w, key=w.get) for _, (w, _) in sorted(found.items())], wanted)

    def test_several_characters_in_one_file(self):
        """The rig belongs to one of them: the other is reported, and can be assigned to a bone or left out."""
        column = Column()
        rig = column.glb.write(self.path("rig.glb"))
        objects = {"body": column.body, "hat": column.hat,
                   "stranger": ([(x + 4, y, z) for x, y, z in tube(0, 2, 0.2, 20)[0]], tube(0, 2, 0.2, 20)[1])}
        found, printed = self.convert(obj_of(objects), rig)
        self.assertEqual(found[:len(column.body[0])], column.wanted["body"])
        self.assertIn("is inside or near the object 'stranger'", printed)
        self.assertNotIn("RIG_OTHER_MESH", printed)
        self.assertIn("RIG_OBJECT_APART", printed)
        self.assertNotIn("object 'hat'", printed)
        _, printed = self.convert(obj_of(column.objects()), rig)
        self.assertNotIn("RIG_OBJECT_APART", printed)
        found, printed = self.convert(obj_of(objects), rig, "--shell", "stranger=low")
        self.assertEqual(set(found[-len(objects["stranger"][0]):]), {"low"})
        self.assertNotIn("RIG_OBJECT_APART", printed)

    def test_bones_of_a_rig_with_another_mesh(self):
        """The bones are inside the input but may be another character's: this is reported. At a wrong scale they are refused."""
        column = Column()
        rig = column.glb.write(self.path("rig.glb"))
        points, triangles = tube(0, 2.6, 0.9)
        barrel = obj_of({"barrel": ([(1.3 * x, y, 0.8 * z) for x, y, z in points], triangles)})
        _, printed = self.convert(barrel, rig)
        self.assertIn("RIG_OTHER_MESH", printed)
        self.assertRegex(printed, r"they are \d+ % of the mesh's size apart; its bones \(\d+ % of them inside")
        odd = variants.moved(barrel, 0.137)
        variants.write(odd, self.path("odd.obj"))
        os.remove(self.path("out.sbf"))
        refused = self.fails(1, "convert", self.path("odd.obj"), "--rig", rig, "-o", self.path("out.sbf"))
        self.assertIn("RIG_MISFIT", refused)
        self.assertIn("which is not a usual unit", refused)
        self.assertFalse(os.path.exists(self.path("out.sbf")))
        for obj in (barrel, odd, obj_of(column.objects())):
            _, printed = self.convert(obj, rig, "--weights", "compute")
            self.assertNotIn("RIG_OTHER_MESH", printed)
        _, printed = self.convert(odd, rig, "--unit", "0.137")
        self.assertIn("RIG_OTHER_MESH", printed)
        _, printed = self.convert(obj_of({**column.objects(), "beside": tube(4, 6, 0.2)}), rig)
        self.assertNotIn("RIG_OTHER_MESH", printed)

    def test_a_mesh_that_resembles_the_rigs(self):
        """Another character of the same maker may have the same hat: weights transferred to its body are reported."""
        column = Column()
        rig = column.glb.write(self.path("rig.glb"))
        (points, triangles), objects = column.body, column.objects()
        objects["body"] = ([(1.08 * x, y, 1.08 * z) for x, y, z in points], triangles)
        _, printed = self.convert(obj_of(objects), rig)
        self.assertIn(f"{len(column.hat[0])} from the same positions of the rig's mesh", printed)
        self.assertRegex(printed, r"resembles the input, but half of the input's surface is farther from it than \d")
        self.assertIn("RIG_OTHER_MESH", printed)
        _, printed = self.convert(obj_of(objects), rig, "--weights", "transfer")
        self.assertNotIn("RIG_OTHER_MESH", printed)
        for edited in (variants.jiggled(obj_of(column.objects()), 1, 0.004), variants.jiggled(obj_of(column.objects()))):
            _, printed = self.convert(edited, rig)
            self.assertIn("from the nearest surface", printed)
            self.assertNotIn("RIG_OTHER_MESH", printed)

    def test_a_part_of_another_character(self):
        """Most of the input lies on the rig's mesh, but a hat is wider, as clothes of two people of one maker are."""
        column = Column()
        rig = column.glb.write(self.path("rig.glb"))
        for radius, reported in ((0.3, False), (0.32, False), (0.36, True)):
            edited = {"body": tube(0, 2, 0.2, 12), "hat": tube(2.1, 2.5, radius, 7)}
            _, printed = self.convert(obj_of(edited), rig)
            self.assertIn("from the nearest surface", printed)
            self.assertEqual("RIG_OTHER_MESH" in printed, reported, printed)
        self.assertRegex(printed, r"and \d+ % of it farther than 1.5 %: it may belong to another character")

    def test_the_mesh_of_one_bone_is_another_characters(self):
        """A rig too small for joints to lie inside of anything."""
        glb = SkinnedGlb()
        joint = glb.node("trap")
        points, triangles = box((-0.2, 0, -0.2), (0.2, 0.05, 0.2))
        mesh = glb.mesh(points, triangles, [(0, 0, 0, 0)] * len(points), [(1, 0, 0, 0)] * len(points))
        glb.node("plate", mesh=mesh, skin=glb.skin([joint], inverse_binds([at(0, 0, 0)], at(0, 0, 0))))
        rig = glb.write(self.path("rig.glb"))
        _, printed = self.convert(obj_of(Column().objects()), rig)
        self.assertIn("its bones may belong to another character", printed)
        self.assertIn("RIG_OTHER_MESH", printed)

    def test_vertex_colours_change_no_weights(self):
        column = Column()
        rig = column.glb.write(self.path("rig.glb"))
        variants.write(obj_of(column.objects()), self.path("plain.obj"))
        lines = read_text(self.path("plain.obj")).splitlines()
        with open(self.path("colours.obj"), "w", encoding="ascii") as stream:
            stream.write("\n".join(line + " 0.8 0.2 0.1" if line.startswith("v ") else line for line in lines) + "\n")
        found, printed = self.convert(self.path("colours.obj"), rig)
        self.assertEqual(found, column.wanted["body"] + column.wanted["hat"])
        self.assertIn(f"the colors of {len(found)} vertices are left out", printed)
        places = [p for mesh in Bundle(self.path("out.sbf")).meshes for p in Bundle(self.path("out.sbf")).positions(mesh)]
        self.assertEqual(len(places), len(found))
        self.assertAlmostEqual(max(p[1] for p in places), 2.5, 5)

    def test_free_form_curves_are_reported(self):
        column = Column()
        rig = column.glb.write(self.path("rig.glb"))
        variants.write(obj_of(column.objects()), self.path("free.obj"))
        with open(self.path("free.obj"), "a", encoding="ascii") as stream:
            stream.write("cstype bspline\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 0 0 0 1 1 1 1\nend\n")
        found, printed = self.convert(self.path("free.obj"), rig)
        self.assertEqual(found, column.wanted["body"] + column.wanted["hat"])
        self.assertIn("5 lines that do not define polygons are skipped, the first is \"cstype\"", printed)

    def test_inputs_without_polygons_get_advice_to_export_meshes(self):
        rig = Column().glb.write(self.path("rig.glb"))
        with open(self.path("free.obj"), "w", encoding="ascii") as stream:
            stream.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ncstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nend\n")
        with open(self.path("points.obj"), "w", encoding="ascii") as stream:
            stream.write("v 0 0 0\nv 1 0 0\nl 1 2\n")
        for name, printed in (("free.obj", "it has only free-form curves and surfaces: export it as a polygon mesh"),
                           ("points.obj", "export polygons")):
            self.assertIn(printed, self.fails(1, "convert", self.path(name), "--rig", rig, "-o", self.path("no.sbf")))
        for ending, text in ((".node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n"), (".ele", "1 4 0\n0 0 1 2 3\n")):
            with open(self.path("tets" + ending), "w", encoding="ascii") as stream:
                stream.write(text)
        printed = self.fails(2, "convert", self.path("tets.ele"), "--rig", rig, "-o", self.path("no.sbf"))
        self.assertIn("has only tetrahedra and cannot use a rig: convert the surface as OBJ or PLY with --rig", printed)

    def test_objects_named_as_bones_of_a_rig_without_a_mesh(self):
        """They are sections of those bones, even if another bone is nearer; the others are computed."""
        write_bones(self.path("arm.bvh"))
        objects = {"hand": box((0.2, -0.2, -0.2), (0.8, 0.2, 0.2)), "fore": box((1.2, -0.2, -0.2), (1.8, 0.2, 0.2)),
                   "other": box((2.2, -0.2, -0.2), (2.8, 0.2, 0.2))}
        found, printed = self.convert(obj_of(objects), self.path("arm.bvh"))
        self.assertEqual(found, ["hand"] * 8 + ["fore"] * 8 + ["hand"] * 8)
        self.assertIn("16 from the names of objects or bones, 8 computed from the bones", printed)

    def test_unwelded_polygons_become_one_body(self):
        """As exporters write flat-shaded meshes. The two sides of a sheet, which also touch, stay separate."""
        write_bones(self.path("arm.bvh"))
        points, triangles = box((1.2, -0.2, -0.2), (1.8, 0.2, 0.2))
        sheet = [(0.2, 0.3, 0), (0.8, 0.3, 0), (0.5, 0.3, 0.4)]
        objects = {"hand": (sheet + sheet, [(0, 1, 2), (5, 4, 3)]), "fore": (points, triangles)}
        whole, apart = obj_of(objects), variants.doubled(obj_of(objects), lambda face, corner: (id(face), corner))
        self.assertEqual(len(apart.points), 6 + 36)
        self.convert(whole, self.path("arm.bvh"))
        self.assertEqual(self.meshes(), {"hand": 6, "fore": 8})
        _, printed = self.convert(apart, self.path("arm.bvh"))
        self.assertEqual(self.meshes(), {"hand": 6, "fore": 8})
        self.assertIn("42 points of the file became 14: polygons of an object that meet along an edge", printed)

    def test_points_far_from_all_others(self):
        """A point outside all polygons is left out, and one in a polygon is reported; both quickly."""
        column = Column()
        rig, points = column.glb.write(self.path("rig.glb")), obj_of(column.objects()).points
        wanted = column.wanted["body"] + column.wanted["hat"]
        unused, used, farther = (obj_of(column.objects()) for _ in range(3))
        unused.points, unused.origins = points + [(500, 0, 0)], unused.origins + [[]]
        found, printed = self.convert(unused, rig)
        self.assertEqual(found, wanted)
        self.assertIn("1 vertices that no face uses are left out", printed)
        self.assertNotIn("RIG_OBJECT_APART", printed)
        used.points = points[:7] + [(500, 0, 0)] + points[8:]
        _, printed = self.convert(used, rig)
        self.assertRegex(printed, r"1 of the points of the object 'body' are farther .*: vertex 7 by 500 m; delete or move them")
        self.assertNotIn("shells of the object", printed)
        farther.points = points[:7] + [(1e30, 0, 0)] + points[8:]
        variants.write(farther, self.path("farther.obj"))
        printed = self.good("convert", self.path("farther.obj"), "--rig", rig, *SOURCE_PARTS, "-o", self.path("out.sbf"), timeout=60).err
        self.assertIn("vertex 7 by 1e+30 m", printed)

    def test_a_piece_beside_a_rigid_part_follows_its_bone_whole(self):
        """Two stiff tubes, one on the other; the lower one was made longer, and its end lies on the upper one's side."""
        low, high = tube(0, 1, 0.2), tube(1.01, 2, 0.2)
        glb = SkinnedGlb()
        joints = [glb.node("low", matrix=at(0, 0, 0))]
        joints.append(glb.node("high", joints[0], at(0, 1, 0)))
        for bone, (points, triangles) in enumerate((low, high)):
            mesh = glb.mesh(points, triangles, [(bone, 0, 0, 0)] * len(points), [(1, 0, 0, 0)] * len(points))
            glb.node(("lower", "upper")[bone], mesh=mesh,
                     skin=glb.skin(joints, inverse_binds([at(0, 0, 0), at(0, 1, 0)], at(0, 0, 0))))
        longer = [(x, 1.03 * y, z) for x, y, z in low[0]], low[1]
        found, printed = self.convert(obj_of({"lower": longer, "upper": high}), glb.write(self.path("rig.glb")))
        self.assertEqual(found, ["low"] * len(low[0]) + ["high"] * len(high[0]))
        self.assertIn("from the nearest surface", printed)

    def test_limbs_in_another_pose_than_the_rigs(self):
        """A small part of an object may move with the bone that it touches, but not an arm."""
        column = Column()
        rig = column.glb.write(self.path("rig.glb"))
        for rings, reported in ((2, False), (8, True)):
            points, triangles = tube(4, 6, 0.2, rings)
            joined = variants.one_object(obj_of({**column.objects(), "beside": (points, triangles)}))
            found, printed = self.convert(joined, rig)
            self.assertIn(f"{len(points)} from the bone that their piece touches", printed)
            self.assertEqual(f"{len(points)} of {len(found)} points are away from the mesh" in printed, reported)

    def test_shells_on_a_joint_follow_one_bone(self):
        """A saddle that overlaps the skin of two bones: all of it hangs on the one that it touches most."""
        column = Column()
        rig = column.glb.write(self.path("rig.glb"))
        points, triangles = tube(0.85, 1.6, 0.07, 9)
        saddle = [(x + 0.25, y, z) for x, y, z in points], triangles
        for name in ("saddle", "body"):  # an object of its own, or a shell of the body's
            obj = obj_of({"body": column.body, "hat": column.hat, "saddle": saddle})
            obj.faces = [(name if part == "saddle" else part, m, c) for part, m, c in obj.faces]
            found, printed = self.convert(obj, rig)
            weights = weights_by_vertex(self.path("out.sbf"))
            first = len(column.body[0]) + len(column.hat[0])
            for vertex in range(first, first + len(points)):
                self.assertEqual(weights[vertex][0], {"high": 1.0})
            self.assertEqual(found[:len(column.body[0])], column.wanted["body"])
            self.assertIn(f"{len(points)} from the bone that their piece touches", printed)
            self.assertNotIn("RIG_OBJECT_APART", printed)

    def test_two_characters_in_one_object(self):
        """Shells far from the rig are named."""
        column = Column()
        rig = column.glb.write(self.path("rig.glb"))
        for shells, apart in (({"twin": 1.2}, 1), ({"twin": 1.2, "third": -2.0}, 2), ({}, 0)):
            more = {name: ([(x + by, y, z) for x, y, z in column.body[0]], column.body[1]) for name, by in shells.items()}
            _, printed = self.convert(variants.one_object(obj_of({**column.objects(), **more}), "both"), rig)
            self.assertEqual("RIG_OBJECT_APART" in printed, apart > 0, printed)
            if apart:
                self.assertIn(f"{apart} of {2 + apart} shells of the object 'both' are apart from the rig", printed)
                self.assertIn("'both#3'", printed)

    def test_an_existing_skin_is_kept(self):
        """An input whose skin names the bones of the rig keeps it, though the rig's own mesh says otherwise."""
        column, other = Column(), Column()
        rig = column.glb.write(self.path("rig.glb"))
        body = other.glb.json["meshes"][0]["primitives"][0]["attributes"]
        body["JOINTS_0"] = other.glb.accessor([(1, 0, 0, 0)] * len(other.body[0]), "H", "VEC4")
        source = other.glb.write(self.path("in.glb"))
        self.convert(source, rig)
        bundle = Bundle(self.path("out.sbf"))
        names, seen = bundle.bone_names(), 0
        for mesh in bundle.meshes:
            for (_, y, _), weights in zip(bundle.positions(mesh), bundle.skin(mesh)):
                self.assertEqual([names[b] for b, _ in weights], ["plume" if y > 2.25 else "high"])
                seen += 1
        self.assertEqual(seen, sum(map(len, column.wanted.values())))

    def test_bones_of_the_same_names_elsewhere(self):
        """A rigged input with the rig of another character of one author, whose bones have the same names."""
        source = Column().glb.write(self.path("in.glb"))
        for name, offsets, outcome in (("same", (0, 1, 1.2), None), ("longer", (0, 1, 1.5), "warning"), ("other", (0, 0.4, 0.3), "error")):
            with self.subTest(name):
                rig = SkinnedGlb()
                joints = []
                for bone, offset in zip(("low", "high", "plume"), offsets):
                    joints.append(rig.node(bone, joints[-1] if joints else None, at(0, offset, 0)))
                worlds = [at(0, sum(offsets[:i + 1]), 0) for i in range(3)]
                points, triangles = tube(0, sum(offsets) + 0.3, 0.2)
                mesh = rig.mesh(points, triangles, [(1, 0, 0, 0)] * len(points), [(1, 0, 0, 0)] * len(points))
                rig.node("skin", mesh=mesh, skin=rig.skin(joints, inverse_binds(worlds, at(0, 0, 0))))
                done = call("convert", source, "--rig", rig.write(self.path("rig.glb")), *SOURCE_PARTS, "-o", self.path("out.sbf"))
                self.assertEqual(done.status, outcome == "error")
                if outcome == "warning":
                    self.assertRegex(done.err, r"1 of 3 bones of .*, 'plume' by 1\d % of the extent.*leave out --rig.*\[RIG_OTHER_MESH\]")
                elif outcome:
                    self.assertRegex(done.err, r"half of them are farther off than 2\d % .*leave out --rig.*\[RIG_MISFIT\]")
                else:
                    self.assertNotIn("leave out --rig", done.err)


class ArmOfAnotherFile(ProgramTest):
    def test_the_report_names_separate_objects(self):
        write_arm(self.path("arm.obj"))
        write_bones(self.path("arm.bvh"))
        with open(self.path("arm.obj"), "a", encoding="ascii") as stream:
            points, triangles = box((0, 5, 0), (0.3, 5.3, 0.3))
            stream.write("o far\n" + "".join("v %g %g %g\n" % p for p in points) +
                         "".join("f %d %d %d\n" % tuple(i - 8 for i in t) for t in triangles))
        self.good("convert", self.path("arm.obj"), "--rig", self.path("arm.bvh"), *SOURCE_PARTS, "--report",
                  self.path("why.json"), "-o", self.path("out.sbf"))
        notes = [n for n in json.loads(read_text(self.path("why.json")))["notes"] if n["code"] == "RIG_OBJECT_APART"]
        self.assertEqual(len(notes), 1)
        self.assertIn("'far'", notes[0]["message"])

    def test_another_character_side_by_side(self):
        """It is nearer to the bones than the limit for a bracelet, but contains none of them."""
        write_arm(self.path("arm.obj"))
        write_bones(self.path("arm.bvh"))
        arm = variants.read(self.path("arm.obj"))
        twin = [(x, y + 0.45, z) for x, y, z in arm.points]
        bracelet = box((1, -0.25, 0), (1.1, -0.22, 0.1))
        objects = {name: (points, [[p for p, _, _ in corners] for part, _, corners in arm.faces if part == "arm"])
                   for name, points in (("arm", arm.points), ("twin", twin))}
        variants.write(obj_of({**objects, "bracelet": bracelet}), self.path("both.obj"))
        done = self.good("convert", self.path("both.obj"), "--rig", self.path("arm.bvh"), *SOURCE_PARTS, "--verbose", "-o",
                         self.path("out.sbf"))
        self.assertEqual(done.err.count("RIG_OBJECT_APART"), 1, done.err)
        self.assertIn("is inside or near the object 'twin'", done.err)
        objects["twin"] = ([(x, y + 1.5, z) for x, y, z in arm.points], objects["twin"][1])
        variants.write(variants.one_object(obj_of({**objects, "bracelet": bracelet}), "both"), self.path("both.obj"))
        done = self.good("convert", self.path("both.obj"), "--rig", self.path("arm.bvh"), *SOURCE_PARTS, "--verbose", "-o",
                         self.path("out.sbf"))
        self.assertEqual(done.err.count("RIG_OBJECT_APART"), 1, done.err)
        self.assertIn("of the object 'both' are apart from the rig", done.err)


if __name__ == "__main__":
    main()
