"""A small reader of USD's text form, as far as our exports and reprints of them go: prims by path with type, schemas and properties."""

import ast
import re

TOKEN = re.compile(r"""\s*(?:\#[^\n]*|("(?:[^"\\]|\\.)*"|<[^<>]*>|[-+.\w:]+|[][(){}=,@]))""")


class Prim:
    def __init__(self, kind, path):
        self.kind, self.path, self.schemas, self.values, self.types, self.meta, self.children = kind, path, [], {}, {}, {}, []


class Reader:
    def __init__(self, text):
        self.tokens = [found.group(1) for found in TOKEN.finditer(text) if found.group(1)]
        self.at = 0
        self.prims = {}

    def next(self):
        self.at += 1
        return self.tokens[self.at - 1]

    def peek(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    def expect(self, token):
        found = self.next()
        if found != token:
            raise ValueError(f"token {self.at}: {found} where {token} should be")

    def value(self):
        token = self.next()
        if token in "([":
            items, end = [], ")" if token == "(" else "]"
            while self.peek() != end:
                items.append(self.value())
                if self.peek() == ",":
                    self.next()
            self.next()
            return items
        if token[0] == '"':
            return ast.literal_eval(token)
        if token[0] == "<":
            return token
        return {"true": 1.0, "false": 0.0}.get(token) if token in ("true", "false") else float(token)

    def metadata(self):
        found = {}
        if self.peek() != "(":
            return found
        self.next()
        while self.peek() != ")":
            name = self.next()
            if name == "prepend":
                name = self.next()
            if self.peek() == "=":
                self.next()
                found[name] = self.value()
            if self.peek() == ",":
                self.next()
        self.next()
        return found

    def body(self, prim):
        self.expect("{")
        while self.peek() != "}":
            if self.peek() == "def":
                self.prim(prim)
                continue
            words = []
            while not re.fullmatch(r"[=({}]", self.peek()) and not (words and self.is_start(words)):
                words.append(self.next())
                if self.peek() == "[" and self.tokens[self.at + 1] == "]":
                    self.at += 2
                    words[-1] += "[]"
            name = words[-1]
            if name in prim.values:
                raise ValueError(f"{prim.path}: {name} is there twice")
            prim.types[name], prim.values[name] = " ".join(words[:-1]), None
            if self.peek() == "=":
                self.next()
                prim.values[name] = self.value()
            prim.meta[name] = self.metadata()
        self.next()

    def is_start(self, words):
        """Whether a declaration without a value is complete: it has its type and name."""
        return len([word for word in words if word not in ("uniform", "custom", "prepend")]) == 2

    def prim(self, parent):
        self.expect("def")
        kind = self.next()
        name = ast.literal_eval(self.next())
        if not re.fullmatch(r"[A-Za-z_]\w*", name):
            raise ValueError(f"{parent.path}/{name}: not the name of a prim")
        prim = Prim(kind, f"{parent.path}/{name}")
        if prim.path in self.prims:
            raise ValueError(f"{prim.path} is there twice")
        prim.schemas = self.metadata().get("apiSchemas", [])
        parent.children.append(prim)
        self.prims[prim.path] = prim
        self.body(prim)


def read(path):
    """The layer's metadata, and its prims by path."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if not text.startswith("#usda 1.0"):
        raise ValueError("no USD text")
    reader = Reader(text)
    layer, root = reader.metadata(), Prim("", "")
    while reader.peek():
        reader.prim(root)
    return layer, reader.prims
