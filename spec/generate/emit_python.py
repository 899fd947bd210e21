"""The schema for Python: exporters/python/sbfmt/document/elements.py."""
import schema as schema_reader

HEAD = '''"""Every element and field of the format. Generated from spec/sbf.schema by spec/generate/generate.py; do not edit."""

from .fields import Element, Field

VERSION = "{version}"

ENUMS = {{
{enums}
}}

ELEMENTS = {{element.name: element for element in (
{elements}
)}}
'''


def value(field, schema):
    """The default of an attribute, as Python has it; vectors and numbers without one are zero, a turn is none at all."""
    text, width = field.default, schema_reader.WIDTH.get(field.type, 1)
    if field.type in ("string", "id", "text"):
        return repr(text or "")
    if field.type == "enum":
        return repr(text or schema.enums[field.argument][0])
    if field.type == "bool":
        return str(text == "true")
    if field.type in ("int", "uint"):
        return str(int(text or 0))
    if field.type in schema_reader.WIDTH:
        numbers = [float(n) for n in text.split(",")] if text else [0.0] * width
        if field.type == "quat" and not text:
            numbers[3] = 1.0
        return repr(tuple(numbers) if width > 1 else numbers[0])
    return None


def line(field, schema):
    words = [repr(field.name), repr(field.type)] + ([repr(field.argument)] if field.argument else [])
    default = value(field, schema)
    child = schema.elements.get(field.argument) if field.is_child else None
    fixed = None
    if field.fix:
        name, text = field.fix.split(":")
        fixed = repr((name, text))
    xml = field.xml or (child.xml if child and not field.suffix else None)
    for key, text in (("default", default), ("required", "True" if field.required else None), ("xml", repr(xml) if xml else None),
                      ("wrapper", repr(field.wrapper) if field.wrapper else None),
                      ("suffix", repr(field.suffix) if field.suffix else None), ("by", repr(field.by) if field.by else None),
                      ("fixed", fixed), ("volatile", "True" if field.volatile else None)):
        if text is not None:
            words.append(f"{key}={text}")
    return f"        Field({', '.join(words)}),"


def elements(schema):
    enums = "\n".join(f"    {name!r}: {tuple(words)!r}," for name, words in schema.enums.items())
    blocks = []
    for element in schema.elements.values():
        fields = "\n".join(line(field, schema) for field in element.fields)
        blocks.append(f"    Element({element.name!r}, {element.xml!r}, (\n{fields}\n    )),")
    return HEAD.format(version=schema.version, enums=enums, elements="\n".join(blocks))
