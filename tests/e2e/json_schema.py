"""Implements the part of JSON Schema that spec/*.schema.json and Khronos's extensions use; reports an error for unknown keywords."""

import re

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int, "number": (int, float), "null": type(None)}
NOTES = {"$schema", "$id", "$defs", "title", "description", "default", "gltf_detailedDescription"}
CORE = {"glTFid.schema.json": {"type": "integer", "minimum": 0}, "glTFProperty.schema.json": {},
        "glTFChildOfRootProperty.schema.json": {}}  # of glTF 2.0 itself
OF_OBJECTS, OF_ARRAYS = {"required", "properties", "additionalProperties", "dependencies"}, {"items", "minItems", "maxItems", "uniqueItems"}


def is_of_type(value, name):
    if isinstance(name, list):
        return any(is_of_type(value, one) for one in name)
    return isinstance(value, TYPES[name]) and not (name in ("integer", "number") and isinstance(value, bool))


def resolve(root, reference):
    node = root
    for step in reference.lstrip("#/").split("/"):
        node = node[step]
    return node


def faults(value, schema, root=None, path="$", files=None):
    """What in the value breaks the schema, as texts. `files` are other schemas by their names."""
    root = root or schema
    found = []

    def inner(item, rule, where=path):
        return faults(item, rule, root, where, files)

    for word, rule in schema.items():
        if word in NOTES or word in OF_OBJECTS and not isinstance(value, dict) or word in OF_ARRAYS and not isinstance(value, list):
            continue  # of no effect on this value
        if word == "$ref" and files and not rule.startswith("#"):
            named = {**CORE, **files}[rule]
            found += faults(value, named, named, path, files)
        elif word == "$ref":
            found += inner(value, resolve(root, rule))
        elif word == "type":
            found += [] if is_of_type(value, rule) else [f"{path} is no {rule}"]
        elif word == "enum":
            found += [] if value in rule else [f"{path} is none of {rule}"]
        elif word == "const":
            found += [] if value == rule else [f"{path} is not {rule}"]
        elif word == "pattern":
            found += [] if re.search(rule, value) else [f"{path} does not match {rule}"]
        elif word == "minimum":
            found += [] if value >= rule else [f"{path} is below {rule}"]
        elif word == "exclusiveMinimum":
            found += [] if value > rule else [f"{path} is not above {rule}"]
        elif word == "maximum":
            found += [] if value <= rule else [f"{path} is above {rule}"]
        elif word == "allOf":
            for one in rule:
                found += inner(value, one)
        elif word in ("anyOf", "oneOf"):
            fits = sum(not inner(value, one) for one in rule)
            found += [] if fits == 1 or fits and word == "anyOf" else [f"{path} fits {fits} of {word}"]
        elif word == "not":
            found += [] if inner(value, rule) else [f"{path} fits what it must not"]
        elif word == "required":
            found += [f"{path} lacks {key}" for key in rule if key not in value]
        elif word == "dependencies":
            found += [f"{path} has {key} without {other}" for key in rule.keys() & value.keys() for other in rule[key] if other not in value]
        elif word == "properties":
            for key in rule.keys() & value.keys():
                found += inner(value[key], rule[key], f"{path}.{key}")
        elif word == "additionalProperties" and rule is False:
            found += [f"{path} has {key} as well" for key in value if key not in schema["properties"]]
        elif word == "items":
            for i, item in enumerate(value):
                found += inner(item, rule, f"{path}[{i}]")
        elif word in ("minItems", "maxItems"):
            found += [] if (len(value) >= rule if word == "minItems" else len(value) <= rule) else [f"{path} has {len(value)} items"]
        elif word == "uniqueItems":
            found += [] if len(set(map(str, value))) == len(value) else [f"{path} repeats an item"]
        else:
            raise ValueError(f"the checker does not know {word}")
    return found
