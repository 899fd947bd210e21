/* Writes joints: slides, hinges and balls between a body and its parent; equalities and tendons elsewhere. */
#include <math.h>

#include "export/mjcf.h"
#include "mechanics/joint_freedom.h"

static sbf_quat product(sbf_quat a, sbf_quat b) {
  return (sbf_quat){a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

static sbf_quat conjugate(sbf_quat q) {
  return (sbf_quat){-q.x, -q.y, -q.z, q.w};
}

sbf_vec3 sbfi_mjcf_rotated(sbf_quat q, sbf_vec3 v) {
  sbf_quat r = product(product(q, (sbf_quat){v.x, v.y, v.z, 0}), conjugate(q));
  return (sbf_vec3){r.x, r.y, r.z};
}

static sbf_vec3 origin(const sbf_asset *asset, int32_t body, const sbf_frame *frame) {
  const sbf_vec3 from = body < 0 ? (sbf_vec3){0, 0, 0} : asset->rigid_bodies.at[body].center;
  return (sbf_vec3){from.x + frame->position.x, from.y + frame->position.y, from.z + frame->position.z};
}

/* The six coordinates at rest (specification, 8.3). */
static void coordinates_at_rest(const sbf_asset *asset, const sbf_joint *joint, float c[6]) {
  const sbf_vec3 a = origin(asset, joint->body_a, &joint->frame_a);
  const sbf_vec3 b = origin(asset, joint->body_b, &joint->frame_b);
  const sbf_quat back = conjugate(joint->frame_a.rotation);
  const sbf_vec3 o = sbfi_mjcf_rotated(back, (sbf_vec3){b.x - a.x, b.y - a.y, b.z - a.z});
  sbf_quat q = product(back, joint->frame_b.rotation);
  if (q.w < 0) q = (sbf_quat){-q.x, -q.y, -q.z, -q.w};
  c[0] = o.x, c[1] = o.y, c[2] = o.z;
  double half = sqrt((double)q.x * q.x + (double)q.w * q.w);
  c[3] = half > 0 ? (float)(2 * atan2(q.x, q.w)) : 0;
  sbf_quat twist =
      half > 0 ? (sbf_quat){(float)(q.x / half), 0, 0, (float)(q.w / half)} : (sbf_quat){0, 0, 0, 1};
  sbf_quat swing = product(q, conjugate(twist));
  double sine = sqrt((double)swing.y * swing.y + (double)swing.z * swing.z);
  double factor = sine > 1e-9 ? 2 * atan2(sine, swing.w) / sine : 2;
  c[4] = (float)(factor * swing.y);
  c[5] = (float)(factor * swing.z);
}

/* Limits and drives of one coordinate; a cone limits both swings. */
typedef struct motion {
  bool free, bounded, driven;
  float min, max, stiffness, damping, position;
} motion;

static void find_motions(mjcf_writer *w, const sbf_joint *joint, motion motions[6]) {
  for (int k = 0; k < 6; k++)
    motions[k] =
        (motion){!(sbfi_joint_is_locked(joint->kind) >> k & 1), false, false, -INFINITY, INFINITY, 0, 0, 0};
  for (uint32_t i = 0; i < joint->limits.count; i++) {
    const sbf_limit *limit = &joint->limits.at[i];
    w->unsupported.soft_limits += limit->stiffness > 0;
    for (unsigned k = 0; k < 6; k++) {
      bool cone = limit->target == SBF_JOINT_AXIS_SWING && k >= SBF_JOINT_AXIS_SWING_Y;
      if (k != (unsigned)limit->target && !cone) continue;
      float lower = cone ? -limit->max : limit->min;
      motions[k].bounded = true;
      motions[k].min = lower > motions[k].min ? lower : motions[k].min;
      motions[k].max = limit->max < motions[k].max ? limit->max : motions[k].max;
    }
  }
  for (uint32_t i = 0; i < joint->drives.count; i++) {
    const sbf_drive *drive = &joint->drives.at[i];
    w->unsupported.drives +=
        drive->velocity != 0 || drive->maximum > 0 || drive->target == SBF_JOINT_AXIS_DISTANCE;
    for (unsigned k = 0; k < 6; k++) {
      bool cone = drive->target == SBF_JOINT_AXIS_SWING && k >= SBF_JOINT_AXIS_SWING_Y;
      if (k != (unsigned)drive->target && !cone) continue;
      motions[k].driven = true;
      motions[k].stiffness = drive->stiffness;
      motions[k].damping = drive->damping;
      motions[k].position = cone ? 0 : drive->position;
    }
  }
  for (int k = 0; k < 6; k++)
    if (motions[k].bounded && !(motions[k].min < motions[k].max)) motions[k].free = false;
}

static void begin_joint(mjcf_writer *w, const sbf_joint *joint, uint32_t index, const char *part,
    const char *type, sbf_vec3 anchor) {
  sbfi_text_string(&w->e->text, "      <joint name=\"");
  sbfi_mjcf_name(w, joint->id, index);
  sbfi_export_format(w->e, ":%s\" type=\"%s\"", part, type);
  sbfi_mjcf_write_vec3(w, "pos", anchor);
}

/* MJCF's first joint of a body moves with the parent, the last with the body. Slides and swings belong to
 * body a, the twist to body b. */
void sbfi_mjcf_write_joint(mjcf_writer *w, const sbf_joint *joint, uint32_t index, bool forward) {
  static const char *const parts[6] = {"linear_x", "linear_y", "linear_z", "twist", "swing_y", "swing_z"};
  static const int order[6] = {0, 1, 2, 5, 4, 3};
  motion motions[6];
  float rest[6];
  const sbf_vec3 anchor = forward ? joint->frame_b.position : joint->frame_a.position;
  find_motions(w, joint, motions);
  coordinates_at_rest(w->e->asset, joint, rest);
  w->unsupported.breaking += joint->break_force > 0 || joint->break_torque > 0;
  w->unsupported.touching += joint->collide;
  bool ball = true;
  for (int k = 3; k < 6; k++) ball = ball && motions[k].free && !motions[k].bounded && !motions[k].driven;
  for (int i = 0; i < 6; i++) {
    int k = forward ? order[i] : order[5 - i];
    if (!motions[k].free) continue;
    if (ball && k > 3) continue;
    if (ball && k == 3) {
      begin_joint(w, joint, index, "ball", "ball", anchor);
      sbfi_text_string(&w->e->text, "/>\n");
      continue;
    }
    sbf_vec3 axis = {k % 3 == 0, k % 3 == 1, k % 3 == 2};
    axis = sbfi_mjcf_rotated(k == 3 ? joint->frame_b.rotation : joint->frame_a.rotation, axis);
    if (!forward) axis = (sbf_vec3){0 - axis.x, 0 - axis.y, 0 - axis.z};
    begin_joint(w, joint, index, parts[k], k < 3 ? "slide" : "hinge", anchor);
    sbfi_mjcf_write_vec3(w, "axis", axis);
    if (rest[k] != 0) sbfi_mjcf_write_f32(w, "ref", rest[k]);
    if (motions[k].bounded) {
      sbfi_text_string(&w->e->text, " range=\"");
      sbfi_text_f32(&w->e->text, motions[k].min);
      sbfi_text_char(&w->e->text, ' ');
      sbfi_text_f32(&w->e->text, motions[k].max);
      sbfi_text_char(&w->e->text, '"');
    }
    if (motions[k].driven) {
      sbfi_mjcf_write_f32(w, "stiffness", motions[k].stiffness);
      sbfi_mjcf_write_f32(w, "springref", motions[k].position);
      sbfi_mjcf_write_f32(w, "damping", motions[k].damping);
    }
    sbfi_text_string(&w->e->text, "/>\n");
  }
}

/* ---- Joints outside the tree ---- */

static void write_pair(mjcf_writer *w, const sbf_joint *joint) {
  /* body2 defaults to the world, and body1 is required. */
  bool is_swapped = joint->body_a < 0;
  sbfi_text_string(&w->e->text, " body1=\"");
  sbfi_mjcf_rigid_name(w, is_swapped ? joint->body_b : joint->body_a);
  sbfi_text_string(&w->e->text, "\" body2=\"");
  sbfi_mjcf_rigid_name(w, is_swapped ? joint->body_a : joint->body_b);
  sbfi_text_char(&w->e->text, '"');
}

static void write_connect(
    mjcf_writer *w, const sbf_joint *joint, uint32_t index, const char *part, float out) {
  const sbf_frame *frame = joint->body_a < 0 ? &joint->frame_b : &joint->frame_a;
  const sbf_vec3 along = sbfi_mjcf_rotated(frame->rotation, (sbf_vec3){out, 0, 0});
  const sbf_vec3 p = frame->position;
  sbfi_text_string(&w->e->text, "    <connect name=\"");
  sbfi_mjcf_name(w, joint->id, index);
  sbfi_export_format(w->e, ":%s\"", part);
  write_pair(w, joint);
  sbfi_mjcf_write_vec3(w, "anchor", (sbf_vec3){p.x + along.x, p.y + along.y, p.z + along.z});
  sbfi_text_string(&w->e->text, "/>\n");
}

/* Limits of a distance; false if it keeps its rest value. */
static bool range_of(const sbf_joint *joint, float *min, float *max) {
  for (uint32_t i = 0; i < joint->limits.count; i++) {
    const sbf_limit *limit = &joint->limits.at[i];
    if (limit->target != SBF_JOINT_AXIS_DISTANCE || !(limit->min < limit->max)) continue;
    *min = limit->min, *max = limit->max;
    return true;
  }
  return false;
}

static void write_equality(mjcf_writer *w, const sbf_joint *joint, uint32_t index) {
  float min, max;
  if (joint->kind != SBF_JOINT_KIND_DISTANCE)
    w->unsupported.loop_bounds += joint->limits.count + joint->drives.count;
  w->unsupported.breaking += joint->break_force > 0 || joint->break_torque > 0;
  if (joint->kind == SBF_JOINT_KIND_FIXED) {
    sbfi_text_string(&w->e->text, "    <weld name=\"");
    sbfi_mjcf_name(w, joint->id, index);
    sbfi_text_char(&w->e->text, '"');
    write_pair(w, joint);
    sbfi_text_string(&w->e->text, "/>\n");
  } else if (joint->kind == SBF_JOINT_KIND_SPHERICAL) {
    write_connect(w, joint, index, "ball", 0);
  } else if (joint->kind == SBF_JOINT_KIND_REVOLUTE) {
    write_connect(w, joint, index, "near", -0.05f);
    write_connect(w, joint, index, "far", 0.05f);
  } else if (joint->kind == SBF_JOINT_KIND_DISTANCE) {
    if (range_of(joint, &min, &max)) return;
    sbfi_text_string(&w->e->text, "    <tendon name=\"");
    sbfi_mjcf_name(w, joint->id, index);
    sbfi_text_string(&w->e->text, "\" tendon1=\"");
    sbfi_mjcf_name(w, joint->id, index);
    sbfi_text_string(&w->e->text, "\"/>\n");
  } else if (joint->kind == SBF_JOINT_KIND_PULLEY) {
    w->unsupported.pulleys++;
  } else {
    w->unsupported.loops++;
  }
}

static void write_tendon(mjcf_writer *w, const sbf_joint *joint, uint32_t index) {
  float min, max;
  sbfi_text_string(&w->e->text, "    <spatial name=\"");
  sbfi_mjcf_name(w, joint->id, index);
  sbfi_text_char(&w->e->text, '"');
  if (range_of(joint, &min, &max)) {
    sbfi_text_string(&w->e->text, " range=\"");
    sbfi_text_f32(&w->e->text, min);
    sbfi_text_char(&w->e->text, ' ');
    sbfi_text_f32(&w->e->text, max);
    sbfi_text_char(&w->e->text, '"');
  }
  sbfi_text_char(&w->e->text, '>');
  for (char side = 'a'; side <= 'b'; side++) {
    sbfi_text_string(&w->e->text, "<site site=\"");
    sbfi_mjcf_name(w, joint->id, index);
    sbfi_export_format(w->e, ":%c\"/>", side);
  }
  sbfi_text_string(&w->e->text, "</spatial>\n");
}

void sbfi_mjcf_write_constraints(mjcf_writer *w) {
  const sbf_joint_list joints = w->e->asset->joints;
  if (!joints.count) return;
  sbfi_text_string(&w->e->text, "  <tendon>\n");
  for (uint32_t j = 0; j < joints.count; j++)
    if (joints.at[j].kind == SBF_JOINT_KIND_DISTANCE) write_tendon(w, &joints.at[j], j);
  sbfi_text_string(&w->e->text, "  </tendon>\n  <equality>\n");
  for (uint32_t j = 0; j < joints.count; j++)
    if (!w->is_tree[j]) write_equality(w, &joints.at[j], j);
  sbfi_text_string(&w->e->text, "  </equality>\n");
}
