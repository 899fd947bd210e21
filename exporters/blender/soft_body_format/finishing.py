"""Writes a document to a file. The library builds, checks and packs it; without the library plain Python writes XML."""

import os
import stat

from . import sbfmt
from .sbfmt.document import save_whole, to_xml
from .side_files import files_beside


def has_library():
    return sbfmt.library_fault() is None


def refusal(path):
    """Why nothing can be written to the path, or None. The export asks this before it does any work."""
    folder = os.path.dirname(os.path.abspath(path))
    if not os.path.isdir(folder):
        return f"the folder {folder} does not exist: make it, or choose another"
    if os.path.isdir(path):
        return f"{path} is a folder: choose a file's name in it"
    if os.path.exists(path) and not os.stat(path).st_mode & (stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH):
        return f"{path} is write-protected: choose another name, or take its protection away"
    if not os.access(folder, os.W_OK | os.X_OK, effective_ids=os.access in os.supports_effective_ids):
        return f"the folder {folder} may not be written to: choose another, or ask for its permission"
    return None


def finish(document, path, build, findings, locator=None, files=None, repair_files=False):
    """Writes the file and `files`, which it names: all of them or none. Returns whether the file was written. `build` holds the
    arguments of a build, or is None. Adds the library's messages to the findings. `repair_files`: repairs what has one right
    answer."""
    refused = refusal(path)
    if refused:
        findings.error(refused)
        return False
    try:
        with files_beside(os.path.dirname(os.path.abspath(path)), files or {}) as beside:
            if has_library():
                written = with_library(document, path, build, findings, locator, repair_files)
            else:
                written = without_library(document, path, findings)
            if written:
                beside.keep()
        return written
    except sbfmt.Error as error:
        findings.error(f"{error}")
    except OSError as error:
        findings.error(f"{error.filename or path} can't be written: {error.strerror}; choose another folder, or free some space")
    return False


def to_asset(document, repaired=None):
    """The library's asset of a document. `repaired` is called with each repair; None: nothing is repaired."""
    if repaired is None:
        return sbfmt.load_document(document)
    with sbfmt.load_document(document, repairable=True) as unrepaired:
        return unrepaired.fix(report=repaired)


def with_library(document, path, build, findings, locator, repair_files):
    """A file with errors is not written."""
    with to_asset(document, repair_reporter(findings, locator) if repair_files else None) as source:
        asset = source.build(report=lambda found: add(found, findings, locator), **build) if build is not None else source
        try:
            check(asset, os.path.dirname(path), findings, locator)
            if not findings.errors:
                asset.save(path)
        finally:
            asset.close()
    return not findings.errors


def repair_reporter(findings, locator):
    """A function that adds each repair of a file to the findings."""
    def repaired(found):
        findings.info(f"repaired in the file: {found.message}", code=found.code, **(locator.locate(found) if locator else {}))
    return repaired


def check(asset, folder, findings, locator):
    for found in asset.validate(folder=folder).findings:
        add(found, findings, locator)


def without_library(document, path, findings):
    ending = os.path.splitext(path)[1]
    if ending in (".sbfz", ".glb"):
        findings.error(f"{ending} files need the compiled library. It {sbfmt.library_fault()}. Or export as .sbf, "
                       f"then run: sbfmt build FILE.sbf -o FILE{ending}")
        return False
    save_whole(path, to_xml(document))
    name = os.path.basename(path)
    findings.warning(f"this file holds source parts alone; finish it with: sbfmt build {name} -o {name}. "
                     f"The compiled library {sbfmt.library_fault()}")
    return True


# Command line terms in the library's messages, and Blender's terms for them.
IN_BLENDER = ((", for example --material flesh", ", in Scene > Soft body format > What a build makes"),
              ("(--cell, --elements)", "(Scene > Soft body format > What a build makes)"),
              ("(--elements, --cell)", "(Scene > Soft body format > What a build makes)"),
              ("convert the source with --unit", "scale all of it and apply the scale, or set the scene's Unit Scale"),
              (", as --fix does", ", as Check's button does"), (", or by --fix", ", or by Check's button"))


def in_blender(message):
    for typed, shown in IN_BLENDER:
        message = message.replace(typed, shown)
    return message


def add(found, findings, locator=None):
    """Adds a diagnostic of the library to the findings, with its object and bone."""
    add = {"error": findings.error, "warning": findings.warning}.get(found.severity, findings.info)
    add(in_blender(found.message), code=found.code, **(locator.locate(found) if locator else {}))
