"""Assets: load, convert, build, validate, save."""

import ctypes
import os
import weakref
import xml.etree.ElementTree as ElementTree

from .description import describe
from .document.reading import from_xml
from .document.writing import to_parts
from .library import AssetMeasures, Buffer, BuildOptions, Callbacks, ConvertAttachment, ConvertOptions, ConvertPin, ConvertPinning, \
    ConvertStance, DiagnosticStruct, ExportOptions, FixOptions, FixResult, GivenList, LoadOptions, OK, SaveOptions, ValidateOptions, \
    ValidateResult, check, library

INTERIORS = ("automatic", "centroid", "none", "lattice", "brute", "tetrahedra", "shape_matching")
LIMITS = ("none", "human", "quadruped", "reptile")


class Validation:
    """Result of a validation. `findings` is a list of Diagnostic; `valid` is True if none of them is an error."""

    def __init__(self, result, findings):
        self.errors, self.warnings, self.infos = result.errors, result.warnings, result.infos
        self.valid = result.errors == 0
        self.findings = findings


def path_bytes(path):
    return os.fsencode(path) if path is not None else None


class Asset:
    """An asset in memory. `load`, `convert` and `build` make assets; an asset never changes."""

    def __init__(self, pointer):
        self._pointer = pointer
        self._finalizer = weakref.finalize(self, library().sbf_asset_free, pointer)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Frees the memory now, without waiting for Python's garbage collection."""
        self._finalizer()
        self._pointer = None

    @property
    def pointer(self):
        """The library's `const sbf_asset *`, for further calls by ctypes."""
        if self._pointer is None:
            raise ValueError("the asset is closed")
        return self._pointer

    def save(self, path, store=False, level=0):
        """Writes a file: .sbf, .sbfz, or .glb, which any glTF viewer shows. A failure leaves the old file unchanged. `store`: no
        compression. `level`: 1 to 9 of zlib, 0: 6. A .glb embeds images from its folder."""
        error = DiagnosticStruct()
        if path_bytes(path).endswith(b".glb"):
            options = ExportOptions(struct_size=ctypes.sizeof(ExportOptions), folder=os.path.dirname(path_bytes(path)) or b".",
                                    soft_bodies=True, store=store, compression=level)
            check(library().sbf_export(self.pointer, path_bytes(path), ctypes.byref(options), ctypes.byref(error)), error)
            return
        options = SaveOptions(ctypes.sizeof(SaveOptions), store, level)
        check(library().sbf_save_file(self.pointer, path_bytes(path), ctypes.byref(options), ctypes.byref(error)), error)

    def to_xml(self):
        """The canonical XML, as bytes."""
        buffer, error = Buffer(), DiagnosticStruct()
        check(library().sbf_xml_save_memory(self.pointer, None, None, ctypes.byref(buffer), ctypes.byref(error)), error)
        try:
            return ctypes.string_at(buffer.at, buffer.size)
        finally:
            library().sbf_buffer_free(ctypes.byref(buffer))

    def export(self, path, report=None, render_level=0, folder=None):
        """Writes another program's format, chosen by the extension (.glb, .obj, .tet, .xml). `report` is called with each part that
        the format cannot hold. `render_level` of each mesh, 0: full. `folder`: folder of images that the asset names, for .glb."""
        callbacks, error = Callbacks(report), DiagnosticStruct()
        options = ExportOptions(ctypes.sizeof(ExportOptions), None, callbacks.report, None, render_level,
                                path_bytes(folder))
        callbacks.check(library().sbf_export(self.pointer, path_bytes(path), ctypes.byref(options), ctypes.byref(error)),
                        error)

    def build(self, progress=None, report=None, interior="automatic", flexion=True, embeddings=True, hulls=True, cell=0.0,
              elements=0, sections=True, overlap=0.0, calibration=True, levels=0, error=0.0,
              render_levels=0, render_error=0.0):
        """A new asset with new derived parts. `progress(step, fraction)` may return False to cancel.

        Lengths are in metres: `cell` of lattices, `overlap` of sections, largest `error` of a lattice, and
        largest `render_error` of a render level. build.h describes each option and the meaning of 0."""
        if interior not in INTERIORS:
            raise ValueError(f"interior is one of {', '.join(INTERIORS)}, not {interior!r}")
        callbacks, found, built = Callbacks(report, progress), DiagnosticStruct(), ctypes.c_void_p()
        options = BuildOptions(
            struct_size=ctypes.sizeof(BuildOptions), interior=INTERIORS.index(interior), without_flexion=not flexion,
            without_embeddings=not embeddings, without_hulls=not hulls, progress=callbacks.progress,
            report=callbacks.report, cell_m=cell, elements=elements, sections=0 if sections else 1, overlap_m=overlap,
            without_calibration=not calibration, levels=levels, error_m=error, render_levels=render_levels,
            render_error_m=render_error)
        status = library().sbf_build(self.pointer, ctypes.byref(options), ctypes.byref(built), None, ctypes.byref(found))
        made = Asset(built.value) if status == OK else None
        callbacks.check(status, found)
        return made

    def validate(self, folder=None):
        """Checks the asset against the format's rules. `folder` is the file's folder, where images are looked for."""
        findings = []
        callbacks, error, result = Callbacks(findings.append), DiagnosticStruct(), ValidateResult()
        options = ValidateOptions(ctypes.sizeof(ValidateOptions), None, 0, callbacks.report, None, path_bytes(folder))
        callbacks.check(library().sbf_validate(self.pointer, ctypes.byref(options), ctypes.byref(result),
                                               ctypes.byref(error)), error)
        return Validation(result, findings)

    def fix(self, report=None, build=True):
        """A new asset in which every fault with one right answer is repaired. `report` is called with each repair. This asset may be
        loaded with `repairable`. Without `build` stale derived parts stay."""
        callbacks, found, made = Callbacks(report), DiagnosticStruct(), ctypes.c_void_p()
        options = FixOptions(ctypes.sizeof(FixOptions), None, not build, callbacks.report, None)
        status = library().sbf_fix(self.pointer, ctypes.byref(options), ctypes.byref(made), ctypes.byref(FixResult()),
                                   ctypes.byref(found))
        fixed = Asset(made.value) if status == OK else None
        callbacks.check(status, found)
        return fixed

    def measure(self):
        """{"mass": kg, "bounds": {"min", "max"} in metres, or None if the asset has no points}."""
        found = AssetMeasures()
        library().sbf_asset_measure(self.pointer, ctypes.byref(found))
        bounds = {"min": list(found.low), "max": list(found.high)} if found.bounded else None
        return {"mass": found.mass, "bounds": bounds}

    def info(self):
        """The asset's contents as a dict; see `description`."""
        return {**describe(ElementTree.fromstring(self.to_xml())), **self.measure()}

    def equals(self, other):
        """None if both are equal, else the path of the first difference."""
        path = ctypes.create_string_buffer(512)
        same = library().sbf_asset_equal(self.pointer, other.pointer, path, len(path))
        return None if same else path.value.decode()


