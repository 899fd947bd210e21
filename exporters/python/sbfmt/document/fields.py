"""How the format's elements are described: `elements.py`, generated from spec/sbf.schema, consists of these."""

import struct
from collections import namedtuple

# Scalars in one item of a list or a vector.
WIDTHS = {"vec2": 2, "vec3": 3, "vec4": 4, "quat": 4, "uint2": 2, "uint4": 4}
CHILDREN = ("one", "optional", "many")


def binary32(value):
    """The number, or the tuple of numbers, that a float of the format holds."""
    numbers = value if isinstance(value, tuple) else (value, )
    rounded = struct.unpack(f"{len(numbers)}f", struct.pack(f"{len(numbers)}f", *numbers))
    return rounded if isinstance(value, tuple) else rounded[0]


FieldBase = namedtuple("FieldBase", "name type argument default required xml wrapper suffix by fixed volatile")


class Field(FieldBase):
    """One field of an element. `type` is the schema's type. `argument` is an enum's values, a child's element or a reference's
    collection. `xml` is the child's element name. `fixed` is the child's field and the value that it always has."""

    __slots__ = ()

    def __new__(cls, name, type_, argument=None, *, default=None, required=False, xml=None, wrapper=None, suffix=None, by=None,
                fixed=None, volatile=False):
        if isinstance(default, (float, tuple)):
            default = binary32(default)
        return super().__new__(cls, name, type_, argument, default, required, xml, wrapper, suffix, by, fixed, volatile)

    @property
    def is_list(self):
        """Numbers in an element of their own; `bytes` too."""
        return self.type.endswith("[]") or self.type == "bytes"

    @property
    def is_child(self):
        return self.type in CHILDREN

    @property
    def is_attribute(self):
        return not (self.is_list or self.is_child or self.type == "text")

    @property
    def typecode(self):
        """The type code of the numbers in the module `array`; None if they are not numbers."""
        item = self.type[:-2] if self.type.endswith("[]") else self.type
        if item in ("float", "vec2", "vec3", "vec4", "quat"):
            return "f"
        return {"int": "i", "uint": "I", "uint2": "I", "uint4": "I"}.get(item)

    @property
    def width(self):
        return WIDTHS.get(self.type[:-2] if self.type.endswith("[]") else self.type, 1)


class Element:
    """An element: its name, its name in XML, and its fields in order."""

    def __init__(self, name, xml, fields):
        self.name, self.xml, self.fields = name, xml, fields
        self.by_name = {field.name: field for field in fields}
