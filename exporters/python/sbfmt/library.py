"""Finds and loads the shared library, and declares its structures and calls for ctypes.

The structures match base.h, packed.h, build.h, convert.h, validate.h and export.h of this version. A newer library accepts them
too, because options start with their size and grow only at the end.
"""

import contextlib
import ctypes
import ctypes.util
import functools
import glob
import os
import platform
import re
import shutil
import tempfile
from ctypes import POINTER, Structure, c_bool, c_char, c_char_p, c_double, c_float, c_int, c_int32, c_int64, c_size_t, \
    c_uint32, c_uint64, c_void_p

from .messages import SEVERITIES, Cancelled, Diagnostic, Error

NAME = "sbfmt-interchange"
# This system, as Blender names platforms; an add-on has a folder of libraries for each.
PLATFORM = "-".join(({"Darwin": "macos"}.get(platform.system(), platform.system().lower()),
                     {"x86_64": "x64", "amd64": "x64", "aarch64": "arm64"}.get(platform.machine().lower(), platform.machine().lower())))
FOLDERS = (os.path.dirname(os.path.abspath(__file__)),
           os.path.join(os.path.dirname(os.path.abspath(__file__)), "lib", PLATFORM))
OK, BAD_INPUT, FAILED = range(3)


class DiagnosticStruct(Structure):
    _fields_ = [("code", c_int32), ("severity", c_int), ("message", c_char * 384), ("path", c_char * 256),
                ("file", c_char * 256), ("line", c_uint32), ("offset", c_int64), ("index", c_int64)]


Report = ctypes.CFUNCTYPE(None, c_void_p, POINTER(DiagnosticStruct))
Progress = ctypes.CFUNCTYPE(c_bool, c_void_p, c_char_p, c_double)


class CodeInfo(Structure):
    _fields_ = [("name", c_char_p), ("code", c_int), ("severity", c_int), ("fault", c_int), ("text", c_char_p)]


class Limits(Structure):
    _fields_ = [("file_bytes", c_uint64), ("memory_bytes", c_uint64), ("inflated_bytes", c_uint64),
                ("inflate_ratio", c_uint32), ("list_items", c_uint32), ("depth", c_uint32)]


class GivenList(Structure):
    _fields_ = [("at", c_void_p), ("size", c_size_t)]


class LoadOptions(Structure):
    _fields_ = [("struct_size", c_size_t), ("allocator", c_void_p), ("limits", Limits), ("check_crc", c_bool),
                ("name", c_char_p), ("extensions", POINTER(c_char_p)), ("extension_count", c_uint32),
                ("selection", c_void_p), ("copy_file", c_bool), ("read_bytes", POINTER(c_uint64)), ("outline", c_bool),
                ("repairable", c_bool), ("given_lists", POINTER(GivenList)), ("given_list_count", c_uint32),
                ("report", Report), ("user", c_void_p), ("with_images", c_bool)]


class SaveOptions(Structure):
    _fields_ = [("struct_size", c_size_t), ("store", c_bool), ("level", c_int)]


class BuildOptions(Structure):
    _fields_ = [("struct_size", c_size_t), ("allocator", c_void_p), ("tool", c_char_p), ("interior", c_int),
                ("without_flexion", c_bool), ("without_embeddings", c_bool), ("without_hulls", c_bool),
                ("progress", Progress), ("report", Report), ("user", c_void_p), ("cell_m", c_double),
                ("elements", c_uint32), ("sections", c_int), ("overlap_m", c_double),
                ("without_calibration", c_bool), ("levels", c_uint32), ("error_m", c_double),
                ("render_levels", c_uint32), ("render_error_m", c_double)]


class ConvertPin(Structure):
    _fields_ = [("group", c_char_p), ("bone", c_char_p)]


class ConvertAttachment(Structure):
    _fields_ = [("body", c_char_p), ("holder", c_char_p)]


