"""Avatars as VRM files: a person of tubes with a pony tail, a side lock and a scarf, in VRM 0.x or 1.0."""

from bundle_file import inverse, matrix_of, product
from skinned_glb import SkinnedGlb
from stranger_rigs import PERSON, RADII, heads_and_tips, tube_along

HAIR = [(0, 1.70, -0.10), (0, 1.66, -0.22), (0, 1.55, -0.28), (0, 1.42, -0.29), (0, 1.30, -0.28)]  # the last is the end
TAIL = [(0, 0.90, -0.12), (0, 0.88, -0.30), (0, 0.87, -0.50), (0, 0.86, -0.70)]
LOCK = [(0.09, 1.72, 0.04), (0.12, 1.62, 0.06), (0.13, 1.52, 0.07)]
HUMAN = {"hips": "hips", "spine": "spine", "chest": "chest", "head": "head",
         **{f"{side}{bone}": f"{name}.{side[0].upper()}" for side in ("left", "right")
            for bone, name in (("UpperLeg", "thigh"), ("LowerLeg", "shin"), ("Foot", "foot"),
                               ("UpperArm", "arm"), ("LowerArm", "forearm"), ("Hand", "hand"))}}


class Avatar:
    """`plain`: nodes have the names of their bones; else numbers, without a meaning. `back`: it faces -Z, as VRM 0.x."""

    def __init__(self, plain=True, back=False, tail=False):
        self.glb, self.node, self.back = SkinnedGlb(), {}, back
        self.heads, self.joints, tubes = {}, [], []
        heads, tips = heads_and_tips()
        for name, parent, head in PERSON:
            self._bone(name, parent, head, plain)
            tubes.append((name, heads[name], tips[name], RADII[name.partition(".")[0]]))
        for chain, above, points in (("hair", "head", HAIR), ("lock", "head", LOCK), ("tail", "hips", TAIL if tail else [])):
            for i, head in enumerate(points):
                self._bone(f"{chain}{i}", f"{chain}{i - 1}" if i else above, head, plain)
                if i + 1 < len(points):
                    tubes.append((f"{chain}{i}", head, points[i + 1], 0.02))
        self._skin(tubes)

    def _turned(self, p):
        return (-p[0], p[1], -p[2]) if self.back else p

    def _bone(self, name, parent, head, plain):
        head = self._turned(head)
        above = self.heads[parent] if parent else (0, 0, 0)
        self.heads[name] = head
        self.node[name] = self.glb.node(name if plain else f"n{len(self.node):02}", self.node.get(parent))
        self.glb.json["nodes"][self.node[name]]["translation"] = [a - b for a, b in zip(head, above)]
        self.joints.append(name)

    def _skin(self, tubes):
        points, triangles, joints, weights = [], [], [], []
        for name, start, end, radius in tubes:
            own, faces = tube_along(self._turned(start), self._turned(end), radius)
            triangles += [tuple(len(points) + i for i in t) for t in faces]
            joints += [(self.joints.index(name), 0, 0, 0)] * len(own)
            weights += [(1.0, 0.0, 0.0, 0.0)] * len(own)
            points += own
        mesh = self.glb.mesh(points, triangles, joints, weights)
        binds = [inverse(matrix_of(translation=self.heads[name])) for name in self.joints]
        skin = self.glb.skin([self.node[name] for name in self.joints], binds)
        self.glb.node("body", mesh=mesh, skin=skin)

    def chain(self, name, count):
        return [self.node[f"{name}{i}"] for i in range(count)]

    def write(self, path, **extensions):
        self.glb.json["extensions"] = extensions
        used = set(extensions)
        if "extended_collider" in str(extensions):
            used.add("VRMC_springBone_extended_collider")
        self.glb.json["extensionsUsed"] = sorted(used)
        return self.glb.write(path)

    def humanoid(self):
        """VRMC_vrm."""
        bones = {bone: {"node": self.node[name]} for bone, name in HUMAN.items()}
        return {"specVersion": "1.0", "meta": {"name": "Tube", "authors": ["sbfmt"], "licenseUrl": "https://vrm.dev/licenses/1.0/"},
                "humanoid": {"humanBones": bones}}

    def old(self, groups, collider_groups):
        """VRM 0.x."""
        bones = [{"bone": bone, "node": self.node[name]} for bone, name in HUMAN.items()]
        return {"specVersion": "0.0", "humanoid": {"humanBones": bones},
                "secondaryAnimation": {"boneGroups": groups, "colliderGroups": collider_groups}}


