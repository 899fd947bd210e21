#!/usr/bin/env python3
"""Makes what is generated from spec/sbf.schema, sbf.codes and sbf.materials; with --check, says what is stale and fails."""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True

import emit_c
import emit_codes
import emit_docs
import emit_gltf
import emit_materials
import emit_python
import schema as schema_reader

ROOT = os.path.dirname(os.path.dirname(HERE))


def products():
    schema = schema_reader.read(os.path.join(ROOT, "spec", "sbf.schema"))
    codes = emit_codes.read(os.path.join(ROOT, "spec", "sbf.codes"))
    materials = emit_materials.read(os.path.join(ROOT, "spec", "sbf.materials"))
    with open(os.path.join(ROOT, "docs", "materials.md"), encoding="utf-8") as file:
        materials_page = file.read()
    return {
        **{"libsbfmt/include/sbfmt/" + name: text for name, text in emit_c.model_headers(schema).items()},
        "libsbfmt/generated/schema_tables.c": emit_c.tables(schema),
        "libsbfmt/include/sbfmt/codes.h": emit_codes.header(codes),
        "libsbfmt/generated/code_table.c": emit_codes.table(codes),
        "exporters/python/sbfmt/document/elements.py": emit_python.elements(schema),
        "exporters/python/sbfmt/document/material_presets.py": emit_materials.python(materials),
        "libsbfmt/build/materials/material_table.h": emit_materials.table(materials),
        "docs/materials.md": emit_materials.page(materials, materials_page),
        "spec/reference.md": emit_docs.reference(schema),
        "spec/sbf.xsd": emit_docs.xsd(schema),
        "spec/codes.md": emit_codes.page(codes),
        "spec/gltf/SBF_soft_body/schema/SBF_soft_body.schema.json": emit_gltf.extension(schema),
    }


def main():
    check, stale = "--check" in sys.argv[1:], []
    for name, text in products().items():
        path = os.path.join(ROOT, name)
        try:
            with open(path, encoding="utf-8") as file:
                if file.read() == text:
                    continue
        except FileNotFoundError:
            pass
        if check:
            stale.append(name)
            continue
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        print("made", name)
    if stale:
        sys.exit("stale: " + ", ".join(stale) + "; run python3 spec/generate/generate.py")


if __name__ == "__main__":
    main()
