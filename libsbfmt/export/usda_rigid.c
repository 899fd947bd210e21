/* Writes rigid bodies with hulls, and joints with limits and drives, as UsdPhysics. Bodies have no
 * rotation at rest, as in assets. */
#include <math.h>
#include <stdio.h>

#include "export/usda.h"
#include "mechanics/joint_freedom.h"
#include "sbfmt/mechanics.h"

#define DEGREES 57.29577951308232

static void write_mass(usda_writer *w, const sbf_rigid_body *body) {
  sbf_rigid_measures measures;
  sbf_rigid_body_measure(body, &measures);
  if (!(measures.mass > 0)) return;
  const sbf_vec3 at = measures.center, from = body->center;
  sbfi_usda_write_vec3(
      w, "point3f physics:centerOfMass", (sbf_vec3){at.x - from.x, at.y - from.y, at.z - from.z});
  sbfi_usda_write_vec3(w, "float3 physics:diagonalInertia", measures.inertia);
  sbfi_usda_write_f32(w, "float physics:mass", (float)measures.mass);
  sbfi_usda_write_quat(w, "quatf physics:principalAxes", measures.inertia_rotation);
}

/* Angular velocity is in degrees per second. */
static void write_velocities(usda_writer *w, const sbf_rigid_body *body) {
  const sbf_vec3 v = body->velocity, turn = body->angular_velocity;
  const float degrees = (float)DEGREES;
  if (v.x != 0 || v.y != 0 || v.z != 0) sbfi_usda_write_vec3(w, "vector3f physics:velocity", v);
  if (turn.x != 0 || turn.y != 0 || turn.z != 0)
    sbfi_usda_write_vec3(w, "vector3f physics:angularVelocity",
        (sbf_vec3){turn.x * degrees, turn.y * degrees, turn.z * degrees});
}

static void write_hull(usda_writer *w, const sbf_rigid_body *body, uint32_t index) {
  const sbf_polygon_mesh *hull = body->hull;
  sbfi_usda_open_plain(
      w, "Mesh", "hull", "\"MaterialBindingAPI\", \"PhysicsCollisionAPI\", \"PhysicsMeshCollisionAPI\"");
  sbfi_usda_write_line(w, "uniform token subdivisionScheme = \"none\"");
  sbfi_usda_write_line(w, "uniform token purpose = \"guide\"");
  sbfi_usda_write_line(w, "uniform token physics:approximation = \"convexHull\"");
  sbfi_usda_write_extent(w, hull->positions.at, hull->positions.count, body->center);
  sbfi_usda_write_points(w, "point3f[] points", hull->positions.at, hull->positions.count, body->center);
  sbfi_usda_write_indices(w, "int[] faceVertexCounts", hull->polygon_sizes.at, hull->polygon_sizes.count, 1);
  sbfi_usda_write_indices(
      w, "int[] faceVertexIndices", hull->polygon_points.at, hull->polygon_points.count, 1);
  sbfi_usda_begin(w, "rel material:binding:physics = ");
  sbfi_usda_write_path(w, "rigid", body->id, index, "/matter>");
  sbfi_usda_end(w);
  sbfi_usda_close(w);
  sbfi_usda_open_plain(w, "Material", "matter", "\"PhysicsMaterialAPI\"");
  sbfi_usda_write_f32(w, "float physics:density", body->density);
  sbfi_usda_write_f32(w, "float physics:dynamicFriction", body->friction);
  sbfi_usda_write_f32(w, "float physics:staticFriction", body->friction);
  sbfi_usda_write_f32(w, "float physics:restitution", body->restitution);
  sbfi_usda_close(w);
}

