"""Selects the objects to export, and makes temporary copies of objects that exist only as instances of a collection."""

import contextlib

import bpy
from mathutils import Matrix

SCRATCH = "Soft body format, while it exports"


def on_in_renders(layer, on=True, found=None):
    """Names of objects in a layer's collections that are enabled in the outliner and in renders."""
    found = set() if found is None else found
    on = on and not layer.exclude and not layer.collection.hide_render
    if on:
        found.update(one.name_full for one in layer.collection.objects)
    for below in layer.children:
        on_in_renders(below, on, found)
    return found


def chosen_objects(context, options):
    """Objects of the view layer to export, sorted by name because the order of Blender's lists changes between sessions."""
    shown = on_in_renders(context.view_layer.layer_collection)
    wanted = {one.name_full for one in bpy.data.collections[options.collection].all_objects} if options.collection else shown
    kept = [one for one in context.view_layer.objects if one.name_full in wanted & shown and not one.hide_render and
            (one.select_get() or not options.selected_only)]
    return sorted(kept, key=lambda one: one.name_full)


def is_instance(source):
    return source.type == "EMPTY" and source.instance_type == "COLLECTION" and source.instance_collection is not None


class StandIns:
    """Copies of objects for the time of an export. They share their data with the originals."""

    def __init__(self, context):
        self.context, self.owners, self.of = context, {}, {}
        self.collection = bpy.data.collections.new(SCRATCH)
        context.scene.collection.children.link(self.collection)

    def copy(self, source, name, owner):
        made = source.copy()
        made.name = name
        self.collection.objects.link(made)
        self.owners[made.name] = owner
        self.of.setdefault(source.name_full, made)
        return made

    def instance(self, empty, owner):
        """Copies everything in the collection that an empty instances, and in the collections nested in it."""
        inside = [one for one in empty.instance_collection.all_objects if not one.hide_render]
        world_of_instance = empty.matrix_world @ Matrix.Translation(-empty.instance_collection.instance_offset)
        made = {one: self.copy(one, f"{empty.name}/{one.name}", owner) for one in inside}
        for source, copy in made.items():
            redirect(copy, made)
            if source.parent in made:
                copy.parent = made[source.parent]
            else:
                world = source.matrix_basis if source.parent is None else source.matrix_world
                copy.parent = None
                copy.matrix_world = world_of_instance @ world
        self.context.view_layer.update()
        copies = list(made.values())
        for copy in [one for one in copies if is_instance(one)]:
            copies += self.instance(copy, owner)
        return copies

    def remove(self):
        for one in list(self.collection.objects):
            bpy.data.objects.remove(one)
        bpy.data.collections.remove(self.collection)


def redirect(copy, made):
    """Makes references from copies to originals point to the copies."""
    settings = copy.soft_body_format
    for owner in (*copy.modifiers, *copy.constraints, *settings.pins, copy.rigid_body_constraint,
                  *(one for pose in (copy.pose.bones if copy.pose else ()) for one in pose.constraints)):
        if owner is None:
            continue
        for one in owner.bl_rna.properties:
            if one.type == "POINTER" and not one.is_readonly and getattr(owner, one.identifier) in made:
                setattr(owner, one.identifier, made[getattr(owner, one.identifier)])


@contextlib.contextmanager
def with_stand_ins(context, objects):
    """(objects, stand-ins or None). Copies replace collection instances. Library objects with the name of a local object are replaced
    by copies with new names. All copies are removed at the end."""
    local = {one.name for one in objects if one.library is None}
    doubles = [one for one in objects if one.library is not None and one.name in local]
    instances = [one for one in objects if is_instance(one)]
    if not doubles and not instances:
        yield objects, None
        return
    stand_ins = StandIns(context)
    try:
        found = [one for one in objects if one not in doubles]
        found += [stand_ins.copy(one, one.name, one.name) for one in doubles]
        for one in instances:
            found += stand_ins.instance(one, one.name)
        yield found, stand_ins
    finally:
        stand_ins.remove()
        context.view_layer.update()