class ConvertPinning(Structure):
    _fields_ = [("pins", POINTER(ConvertPin)), ("pin_count", c_uint32), ("goal_minimum", c_double),
                ("goal_maximum", c_double), ("goal_stiffness", c_double), ("section_pins", POINTER(ConvertPin)),
                ("section_pin_count", c_uint32)]


class ConvertRigging(Structure):
    _fields_ = [("weights", c_char_p), ("shells", POINTER(ConvertPin)), ("shell_count", c_uint32),
                ("misfit", POINTER(c_void_p))]


class ConvertSoftness(Structure):
    _fields_ = [("firmness", c_double), ("soft", POINTER(c_char_p)), ("soft_count", c_uint32),
                ("rigid", POINTER(c_char_p)), ("rigid_count", c_uint32)]


class ConvertOptions(Structure):
    _fields_ = [("struct_size", c_size_t), ("allocator", c_void_p), ("rig", c_char_p), ("unit_m", c_double),
                ("up", c_char), ("forward", c_char_p), ("no_gait", c_bool), ("gait", c_char_p), ("import_helper", c_char_p),
                ("report", Report), ("user", c_void_p), ("summary", c_void_p), ("limits", c_int), ("keep_modulus", c_bool),
                ("pinning", ConvertPinning), ("attachments", POINTER(ConvertAttachment)), ("attachment_count", c_uint32),
                ("rigging", ConvertRigging), ("softness", ConvertSoftness)]


class ValidateOptions(Structure):
    _fields_ = [("struct_size", c_size_t), ("allocator", c_void_p), ("repeats", c_uint32), ("report", Report),
                ("user", c_void_p), ("folder", c_char_p)]


class ValidateResult(Structure):
    _fields_ = [("errors", c_uint32), ("warnings", c_uint32), ("infos", c_uint32)]


class FixOptions(Structure):
    _fields_ = [("struct_size", c_size_t), ("allocator", c_void_p), ("without_build", c_bool), ("report", Report), ("user", c_void_p)]


class FixResult(Structure):
    _fields_ = [("repaired", c_uint32), ("rebuilt", c_bool)]


class ExportOptions(Structure):
    _fields_ = [("struct_size", c_size_t), ("allocator", c_void_p), ("report", Report), ("user", c_void_p),
                ("render_level", c_uint32), ("folder", ctypes.c_char_p), ("motion", c_void_p), ("soft_bodies", c_bool),
                ("store", c_bool), ("compression", c_int), ("images", c_void_p)]


class ConvertStance(Structure):
    _fields_ = [("struct_size", c_size_t), ("quarter_turns", c_uint32), ("ground_m", c_double), ("height_m", c_double)]


class Buffer(Structure):
    _fields_ = [("at", POINTER(ctypes.c_uint8)), ("size", c_size_t), ("reallocate", c_void_p), ("user", c_void_p),
                ("capacity", c_size_t)]


class AssetMeasures(Structure):
    _fields_ = [("mass", c_double), ("bounded", c_bool), ("low", c_float * 3), ("high", c_float * 3)]


# Options whose struct_size the library compares with its own. Tests compare their sizes with the library.
OPTIONS = {"sbf_load_options": LoadOptions, "sbf_given_list": GivenList, "sbf_save_options": SaveOptions, "sbf_build_options": BuildOptions,
           "sbf_convert_options": ConvertOptions, "sbf_convert_stance": ConvertStance, "sbf_validate_options": ValidateOptions,
           "sbf_export_options": ExportOptions, "sbf_diagnostic": DiagnosticStruct, "sbf_buffer": Buffer,
           "sbf_validate_result": ValidateResult, "sbf_asset_measures": AssetMeasures, "sbf_code_info": CodeInfo,
           "sbf_fix_options": FixOptions, "sbf_fix_result": FixResult}

