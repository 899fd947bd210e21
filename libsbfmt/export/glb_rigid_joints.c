/* Writes limits and drives of a joint as those of KHR_physics_rigid_bodies, whose X axis is the twist axis.
 */
#include <math.h>

#include "export/glb_rigid.h"
#include "mechanics/joint_freedom.h"

/* Bounds of this size and more are none. */
static const float UNBOUNDED_M = 1e30f, HALF_TURN = 3.14159f;

typedef struct item_writer {
  sbfi_text *text;
  uint32_t count;
} item_writer;

static void write_number(sbfi_text *text, const char *name, float value) {
  sbfi_export_print(text, ",\"%s\":", name);
  sbfi_text_f32(text, value);
}

static void write_limit(item_writer *w, bool angular, unsigned axes, const sbf_limit *limit) {
  float beyond = angular ? HALF_TURN : UNBOUNDED_M;
  if (!axes) return;
  sbfi_text_string(w->text, w->count++ ? ",{" : "{");
  sbfi_export_bits(w->text, angular ? "angularAxes" : "linearAxes", axes, "", "");
  if (limit->min > -beyond) write_number(w->text, "min", limit->min);
  if (limit->max < beyond) write_number(w->text, "max", limit->max);
  if (limit->stiffness > 0) write_number(w->text, "stiffness", limit->stiffness);
  if (limit->stiffness > 0 && limit->damping > 0) write_number(w->text, "damping", limit->damping);
  sbfi_text_char(w->text, '}');
}

static void write_locked(item_writer *w, const sbf_joint *joint) {
  const sbf_limit none = {.min = 0, .max = 0};
  unsigned locked = sbfi_joint_is_locked(joint->kind);
  write_limit(w, false, locked & 7, &none);
  write_limit(w, true, locked >> SBF_JOINT_AXIS_TWIST & 7, &none);
}

/* Length of a distance joint at rest. */
static float rest_distance(const sbf_asset *asset, const sbf_joint *joint) {
  sbf_vec3 a = joint->frame_a.position, b = joint->frame_b.position, from = {0, 0, 0};
  if (joint->body_a >= 0) from = asset->rigid_bodies.at[joint->body_a].center;
  const sbf_vec3 to = asset->rigid_bodies.at[joint->body_b].center;
  float x = to.x + b.x - from.x - a.x, y = to.y + b.y - from.y - a.y, z = to.z + b.z - from.z - a.z;
  return sqrtf(x * x + y * y + z * z);
}

static void write_limits(sbfi_glb *g, item_writer *w, const sbf_joint *joint) {
  bool has_distance = false;
  for (uint32_t i = 0; i < joint->limits.count; i++) {
    const sbf_limit *limit = &joint->limits.at[i];
    has_distance |= limit->target == SBF_JOINT_AXIS_DISTANCE;
    g->rigid->losses[SBFI_RIGID_BOUNCING_LIMITS] += limit->restitution > 0;
    if (!sbfi_joint_is_free(joint->kind, limit->target)) continue;
    if (limit->target == SBF_JOINT_AXIS_DISTANCE)
      write_limit(w, false, 7, limit);
    else if (limit->target == SBF_JOINT_AXIS_SWING)
      write_limit(w, true, 6, limit); /* a cone about X */
    else if (limit->target < SBF_JOINT_AXIS_TWIST)
      write_limit(w, false, 1u << limit->target, limit);
    else
      write_limit(w, true, 1u << (limit->target - SBF_JOINT_AXIS_TWIST), limit);
  }
  if (joint->kind != SBF_JOINT_KIND_DISTANCE || has_distance) return;
  sbf_limit rest = {.min = rest_distance(g->e->asset, joint)};
  rest.max = rest.min;
  write_limit(w, false, 7, &rest);
}

static void write_drive(item_writer *w, const sbf_drive *drive, bool angular, unsigned axis) {
  sbfi_export_print(w->text, "%s{\"type\":\"%s\",\"mode\":\"force\",\"axis\":%u", w->count++ ? "," : "",
      angular ? "angular" : "linear", axis);
  if (drive->stiffness > 0) {
    write_number(w->text, "positionTarget", drive->position);
    write_number(w->text, "stiffness", drive->stiffness);
  }
  if (drive->damping > 0) {
    write_number(w->text, "velocityTarget", drive->velocity);
    write_number(w->text, "damping", drive->damping);
  }
  if (drive->maximum > 0) write_number(w->text, "maxForce", drive->maximum);
  sbfi_text_char(w->text, '}');
}

static void write_drives(sbfi_glb *g, item_writer *w, const sbf_joint *joint) {
  for (uint32_t i = 0; i < joint->drives.count; i++) {
    const sbf_drive *drive = &joint->drives.at[i];
    if (!(drive->stiffness > 0 || drive->damping > 0)) continue;
    bool is_one = drive->target <= SBF_JOINT_AXIS_SWING_Z && sbfi_joint_is_free(joint->kind, drive->target);
    g->rigid->losses[SBFI_RIGID_DRIVES] += !is_one;
    if (is_one) write_drive(w, drive, drive->target >= SBF_JOINT_AXIS_TWIST, (unsigned)drive->target % 3);
  }
}

void sbfi_glb_write_rigid_joint(sbfi_glb *g, const sbf_joint *joint) {
  sbfi_text *text = &g->rigid->joints;
  item_writer limits = {text, 0}, drives = {text, 0};
  sbfi_text_string(text, g->rigid->joint_count++ ? ",{\"name\":" : "{\"name\":");
  sbfi_glb_write_string(text, *joint->name ? joint->name : joint->id);
  sbfi_text_string(text, ",\"limits\":[");
  write_locked(&limits, joint);
  write_limits(g, &limits, joint);
  sbfi_text_string(text, "],\"drives\":[");
  write_drives(g, &drives, joint);
  sbfi_text_string(text, "]}");
  g->rigid->losses[SBFI_RIGID_BREAKING] += joint->break_force > 0 || joint->break_torque > 0;
}
