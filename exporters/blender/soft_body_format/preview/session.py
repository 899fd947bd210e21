"""A preview's simulation: the runtime's world, its current frame, and its controls."""

import math

import numpy
from mathutils import Matrix

from ..sbfmt import runtime
from ..space import Space, frame_rate
from .walk_path import Walker, path_of

JUMP = 10  # frames: a longer step restarts the simulation, as in Blender's soft body
NO_GROUND_M = 1e4


class Session:
    """Plays a Built. Owns the runtime's world; `close` frees it."""

    def __init__(self, context, built, whole, frame, clip=None):
        scene = context.scene
        self.scene_name, self.space, self.built = scene.name, Space.of_scene(scene), built
        self.settings_of_walk(context, scene.soft_body_format.preview)
        self.number_of_bone = {bone.id: index for index, bone in enumerate(built.document.bones)}
        self.bones = {}  # by armature: [(bone name, number)]
        for (armature, name), identity in whole.writer.skeleton.ids.items():
            if identity in self.number_of_bone:
                self.bones.setdefault(armature, []).append((name, self.number_of_bone[identity]))
        self.clip = next((index for index, one in enumerate(built.document.clips) if one.id == clip), None)
        self.model = runtime.Model(built.asset)
        self.ground = self.make_ground(context, scene.soft_body_format.preview)
        self.world = runtime.World(self.ground)
        try:
            self.make_character(scene, frame)
        except BaseException:
            self.world.close()
            raise

    # ---- Beginning ----

    def settings_of_walk(self, context, settings):
        measured = self.built.asset.measure()["bounds"]
        size = max(measured["max"][axis] - measured["min"][axis] for axis in (0, 2)) if measured else 1.0
        self.size_m = max(size, 1e-3)
        self.walker = None
        if settings.drive == "CURVE" and settings.curve is not None:
            path = path_of(settings.curve, self.space, context.evaluated_depsgraph_get())
            self.walker = Walker(path, self.size_m) if path is not None else None

    def make_ground(self, context, settings):
        height = settings.ground_height * self.space.unit_m
        if settings.ground == "NONE":
            return runtime.flat(-NO_GROUND_M)
        if settings.ground == "OBJECT" and settings.ground_object is not None:
            return ground_of(settings.ground_object, self.space, context.evaluated_depsgraph_get(), height)
        return runtime.flat(height)

    def make_character(self, scene, frame):
        settings = scene.soft_body_format.preview
        heading, start = 0.0, numpy.zeros(2)
        gait = self.built.document.gaits[0] if self.built.document.gaits else None
        self.body = self.number_of_bone.get(gait.body) if gait is not None else None
        head = self.built.document.bones[self.body].head if self.body is not None else (0, 0, 0)
        if self.walker is not None:
            heading = self.walker.path.heading(0.0)
            start = self.walker.path.at(0.0)
            cosine, sine = math.cos(heading), math.sin(heading)
            start = start - (cosine * head[0] + sine * head[2], cosine * head[2] - sine * head[0])
        # A walking character starts on the ground; others start where they were modelled.
        high = 0.0 if gait is not None and settings.ground != "NONE" else -self.ground.height_at(*start)
        self.character = self.world.add(self.model, (start[0], high, start[1]), heading)
        self.frame = frame
        self.play_clip(scene, frame)
        rate = frame_rate(scene)
        for _ in range(round(settings.settling_s * rate)):
            self.world.step(1 / rate)
        self.first = self.world.snapshot()

    def close(self):
        self.world.close()

    def state(self):
        """A one-line summary for the panel."""
        words = [f"Frame {self.frame}"]
        if self.body is not None:
            words.append(f"{self.character.distance:.2f} m walked")
        health = [self.character.health(index) for index in range(len(self.built.document.soft_bodies))]
        recovered, torn = sum(one.recoveries for one in health), sum(one.torn for one in health)
        words += [f"{recovered} recoveries"] if recovered else []
        words += [f"{torn} torn"] if torn else []
        return ", ".join(words)

    # ---- Time ----

    def go_to(self, scene, frame):
        """Steps to the frame if it is a few frames ahead; otherwise restarts the simulation at that frame."""
        ahead = frame - self.frame
        if ahead == 0:
            return
        if 0 < ahead < JUMP:
            for _ in range(ahead):
                self.step(scene)
            self.frame = frame
        else:
            self.reset(scene, frame)

    def reset(self, scene, frame):
        self.world.restore(self.first)
        if self.walker is not None:
            self.walker.begin()
        self.frame = frame
        self.play_clip(scene, frame)

    def play_clip(self, scene, frame):
        if self.clip is not None:
            self.character.play(self.clip, start=max(0.0, (frame - scene.frame_start) / frame_rate(scene)))

    def step(self, scene):
        """Steps one frame with the current speeds."""
        settings = scene.soft_body_format.preview
        if settings.drive == "WALK":
            self.character.drive(settings.speed, settings.sideways, settings.turn)
        elif settings.drive == "CURVE" and self.walker is not None and self.body is not None:
            forward, turn = self.walker.drive(*self.ground_position(), max(settings.speed, 0.0))
            self.character.drive(forward, 0.0, turn)
        else:
            self.character.drive()
        self.world.step(1 / frame_rate(scene))

    def ground_position(self):
        """The body bone's position on the ground, and its heading."""
        bone = self.character.bones(self.body + 1)[self.body]
        origin = self.character.origin
        forward = turned(bone.rotation, turned(conjugate(self.built.document.bones[self.body].rotation), (0.0, 0.0, 1.0)))
        return numpy.array([origin[0] + bone.position[0], origin[2] + bone.position[2]]), math.atan2(forward[0], forward[2])

    # ---- What is seen ----

    def points(self, actor):
        """The points of an actor in Blender's world space: an (n, 3) array."""
        found = self.character.skin(actor.index) if actor.kind == "skin" else self.character.surface(actor.index)
        return self.in_scene(found)

    def level_points(self, body):
        """The points of a soft body's simulated level in Blender's world space: an (n, 3) array."""
        return self.in_scene(self.character.points(body))

    def in_scene(self, found):
        return self.space.points_back(numpy.frombuffer(found, dtype=numpy.float32).reshape(-1, 3) + numpy.array(self.character.origin))

    def bone_frames(self, armature):
        """{bone name: 4x4 matrix in Blender's world space}."""
        bones, origin = self.character.bones(len(self.number_of_bone)), self.character.origin
        frames = {}
        for name, number in self.bones.get(armature, ()):
            position = self.space.point_back([a + b for a, b in zip(bones[number].position, origin)])
            frames[name] = Matrix.Translation(position) @ self.space.rotation_back(bones[number].rotation).to_matrix().to_4x4()
        return frames


def conjugate(q):
    return (-q[0], -q[1], -q[2], q[3])


def turned(q, v):
    """A vector rotated by a quaternion x, y, z, w."""
    x, y, z, w = q
    u = numpy.array((x, y, z))
    v = numpy.array(v)
    return v + 2 * numpy.cross(u, numpy.cross(u, v) + w * v)


def ground_of(source, space, depsgraph, fallback_m):
    """A mesh object's triangles with modifiers applied, as the runtime's ground."""
    evaluated = source.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    try:
        mesh.calc_loop_triangles()
        points = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
        mesh.vertices.foreach_get("co", points)
        triangles = numpy.empty(3 * len(mesh.loop_triangles), dtype=numpy.int32)
        mesh.loop_triangles.foreach_get("vertices", triangles)
    finally:
        evaluated.to_mesh_clear()
    return runtime.GroundMesh(space.points(points.reshape(-1, 3), source.matrix_world).ravel(), triangles.tolist(), fallback_m)
