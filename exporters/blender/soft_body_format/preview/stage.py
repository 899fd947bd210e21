"""The visible part of a preview: copies of the character's meshes and armature in a collection.

The user's objects do not change; they are only hidden while their copies are shown. Copies are never rendered, exported or
selected."""

from dataclasses import dataclass

import bpy
import numpy
from mathutils import Matrix

from ..from_document.import_meshes import fill_materials, fill_normals, fill_uv_sets
from ..from_document.import_polygons import make_mesh
from ..space import Space
from ..to_document.rest import at_rest, instances_realized
from . import copies

NAME = "Soft body preview"


@dataclass
class Actor:
    """A mesh that the preview moves: the part of the asset that moves it, and the names of its object and its copy. A mesh inside a
    collection instance is no object of the scene; its owner is the instance."""

    source: str
    owner: str
    kind: str      # "skin" of a render mesh, or "surface" of a soft body
    index: int
    copy: str = ""

    @property
    def is_own(self):
        return self.source == self.owner


def collection_of():
    return bpy.data.collections.get(NAME)


def actors_of(whole, document):
    """Finds the part of the built document that moves each mesh: its render mesh, or the surface of a body without one."""
    meshes = {one.id: index for index, one in enumerate(document.render_meshes)}
    bodies = {one.id: index for index, one in enumerate(document.soft_bodies)}
    owners = whole.writer.stand_ins.owners if whole.writer.stand_ins is not None else {}
    found = {}
    for (kind, name), identity in whole.writer.identifiers.given.items():
        if kind == "mesh" and identity in meshes:
            found[name] = Actor(name, owners.get(name, name), "skin", meshes[identity])
        elif kind == "body" and identity in bodies and name not in found:
            found[name] = Actor(name, owners.get(name, name), "surface", bodies[identity])
    return list(found.values())


def rest_meshes(context, sources):
    """The rest mesh of each object in world space, with modifiers evaluated as in an export."""
    made = {}
    with at_rest(list(context.view_layer.objects), context.view_layer), instances_realized(sources, context.view_layer):
        depsgraph = context.evaluated_depsgraph_get()
        for source in sources:
            mesh = bpy.data.meshes.new_from_object(source.evaluated_get(depsgraph), preserve_all_data_layers=True,
                                                   depsgraph=depsgraph)
            mesh.transform(source.matrix_world)
            if source.matrix_world.is_negative:
                mesh.flip_normals()
            made[source.name] = mesh
    return made


class Stage:
    """The copies of one preview, stored by name because an undo invalidates Blender's pointers."""

    def __init__(self, scene, actors, armatures, document):
        self.scene_name, self.actors, self.document = scene.name, actors, document
        self.armatures = {name: "" for name in armatures}

    def set(self, context):
        """Makes the copies and hides the objects that they replace."""
        strike()  # so that what an earlier preview hid is evaluated
        scene = bpy.data.scenes[self.scene_name]
        sources = [scene.objects[actor.source] for actor in self.actors if actor.is_own and actor.source in scene.objects]
        meshes = rest_meshes(context, sources)
        meshes |= {actor.source: self.mesh_of(actor, Space.of_scene(scene)) for actor in self.actors if not actor.is_own}
        collection = copies.begin(scene, NAME)
        for actor in self.actors:
            if actor.source in meshes:
                made = bpy.data.objects.new(f"{actor.source} (preview)", meshes[actor.source])
                actor.copy = self.put(made, collection, actor.source)
        for name in self.armatures:
            if name in scene.objects:
                self.armatures[name] = self.put_armature(scene.objects[name], collection)
        copies.hide_originals(collection, scene, context.view_layer, sorted({actor.owner for actor in self.actors} | set(self.armatures)))

    def mesh_of(self, actor, space):
        """The document's mesh in world space."""
        record = (self.document.render_meshes if actor.kind == "skin" else self.document.soft_bodies)[actor.index]
        mesh, corners = make_mesh(actor.source, record.mesh if actor.kind == "skin" else record.surface, space)
        names = {one.id: one.name for one in self.document.materials}
        if actor.kind == "skin":
            fill_materials(mesh, record, {identity: bpy.data.materials.get(name) for identity, name in names.items()},
                           corners)
            fill_uv_sets(mesh, record, corners)
            fill_normals(mesh, record, space, corners)
        return mesh

    def has_points(self, actor):
        """Whether the actor's object is a mesh of the scene with vertices to move, and not an instance or a curve."""
        scene = bpy.data.scenes[self.scene_name]
        return actor.is_own and actor.source in scene.objects and scene.objects[actor.source].type == "MESH"

    @staticmethod
    def put(made, collection, source):
        """The name it got."""
        made.hide_render = made.hide_select = True
        return copies.add(collection, made, source).name

    def put_armature(self, source, collection):
        """Copies the armature with the same bones and an independent pose."""
        made = source.copy()
        world = source.matrix_world.copy()
        made.animation_data_clear()
        for bone in made.pose.bones:
            for one in list(bone.constraints):
                bone.constraints.remove(one)
            bone.rotation_mode = "QUATERNION"
        for one in list(made.constraints):
            made.constraints.remove(one)
        made.parent, made.name = None, f"{source.name} (preview)"
        made.matrix_world = world
        return self.put(made, collection, source.name)

    def is_complete(self):
        """Whether all copies still exist. Undo, loading or the user may have removed some."""
        return collection_of() is not None and bpy.data.scenes.get(self.scene_name) is not None and \
            all(actor.copy in bpy.data.objects for actor in self.actors if actor.copy) and \
            all(name in bpy.data.objects for name in self.armatures.values() if name)

    def show_points(self, actor, points):
        """`points` is an (n, 3) array in the world of Blender."""
        made = bpy.data.objects.get(actor.copy)
        if made is None or len(made.data.vertices) != len(points):
            return
        made.data.vertices.foreach_set("co", numpy.ascontiguousarray(points, dtype=numpy.float32).ravel())
        made.data.update()

    def show_bones(self, armature_name, frames):
        """`frames`: {bone name: 4x4 in the world of Blender}."""
        made = bpy.data.objects.get(self.armatures.get(armature_name, ""))
        if made is None:
            return
        inverse = made.matrix_world.inverted_safe()
        scale = Matrix.Scale(made.matrix_world.median_scale, 4)
        poses = {}
        for bone in made.data.bones:  # parents first
            if bone.name not in frames:
                continue
            poses[bone.name] = pose = inverse @ frames[bone.name] @ scale
            above = bone.parent if bone.parent is not None and bone.parent.name in poses else None
            more = {"parent_matrix": poses[above.name], "parent_matrix_local": above.matrix_local} if above is not None else {}
            made.pose.bones[bone.name].matrix_basis = bone.convert_local_to_pose(pose, bone.matrix_local, invert=True, **more)


def strike():
    """Removes a preview's copies. Returns whether there were any."""
    return copies.strike(NAME)
