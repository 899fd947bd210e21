"""Scene > Soft body format: the gait."""

import bpy

from .list_buttons import draw_list


class ScenePanel:
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "scene"


class SBFMT_PT_scene(ScenePanel, bpy.types.Panel):
    bl_label = "Soft body format"

    def draw(self, context):
        layout, settings = self.layout, context.scene.soft_body_format
        layout.use_property_split = True
        layout.prop(settings, "ahead")
        layout.prop(settings, "ground")


class GaitPanel(ScenePanel):
    bl_parent_id = "SBFMT_PT_gait"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        gait = context.scene.soft_body_format.gait
        return gait.use and gait.armature is not None


class SBFMT_PT_gait(ScenePanel, bpy.types.Panel):
    bl_label = "Gait"
    bl_parent_id = "SBFMT_PT_scene"

    def draw_header(self, context):
        self.layout.prop(context.scene.soft_body_format.gait, "use", text="")

    def draw(self, context):
        layout, gait = self.layout, context.scene.soft_body_format.gait
        layout.use_property_split = True
        layout.operator("sbfmt.propose_gait", icon="ARMATURE_DATA")
        layout = layout.column()
        layout.active = gait.use
        layout.prop(gait, "armature")
        if gait.armature is None:
            return
        for name in ("body", "hips", "chest"):
            layout.prop_search(gait, name, gait.armature.data, "bones")
        column = layout.column(align=True)
        for name in ("step_height", "step_width", "step_trigger", "step_duration", "walk_speed", "hip_tilt", "body_tilt"):
            column.prop(gait, name)


class ListPanel(GaitPanel):
    """A list of the gait, the bones that the chosen entry names, and its numbers."""

    items, active, bones, numbers = "", "", (), ()

    def draw(self, context):
        layout, gait = self.layout, context.scene.soft_body_format.gait
        layout.use_property_split = True
        entry = draw_list(layout, gait, f"scene.gait.{self.items}", self.active)
        if entry is None:
            return
        for name in self.bones:
            layout.prop_search(entry, name, gait.armature.data, "bones")
        for name in self.numbers:
            layout.prop(entry, name)
        self.draw_more(layout, entry)

    def draw_more(self, layout, entry):
        pass


class SBFMT_PT_legs(ListPanel, bpy.types.Panel):
    bl_label = "Legs"
    items, active, bones, numbers = "legs", "active_leg", ("root", "end"), ("solver", "group")

    def draw_more(self, layout, entry):
        for name in ("home", "pole"):
            layout.prop(entry, f"use_{name}")
            if getattr(entry, f"use_{name}"):
                layout.prop(entry, name)


class SBFMT_PT_head(GaitPanel, bpy.types.Panel):
    bl_label = "Head"

    def draw(self, context):
        layout, gait = self.layout, context.scene.soft_body_format.gait
        layout.use_property_split = True
        layout.prop_search(gait, "head", gait.armature.data, "bones")
        layout.prop(gait, "head_lead")
        layout.prop(gait, "head_limit")


class SBFMT_PT_tails(ListPanel, bpy.types.Panel):
    bl_label = "Tails"
    items, active, bones, numbers = "tails", "active_tail", ("root", "end"), ("frequency", "damping_ratio", "limit")


class SBFMT_PT_followers(ListPanel, bpy.types.Panel):
    bl_label = "Followers"
    items, active, bones = "followers", "active_follower", ("bone", )
    numbers = ("channel", "frequency", "damping_ratio", "response", "axis", "strength", "limit")


GAIT_CLASSES = (SBFMT_PT_gait, SBFMT_PT_legs, SBFMT_PT_head, SBFMT_PT_tails, SBFMT_PT_followers)
