"""Tests OBJ files with a rig in another file: their alignment, the bones that move them, and rejected inputs."""

import json
import math
import os
import random
import tempfile

import obj_variants as variants
import posed_inputs
from bundle_file import Bundle, matrix_of
from bvh_file import write_bvh
from glb_file import Glb
from skinned_glb import SkinnedGlb, inverse_binds, tube
from rigged_weights import (Original, add_clip, difference, posed, posed_errors, save_in_a_pose, equal_fraction,
                            walk_motions, weights_by_vertex)
from sbfmt_program import ROOT, SOURCE_PARTS, ProgramTest, main, read_text, shared, write_bytes

CALF = os.path.join(ROOT, "examples", "calf", "calf.glb")
LIZARD = os.path.join(ROOT, "examples", "lizard", "lizard.glb")
SNAKE = os.path.join(ROOT, "examples", "snake", "snake.glb")


def same_mesh(obj):
    """The same mesh as other programs write it, with a word that the conversion has to say of it."""
    z_up = ("x", "-z", "y")
    return {
        "as it is": (obj, None),
        "centimetres, Z up": (variants.moved(obj, 0.01, z_up), "rotated by -90 degrees about x"),
        "inches, facing -Z, shuffled": (variants.shuffled(variants.moved(obj, 0.0254, ("-x", "y", "-z"))), "inches"),
        "mirrored with its polygons, elsewhere": (variants.moved(obj, 1, ("-x", "y", "z"), (5, 1, -2)), "moved by"),
        "mirrored without its polygons": (variants.moved(obj, 1000, ("x", "y", "-z"), turn_mirrored=False), None),
        "an odd unit": (variants.moved(obj, 0.0371, ("y", "z", "x"), (1, 2, 3)), "scaled by 0.0371"),
        "triangles": (variants.triangulated(obj), None),
        "one object, points merged": (variants.merged(variants.one_object(obj)), None),
        "points doubled at seams": (variants.doubled(obj), None),
        "objects of materials": (variants.by_material(obj), None),
    }


def write_bones(bundle_path, path, scale=1):
    """The bundle's bones at rest as a BVH: no mesh, no unit."""
    bundle = Bundle(bundle_path)
    names = [name.replace(" ", "_") for name in bundle.bone_names()]
    write_bvh(path, [(names[i], None if parent is None else names[parent], [scale * row[3] for row in bundle.rest[i]])
                     for i, parent in enumerate(bundle.parents)])


def sections_of(path):
    """Name, bone, and numbers of points and polygons of each section."""
    bundle = Bundle(path)
    return sorted((body.get("name"), body.get("bone"), len(bundle.positions(body)), len(bundle.polygon_sizes(body)))
                  for body in bundle.root.iter("soft_body"))


def shapes_of(obj):
    """How many faces each object has of each material, and how many of their corners have normals."""
    found = {}
    for name, material, corners in obj.faces:
        key = (name, material.rpartition(".")[2])
        count, normals = found.get(key, (0, 0))
        found[key] = (count + 1, normals + sum(normal is not None for _, _, normal in corners))
    return found


def rig_of_bones(points, faces, joints, hold):
    """A skin on bones below one root, each at its position; `hold` has one weight per bone for each point."""
    file = SkinnedGlb()
    root = file.node("Root")
    worlds = [matrix_of(position) for position in joints.values()]
    nodes = [file.node(name, root, world) for name, world in zip(joints, worlds)]
    of_point = [tuple(weights) + (0,) * (4 - len(joints)) for weights in hold]
    mesh = file.mesh(points, faces, [(0, 1, 2, 3)[:len(joints)] + (0,) * (4 - len(joints))] * len(points), of_point)
    file.node("skin", None, mesh=mesh, skin=file.skin(nodes, inverse_binds(worlds, matrix_of())))
    return file


