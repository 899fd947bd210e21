"""Scene > Soft body format: the gait."""

import bpy

from .list_buttons import draw_list


class ScenePanel:
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "scene"


class SBFMT_PT_scene(ScenePanel, bpy.types.Panel):
    bl_label = "Soft body format"

    def draw(self, _context):
        pass


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
        layout.active = gait.use
        layout.prop(gait, "armature")
        if gait.armature is None:
            return
        for name in ("body", "hips", "chest"):
            layout.prop_search(gait, name, gait.armature.data, "bones")
        column = layout.column(align=True)
        for name in ("step_height", "step_width", "step_trigger", "step_duration", "walk_speed", "hip_tilt", "body_tilt"):
            column.prop(gait, name)


class SBFMT_PT_legs(GaitPanel, bpy.types.Panel):
    bl_label = "Legs"

    def draw(self, context):
        layout, gait = self.layout, context.scene.soft_body_format.gait
        layout.use_property_split = True
        leg = draw_list(layout, gait, "scene.gait.legs", "active_leg")
        if leg is None:
            return
        for name in ("root", "end"):
            layout.prop_search(leg, name, gait.armature.data, "bones")
        for name in ("solver", "group"):
            layout.prop(leg, name)
        for name in ("home", "pole"):
            layout.prop(leg, f"use_{name}")
            if getattr(leg, f"use_{name}"):
                layout.prop(leg, name)


class SBFMT_PT_head(GaitPanel, bpy.types.Panel):
    bl_label = "Head"

    def draw(self, context):
        layout, gait = self.layout, context.scene.soft_body_format.gait
        layout.use_property_split = True
        layout.prop_search(gait, "head", gait.armature.data, "bones")
        layout.prop(gait, "head_lead")
        layout.prop(gait, "head_limit")


class SBFMT_PT_tails(GaitPanel, bpy.types.Panel):
    bl_label = "Tails"

    def draw(self, context):
        layout, gait = self.layout, context.scene.soft_body_format.gait
        layout.use_property_split = True
        tail = draw_list(layout, gait, "scene.gait.tails", "active_tail")
        if tail is None:
            return
        for name in ("root", "end"):
            layout.prop_search(tail, name, gait.armature.data, "bones")
        for name in ("frequency", "damping_ratio", "limit"):
            layout.prop(tail, name)


class SBFMT_PT_followers(GaitPanel, bpy.types.Panel):
    bl_label = "Followers"

    def draw(self, context):
        layout, gait = self.layout, context.scene.soft_body_format.gait
        layout.use_property_split = True
        follower = draw_list(layout, gait, "scene.gait.followers", "active_follower")
        if follower is None:
            return
        layout.prop_search(follower, "bone", gait.armature.data, "bones")
        for name in ("channel", "frequency", "damping_ratio", "response"):
            layout.prop(follower, name)


CLASSES = (SBFMT_PT_scene, SBFMT_PT_gait, SBFMT_PT_legs, SBFMT_PT_head, SBFMT_PT_tails, SBFMT_PT_followers)
