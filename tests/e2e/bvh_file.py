"""A BVH file read with the standard library alone: its joints, and where they are in a frame."""

from bundle_file import matrix_of, product
from math import cos, radians, sin


def turn(axis, degrees):
    c, s = cos(radians(degrees)), sin(radians(degrees))
    return {"X": ((1, 0, 0, 0), (0, c, -s, 0), (0, s, c, 0)), "Y": ((c, 0, s, 0), (0, 1, 0, 0), (-s, 0, c, 0)),
            "Z": ((c, -s, 0, 0), (s, c, 0, 0), (0, 0, 1, 0))}[axis]


class Bvh:
    def __init__(self, path):
        with open(path, encoding="ascii") as stream:
            words = stream.read().split()
        self.names, self.parents, self.offsets, self.channels = [], [], [], []
        at, stack, in_end = 1, [], False
        while words[at] != "MOTION":
            word = words[at]
            if word in ("ROOT", "JOINT"):
                self.names.append(words[at + 1])
                self.parents.append(stack[-1] if stack else None)
                at += 2
            elif word == "End":
                in_end, at = True, at + 2
            elif word == "{":
                stack.append(None if in_end else len(self.names) - 1)
                at += 1
            elif word == "}":
                in_end = False
                stack.pop()
                at += 1
            elif word == "OFFSET":
                if not in_end:
                    self.offsets.append(tuple(map(float, words[at + 1:at + 4])))
                at += 4
            else:
                assert word == "CHANNELS", word
                count = int(words[at + 1])
                self.channels.append(words[at + 2:at + 2 + count])
                at += 2 + count
        self.frame_count = int(words[at + 2])
        self.frame_time = float(words[at + 5])
        values, width = [float(word) for word in words[at + 6:]], sum(map(len, self.channels))
        self.frames = [values[i * width:(i + 1) * width] for i in range(self.frame_count)]

    def worlds(self, frame=None):
        """Each joint's frame as 3x4 rows, in that frame or at rest."""
        values = iter(self.frames[frame]) if frame is not None else None
        found = []
        for parent, offset, channels in zip(self.parents, self.offsets, self.channels):
            position, own = list(offset), matrix_of()
            for channel in channels if values else ():
                number = next(values)
                if channel.endswith("position"):
                    position["XYZ".index(channel[0])] = number
                else:
                    own = product(own, turn(channel[0], number))
            own = tuple(own[r][:3] + (position[r],) for r in range(3))
            found.append(product(found[parent], own) if parent is not None else own)
        return found


def write_bvh(path, joints, end=(0, 0, 0), frames=1):
    """Joints by (name, parent or None, position), at rest in every frame. A joint called "..._end" is its parent's end
    site; joints without children end where `end` says."""
    positions = {name: position for name, _, position in joints}
    children = {}
    for name, parent, _ in joints:
        children.setdefault(parent, []).append(name)

    def lines(name, parent, pad):
        is_end = name.endswith("_end")
        offset = [a - b for a, b in zip(positions[name], positions.get(parent, (0, 0, 0)))]
        yield pad + ("End Site" if is_end else f"{'JOINT' if parent else 'ROOT'} {name}")
        yield pad + "{"
        yield pad + "  OFFSET {:.6f} {:.6f} {:.6f}".format(*offset)
        if not is_end:
            yield pad + "  CHANNELS 3 Zrotation Xrotation Yrotation"
            for child in children.get(name, []):
                yield from lines(child, name, pad + "  ")
            if name not in children:
                yield from (pad + "  End Site", pad + "  {", pad + "    OFFSET {} {} {}".format(*end), pad + "  }")
        yield pad + "}"

    channels = 3 * sum(not name.endswith("_end") for name in positions)
    text = ["HIERARCHY", *lines(children[None][0], None, ""), "MOTION", f"Frames: {frames}", "Frame Time: 0.04",
            *[" ".join(["0"] * channels)] * frames]
    with open(path, "w", encoding="utf-8") as stream:
        stream.write("\n".join(text) + "\n")
