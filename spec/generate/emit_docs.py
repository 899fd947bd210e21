"""Reference tables and the XML Schema from the schema."""
from emit_c import length_text, range_text
from schema import LISTS

XSD_SCALARS = {"bool": "xs:boolean", "int": "xs:int", "uint": "xs:unsignedInt", "float": "float",
               "vec2": "floats", "vec3": "floats", "vec4": "floats", "quat": "floats",
               "string": "xs:string", "text": "xs:string", "id": "id", "ref": "id"}


def since(field):
    return "" if field.since == "1.0" else f" Since {field.since}."


def type_text(f):
    return f"{f.type}({f.argument})" if f.argument else f.type


def written_as(f, schema):
    if f.is_child:
        name = f"*{f.by}*`{f.suffix}`" if f.suffix else f"`<{f.xml or schema.elements[f.argument].xml}>`"
        return (f"`<{f.wrapper}>` " if f.wrapper else "") + name
    return f"`<{f.name}>`" if f.is_list or f.type == "text" else f"`{f.name}=`"


def reference(schema):
    out = ["# Reference of the sbf format, version " + schema.version + "\n\n"
           "Made from `sbf.schema` by `generate/generate.py`: change the schema, not this page. What the parts mean\n"
           "and how they act is in [sbf.md](sbf.md).\n\n"
           "Scalars are attributes, lists are elements with numbers separated by white space, children are elements.\n"
           "What equals its default is left out. A reference is the `id` of an object of the named collection.\n\n"
           "## Words\n\n| enumeration | values, numbered from 0 |\n|---|---|\n"]
    out += [f"| `{name}` | {', '.join(values)} |\n" for name, values in schema.enums.items()]
    first = {chapter.elements[0].name: chapter for chapter in schema.chapters}
    for element in schema.elements.values():
        part = f" A part of kind `{element.part}` in the packed form." if element.part else ""
        if element.name in first:
            chapter = first[element.name]
            out.append(f"\n## Chapter: {chapter.name.replace('_', ' ')}\n\n{chapter.meaning} In C: `sbfmt/model_{chapter.name}.h`.\n")
        out.append(f"\n{'##' if element is schema.root else '###'} {element.name}\n\n`<{element.xml}>`: {element.meaning}{part}\n\n"
                   "| nr | field | written as | type | unit | default | range | length | indexes | meaning |\n"
                   "|---|---|---|---|---|---|---|---|---|---|\n")
        for f in element.fields:
            default = "required" if f.required else (f.default or ("0,0,0,1" if f.type == "quat" else ""))
            if f.fix:
                default = "always `{}`: {}".format(*f.fix.split(":"))
            out.append(f"| {f.number} | {f.name} | {written_as(f, schema)} | {type_text(f)} | {f.unit or ''} | "
                       f"{default} | {range_text(f)} | {' or '.join(length_text(l) for l in f.lengths)} | "
                       f"{length_text(f.index) if f.index else ''} | {f.meaning}{since(f)} |\n")
    return "".join(out)


def escape(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")


def simple(f):
    if f.type == "enum":
        return f.argument
    if f.type == "bytes":
        return "xs:base64Binary"
    if f.is_list:
        return "floats" if LISTS[f.type][0] in ("f32", "vec2", "vec3", "vec4", "quat") else "uints"
    return XSD_SCALARS[f.type]


def child_xsd(f, schema, indent):
    child = schema.elements[f.argument]
    bounds = ' minOccurs="0"' + (' maxOccurs="unbounded"' if f.type == "many" else "")
    if f.suffix:
        names = [v + f.suffix for v in schema.enums[child.field(f.by).argument]]
        rows = "".join(f'{indent}  <xs:element name="{n}" type="{child.name}"/>\n' for n in names)
        inner = f'{indent}<xs:choice{bounds}>\n{rows}{indent}</xs:choice>\n'
    else:
        inner = f'{indent}<xs:element name="{f.xml or child.xml}" type="{child.name}"{bounds}/>\n'
    if not f.wrapper:
        return inner
    inner = "".join("      " + line + "\n" for line in inner.rstrip("\n").split("\n"))
    return (f'{indent}<xs:element name="{f.wrapper}" minOccurs="0">\n{indent}  <xs:complexType>\n'
            f'{indent}    <xs:sequence>\n{inner}{indent}    </xs:sequence>\n{indent}  </xs:complexType>\n'
            f'{indent}</xs:element>\n')


def xsd(schema):
    out = ['<?xml version="1.0" encoding="UTF-8"?>\n'
           '<!-- Made from sbf.schema by generate/generate.py: change the schema, not this file.\n'
           '     It states the structure; lengths, ranges, references and meaning are checked by sbfmt validate. -->\n'
           f'<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" version="{schema.version}">\n'
           '  <xs:simpleType name="float"><xs:restriction base="xs:float">'
           '<xs:pattern value="[-+]?[0-9.]+([eE][-+]?[0-9]+)?"/></xs:restriction></xs:simpleType>\n'
           '  <xs:simpleType name="id"><xs:restriction base="xs:string"><xs:minLength value="1"/>'
           '</xs:restriction></xs:simpleType>\n'
           '  <xs:simpleType name="floats"><xs:list itemType="float"/></xs:simpleType>\n'
           '  <xs:simpleType name="uints"><xs:list itemType="xs:unsignedInt"/></xs:simpleType>\n']
    for name, values in schema.enums.items():
        rows = "".join(f'<xs:enumeration value="{v}"/>' for v in values)
        out.append(f'  <xs:simpleType name="{name}"><xs:restriction base="xs:string">{rows}'
                   '</xs:restriction></xs:simpleType>\n')
    named_by = {(f.argument, f.by) for e in schema.elements.values() for f in e.fields if f.by}
    for element in schema.elements.values():
        out.append(f'  <xs:complexType name="{element.name}">\n    <xs:annotation><xs:documentation>'
                   f'{escape(element.meaning)}</xs:documentation></xs:annotation>\n    <xs:sequence>\n')
        for f in element.fields:
            if f.is_child:
                out.append(child_xsd(f, schema, "      "))
            elif f.is_list or f.type == "text":
                out.append(f'      <xs:element name="{f.name}" type="{simple(f)}" minOccurs="0"/>\n')
        out.append("    </xs:sequence>\n")
        for f in element.fields:
            if f.is_child or f.is_list or f.type == "text" or (element.name, f.name) in named_by:
                continue
            use = ' use="required"' if f.required else ""
            out.append(f'    <xs:attribute name="{f.name}" type="{simple(f)}"{use}/>\n')
        out.append("  </xs:complexType>\n")
    out.append(f'  <xs:element name="{schema.root.xml}" type="{schema.root.name}"/>\n</xs:schema>\n')
    return "".join(out)
