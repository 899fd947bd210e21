"""Reads spec/sbf.schema into plain objects. Errors name the line."""
import re

LISTS = {"float[]": ("f32", 1), "vec2[]": ("vec2", 2), "vec3[]": ("vec3", 3), "vec4[]": ("vec4", 4),
         "quat[]": ("quat", 4), "uint[]": ("u32", 1), "uint2[]": ("uint2", 2), "uint4[]": ("uint4", 4),
         "bytes": ("u8", 1)}
SCALARS = {"bool", "int", "uint", "float", "vec2", "vec3", "vec4", "quat", "string", "text", "id"}
CHILDREN = {"one", "optional", "many"}
WIDTH = {"float": 1, "vec2": 2, "vec3": 3, "vec4": 4, "quat": 4}


class Term:
    """One summand of a length: a count `up` elements above (-1: the root), a sum, a size, or a number."""

    def __init__(self, kind, up=0, path="", number=0):
        self.kind, self.up, self.path, self.number = kind, up, path, number


class Field:
    def __init__(self, name, type_name, argument, line):
        self.name, self.type, self.argument, self.line = name, type_name, argument, line
        self.unit = self.default = self.wrapper = self.suffix = self.by = self.xml = self.fix = None
        self.since, self.required, self.volatile = "1.0", False, False
        self.earlier = self.positive = False
        self.range, self.lengths, self.index = None, [], None
        self.meaning, self.number = "", 0

    @property
    def is_list(self):
        return self.type in LISTS

    @property
    def is_child(self):
        return self.type in CHILDREN


class Element:
    def __init__(self, name, xml, part, meaning, line):
        self.name, self.xml, self.part, self.meaning, self.line = name, xml, part, meaning, line
        self.fields, self.size = [], None

    def field(self, name):
        return next((f for f in self.fields if f.name == name), None)


class Chapter:
    """What stands together in the schema, in a C header and in the reference; `above` are the chapters it builds on."""

    def __init__(self, name, meaning):
        self.name, self.meaning = name, meaning
        self.enums, self.elements, self.above = [], [], []


class Schema:
    """Elements and enums by name, in the schema's order, and the chapters that share them out: all but the root's."""

    def __init__(self):
        self.version, self.enums, self.elements, self.chapters = None, {}, {}, []

    @property
    def root(self):
        return self.elements["asset"]


def parse_terms(text):
    terms = []
    for part in (p.strip() for p in text.split("+")):
        if re.fullmatch(r"\d+", part):
            terms.append(Term("number", number=int(part)))
            continue
        kind = "count"
        match = re.fullmatch(r"sum\((.*)\)", part)
        if match:
            kind, part = "sum", match.group(1)
        up = len(part) - len(part.lstrip("^"))
        part = part[up:]
        if part.startswith("/"):
            up, part = -1, part[1:]
        if part == "size":
            kind = "size"
        terms.append(Term(kind, up, part))
    return terms


def parse_options(field, text, where):
    for option in text.split():
        key, _, value = option.partition("=")
        if key in ("required", "volatile", "earlier", "positive") and not value:
            setattr(field, key, True)
        elif key in ("unit", "default", "wrapper", "suffix", "by", "since", "xml", "fix"):
            setattr(field, key, value)
        elif key == "range":
            match = re.fullmatch(r"([\[(])(-?[\w.]+),(-?[\w.]+)([\])])", value)
            if not match:
                raise SystemExit(f"{where}: range {value} is not of the form [a,b)")
            field.range = (float(match[2]), match[1] == "(", float(match[3]), match[4] == ")")
        elif key == "len":
            field.lengths = [parse_terms(v) for v in value.split(",")]
        elif key == "index":
            field.index = parse_terms(value)
        else:
            raise SystemExit(f"{where}: unknown option {option}")


def read(path):
    schema, element = Schema(), None
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    for number, line in enumerate(lines, 1):
        where = f"{path}:{number}"
        if not line.strip() or line.startswith("#"):
            continue
        head, _, meaning = line.partition(" -- ")
        if match := re.fullmatch(r"version (\S+)", line):
            schema.version = match[1]
        elif match := re.fullmatch(r"chapter (\w+)", head):
            schema.chapters.append(Chapter(match[1], meaning))
        elif match := re.fullmatch(r"enum (\w+): (.*)", line):
            schema.enums[match[1]] = match[2].split()
            if schema.chapters:
                schema.chapters[-1].enums.append(match[1])
        elif match := re.fullmatch(r"element (\w+)(?: xml=(\w+))?(?: part=([A-Z]{4}))?", head):
            element = Element(match[1], match[2] or match[1], match[3], meaning, number)
            schema.elements[element.name] = element
            if schema.chapters:
                schema.chapters[-1].elements.append(element)
        elif match := re.fullmatch(r"  size = (.*)", line):
            element.size = parse_terms(match[1])
        elif match := re.fullmatch(r"  (\w+)\s*: ([a-z0-9]+(?:\[\])?)(?:\((\w+)\))?( .*)?", head):
            field = Field(match[1], match[2], match[3], number)
            parse_options(field, match[4] or "", where)
            field.meaning, field.number = meaning, len(element.fields) + 1
            element.fields.append(field)
        else:
            raise SystemExit(f"{where}: not understood: {line}")
    check(schema, path)
    return schema