class ByPlace(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.calf = Original(CALF, cls.class_folder.name)

    def convert(self, obj, *options, rig=CALF, digits=None):
        variants.write(obj, self.path("in.obj"), digits)
        return self.good("convert", self.path("in.obj"), "--rig", rig, *options, "-o", self.path("out.sbf"))

    def test_weights_are_those_of_the_rig(self):
        for name, (obj, printed) in same_mesh(self.calf.obj).items():
            with self.subTest(name):
                result = self.convert(obj, *SOURCE_PARTS)
                self.assertGreaterEqual(equal_fraction(self.calf, obj, self.path("out.sbf")), 0.999)
                self.assertIn(" from the same positions of the rig's mesh", result.err)
                if printed:
                    self.assertIn(printed, result.err)

    def test_mesh_and_rig_convert_as_one_file_of_both(self):
        self.good("convert", CALF, "--soft", "*", "-o", self.path("original.sbf"))
        self.convert(variants.shuffled(variants.moved(self.calf.obj, 0.01, ("x", "-z", "y"))), "--soft", "*")
        reports, walks = [], []
        for name in "original.sbf", "out.sbf":
            reports.append(self.json_of("info", self.path(name)))
            walks.append(self.json_of("run", self.path(name), "--seconds", 4, "--drive", "0.4,0"))
        self.assertEqual(*(report["gait"] for report in reports))
        self.assertEqual(*(sorted(s["bone"] for s in report["sections"]) for report in reports))
        self.assertGreater(walks[0]["distance"], 0.5)
        self.assertAlmostEqual(walks[1]["distance"] / walks[0]["distance"], 1, delta=0.02)

    def test_names_distinguish_left_and_right(self):
        """A symmetric character of named objects fits as well unmirrored: its left would hang on the right."""
        lizard = Original(LIZARD, self.class_folder.name)
        result = self.convert(variants.moved(lizard.obj, 1, ("-x", "y", "z"), (5, 1, -2)), *SOURCE_PARTS, rig=LIZARD)
        self.assertIn("mirrored in x, moved by (5, -1, 2) m", result.err)
        self.assertGreaterEqual(equal_fraction(lizard, lizard.obj, self.path("out.sbf")), 0.999)
        self.assertEqual(self.json_of("info", self.path("out.sbf"))["gait"], {"kind": "walk", "legs": 4})

    def test_pieces_cut_by_material_are_one_section(self):
        """Of named objects, and of nameless ones that lie on the rig's."""
        lizard = Original(LIZARD, self.class_folder.name)
        cut = variants.by_material(lizard.obj)
        nameless = cut.copy()
        numbers = {name: f"piece{i}" for i, name in enumerate(sorted({name for name, _, _ in cut.faces}))}
        nameless.faces = [(numbers[name], material, corners) for name, material, corners in cut.faces]
        self.assertGreater(len(numbers), len({name for name, _, _ in lizard.obj.faces}))
        self.good("convert", LIZARD, *SOURCE_PARTS, "-o", self.path("original.sbf"))
        wanted = sections_of(self.path("original.sbf"))
        self.assertEqual(len(wanted), 22)
        for obj in cut, nameless, variants.moved(nameless, 0.01, ("x", "-z", "y")):
            self.convert(obj, *SOURCE_PARTS, rig=LIZARD)
            self.assertEqual(sections_of(self.path("out.sbf")), wanted)
            self.good("export", self.path("out.sbf"), "-o", self.path("back.obj"))
            back = variants.read(self.path("back.obj"))
            self.assertEqual(shapes_of(back), shapes_of(lizard.obj))
        self.convert(variants.by_material(variants.jiggled(lizard.obj)), *SOURCE_PARTS, rig=LIZARD)
        self.assertEqual(sections_of(self.path("out.sbf")), wanted)  # by their borders alone

    def test_numbers_rounded_to_six_decimals(self):
        obj = variants.moved(self.calf.obj, 1000)  # a calf of a thousandth of a unit
        self.convert(obj, *SOURCE_PARTS, digits=6)
        self.assertGreaterEqual(equal_fraction(self.calf, obj, self.path("out.sbf")), 0.99)

    def test_a_part_of_the_mesh(self):
        low = min(p[1] for p in self.calf.obj.points)
        high = max(p[1] for p in self.calf.obj.points)
        part = self.calf.obj.copy()
        part.faces = [face for face in part.faces
                      if all(part.points[p][1] > (low + high) / 2 for p, _, _ in face[2])]
        part = variants.renumbered(part, sorted({p for _, _, c in part.faces for p, _, _ in c}))
        obj = variants.shuffled(variants.moved(part, 0.0371, ("z", "x", "y"), (3, 0, 0)))
        self.convert(obj, *SOURCE_PARTS)
        self.assertGreaterEqual(equal_fraction(self.calf, obj, self.path("out.sbf")), 0.999)

    def test_normals_uvs_materials_and_order_are_kept(self):
        obj = variants.shuffled(variants.moved(self.calf.obj, 0.01, ("x", "-z", "y")))
        self.convert(obj, *SOURCE_PARTS)
        self.good("export", self.path("out.sbf"), "-o", self.path("back.obj"))
        back = variants.read(self.path("back.obj"))
        self.assertEqual(sorted(weights_by_vertex(self.path("out.sbf"))), list(range(len(obj.points))))
        self.assertEqual(len(back.points), len(obj.points))
        self.assertEqual(len(back.faces), len(obj.faces))
        self.assertEqual([bool(c[0][1]) for _, _, c in back.faces], [bool(c[0][1]) for _, _, c in obj.faces])
        self.assertEqual({m.rpartition(".")[2] for _, m, _ in back.faces}, {m.rpartition(".")[2] for _, m, _ in obj.faces})

    def test_match_refuses_another_mesh(self):
        variants.write(variants.jiggled(self.calf.obj, 0.5), self.path("in.obj"))
        printed = self.fails(1, "convert", self.path("in.obj"), "--rig", CALF, "--weights", "match", "-o",
                          self.path("out.sbf"))
        self.assertIn("RIG_MISFIT", printed)
        self.assert_empty_folder(but=["in.obj"])


class InSavedPose(ProgramTest):
    """A rig whose file was saved in the middle of a movement, and an OBJ of that pose by another program."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.calf = Original(CALF, cls.class_folder.name)
        turns = {bone: (0.25 * (-1) ** i, 0.1, 0, (1 - 0.0725) ** 0.5) for i, bone in
                 enumerate(sorted({bone for weights in cls.calf.weights for bone in weights} - {"hips"}))}
        cls.rig = cls.made("saved.glb")
        cls.motions = save_in_a_pose(CALF, cls.rig, turns)

    def check(self, obj, within):
        """Weights, positions and normals are those of the skin's bind pose."""
        self.assertGreaterEqual(equal_fraction(self.calf, obj, self.path("out.sbf")), 0.999)
        size = variants.size_of(self.calf.obj)
        for vertex, (_, position) in weights_by_vertex(self.path("out.sbf")).items():
            for origin in obj.origins[vertex]:
                self.assertLess(math.dist(position, self.calf.places[origin]), within * size)

    def test_the_input_is_moved_to_the_bind_pose(self):
        obj = posed(self.calf, self.motions)
        self.assertGreater(max(map(math.dist, obj.points, self.calf.obj.points)), 0.1)
        variants.write(obj, self.path("in.obj"))
        done = self.good("convert", self.path("in.obj"), "--rig", self.rig, *SOURCE_PARTS, "-o", self.path("out.sbf"))
        self.assertIn("has the pose of", done.err)
        self.assertIn(f"{len(obj.points)} from the same positions of the rig's mesh", done.err)
        self.check(obj, 1e-5)
        self.good("export", self.path("out.sbf"), "-o", self.path("back.obj"))
        back = variants.read(self.path("back.obj"))
        self.assertEqual(len(back.faces), len(obj.faces))
        for (_, _, found), (_, _, wanted) in zip(back.faces, self.calf.obj.faces):
            for (_, _, a), (_, _, b) in zip(found, wanted):
                self.assertLess(math.dist(back.normals[a], self.calf.obj.normals[b]), 1e-3)

    def test_units_axes_and_order_are_found_there_too(self):
        obj = variants.shuffled(variants.moved(posed(self.calf, self.motions), 0.01, ("x", "-z", "y")))
        variants.write(obj, self.path("in.obj"), 6)
        done = self.good("convert", self.path("in.obj"), "--rig", self.rig, *SOURCE_PARTS, "-o", self.path("out.sbf"))
        self.assertIn("rotated by -90 degrees about x", done.err)
        self.check(obj, 1e-4)

    def test_the_bind_pose_is_found_in_a_posed_file(self):
        variants.write(self.calf.obj, self.path("in.obj"))
        done = self.good("convert", self.path("in.obj"), "--rig", self.rig, *SOURCE_PARTS, "-o", self.path("out.sbf"))
        self.assertNotIn("has the pose of", done.err)
        self.check(self.calf.obj, 1e-5)

    def test_an_edited_mesh_is_moved_to_the_bind_pose_by_nearby_weights(self):
        obj = variants.jiggled(posed(self.calf, self.motions), 1, 0.003)
        variants.write(obj, self.path("in.obj"), 6)
        done = self.good("convert", self.path("in.obj"), "--rig", self.rig, *SOURCE_PARTS, "-o", self.path("out.sbf"))
        self.assertIn("has the pose of", done.err)
        self.assertIn("from the nearest surface", done.err)
        gaps = sorted(math.dist(position, self.calf.places[vertex]) / variants.size_of(self.calf.obj)
                      for vertex, (_, position) in weights_by_vertex(self.path("out.sbf")).items())
        self.assertLess(gaps[int(0.99 * len(gaps))], 0.015)

    def test_real_files_saved_in_a_pose(self):
        """Each vertex has the weights that the file states for it."""
        paths = [p for p in (shared("..", "zoo", "animals_pack", "Horse.glb"), shared("snake", "snake.glb"))
                 if os.path.exists(p)]
        if not paths:
            self.skipTest("the files of ../shared are not there")
        for path in paths:
            with self.subTest(path):
                places, faces, stated = drawn_mesh(Glb(path))
                variants.write(variants.Obj(places, [], [], faces), self.path("in.obj"))
                done = self.good("convert", self.path("in.obj"), "--rig", path, *SOURCE_PARTS, "-o", self.path("out.sbf"))
                self.assertIn("has the pose of", done.err)
                found = weights_by_vertex(self.path("out.sbf"))
                equal = sum(difference(weights, stated[v]) <= 1e-3 for v, (weights, _) in found.items())
                self.assertGreaterEqual(equal, 0.999 * len(found))


def drawn_mesh(file):
    """Points as drawn, faces, and weights by names of joints, of all skinned vertices in the order of the file."""
    places, faces, stated = file.skinned(file.worlds({}, 0)), [], []
    for node, primitive in file.primitives():
        names = [file.nodes[j].get("name") for j in file.json["skins"][file.nodes[node]["skin"]]["joints"]]
        indices = [i[0] for i in file.accessor(primitive["indices"])]
        faces += [("all", None, [(len(stated) + i, None, None) for i in indices[k:k + 3]]) for k in range(0, len(indices), 3)]
        for joints, weights in zip(file.accessor(primitive["attributes"]["JOINTS_0"]),
                                   file.accessor(primitive["attributes"]["WEIGHTS_0"])):
            of = {}
            for joint, weight in zip(joints, weights):
                if weight > 0:
                    of[names[joint]] = of.get(names[joint], 0) + weight / sum(weights)
            stated.append(of)
    return places, faces, stated


class AtAMomentOfAClip(ProgramTest):
    """An OBJ that a program wrote of a rigged file while it played one of its clips."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.calf = Original(CALF, cls.class_folder.name)
        cls.bones = sorted({bone for weights in cls.calf.weights for bone in weights} - {"hips"})
        cls.rig, still = cls.made("played.glb"), cls.made("still.glb")
        add_clip(CALF, still, "still", {bone: (0, 0, 0.01, 0.99995) for bone in cls.bones[:2]}, 0.5)
        add_clip(still, cls.rig, "kick", cls.turns(1), 1.0)

    @classmethod
    def turns(cls, time):
        """Of bone i about its x and z, in turn to either side."""
        half = 0.35 * time
        return {bone: ((-1) ** i * 0.8 * math.sin(half), 0, 0.6 * math.sin(half), math.cos(half))
                for i, bone in enumerate(cls.bones)}

    def write_posed(self, time, change=lambda obj: obj):
        motions = save_in_a_pose(CALF, self.path("pose.glb"), self.turns(time))
        obj = change(posed(self.calf, motions))
        variants.write(obj, self.path("in.obj"), 6)
        return obj

    def check(self, obj, time):
        done = self.good("convert", self.path("in.obj"), "--rig", self.rig, *SOURCE_PARTS, "-o", self.path("out.sbf"))
        self.assertIn(f"{time:.3f} s after the start of its clip 'kick'", done.err)
        self.assertGreaterEqual(equal_fraction(self.calf, obj, self.path("out.sbf")), 0.999)
        size = variants.size_of(self.calf.obj)
        for vertex, (_, position) in weights_by_vertex(self.path("out.sbf")).items():
            for origin in obj.origins[vertex]:
                self.assertLess(math.dist(position, self.calf.places[origin]), 1e-4 * size)
        return done

    def test_a_frame(self):
        self.check(self.write_posed(5 / 24), 5 / 24)

    def test_between_frames_in_centimetres_split_and_shuffled(self):
        z_up = ("x", "-z", "y")
        obj = self.write_posed(0.7331, lambda obj: variants.shuffled(variants.by_material(variants.moved(obj, 0.01, z_up))))
        self.assertIn("rotated by -90 degrees about x", self.check(obj, 0.7331).err)

    def test_a_mesh_in_a_pose_of_no_clip_matches_no_clip(self):
        motions = save_in_a_pose(CALF, self.path("pose.glb"), {b: (0, 0, 0.2, 0.98) for b in self.bones[::3]})
        variants.write(posed(self.calf, motions), self.path("in.obj"), 6)
        done = self.good("convert", self.path("in.obj"), "--rig", self.rig, *SOURCE_PARTS, "-o", self.path("out.sbf"))
        self.assertNotIn("of its clip", done.err)


class ByNearness(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.calf = Original(CALF, cls.class_folder.name)

    def test_edited_meshes_move_as_the_original(self):
        kinds = {"a third of its points moved": variants.jiggled, "simplified": variants.simplified,
                 "subdivided": variants.subdivided}
        self.good("convert", CALF, "-o", self.path("walking.sbf"))
        motions = walk_motions(self.path("walking.sbf"), self.folder)
        for name, change in kinds.items():
            with self.subTest(name):
                obj = variants.moved(change(self.calf.obj), 0.01, ("x", "-z", "y"))
                variants.write(obj, self.path("in.obj"), 6)
                result = self.good("convert", self.path("in.obj"), "--rig", CALF, *SOURCE_PARTS, "-o",
                                   self.path("out.sbf"))
                self.assertIn("from the nearest surface", result.err)
                errors = posed_errors(self.calf, obj, self.path("out.sbf"), motions)
                self.assertLess(errors[int(0.99 * len(errors))], 0.01)
                found = weights_by_vertex(self.path("out.sbf"))
                unlike = [v for v, (w, _) in found.items() if difference(w, self.calf.expected(obj.origins[v])) > 0.5]
                self.assertLess(len(unlike), 0.01 * len(found))

    def test_a_mesh_with_equal_shape_only_gets_the_rigs_weights(self):
        obj = variants.moved(variants.jiggled(self.calf.obj, 1, 0.004), 0.01, ("-x", "z", "y"))
        variants.write(obj, self.path("in.obj"), 6)
        result = self.good("convert", self.path("in.obj"), "--rig", CALF, *SOURCE_PARTS, "-o", self.path("out.sbf"))
        self.assertIn("scaled by 0.01 (it is in centimetres)", result.err)
        found = weights_by_vertex(self.path("out.sbf"))
        unlike = [v for v, (w, _) in found.items() if difference(w, self.calf.expected(obj.origins[v])) > 0.5]
        self.assertLess(len(unlike), 0.02 * len(found))

    def test_a_piece_beside_the_body_follows_the_bone_in_contact(self):
        """A pole on the calf's back: all of it moves with one bone: the bone of the nearest point."""
        obj = variants.jiggled(self.calf.obj, 0)
        top = max(range(len(obj.points)), key=lambda i: obj.points[i][1])
        x, y, z = obj.points[top]
        size = variants.size_of(obj)
        base, half = len(obj.points), 0.01 * size
        for k in range(8):
            obj.points.append((x + (half if k & 1 else -half), y + (0.3 * size if k & 2 else 0),
                               z + (half if k & 4 else -half)))
            obj.origins.append([])
        for quad in ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)):
            obj.faces.append(("pole", None, [(base + i, None, None) for i in quad]))
        variants.write(obj, self.path("in.obj"))
        self.good("convert", self.path("in.obj"), "--rig", CALF, *SOURCE_PARTS, "-o", self.path("out.sbf"))
        found = weights_by_vertex(self.path("out.sbf"))
        poles = [found[v][0] for v in range(base, base + 8)]
        self.assertEqual({len(weights) for weights in poles}, {1})
        self.assertEqual({*poles[0]}, {bone for weights in poles for bone in weights})
        self.assertIn(next(iter(poles[0])), self.calf.weights[top])

    def test_a_thin_part_that_became_a_sheet_bends_as_before(self):
        """Programs that simplify join the two sides of a fin, which then faces nowhere: beside it lies the body."""
        body, faces = tube(0, 3, 0.3, 25)
        rows, first = 17, len(body)
        fin = [(0.35 + x, 3 * i / (rows - 1), z) for z in (-0.01, 0.01) for i in range(rows) for x in (0, 0.3)]
        for side in (0, 1):
            for i in range(rows - 1):
                a = first + 2 * (side * rows + i)
                quad = (a, a + 1, a + 3, a + 2) if side else (a, a + 2, a + 3, a + 1)
                faces += [quad[:3], (quad[0], quad[2], quad[3])]
        hold = [(1, 0, 0)] * len(body) + [(0, 1 - y / 3, y / 3) for _, y, _ in fin]
        rig = rig_of_bones(body + fin, faces, {"Body": (0, 0, 0), "Low": (0.4, 0, 0), "High": (0.4, 2, 0)}, hold)
        rig.write(self.path("rig.glb"))
        sheet = body + [(x, y, 0) for x, y, _ in fin[:2 * rows]]
        faces = [("all", None, [(i if i < len(sheet) else i - 2 * rows, None, None) for i in face]) for face in faces]
        variants.write(variants.Obj(sheet, [], [], faces), self.path("in.obj"))
        self.good("convert", self.path("in.obj"), "--rig", self.path("rig.glb"), *SOURCE_PARTS, "-o", self.path("out.sbf"))
        found = weights_by_vertex(self.path("out.sbf"))
        for v in range(first, len(sheet)):
            self.assertAlmostEqual(found[v][0].get("High", 0), sheet[v][1] / 3, delta=0.01)

    def test_points_beside_a_part_without_weights_follow_the_root(self):
        """As the rig's own mesh does; other bones lie nearer."""
        body, faces = tube(0, 3, 0.3, 25)
        hat, crown = tube(3.1, 3.5, 0.3, 5)
        faces += [tuple(i + len(body) for i in face) for face in crown]
        hold = [(0, 1)] * len(body) + [(0, 0)] * len(hat)
        rig_of_bones(body + hat, faces, {"Foot": (0, 0, 0), "Head": (0, 2.9, 0)}, hold).write(self.path("rig.glb"))
        obj = variants.Obj(body + hat, [], [], [("all", None, [(i, None, None) for i in face]) for face in faces])
        variants.write(variants.subdivided(obj), self.path("in.obj"))
        self.good("convert", self.path("in.obj"), "--rig", self.path("rig.glb"), *SOURCE_PARTS, "-o", self.path("out.sbf"))
        for weights, (_, y, _) in weights_by_vertex(self.path("out.sbf")).values():
            if y > 3.05:
                self.assertEqual(weights, {"Foot": 1.0})

    def test_an_object_like_a_boneless_one_is_attached_equally(self):
        """A turret beside a skin, on no bone: an edited one gets none of the bones of the skin below it."""
        body, faces = tube(0, 3, 0.3, 25)
        hat, crown = tube(3.05, 3.3, 0.6, 5)
        file = rig_of_bones(body, faces, {"Foot": (0, 0, 0), "Head": (0, 2.9, 0)}, [(1 - y / 3, y / 3) for _, y, _ in body])
        file.node("Hat", None, mesh=file.mesh(hat, crown))
        file.write(self.path("rig.glb"))
        objects = [("all", face) for face in faces] + [("cap", [i + len(body) for i in face]) for face in crown]
        obj = variants.Obj(body + hat, [], [], [(name, None, [(i, None, None) for i in face]) for name, face in objects])
        whole = variants.jiggled(obj, 0)
        found = []
        for change in (whole, variants.subdivided(obj)):
            variants.write(change, self.path("in.obj"))
            self.good("convert", self.path("in.obj"), "--rig", self.path("rig.glb"), *SOURCE_PARTS, "-o", self.path("out.sbf"))
            found.append({bone for weights, (_, y, _) in weights_by_vertex(self.path("out.sbf")).values() if y > 3.02
                          for bone in weights})
        self.assertEqual(found[0], found[1])

    def test_a_symmetric_mesh_is_not_its_mirror_image(self):
        """Half of its points were moved: the others fit in both directions, in any order of its points."""
        chance, points, faces = random.Random(1), [], []
        for i in range(30):
            row = [0.3 * chance.random() for _ in range(9)]
            points += [(0.1 * k, 0.1 * i, row[abs(k)]) for k in range(-8, 9)]
        for i in range(29):
            for k in range(16):
                a = 17 * i + k
                faces += [(a, a + 1, a + 18), (a, a + 18, a + 17)] if k < 8 else [(a, a + 1, a + 17), (a + 1, a + 18, a + 17)]
        for order in (range(len(faces)), reversed(range(len(faces)))):
            own = [faces[i] for i in order]
            hold = [(1, 0) if x < 0 else (0, 1) for x, _, _ in points]
            rig_of_bones(points, own, {"Right": (-0.4, 0, 0), "Left": (0.4, 0, 0)}, hold).write(self.path("rig.glb"))
            obj = variants.Obj(points, [], [], [("all", None, [(i, None, None) for i in face]) for face in own])
            obj = variants.moved(variants.jiggled(obj, 0.5), 0.0371, ("x", "-z", "y"), (5, 1, -2))
            variants.write(obj, self.path("in.obj"))
            self.good("convert", self.path("in.obj"), "--rig", self.path("rig.glb"), *SOURCE_PARTS, "-o", self.path("out.sbf"))
            for v, (weights, _) in weights_by_vertex(self.path("out.sbf")).items():
                if abs(points[v][0]) > 0.2:
                    self.assertIn("Right" if points[v][0] < 0 else "Left", weights)

    def test_transfer_refuses_another_character(self):
        variants.write(self.calf.obj, self.path("in.obj"))
        printed = self.fails(1, "convert", self.path("in.obj"), "--rig", SNAKE, "--weights", "transfer", "-o",
                          self.path("out.sbf"))
        self.assertIn("RIG_MISFIT", printed)
        self.assert_empty_folder(but=["in.obj"])


