"""Collections of copies that stand for the artist's objects, whose eyes are closed meanwhile: what a preview shows and a bake leaves.

Everything can be put back from the .blend alone: after an undo, or in a file that was saved by a Blender that broke down."""

import json

import bpy

HIDDEN = "soft_body_format_hidden"
COPY_OF = "soft_body_format_copy_of"


def begin(scene, name):
    """An empty collection; an earlier one of that name goes."""
    strike(name)
    collection = bpy.data.collections.new(name)
    scene.collection.children.link(collection)
    return collection


def add(collection, made, source):
    """`made` is a copy of the object of the name `source`; it is never exported."""
    made.soft_body_format.role = "IGNORE"
    made[COPY_OF] = source
    collection.objects.link(made)
    return made


def hide_originals(collection, scene, layer, names):
    """Closes the eyes of what is seen of those objects."""
    hidden = [name for name in names if name in scene.objects and not scene.objects[name].hide_get(view_layer=layer)]
    for name in hidden:
        scene.objects[name].hide_set(True, view_layer=layer)
    collection[HIDDEN] = json.dumps(hidden)


def strike(name):
    """Takes the copies away and opens the eyes again, whoever made them; says whether there were any."""
    collection = bpy.data.collections.get(name)
    if collection is None:
        return False
    hidden = json.loads(collection.get(HIDDEN, "[]"))
    for made in list(collection.objects):
        data = made.data
        bpy.data.objects.remove(made)
        if isinstance(data, bpy.types.Mesh) and data.users == 0:
            bpy.data.meshes.remove(data)
    bpy.data.collections.remove(collection)
    for scene in bpy.data.scenes:
        for layer in scene.view_layers:
            for one in hidden:
                if one in layer.objects:
                    layer.objects[one].hide_set(False, view_layer=layer)
    return True
