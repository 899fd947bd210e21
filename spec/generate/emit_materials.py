"""Materials: the library's table, Python's, and the one of docs/materials.md, from spec/sbf.materials."""
import re

from emit_c import c_string

NUMBERS = ("density", "young_modulus", "poisson_ratio", "damping_ratio", "friction", "area_density", "thickness",
           "bending_stiffness")
OF_MATTER = ("0", "0.001", "0")  # what a body that is no layer has of the last three: the schema's defaults
BEGIN, END = "| material |", "\n\n"


def read(path):
    """(name, whether it is cloth, numbers as written, source), in the file's order."""
    found = []
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            if not line.strip() or line.startswith("#"):
                continue
            match = re.fullmatch(r"(matter|cloth) (\w+) ([-+.\de ]+) -- (.+)", line.rstrip())
            numbers = match[3].split() if match else []
            if not match or len(numbers) != (8 if match[1] == "cloth" else 5):
                raise SystemExit(f"{path}:{number}: not of the form KIND NAME numbers -- source: {line}")
            found.append((match[2], match[1] == "cloth", numbers, match[4]))
    if [one[0] for one in found] != sorted({one[0] for one in found}):
        raise SystemExit(f"{path}: names stand once, in alphabetical order")
    return found


def c_float(text):
    return text if text.isdigit() else text + "f"


def table(materials):
    rows = "".join(f"  {{{c_string(name)}, {'true' if cloth else 'false'}, "
                   f"{', '.join(map(c_float, numbers + list(OF_MATTER[len(numbers) - 5:])))}, {c_string(source)}}},\n"
                   for name, cloth, numbers, source in materials)
    return ("// clang-format off\n/* Made from spec/sbf.materials by spec/generate/generate.py: change that, not this file. */\n"
            "#ifndef SBFI_MATERIAL_TABLE_H\n#define SBFI_MATERIAL_TABLE_H\n\n#include \"sbfmt/materials.h\"\n\n"
            f"static const sbf_material_preset presets[] = {{\n{rows}}};\n\n#endif\n")


def python(materials):
    rows = "".join(f"    {name!r}: {{{', '.join(f'{key!r}: {text}' for key, text in zip(NUMBERS, numbers))}}},\n"
                   for name, _, numbers, _ in materials)
    return ('"""Attributes of materials by name. Generated from spec/sbf.materials by spec/generate/generate.py; do not edit."""\n\n'
            f"MATERIALS = {{\n{rows}}}\n")


def page(materials, text):
    """The page with its table made anew."""
    start = text.index(BEGIN)
    head = text[start:].split("\n")[:2]
    rows = ["|" + "".join(f" {cell} |" if cell else " |" for cell in (name, *numbers, *[""] * (8 - len(numbers)), source))
            for name, _, numbers, source in materials]
    stop = text.index(END, start)
    return text[:start] + "\n".join(head + rows) + text[stop:]
