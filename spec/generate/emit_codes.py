"""Diagnostic codes: the header, the table and the page, from spec/sbf.codes."""
import re

from emit_c import c_string

FAMILIES = {1: "Input and output, and the call", 2: "XML", 3: "Structure", 4: "Links", 5: "Geometry", 6: "Physics",
            7: "Rig", 8: "Packed form", 9: "Import"}
NOTE = "/* Made from spec/sbf.codes by spec/generate/generate.py: change that, not this file. */\n"


def read(path):
    codes, seen = [], {}
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            if not line.strip() or line.startswith("#"):
                continue
            match = re.fullmatch(r"(\w+)\s+(\d+)\s+(error|warning|info)\s+(input|failed)\s+(.+)", line.rstrip())
            if not match:
                raise SystemExit(f"{path}:{number}: not of the form NAME number severity fault text: {line}")
            name, value, severity, fault, text = match.groups()
            for key in (name, value):
                if key in seen:
                    raise SystemExit(f"{path}:{number}: {key} stands on line {seen[key]} already")
                seen[key] = number
            codes.append((name, int(value), severity, fault, text))
    return sorted(codes, key=lambda c: c[1])


def header(codes):
    rows = "".join(f"  SBF_CODE_{name} = {value}, /* {text} */\n" for name, value, _, _, text in codes)
    return ("/* Numbers of the diagnostics: stable, never reused. The page spec/codes.md explains each.\n *\n"
            " * Made from spec/sbf.codes by spec/generate/generate.py: change that, not this file. */\n"
            "#ifndef SBFMT_CODES_H\n#define SBFMT_CODES_H\n\n#include \"sbfmt/base.h\"\n\n"
            "#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n// clang-format off\n"
            "/* Codes of findings. Their numbers never change. */\ntypedef enum sbf_code {\n  SBF_CODE_NONE = 0,\n" + rows + "} sbf_code;\n// clang-format on\n\n"
            "/* Information about a code. */\ntypedef struct sbf_code_info {\n  const char *name;      /* as in reports */\n"
            "  sbf_code code;         /* its number */\n  sbf_severity severity; /* its severity */\n"
            "  sbf_status fault;      /* SBF_BAD_INPUT or SBF_FAILED */\n  const char *text;      /* its meaning and what to do next */\n} sbf_code_info;\n\n"
            "/* Information about a code; NULL for an unknown number. */\n"
            "SBF_API const sbf_code_info *sbf_code_find(int32_t code);\n\n"
            "/* All codes, ordered by number; `*count` receives how many. */\n"
            "SBF_API const sbf_code_info *sbf_code_table(uint32_t *count);\n\n"
            "#ifdef __cplusplus\n}\n#endif\n#endif\n")


def table(codes):
    rows = "".join(f"  {{{c_string(name)}, SBF_CODE_{name}, SBF_SEVERITY_{severity.upper()}, "
                   f"{'SBF_BAD_INPUT' if fault == 'input' else 'SBF_FAILED'}, {c_string(text)}}},\n"
                   for name, _, severity, fault, text in codes)
    return ("// clang-format off\n" + NOTE + '#include "sbfmt/codes.h"\n\n'
            f"static const sbf_code_info table[] = {{\n{rows}}};\n\n"
            "const sbf_code_info *sbf_code_table(uint32_t *count) {\n"
            "  *count = (uint32_t)(sizeof table / sizeof *table);\n  return table;\n}\n\n"
            "const sbf_code_info *sbf_code_find(int32_t code) {\n"
            "  for (size_t i = 0; i < sizeof table / sizeof *table; i++)\n"
            "    if ((int32_t)table[i].code == code) return &table[i];\n  return NULL;\n}\n")


def page(codes):
    out = ["# Diagnostic codes\n\nMade from `sbf.codes` by `generate/generate.py`. A code's name and number never "
           "change and are never used again.\nErrors of the input end with exit status 1, those of the call or the "
           "machine with 2; warnings do not change it\nunless `--strict` is given.\n"]
    family = 0
    for name, value, severity, fault, text in codes:
        if value // 100 != family:
            family = value // 100
            out.append(f"\n## {FAMILIES[family]}\n\n| code | number | severity | at fault | meaning |\n"
                       "|---|---|---|---|---|\n")
        out.append(f"| `{name}` | {value} | {severity} | "
                   f"{'the input' if fault == 'input' else 'call or machine'} | {text} |\n")
    return "".join(out)
