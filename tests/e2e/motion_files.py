"""Reads what `sbfmt run` writes about a motion, independently of the writer: point caches, pose files,
and the bundle's own rest pose."""

import csv
import math
import struct
import xml.etree.ElementTree as ElementTree

PC2_HEADER = struct.Struct("<12siiffi")


class PointCache:
    def __init__(self, path):
        with open(path, "rb") as stream:
            self.bytes = stream.read()
        (self.magic, self.version, self.point_count, self.start, self.frames_a_sample,
         self.sample_count) = PC2_HEADER.unpack_from(self.bytes)

    def expected_size(self):
        return PC2_HEADER.size + 12 * self.point_count * self.sample_count

    def place(self, sample, point):
        return struct.unpack_from("<3f", self.bytes, PC2_HEADER.size + 12 * (sample * self.point_count + point))


def read_poses(path):
    """{frame: {bone: (px, py, pz, qx, qy, qz, qw)}}, the header and the times of the frames."""
    poses, times = {}, {}
    with open(path, encoding="utf-8", newline="") as stream:
        rows = csv.reader(stream)
        header = next(rows)
        for frame, time, bone, *numbers in rows:
            poses.setdefault(int(frame), {})[bone] = tuple(map(float, numbers))
            times[int(frame)] = float(time)
    return poses, header, times


def rotated(q, v):
    x, y, z, w = q
    t = (2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0]))
    return (v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0])


def triples(text):
    numbers = [float(n) for n in (text or "").split()]
    return [tuple(numbers[i:i + 3]) for i in range(0, len(numbers), 3)]


class Section:
    """A section's surface at rest, as its bone sees it."""

    def __init__(self, body, bones, first):
        self.name, self.bone, self.first = body.get("name"), bones[body.get("bone")].get("name"), first
        bone = bones[body.get("bone")]
        head = [float(n) for n in bone.get("head").split()]
        q = [float(n) for n in bone.get("rotation", "0 0 0 1").split()]
        self.rest = triples(body.find("polygon_mesh/positions").text)
        used = set((body.find("polygon_mesh/polygon_points").text or "").split())
        self.used = [i for i in range(len(self.rest)) if str(i) in used]
        back = (-q[0], -q[1], -q[2], q[3])
        self.local = [rotated(back, [p[k] - head[k] for k in range(3)]) for p in self.rest]
        self.size = math.dist([min(p[k] for p in self.rest) for k in range(3)],
                              [max(p[k] for p in self.rest) for k in range(3)])

    def departure(self, cache, sample, pose):
        """Maximum distance of a point from its position by the bone alone, as a fraction of the size."""
        place = pose[self.bone]
        farthest = 0
        for i in self.used:
            carried = rotated(place[3:], self.local[i])
            farthest = max(farthest, math.dist(cache.place(sample, self.first + i),
                                               [place[k] + carried[k] for k in range(3)]))
        return farthest / self.size


def read_sections(path):
    root = ElementTree.parse(path).getroot()
    bones = {b.get("id"): b for b in root.iter("bone")}
    sections, first = [], 0
    for body in root.findall("soft_body"):
        sections.append(Section(body, bones, first))
        first += len(sections[-1].rest)
    return sections


def slip_of(section, cache, height=0.004, shortest=8):
    """Maximum displacement of a foot's sole over the flat ground in stance: of every run of at least `shortest`
    samples in which the mean of the sole's points is low, less a margin at both ends for coming down and lifting."""
    lowest = min(section.rest[i][1] for i in section.used)
    sole = [i for i in section.used if section.rest[i][1] < lowest + 0.02 * section.size]
    stands, run, farthest = sum(section.rest[i][1] for i in sole) / len(sole), [], 0
    for sample in range(cache.sample_count + 1):
        mean = None
        if sample < cache.sample_count:
            positions = [cache.place(sample, section.first + i) for i in sole]
            mean = [sum(p[k] for p in positions) / len(positions) for k in range(3)]
        if mean and mean[1] < stands + height:
            run.append(mean)
            continue
        if len(run) >= shortest:
            stance = run[2:-2]
            farthest = max(farthest, max(math.dist((p[0], p[2]), (stance[0][0], stance[0][2])) for p in stance))
        run = []
    return farthest


def steps_of(bone, poses, lift):
    """Number of times that a bone's head rose above its first position by at least `lift` and came down again."""
    ground, up, count = poses[0][bone][1], False, 0
    for frame in sorted(poses):
        height = poses[frame][bone][1] - ground
        if not up and height > lift:
            up = True
        elif up and height < lift / 2:
            up, count = False, count + 1
    return count