class FromFile(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.calf = Original(CALF, cls.class_folder.name)

    def convert(self, weights, *options):
        return ("convert", self.calf.obj_path, "--rig", CALF, "--weights", weights, *SOURCE_PARTS, *options, "-o",
                self.path("out.sbf"))

    def test_exported_files_convert_back(self):
        for ending in "csv", "json":
            with self.subTest(ending):
                self.good("export", self.calf.bundle, "-o", self.path("weights." + ending))
                self.good(*self.convert(self.path("weights." + ending)))
                self.assertEqual(equal_fraction(self.calf, self.calf.obj, self.path("out.sbf"), 1e-5), 1)

    def test_the_file_decides(self):
        bones = sorted({bone for weights in self.calf.weights for bone in weights})
        rows = [f'"{bones[i % 2]}",{i},1' for i in range(len(self.calf.obj.points))]
        write_bytes(self.path("w.csv"), ("bone,vertex,weight\r\n" + "\r\n".join(rows)).encode())
        self.good(*self.convert(self.path("w.csv")))
        for vertex, (weights, _) in weights_by_vertex(self.path("out.sbf")).items():
            self.assertEqual(weights, {bones[vertex % 2]: 1})

    def test_a_file_of_a_few_points_is_a_warning(self):
        bone = next(iter(self.calf.weights[0]))
        rows, count = "".join(f"{i},{bone},1\n" for i in range(6)), len(self.calf.obj.points)
        write_bytes(self.path("w.csv"), f"vertex,bone,weight\n{rows}".encode())
        printed = self.good(*self.convert(self.path("w.csv"))).err
        self.assertIn(f"warning: {self.calf.obj_path}: the weights file has 6 of the {count} points", printed)
        root = Bundle(self.path("out.sbf")).bone_names()[0]
        self.assertIn(f"the other {count - 6} follow the root bone '{root}'", printed)
        found = weights_by_vertex(self.path("out.sbf"))
        self.assertEqual([found[i][0] for i in (5, 6)], [{bone: 1}, {root: 1}])
        rows = "".join(f"{i},{bone},1\n" for i in range(count))
        write_bytes(self.path("w.csv"), f"vertex,bone,weight\n{rows}".encode())
        self.assertNotIn("the weights file has", self.good(*self.convert(self.path("w.csv"))).err)

    def test_broken_files_are_refused_with_their_line(self):
        bone = next(iter(self.calf.weights[0]))
        faults = {
            "vertex,bone,weight\n0,Nobody,1\n": "line 2|no bone of",
            f"vertex,bone,weight\n0,{bone},1\n99999999,{bone},1\n": "no vertex 99999999 in a polygon: they are counted from 0",
            f"vertex,bone,weight\n0,{bone},-1\n": "is not a weight",
            f"vertex,bone,weight\n0,{bone},nan\n": "is not a weight",
            f"vertex,bone,weight\nx,{bone},1\n": "is not a vertex number",
            "vertex,weight\n0,1\n": "there is no column 'bone'",
            f"vertex;bone;weight\n0;{bone};1\n": "no column 'vertex': the first line must name vertex, bone and weight, separated by commas",
            "vertex,bone,weight\n": "no vertex has a weight",
            "": "the file is empty",
        }
        for text, printed in faults.items():
            with self.subTest(text):
                write_bytes(self.path("w.csv"), text.encode())
                error = self.fails(1, *self.convert(self.path("w.csv")))
                self.assertRegex(error, printed)
                self.assertIn("w.csv", error)
                self.assertIn("RIG_WEIGHTS_FILE", error)
                self.assert_empty_folder(but=["w.csv"])
        for text in "", "[", '{"a": 1}', '[{"vertex": 0}]', '[{"vertex": 0, "bone": "x", "weight": 1}', "[1]", "[" * 99:
            with self.subTest(text):
                write_bytes(self.path("w.json"), text.encode())
                self.assertIn("RIG_WEIGHTS_FILE", self.fails(1, *self.convert(self.path("w.json"))))

    def test_a_file_with_a_skin_of_its_own(self):
        self.good("export", self.calf.bundle, "-o", self.path("weights.csv"))
        lines = read_text(self.path("weights.csv")).splitlines()
        bone = lines[1].split(",")[1]
        with open(self.path("weights.csv"), "w", encoding="utf-8") as stream:
            stream.write("vertex,bone,weight\n" + "".join(f"{i},{bone},1\n" for i in range(len(self.calf.places))))
        self.good("convert", CALF, "--weights", self.path("weights.csv"), *SOURCE_PARTS, "-o", self.path("out.sbf"))
        self.assertEqual({b for w, _ in weights_by_vertex(self.path("out.sbf")).values() for b in w}, {bone})

    def test_weights_option_needs_a_rig(self):
        self.assertIn("--rig FILE", self.fails(2, "convert", self.calf.obj_path, "--weights", "match", "-o",
                                               self.path("out.sbf")))
        self.assertIn("has its own", self.fails(2, "convert", CALF, "--weights", "match", "-o", self.path("out.sbf")))
        self.assert_empty_folder()

    def test_unknown_methods_and_missing_files(self):
        self.assertIn("named, match, transfer", self.fails(2, *self.convert("nearest")))


class FromBones(ProgramTest):
    """A rig without a mesh: a BVH of the calf's bones."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.calf = Original(CALF, cls.class_folder.name)
        cls.bones = cls.made("bones.bvh")
        write_bones(cls.calf.bundle, cls.bones)

    def convert(self, obj, *options):
        variants.write(obj, self.path("in.obj"), 6)
        return ("convert", self.path("in.obj"), "--rig", self.bones, *options, "-o", self.path("out.sbf"))

    def test_unit_and_axes_are_found_by_bones_inside(self):
        for name, (obj, printed) in {
                "as it is": (self.calf.obj, None),
                "centimetres, Z up": (variants.moved(self.calf.obj, 0.01, ("x", "-z", "y")), "-90 degrees about x"),
                "an odd unit, elsewhere": (variants.moved(self.calf.obj, 0.37, offset=(3, 0, 5)), "moved by"),
        }.items():
            with self.subTest(name):
                result = self.good(*self.convert(obj, *SOURCE_PARTS))
                self.assertIn("computed from the bones", result.err)
                if printed:
                    self.assertIn(printed, result.err)
                bundle = Bundle(self.path("out.sbf"))
                sizes = [max(p[1] for p in points) - min(p[1] for p in points) for points in (
                    [p for mesh in bundle.meshes for p in bundle.positions(mesh)], [tuple(r[3] for r in f) for f in bundle.rest])]
                self.assertTrue(0.9 <= sizes[0] / sizes[1] < 1.6, sizes)

    def test_bones_without_a_unit_take_the_size_of_the_input(self):
        """A BVH states no unit: it is scaled, upright, and --unit applies to the input."""
        for name, scale, unit, reported in (("twice as large", 1, "2", "scaled by 2,"), ("an odd scale", 4.95, None, "scaled by"),
                                        ("an odd scale, small", 0.0731, "1", "scaled by")):
            with self.subTest(name):
                write_bones(self.calf.bundle, self.path("scaled.bvh"), scale)
                variants.write(self.calf.obj, self.path("in.obj"), 6)
                done = self.good("convert", self.path("in.obj"), "--rig", self.path("scaled.bvh"), *SOURCE_PARTS,
                                 *(["--unit", unit] if unit else []), "-o", self.path("out.sbf"))
                self.assertIn("states no unit: it was " + reported, done.err)
                bundle = Bundle(self.path("out.sbf"))
                found = weights_by_vertex(self.path("out.sbf"))
                for axis in range(3):  # neither turned nor mirrored
                    sizes = [(max(p[axis] for p in points) - min(p[axis] for p in points)) for points in (
                        [p for _, p in found.values()], self.calf.places)]
                    self.assertAlmostEqual(sizes[0] / sizes[1], float(unit or 1), 3)
                heads = [tuple(row[3] for row in frame) for frame in bundle.rest]
                height = max(p[1] for p in heads) - min(p[1] for p in heads)
                wanted = [tuple(row[3] for row in frame) for frame in Bundle(self.calf.bundle).rest]
                wanted = max(p[1] for p in wanted) - min(p[1] for p in wanted)
                self.assertAlmostEqual(height / wanted / float(unit or 1), 1, delta=0.15)

    def test_a_skin_cut_along_its_bones_is_one_skin(self):
        """As Blender splits by vertex groups: pieces are named like bones and share the points of their borders."""
        def bone_of(corners):
            weights = self.calf.expected([p for p, _, _ in corners])
            return max(weights, key=weights.get).replace(" ", "_")

        whole = variants.one_object(variants.merged(self.calf.obj))
        cut = whole.copy()
        cut.faces = sorted(((bone_of([(o, 0, 0) for p, _, _ in c for o in whole.origins[p]]), m, c) for _, m, c in whole.faces),
                           key=lambda face: face[0])
        self.good(*self.convert(whole, *SOURCE_PARTS))
        expected = weights_by_vertex(self.path("out.sbf"))
        for name, pieces in (("shared", cut), ("doubled", variants.doubled(cut, lambda face, corner: (corner[0], face[0])))):
            with self.subTest(name):
                printed = self.good(*self.convert(pieces, *SOURCE_PARTS, "--verbose")).err
                self.assertRegex(printed, r"are open and share their borders, .*--weights named .*\[IMPORT_POINTS_JOINED\]")
                found = {position: weights for weights, position in weights_by_vertex(self.path("out.sbf")).values()}
                errors = sorted(difference(weights, found[position]) for weights, position in expected.values())
                self.assertLess(errors[int(0.95 * len(errors))], 1e-3)  # another order of points: other ties and rounding
        self.good(*self.convert(cut))
        report = self.json_of("run", self.path("out.sbf"), "--seconds", "2", "--drive", "0.3,0")
        self.assertTrue(report["valid"])
        self.assertLess(report["max_strain"], 1)
        self.assertGreater(report["distance"], 0.2)
        printed = self.good(*self.convert(cut, *SOURCE_PARTS, "--weights", "named")).err
        self.assertNotIn("IMPORT_POINTS_JOINED", printed)

    def test_a_rig_of_another_character_is_refused(self):
        pole = variants.Obj([(0.01 * x, y, 0.01 * z) for x in (0, 1) for y in (0, 3) for z in (0, 1)], [], [],
                            [("pole", None, [(i, None, None) for i in c]) for c in
                             ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))])
        printed = self.fails(1, *self.convert(pole))
        self.assertRegex(printed, r"only \d+ % of the bones' length is inside the mesh; outside are '.*' by .* m")
        self.assertIn("IMPORT_RIG_OUTSIDE", printed)
        self.assertNotIn("rest pose", printed)
        self.assert_empty_folder(but=["in.obj"])
        self.fails(1, *self.convert(pole, "--report", self.path("why.json")))
        self.assert_empty_folder(but=["in.obj", "why.json"])
        report = json.loads(read_text(self.path("why.json")))
        self.assertEqual(len(report["bundle"]["bones"]), len(Bundle(self.calf.bundle).bones))
        self.assertIn("IMPORT_RIG_OUTSIDE", [note["code"] for note in report["notes"]])
        self.assertTrue(report["pictures"] or report["drawing_failed"])

    def test_posed_bones_get_advice_to_export_at_rest(self):
        """Exporters write bones without a mesh in their present pose."""
        add_clip(CALF, self.path("jump.glb"), "Jump", {"head": (0, 0, math.sin(0.2), math.cos(0.2))}, 1)
        posed_inputs.write_bones(self.path("jump.glb"), self.path("bones.glb"))
        variants.write(variants.Obj([(0, 0, 0), (0, 3, 0), (0, 0, 0.01)], [], [], [("pole", None, [(i, None, None) for i in range(3)])]),
                       self.path("in.obj"))
        printed = self.fails(1, "convert", self.path("in.obj"), "--rig", self.path("bones.glb"), "-o", self.path("out.sbf"))
        self.assertRegex(printed, r"exported in its rest pose \(its clips may have moved it\) or with its mesh.*IMPORT_RIG_OUTSIDE")

    def test_bones_that_fit_a_part_of_the_mesh_are_refused(self):
        """A fish's and a snake's bones lie inside a calf's trunk, at some scale."""
        variants.write(self.calf.obj, self.path("in.obj"))
        for name in "koi", "snake":
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                write_bones(Original(os.path.join(ROOT, "examples", name, name + ".glb"), folder).bundle, self.path("other.bvh"))
                call = ("convert", self.path("in.obj"), "--rig", self.path("other.bvh"), *SOURCE_PARTS)
                printed = self.fails(1, *call, "-o", self.path("out.sbf"))
                self.assertRegex(printed, r"extend over only \d+ % of its length.*RIG_MISFIT|only \d+ % of the bones' length")
                self.assert_empty_folder(but=["in.obj", "other.bvh"])

    def test_a_body_as_wide_as_long_is_turned_forwards(self):
        """The dragon's wings reach as far as its tail; bones of an odd unit fit at many scales."""
        dragon = Original(os.path.join(ROOT, "examples", "dragon", "dragon.glb"), self.folder)
        write_bones(dragon.bundle, self.path("dragon.bvh"), 37)
        variants.write(variants.moved(dragon.obj, 0.01, ("x", "-z", "y")), self.path("in.obj"), 6)
        done = self.good("convert", self.path("in.obj"), "--rig", self.path("dragon.bvh"), *SOURCE_PARTS, "-o", self.path("out.sbf"))
        self.assertIn("aligned with the rig: rotated by -90 degrees about x", done.err)

    def test_a_mesh_of_one_triangle_is_refused(self):
        triangle = variants.Obj([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [],
                                [("t", None, [(0, None, None), (1, None, None), (2, None, None)])])
        self.fails(1, *self.convert(triangle))
        self.assert_empty_folder(but=["in.obj"])

    def test_forward_sets_the_facing_direction(self):
        """The calf faces +Z. With --forward along its tail, it is rotated by half a turn."""
        for forward, sign in ("z", 1), ("-z", -1):
            self.good(*self.convert(self.calf.obj, *SOURCE_PARTS, "--forward", forward))
            found = weights_by_vertex(self.path("out.sbf"))
            middle = sum(p[2] for p in self.calf.places) / len(self.calf.places)
            there = sum(p[2] for _, p in found.values()) / len(found)
            same = sum((self.calf.places[v][2] - middle) * (p[2] - there) for v, (_, p) in found.items())
            self.assertGreater(same * sign, 0)
        self.assertIn("upward axis", self.fails(2, *self.convert(self.calf.obj, "--forward", "y")))

    def test_stated_units_are_used(self):
        """--unit says how large the input is: then the rig is too large for it."""
        printed = self.fails(1, "convert", self.calf.obj_path, "--rig", CALF, "--unit", "0.01", "--weights", "match", "-o",
                          self.path("out.sbf"))
        self.assertIn("RIG_MISFIT", printed)
        self.assert_empty_folder()


if __name__ == "__main__":
    main()
