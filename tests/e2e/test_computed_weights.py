"""An OBJ with a skeleton that has no mesh: weights computed from the bones, shells assigned to bones, and refused inputs."""

import json
import math
import os

from bundle_file import Bundle, inverse, matrix_of, product
from bvh_file import Bvh, write_bvh
from rigged_weights import weights_by_vertex
from skinned_glb import SkinnedGlb, box
from skinned_glb import tube as tube_y
from sbfmt_program import SOURCE_PARTS, ProgramTest, main

def turn_from_y(direction):
    """The quaternion that turns +Y to a direction other than -Y."""
    length = math.hypot(*direction)
    x, y, z = (d / length for d in direction)
    scale = math.hypot(z, x, 1 + y)
    return z / scale, 0, -x / scale, (1 + y) / scale


BONES = (("upper", 0.0), ("fore", 1.0), ("hand", 2.0))


def tube(lines, start, end, radius, rings, height, base):
    """Appends a closed tube along x of 12 sides; returns the number of the next point, from 1."""
    sides = 12
    for i in range(rings + 1):
        for k in range(sides):
            angle = 2 * math.pi * k / sides
            lines.append(f"v {start + (end - start) * i / rings:.6f} {height + radius * math.cos(angle):.6f} "
                         f"{radius * math.sin(angle):.6f}")
    for i in range(rings):
        for k in range(sides):
            a, b = base + i * sides + k, base + i * sides + (k + 1) % sides
            lines.append(f"f {b} {b + sides} {a + sides} {a}")
    lines.append("f " + " ".join(str(base + k) for k in range(sides)))
    lines.append("f " + " ".join(str(base + rings * sides + k) for k in reversed(range(sides))))
    return base + (rings + 1) * sides


def write_arm(path):
    """An arm of 372 points from x = 0 to 3, and an object of two buttons of 36 beside it."""
    lines = ["o arm"]
    after = tube(lines, 0, 3, 0.2, 30, 0, 1)
    lines.append("o buttons")
    after = tube(lines, 0.45, 0.55, 0.04, 2, 0.3, after)
    tube(lines, 1.45, 1.55, 0.04, 2, 0.3, after)
    with open(path, "w", encoding="ascii") as stream:
        stream.write("\n".join(lines) + "\n")


def write_bones(path, shift=0.0):
    write_bvh(path, [(name, BONES[i - 1][0] if i else None, (x, shift, 0)) for i, (name, x) in enumerate(BONES)], (0.9, 0, 0))


def write_person(obj_path, bvh_path, angle=45, collarbones=False):
    """A body of tubes whose arms hang by an angle, and bones whose arms are stretched out, for two frames."""
    parts = {"body": (tube_y(0.9, 2.4, 0.25, 13), (0, 0, 0), 0)}
    for side, name in ((1, "left"), (-1, "right")):
        parts[name + " leg"] = (tube_y(0, 1.05, 0.12, 9), (side * 0.15, 0, 0), 0)
        parts[name + " arm"] = (tube_y(-1.4, 0, 0.1, 15), (side * 0.2, 1.85, 0), side * math.radians(90 - angle))
    lines, first, starts = [], 1, {}
    for name, ((points, triangles), offset, turn) in parts.items():
        starts[name] = (first - 1, first - 1 + len(points))
        c, s = math.cos(turn), math.sin(turn)
        lines += [f"v {c * x - s * y + offset[0]:.6f} {s * x + c * y + offset[1]:.6f} {z:.6f}" for x, y, z in points]
        lines += ["f " + " ".join(str(i + first) for i in t) for t in triangles]
        first += len(points)
    with open(obj_path, "w", encoding="ascii") as stream:
        stream.write("\n".join(lines) + "\n")
    joints = [("Hips", None, (0, 1, 0)), ("Spine", "Hips", (0, 1.8, 0)), ("Head", "Spine", (0, 2.1, 0)),
              ("Head_end", "Head", (0, 2.3, 0))]
    for side, name in ((1, "Left"), (-1, "Right")):
        if collarbones:
            joints.append((name + "Shoulder", "Spine", (side * 0.05, 1.85, 0)))
        joints += [(name + "UpLeg", "Hips", (side * 0.15, 1, 0)), (name + "Leg", name + "UpLeg", (side * 0.15, 0.5, 0)),
                   (name + "Foot", name + "Leg", (side * 0.15, 0.05, 0)),
                   (name + "Foot_end", name + "Foot", (side * 0.15, 0.05, 0.1)),
                   (name + "Arm", name + "Shoulder" if collarbones else "Spine", (side * 0.2, 1.85, 0)), (name + "ForeArm", name + "Arm", (side * 0.8, 1.85, 0)),
                   (name + "Hand", name + "ForeArm", (side * 1.3, 1.85, 0)),
                   (name + "Hand_end", name + "Hand", (side * 1.5, 1.85, 0))]
    write_bvh(bvh_path, joints, frames=2)
    return starts


