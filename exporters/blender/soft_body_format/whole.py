"""Writes the complete document of a scene: the scene's own data, merged with the file that it was imported from."""

from dataclasses import dataclass

from . import memory
from .locating import Locator
from .to_document import SceneWriter


@dataclass
class Whole:
    document: object
    writer: SceneWriter
    changed: bool  # whether it differs from the file it was imported from; true without an import

    @property
    def locator(self):
        return Locator(self.document, self.writer.identifiers)


def write_whole(context, options, findings):
    """Returns the document of the scene. Adds the scene's faults to the findings."""
    writer = SceneWriter(context, options, findings)
    now, known = writer.write(), memory.find_import(writer.objects, writer.space, findings)
    document = memory.merge_documents(*known, now) if known else now
    return Whole(document, writer, not known or document != known[0])
