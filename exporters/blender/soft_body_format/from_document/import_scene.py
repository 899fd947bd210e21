"""Imports a document as Blender objects: an armature, meshes and settings. Keeps the document for a later export."""

import bpy
from mathutils import Matrix

from .. import memory
from ..findings import Findings
from ..space import Space
from ..to_document import Options, SceneWriter
from . import import_bones, import_meshes, import_recipes, import_settings
from .import_chains import fill_chains
from .import_materials import make_materials
from .import_polygons import make_mesh
from .import_rigid import RigidMaker
from .import_surroundings import fill_surroundings


class SceneMaker:
    def __init__(self, context, document, name, folder, findings):
        self.context, self.document, self.folder, self.findings = context, document, folder, findings
        self.space = Space.of_scene(context.scene)
        self.collection = bpy.data.collections.new(name)
        self.armature, self.names, self.object_of_mesh = None, {}, {}

    def make(self):
        self.context.scene.collection.children.link(self.collection)
        found = import_bones.make_armature(self.document, self.space, self.collection, self.context)
        if found:
            self.armature, self.names = found
        self.make_meshes(make_materials(self.document, self.folder, self.findings))
        rigid = RigidMaker(self)
        rigid.make()
        if self.armature is not None:
            import_bones.fill_joints(self.document, self.armature, self.names, rigid.joined)
        fill_chains(self)
        fill_surroundings(self)
        import_settings.fill_gait(self.context.scene, self.document, self.armature, self.names, self.space)
        import_recipes.fill_recipes(self.context.scene, self.document, self.armature, self.names)
        self.context.view_layer.update()
        unchanged = SceneWriter(self.context, Options(collection=self.collection.name), Findings()).write()
        memory.keep(self.collection, self.document, unchanged, self.space)

    def act_on(self, made, call):
        """Calls a Blender operator that works on the active object."""
        self.context.view_layer.objects.active = made
        with self.context.temp_override(object=made, active_object=made, selected_objects=[made], selected_editable_objects=[made]):
            call()

    def make_meshes(self, materials):
        """Makes one object for a body and the render mesh of the same shape. Bodies that a build derived get no object."""
        bodies = {body.id: body for body in self.document.soft_bodies if not body.derived}
        for record in self.document.render_meshes:
            if record.derived:
                continue
            body = self.twin(record, bodies)
            self.make_object(record, bodies.pop(body.id) if body else None, materials)
        for body in bodies.values():
            self.make_object(None, body, materials)

    @staticmethod
    def twin(record, bodies):
        return next((body for body in bodies.values() if body.surface.positions == record.mesh.positions and
                     body.surface.polygon_points == record.mesh.polygon_points and
                     body.surface.polygon_sizes == record.mesh.polygon_sizes), None)

    def make_object(self, record, body, materials):
        source = record or body
        polygons = record.mesh if record else body.surface
        mesh, corners = make_mesh(source.name or source.id, polygons, self.space)
        if record:
            import_meshes.fill_uv_sets(mesh, record, corners)
            import_meshes.fill_materials(mesh, record, materials, corners)
            import_meshes.fill_normals(mesh, record, self.space, corners)
        made = bpy.data.objects.new(source.name or source.id, mesh)
        self.collection.objects.link(made)
        if record:
            self.object_of_mesh[record.id] = made
        settings = made.soft_body_format
        settings.role, settings.mesh_identity, settings.simulation_only = "RENDER", record.id if record else "", record is None
        if record:
            import_meshes.fill_shape_keys(made, record, self.space)
            if record.skin is not None and self.armature is not None:
                import_meshes.fill_skin(made, record, [self.names[bone.id] for bone in self.document.bones])
                made.parent = self.armature
                made.modifiers.new("Armature", "ARMATURE").object = self.armature
        if body:
            import_settings.fill_body(made, body, self.armature, self.names)
        self.attach_to_bone(made, body.bone if body else record.bone)

    def attach_to_bone(self, made, bone):
        """Parents the object to a bone and keeps its world position."""
        if not bone or made.parent is not None:
            return
        name = self.names[bone]
        made.parent, made.parent_type, made.parent_bone = self.armature, "BONE", name
        rest = self.armature.data.bones[name]
        # A child's origin is relative to the bone's tail.
        made.matrix_parent_inverse = (rest.matrix_local @ Matrix.Translation((0, rest.length, 0))).inverted()
