"""Reads canonical XML into records. Other files must go through the library first, which rejects invalid ones."""

import base64
import xml.etree.ElementTree as ElementTree
from array import array

from .record import Record


def value_of(text, field):
    if field.type == "bool":
        return text in ("true", "1")
    if field.typecode == "f":
        numbers = tuple(map(float, text.split()))
        return numbers if field.width > 1 else numbers[0]
    return int(text) if field.typecode else text


def items_of(text, field):
    if field.type == "bytes":
        return base64.b64decode("".join((text or "").split()))
    return array(field.typecode, map(float if field.typecode == "f" else int, (text or "").split()))


def child_names(element):
    """A dict from names of child elements to their field, and to the value of the field that names them."""
    names = {}
    for field in element.fields:
        if field.wrapper:
            names[field.wrapper] = field
        elif field.is_child or field.is_list or field.type == "text":
            names[field.xml or field.name] = field
    return names


def fill(record, node):
    for name, text in node.attrib.items():
        setattr(record, name, value_of(text, record.field(name)))
    names = child_names(record.element)
    for below in node:
        field = names.get(below.tag)
        if field is None:
            raise ValueError(f"<{below.tag}> has no place in <{node.tag}>")
        if field.is_list:
            setattr(record, field.name, items_of(below.text, field))
        elif field.type == "text":
            setattr(record, field.name, below.text or "")
        else:
            for one in below if field.wrapper else (below,):
                add(record, field, one)


def add(record, field, node):
    child = getattr(record, field.name) if field.type == "one" else record.add(field.name)
    if field.by:
        setattr(child, field.by, node.tag[:-len(field.suffix)])
    fill(child, node)


def from_xml(data):
    """The asset's record of canonical XML."""
    record = Record("asset")
    fill(record, ElementTree.fromstring(data))
    return record
