"""Soft-bodied characters in one file, from Blender and back."""

bl_info = {
    "name": "Soft body format",
    "author": "The sbfmt authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Export, File > Import, Properties > Object, Bone, Scene",
    "description": "Soft-bodied characters in one file: mesh, rig, springs, pins, limits, gait",
    "category": "Import-Export",
}

from . import panels, preview, settings  # noqa: E402
from .operators import (bake_preview, build_scene, check_scene, copy_settings, export, import_bundle, live_check,  # noqa: E402
                        preview_scene, propose_gait)
from .overlay import joints, structure  # noqa: E402

PARTS = (settings, panels, export, import_bundle, build_scene, check_scene, preview_scene, propose_gait, bake_preview, copy_settings, structure, joints, preview,
         live_check)


def register():
    for part in PARTS:
        part.register()


def unregister():
    for part in reversed(PARTS):
        part.unregister()
