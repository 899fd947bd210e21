#!/usr/bin/env python3
"""Doxygen's input filter: our headers have plain comments, which it takes for documentation where a mark says so.

Lists, which are a pointer and a count, and the components of small vectors say no more than that.
A comment that begins a line documents what follows; one behind code documents what stands before it. The first comment of
a header documents the file. Nothing in a comment is a command or markup."""
import re
import sys

LIST = re.compile(r"typedef struct (\w+)_list \{\s+(const [^;]*\bat);\s+uint32_t count;\s+\}")
LIST_PAGE = ("/** A list of \\1. */\ntypedef struct \\1_list {\n  \\2; /**< The items; NULL where there are none. */\n"
             "  uint32_t count; /**< How many. */\n}")
VECTOR = re.compile(r"typedef struct (sbf_(?:vec|quat|uint)\w*) \{\n  (float|uint32_t) ([^;]*);\n\}")
COMMENT = re.compile(r"/\*(.*?)\*/", re.DOTALL)


def escaped(text):
    return re.sub(r"([\\@&$#<>%\"])|(::)", lambda m: "\\" + m.group(0) if m.group(1) else "\\::", text)


def mark(match, text):
    before = text[text.rfind("\n", 0, match.start()) + 1:match.start()].strip()
    # Stars at the beginnings of lines are layout.
    body = "\n * ".join(escaped(re.sub(r"^\s*\*\s?", "", line)) if i else escaped(line)
                        for i, line in enumerate(match.group(1).split("\n")))
    if re.match(r"\s*-{3,}", match.group(1)):
        return match.group(0)  # a line between sections
    if before:
        return "/**<" + body + "*/"
    return ("/** \\file\n *" if not text[:match.start()].strip() else "/**") + body + "*/"


def share(text):
    """Declarations that follow each other without a blank line share the comment above the first."""
    out, last, begun = [], None, False
    for chunk in re.split(r"(/\*\*(?!<).*?\*/\n)", text, flags=re.DOTALL):
        if chunk.startswith("/**"):
            last = chunk if "\\file" not in chunk else None
            out.append(chunk)
            begun = True  # the next declaration has its comment
            continue
        for line in chunk.splitlines(keepends=True):
            declares = re.match(r"(SBF_API|SBR_API|typedef struct \w+ \w+;|#define SB\w+ )", line)
            if not line.strip():
                last = None
            elif declares and last and not begun:
                out.append(last)
            begun = begun and not (declares or line.startswith("typedef"))
            out.append(line)
    return "".join(out)


def split_members(text):
    """Members declared together share their comment."""
    def lines(match):
        return "".join(f"  {match.group(1)} {name};{match.group(3)}\n" for name in match.group(2).split(", "))
    return re.sub(r"^  (\w+) (\w+(?:, \w+)+);( /\*\*<(?:[^*]|\*(?!/))*\*/)\n", lines, text, flags=re.MULTILINE)


def vector_page(match):
    members = "".join(f"  {match.group(2)} {name.strip()}; /**< Component. */\n" for name in match.group(3).split(","))
    return f"/** Numbers together. */\ntypedef struct {match.group(1)} {{\n{members}}}"


def main():
    with open(sys.argv[1], encoding="utf-8") as stream:
        text = stream.read()
    text = COMMENT.sub(lambda match: mark(match, text), text)
    sys.stdout.write(VECTOR.sub(vector_page, LIST.sub(LIST_PAGE, split_members(share(text)))))


if __name__ == "__main__":
    main()
