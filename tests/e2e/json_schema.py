"""As much of JSON Schema as spec/*.schema.json use, and an error for every word of it that is not known here."""

import re

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int, "number": (int, float), "null": type(None)}
NOTES = {"$schema", "$id", "$defs", "title", "description"}


def is_of_type(value, name):
    if isinstance(name, list):
        return any(is_of_type(value, one) for one in name)
    return isinstance(value, TYPES[name]) and not (name in ("integer", "number") and isinstance(value, bool))


def resolve(root, reference):
    node = root
    for step in reference.lstrip("#/").split("/"):
        node = node[step]
    return node


def faults(value, schema, root=None, path="$"):
    """What in the value breaks the schema, as texts."""
    root = root or schema
    found = []
    for word, rule in schema.items():
        if word in NOTES:
            continue
        if word == "$ref":
            found += faults(value, resolve(root, rule), root, path)
        elif word == "type":
            found += [] if is_of_type(value, rule) else [f"{path} is no {rule}"]
        elif word == "enum":
            found += [] if value in rule else [f"{path} is none of {rule}"]
        elif word == "pattern":
            found += [] if re.search(rule, value) else [f"{path} does not match {rule}"]
        elif word == "minimum":
            found += [] if value >= rule else [f"{path} is below {rule}"]
        elif word in ("required", "properties", "additionalProperties") and isinstance(value, list) or word == "items" and isinstance(value, dict):
            continue  # they speak of values of another type
        elif word == "required":
            found += [f"{path} lacks {key}" for key in rule if value is not None and key not in value]
        elif word == "properties":
            for key in rule.keys() & (value or {}).keys():
                found += faults(value[key], rule[key], root, f"{path}.{key}")
        elif word == "additionalProperties" and rule is False:
            found += [f"{path} has {key} as well" for key in value if key not in schema["properties"]]
        elif word == "items":
            for i, item in enumerate(value):
                found += faults(item, rule, root, f"{path}[{i}]")
        else:
            raise ValueError(f"the checker does not know {word}")
    return found
