"""A foot of the lizard: a palm, four padded toes and a shaft for the ankle, as a coarse cage subdivided once."""

import math

import modelling_path  # noqa: F401
from quad_mesh import QuadMesh, add, dot, scale, sub, subdivided, unit

# Across the foot, inner to outer side, as fractions of the half width.
ACROSS = (-1.0, -0.5, 0.0, 0.5, 1.0)
# Heel, middle, knuckles: metres ahead of the ankle, half width, height at the middle; the knuckles lie on an arc.
ROWS = ((-0.022, 0.019, 0.024, 0.0), (0.006, 0.026, 0.030, 0.0), (0.036, 0.033, 0.019, 0.010))
# Toes, inner to outer: degrees from straight ahead, length.
TOES = ((-42.0, 0.046), (-14.0, 0.054), (14.0, 0.052), (44.0, 0.044))
# Along a toe: fraction of its length, half width, height, material.
TOE_RINGS = ((0.55, 0.0070, 0.0130, "back"), (1.05, 0.0140, 0.0175, "toe"))
# The ankle's outline, (ahead, outward) as fractions of its radius, in the order of the heel's rim.
SHAFT = ((-0.5, -0.85), (-0.9, -0.5), (-1.0, 0.0), (-0.9, 0.5), (-0.5, 0.85),
        (0.5, 0.85), (0.9, 0.5), (1.0, 0.0), (0.9, -0.5), (0.5, -0.85))
SHAFT_RADIUS, SHAFT_HEIGHT, SHAFT_LEAN = 0.0212, 0.056, 0.010


def foot(leg):
    knee, ankle = leg.joints[1:]
    ahead = unit((leg.toes[0] - ankle[0], 0.0, leg.toes[2] - ankle[2]))
    outward = (ahead[2], 0.0, -ahead[0])
    cage = QuadMesh(leg.names[2] + ".L")

    def put(forward, aside, up):
        position = add((ankle[0], 0.0, ankle[2]), add(scale(ahead, forward), scale(outward, aside)))
        return cage.add_point(add(position, (0.0, up, 0.0)))

    def quad(*corners, material="back"):
        cage.add_face(corners, ((0.0, 0.0),) * 4, material)    # uvs come at the end

    palm(put, quad, leg.foot_size, (dot(sub(knee, ankle), ahead), dot(sub(knee, ankle), outward), knee[1] - ankle[1]))
    mesh = subdivided(cage)
    lowest = min(p[1] for p in mesh.points)
    mesh.points = [(x, y - lowest, z) for x, y, z in mesh.points]
    unwrap(mesh, ankle, ahead, outward)
    return mesh


def palm(put, quad, size, shin):
    """The cage. shin: from ankle to knee, as (ahead, outward, up); the ankle leans that way."""
    sole = [[put(size * (x - bend * c * c), size * half * c, 0.0) for c in ACROSS] for x, half, _, bend in ROWS]
    top = [[put(size * (x - bend * c * c), size * half * c, size * (high - 0.008 * abs(c))) for c in ACROSS]
           for x, half, high, bend in ROWS]
    for r in range(2):
        for c in range(4):
            quad(sole[r][c], sole[r][c + 1], sole[r + 1][c + 1], sole[r + 1][c], material="belly")
        quad(sole[r][0], sole[r + 1][0], top[r + 1][0], top[r][0])
        quad(sole[r][4], top[r][4], top[r + 1][4], sole[r + 1][4])
    for c in range(4):
        quad(sole[0][c], top[0][c], top[0][c + 1], sole[0][c + 1])
        quad(top[1][c], top[2][c], top[2][c + 1], top[1][c + 1])
    # the heel's upper side grows into the round shaft of the ankle, which ends inside the lower leg
    rim = top[0] + top[1][::-1]
    lean = SHAFT_LEAN / shin[2]
    radius = size * SHAFT_RADIUS
    shaft = [put(radius * f + lean * shin[0], radius * o + lean * shin[1], size * SHAFT_HEIGHT) for f, o in SHAFT]
    for i in range(10):
        quad(rim[i], shaft[i], shaft[(i + 1) % 10], rim[(i + 1) % 10])
    for i in range(4):
        quad(shaft[i], shaft[9 - i], shaft[8 - i], shaft[i + 1])
    for number in range(4):
        knuckle = (sole[2][number], sole[2][number + 1], top[2][number + 1], top[2][number])
        toe(put, quad, size, number, knuckle)


def toe(put, quad, size, number, knuckle):
    degrees, reach = TOES[number]
    cosine, sine = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    middle = (number - 1.5) * 0.5
    x0, half_palm, _, bend = ROWS[2]
    ring = knuckle
    for part, half, high, material in TOE_RINGS:
        x, aside = x0 - bend * middle ** 2 + reach * part * cosine, half_palm * middle + reach * part * sine
        inner, outer = (x + half * sine, aside - half * cosine), (x - half * sine, aside + half * cosine)
        after = [put(size * a, size * b, size * up)
                 for (a, b), up in ((inner, 0.0), (outer, 0.0), (outer, high), (inner, high))]
        for i in range(4):
            below = i == 0 and material == "back"
            quad(ring[i], ring[(i + 1) % 4], after[(i + 1) % 4], after[i], material="belly" if below else material)
        ring = after
    quad(*ring, material="toe")


def unwrap(mesh, ankle, ahead, outward):
    """Makes two islands, the sole and the upper side, projected along y. Spreads them a little along the normals so that steep
    sides keep some area."""
    seen = []
    for point, normal in zip(mesh.points, mesh.normals()):
        spread = add(sub(point, ankle), scale(normal, 0.012))
        seen.append((dot(spread, outward), dot(spread, ahead)))
    low = [min(c[i] for c in seen) for i in (0, 1)]
    span = max(max(c[i] for c in seen) - low[i] for i in (0, 1))
    position = [tuple((c[i] - low[i]) / span for i in (0, 1)) for c in seen]

    def uvs(face):
        down = mesh.face_normal(face)[1] < 0.0
        return tuple((0.5 - 0.5 * position[c][0] if down else 0.5 + 0.5 * position[c][0], position[c][1]) for c in face.corners)

    mesh.faces = [face._replace(uvs=uvs(face)) for face in mesh.faces]
