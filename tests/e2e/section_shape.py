"""Measures the distance of a section's surface from its rest shape, after removing the nearest rigid motion
(Horn, Closed-form solution of absolute orientation using unit quaternions, 1987)."""

import math

from motion_files import rotated


def middle_of(points):
    return [sum(p[k] for p in points) / len(points) for k in range(3)]


def nearest_turn(rest, positions):
    """The rotation, as x, y, z, w, that brings `rest` nearest to `positions`, both about their middles."""
    s = [[sum(a[i] * b[j] for a, b in zip(rest, positions)) for j in range(3)] for i in range(3)]
    trace = s[0][0] + s[1][1] + s[2][2]
    row = (s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0])
    matrix = [[s[i][j] + s[j][i] - (trace if i == j else 0) for j in range(3)] + [row[i]] for i in range(3)]
    matrix.append(list(row) + [trace])
    shift = sum(abs(v) for line in matrix for v in line)  # makes the greatest eigenvalue the greatest in size
    q = [0.0, 0.0, 0.0, 1.0]
    for _ in range(200):
        q = [sum(matrix[i][j] * q[j] for j in range(4)) + shift * q[i] for i in range(4)]
        length = math.sqrt(sum(v * v for v in q))
        q = [v / length for v in q]
    return q


def shape_error(section, positions):
    """The farthest of the points in `positions` from where the nearest rigid motion has them, over the size."""
    rest = [section.rest[i] for i in section.used]
    from_middle, to_middle = middle_of(rest), middle_of(positions)
    here = [[p[k] - from_middle[k] for k in range(3)] for p in rest]
    there = [[p[k] - to_middle[k] for k in range(3)] for p in positions]
    q = nearest_turn(here, there)
    return max(math.dist(rotated(q, a), b) for a, b in zip(here, there)) / section.size


def volume_of(polygons, positions):
    """Enclosed by polygons cut into fans."""
    six = 0
    for polygon in polygons:
        a = positions[polygon[0]]
        for second, third in zip(polygon[1:], polygon[2:]):
            b, c = positions[second], positions[third]
            six += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                    a[2] * (b[0] * c[1] - b[1] * c[0]))
    return six / 6
