"""The XML form: section 4 of sbf.md."""

import base64
import binascii
import re
import xml.parsers.expat

from sbf_elements import KNOWN_VERSION, ROOT, Fault, Object
from sbf_words import WORDS
from sbf_numbers import read_scalars

SPACE = " \t\r\n"
SILENT = ("http://www.w3.org/XML/1998/namespace ", "http://www.w3.org/2001/XMLSchema-instance ")
DEEPEST = 32
ENCODINGS = ("utf-8", "us-ascii")
VERSION = re.compile(r"([0-9]+)\.([0-9]+)")


def read_version(text):
    """(major, minor); refuses what is newer than major version 1."""
    match = VERSION.fullmatch(text)
    if not match:
        raise Fault(f"version '{text[:40]}' is not MAJOR.MINOR")
    major, minor = int(match.group(1)), int(match.group(2))
    if major != 1:
        raise Fault(f"version {text} is of another major version than 1")
    return major, minor


class Node:
    """An open element: an object, a wrapper around objects, a list or text, or something passed over."""

    def __init__(self, kind, target=None, field=None):
        self.kind, self.object, self.field = kind, target, field
        self.seen, self.text = set(), []


class XmlReader:
    """Turns expat's events into objects."""

    def __init__(self):
        self.nodes, self.root, self.newer = [], None, False

    def read(self, data):
        if data[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\0" in data[:4]:
            raise Fault("the file is not UTF-8")
        parser = xml.parsers.expat.ParserCreate(namespace_separator=" ")
        parser.buffer_text = True
        parser.XmlDeclHandler = self.declaration
        parser.StartDoctypeDeclHandler = self.doctype
        parser.StartElementHandler = self.start
        parser.EndElementHandler = self.end
        parser.CharacterDataHandler = self.characters
        try:
            parser.Parse(data, True)
        except xml.parsers.expat.ExpatError as error:
            raise Fault(f"not well-formed: {error}") from error
        except Fault as fault:
            raise Fault(f"line {parser.CurrentLineNumber}: {self.path()}: {fault}") from None
        return self.root

    def path(self):
        return "/" + "/".join(node.field.name if node.field else node.kind for node in self.nodes)

    @staticmethod
    def declaration(_version, encoding, _standalone):
        if encoding is not None and encoding.lower() not in ENCODINGS:
            raise Fault(f"the encoding {encoding} is not UTF-8")

    @staticmethod
    def doctype(*_):
        raise Fault("a DOCTYPE is not taken")

    def start(self, name, attributes):
        if len(self.nodes) >= DEEPEST:
            raise Fault(f"more than {DEEPEST} elements inside each other")
        attributes = {key: value for key, value in attributes.items() if not key.startswith(SILENT)}
        if not self.nodes:
            self.start_root(name, attributes)
            return
        node = self.nodes[-1]
        if node.kind == "passed over":
            self.nodes.append(Node("passed over"))
        elif node.kind == "list":
            self.unknown(f"<{name}> inside a list or text")
        elif node.kind == "wrapper":
            if not self.start_child(node, [node.field], name, attributes, wrapped=True):
                self.unknown(f"<{name}>")
        elif not self.start_list(node, name, attributes) and not self.start_wrapper(node, name, attributes) and \
                not self.start_child(node, node.object.element.fields, name, attributes, wrapped=False):
            self.unknown(f"<{name}>")

    def unknown(self, what):
        """What this version does not have is passed over in files of a newer one."""
        if not self.newer:
            raise Fault(f"{what} has no place here")
        self.nodes.append(Node("passed over"))

    def start_root(self, name, attributes):
        if name != ROOT.xml:
            raise Fault(f"the root is <{name}>, not <{ROOT.xml}>")
        if "version" not in attributes:
            raise Fault("no version is given")
        self.newer = read_version(attributes["version"]) > KNOWN_VERSION
        self.version = read_version(attributes["version"])
        self.root = Object(ROOT)
        self.nodes.append(Node("object", self.root))
        self.read_attributes(self.root, attributes, None)

    def stated(self, field):
        """What is of a later version than the file states has no place in it, for later readers either: section 5."""
        if (1, field.since) > max(self.version, (1, 0)):
            raise Fault(f"{field.name} is of version 1.{field.since}")

    def start_list(self, node, name, attributes):
        field = node.object.element.by_name.get(name)
        if field is None or field.is_child or field.is_attribute:
            return False
        self.stated(field)
        self.once(node, name)
        if attributes and not self.newer:
            raise Fault(f"{name} has no attributes")
        self.nodes.append(Node("list", node.object, field))
        return True

    def start_wrapper(self, node, name, attributes):
        field = next((f for f in node.object.element.fields if f.is_child and f.wrapper == name), None)
        if field is None:
            return False
        self.once(node, name)
        if attributes and not self.newer:
            raise Fault(f"{name} has no attributes")
        self.nodes.append(Node("wrapper", node.object, field))
        return True

    def start_child(self, node, fields, name, attributes, wrapped):
        for field in fields:
            if not field.is_child or (field.wrapper is not None) != wrapped:
                continue
            by = None
            if field.written and field.written[-1] == "KIND_joint":
                word = name[:-len("_joint")]
                if not name.endswith("_joint") or word not in WORDS["joint_kind"]:
                    continue
                by = ("kind", word)
            elif name != (field.written[-1] if field.written else field.name):
                continue
            self.add_child(node, field, attributes, by)
            return True
        return False

    def add_child(self, node, field, attributes, by):
        parent = node.object
        self.stated(field)
        if field.kind == "many":
            child = parent.child(field)
            parent[field.name].append(child)
        else:
            self.once(node, field.name)
            child = parent[field.name] if field.kind == "one" else parent.child(field)
            parent[field.name] = child
        if by:
            child[by[0]] = by[1]
        self.nodes.append(Node("object", child, field))
        self.read_attributes(child, attributes, by)

    @staticmethod
    def once(node, name):
        if name in node.seen:
            raise Fault(f"{name} stands twice")
        node.seen.add(name)

    def read_attributes(self, target, attributes, by):
        given = {by[0]} if by else set()
        for name, text in attributes.items():
            field = target.element.by_name.get(name)
            if field is None or not field.is_attribute or (by and name == by[0]):
                if not self.newer:
                    raise Fault(f"the attribute {name} has no place here")
                continue
            self.stated(field)
            target[name] = self.read_value(field, text)
            given.add(name)
        for field in target.element.fields:
            if field.required and (field.name not in given or target[field.name] == ""):
                raise Fault(f"{field.name} is required")

    @staticmethod
    def read_value(field, text):
        kind = field.kind
        if kind in ("string", "id", "ref"):
            if kind != "string" and not text:
                raise Fault(f"{field.name} is empty")
            return text
        text = text.strip(SPACE)
        if kind == "enum":
            if text not in WORDS[field.argument]:
                raise Fault(f"'{text}' is no word for {field.name}")
            return text
        if kind == "bool":
            if text not in ("true", "false", "1", "0"):
                raise Fault(f"'{text}' is neither true nor false")
            return text in ("true", "1")
        numbers = read_scalars(text, field.scalar)
        if len(numbers) != field.width:
            raise Fault(f"{field.name} takes {field.width} numbers, not {len(numbers)}")
        return numbers if field.width > 1 else numbers[0]

    def characters(self, text):
        node = self.nodes[-1]
        if node.kind == "list":
            node.text.append(text)
        elif node.kind != "passed over" and text.strip(SPACE):
            raise Fault(f"the text '{text.strip(SPACE)[:30]}' stands where only elements belong")

    def end(self, _name):
        node = self.nodes[-1]
        if node.kind == "list":
            self.read_list(node)
        self.nodes.pop()

    @staticmethod
    def read_list(node):
        text, field = "".join(node.text), node.field
        if field.kind == "text":
            node.object[field.name] = text
        elif field.kind == "bytes":
            node.object[field.name] = read_base64(text)
        else:
            numbers = read_scalars(text, field.scalar)
            if len(numbers) % field.width:
                raise Fault(f"{len(numbers)} numbers are no multiple of {field.width}")
            node.object[field.name] = numbers


def read_base64(text):
    text = "".join(text.split())
    try:
        data = base64.b64decode(text.encode("ascii"), validate=True)
    except (binascii.Error, ValueError) as error:
        raise Fault(f"not base64: {error}") from error
    if base64.b64encode(data).decode() != text:
        raise Fault("base64 with unused bits set or characters left over")
    return data


def read_xml(data):
    return XmlReader().read(data)
