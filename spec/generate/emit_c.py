"""C from the schema: the structs of sbfmt/model.h, a header a chapter, and the tables behind model/schema.h."""
from schema import LISTS, WIDTH, ordered

C_SCALARS = {"bool": "bool", "int": "int32_t", "uint": "uint32_t", "float": "float", "vec2": "sbf_vec2",
             "vec3": "sbf_vec3", "vec4": "sbf_vec4", "quat": "sbf_quat", "string": "const char *",
             "text": "const char *", "id": "const char *", "ref": "int32_t"}
SOURCE = "Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file."
NOTE = f"/* {SOURCE} */\n"


def c_type(field):
    if field.is_list:
        return f"sbf_{LISTS[field.type][0]}_list"
    if field.type in ("enum", "one"):
        return f"sbf_{field.argument}"
    if field.type == "optional":
        return f"const sbf_{field.argument} *"
    if field.type == "many":
        return f"sbf_{field.argument}_list"
    return C_SCALARS[field.type]


GLUE = "\u00a0"  # holds words together in a comment


def bound_text(value):
    return ("-" if value < 0 else "") + "inf" if abs(value) == float("inf") else f"{value:g}"


def range_text(field):
    if not field.range:
        return ""
    low, low_open, high, high_open = field.range
    return ("(" if low_open else "[") + f"{bound_text(low)}, {bound_text(high)}" + (")" if high_open else "]")


def shape(field):
    """What stands in brackets behind a meaning: unit, range, default, length, index."""
    notes = [field.unit, range_text(field), field.default and f"default {field.default}"]
    if field.lengths:
        notes.append("length " + " or ".join(length_text(l) for l in field.lengths))
    if field.index:
        notes.append("index into " + length_text(field.index))
    if field.type == "ref":
        notes.append(f"index into asset.{field.argument}, or SBF_NONE")
    notes = [n for n in notes if n]
    return f" [{'; '.join(notes)}]".replace(" ", GLUE).replace(GLUE, " ", 1) if notes else ""


def length_text(terms):
    texts = []
    for t in terms:
        if t.kind == "number":
            texts.append(str(t.number))
            continue
        place = {0: "", -1: "asset."}.get(t.up, "parent." * t.up) + t.path
        texts.append(f"sum({place})" if t.kind == "sum" else place)
    return " + ".join(texts)


def wrap(text, begin="", width=120):
    """A comment behind `begin`, its further lines below its first. An empty line in the text stays one; what stands
    in brackets behind it stays together."""
    lines, line, rest = [], begin + "/*", " " * len(begin) + " *"
    for number, paragraph in enumerate((text + GLUE + "*/").split("\n\n")):
        if number:
            lines += [line, rest]
            line = rest
        for word in paragraph.split(" "):
            for part in [word] if len(rest) + len(word) < width else word.split(GLUE):
                if len(line) + len(part) + 1 > width:
                    lines.append(line)
                    line = rest
                line += " " + part
    return "\n".join(lines + [line]).replace(GLUE, " ") + "\n"


def enum_type(name, values):
    return (f"/* Values of {name}; sbf_{name}_name returns their names in files. */\ntypedef enum sbf_{name} {{\n"
            + "".join(f"  SBF_{name.upper()}_{v.upper()} = {i},\n" for i, v in enumerate(values))
            + f"  SBF_{name.upper()}_COUNT = {len(values)}\n}} sbf_{name};\n\n")


def struct(element, is_root=False):
    kinds = [c_type(field) for field in element.fields]
    declared = [f"  {kind}{'' if kind.endswith('*') else ' '}{field.name};" for kind, field in zip(kinds, element.fields)]
    column = max(map(len, declared)) + 2
    out = [wrap(element.meaning), f"typedef struct sbf_{element.name} {{\n"]
    out += [wrap(field.meaning + shape(field), line.ljust(column)) for line, field in zip(declared, element.fields)]
    out.append(f"}} sbf_{element.name};\n")
    if not is_root:
        out.append(f"typedef struct sbf_{element.name}_list {{ const sbf_{element.name} *at; uint32_t count; }} "
                   f"sbf_{element.name}_list;\n")
    return "".join(out) + "\n"


def calls(elements, enums):
    out = ["/* Sets every field to its default, lists to empty, references to SBF_NONE. */\n"]
    out += [f"SBF_API void sbf_{element.name}_init(sbf_{element.name} *{element.name});\n" for element in elements]
    if enums:
        out.append("\n/* The name of a value in files, or \"?\" if it is out of range. */\n")
    out += [f"SBF_API const char *sbf_{name}_name(sbf_{name} value);\n" for name in enums]
    return "".join(out)