def joints(nodes, **numbers):
    return [{"node": node, **numbers} for node in nodes]


def springs(avatar, colliders=True, **numbers):
    """VRMC_springBone with all kinds of colliders: hair that hangs around the neck, and a lock within the head's center."""
    far = {"sphere": {"offset": [0, -10000, 0], "radius": 0}}

    def extended(node, shape):
        return {"node": node, "shape": far,
                "extensions": {"VRMC_springBone_extended_collider": {"specVersion": "1.0", "shape": shape}}}

    head, chest, neck = avatar.node["head"], avatar.node["chest"], avatar.node["spine"]
    shapes = [{"node": head, "shape": {"sphere": {"offset": [0, 0.1, -0.02], "radius": 0.11}}},
              {"node": chest, "shape": {"capsule": {"offset": [0, 0, -0.03], "tail": [0, 0.2, -0.04], "radius": 0.14}}},
              extended(head, {"sphere": {"offset": [0, 0, -0.1], "radius": 0.55, "inside": True}}),
              extended(neck, {"capsule": {"offset": [0, -0.2, 0], "tail": [0, 0.7, 0], "radius": 0.5, "inside": True}}),
              extended(chest, {"plane": {"offset": [0, 0, -0.12], "normal": [0, 0, -1]}})]
    hair = joints(avatar.chain("hair", 5), **{"stiffness": 0.4, "gravityPower": 0.3, "dragForce": 0.3, "hitRadius": 0.02, **numbers})
    lock = joints(avatar.chain("lock", 3), **{"stiffness": 0.8, "dragForce": 0.4, "gravityPower": 0.1, **numbers})
    hair[1]["stiffness"] = 0.6
    return {"specVersion": "1.0", "colliders": shapes if colliders else [],
            "colliderGroups": [{"name": "body", "colliders": [0, 1, 4]}, {"name": "around", "colliders": [2, 3]}] if colliders else [],
            "springs": [{"name": "hair", "joints": hair, "colliderGroups": [0, 1] if colliders else []},
                        {"name": "lock", "joints": lock, "center": head}]}


def old_springs(avatar, **numbers):
    """Bone groups and collider groups of VRM 0.x, whose offsets have z against glTF's."""
    turn = 1 if avatar.back else -1
    groups = [{"comment": "hair", "bones": [avatar.node["hair0"]], "stiffiness": 0.4, "gravityPower": 0.3, "dragForce": 0.3,
               "gravityDir": {"x": 0, "y": -1, "z": 0}, "hitRadius": 0.02, "center": -1, "colliderGroups": [0, 1], **numbers},
              {"comment": "lock", "bones": [avatar.node["lock0"]], "stiffiness": 0.8, "gravityPower": 0.1, "dragForce": 0.4,
               "gravityDir": {"x": 0, "y": -1, "z": 0}, "hitRadius": 0, "center": avatar.node["head"], "colliderGroups": []}]
    colliders = [{"node": avatar.node["head"], "colliders": [{"offset": {"x": 0, "y": 0.1, "z": -0.02 * turn}, "radius": 0.11}]},
                 {"node": avatar.node["chest"], "colliders": [{"offset": {"x": 0, "y": 0.1, "z": -0.05 * turn}, "radius": 0.16},
                                                              {"offset": {"x": 0, "y": -0.05, "z": -0.05 * turn}, "radius": 0.14}]}]
    return groups, colliders
