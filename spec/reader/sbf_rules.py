"""What holds of every asset, in whichever form it came: section 3 of sbf.md."""

import math
import struct

from sbf_elements import ELEMENTS, ROOT, Fault

SIZES = {"polygon_mesh": ["positions"], "render_mesh": ["mesh.positions"],
         "soft_body": ["surface.positions", "interior"], "level": ["positions"]}
KNOWN_EXTENSIONS = ()


def nearest(bound):
    return bound if math.isinf(bound) else struct.unpack("<f", struct.pack("<f", bound))[0]


class Rules:
    """Walks an asset once and refuses what the section forbids."""

    def __init__(self, root):
        self.root, self.ids, self.collections = root, set(), {}
        for field in ROOT.fields:
            if field.kind == "many" and "id" in ELEMENTS[field.argument].by_name:
                self.collections[field.name] = {child["id"] for child in root[field.name]}

    def check(self):
        self.object(self.root, "")
        seen = set()
        for bone in self.root["bones"]:
            if bone["parent"] is not None and bone["parent"] not in seen:
                raise Fault(f"bone {bone['id']}: its parent {bone['parent']} does not stand before it")
            seen.add(bone["id"])
        for extension in self.root["extensions"]:
            if extension["required"] and extension["name"] not in KNOWN_EXTENSIONS:
                raise Fault(f"the extension {extension['name']} is required and not known")

    def object(self, target, path):
        for field in target.element.fields:
            value, where = target[field.name], f"{path}/{field.name}"
            if field.kind in ("string", "text", "id"):
                self.text(field, value, where)
            elif field.kind == "ref":
                if value is not None and value not in self.collections[field.argument]:
                    raise Fault(f"{where}: there is no {field.argument} '{value}'")
                if value is None and field.required:
                    raise Fault(f"{where} refers to nothing")
            elif field.is_child:
                for place, child in enumerate(value if isinstance(value, list) else [value] if value else []):
                    if field.fixed and child[field.fixed[0]] != field.fixed[1]:
                        raise Fault(f"{where}: {field.fixed[0]} must be {field.fixed[1]}")
                    self.object(child, f"{where}[{place + 1}]" if field.kind == "many" else where)
            elif field.kind not in ("bool", "enum", "bytes"):
                numbers = value if isinstance(value, list) else [value]
                self.numbers(field, numbers, where)
                if field.is_list:
                    self.list(target, field, numbers, where)

    def text(self, field, value, where):
        for character in value:
            if character < " " and character not in "\t\n\r" or character in "\ufffe\uffff" or \
                    "\ud800" <= character <= "\udfff":
                raise Fault(f"{where} has the character U+{ord(character):04X}")
        if field.kind == "id":
            if not value:
                raise Fault(f"{where} is empty")
            if value in self.ids:
                raise Fault(f"{where}: the id {value} is there twice")
            self.ids.add(value)

    @staticmethod
    def numbers(field, numbers, where):
        if field.scalar == "float" and not all(map(math.isfinite, numbers)):
            raise Fault(f"{where} is not finite")
        if field.range and numbers:
            low, high, low_open, high_open = field.range
            low, high, least, most = nearest(low), nearest(high), min(numbers), max(numbers)
            if least < low or (low_open and least == low) or most > high or (high_open and most == high):
                raise Fault(f"{where} is out of its range")

    def list(self, target, field, numbers, where):
        count = len(numbers) // field.width
        if field.lengths and not any(count == self.count(target, text) for text in field.lengths):
            raise Fault(f"{where} has {count} items, not {' or '.join(field.lengths)}")
        if field.below and numbers and max(numbers) >= self.count(target, field.below):
            raise Fault(f"{where} names an item of {field.below} that is not there")
        if target.element.name == "tetrahedron_mesh" and field.name == "tetrahedra":
            self.orientation(target.parent["positions"], numbers, where)

    def count(self, target, text):
        """What a length says, seen from the object that has the list."""
        if text.isdigit():
            return int(text)
        if text.startswith("sum("):
            return sum(target[text[4:-1]])
        if text.startswith("parent."):
            return self.count(target.parent, text[len("parent."):])
        if text.startswith("asset."):
            return self.count(self.root, text[len("asset."):])
        if text == "size":
            return sum(self.count(target, part) for part in SIZES[target.element.name])
        name, _, rest = text.partition(".")
        if rest:
            return self.count(target[name], rest)
        field = target.element.by_name[name]
        return len(target[name]) // (1 if field.kind == "many" else field.width)

    @staticmethod
    def orientation(positions, tetrahedra, where):
        for place in range(0, len(tetrahedra), 4):
            a, b, c, d = (positions[3 * p:3 * p + 3] for p in tetrahedra[place:place + 4])
            u, v, w = ([p[i] - a[i] for i in range(3)] for p in (b, c, d))
            if not (u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                    u[2] * (v[0] * w[1] - v[1] * w[0])) > 0:
                raise Fault(f"{where} item {place // 4} is flat or inverted")


def check(root):
    Rules(root).check()