def strongest(weights):
    return max(weights, key=weights.get)


def write_gltf(path, with_skin, frame):
    """The arm's bones alone, below a node of the frame's name; the skin that lists them moves no mesh."""
    nodes = [{"name": frame, "children": [1, 4]}, {"name": "upper", "children": [2]},
             {"name": "fore", "translation": [1, 0, 0], "children": [3]}, {"name": "hand", "translation": [1, 0, 0]}]
    gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes}
    if with_skin:
        nodes.append({"name": "hand", "translation": [0, 5, 0]})  # no joint: names need not differ
        gltf["skins"] = [{"joints": [1, 2, 3]}]
    else:
        nodes[0]["children"] = [1]
    with open(path, "w", encoding="utf-8") as stream:
        json.dump(gltf, stream)


def write_collada(path, kind, beside=""):
    inside = ""
    for name, x in reversed(BONES):
        offset = 1 if x else 0
        inside = (f'<node id="{name}" name="{name}" type="{kind}"><matrix>1 0 0 {offset} 0 1 0 0 0 0 1 0 0 0 0 1</matrix>'
                  f"{inside}</node>")
    frame = "metarig" if kind == "JOINT" else "Armature.001"
    with open(path, "w", encoding="ascii") as stream:
        stream.write('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
                     '<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset><library_visual_scenes>'
                     f'<visual_scene id="S" name="S"><node id="{frame}" type="NODE">{inside}{beside}</node></visual_scene>'
                     '</library_visual_scenes><scene><instance_visual_scene url="#S"/></scene></COLLADA>')


