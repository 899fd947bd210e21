"""Converts between Blender's space (Z up, scene units) and the format's (Y up, metres). A character faces +Z in the format. The
scene's settings give the direction it faces in Blender (default -Y, as in front view) and the height of the ground."""

import numpy
from mathutils import Matrix, Quaternion, Vector

DIRECTIONS = ("-Y", "X", "Y", "-X")  # forward directions, a quarter turn about the vertical apart
# From Blender to asset space for a character that faces -Y: (x, y, z) becomes (x, z, -y).
UPRIGHT = Matrix(((1, 0, 0), (0, 0, 1), (0, -1, 0)))
BACK = tuple(Matrix(rows) for rows in (((1, 0, 0), (0, 1, 0), (0, 0, 1)), ((0, 0, -1), (0, 1, 0), (1, 0, 0)),
                                       ((-1, 0, 0), (0, 1, 0), (0, 0, -1)), ((0, 0, 1), (0, 1, 0), (-1, 0, 0))))


def frame_rate(scene):
    """Frames a second."""
    return scene.render.fps / scene.render.fps_base


class Space:
    """Maps a scene's world to asset space and back. `unit_m` is the length of a scene unit in metres, `ahead` the forward direction,
    `ground` the height of the ground in scene units."""

    def __init__(self, unit_m=1.0, ahead="-Y", ground=0.0):
        self.unit_m, self.ahead, self.ground = unit_m, ahead, ground
        self.turn = BACK[DIRECTIONS.index(ahead)] @ UPRIGHT
        self.quaternion = self.turn.to_quaternion()
        self.lift = Vector((0, 0, -ground))

    @classmethod
    def of_scene(cls, scene):
        settings = scene.soft_body_format
        return cls(scene.unit_settings.scale_length if scene.unit_settings.system != "NONE" else 1.0, settings.ahead, settings.ground)

    @property
    def placement(self):
        """The forward direction and the ground height, as the scene's panel states them."""
        return [DIRECTIONS.index(self.ahead), self.ground]

    def matrix(self, world):
        """The 4x4 matrix from an object's own space to asset space; lengths in metres."""
        return Matrix.Scale(self.unit_m, 4) @ self.turn.to_4x4() @ Matrix.Translation(self.lift) @ world

    def points(self, points, world):
        """An (n, 3) array of an object's points in asset space, as binary32."""
        matrix = numpy.array(self.matrix(world), dtype=numpy.float64)
        return (points.astype(numpy.float64) @ matrix[:3, :3].T + matrix[:3, 3]).astype(numpy.float32)

    def offsets(self, offsets, world):
        """Differences of points: rotated and scaled, not translated."""
        matrix = numpy.array(self.matrix(world), dtype=numpy.float64)
        return (offsets.astype(numpy.float64) @ matrix[:3, :3].T).astype(numpy.float32)

    def normals(self, normals, world):
        """Unit normals, transformed by the inverse transpose. Zero normals become upward ones."""
        matrix = numpy.array(self.matrix(world), dtype=numpy.float64)[:3, :3]
        turned = normals.astype(numpy.float64) @ numpy.linalg.inv(matrix)
        lengths = numpy.linalg.norm(turned, axis=1, keepdims=True)
        turned = numpy.where(lengths > 0, turned / numpy.where(lengths > 0, lengths, 1), (0.0, 1.0, 0.0))
        return turned.astype(numpy.float32)

    def point(self, point):
        """One point of the world."""
        return tuple(self.turn @ (point + self.lift) * self.unit_m)

    def direction(self, vector):
        """One direction of the world."""
        return tuple(self.turn @ vector)

    def rotation(self, rotation):
        """Converts a rotation from a frame to the world into one from that frame to asset space: x, y, z, w."""
        turned = (self.quaternion @ rotation).normalized()
        return (turned.x, turned.y, turned.z, turned.w)

    # ---- Back ----

    def point_back(self, point):
        return self.turn.transposed() @ Vector(point) / self.unit_m - self.lift

    def direction_back(self, vector):
        return self.turn.transposed() @ Vector(vector)

    def offsets_back(self, offsets):
        """An (n, 3) array of differences of points in the world."""
        back = numpy.array(self.turn, dtype=numpy.float64)
        return (numpy.asarray(offsets, dtype=numpy.float64).reshape(-1, 3) @ back / self.unit_m).astype(numpy.float32)

    def points_back(self, points):
        return self.offsets_back(points) - numpy.array(self.lift, dtype=numpy.float32)

    def rotation_back(self, xyzw):
        x, y, z, w = xyzw
        return self.quaternion.inverted() @ Quaternion((w, x, y, z))
