"""Properties that the add-on adds to objects, bones and scenes, and ids that an import stores with materials and images. Blender
saves, undoes and copies them."""

import bpy
from bpy.props import PointerProperty

from . import appearance_settings, attributes, bone_settings, build_settings, object_settings, preview_settings, scene_settings

CLASSES = attributes.CLASSES + object_settings.CLASSES + bone_settings.CLASSES + build_settings.CLASSES + \
    preview_settings.CLASSES + scene_settings.CLASSES + appearance_settings.CLASSES
OWNERS = ((bpy.types.Object, object_settings.SBFMT_PG_object), (bpy.types.Bone, bone_settings.SBFMT_PG_bone),
          (bpy.types.Scene, scene_settings.SBFMT_PG_scene), (bpy.types.Material, appearance_settings.SBFMT_PG_material),
          (bpy.types.Image, appearance_settings.SBFMT_PG_image))


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    for owner, group in OWNERS:
        owner.soft_body_format = PointerProperty(type=group, name="Soft body format")


def unregister():
    for owner, _ in OWNERS:
        del owner.soft_body_format
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
