"""Blender's space and the format's: Z-up in scene units here, metres and Y-up there. A character that faces -Y faces +Z."""

import numpy
from mathutils import Matrix, Quaternion, Vector

# Asset from Blender: (x, y, z) becomes (x, z, -y).
ASSET_FROM_BLENDER = Matrix(((1, 0, 0), (0, 0, 1), (0, -1, 0)))
TURN = ASSET_FROM_BLENDER.to_quaternion()


def frame_rate(scene):
    """Frames a second."""
    return scene.render.fps / scene.render.fps_base


class Space:
    """Maps a scene's world to asset space, and back. `unit_m` is the length of a scene unit in metres."""

    def __init__(self, unit_m=1.0):
        self.unit_m = unit_m

    @classmethod
    def of_scene(cls, scene):
        return cls(scene.unit_settings.scale_length if scene.unit_settings.system != "NONE" else 1.0)

    def matrix(self, world):
        """From an object's own space to asset space: 4x4, lengths in metres."""
        turn = ASSET_FROM_BLENDER.to_4x4()
        return Matrix.Scale(self.unit_m, 4) @ turn @ world

    def points(self, points, world):
        """An (n, 3) array of an object's points in asset space, as binary32."""
        matrix = numpy.array(self.matrix(world), dtype=numpy.float64)
        return (points.astype(numpy.float64) @ matrix[:3, :3].T + matrix[:3, 3]).astype(numpy.float32)

    def offsets(self, offsets, world):
        """Differences of points: turned and scaled, not moved."""
        matrix = numpy.array(self.matrix(world), dtype=numpy.float64)
        return (offsets.astype(numpy.float64) @ matrix[:3, :3].T).astype(numpy.float32)

    def normals(self, normals, world):
        """Unit normals, by the inverse transpose; zero ones point up."""
        matrix = numpy.array(self.matrix(world), dtype=numpy.float64)[:3, :3]
        turned = normals.astype(numpy.float64) @ numpy.linalg.inv(matrix)
        lengths = numpy.linalg.norm(turned, axis=1, keepdims=True)
        turned = numpy.where(lengths > 0, turned / numpy.where(lengths > 0, lengths, 1), (0.0, 1.0, 0.0))
        return turned.astype(numpy.float32)

    def point(self, point):
        """One point of the world."""
        return tuple(ASSET_FROM_BLENDER @ point * self.unit_m)

    def direction(self, vector):
        """One direction of the world."""
        return tuple(ASSET_FROM_BLENDER @ vector)

    @staticmethod
    def rotation(rotation):
        """A rotation from some frame to the world, as x, y, z, w from that frame to asset space."""
        turned = (TURN @ rotation).normalized()
        return (turned.x, turned.y, turned.z, turned.w)

    # ---- Back ----

    def point_back(self, point):
        return ASSET_FROM_BLENDER.transposed() @ Vector(point) / self.unit_m

    @staticmethod
    def direction_back(vector):
        return ASSET_FROM_BLENDER.transposed() @ Vector(vector)

    def points_back(self, points):
        back = numpy.array(ASSET_FROM_BLENDER, dtype=numpy.float64)
        return (numpy.asarray(points, dtype=numpy.float64).reshape(-1, 3) @ back / self.unit_m).astype(numpy.float32)

    @staticmethod
    def rotation_back(xyzw):
        x, y, z, w = xyzw
        return TURN.inverted() @ Quaternion((w, x, y, z))
