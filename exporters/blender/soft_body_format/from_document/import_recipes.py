"""Imports materials of sections as settings of the scene panel and the bone panels."""

from ..settings.attributes import read_attributes


def fill_recipes(scene, document, armature, names):
    for recipe in document.section_recipes:
        if recipe.bone is None:
            settings = scene.soft_body_format.build
        elif armature is not None:
            settings = armature.data.bones[names[recipe.bone]].soft_body_format
            settings.rigid, settings.proposed, settings.elements = recipe.rigid, recipe.proposed, recipe.elements
        else:
            continue
        settings.use_material = True
        read_attributes(settings.attributes, recipe.attributes)
