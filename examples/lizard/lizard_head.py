"""The lizard's head: a wedge with a smile, two nostrils, and eyes set into rings of lid."""

import math

import modelling_path  # noqa: F401
from lizard_body import both_sides
from lizard_shape import AXIS, BODY, METRES_AT, across_middle
from loft import Cap, Keys, border_walk, coons, inset_rings, loft
from quad_mesh import add, cross, dot, lerp, scale, sub, unit

RING_Z = (0.240, 0.262, 0.283, 0.303, 0.322, 0.341, 0.360, 0.379, 0.399, 0.418, 0.435)
AROUND = 24
MOUTH = 4                   # the mouth runs between angles 4 and 5 on either side,
MOUTH_CORNER = 2            # from this ring on
EYE_RINGS, EYE_ANGLES = (3, 7), (6, 10)

REAR = Cap(0.050, (0.3, 0.65), 2.0, 6)
NOSE = Cap(0.034, (0.35, 0.72), 2.1, 6)

# by part of the head's length: how many degrees the mouth line rises
SMILE = Keys([(0.0, 0.0), (0.2, 10.0), (0.45, -1.0), (0.7, -1.0), (1.0, 4.0)])

EYE_CENTRE = (0.0595, 0.2690, 0.3430)
EYE_AXIS = unit((0.80, 0.40, 0.36))
EYE_RADIUS, IRIS_RADIUS, PUPIL_RADIUS = 0.0270, 0.0238, 0.0145


def metres_at(z):
    low, high = METRES_AT[RING_Z[0]], METRES_AT[RING_Z[-1]]
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if AXIS(middle)[2] < z else (low, middle)
    return 0.5 * (low + high)


STATIONS = [metres_at(z) for z in RING_Z]


def angles(s):
    """The mouth line is highest at its corner, low along the jaw, and the stripe on the skull narrows to the front."""
    along = min(max((s - STATIONS[0]) / (STATIONS[-1] - STATIONS[0]), 0.0), 1.0)
    smile = SMILE(along)[0]
    return both_sides([0.0, 18.0, 36.0, 53.0 + 0.4 * smile, 67.5 + smile, 72.6 + smile + 3.4 * along,
                       90.0 + 0.5 * smile, 108.0, 125.0, 142.0, 157.5 + 13.0 * along, 169.0 + 6.0 * along, 180.0])


def material(s, k):
    side = min(k, AROUND - 1 - k)
    if side == MOUTH:
        return "mouth" if s > STATIONS[MOUTH_CORNER] else "belly"
    return "belly" if side < MOUTH else "flank" if side == MOUTH + 1 else "stripe" if side >= 10 else "back"


def point_at(ring, k):
    """Index of a point of the lofted mesh, where the rings of the rear cap come first."""
    return (len(REAR.loops) + ring) * AROUND + k % AROUND


def head():
    mesh = loft("Head", BODY, STATIONS, angles, REAR, NOSE, material)
    # lips: the mouth's points sink in a little
    for ring in range(MOUTH_CORNER + 1, len(RING_Z) + len(NOSE.loops)):
        for k in (MOUTH, MOUTH + 1, -MOUTH, -MOUTH - 1):
            x, y, z = mesh.points[point_at(ring, k)]
            mesh.points[point_at(ring, k)] = (0.965 * x, y, z)
    # nostrils: two quads of the snout's closing patch, which is 6 x 6 from the bottom up and comes last
    patch = len(mesh.faces) - 36
    for index in (patch + 4 * 6 + 1, patch + 4 * 6 + 4):
        mesh.faces[index] = mesh.faces[index]._replace(material="stripe")
    put_eye(mesh, 1)
    put_eye(mesh, -1)
    return mesh.without_unused_points()


def put_eye(mesh, side):
    """A ball set into the skull on one side (1 left, -1 right): lid, iris, and a round pupil with a glint."""
    patch = [[point_at(ring, side * k) for k in range(EYE_ANGLES[0], EYE_ANGLES[1] + 1)]
             for ring in range(EYE_RINGS[0], EYE_RINGS[1] + 1)]
    size = len(patch) - 1
    walk = border_walk(size)
    centre, axis = (EYE_CENTRE, EYE_AXIS) if side > 0 else (across_middle(EYE_CENTRE), across_middle(EYE_AXIS))

    # angles around the axis: even ones, turned so that ring points lie as near as can be to the border points they join
    first = sub(mesh.points[patch[0][0]], centre)
    u = unit(sub(first, scale(axis, dot(first, axis))))
    v = cross(axis, u)
    even = [2.0 * math.pi * i / len(walk) for i in range(len(walk))]
    if dot(sub(mesh.points[patch[0][1]], centre), v) < 0.0:
        v = scale(v, -1.0)
    border = []
    for (row, column), angle in zip(walk, even):
        offset = sub(mesh.points[patch[row][column]], centre)
        border.append(angle + math.remainder(math.atan2(dot(offset, v), dot(offset, u)) - angle, 2.0 * math.pi))
    turn = sum(b - e for b, e in zip(border, even)) / len(walk)
    even = [angle + turn for angle in even]

    def circle(radius, height, around=even):
        middle = add(centre, scale(axis, height))
        return [add(middle, add(scale(u, radius * math.cos(a)), scale(v, radius * math.sin(a)))) for a in around]

    def height_on_ball(radius):
        return math.sqrt(EYE_RADIUS ** 2 - radius ** 2)

    rings = [circle(0.0312, 0.0058, [0.5 * (b + e) for b, e in zip(border, even)]), circle(0.0290, 0.0118),
             circle(IRIS_RADIUS, height_on_ball(IRIS_RADIUS)), circle(PUPIL_RADIUS, height_on_ball(PUPIL_RADIUS))]
    rim = dict(zip(walk, rings[-1]))
    pupil = [[None] * (size + 1) for _ in range(size + 1)]
    for row in range(1, size):
        for column in range(1, size):
            flat, rho = coons(rim, size, size, row, column)
            rise = height_on_ball(rho * PUPIL_RADIUS) - height_on_ball(PUPIL_RADIUS)
            pupil[row][column] = add(flat, scale(axis, rise))
    inset_rings(mesh, patch, rings, pupil, ["back", "flank", "stripe", "iris"],
                lambda row, column: "glint" if (row, column) == (2, 2) else "pupil")