def header(name, opening, includes, body):
    guard = f"SBFMT_{name.upper()}_H"
    return (wrap(opening + "\n\n" + SOURCE) + f"#ifndef {guard}\n#define {guard}\n\n"
            + "".join(f'#include "sbfmt/{include}.h"\n' for include in includes)
            + f'\n#ifdef __cplusplus\nextern "C" {{\n#endif\n\n// clang-format off\n\n{body}'
            "\n// clang-format on\n\n#ifdef __cplusplus\n}\n#endif\n#endif\n")


def chapter_header(schema, chapter):
    elements = [element for element in ordered(schema) if element in chapter.elements]
    body = [enum_type(name, schema.enums[name]) for name in chapter.enums] + [struct(element) for element in elements]
    return header("model_" + chapter.name, chapter.meaning + " Part of sbfmt/model.h, which documents the common conventions.",
                  [f"model_{above.name}" for above in chapter.above] or ["base"],
                  "".join(body) + calls(elements, chapter.enums))


MODEL = ("The asset: plain read-only data, as the format defines it, with a header for each chapter.\n\n"
         "Units are SI: metres, kilograms, seconds, newtons, pascals, radians. Right-handed, +Y up, +Z forward; all "
         "positions are in asset space and in the rest pose unless stated otherwise. A loaded asset owns everything it "
         "points to, and any number of threads may read it at once. Strings are UTF-8 and "
         "never NULL. References are indices into a list of the asset, or SBF_NONE. Square brackets give unit, range, "
         "default, and the length of a list.")


def model_headers(schema):
    """Name below sbfmt/ -> text: a header for each chapter, and model.h, which includes them and holds the root."""
    headers = {f"model_{chapter.name}.h": chapter_header(schema, chapter) for chapter in schema.chapters}
    version = f"/* Version of the format that this library writes. */\n#define SBF_FORMAT_VERSION \"{schema.version}\"\n\n"
    headers["model.h"] = header("model", MODEL, [f"model_{chapter.name}" for chapter in schema.chapters],
                                version + struct(schema.root, is_root=True) + calls([schema.root], []))
    return headers


def c_string(text):
    return "NULL" if text is None else '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