def load(path, check_crc=True, extensions=(), repairable=False):
    """Reads an .sbf, .sbfz or .glb file. `extensions` lists the ones that the caller understands. `repairable` accepts faults that `fix`
    can repair; then only `fix` may be called on the asset."""
    names = (ctypes.c_char_p * len(extensions))(*(name.encode() for name in extensions))
    options = LoadOptions(struct_size=ctypes.sizeof(LoadOptions), check_crc=check_crc, extension_count=len(extensions),
                          extensions=ctypes.cast(names, ctypes.POINTER(ctypes.c_char_p)), copy_file=True,
                          repairable=repairable, with_images=path_bytes(path).endswith(b".glb"))
    loaded, error = ctypes.c_void_p(), DiagnosticStruct()
    check(library().sbf_load_file(path_bytes(path), ctypes.byref(options), ctypes.byref(loaded), ctypes.byref(error)), error)
    return Asset(loaded.value)


def given(items):
    """A list of a document as a C struct. The document must outlive it."""
    if isinstance(items, bytes):
        return GivenList(ctypes.cast(ctypes.c_char_p(items), ctypes.c_void_p), len(items))
    address, count = items.buffer_info()
    return GivenList(address, count * items.itemsize)


def load_document(record, repairable=False):
    """The asset of a `document.Record`, checked like a file; `repairable` as in `load`."""
    text, lists = to_parts(record)
    options = LoadOptions(struct_size=ctypes.sizeof(LoadOptions), repairable=repairable, given_list_count=len(lists),
                          given_lists=(GivenList * len(lists))(*map(given, lists)))
    loaded, error = ctypes.c_void_p(), DiagnosticStruct()
    check(library().sbf_xml_load_memory(text, len(text), ctypes.byref(options), ctypes.byref(loaded), ctypes.byref(error)), error)
    return Asset(loaded.value)


