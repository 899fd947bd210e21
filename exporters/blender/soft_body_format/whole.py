"""The whole document that a scene stands for: what the scene says, and what the file it came from said beside it."""

from dataclasses import dataclass

from . import memory
from .locating import Locator
from .to_document import SceneWriter


@dataclass
class Whole:
    document: object
    writer: SceneWriter
    changed: bool  # against the file that it was imported from; true where it is from none

    @property
    def locator(self):
        return Locator(self.document, self.writer.identifiers)


def write_whole(context, options, findings):
    """What is wrong with the scene joins the findings."""
    writer = SceneWriter(context, options, findings)
    now, known = writer.write(), memory.recall(writer.objects, writer.space, findings)
    document = memory.merge_documents(*known, now) if known else now
    return Whole(document, writer, not known or document != known[0])
