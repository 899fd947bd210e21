"""The valid samples of the specification: they load, go round and show every element, field and word of the schema."""

import glob
import os
import re
import sys
import xml.etree.ElementTree as ElementTree

from canonical_source import source_hash
from sbfmt_program import ProgramTest, ROOT, main, read_bytes, read_text

sys.path.insert(0, os.path.join(ROOT, "spec", "generate"))
import schema as schema_reader  # noqa: E402

SAMPLES = os.path.join(ROOT, "spec", "samples")
VALID = sorted(glob.glob(os.path.join(SAMPLES, "valid", "*.sbf")))


class Seen:
    """What a file says, in the words of the schema."""

    def __init__(self, schema):
        self.schema, self.fields, self.words = schema, set(), set()

    def look(self, element, node):
        for field in element.fields:
            if field.is_child:
                self.look_at_children(element, field, node)
            elif field.is_list or field.type == "text":
                if node.find(field.name) is not None:
                    self.fields.add((element.name, field.name))
            elif field.name in node.attrib:
                self.fields.add((element.name, field.name))
                if field.type == "enum":
                    self.words.add((field.argument, node.attrib[field.name]))

    def look_at_children(self, element, field, node):
        child = self.schema.elements[field.argument]
        inside = node.find(field.wrapper) if field.wrapper else node
        for found in inside if inside is not None else ():
            if field.suffix:
                if not found.tag.endswith(field.suffix):
                    continue
                self.fields.add((child.name, field.by))
                self.words.add((child.field(field.by).argument, found.tag[:-len(field.suffix)]))
            elif found.tag != (field.xml or child.xml) or (field.fix and not self.is_fixed(field, found)):
                continue
            self.fields.add((element.name, field.name))
            self.look(child, found)

    @staticmethod
    def is_fixed(field, node):
        name, value = field.fix.split(":")
        return node.get(name) == value


class ValidSamples(ProgramTest):
    def test_there_are_some(self):
        self.assertGreaterEqual(len(VALID), 3)

    def test_each_is_valid_without_a_warning(self):
        for path in VALID:
            report = self.json_of("validate", path)
            self.assertEqual((report["valid"], report["messages"]), (True, []), path)

    def test_each_is_canonical_and_round_trips(self):
        for path in VALID:
            for options in ((), ("--store",)):
                self.good("pack", path, "-o", self.path("a.sbfz"), *options)
                self.good("unpack", self.path("a.sbfz"), "-o", self.path("a.sbf"))
                self.assertEqual(read_bytes(self.path("a.sbf")), read_bytes(path), path)

    def test_samples_cover_every_field_and_enum_value(self):
        schema = schema_reader.read(os.path.join(ROOT, "spec", "sbf.schema"))
        seen = Seen(schema)
        for path in VALID:
            seen.look(schema.root, ElementTree.parse(path).getroot())
        fields = {(e.name, f.name) for e in schema.elements.values() for f in e.fields}
        fields.remove(("extension", "required"))  # who says it is refused: invalid/extension_required.sbf
        self.assertEqual(sorted(fields - seen.fields), [])
        defaults = {(f.argument, f.default or schema.enums[f.argument][0]) for e in schema.elements.values()
                    for f in e.fields if f.type == "enum" and not f.required}
        words = {(name, word) for name, values in schema.enums.items() for word in values}
        self.assertEqual(sorted(words - seen.words - defaults), [])

    def test_source_hashes_are_right(self):
        stated = [(path, found) for path in VALID for found in re.findall(r'source_hash="(\w+)"', read_text(path))]
        self.assertTrue(stated)
        for path, found in stated:
            self.assertEqual(found, source_hash(path), path)


if __name__ == "__main__":
    main()
