"""Builds a document in a background thread. Keeps the last build, because check, preview and bake often need the same one."""

import hashlib
import threading
import time

from . import sbfmt
from .finishing import to_asset
from .sbfmt.document import from_xml, to_parts


class Built:
    """The result of a build: the library's asset, and its document."""

    def __init__(self, asset, document):
        self.asset, self.document = asset, document


class BuildJob:
    """One build in a thread. The thread does not call Blender. Both threads use only `progress` and `cancelled`."""

    def __init__(self, document, arguments, repair_files):
        self.document, self.arguments, self.repair_files, self.built, self.error = document, arguments, repair_files, None, None
        self.progress, self.pass_name, self.cancelled = 0.0, "", False
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    @property
    def is_running(self):
        return self.thread.is_alive()

    def run(self):
        try:
            with to_asset(self.document, (lambda _found: None) if self.repair_files else None) as source:
                made = source.build(progress=self.on_progress, **self.arguments)
            self.built = Built(made, from_xml(made.to_xml()))
        except (sbfmt.Error, OSError) as error:
            self.error = error

    def on_progress(self, name, fraction):
        self.pass_name, self.progress = name, fraction
        return not self.cancelled


class LastBuild:
    """The key of the last build, and its result."""

    key, built = None, None

    @classmethod
    def forget(cls):
        cls.key = cls.built = None


def key_of(document, arguments, repair_files):
    """The hash of everything a build depends on."""
    text, lists = to_parts(document)
    hashed = hashlib.sha256(text + repr((sorted(arguments.items()), repair_files)).encode())
    for items in lists:
        hashed.update(items)
    return hashed.digest()


def build_in_steps(document, arguments, repair_files):
    """A generator of (step, fraction done) that returns a Built. Returns the last Built at once if its key is the same. Raises the
    build's exception. Closing the generator cancels the build."""
    key = key_of(document, arguments, repair_files)
    if key == LastBuild.key:
        return LastBuild.built
    job = BuildJob(document, arguments, repair_files)
    try:
        while job.is_running:
            yield f"Building: {job.pass_name}", job.progress
            time.sleep(0.005)
    finally:
        job.cancelled = True
        job.thread.join()
    if job.error is not None:
        raise job.error
    LastBuild.key, LastBuild.built = key, job.built
    return job.built
