"""Makes the lizard's closed skin: the tube of the body, legs joined to holes in it, and feet at their ends."""

import math
from collections import Counter

import modelling_path  # noqa: F401
from lizard_body import LEG_ANGLES, TAIL_JOINTS, TRUNK_ANGLES, leg_material, spaced, tail_material, trunk_material
from lizard_foot import foot
from lizard_head import head
from lizard_shape import BODY, LEGS, METRES_AT, across_middle
from loft import Cap, loft
from quad_mesh import Face, QuadMesh, cross, dot, length, mean, scale, sub, unit
from skin_files import planted, smooth_weights

TRUNK_JOINTS = [METRES_AT[z] for z in (-0.205, -0.070, 0.055, 0.170, 0.240)]
ROWS = (4, 4, 4, 4, 4, 5, 5, 5, 3)
END_GRID = 4        # the patch that closes the neck, which the head replaces
MARGIN_M = 0.004    # gap between a leg's edge on the body and the nearest kept quads
SHIN_M = 0.034      # before the ankle the lower leg ends, the foot's shaft goes on
REACH_M = 0.022     # over which a point passes from bone to bone
SOLE_M = 0.022      # points below it follow only their foot


def body():
    """Tail, trunk and neck, open where the head begins."""
    joints = TAIL_JOINTS + TRUNK_JOINTS[1:]
    stations = [joints[0]]
    for start, end, rows in zip(joints, joints[1:], ROWS):
        stations += spaced(start, end, rows)[1:]
    mesh = loft("Lizard", BODY, stations[:-1], lambda s: TRUNK_ANGLES, Cap(0.010, (), 2.0), Cap(0.02, (), grid=END_GRID),
                lambda s, k: (tail_material if s < TAIL_JOINTS[-1] else trunk_material)(s, k))
    del mesh.faces[-END_GRID * END_GRID:]
    return mesh.without_unused_points()


def open_head():
    """The head without its part inside the neck."""
    mesh, joint = head(), TRUNK_JOINTS[-1]
    centre, ahead = BODY.centre(joint), BODY.frame(joint)[2]
    mesh.faces = [face for face in mesh.faces
                  if max(dot(sub(mesh.points[c], centre), ahead) for c in face.corners) > 1e-6]
    return mesh.without_unused_points()


def append(mesh, other):
    """Adds another mesh's points and faces."""
    first = len(mesh.points)
    mesh.points += other.points
    mesh.faces += [Face(tuple(c + first for c in face.corners), face.uvs, face.material) for face in other.faces]


def edge_loops(mesh):
    """The loops of points along open edges, each in the order of the missing faces."""
    edges = mesh.directed_edges()
    after = {b: a for a, b in edges if (b, a) not in edges}
    loops = []
    while after:
        loop = [min(after)]
        while after[loop[-1]] != loop[0]:
            loop.append(after[loop[-1]])
        loops.append(loop)
        for point in loop:
            del after[point]
    return loops


def nearest_loop(mesh, spot):
    return min(edge_loops(mesh), key=lambda loop: length(sub(mean([mesh.points[c] for c in loop]), spot)))


def bridge(mesh, near, far, axis, material):
    """Faces between two loops around an axis that points from `near` to `far`; material(point): of a face there."""
    start = (0.0, -1.0, 0.0) if abs(axis[1]) < 0.7 else (0.0, 0.0, 1.0)
    u = unit(sub(start, scale(axis, dot(start, axis))))
    v = cross(axis, u)

    def around(loop):
        centre = mean([mesh.points[c] for c in loop])
        offsets = [sub(mesh.points[c], centre) for c in loop]
        turned = sorted((round(math.atan2(dot(offset, v), dot(offset, u)), 9) % (2.0 * math.pi), c) for offset, c in zip(offsets, loop))
        return turned + [(turned[0][0] + 2.0 * math.pi, turned[0][1])]

    inner, outer = around(near), around(far)
    i = j = 0
    step = 2.0 * math.pi / max(len(near), len(far))
    while i + 1 < len(inner) or j + 1 < len(outer):
        ahead_inner = inner[i + 1][0] if i + 1 < len(inner) else math.inf
        ahead_outer = outer[j + 1][0] if j + 1 < len(outer) else math.inf
        corners = [inner[i][1]]
        if ahead_inner <= ahead_outer + 0.6 * step:
            i += 1
            corners.append(inner[i][1])
        corners_far = [outer[j][1]]
        if ahead_outer <= ahead_inner + 0.6 * step:
            j += 1
            corners_far.insert(0, outer[j][1])
        corners += corners_far
        spots = [mesh.points[c] for c in corners]
        mesh.add_face(corners, [(0.5 + x, 0.5 + z) for x, _, z in spots], material(mean(spots)))


