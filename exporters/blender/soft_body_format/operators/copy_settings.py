"""Copies settings of the active object or bone to the selected ones, or to the other side of the body."""

import bpy
from bpy.props import BoolProperty, EnumProperty

PARTS = {"ROLE": ("role", "simulation_only"), "MATERIAL": ("attributes", "own_values"),
         "COLLISION": ("particle_radius", "outer_thickness", "inner_thickness", "self_collision"),
         "PINS": ("pins", "active_pin"), "MAPS": ("weight_maps", "active_weight_map")}
# The mirrored bone has the opposite sign for rotation about the bone and about its Z axis, and for sliding along X.
TURNED = ("twist", "swing_y")


def copy_group(source, target, names=None):
    """Copies the values of a property group, including groups and lists in it. Does not copy ids."""
    for one in source.bl_rna.properties:
        name = one.identifier
        if name in ("rna_type", "name", "order") or name.endswith("identity") or names is not None and name not in names:
            continue
        if one.type == "COLLECTION":
            target_list = getattr(target, name)
            target_list.clear()
            for entry in getattr(source, name):
                copy_group(entry, target_list.add())
        elif one.type == "POINTER" and isinstance(getattr(source, name), bpy.types.PropertyGroup):
            copy_group(getattr(source, name), getattr(target, name))
        else:
            setattr(target, name, getattr(source, name))


def mirror_joint(joint):
    """Mirrors the limits for a bone of the other side. Its axes are mirrored as Blender's Symmetrize mirrors them."""
    turned = TURNED if joint.kind == "spherical" else ("twist", ) if joint.axis != "X" else ()
    if joint.kind != "spherical" and joint.axis == "X":
        turned += ("slide", )
    for name in turned:
        low, high = getattr(joint, f"{name}_min"), getattr(joint, f"{name}_max")
        setattr(joint, f"{name}_min", -high)
        setattr(joint, f"{name}_max", -low)


class SBFMT_OT_copy_object(bpy.types.Operator):
    """Copy the active object's settings in these panels to the selected objects"""

    bl_idname = "sbfmt.copy_object"
    bl_label = "Copy to selected"
    bl_options = {"REGISTER", "UNDO"}

    parts: EnumProperty(name="What", options={"ENUM_FLAG"}, default={"MATERIAL", "COLLISION"}, items=(
        ("ROLE", "Role", "What the object is for"), ("MATERIAL", "Material", "With pressure, yield and tear"),
        ("COLLISION", "Collision", "Thicknesses and radius"), ("PINS", "Pins", "Sets, by the names of their vertex groups"),
        ("MAPS", "Painted attributes", "By the names of their vertex groups")))

    @classmethod
    def poll(cls, context):
        others = [one for one in context.selected_objects if one != context.object and one.type == "MESH"]
        if context.object is None or not others:
            cls.poll_message_set("Select other meshes too, this one last")
            return False
        return True

    def execute(self, context):
        names = [name for part in self.parts for name in PARTS[part]]
        others = [one for one in context.selected_objects if one != context.object and one.type == "MESH"]
        for one in others:
            copy_group(context.object.soft_body_format, one.soft_body_format, names)
        self.report({"INFO"}, f"copied to {len(others)} objects")
        return {"FINISHED"}


class SBFMT_OT_copy_bone(bpy.types.Operator):
    """Copy the active bone's joint and material to other bones"""

    bl_idname = "sbfmt.copy_bone"
    bl_label = "Copy to selected"
    bl_options = {"REGISTER", "UNDO"}

    other_side: BoolProperty(name="To the other side", default=False,
                             description="To the bone of the other side, by its name, with limits mirrored")

    @classmethod
    def poll(cls, context):
        return context.bone is not None and context.object is not None and context.object.type == "ARMATURE"

    def targets(self, context):
        bones = context.object.data.bones
        if self.other_side:
            other = bones.get(bpy.utils.flip_name(context.bone.name))
            return [other] if other is not None and other.name != context.bone.name else []
        chosen = {pose.name for pose in context.object.pose.bones
                  if (pose.select if hasattr(pose, "select") else pose.bone.select)}
        return [bone for bone in bones if bone.name in chosen and bone.name != context.bone.name]

    def execute(self, context):
        targets = self.targets(context)
        if not targets:
            self.report({"INFO"}, f"{context.bone.name} has no bone on the other side: their names differ by .L and .R, or left and right"
                        if self.other_side else "no other bone is selected: select some in pose mode, the active one last")
            return {"CANCELLED"}
        for bone in targets:
            copy_group(context.bone.soft_body_format, bone.soft_body_format)
            if self.other_side:
                mirror_joint(bone.soft_body_format.joint)
        self.report({"INFO"}, f"copied to {', '.join(bone.name for bone in targets)}")
        return {"FINISHED"}


CLASSES = (SBFMT_OT_copy_object, SBFMT_OT_copy_bone)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
