"""sbfmt for Python: soft-bodied characters in one file, through the installed shared library.

    import sbfmt
    asset = sbfmt.convert("lizard.obj", rig="lizard.glb")
    asset = asset.build(progress=lambda name, share: print(name, share) or True)
    print(asset.info()["sections"], asset.validate().valid)
    asset.save("lizard.sbfz")

Only Python's standard library is needed, and libsbfmt-interchange, built shared (-DBUILD_SHARED_LIBS=ON). It is looked for
where SBFMT_LIBRARY says (the file, or its folder), beside this package, and where the system keeps libraries.

Functions raise `Error`, which has `code`, `path`, `file` and `line`. Assets are never changed: `build` gives a new one.
Different threads may use different assets, and read one asset together.
"""

from .asset import Asset, Validation, convert, load, load_document, propose_gait, stand
from .library import library_fault, library_path, library_version
from .messages import Cancelled, Diagnostic, Error

__all__ = ["Asset", "Cancelled", "Diagnostic", "Error", "Validation", "convert", "library_fault", "library_path", "library_version",
           "load", "load_document", "propose_gait", "stand"]