def leg_tube(leg):
    """Upper and lower leg, open at both ends; the first ring lies on the body."""
    out, knee, ankle, material = leg.skin.at, leg.knee_at, leg.ankle_at, leg_material(leg)
    stations = [out, out + 0.010, out + 0.024, out + 0.045, knee - 0.014, knee, knee + 0.014, *spaced(knee + 0.034, ankle - SHIN_M, 3)]
    tube, count = QuadMesh(leg.names[0]), len(LEG_ANGLES)
    for s in stations:
        for angle in LEG_ANGLES:
            tube.add_point(leg.skin.point(s, angle))
    span = stations[-1] - stations[0]
    for i, (low, high) in enumerate(zip(stations, stations[1:])):
        for k in range(count):
            beside = (k + 1) % count
            v0, v1 = ((s - stations[0]) / span for s in (low, high))
            tube.add_face((i * count + k, i * count + beside, (i + 1) * count + beside, (i + 1) * count + k),
                          ((k / count, v0), ((k + 1) / count, v0), ((k + 1) / count, v1), (k / count, v1)), material(0.5 * (low + high), k))
    return tube


def open_foot(leg):
    """The foot without the patch that closes its shaft."""
    mesh = foot(leg)
    top = 0.8 * max(p[1] for p in mesh.points)

    def closes(face):
        normal = mesh.face_normal(face)
        return normal[1] > 0.7 * length(normal) and mean([mesh.points[c] for c in face.corners])[1] > top

    mesh.faces = [face for face in mesh.faces if not closes(face)]
    return mesh.without_unused_points()


def cleared(mesh, points):
    """Removes the faces at these points, and those at a point where two parts of the hole meet; returns all of them."""
    removed = []
    while points:
        removed += [face for face in mesh.faces if points & set(face.corners)]
        mesh.faces = [face for face in mesh.faces if not points & set(face.corners)]
        edges = mesh.directed_edges()
        points = {c for c, n in Counter(a for a, b in edges if (b, a) not in edges).items() if n > 1}
    return removed


def with_leg(mesh, leg):
    """The body with a left leg: removes the quads under the leg's first ring and joins the open edges."""
    tube = leg_tube(leg)
    base, normal = leg.skin.centre(leg.skin.at), leg.skin.normal

    def off_axis(point):
        offset = sub(point, base)
        along = dot(offset, normal)
        return length(sub(offset, scale(normal, along))) if along > -0.05 else math.inf

    reach = max(off_axis(p) for p in tube.points[:len(LEG_ANGLES)]) + MARGIN_M
    removed = cleared(mesh, {c for c, p in enumerate(mesh.points) if off_axis(p) <= reach})

    def body_material(point):
        return min(removed, key=lambda face: length(sub(mean([mesh.points[c] for c in face.corners]), point))).material

    hole = nearest_loop(mesh, base)
    first = len(mesh.points)
    append(mesh, tube)
    count = len(LEG_ANGLES)
    bridge(mesh, hole, list(range(first, first + count)), normal, body_material)
    shin = list(range(len(mesh.points) - count, len(mesh.points)))
    append(mesh, open_foot(leg))
    knee, ankle = leg.joints[1:]
    bridge(mesh, shin, nearest_loop(mesh, ankle), unit(sub(ankle, knee)), lambda point: "back")
    return mesh.without_unused_points()


def mirror_faces(mesh, first):
    """Makes faces on the right mirror images of those on the left, from face `first` on."""
    index = {p: c for c, p in enumerate(mesh.points)}
    left = [face for face in mesh.faces[first:] if sum(mesh.points[c][0] for c in face.corners) > 0.0]
    images = [[index[across_middle(mesh.points[c])] for c in face.corners] for face in left]
    mesh.faces[first:] = left
    for face, corners in zip(left, images):
        mesh.add_face(corners[:1] + corners[:0:-1], face.uvs[:1] + face.uvs[:0:-1], face.material)


def lizard_skin():
    mesh = body()
    append(mesh, open_head())
    mesh.symmetrise()
    neck, rear = sorted(edge_loops(mesh), key=len)
    first = len(mesh.faces)
    bridge(mesh, neck, rear, BODY.frame(TRUNK_JOINTS[-1])[2], neck_material)
    mirror_faces(mesh, first)
    for leg in LEGS:
        mesh = with_leg(with_leg(mesh, leg).mirrored("Lizard"), leg).mirrored("Lizard")
    return mesh.round_points()


def neck_material(point):
    joint = TRUNK_JOINTS[-1]
    offset = sub(point, BODY.centre(joint))
    across, upward, _ = BODY.frame(joint)
    angle = math.atan2(abs(dot(offset, across)), -dot(offset, upward))
    return trunk_material(joint, min(7, int(8.0 * angle / math.pi)))


def skin_weights(points, bones):
    """Weights of the bones that move the skin. The root and the bare ends move no points."""
    moving = [i for i, bone in enumerate(bones) if bone.limits]
    chosen = [bones[i] for i in moving]
    weights = planted(points, chosen, smooth_weights(points, chosen, REACH_M), SOLE_M)
    return [[(moving[i], w) for i, w in of_point] for of_point in weights]
