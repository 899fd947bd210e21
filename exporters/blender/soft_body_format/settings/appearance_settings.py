"""Properties of materials and images that identify them in the file they were imported from. No panel shows them."""

import bpy
from bpy.props import StringProperty


class SBFMT_PG_material(bpy.types.PropertyGroup):
    identity: StringProperty(options={"HIDDEN"}, description="Id in the file it was imported from")


class SBFMT_PG_image(bpy.types.PropertyGroup):
    identity: StringProperty(options={"HIDDEN"}, description="Id in the file it was imported from")
    path: StringProperty(options={"HIDDEN"}, description="Path from that file's folder")


CLASSES = (SBFMT_PG_material, SBFMT_PG_image)
