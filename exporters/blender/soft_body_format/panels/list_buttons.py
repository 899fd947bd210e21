"""Draws lists of pins, legs and so on, with buttons to add, remove and move entries. All lists share one operator."""

import bpy
from bpy.props import EnumProperty, StringProperty


def owner_of(context, path):
    """The property group that holds a list: `path` is below the active object or the scene."""
    root, rest = path.split(".", 1)
    found = context.scene.soft_body_format if root == "scene" else context.object.soft_body_format
    for name in rest.split(".")[:-1]:
        found = getattr(found, name)
    return found, rest.rsplit(".", 1)[-1]


class SBFMT_OT_list_edit(bpy.types.Operator):
    """Add, remove or move an entry of the list"""

    bl_idname = "sbfmt.list_edit"
    bl_label = "Edit list"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    path: StringProperty()
    active: StringProperty()
    action: EnumProperty(items=(("ADD", "Add", ""), ("REMOVE", "Remove", ""), ("UP", "Up", ""), ("DOWN", "Down", "")))

    def execute(self, context):
        owner, name = owner_of(context, self.path)
        items, index = getattr(owner, name), getattr(owner, self.active)
        if self.action == "ADD":
            items.add()
            index = len(items) - 1
        elif self.action == "REMOVE" and index < len(items):
            items.remove(index)
            index = max(0, index - 1)
        else:
            wanted = index + (1 if self.action == "DOWN" else -1)
            if 0 <= wanted < len(items):
                items.move(index, wanted)
                index = wanted
        setattr(owner, self.active, index)
        return {"FINISHED"}


class SBFMT_UL_entries(bpy.types.UIList):
    """One line for each entry: the first of its names that is not empty."""

    def draw_item(self, _context, layout, _data, item, _icon, _active_data, _active_name, _index):
        words = [getattr(item, name, "") for name in ("group", "root", "bone", "end", "attribute")]
        layout.label(text=" → ".join(one for one in words if one and isinstance(one, str)) or "(nothing chosen)")


def draw_list(layout, owner, path, active):
    """Draws the list and its buttons."""
    name = path.rsplit(".", 1)[-1]
    row = layout.row()
    row.template_list("SBFMT_UL_entries", path, owner, name, owner, active, rows=3)
    column = row.column(align=True)
    for action, icon in (("ADD", "ADD"), ("REMOVE", "REMOVE"), ("UP", "TRIA_UP"), ("DOWN", "TRIA_DOWN")):
        button = column.operator(SBFMT_OT_list_edit.bl_idname, icon=icon, text="")
        button.path, button.active, button.action = path, active, action
    items, index = getattr(owner, name), getattr(owner, active)
    return items[index] if index < len(items) else None


CLASSES = (SBFMT_OT_list_edit, SBFMT_UL_entries)
