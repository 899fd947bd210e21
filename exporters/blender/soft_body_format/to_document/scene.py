"""Writes a Blender scene as the format's source parts."""

import os
from dataclasses import dataclass

import bpy
import numpy

from ..sbfmt.document import Record
from ..space import Space
from .armatures import Skeleton, write_bones
from ..settings.attributes import fill_attributes
from . import cloth, soft_bodies, soundness
from .chosen import chosen_objects, with_stand_ins
from .gaits import GaitWriter
from .identifiers import Identifiers
from .ik_constraints import IkConstraints
from .materials import Materials
from .meshes import Geometry, fill_normals, fill_polygons, fill_shape_keys, fill_skin, fill_uv_sets
from .pins import fill_pins, fill_weight_maps
from .recipes import write_recipes
from .rest import at_rest, instances_realized, materials_of, mesh_of
from .rigid_objects import COLLIDER_FRICTION, RigidObjects
from .rigid_parts import RigidParts
from .roles import COLLISION, IGNORE, RENDER, SECTION, SOFT, SURFACES, armature_of, holding_bone, modifier, role_of
from .surroundings import write_surroundings

NOTHING = "NOTHING_TO_EXPORT"
COLLIDER_LEFT_OUT = (("damping", "damping of soft bodies", 0.1), ("absorption", "field absorption", 0.0),
                     ("use_culling", "single sided", True), ("use_normal", "override normals", False))


@dataclass
class Options:
    """Options of an export: which objects, and how."""

    selected_only: bool = False
    collection: str = ""          # name; empty: all
    apply_modifiers: bool = True
    textures: str = "COPY"        # COPY: into a folder beside the file; or EMBED