class Stance:
    """How a character stands. `quarter_turns` about +Y from facing +Z (1: facing +X). `ground`: y of its lowest foot, in metres.
    `height` above its lowest point, in metres. `hangs_on`: {bone id: bone id} of bones that need another parent."""

    def __init__(self, found, hangs_on):
        self.quarter_turns, self.ground, self.height, self.hangs_on = found.quarter_turns, found.ground_m, found.height_m, hangs_on


def stand(record):
    """The Stance of a `document.Record`. `propose_gait` needs no turns, ground 0 and no bones that need another parent. If there are
    such bones, change their parents and call this again."""
    found, error = ConvertStance(struct_size=ctypes.sizeof(ConvertStance)), DiagnosticStruct()
    hangs_on = (ctypes.c_int32 * len(record.bones))(*[-1] * len(record.bones))
    with load_document(record) as asset:
        check(library().sbf_convert_stand(asset.pointer, None, ctypes.byref(found), hangs_on, ctypes.byref(error)), error)
    return Stance(found, {record.bones[index].id: record.bones[other].id for index, other in enumerate(hangs_on) if other >= 0})


def propose_gait(record, report=None):
    """A `document.Record` with a gait proposed for its rig, as `convert` does. A rig without legs gets no gait, and `report` is
    called. A record with a gait or chains is returned unchanged."""
    callbacks, error = Callbacks(report), DiagnosticStruct()
    with load_document(record) as asset:
        options = ConvertOptions(struct_size=ctypes.sizeof(ConvertOptions), report=callbacks.report)
        status = library().sbf_convert_gait(asset.pointer, ctypes.byref(options), ctypes.byref(error))
        callbacks.check(status, error)
        return from_xml(asset.to_xml())


def convert(path, rig=None, unit=0.0, up=None, gait=True, helper=None, report=None, pins=None, goals=(0.0, 1.0),
            goal_stiffness=0.0, limits="none", keep_modulus=False, section_pins=None, attachments=None):
    """Reads another program's file into an asset of source parts; `build` makes the rest.

    `pins` is a dict from vertex groups or bones with weights to the bone they are pinned to; "" is the world, None the bone of
    that name. `goals` are the minimum and maximum weight. `goal_stiffness` is in N/m at weight 1; 0: from the body.
    `limits` are proposed for joints without limits: none, human, quadruped or reptile.
    `keep_modulus` keeps the usual modulus of bodies without pins, even if it is too soft for their weight.
    `section_pins` is like `pins`, for sections cut from a skin; None is each section's own bone.
    `attachments` is a dict from soft bodies to an object or bone. Points inside its hull are attached to it."""
    if limits not in LIMITS:
        raise ValueError(f"limits are {', '.join(LIMITS)}, not {limits!r}")
    if up not in (None, "y", "z"):
        raise ValueError(f"up is y or z, not {up!r}")
    callbacks, made, error = Callbacks(report), ctypes.c_void_p(), DiagnosticStruct()
    pinned, in_sections = ([(group.encode(), None if bone is None else bone.encode()) for group, bone in (names or {}).items()]
                           for names in (pins, section_pins))
    attached = [(body.encode(), holder.encode()) for body, holder in (attachments or {}).items()]
    options = ConvertOptions(
        struct_size=ctypes.sizeof(ConvertOptions), rig=path_bytes(rig), unit_m=unit, up=up.encode() if up else b"\0",
        no_gait=not gait, import_helper=path_bytes(helper), report=callbacks.report, limits=LIMITS.index(limits),
        keep_modulus=keep_modulus,
        pinning=ConvertPinning((ConvertPin * len(pinned))(*pinned), len(pinned), *goals, goal_stiffness,
                               (ConvertPin * len(in_sections))(*in_sections), len(in_sections)),
        attachments=(ConvertAttachment * len(attached))(*attached), attachment_count=len(attached))
    status = library().sbf_convert(path_bytes(path), ctypes.byref(options), ctypes.byref(made), ctypes.byref(error))
    asset = Asset(made.value) if status == OK else None
    callbacks.check(status, error)
    return asset
