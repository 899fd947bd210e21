"""sbfmt for Python: soft-bodied characters in one file, through the installed shared library.

    import sbfmt
    asset = sbfmt.convert("lizard.obj", rig="lizard.glb")
    asset = asset.build(progress=lambda name, share: print(name, fraction) or True)
    print(asset.info()["sections"], asset.validate().valid)
    asset.save("lizard.sbfz")

The package needs only Python's standard library and libsbfmt-interchange, built shared (-DBUILD_SHARED_LIBS=ON). It looks for the
library at SBFMT_LIBRARY (the file, or its folder), beside this package, and in the system's library folders.

Functions raise `Error`, which has `code`, `path`, `file` and `line`. Assets never change: `build` returns a new one.
Different threads may use different assets, and may read the same asset.
"""

from .asset import Asset, Validation, convert, load, load_document, propose_gait, stand
from .library import library_fault, library_path, library_version
from .messages import Cancelled, Diagnostic, Error

__all__ = ["Asset", "Cancelled", "Diagnostic", "Error", "Validation", "convert", "library_fault", "library_path", "library_version",
           "load", "load_document", "propose_gait", "stand"]