class SceneWriter:
    """State of one export: the document, and data that its parts share. Every writer module takes this."""

    def __init__(self, context, options, findings):
        self.context, self.options, self.findings = context, options, findings
        self.scene = context.scene
        self.space = Space.of_scene(context.scene)
        self.asset, self.identifiers, self.skeleton = Record("asset"), Identifiers(), Skeleton()
        self.materials = Materials(self.asset, self.identifiers, options.textures, findings)
        self.chosen = self.objects = chosen_objects(context, options)
        self.stand_ins = self.depsgraph = None
        self.field_effects = {}  # by object: (m/s² in a force field of strength 1, 1/s in a drag of 1), as in Blender
        self.sort()

    def sort(self):
        """Finds the role of each mesh, before modifiers are turned off for the rest pose."""
        meshes = self.meshes()
        self.roles = {one.name: role_of(one) for one in meshes}
        self.armatures = {one.name: armature_of(one) for one in meshes}
        self.soft = {one.name: soft_bodies.settings_of(one) for one in meshes}
        self.cloth = {one.name: cloth.settings_of(one) for one in meshes}
        self.colliders = {one.name for one in meshes if modifier(one, "COLLISION") and one.collision.use}

    def of_type(self, kind):
        return [one for one in self.objects if one.type == kind]

    def meshes(self):
        """The objects that are exported as meshes."""
        return [one for one in self.objects if one.type == "MESH" or one.type in SURFACES and self.options.apply_modifiers]

    def write(self):
        """Writes the document. Adds faults to the findings. Do not use the document if they hold an error."""
        with with_stand_ins(self.context, self.chosen) as (objects, stand_ins):
            self.objects, self.stand_ins = objects, stand_ins
            self.sort()
            self.write_objects()
            self.objects = self.chosen
        if stand_ins is not None:
            for found in self.findings:  # by the name of the object in the scene
                found.object_name = stand_ins.owners.get(found.object_name, found.object_name)
        return self.asset

    def write_objects(self):
        self.write_info()
        for source in self.meshes():
            if source.mode == "EDIT":
                source.update_from_editmode()
        with at_rest(self.objects, self.context.view_layer), instances_realized(self.meshes(), self.context.view_layer):
            self.objects = soundness.find_sound_objects(self)
            self.depsgraph = self.context.evaluated_depsgraph_get()
            for armature in self.of_type("ARMATURE"):
                write_bones(self.asset, armature, self.space, self.identifiers, self.skeleton)
            soundness.instances_left_out(self)
            for source in self.meshes():
                if self.roles[source.name] != IGNORE:
                    self.write_mesh(source, self.roles[source.name])
            RigidObjects(self).write()
            for armature in self.of_type("ARMATURE"):
                RigidParts(self).write(armature)
            gait = self.scene.soft_body_format.gait
            if gait.use and gait.armature is not None:
                GaitWriter(self, gait).write()
            for armature in self.of_type("ARMATURE"):
                IkConstraints(self, armature).write()
            write_surroundings(self)
            write_recipes(self)
            for armature in self.of_type("ARMATURE"):
                soundness.bones_without_section(self, armature)
        if not self.asset.render_meshes and not self.findings.errors:
            self.findings.error("nothing to export: no visible mesh with faces is chosen; select one, or turn off Selected Objects Only",
                                code=NOTHING)

    def write_info(self):
        info = self.asset.info
        info.title = os.path.splitext(os.path.basename(bpy.data.filepath))[0] or self.scene.name
        info.tool = f"Soft body format for Blender {bpy.app.version_string}"
        if bpy.data.filepath:
            info.add("sources", path=os.path.basename(bpy.data.filepath))

    def exported(self, source):
        """The exported object for one that a panel names: itself, or its first copy."""
        if source is None or source in self.objects or self.stand_ins is None:
            return source
        return self.stand_ins.of.get(source.name_full, source)

    def write_mesh(self, source, role):
        with mesh_of(source, self.depsgraph, self.options.apply_modifiers) as mesh:
            if mesh is None or not mesh.polygons:
                soundness.without_faces(self, source)
                return
            geometry = Geometry(source, mesh, self.space)
            if not soundness.finite(self.findings, source, geometry.positions):
                return
            if not source.soft_body_format.simulation_only or role == RENDER:
                self.write_render_mesh(source, mesh, geometry, role)
            if role in (SECTION, SOFT):
                self.write_body(source, geometry)

    def fill_collider(self, body, source):
        """Writes thickness and friction of Collision physics as the body's own contact settings."""
        if source.name in self.colliders:
            scale = self.space.unit_m * source.matrix_world.median_scale
            body.collision.outer_thickness = source.collision.thickness_outer * scale
            body.collision.inner_thickness = source.collision.thickness_inner * scale
            body.attributes.friction = source.collision.cloth_friction * COLLIDER_FRICTION
            self.report_collider_settings(source)

    def report_collider_settings(self, source):
        """Reports Collision settings that the format does not have, such as those for particles and force fields."""
        left_out = [label for name, label, idle in COLLIDER_LEFT_OUT if abs(getattr(source.collision, name) - idle) > 1e-6]
        if left_out:
            self.findings.info(f"settings of its collision without a counterpart are left out: {', '.join(left_out)}",
                               object_name=source.name)

    def mesh_id(self, source):
        return self.identifiers.of("mesh", source.name, source.name, source.soft_body_format.mesh_identity)

    def body_id(self, source):
        return self.identifiers.of("body", source.name, source.name, source.soft_body_format.body_identity)

    def write_render_mesh(self, source, mesh, geometry, role):
        record = self.asset.add("render_meshes", id=self.mesh_id(source), name=source.name)
        fill_polygons(record.mesh, geometry, "rendering")
        fill_normals(record, geometry, source, self.space)
        fill_uv_sets(record, geometry)
        self.fill_materials(record, source, geometry)
        fill_shape_keys(record, source, geometry, self.space, self.findings)
        armature = self.armatures[source.name]
        if role in (RENDER, COLLISION) and armature is not None:
            fill_skin(record, source, mesh, self.bones_of_groups(source, armature), self.findings)
        bone = self.bone_of_object(source)
        if bone is not None and role in (RENDER, COLLISION) and record.skin is None:
            record.bone = bone

    def fill_materials(self, record, source, geometry):
        slots = materials_of(source, geometry.mesh)
        if not any(slots):
            return
        number_of_slot = numpy.zeros(int(geometry.polygon_materials.max(initial=0)) + 1, dtype=numpy.uint32)
        for index in numpy.unique(geometry.polygon_materials).tolist():
            material = slots[index] if index < len(slots) else None
            if material is None:
                self.findings.warning(f"faces of material slot {index + 1} have no material; they take the first one's",
                                      object_name=source.name)
                continue
            number_of_slot[index] = len(record.material_slots)
            record.add("material_slots", material=self.materials.id(material))
        numbers = number_of_slot[geometry.polygon_materials]
        if numbers.any():
            record.polygon_materials = numbers

    def bones_of_groups(self, source, armature):
        """{index of a vertex group: index of the bone with its name}."""
        found = {}
        for group in source.vertex_groups:
            number = self.skeleton.number(armature, group.name)
            if number is not None and armature.data.bones[group.name].use_deform:
                found[group.index] = number
        return found

    def bone_of_object(self, source):
        """The id of the bone that a mesh is parented to, or None."""
        bone = holding_bone(source)
        return self.skeleton.id(*bone) if bone else None

    def write_body(self, source, geometry):
        body = self.asset.add("soft_bodies", id=self.body_id(source), name=source.name)
        fill_polygons(body.surface, geometry, "surface")
        body.bone = self.bone_of_object(source)
        settings, soft, layer = source.soft_body_format, self.soft[source.name], self.cloth[source.name]
        if soft is not None and not settings.own_values:
            soft_bodies.fill_from_soft_body(self, body, source, geometry, soft)
        elif layer is not None and not settings.own_values:
            cloth.fill_from_cloth(self, body, source, geometry, layer)
        else:
            fill_attributes(body.attributes, settings.attributes)
            for name in ("particle_radius", "outer_thickness", "inner_thickness"):
                setattr(body.collision, name, getattr(settings, name))
            body.collision.self = settings.self_collision
        if not settings.own_values:
            self.fill_collider(body, source)
        fill_pins(self, body, source, geometry.mesh)
        fill_weight_maps(self, body, source, geometry.mesh)
