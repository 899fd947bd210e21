"""Computes the source hash from the text of the specification alone (spec/sbf.md, sections 4.2 and 6). It handles files that are
already canonical XML, with attributes in order and numbers in their shortest form."""

import hashlib
import xml.etree.ElementTree as ElementTree

# Elements of type `one`: left out where they say nothing.
SILENT = {"asset", "polygon_mesh", "attributes", "collision", "tetrahedron_mesh", "simulation", "frame_a", "frame_b",
          "environment", "relaxation"}
WRAPPERS = {"derivations", "textures", "materials", "skeleton", "rigid_bodies", "joints", "limits", "pins",
            "attachments", "ik", "chains", "followers", "clips", "poses", "bone_masks", "retarget_chains",
            "section_recipes", "extensions"}
DERIVED_MARKS = {"derived", "hull_derived"}
SCALARS_A_LINE, DIGITS_A_LINE = 12, 76
TEXTS = {"data"}  # stand as they are


def escaped(text, quoted):
    for character, name in (("&", "&amp;"), ("<", "&lt;"), (">", "&gt;"), ("\r", "&#13;")):
        text = text.replace(character, name)
    if quoted:
        for character, name in (('"', "&quot;"), ("\t", "&#9;"), ("\n", "&#10;")):
            text = text.replace(character, name)
    return text


def list_lines(element, depth):
    indent = "  " * depth
    if element.tag == "bytes":
        digits = "".join(element.text.split())
        rows = [digits[i:i + DIGITS_A_LINE] for i in range(0, len(digits), DIGITS_A_LINE)]
    else:
        words = element.text.split()
        rows = [" ".join(words[i:i + SCALARS_A_LINE]) for i in range(0, len(words), SCALARS_A_LINE)]
    if len(rows) == 1:
        return [f"{indent}<{element.tag}>{rows[0]}</{element.tag}>"]
    return [f"{indent}<{element.tag}>", *rows, f"{indent}</{element.tag}>"]


READ_OF_ROOT = {"skeleton", "rigid_bodies", "render_mesh", "soft_body", "section_recipes"}
NOT_READ = {("render_mesh", "uv_set"), ("render_mesh", "material_slot"), ("render_mesh", "shape_key"),
            ("render_mesh", "render_level"), ("soft_body", "legacy"), ("simulation", "measured")}


def is_read(parent, child):
    if "derived" in child.attrib or (parent.tag, child.tag) in NOT_READ:
        return False
    if parent.tag == "sbf" and child.tag not in READ_OF_ROOT:
        return False
    return not (parent.tag == "rigid_body" and "hull_derived" in parent.attrib and child.tag == "polygon_mesh")


def lines_of(element, depth):
    indent, children = "  " * depth, []
    if element.tag in TEXTS:
        return [f"{indent}<{element.tag}>{escaped(element.text or '', False)}</{element.tag}>"]
    if element.text and element.text.strip():
        return list_lines(element, depth)
    attributes = [(k, v) for k, v in element.attrib.items() if k not in DERIVED_MARKS]
    for child in element:
        if is_read(element, child):
            children += lines_of(child, depth + 1)
    stated = [k for k, _ in attributes if k != "target"]
    if not children and (element.tag in WRAPPERS or (element.tag in SILENT and not stated)):
        return []
    start = f"{indent}<{element.tag}" + "".join(f' {k}="{escaped(v, True)}"' for k, v in attributes)
    return [start + ">", *children, f"{indent}</{element.tag}>"] if children else [start + "/>"]


def source_text(path):
    root = ElementTree.parse(path).getroot()
    root.set("version", "1.0")
    return "\n".join(['<?xml version="1.0" encoding="UTF-8"?>', *lines_of(root, 0), ""])


def source_hash(path):
    return hashlib.sha256(source_text(path).encode()).hexdigest()
