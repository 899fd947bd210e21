"""Writes objects with rigid body settings, and the rigid body constraints between them."""

import bmesh
import numpy
from mathutils import Matrix, Vector

from ..sbfmt.document import Record
from ..space import frame_rate
from .rest import mesh_of
from .roles import COLLISION, holding_bone, modifier

# Blender's hinge turns about Z, its slider and piston run along X; a joint's own axis is X.
X_FROM_Z = Matrix(((0, 0, -1), (0, 1, 0), (1, 0, 0)))
KINDS = {"FIXED": "fixed", "POINT": "spherical", "HINGE": "revolute", "SLIDER": "prismatic", "PISTON": "cylindrical",
         "GENERIC": "six_dof", "GENERIC_SPRING": "six_dof", "MOTOR": "six_dof"}
LINEAR = ("linear_x", "linear_y", "linear_z")
ANGULAR = ("twist", "swing_y", "swing_z")
SEGMENTS = 12  # of round shapes' hulls
COLLIDER_FRICTION = 0.1  # Blender's cloth uses this fraction of the slider as its coefficient


def is_flat(made):
    """Whether all points lie in a plane, within 1e-5 of their extent."""
    positions = numpy.array([vertex.co for vertex in made.verts]).reshape(-1, 3)
    if len(positions) < 4:
        return True
    extents = numpy.linalg.svd(positions - positions.mean(axis=0), compute_uv=False)
    return extents[2] <= 1e-5 * extents[0]


