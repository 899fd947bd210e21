"""Writes materials of sections that a build cuts from a skin: the scene panel's, and those of single bones."""

from ..sbfmt.document.elements import VERSION
from ..settings.attributes import fill_attributes


def write_recipes(writer):
    build = writer.scene.soft_body_format.build
    if build.use_material:
        fill_attributes(writer.asset.add("section_recipes").attributes, build.attributes)
    for armature in writer.of_type("ARMATURE"):
        for bone in armature.data.bones:
            settings = bone.soft_body_format
            identity = writer.skeleton.id(armature, bone.name)
            if settings.use_material and identity is not None:
                if settings.rigid or settings.proposed or settings.elements:
                    writer.asset.version = VERSION  # 1.0 has none of these
                recipe = writer.asset.add("section_recipes", bone=identity, rigid=settings.rigid, proposed=settings.proposed,
                                          elements=settings.elements)
                fill_attributes(recipe.attributes, settings.attributes)
