#!/usr/bin/env python3
"""A second reader of sbf files, written from sbf.md, packed.md and reference.md alone.

    sbf.py FILE        prints what the file says as canonical JSON; status 1 and a message where it is refused

It shows that the specification is enough, and the project's tests compare what it prints with what the C library
reads. It is short and slow; for real work there are the C library and its Python module.

The JSON has every field of every object, in the order of field numbers, defaults included: numbers in the form of
section 4.2, lists flat, references as ids or null, words as strings, bytes as base64; one line, without spaces.
"""

import base64
import functools
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from sbf_elements import KNOWN_VERSION, Fault  # noqa: E402
from sbf_numbers import print_float  # noqa: E402
from sbf_packed import MAGIC, read_packed  # noqa: E402
from sbf_rules import check  # noqa: E402
from sbf_xml import read_version, read_xml  # noqa: E402

ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\r": "\\r", "\t": "\\t"}


def load(data):
    """The asset that the bytes hold, checked; raises Fault."""
    root = read_packed(data) if data.startswith(MAGIC) else read_xml(data)
    if read_version(root["version"]) > KNOWN_VERSION:
        root["version"] = "%d.%d" % KNOWN_VERSION  # what it says beyond that has been passed over: section 5
    check(root)
    return root


@functools.lru_cache(maxsize=1 << 18)
def number_text(value, _negative):
    return print_float(value)


def scalar_text(field, value):
    return number_text(value, str(value)[0] == "-") if field.scalar == "float" else str(value)


def string_text(value):
    return '"' + "".join(ESCAPES.get(character, character) for character in value) + '"'


def value_text(field, value):
    if value is None:
        return "null"
    if field.is_child:
        if field.kind == "many":
            return "[" + ",".join(map(object_text, value)) + "]"
        return object_text(value)
    if field.kind == "bool":
        return "true" if value else "false"
    if field.kind == "bytes":
        return string_text(base64.b64encode(value).decode())
    if isinstance(value, str):
        return string_text(value)
    if isinstance(value, list):
        return "[" + ",".join(scalar_text(field, number) for number in value) + "]"
    return scalar_text(field, value)


def object_text(target):
    return "{" + ",".join(f'"{field.name}":{value_text(field, target[field.name])}'
                          for field in target.element.fields) + "}"


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    try:
        with open(sys.argv[1], "rb") as stream:
            text = object_text(load(stream.read()))
    except OSError as error:
        print(f"sbf.py: {error}", file=sys.stderr)
        return 2
    except Fault as fault:
        print(f"sbf.py: {sys.argv[1]}: {fault}", file=sys.stderr)
        return 1
    sys.stdout.buffer.write(text.encode("utf-8") + b"\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
