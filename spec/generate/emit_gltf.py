"""JSON Schema of the glTF extension SBF_soft_body: spec/gltf/SBF_soft_body/schema/SBF_soft_body.schema.json."""
import json

import schema as schema_reader

NUMBERS = {"float": "number", "int": "integer", "uint": "integer", "ref": "integer"}
LIST = {
    "description": "A list: an array of its scalars, or where they are.",
    "type": ["array", "object"],
    "items": {"type": "number"},
    "additionalProperties": False,
    "properties": {
        "count": {"type": "integer", "minimum": 0, "description": "Number of items."},
        "bufferView": {"type": "integer", "minimum": 0, "description": "Buffer view of the scalars, little-endian; compressed if `codec` says so."},
        "filter": {"enum": ["planes", "delta", "recent"], "description": "Filter applied before the codec, as in the packed form."},
        "codec": {"enum": ["zlib"], "description": "Compression of the buffer view."},
        "gltf": {"enum": [True], "description": "The list is computed from the glTF file."},
        "correction": {"$ref": "#/$defs/list", "description": "Zigzag differences of the scalars' bits to those computed."},
    },
}


def value(field, schema):
    if field.is_list:
        return {"$ref": "#/$defs/list"}
    if field.is_child:
        child = {"$ref": f"#/$defs/{field.argument}"}
        return {"type": "array", "items": child} if field.type == "many" else child
    if field.type == "enum":
        return {"enum": list(schema.enums[field.argument])}
    if field.type == "bool":
        return {"type": "boolean"}
    if field.type in NUMBERS:
        return {"type": NUMBERS[field.type], **({"minimum": 0} if field.type in ("uint", "ref") else {})}
    width = schema_reader.WIDTH.get(field.type)
    return {"type": "array", "items": {"type": "number"}} if width else {"type": "string"}


def properties(element, schema):
    found = {field.name: {**value(field, schema), "description": field.meaning} for field in element.fields}
    found["gltf"] = {"type": "object", "description": "Where the object is in the glTF file."}
    found["extras"] = {"description": "Anything."}
    return {"type": "object", "description": element.meaning, "additionalProperties": False,
            "required": [field.name for field in element.fields if field.required], "properties": found}


def extension(schema):
    definitions = {element.name: properties(element, schema) for element in schema.elements.values() if element is not schema.root}
    whole = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "SBF_soft_body glTF document extension",
             **properties(schema.root, schema), "$defs": {"list": LIST, **definitions}}
    return json.dumps(whole, indent=1) + "\n"
