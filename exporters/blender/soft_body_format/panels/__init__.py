"""Panels of the properties editor: Object, Bone and Scene > Soft body format."""

import bpy

from . import bone_panel, build_panel, check_panel, list_buttons, object_panels, preview_panels, scene_panels

# Below Scene > Soft body format in this order.
CLASSES = list_buttons.CLASSES + object_panels.CLASSES + bone_panel.CLASSES + (scene_panels.SBFMT_PT_scene, ) + \
    check_panel.CLASSES + build_panel.CLASSES + preview_panels.CLASSES + scene_panels.GAIT_CLASSES

register, unregister = bpy.utils.register_classes_factory(CLASSES)