CALLS = {
    "sbf_load_file": [c_char_p, POINTER(LoadOptions), POINTER(c_void_p), POINTER(DiagnosticStruct)],
    "sbf_save_file": [c_void_p, c_char_p, POINTER(SaveOptions), POINTER(DiagnosticStruct)],
    "sbf_xml_load_memory": [c_char_p, c_size_t, POINTER(LoadOptions), POINTER(c_void_p), POINTER(DiagnosticStruct)],
    "sbf_xml_save_memory": [c_void_p, POINTER(SaveOptions), c_void_p, POINTER(Buffer), POINTER(DiagnosticStruct)],
    "sbf_build": [c_void_p, POINTER(BuildOptions), POINTER(c_void_p), c_void_p, POINTER(DiagnosticStruct)],
    "sbf_convert": [c_char_p, POINTER(ConvertOptions), POINTER(c_void_p), POINTER(DiagnosticStruct)],
    "sbf_convert_gait": [c_void_p, POINTER(ConvertOptions), POINTER(DiagnosticStruct)],
    "sbf_convert_stand": [c_void_p, POINTER(ConvertOptions), POINTER(ConvertStance), POINTER(c_int32), POINTER(DiagnosticStruct)],
    "sbf_validate": [c_void_p, POINTER(ValidateOptions), POINTER(ValidateResult), POINTER(DiagnosticStruct)],
    "sbf_fix": [c_void_p, POINTER(FixOptions), POINTER(c_void_p), POINTER(FixResult), POINTER(DiagnosticStruct)],
    "sbf_export": [c_void_p, c_char_p, POINTER(ExportOptions), POINTER(DiagnosticStruct)],
}


def candidates():
    """Paths where the library may be, in order: from the environment, beside the package, from the system."""
    named = os.environ.get("SBFMT_LIBRARY")
    folders = FOLDERS
    if named:
        if not os.path.isdir(named):
            return [named]
        folders = (named,)
    found = [path for folder in folders for pattern in (f"lib{NAME}.so", f"lib{NAME}.so.*", f"lib{NAME}.dylib", f"{NAME}.dll")
             for path in sorted(glob.glob(os.path.join(folder, pattern)))]
    system = None if named else ctypes.util.find_library(NAME)
    return found + ([system] if system else [])


def opened(path):
    """The library at a path. An add-on's library is loaded from a copy. Blender overwrites the files of an add-on when it updates it,
    and a process crashes if a library that it has loaded changes."""
    if os.path.dirname(path) != FOLDERS[1]:
        return ctypes.CDLL(path)
    handle, copy = tempfile.mkstemp(suffix=os.path.basename(path))
    os.close(handle)
    try:
        shutil.copyfile(path, copy)
        loaded = ctypes.CDLL(copy)
        loaded._name = path  # pylint: disable=protected-access
        return loaded
    finally:
        with contextlib.suppress(OSError):  # Windows locks loaded files
            os.unlink(copy)


def fault_in_words(said):
    """Turns an error of the system's loader into advice."""
    system = f"{platform.system()} on {platform.machine()}"
    newer = re.search(r"version `GLIBC_([\d.]+)' not found", said)
    lacking = re.search(r"([^\s:]+): cannot open shared object file", said)
    if newer:
        return f"needs glibc {newer[1]} or newer, and this system's is older ({platform.libc_ver()[1] or 'of unknown version'}): update the system"
    if lacking and os.sep not in lacking[1]:
        return f"needs {lacking[1]}, which this system does not have: install it, or take the zip of a release, which needs none"
    if re.search(r"wrong ELF class|invalid ELF header|not a valid Win32|incompatible architecture|not a mach-o|slice is not valid", said):
        return f"is made for another system than this, {system}: take the zip for it"
    return f"cannot be loaded: {said}"


@functools.lru_cache(maxsize=None)
def loaded_library():
    """The library, loaded once, or None; and each path that was tried, with the loader's error."""
    tried = []
    for path in candidates():
        try:
            return declare(opened(path)), tried
        except OSError as error:
            tried.append((path, str(error)))
    return None, tried


