"""Collections of copies that a preview or a bake shows in place of the user's objects, which are hidden meanwhile.

The .blend alone is enough to restore the scene: after an undo, or in a file saved before Blender crashed."""

import json

import bpy

HIDDEN = "soft_body_format_hidden"
COPY_OF = "soft_body_format_copy_of"


def begin(scene, name):
    """Makes an empty collection and removes an earlier one of that name."""
    strike(name)
    collection = bpy.data.collections.new(name)
    scene.collection.children.link(collection)
    return collection


def add(collection, made, source):
    """Adds `made`, a copy of the object with the name `source`. Copies are never exported."""
    made.soft_body_format.role = "IGNORE"
    made[COPY_OF] = source
    collection.objects.link(made)
    return made


def hide_originals(collection, scene, layer, names):
    """Hides those of the objects that are visible."""
    hidden = [name for name in names if name in scene.objects and not scene.objects[name].hide_get(view_layer=layer)]
    for name in hidden:
        scene.objects[name].hide_set(True, view_layer=layer)
    collection[HIDDEN] = json.dumps(hidden)


def strike(name):
    """Removes the copies and shows the hidden objects again. Returns whether there were copies."""
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