class RigidObjects:
    def __init__(self, writer):
        self.writer = writer

    def write(self):
        for source in self.writer.meshes():
            if self.writer.roles[source.name] == COLLISION:
                self.body(source)
        for source in self.writer.objects:
            if source.rigid_body_constraint is not None and source.rigid_body_constraint.enabled:
                self.constraint(source)

    # ---- Bodies ----

    def body(self, source):
        """The rigid body of an object, written once; None if the object has neither rigid body settings nor that role."""
        writer, key = self.writer, ("object", source.name)
        known = writer.identifiers.known("rigid", key)
        if known:
            return writer.asset.find("rigid_bodies", known)
        settings, collider = source.rigid_body, modifier(source, "COLLISION")
        points, polygons = self.hull(source, settings.collision_shape if settings else "CONVEX_HULL")
        if not polygons and settings is None and collider is not None:
            writer.findings.info("has collision settings and no depth: it is left out, since the ground is the host's",
                                 object_name=source.name)
            return None
        if not polygons:
            writer.findings.error("its convex hull is flat or empty, so it can be no rigid part: give it a volume",
                                  object_name=source.name)
            return None
        positions = [writer.space.point(source.matrix_world @ point) for point in points]
        center = tuple(sum(position[axis] for position in positions) / len(positions) for axis in range(3))
        parent = holding_bone(source)
        identity = writer.identifiers.of("rigid", key, source.name, source.soft_body_format.rigid_identity)
        if parent:  # so that joints of that bone join this body, not another one
            writer.identifiers.given.setdefault(("rigid", (parent[0].name, parent[1])), identity)
        record = writer.asset.add("rigid_bodies", id=identity, name=source.name,
                                  bone=writer.skeleton.id(*parent) if parent else None, center=center)
        record.add("hull", target="collision_detection", positions=positions, polygon_sizes=[len(one) for one in polygons],
                   polygon_points=[point for one in polygons for point in one])
        if settings is not None:
            record.motion = "dynamic" if settings.type == "ACTIVE" and not settings.kinematic else "kinematic"
            record.mass, record.friction, record.restitution = settings.mass, settings.friction, settings.restitution
            record.layer = sum(1 << index for index, on in enumerate(settings.collision_collections) if on)
        elif collider is not None:
            record.friction = source.collision.cloth_friction * COLLIDER_FRICTION
        return record

    def hull(self, source, shape):
        """(points, polygons), convex and closed, in the object's space: its mesh's, or that of the simple shape around it."""
        made = bmesh.new()
        try:
            if shape in ("CONVEX_HULL", "MESH", "COMPOUND"):
                with mesh_of(source, self.writer.depsgraph, source.type != "MESH") as mesh:
                    made.from_mesh(mesh)
                if shape != "CONVEX_HULL":
                    self.writer.findings.info("its collision shape becomes a convex hull, the only one a rigid part has",
                                              object_name=source.name)
            else:
                self.simple(made, source, shape)
            if is_flat(made):
                return [], []
            found = bmesh.ops.convex_hull(made, input=made.verts, use_existing_faces=False)
            bmesh.ops.delete(made, geom=[one for one in {*found["geom_interior"], *found["geom_unused"]}
                                         if isinstance(one, bmesh.types.BMVert)], context="VERTS")
            bmesh.ops.delete(made, geom=[face for face in made.faces if face not in set(found["geom"])], context="FACES_ONLY")
            bmesh.ops.recalc_face_normals(made, faces=made.faces)
            made.verts.index_update()
            turn = -1 if source.matrix_world.is_negative else 1
            return ([vertex.co.copy() for vertex in made.verts],
                    [[vertex.index for vertex in face.verts][::turn] for face in made.faces])
        finally:
            made.free()

    @staticmethod
    def simple(made, source, shape):
        """A shape that fills the object's bounds."""
        corners = [Vector(corner) for corner in source.bound_box]
        low, high = corners[0], corners[6]
        position = Matrix.Translation((low + high) / 2)
        size = high - low
        if shape == "BOX":
            bmesh.ops.create_cube(made, size=1, matrix=position @ Matrix.Diagonal((*size, 1)))
        elif shape == "SPHERE":
            bmesh.ops.create_uvsphere(made, u_segments=SEGMENTS, v_segments=SEGMENTS // 2, radius=max(size) / 2, matrix=position)
        elif shape == "CAPSULE":
            radius = max(size.x, size.y) / 2
            for end in (-1, 1):
                at = position @ Matrix.Translation((0, 0, end * max(size.z / 2 - radius, 0)))
                bmesh.ops.create_uvsphere(made, u_segments=SEGMENTS, v_segments=SEGMENTS // 2, radius=radius, matrix=at)
        else:
            radius = max(size.x, size.y) / 2
            bmesh.ops.create_cone(made, cap_ends=True, segments=SEGMENTS, radius1=radius, radius2=radius if shape == "CYLINDER" else 0,
                                  depth=size.z, matrix=position)

    # ---- Constraints ----

    def constraint(self, source):
        writer, settings = self.writer, source.rigid_body_constraint
        if settings.object1 is None and settings.object2 is None:
            writer.findings.error("its rigid body constraint names no object: choose two, or remove it", object_name=source.name)
            return
        first, second = (one for one in (settings.object1, settings.object2))
        if second is None:
            first, second = None, first
        below = self.body(second)
        above = self.body(first) if first is not None else None
        if below is None or first is not None and above is None:
            return
        identity = writer.identifiers.of("joint", ("object", source.name), source.name, source.soft_body_format.joint_identity)
        made = writer.asset.add("joints", id=identity, name=source.name, kind=KINDS[settings.type],
                                body_a=above.id if above else None, body_b=below.id, collide=not settings.disable_collisions)
        self.set_frames(made, source, settings, above, below)
        self.limit(made, settings)
        if settings.type == "GENERIC_SPRING":
            self.springs(made, settings)
        elif settings.type == "MOTOR":
            self.motor(made, settings)
        if settings.use_breaking:
            made.break_force = settings.breaking_threshold * self.steps_a_second()

    def steps_a_second(self):
        """Steps per second: Blender's limits are impulses per step, and forces are impulses times this rate."""
        scene = self.writer.scene
        return frame_rate(scene) * scene.rigidbody_world.substeps_per_frame

    def set_frames(self, made, source, settings, above, below):
        space = self.writer.space
        turn = source.matrix_world.decompose()[1].to_matrix()
        if settings.type == "HINGE":
            turn = turn @ X_FROM_Z
        position, rotation = space.point(source.matrix_world.translation), space.rotation(turn.to_quaternion())
        for record, part in ((made.frame_a, above), (made.frame_b, below)):
            center = part.center if part else (0.0, 0.0, 0.0)
            record.position = tuple(a - b for a, b in zip(position, center))
            record.rotation = rotation

    def limit(self, made, settings):
        """Bounds in metres and radians. A generic constraint's axis without limits is free, as it is here."""
        def put(target, use, low, high, scale=1.0):
            if use and low <= high:
                made.limits.append(Record("limit", target=target, min=low * scale, max=high * scale))

        unit = self.writer.space.unit_m
        if settings.type == "HINGE":
            put("twist", settings.use_limit_ang_z, settings.limit_ang_z_lower, settings.limit_ang_z_upper)
        if settings.type in ("SLIDER", "PISTON"):
            put("linear_x", settings.use_limit_lin_x, settings.limit_lin_x_lower, settings.limit_lin_x_upper, unit)
        if settings.type == "PISTON":
            put("twist", settings.use_limit_ang_x, settings.limit_ang_x_lower, settings.limit_ang_x_upper)
        if settings.type in ("GENERIC", "GENERIC_SPRING"):
            for axis, linear, angular in zip("xyz", LINEAR, ANGULAR):
                put(linear, getattr(settings, f"use_limit_lin_{axis}"), getattr(settings, f"limit_lin_{axis}_lower"),
                    getattr(settings, f"limit_lin_{axis}_upper"), unit)
                put(angular, getattr(settings, f"use_limit_ang_{axis}"), getattr(settings, f"limit_ang_{axis}_lower"),
                    getattr(settings, f"limit_ang_{axis}_upper"))

    @staticmethod
    def springs(made, settings):
        for axis, linear, angular in zip("xyz", LINEAR, ANGULAR):
            for target, kind in ((linear, axis), (angular, f"ang_{axis}")):
                if getattr(settings, f"use_spring_{kind}"):
                    made.drives.append(Record("drive", target=target, stiffness=getattr(settings, f"spring_stiffness_{kind}"),
                                              damping=getattr(settings, f"spring_damping_{kind}")))

    def motor(self, made, settings):
        """Writes a motor. It drives a velocity; its largest impulse limits the force, which the damping reaches at 1 m/s or 1 rad/s."""
        for target, kind in (("linear_x", "lin"), ("twist", "ang")):
            if getattr(settings, f"use_motor_{kind}"):
                max_force = getattr(settings, f"motor_{kind}_max_impulse") * self.steps_a_second()
                made.drives.append(Record("drive", target=target, velocity=getattr(settings, f"motor_{kind}_target_velocity"),
                                          damping=max_force, maximum=max_force))
