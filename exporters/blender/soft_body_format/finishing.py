"""From source parts to a file: by the library, which builds, checks and packs; without it as XML in plain Python."""

import os
import tempfile

from . import sbfmt
from .sbfmt.document import save_whole, to_xml


def has_library():
    try:
        sbfmt.library_path()
        return True
    except ImportError:
        return False


def finish(document, path, build, findings, locator=None):
    """Writes the file whole or not at all; says whether it is there. What the library finds joins the findings."""
    try:
        if has_library():
            return with_library(document, path, build, findings, locator)
        return without_library(document, path, findings)
    except sbfmt.Error as error:
        findings.error(f"{error}")
    except OSError as error:
        findings.error(f"{path} can't be written: {error.strerror}; choose another folder, or free some space")
    return False


def to_asset(document):
    """The library's own asset of a document."""
    handle, path = tempfile.mkstemp(suffix=".sbf")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(to_xml(document, canonical=False))
        return sbfmt.load(path)
    finally:
        os.unlink(path)


def with_library(document, path, build, findings, locator):
    with to_asset(document) as source:
        asset = source.build(report=lambda found: add(found, findings, locator)) if build else source
        try:
            check(asset, os.path.dirname(path), findings, locator)
            asset.save(path)
        finally:
            asset.close()
    return True


def check(asset, folder, findings, locator):
    for found in asset.validate(folder=folder).findings:
        add(found, findings, locator)


def without_library(document, path, findings):
    if path.endswith(".sbfz"):
        findings.error("packed files need the compiled library, which this add-on does not find: export as .sbf, "
                       "then run: sbfmt build FILE.sbf -o FILE.sbfz")
        return False
    save_whole(path, to_xml(document))
    findings.warning("the compiled library is not found, so this file holds source parts alone; finish it with: "
                     f"sbfmt build {os.path.basename(path)} -o {os.path.basename(path)}")
    return True


def add(found, findings, locator=None):
    """A diagnostic of the library as a finding, with what it is about."""
    tell = {"error": findings.error, "warning": findings.warning}.get(found.severity, findings.info)
    tell(found.message, code=found.code, **(locator.locate(found) if locator else {}))