def check(schema, path):
    for element in schema.elements.values():
        for field in element.fields:
            where = f"{path}:{field.line}"
            known = field.type in SCALARS or field.is_list or field.is_child or field.type in ("enum", "ref")
            if not known:
                raise SystemExit(f"{where}: unknown type {field.type}")
            if field.type == "enum" and field.argument not in schema.enums:
                raise SystemExit(f"{where}: unknown enum {field.argument}")
            if field.is_child and field.argument not in schema.elements:
                raise SystemExit(f"{where}: unknown element {field.argument}")
            if field.type == "ref" and schema.root.field(field.argument) is None:
                raise SystemExit(f"{where}: the root has no collection {field.argument}")
            if not field.meaning:
                raise SystemExit(f"{where}: no meaning given")
            if field.positive and (field.type != "uint4[]" or not field.index):
                raise SystemExit(f"{where}: only a uint4 list with an index can be positive")
        check_names(schema, element, path)
    check_depth(schema, schema.root, [], path)
    check_parts(schema, path)
    check_chapters(schema, path)


def check_names(schema, element, path):
    """The XML reader tells fields apart by name alone, and keeps 64 marks of what it has seen."""
    if len(element.fields) > 64:
        raise SystemExit(f"{path}:{element.line}: more than 64 fields")
    seen = {}
    for field in element.fields:
        child = schema.elements.get(field.argument) if field.is_child else None
        name = field.wrapper or field.xml or (child.xml if child else field.name)
        kind = "element" if child or field.is_list or field.type == "text" else "attribute"
        if (kind, name) in seen:
            raise SystemExit(f"{path}:{field.line}: the {kind} {name} stands on line {seen[kind, name]} already")
        seen[kind, name] = field.line


def check_depth(schema, element, above, path):
    if element in above:
        raise SystemExit(f"{path}:{element.line}: {element.name} holds itself")
    for field in element.fields:
        if field.is_child:
            check_depth(schema, schema.elements[field.argument], above + [element], path)


def check_parts(schema, path):
    """A packed table names a part by its kind and two places, so parts lie at most two deep below the root."""
    if not schema.root.part:
        raise SystemExit(f"{path}:{schema.root.line}: the root is a part")
    depth, order = {schema.root.name: 0}, [schema.root]
    for element in order:
        for field in (f for f in element.fields if f.is_child and schema.elements[f.argument].part):
            if field.type != "many" or field.argument in depth or depth[element.name] == 2:
                raise SystemExit(f"{path}:{field.line}: a part stands once in the schema, as `many`, two deep at most")
            depth[field.argument] = depth[element.name] + 1
            order.append(schema.elements[field.argument])
    kinds = [e.part for e in schema.elements.values() if e.part]
    for element in schema.elements.values():
        if element.part and (element.name not in depth or kinds.count(element.part) > 1):
            raise SystemExit(f"{path}:{element.line}: a part lies in a part and has a kind of its own")


def check_chapters(schema, path):
    """Chapters build on those before them; finds which."""
    place = {name: chapter for chapter in schema.chapters for name in [*chapter.enums, *(e.name for e in chapter.elements)]}
    for element in schema.elements.values():
        if (element.name in place) == (element is schema.root):
            raise SystemExit(f"{path}:{element.line}: the root stands before all chapters, every other element in one")
    for name in schema.enums:
        if name not in place:
            raise SystemExit(f"{path}: the enum {name} stands in no chapter")
    for number, chapter in enumerate(schema.chapters):
        used = [(place[f.argument], f) for e in chapter.elements for f in e.fields if f.is_child or f.type == "enum"]
        for other, field in used:
            if other not in schema.chapters[:number + 1]:
                raise SystemExit(f"{path}:{field.line}: {field.argument} belongs to a later chapter, {other.name}")
        chapter.above = [one for one in schema.chapters[:number] if one in (other for other, _ in used)]


def ordered(schema):
    """Elements with those they hold before them."""
    done, order = set(), []

    def visit(element):
        if element.name in done:
            return
        done.add(element.name)
        for field in element.fields:
            if field.is_child:
                visit(schema.elements[field.argument])
        order.append(element)

    visit(schema.root)
    unused = set(schema.elements) - done
    if unused:
        raise SystemExit(f"elements that nothing holds: {', '.join(sorted(unused))}")
    return order
