/* Limits of bones relative to their parents, from the joints between the bodies that move with them. */
#include "animation/skeleton/rig_limits.h"
#include "math/trig.h"
#include "mechanics/joint_freedom.h"

static const float ALL_ROUND = 3.2f; /* beyond half a turn: no bound */

static int32_t bone_of(const sbf_asset *asset, int32_t body) {
  return body >= 0 ? asset->rigid_bodies.at[body].bone : -1;
}

/* Rotations that the kind of joint leaves free or locks at 0. */
static void open_kind(sbf_joint_kind kind, sbri_joint_limit *limit) {
  float twist = sbfi_joint_is_free(kind, SBF_JOINT_AXIS_TWIST) ? ALL_ROUND : 0;
  float swing = sbfi_joint_is_free(kind, SBF_JOINT_AXIS_SWING) ? ALL_ROUND : 0;
  limit->twist[0] = -twist, limit->twist[1] = twist;
  limit->swing_y[0] = limit->swing_z[0] = -swing;
  limit->swing_y[1] = limit->swing_z[1] = limit->cone = swing;
}

static void narrow(float range[2], const sbf_limit *limit) {
  if (limit->min > range[0]) range[0] = limit->min;
  if (limit->max < range[1]) range[1] = limit->max;
}

static void copy_limit(const sbf_limit *from, sbri_joint_limit *limit) {
  if (from->target == SBF_JOINT_AXIS_TWIST) narrow(limit->twist, from);
  if (from->target == SBF_JOINT_AXIS_SWING_Y) narrow(limit->swing_y, from);
  if (from->target == SBF_JOINT_AXIS_SWING_Z) narrow(limit->swing_z, from);
  if (from->target == SBF_JOINT_AXIS_SWING && from->max < limit->cone) limit->cone = from->max;
}

static bool rotates(sbf_joint_kind kind) {
  return kind != SBF_JOINT_KIND_DISTANCE && kind != SBF_JOINT_KIND_PULLEY;
}

void sbri_rig_find_limits(const sbri_rig *rig, sbri_joint_limit *limits) {
  const sbf_asset *asset = rig->asset;
  for (uint32_t i = 0; i < rig->bones.count; i++) limits[i] = (sbri_joint_limit){.active = false};
  for (uint32_t j = 0; j < asset->joints.count; j++) {
    const sbf_joint *joint = &asset->joints.at[j];
    int32_t bone = bone_of(asset, joint->body_b), parent = bone_of(asset, joint->body_a);
    if (!rotates(joint->kind) || bone < 0 || rig->bones.parents[bone] != parent || limits[bone].active)
      continue;
    sbri_joint_limit *limit = &limits[bone];
    sbf_quat frame_a = sbri_quat_normalize(joint->frame_a.rotation);
    sbf_quat frame_b = sbri_quat_normalize(joint->frame_b.rotation);
    sbf_quat above = parent >= 0 ? rig->bones.rest[parent].rotation : sbri_quat_identity();
    /* Q = frame_a^-1 (parent's rotation since rest)^-1 (bone's rotation since rest) frame_b */
    limit->before = sbri_quat_multiply(sbri_quat_conjugate(frame_a), above);
    limit->after = sbri_quat_multiply(sbri_quat_conjugate(rig->bones.rest[bone].rotation), frame_b);
    open_kind(joint->kind, limit);
    for (uint32_t k = 0; k < joint->limits.count; k++) copy_limit(&joint->limits.at[k], limit);
    limit->active = true;
    sbri_joint_limit_ready(limit);
    /* A limit that the rest pose violates is ignored. */
    if (sbri_joint_limit_excess(limit, rig->bones.rest_local[bone].rotation) > 1e-3f) limit->active = false;
  }
}

float sbri_rig_limit_excess(const sbri_rig *rig, const sbr_transform *pose) {
  float worst = 0;
  for (uint32_t i = 0; i < rig->bones.count; i++) {
    int32_t parent = rig->bones.parents[i];
    if (!rig->bones.limits[i].active || parent < 0) continue;
    sbf_quat local = sbri_quat_multiply(sbri_quat_conjugate(pose[parent].rotation), pose[i].rotation);
    float excess = sbri_joint_limit_excess(&rig->bones.limits[i], local);
    worst = excess > worst ? excess : worst;
  }
  return worst;
}

/* Distance of hip and ankle for a bend of the knee: 0 is straight. */
static float span_at(const sbri_leg *leg, float bend) {
  float a = leg->length.upper, b = leg->length.lower, sine, cosine;
  sbri_sincos(bend, &sine, &cosine);
  return sqrtf(a * a + b * b + 2 * a * b * cosine);
}

float sbri_rig_leg_reach(const sbri_rig *rig, const sbri_leg *leg) {
  float length = leg->length.upper + leg->length.lower;
  if (leg->lower < 0 || !rig->bones.limits[leg->lower].active) return length;
  sbf_vec3 hip = rig->bones.rest[leg->upper].position, knee = rig->bones.rest[leg->lower].position;
  sbf_vec3 ankle = rig->bones.rest[leg->foot].position, thigh = sbri_sub(knee, hip),
           shin = sbri_sub(ankle, knee);
  float cosine = sbri_dot(thigh, shin) / (leg->length.upper * leg->length.lower), bend = sbri_acos(cosine);
  sbf_vec3 side = sbri_cross(sbri_sub(ankle, hip), sbri_sub(knee, hip)); /* as in the leg solver */
  if (sbri_length(side) < 1e-6f * length * length)
    side = sbri_cross(sbri_sub(ankle, hip), sbri_sub(leg->pole.direction, hip));
  side = sbri_normalize(side, sbri_vec3(1, 0, 0));
  if (sbri_dot(sbri_rotate(sbri_quat_about(side, 0.1f), shin), thigh) > sbri_dot(shin, thigh))
    side = sbri_scale(side, -1); /* rotation about it bends the knee more */
  sbf_quat back = sbri_quat_conjugate(rig->bones.rest[leg->upper].rotation);
  float low = 0, high = bend; /* stretched, and at rest */
  for (int pass = 0; pass < 16; pass++) {
    float middle = pass == 0 ? 0 : 0.5f * (low + high);
    sbf_quat turned =
        sbri_quat_multiply(sbri_quat_about(side, middle - bend), rig->bones.rest[leg->lower].rotation);
    bool free =
        sbri_joint_limit_excess(&rig->bones.limits[leg->lower], sbri_quat_multiply(back, turned)) <= 1e-4f;
    if (free && pass == 0) return length;
    *(free ? &high : &low) = middle;
  }
  return span_at(leg, high);
}
