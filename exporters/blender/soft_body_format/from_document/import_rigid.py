"""Imports rigid bodies with hulls as objects with rigid body settings, and joints between them as constraints on empties."""

import bpy
from mathutils import Vector

from ..space import frame_rate
from ..to_document.rigid_objects import ANGULAR, LINEAR, X_FROM_Z
from .import_polygons import make_mesh

TYPES = {"fixed": "FIXED", "spherical": "POINT", "revolute": "HINGE", "prismatic": "SLIDER", "cylindrical": "PISTON",
         "six_dof": "GENERIC"}


class RigidMaker:
    """`made` maps ids of rigid bodies to their objects. `joined` holds the joints that became constraints."""

    def __init__(self, maker):
        self.maker, self.made, self.joined = maker, {}, set()

    def make(self):
        for body in self.maker.document.rigid_bodies:
            if body.hull is not None and not body.hull_derived and not body.derived:
                self.body(body)
        for joint in self.maker.document.joints:
            if joint.kind in TYPES and not joint.derived and joint.body_b in self.made and \
                    (not joint.body_a or joint.body_a in self.made):
                self.constraint(joint)
                self.joined.add(joint.id)

    # ---- Bodies ----

    def body(self, record):
        """The object whose mesh has this hull, else a new hidden object."""
        made = self.twin(record)
        if made is None:
            mesh, _ = make_mesh(record.name or record.id, record.hull, self.maker.space)
            made = bpy.data.objects.new(record.name or record.id, mesh)
            self.maker.collection.objects.link(made)
            made.display_type, made.soft_body_format.simulation_only = "WIRE", True
            self.maker.attach_to_bone(made, record.bone)
        self.maker.act_on(made, bpy.ops.rigidbody.object_add)
        settings, own = made.rigid_body, made.soft_body_format
        own.role, own.rigid_identity = "COLLISION", record.id
        settings.type = "ACTIVE" if record.motion == "dynamic" else "PASSIVE"
        settings.kinematic = record.motion != "dynamic"
        settings.collision_shape = "CONVEX_HULL"
        settings.mass = max(record.mass, 0.001)
        settings.friction, settings.restitution = record.friction, record.restitution
        settings.collision_collections = [bool(record.layer >> bit & 1) for bit in range(20)]
        self.made[record.id] = made

    def twin(self, record):
        positions = set(zip(*[iter(record.hull.positions)] * 3))
        for mesh in self.maker.document.render_meshes:
            made = self.maker.object_of_mesh.get(mesh.id)
            if made is not None and mesh.name == record.name and mesh.skin is None and not made.soft_body_format.body_identity and \
                    positions <= set(zip(*[iter(mesh.mesh.positions)] * 3)):
                return made
        return None

    # ---- Joints ----

    def constraint(self, joint):
        maker = self.maker
        made = bpy.data.objects.new(joint.name or joint.id, None)
        maker.collection.objects.link(made)
        made.soft_body_format.joint_identity = joint.id
        maker.act_on(made, lambda: bpy.ops.rigidbody.constraint_add(type=self.type_of(joint)))
        settings = made.rigid_body_constraint
        above, below = self.made.get(joint.body_a), self.made[joint.body_b]
        settings.object1, settings.object2 = (above, below) if above else (below, None)
        settings.disable_collisions = not joint.collide
        center = maker.document.find("rigid_bodies", joint.body_b).center
        turn = maker.space.rotation_back(joint.frame_b.rotation).to_matrix()
        made.location = maker.space.point_back(Vector(center) + Vector(joint.frame_b.position))
        made.rotation_euler = (turn @ X_FROM_Z.transposed() if settings.type == "HINGE" else turn).to_euler()
        self.fill_limits(settings, joint)
        self.fill_drives(settings, joint)
        if joint.break_force > 0:
            settings.use_breaking = True
            settings.breaking_threshold = joint.break_force / self.steps_a_second()

    @staticmethod
    def type_of(joint):
        if joint.kind == "six_dof" and joint.drives:
            return "GENERIC_SPRING" if any(one.stiffness > 0 for one in joint.drives) else "MOTOR"
        return TYPES[joint.kind]

    def steps_a_second(self):
        scene = self.maker.context.scene
        return frame_rate(scene) * scene.rigidbody_world.substeps_per_frame

    def fill_limits(self, settings, joint):
        for limit in joint.limits:
            if limit.target in LINEAR:
                name, scale = f"lin_{'xyz'[LINEAR.index(limit.target)]}", 1 / self.maker.space.unit_m
            elif limit.target in ANGULAR:
                name, scale = "ang_z" if settings.type == "HINGE" else f"ang_{'xyz'[ANGULAR.index(limit.target)]}", 1
            else:
                continue  # Blender's constraints have no cone: it is kept in memory
            setattr(settings, f"use_limit_{name}", True)
            setattr(settings, f"limit_{name}_lower", limit.min * scale)
            setattr(settings, f"limit_{name}_upper", limit.max * scale)

    def fill_drives(self, settings, joint):
        for drive in joint.drives:
            if drive.target not in LINEAR + ANGULAR:
                continue
            linear = drive.target in LINEAR
            axis = "xyz"[(LINEAR if linear else ANGULAR).index(drive.target)]
            if settings.type == "GENERIC_SPRING":
                name = axis if linear else f"ang_{axis}"
                setattr(settings, f"use_spring_{name}", True)
                setattr(settings, f"spring_stiffness_{name}", drive.stiffness)
                setattr(settings, f"spring_damping_{name}", drive.damping)
            elif settings.type == "MOTOR" and axis == "x":
                name = "lin" if linear else "ang"
                setattr(settings, f"use_motor_{name}", True)
                setattr(settings, f"motor_{name}_target_velocity", drive.velocity)
                setattr(settings, f"motor_{name}_max_impulse", drive.maximum / self.steps_a_second())
