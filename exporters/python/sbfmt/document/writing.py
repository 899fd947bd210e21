"""Writes records as canonical XML: section 4.2 of spec/sbf.md."""

import base64
import os
import re
import tempfile
from array import array

from .number_text import float_word, nine_digits, number_words

LINE_SCALARS, LINE_BYTES = 12, 57
SPECIAL = {"&": "&amp;", "<": "&lt;", ">": "&gt;", "\r": "&#13;"}
SPECIAL_IN_ATTRIBUTES = {**SPECIAL, '"': "&quot;", "\t": "&#9;", "\n": "&#10;"}


def escape(text, special):
    return re.sub("[" + "".join(special) + "]", lambda found: special[found[0]], text)


def value_text(value, field):
    """An attribute's value."""
    if field.type == "bool":
        return "true" if value else "false"
    if field.typecode == "f":
        return " ".join(map(float_word, value)) if field.width > 1 else float_word(value)
    if field.typecode:
        return str(int(value))
    return escape(value or "", SPECIAL_IN_ATTRIBUTES)


def is_default(value, field):
    """Compares bit by bit, as binary32 if the field is one."""
    if field.default is None or value is None:
        return not value
    if field.typecode == "f":
        pair = [array("f", one if field.width > 1 else [one]).tobytes() for one in (value, field.default)]
        return pair[0] == pair[1]
    return value == field.default


class Writing:
    """The lines so far. `object` returns whether it wrote more than defaults; if not, the caller removes its lines.
    `given` collects the lists; the lines then only refer to them."""

    def __init__(self, rows, given=None):
        self.lines, self.rows, self.given = [], rows, given

    def object(self, record, name, depth, by=None, fixed=None):
        start, says = len(self.lines), False
        tag = [f"{'  ' * depth}<{name}"]
        for field in record.element.fields:
            if field.is_attribute and field.name != by:
                value = getattr(record, field.name)
                default = is_default(value, field) or fixed == (field.name, value)
                says = says or not default
                if field.required or not is_default(value, field):
                    tag.append(f' {field.name}="{value_text(value, field)}"')
        self.lines.append("")
        for field in record.element.fields:
            if field.is_list:
                says = self.list(getattr(record, field.name), field, depth + 1) or says
            elif field.type == "text":
                says = self.text(getattr(record, field.name), field, depth + 1) or says
            elif field.is_child:
                says = self.children(record, field, depth + 1) or says
        empty = len(self.lines) == start + 1
        self.lines[start] = "".join(tag) + ("/>" if empty else ">")
        if not empty:
            self.lines.append(f"{'  ' * depth}</{name}>")
        return says

    def text(self, text, field, depth):
        if text:
            self.lines.append(f"{'  ' * depth}<{field.name}>{escape(text, SPECIAL)}</{field.name}>")
        return bool(text)

    def list(self, items, field, depth):
        if not items:
            return False
        if self.given is not None:
            self.lines.append(f'<{field.name} given="{len(self.given)}"/>')
            self.given.append(items)
            return True
        if field.type == "bytes":
            rows = [base64.b64encode(items[i:i + LINE_BYTES]).decode() for i in range(0, len(items), LINE_BYTES)]
        else:
            rows = self.rows(items)
        space = "  " * depth
        if len(rows) == 1:
            self.lines.append(f"{space}<{field.name}>{rows[0]}</{field.name}>")
        else:
            self.lines.append(f"{space}<{field.name}>")
            self.lines += rows
            self.lines.append(f"{space}</{field.name}>")
        return True

    def children(self, record, field, depth):
        children = getattr(record, field.name)
        if field.type != "many":
            children = [] if children is None else [children]
        start, says = len(self.lines), False
        if field.wrapper:
            self.lines.append(f"{'  ' * depth}<{field.wrapper}>")
            depth += 1
        for child in children:
            before = len(self.lines)
            name = getattr(child, field.by) + field.suffix if field.by else field.xml or child.element.xml
            said = self.object(child, name, depth, field.by, field.fixed)
            if not said and field.type == "one":
                del self.lines[before:]
            says = says or said or field.type != "one"
        if not field.wrapper:
            return says
        if len(self.lines) == start + 1:
            del self.lines[start:]
        else:
            self.lines.append(f"{'  ' * (depth - 1)}</{field.wrapper}>")
        return says


def canonical_rows(items):
    words = number_words(items)
    return [" ".join(words[i:i + LINE_SCALARS]) for i in range(0, len(words), LINE_SCALARS)]


def to_xml(record, canonical=True):
    """The XML of an asset's record, as bytes. XML that only the library reads need not be canonical: nine digits of every number give
    the same values in a fifth of the time."""
    writing = Writing(canonical_rows if canonical else lambda items: [nine_digits(items)])
    writing.object(record, record.element.xml, 0)
    return ("\n".join(['<?xml version="1.0" encoding="UTF-8"?>'] + writing.lines) + "\n").encode()


def to_parts(record):
    """(XML, lists) of an asset's record for the library. The XML refers to the lists by index."""
    given = []
    writing = Writing(None, given)
    writing.object(record, record.element.xml, 0)
    return "\n".join(writing.lines).encode(), given


def save_whole(path, data):
    """Writes a temporary file and renames it. A failure leaves the old file unchanged."""
    folder, name = os.path.split(os.path.abspath(path))
    handle, temporary = tempfile.mkstemp(prefix=f".{name}.", dir=folder)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        mode = os.umask(0)
        os.umask(mode)
        os.chmod(temporary, 0o666 & ~mode)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
