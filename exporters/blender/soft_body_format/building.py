"""Builds in a thread of their own, and the last of them kept: check, preview and bake ask for the same one after another."""

import hashlib
import threading
import time

from . import sbfmt
from .finishing import to_asset
from .sbfmt.document import from_xml, to_parts


class Built:
    """What a build made: the library's asset, and its document."""

    def __init__(self, asset, document):
        self.asset, self.document = asset, document


class BuildJob:
    """One build in a thread. Blender is not touched there; `progress` and `cancelled` are all that both sides know."""

    def __init__(self, document, arguments, mends):
        self.document, self.arguments, self.mends, self.built, self.error = document, arguments, mends, None, None
        self.progress, self.passed, self.cancelled = 0.0, "", False
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    @property
    def is_running(self):
        return self.thread.is_alive()

    def run(self):
        try:
            with to_asset(self.document, (lambda _found: None) if self.mends else None) as source:
                made = source.build(progress=self.hear, **self.arguments)
            self.built = Built(made, from_xml(made.to_xml()))
        except (sbfmt.Error, OSError) as error:
            self.error = error

    def hear(self, name, share):
        self.passed, self.progress = name, share
        return not self.cancelled


class LastBuild:
    """Of what, and what it became."""

    key, built = None, None

    @classmethod
    def forget(cls):
        cls.key = cls.built = None


def key_of(document, arguments, mends):
    """What tells one build from another."""
    text, lists = to_parts(document)
    hashed = hashlib.sha256(text + repr((sorted(arguments.items()), mends)).encode())
    for items in lists:
        hashed.update(items)
    return hashed.digest()


def build_in_steps(document, arguments, mends):
    """A generator of (what, share) that returns a Built, at once where it is the last one's again. Raises what the build did;
    closed, it cancels."""
    key = key_of(document, arguments, mends)
    if key == LastBuild.key:
        return LastBuild.built
    job = BuildJob(document, arguments, mends)
    try:
        while job.is_running:
            yield f"Building: {job.passed}", job.progress
            time.sleep(0.005)
    finally:
        job.cancelled = True
        job.thread.join()
    if job.error is not None:
        raise job.error
    LastBuild.key, LastBuild.built = key, job.built
    return job.built