void sbfi_usda_write_rigid_bodies(usda_writer *w) {
  const sbf_asset *asset = w->e->asset;
  if (!asset->rigid_bodies.count) return;
  sbfi_usda_open_plain(w, "Scope", "rigid", "");
  for (uint32_t i = 0; i < asset->rigid_bodies.count; i++) {
    const sbf_rigid_body *body = &asset->rigid_bodies.at[i];
    w->filters += body->layer != 1 || body->mask != UINT32_MAX;
    w->weights += body->gravity_scale != 1;
    sbfi_usda_open(w, "Xform", body->id, i, "\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"");
    sbfi_usda_write_translation(w, body->center);
    if (body->motion == SBF_BODY_MOTION_KINEMATIC)
      sbfi_usda_write_line(w, "bool physics:kinematicEnabled = true");
    write_mass(w, body);
    write_velocities(w, body);
    if (body->hull && body->hull->polygon_sizes.count) write_hull(w, body, i);
    sbfi_usda_close(w);
  }
  sbfi_usda_close(w);
}

/* ---- Joints ---- */

static const char *const axis_names[6] = {"transX", "transY", "transZ", "rotX", "rotY", "rotZ"};

/* Limits and drives of each coordinate; a cone limits both swings. */
typedef struct motion {
  bool free, bounded;
  float min, max;
  const sbf_drive *drive;
} motion;

static bool is_of(sbf_joint_axis target, unsigned axis) {
  return axis == (unsigned)target || (target == SBF_JOINT_AXIS_SWING && axis >= SBF_JOINT_AXIS_SWING_Y);
}

static void find_motions(usda_writer *w, const sbf_joint *joint, motion motions[6], float distance[2]) {
  for (unsigned k = 0; k < 6; k++)
    motions[k] = (motion){!(sbfi_joint_is_locked(joint->kind) >> k & 1), false, -INFINITY, INFINITY, NULL};
  for (uint32_t i = 0; i < joint->limits.count; i++) {
    const sbf_limit *limit = &joint->limits.at[i];
    w->soft_limits += limit->stiffness > 0 || limit->restitution > 0;
    if (limit->target == SBF_JOINT_AXIS_DISTANCE) distance[0] = limit->min, distance[1] = limit->max;
    for (unsigned k = 0; k < 6; k++) {
      if (!is_of(limit->target, k)) continue;
      float lower = limit->target == SBF_JOINT_AXIS_SWING ? -limit->max : limit->min;
      motions[k].bounded = true;
      motions[k].min = fmaxf(motions[k].min, lower);
      motions[k].max = fminf(motions[k].max, limit->max);
    }
  }
  for (uint32_t i = 0; i < joint->drives.count; i++)
    for (unsigned k = 0; k < 6; k++)
      if (is_of(joint->drives.at[i].target, k)) motions[k].drive = &joint->drives.at[i];
}

static void write_drive(usda_writer *w, const char *name, const sbf_drive *drive, bool is_angular) {
  double angle = is_angular ? DEGREES : 1;
  bool cone = drive->target == SBF_JOINT_AXIS_SWING;
  const struct {
    const char *what;
    double value;
  } parts[] = {{"damping", drive->damping / angle}, {"stiffness", drive->stiffness / angle},
      {"targetPosition", cone ? 0 : drive->position * angle},
      {"targetVelocity", cone ? 0 : drive->velocity * angle}, {"maxForce", drive->maximum}};
  sbfi_usda_write_line(w, "uniform token drive:%s:physics:type = \"force\"", name);
  for (size_t i = 0; i < sizeof parts / sizeof *parts - (drive->maximum > 0 ? 0 : 1); i++) {
    char declaration[80];
    snprintf(declaration, sizeof declaration, "float drive:%s:physics:%s", name, parts[i].what);
    sbfi_usda_write_f32(w, declaration, (float)parts[i].value);
  }
}

static void write_ends(usda_writer *w, const sbf_joint *joint) {
  const sbf_asset *asset = w->e->asset;
  for (int end = 0; end < 2; end++) {
    int32_t body = end ? joint->body_b : joint->body_a;
    const sbf_frame *frame = end ? &joint->frame_b : &joint->frame_a;
    if (body >= 0) {
      sbfi_usda_begin(w, end ? "rel physics:body1 = " : "rel physics:body0 = ");
      sbfi_usda_write_path(w, "rigid", asset->rigid_bodies.at[body].id, (uint32_t)body, ">");
      sbfi_usda_end(w);
    }
    sbfi_usda_write_vec3(w, end ? "point3f physics:localPos1" : "point3f physics:localPos0", frame->position);
    sbfi_usda_write_quat(w, end ? "quatf physics:localRot1" : "quatf physics:localRot0", frame->rotation);
  }
  if (joint->break_force > 0) sbfi_usda_write_f32(w, "float physics:breakForce", joint->break_force);
  if (joint->break_torque > 0) sbfi_usda_write_f32(w, "float physics:breakTorque", joint->break_torque);
  if (joint->collide) sbfi_usda_write_line(w, "bool physics:collisionEnabled = true");
}

/* "\"PhysicsLimitAPI:rotX\", ...": schemas of locked or limited coordinates of a generic joint, and of
 * drives. */
static const char *schemas_of(const motion motions[6], char *to, size_t size) {
  size_t length = 0;
  *to = 0;
  for (int k = 0; k < 6; k++)
    for (int drives = 0; drives < 2; drives++) {
      if (drives ? !motions[k].free || !motions[k].drive : motions[k].free && !motions[k].bounded) continue;
      int more = snprintf(to + length, size - length, "%s\"Physics%sAPI:%s\"", length ? ", " : "",
          drives ? "Drive" : "Limit", axis_names[k]);
      length += more > 0 ? (size_t)more : 0;
    }
  return to;
}

/* A joint with six coordinates; a limit with low above high locks its coordinate. */
static void write_plain(usda_writer *w, const sbf_joint *joint, uint32_t index, const motion motions[6]) {
  char schemas[480];
  sbfi_usda_open(w, "PhysicsJoint", joint->id, index, schemas_of(motions, schemas, sizeof schemas));
  write_ends(w, joint);
  for (int k = 0; k < 6; k++) {
    double angle = k < 3 ? 1 : DEGREES;
    bool pinned = !motions[k].free || (motions[k].bounded && !(motions[k].min < motions[k].max));
    if (pinned || motions[k].bounded)
      for (int high = 0; high < 2; high++) {
        char declaration[64];
        float value = pinned ? (high ? -1 : 1) : (float)((high ? motions[k].max : motions[k].min) * angle);
        snprintf(declaration, sizeof declaration, "float limit:%s:physics:%s", axis_names[k],
            high ? "high" : "low");
        sbfi_usda_write_f32(w, declaration, value);
      }
    if (motions[k].free && motions[k].drive) write_drive(w, axis_names[k], motions[k].drive, k >= 3);
  }
  sbfi_usda_close(w);
}

/* A joint that rotates about or slides along +X. */
static void write_single(
    usda_writer *w, const sbf_joint *joint, uint32_t index, const motion *one, bool is_angular) {
  const char *name = is_angular ? "angular" : "linear";
  sbfi_usda_open(w, is_angular ? "PhysicsRevoluteJoint" : "PhysicsPrismaticJoint", joint->id, index,
      !one->drive  ? ""
      : is_angular ? "\"PhysicsDriveAPI:angular\""
                   : "\"PhysicsDriveAPI:linear\"");
  sbfi_usda_write_line(w, "uniform token physics:axis = \"X\"");
  write_ends(w, joint);
  if (one->bounded) {
    sbfi_usda_write_f32(w, "float physics:lowerLimit", (float)(one->min * (is_angular ? DEGREES : 1)));
    sbfi_usda_write_f32(w, "float physics:upperLimit", (float)(one->max * (is_angular ? DEGREES : 1)));
  }
  if (one->drive) write_drive(w, name, one->drive, is_angular);
  sbfi_usda_close(w);
}

/* A distance keeps its rest value unless a limit bounds it. */
static void write_distance(usda_writer *w, const sbf_joint *joint, uint32_t index, const float bounds[2]) {
  const sbf_asset *asset = w->e->asset;
  float low = bounds[0], high = bounds[1];
  if (!(low <= high)) {
    const sbf_vec3 none = {0, 0, 0};
    const sbf_vec3 a = joint->body_a < 0 ? none : asset->rigid_bodies.at[joint->body_a].center;
    const sbf_vec3 b = joint->body_b < 0 ? none : asset->rigid_bodies.at[joint->body_b].center;
    const sbf_vec3 p = joint->frame_a.position, q = joint->frame_b.position;
    float x = b.x + q.x - a.x - p.x, y = b.y + q.y - a.y - p.y, z = b.z + q.z - a.z - p.z;
    low = high = sqrtf(x * x + y * y + z * z);
  }
  sbfi_usda_open(w, "PhysicsDistanceJoint", joint->id, index, "");
  write_ends(w, joint);
  sbfi_usda_write_f32(w, "float physics:minDistance", low);
  sbfi_usda_write_f32(w, "float physics:maxDistance", high);
  sbfi_usda_close(w);
}

/* Whether a ball joint has only a cone limit, or none. */
static bool is_cone(const sbf_joint *joint) {
  if (joint->kind != SBF_JOINT_KIND_SPHERICAL || joint->drives.count || joint->limits.count > 1) return false;
  return !joint->limits.count || joint->limits.at[0].target == SBF_JOINT_AXIS_SWING;
}

static void write_cone(usda_writer *w, const sbf_joint *joint, uint32_t index) {
  sbfi_usda_open(w, "PhysicsSphericalJoint", joint->id, index, "");
  sbfi_usda_write_line(w, "uniform token physics:axis = \"X\"");
  write_ends(w, joint);
  if (joint->limits.count) {
    float angle = (float)(joint->limits.at[0].max * DEGREES);
    sbfi_usda_write_f32(w, "float physics:coneAngle0Limit", angle);
    sbfi_usda_write_f32(w, "float physics:coneAngle1Limit", angle);
  }
  sbfi_usda_close(w);
}

static void write_fixed(usda_writer *w, const sbf_joint *joint, uint32_t index) {
  sbfi_usda_open(w, "PhysicsFixedJoint", joint->id, index, "");
  write_ends(w, joint);
  sbfi_usda_close(w);
}

void sbfi_usda_write_joints(usda_writer *w) {
  const sbf_joint_list joints = w->e->asset->joints;
  if (!joints.count) return;
  sbfi_usda_open_plain(w, "Scope", "joints", "");
  for (uint32_t i = 0; i < joints.count; i++) {
    const sbf_joint *joint = &joints.at[i];
    motion motions[6];
    float distance[2] = {1, 0};
    if (joint->kind == SBF_JOINT_KIND_PULLEY) {
      w->pulleys++;
      continue;
    }
    find_motions(w, joint, motions, distance);
    if (joint->kind == SBF_JOINT_KIND_DISTANCE)
      write_distance(w, joint, i, distance);
    else if (joint->kind == SBF_JOINT_KIND_FIXED)
      write_fixed(w, joint, i);
    else if (joint->kind == SBF_JOINT_KIND_REVOLUTE)
      write_single(w, joint, i, &motions[SBF_JOINT_AXIS_TWIST], true);
    else if (joint->kind == SBF_JOINT_KIND_PRISMATIC)
      write_single(w, joint, i, &motions[SBF_JOINT_AXIS_LINEAR_X], false);
    else if (is_cone(joint))
      write_cone(w, joint, i);
    else
      write_plain(w, joint, i, motions);
  }
  sbfi_usda_close(w);
}
