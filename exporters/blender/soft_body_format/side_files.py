"""Writes the files that a bundle names together with it: all of them or none."""

import contextlib
import os

from .sbfmt.document import save_whole


class SideFiles:
    """Files beside a bundle, and the files they replace."""

    def __init__(self, folder):
        self.folder, self.before, self.made_folders, self.kept = folder, {}, [], False

    def write(self, files):
        for name, data in files.items():
            path = os.path.join(self.folder, *name.split("/"))
            self.make_folder(os.path.dirname(path))
            old = read(path)
            if old != data:
                self.before[path] = old
                save_whole(path, data)

    def make_folder(self, folder):
        if folder and not os.path.isdir(folder):
            self.make_folder(os.path.dirname(folder))
            os.mkdir(folder)
            self.made_folders.append(folder)

    def keep(self):
        """Keeps the files when the `with` ends."""
        self.kept = True

    def take_back(self):
        for path, old in self.before.items():
            if old is not None:
                save_whole(path, old)
            elif os.path.exists(path):
                os.unlink(path)
        for folder in reversed(self.made_folders):
            with contextlib.suppress(OSError):
                os.rmdir(folder)


def read(path):
    """The bytes of a file, or None where there is none."""
    try:
        with open(path, "rb") as file:
            return file.read()
    except FileNotFoundError:
        return None


@contextlib.contextmanager
def files_beside(folder, files):
    """Writes the files for the time of the `with`. If `keep` was not called in it, the old files return at the end."""
    written = SideFiles(folder)
    try:
        written.write(files)
        yield written
    finally:
        if not written.kept:
            written.take_back()