class ComputedWeights(ProgramTest):
    def setUp(self):
        super().setUp()
        self.obj, self.rig = self.path("arm.obj"), self.path("arm.bvh")
        write_arm(self.obj)
        write_bones(self.rig)

    def weights(self, *options):
        out = self.path("arm.sbf")
        done = self.good("convert", self.obj, "--rig", self.rig, *SOURCE_PARTS, "-o", out, *options)
        return {i: weight for i, (weight, _) in weights_by_vertex(out).items()}, done.err

    def test_each_bone_moves_its_part(self):
        weights, reported = self.weights()
        self.assertIn("computed from 3 bones: 2 of 3 shells move with one bone each", reported)
        self.assertEqual(len(weights), 372 + 72)
        for i in range(372):
            x = 0.1 * (i // 12)
            for name, start in BONES:
                if abs(x - start - 0.5) < 0.25:
                    self.assertGreater(weights[i].get(name, 0), 0.9, (x, weights[i]))
        for i in range(372, 444):
            self.assertEqual(weights[i], {"upper": 1} if i < 408 else {"fore": 1})

    def test_any_format_may_contain_bones_alone(self):
        from_bvh, _ = self.weights()
        for name, write, options in (("skin.gltf", write_gltf, (True, "metarig")),
                                     ("nodes.gltf", write_gltf, (False, "Armature")),
                                     ("joints.dae", write_collada, ("JOINT",)), ("nodes.dae", write_collada, ("NODE",))):
            with self.subTest(name):
                self.rig = self.path(name)
                write(self.rig, *options)
                weights, reported = self.weights()
                self.assertIn("computed from 3 bones", reported)
                self.assertEqual(Bundle(self.path("arm.sbf")).bone_names(), [bone for bone, _ in BONES])
                for i, expected in from_bvh.items():  # whose last bone states its length
                    self.assertEqual(strongest(weights[i]), strongest(expected))

    def test_a_far_end_of_the_last_bone_is_ignored(self):
        """Exporters mark the end of a limb as far away as their own setting says."""
        write_gltf(self.path("rig.gltf"), True, "metarig")
        with open(self.path("rig.gltf"), encoding="utf-8") as stream:
            gltf = json.load(stream)
        gltf["nodes"][3]["children"] = [len(gltf["nodes"])]
        gltf["skins"][0]["joints"].append(len(gltf["nodes"]))
        gltf["nodes"].append({"name": "hand_end", "translation": [0, 5, 0]})
        with open(self.path("far.gltf"), "w", encoding="utf-8") as stream:
            json.dump(gltf, stream)
        self.rig = self.path("rig.gltf")
        near, _ = self.weights()
        self.rig = self.path("far.gltf")
        far, _ = self.weights()
        same = sum(strongest(far[i]) == strongest(expected) for i, expected in near.items())
        self.assertGreater(same, 0.9 * len(near))

    def test_the_node_of_an_armature_joins_no_bones(self):
        """Beside its skeleton hangs what an animator pulls a hand by."""
        write_collada(self.path("rig.dae"), "JOINT", '<node id="aim" name="aim" type="JOINT"/>')
        self.good("convert", self.path("rig.dae"), "-o", self.path("rig.sbf"))
        self.assertEqual(Bundle(self.path("rig.sbf")).bone_names(), ["upper", "fore", "hand", "aim"])

    def test_a_file_of_one_node_is_no_rig(self):
        self.rig = self.path("one.gltf")
        with open(self.rig, "w", encoding="utf-8") as stream:
            stream.write('{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"Empty"}]}')
        printed = self.fails(1, "convert", self.obj, "--rig", self.rig, "-o", self.path("no.sbf"))
        self.assertIn("IMPORT_EMPTY", printed)

    def test_hanging_arms_get_the_bones_of_stretched_arms(self):
        """The rig's limbs are rotated into the mesh; its clips keep their motion."""
        ranges = write_person(self.path("person.obj"), self.path("person.bvh"))
        done = self.good("convert", self.path("person.obj"), "--rig", self.path("person.bvh"), "-o", self.path("person.sbf"))
        self.assertIn("limbs were rotated with their children to fit inside it, 'LeftArm', 'RightArm'", done.err)
        weights, bundle = weights_by_vertex(self.path("person.sbf")), Bundle(self.path("person.sbf"))
        heads = {name: tuple(row[3] for row in frame) for name, frame in zip(bundle.bone_names(), bundle.rest)}
        for side, name in ((1, "left"), (-1, "right")):
            arm, fore, hand = (heads[name.capitalize() + part] for part in ("Arm", "ForeArm", "Hand"))
            for joint, along in ((fore, 0.6), (hand, 1.1)):
                self.assertAlmostEqual(joint[0] - arm[0], side * along * math.sqrt(0.5), delta=0.1)
                self.assertAlmostEqual(joint[1] - arm[1], -along * math.sqrt(0.5), delta=0.1)
            for i in range(*ranges[name + " arm"]):
                weight, (x, y, _) = weights[i]
                along = (abs(x - arm[0]) + abs(y - arm[1])) * math.sqrt(0.5)
                if 0.75 < along < 1:
                    self.assertGreater(weight.get(name.capitalize() + "ForeArm", 0), 0.8)
        info = self.json_of("info", self.path("person.sbf"))
        self.assertEqual(info["gait"]["legs"], 2)
        keyed = {track.get("bone") for track in bundle.root.iter("track")}
        self.assertEqual(keyed, {"bone.LeftArm", "bone.RightArm"})  # out again; all else stays at rest
        write_person(self.path("person.obj"), self.path("person.bvh"), 0)
        done = self.good("convert", self.path("person.obj"), "--rig", self.path("person.bvh"), *SOURCE_PARTS, "-o",
                         self.path("person.sbf"))
        self.assertNotIn("limbs were rotated", done.err)

    def test_an_arm_rotates_about_its_own_joint(self):
        """Not in the collarbone's, which would bring it inside as well, and not into the trunk."""
        for angle in (30, 60):
            write_person(self.path("person.obj"), self.path("person.bvh"), angle, True)
            done = self.good("convert", self.path("person.obj"), "--rig", self.path("person.bvh"), *SOURCE_PARTS, "-o",
                             self.path("person.sbf"))
            self.assertIn("limbs were rotated with their children to fit inside it, 'LeftArm', 'RightArm'", done.err)
            self.assertNotIn("RIG_OTHER_MESH", done.err)
            bundle = Bundle(self.path("person.sbf"))
            heads = {name: tuple(row[3] for row in frame) for name, frame in zip(bundle.bone_names(), bundle.rest)}
            down = math.radians(angle)
            for name, side in (("Left", 1), ("Right", -1)):
                hand = tuple(a - b for a, b in zip(heads[name + "Hand"], heads[name + "Arm"]))
                self.assertLess(math.dist(hand, (side * 1.1 * math.cos(down), -1.1 * math.sin(down), 0)), 0.1)

    def test_targets_outside_the_mesh_are_ignored(self):
        """Animators pull feet and hands by bones that hang on the root: they lie in no body, and most of their length
        is outside."""
        write_person(self.path("person.obj"), self.path("person.bvh"), 0)
        bones = Bvh(self.path("person.bvh"))
        joints = [("World", None, (0, 0, -3)), ("Pole", "World", (4, 4, -4))]
        joints += [(name, bones.names[parent] if parent is not None else "World", tuple(row[3] for row in frame))
                   for name, parent, frame in zip(bones.names, bones.parents, bones.worlds())]
        joints += [("Aim" + name, "World", position) for name, _, position in joints if name.endswith(("Hand", "Foot"))]
        write_bvh(self.path("person.bvh"), joints)
        done = self.good("convert", self.path("person.obj"), "--rig", self.path("person.bvh"), "-o", self.path("person.sbf"))
        self.assertNotIn("RIG_OBJECT_APART", done.err)
        self.assertNotIn("moved by", done.err)
        self.assertEqual(self.json_of("info", self.path("person.sbf"))["gait"]["legs"], 2)

    def test_feet_under_the_root_are_attached_to_their_legs(self):
        """Animators move feet by hand: they hang on the root beside targets of knees, and no skin tells whose they are."""
        write_person(self.path("person.obj"), self.path("person.bvh"), 0)
        bones = Bvh(self.path("person.bvh"))
        joints = [("Root", None, (0, 0, 0))]
        for name, parent, frame in zip(bones.names, bones.parents, bones.worlds()):
            above = "Root" if parent is None or name in ("LeftFoot", "RightFoot") else bones.names[parent]
            joints.append((name, above, tuple(row[3] for row in frame)))
        joints += [("LeftKneeTarget", "Root", (0.15, 0.5, 1)), ("RightKneeTarget", "Root", (-0.15, 0.5, 1))]
        write_bvh(self.path("person.bvh"), joints)
        done = self.good("convert", self.path("person.obj"), "--rig", self.path("person.bvh"), "-o", self.path("person.sbf"))
        self.assertIn("bone 'LeftFoot' is at the end of 'LeftLeg'", done.err)
        self.assertNotIn("'LeftKneeTarget' belongs", done.err)
        bundle = Bundle(self.path("person.sbf"))
        names = bundle.bone_names()
        parents = {name: names[parent] for name, parent in zip(names, bundle.parents) if parent is not None}
        self.assertEqual([parents[side + "Foot"] for side in ("Left", "Right")], ["LeftLeg", "RightLeg"])
        self.assertEqual(parents["LeftKneeTarget"], "Root")
        self.assertEqual(self.json_of("info", self.path("person.sbf"))["gait"], {"kind": "walk", "legs": 2})

    def test_feet_under_the_root_are_attached_to_limbs_that_point_at_them(self):
        """A frog sits with its hind feet beside its fore legs. Some axes are turned, as importers do, those of the last bones
        are not. It is no box, which is refused after its bones were joined."""
        joints = {"Root": (None, (0, 0, 0)), "Body": ("Root", (0, 1.7, 0)), "Spare": ("Body", (0, 1.5, -0.2))}
        for side, x in (("L", 1), ("R", -1)):
            joints.update({f"ForeUpper.{side}": ("Body", (0.67 * x, 1.01, 0.54)), f"ForeLower.{side}": (f"ForeUpper.{side}", (1.07 * x, 0.36, 0.06)),
                           f"HindUpper.{side}": ("Body", (1.06 * x, 0.32, -0.31)), f"HindLower.{side}": (f"HindUpper.{side}", (0.91 * x, 0.06, -1.4)),
                           f"ForeFoot.{side}": ("Root", (1.07 * x, -0.05, 0.85)), f"HindFoot.{side}": ("Root", (1.33 * x, 0, -0.42))})
        feet = {f"{limb}Lower.{side}": f"{limb}Foot.{side}" for limb in ("Fore", "Hind") for side in "LR"}
        glb, nodes, worlds = SkinnedGlb(), {}, {None: matrix_of()}
        for name, (parent, head) in joints.items():
            axis = [b - a for a, b in zip(head, joints[feet[name]][1])] if name in feet else (1, 0, 0)
            worlds[name] = matrix_of(head, turn_from_y(axis))
            nodes[name] = glb.node(name, nodes.get(parent), product(inverse(worlds[parent]), worlds[name]))
        glb.write(self.path("bones.glb"))
        points, triangles = box((-1.5, -0.1, -1.5), (1.5, 1.8, 1))
        with open(self.path("frog.obj"), "w", encoding="ascii") as stream:
            stream.writelines(f"v {x} {y} {z}\n" for x, y, z in points)
            stream.writelines("f {} {} {}\n".format(*(i + 1 for i in t)) for t in triangles)
        printed = self.fails(1, "convert", self.path("frog.obj"), "--rig", self.path("bones.glb"), "--verbose", "-o", self.path("frog.sbf"))
        for tip, foot in feet.items():
            self.assertIn(f"bone '{foot}' is at the end of '{tip}'", printed)

    def test_objects_of_which_half_are_named_as_bones(self):
        """A body and a head are parts of a skin and no sections, where other objects are named as no bone."""
        with open(self.obj, encoding="ascii") as stream:
            text = stream.read()
        with open(self.obj, "w", encoding="ascii") as stream:
            stream.write(text.replace("o arm", "o upper") + "o hand\nf 372 371 370\no rest\nf 372 371 369\no more\nf 372 370 369\n"
                         .replace("o rest", "o hat"))
        weights, reported = self.weights()
        self.assertNotIn("from the names of objects", reported)
        self.assertGreater(weights[360].get("hand", 0), 0.9)

    def test_shells_follow_the_bones_they_are_given_to(self):
        weights, _ = self.weights("--shell", "buttons#2=hand")
        for i in range(372, 444):
            self.assertEqual(weights[i], {"upper": 1} if i < 408 else {"hand": 1})
        weights, _ = self.weights("--shell", "buttons=fore")
        for i in range(372, 444):
            self.assertEqual(weights[i], {"fore": 1})

    def test_missing_shells_and_bones(self):
        for wish, word in (("hat=hand", "'hat'"), ("buttons#3=hand", "has 2 shells"), ("buttons=tail", "'tail'"),
                           ("buttons", "--shell takes"), ("buttons#0=hand", "'buttons#0'")):
            status = 2 if wish == "buttons" else 1
            done = self.fails(status, "convert", self.obj, "--rig", self.rig, "-o", self.path("no.sbf"), "--shell", wish)
            self.assertIn(word, done)
        done = self.fails(2, "convert", self.obj, "-o", self.path("no.sbf"), "--shell", "arm=hand")
        self.assertIn("--rig", done)
        self.assertFalse(os.path.exists(self.path("no.sbf")))

    def test_a_mesh_of_one_triangle(self):
        with open(self.obj, "w", encoding="ascii") as stream:
            stream.write("v 0 0 0\nv 3 0 0\nv 0 0.1 0\nf 1 2 3\n")
        printed = self.fails(1, "convert", self.obj, "--rig", self.rig, "-o", self.path("no.sbf"), "--weights", "compute")
        self.assertIn("outside are bones on the surface of the mesh, which encloses no space", printed)
        printed = self.fails(1, "convert", self.obj, "--rig", self.rig, "-o", self.path("no.sbf"), "--weights", "named")
        self.assertIn("RIG_MISFIT", printed)
        self.assertFalse(os.path.exists(self.path("no.sbf")))


if __name__ == "__main__":
    main()
