"""Objects of the format in plain Python: `Record("bone", id="hip", head=(0, 1, 0))`."""

from array import array

from .elements import ELEMENTS, ENUMS
from .fields import binary32


class Record:
    """One object. Its fields are attributes. A field that was never set has the schema's default; lists and children start empty.

    A reference is the id of its target. A list is one flat `array` of numbers for any width of its items. It may be set from any
    sequence, including nested ones and numpy arrays. A `many` is a Python list of records; a `one` always exists."""

    __slots__ = ("_element", "_values")

    def __init__(self, element_name, /, **values):
        object.__setattr__(self, "_element", ELEMENTS[element_name])
        object.__setattr__(self, "_values", {})
        for name, value in values.items():
            setattr(self, name, value)

    @property
    def element(self):
        """Its description, an `Element`."""
        return self._element

    def field(self, name):
        try:
            return self._element.by_name[name]
        except KeyError:
            raise AttributeError(f"a {self._element.name} has no {name}") from None

    def __getattr__(self, name):
        field = self.field(name)
        if name not in self._values:
            if not (field.is_list or field.type in ("one", "many")):
                return field.default
            self._values[name] = self.empty(field)
        return self._values[name]

    def __setattr__(self, name, value):
        field = self.field(name)
        if field.is_list:
            value = flat(value, field)
        elif field.type == "enum" and value not in ENUMS[field.argument]:
            raise ValueError(f"{self._element.name}.{name} is one of {', '.join(ENUMS[field.argument])}, not {value!r}")
        elif field.is_attribute and field.width > 1:
            value = tuple(float(number) for number in value)
            if len(value) != field.width:
                raise ValueError(f"{self._element.name}.{name} takes {field.width} numbers, not {len(value)}")
            value = binary32(value)
        elif field.type == "float":
            value = binary32(float(value))
        self._values[name] = value

    def __delattr__(self, name):
        self._values.pop(self.field(name).name, None)

    def __repr__(self):
        named = self._values.get("id") or self._values.get("name") or ""
        return f"<{self._element.name} {named}>"

    def __eq__(self, other):
        """Whether both are equal; a field that is left out equals its default."""
        if not isinstance(other, Record) or other._element is not self._element:
            return NotImplemented
        return all(getattr(self, field.name) == getattr(other, field.name) for field in self._element.fields)

    __hash__ = None

    @staticmethod
    def empty(field):
        if field.type == "many":
            return []
        if field.type == "one":
            return Record(field.argument, **dict([field.fixed] if field.fixed else []))
        return b"" if field.type == "bytes" else array(field.typecode)

    def add(self, name, /, **values):
        """Adds a new record at the end of a `many`, or sets an `optional`."""
        field = self.field(name)
        child = Record(field.argument, **values)
        if field.type == "many":
            getattr(self, name).append(child)
        else:
            self._values[name] = child
        return child

    def put(self, name, value):
        """Copies a field of any kind from another record of the same element."""
        self._values[self.field(name).name] = value

    def find(self, name, identity):
        """The record of a `many` that has this id, or None."""
        return next((one for one in getattr(self, name) if one.id == identity), None)


def flat(value, field):
    """One flat array of the field's numbers."""
    if field.type == "bytes":
        return bytes(value)
    if isinstance(value, array) and value.typecode == field.typecode:
        return value
    if hasattr(value, "astype"):  # numpy arrays, without importing numpy
        numbers = array(field.typecode)
        numbers.frombytes(value.astype({"f": "f4", "i": "i4", "I": "u4"}[field.typecode]).tobytes())
    else:
        value = list(value)
        if value and hasattr(value[0], "__len__"):
            value = [number for item in value for number in item]
        numbers = array(field.typecode, value)
    if len(numbers) % field.width:
        raise ValueError(f"{field.name}: {len(numbers)} numbers are not a multiple of {field.width}")
    return numbers
