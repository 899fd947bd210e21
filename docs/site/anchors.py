"""Links and anchors of Markdown documents, as GitHub forms them: for the site and for the check of links."""
import re

FENCE = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)


def anchor_of(heading, names):
    """The anchor of a heading; names are those of the headings before it, to which it is added."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    name = re.sub(r"[^\w\- ]", "", text.lower()).strip().replace(" ", "-")
    names.append(name)
    return name + (f"-{names.count(name) - 1}" if names.count(name) > 1 else "")


def anchors(text):
    """The anchors of all headings of a document."""
    names = []
    return {anchor_of(heading, names) for heading in HEADING.findall(FENCE.sub("", text))}