class Tables:
    def __init__(self, schema):
        self.schema, self.parents = schema, {}
        for element in schema.elements.values():
            for field in element.fields:
                if field.is_child:
                    self.parents.setdefault(field.argument, []).append(element)

    def owner(self, element, up):
        """The element `up` above: where there are several, a path is only used if all have it alike."""
        if up == -1:
            return self.schema.root
        for _ in range(up):
            element = self.parents[element.name][0]
        return element

    def length(self, element, terms):
        parts = []
        for t in terms:
            if t.kind == "number":
                value = str(t.number)
            elif t.kind == "size":
                value = "0"
            else:
                value = f"offsetof(sbf_{self.owner(element, t.up).name}, {t.path})"
            parts.append(f"{{SBFI_TERM_{t.kind.upper()}, {t.up}, {value}}}")
        return f"{{{len(parts)}, {{{', '.join(parts)}}}, {c_string(length_text(terms))}}}"

    def emit(self):
        schema = self.schema
        out = ["// clang-format off\n", NOTE,
               '#include <math.h>\n\n#include "model/schema.h"\n#include "sbfmt/model.h"\n\n']
        for name, values in schema.enums.items():
            out.append(f"static const char *const {name}_values[] = "
                       f"{{{', '.join(c_string(v) for v in values)}}};\n")
        out.append("\n")
        for element in ordered(schema):
            out += self.element(element)
        for element in ordered(schema):
            out.append(f"void sbf_{element.name}_init(sbf_{element.name} *{element.name}) {{ "
                       f"sbfi_element_init(&{self.table(element)}, {element.name}); }}\n")
        for name, values in schema.enums.items():
            out.append(f"\nconst char *sbf_{name}_name(sbf_{name} value) {{\n"
                       f"  return (unsigned)value < {len(values)}u ? {name}_values[value] : \"?\";\n}}\n")
        return "".join(out)

    def table(self, element):
        return "sbfi_asset_element" if element is self.schema.root else f"{element.name}_element"

    def element(self, element):
        out = []
        for field in element.fields:
            if field.lengths:
                rows = ", ".join(self.length(element, l) for l in field.lengths)
                out.append(f"static const sbfi_length {element.name}_{field.name}_lengths[] = {{{rows}}};\n")
            if field.index:
                out.append(f"static const sbfi_length {element.name}_{field.name}_index = "
                           f"{self.length(element, field.index)};\n")
        if element.size:
            out.append(f"static const sbfi_length {element.name}_size = {self.length(element, element.size)};\n")
        out.append(f"static const sbfi_field {element.name}_fields[] = {{\n")
        out += [self.field(element, f) for f in element.fields]
        out.append("};\n")
        static = "" if element is self.schema.root else "static "
        kind = f"SBFI_KIND({', '.join(repr(c) for c in element.part)})" if element.part else "0"
        size = f"&{element.name}_size" if element.size else "NULL"
        out.append(f"{static}const sbfi_element {self.table(element)} = {{{c_string(element.name)}, "
                   f"{c_string(element.xml)}, sizeof(sbf_{element.name}), {kind}, "
                   f"{len(element.fields)}, {element.name}_fields, {size}}};\n\n")
        return out

    def field(self, element, f):
        schema, kind, width = self.schema, f.type.upper(), WIDTH.get(f.type, 1)
        row = []
        if f.is_list:
            kind, (item, width) = "LIST", LISTS[f.type]
            base = {"u8": "U8", "u32": "U32", "uint2": "U32", "uint4": "U32"}.get(item, "F32")
            row.append(f".item = SBFI_ITEM_{base}")
        row = [f".name = {c_string(f.name)}", f".type = SBFI_{kind}", f".number = {f.number}",
               f".since_minor = {f.since.split('.')[1]}", f".offset = offsetof(sbf_{element.name}, {f.name})",
               f".width = {width}", f".unit = {c_string(f.unit or '')}"] + row
        if f.required:
            row.append(".required = true")
        if f.volatile:
            row.append(".volatile_ = true")
        if f.earlier:
            row.append(".earlier = true")
        if f.positive:
            row.append(".positive = true")
        if f.range:
            low, low_open, high, high_open = f.range
            number = lambda v: ("-" if v < 0 else "") + "INFINITY" if abs(v) == float("inf") else repr(v)
            row.append(f".range.is_stated = true, .range.min = {number(low)}, .range.max = {number(high)}, "
                       f".range.min_open = {str(low_open).lower()}, .range.max_open = {str(high_open).lower()}")
        row += self.defaults(f)
        if f.type == "enum":
            row.append(f".words.at = {f.argument}_values, .words.count = {len(schema.enums[f.argument])}")
        if f.type == "ref":
            row.append(f".reference.offset = offsetof(sbf_asset, {f.argument}), .reference.name = {c_string(f.argument)}")
        if f.is_child:
            child = schema.elements[f.argument]
            row.append(f".element = &{self.table(child)}, .tag.xml = {c_string(f.xml or child.xml)}")
            row += [f".tag.{key} = {c_string(getattr(f, key))}" for key in ("wrapper", "suffix", "by")
                    if getattr(f, key)]
            if f.fix:
                name, value = f.fix.split(":")
                place = schema.enums[child.field(name).argument].index(value)
                row.append(f".fixed.name = {c_string(name)}, .fixed.value = {place}")
        if f.lengths:
            row.append(f".length_count = {len(f.lengths)}, .lengths = {element.name}_{f.name}_lengths")
        if f.index:
            row.append(f".index = &{element.name}_{f.name}_index")
        return "  {" + ", ".join(row) + "},\n"

    def defaults(self, f):
        if f.type == "quat":
            return [".initial.scalars = {0, 0, 0, 1}"]
        if f.default is None:
            return ['.initial.text = ""'] if f.type in ("string", "text", "id") else []
        if f.type in WIDTH:
            return [".initial.scalars = {" + ", ".join(f"{float(v)!r}f" for v in f.default.split(",")) + "}"]
        if f.type == "bool":
            return [f".initial.integer = {int(f.default == 'true')}"]
        if f.type == "enum":
            return [f".initial.integer = {self.schema.enums[f.argument].index(f.default)}"]
        if f.type in ("int", "uint"):
            return [f".initial.integer = {f.default}u"]
        return [f".initial.text = {c_string(f.default)}"]


def tables(schema):
    return Tables(schema).emit()