def library():
    """The library."""
    loaded, tried = loaded_library()
    if loaded is None:
        raise ImportError(f"lib{NAME} is not found: install sbfmt built with -DBUILD_SHARED_LIBS=ON, or let SBFMT_LIBRARY name the"
                          " library or its folder" + "".join(f"\n  {path}: {said}" for path, said in tried))
    return loaded


def library_fault():
    """None if there is a library; else the reason and what to do, as the end of a sentence about the library."""
    loaded, tried = loaded_library()
    if loaded is not None:
        return None
    if tried:
        return fault_in_words(tried[0][1])
    return f"is not there for {platform.system()} on {platform.machine()}: take the zip for it, or build it (docs/packages.md)"


def declare(loaded):
    for name, arguments in CALLS.items():
        function = getattr(loaded, name)
        function.argtypes, function.restype = arguments, c_int
    loaded.sbf_asset_free.argtypes, loaded.sbf_asset_free.restype = [c_void_p], None
    loaded.sbf_buffer_free.argtypes, loaded.sbf_buffer_free.restype = [POINTER(Buffer)], None
    loaded.sbf_asset_measure.argtypes, loaded.sbf_asset_measure.restype = [c_void_p, POINTER(AssetMeasures)], None
    loaded.sbf_asset_equal.argtypes = [c_void_p, c_void_p, c_char_p, c_size_t]
    loaded.sbf_asset_equal.restype = c_bool
    loaded.sbf_code_find.argtypes, loaded.sbf_code_find.restype = [c_int32], POINTER(CodeInfo)
    return loaded


def library_path():
    """The path of the loaded library."""
    return library()._name  # pylint: disable=protected-access


def library_version():
    """The format version that the library writes, read from a saved empty asset."""
    create = library().sbf_asset_create
    create.argtypes, create.restype = [c_void_p], c_void_p
    made = create(None)
    buffer, error = Buffer(), DiagnosticStruct()
    try:
        check(library().sbf_xml_save_memory(made, None, None, ctypes.byref(buffer), ctypes.byref(error)), error)
        text = ctypes.string_at(buffer.at, buffer.size).decode()
    finally:
        library().sbf_buffer_free(ctypes.byref(buffer))
        library().sbf_asset_free(made)
    return text.split('version="')[2].split('"')[0]


def diagnostic_of(found):
    info = library().sbf_code_find(found.code)
    code = info.contents.name.decode() if info else "NONE"
    return Diagnostic(code, SEVERITIES[found.severity], *(text.decode("utf-8", "replace") for text in
                                                          (found.message, found.path, found.file)),
                      found.line, found.offset, found.index)


def check(status, error):
    """Raises if a call failed."""
    if status != OK:
        found = diagnostic_of(error)
        raise (Cancelled if found.code == "CANCELLED" else Error)(found, "input" if status == BAD_INPUT else "call")


class Callbacks:
    """Python callbacks as C callbacks. An exception in one stops the work; the call raises it again."""

    def __init__(self, report, progress=None):
        self.raised = None
        self.report = Report(lambda _user, found: self.guard(report, diagnostic_of(found.contents))) if report else Report()
        self.progress = Progress(lambda _user, name, fraction: self.continue_work(progress, name.decode(), fraction)) if progress \
            else Progress()

    def guard(self, function, *arguments):
        try:
            return function(*arguments)
        except BaseException as error:  # pylint: disable=broad-except
            self.raised = self.raised or error
            return None

    def continue_work(self, progress, name, fraction):
        """Whether to continue: False or an exception stops, anything else (also None) continues."""
        answer = self.guard(progress, name, fraction)
        return self.raised is None and answer is not False

    def check(self, status, error):
        if self.raised is not None:
            raise self.raised
        check(status, error)
