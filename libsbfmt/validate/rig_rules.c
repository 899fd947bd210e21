/* Bones, sections, rigid bodies, joints, gait. */
#include <math.h>
#include <string.h>

#include "model/place.h"
#include "validate/validation.h"

static bool is_unit(sbf_quat q) {
  return fabsf(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 1e-3f;
}

static void check_bones(sbfi_validation *v) {
  const sbf_bone_list bones = v->asset->bones;
  for (uint32_t i = 0; i < bones.count; i++) {
    sbfi_path path = sbfi_path_of("/sbf/skeleton/bone[%u]", i + 1);
    if (!is_unit(bones.at[i].rotation))
      sbfi_found(v, SBF_CODE_ROTATION_NOT_UNIT, path.text, -1,
          "the rotation of bone '%s' is not of unit length", bones.at[i].name);
    for (uint32_t k = 0; k < i; k++)
      if (bones.at[i].name[0] && strcmp(bones.at[i].name, bones.at[k].name) == 0)
        sbfi_found(v, SBF_CODE_NAME_REPEATED, path.text, -1, "bone %u has the name '%s' too", k + 1,
            bones.at[i].name);
  }
}

static void check_sections(sbfi_validation *v) {
  const sbf_soft_body_list bodies = v->asset->soft_bodies;
  for (uint32_t i = 0; i < bodies.count; i++) {
    sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]", i + 1);
    if (v->asset->bones.count && bodies.at[i].bone < 0 && bodies.at[i].pins.count == 0)
      sbfi_found(v, SBF_CODE_SECTION_NO_BONE, path.text, -1, "body '%s' names no bone and has no pins",
          bodies.at[i].name);
    for (uint32_t k = 0; k < i; k++)
      if (bodies.at[i].name[0] && strcmp(bodies.at[i].name, bodies.at[k].name) == 0)
        sbfi_found(v, SBF_CODE_NAME_REPEATED, path.text, -1, "body %u has the name '%s' too", k + 1,
            bodies.at[i].name);
  }
}

/* A hull's every point must lie behind every face, within a thousandth of its size. */
static bool is_convex(const sbf_polygon_mesh *hull) {
  double size = 0;
  for (uint32_t i = 0; i < hull->positions.count; i++) {
    sbf_vec3 d = {hull->positions.at[i].x - hull->positions.at[0].x,
        hull->positions.at[i].y - hull->positions.at[0].y, hull->positions.at[i].z - hull->positions.at[0].z};
    size = fmax(size, sqrt((double)d.x * d.x + (double)d.y * d.y + (double)d.z * d.z));
  }
  for (uint32_t p = 0, at = 0; p < hull->polygon_sizes.count; at += hull->polygon_sizes.at[p++]) {
    const uint32_t *c = hull->polygon_points.at + at;
    double n[3] = {0, 0, 0}, length;
    for (uint32_t k = 0; k < hull->polygon_sizes.at[p]; k++) {
      sbf_vec3 a = hull->positions.at[c[k]], b = hull->positions.at[c[(k + 1) % hull->polygon_sizes.at[p]]];
      n[0] += ((double)a.y - (double)b.y) * ((double)a.z + (double)b.z);
      n[1] += ((double)a.z - (double)b.z) * ((double)a.x + (double)b.x);
      n[2] += ((double)a.x - (double)b.x) * ((double)a.y + (double)b.y);
    }
    length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (uint32_t i = 0; i < hull->positions.count && length > 0; i++) {
      sbf_vec3 q = hull->positions.at[i], o = hull->positions.at[c[0]];
      double above =
          (((double)q.x - o.x) * n[0] + ((double)q.y - o.y) * n[1] + ((double)q.z - o.z) * n[2]) / length;
      if (above > 1e-3 * size) return false;
    }
  }
  return true;
}

static void check_bodies(sbfi_validation *v) {
  for (uint32_t i = 0; i < v->asset->rigid_bodies.count; i++) {
    const sbf_rigid_body *body = &v->asset->rigid_bodies.at[i];
    sbfi_path path = sbfi_path_of("/sbf/rigid_bodies/rigid_body[%u]", i + 1);
    if (body->hull && !is_convex(body->hull))
      sbfi_found(v, SBF_CODE_HULL_NOT_CONVEX, path.text, -1, "the hull of '%s' is not convex", body->name);
    if (!body->hull && body->mass == 0 && body->motion == SBF_BODY_MOTION_DYNAMIC)
      sbfi_found(v, SBF_CODE_BODY_NO_MASS, path.text, -1,
          "'%s' is simulated and has neither a hull nor a mass", body->name);
  }
}

static void check_joints(sbfi_validation *v) {
  const sbfi_place root = sbfi_place_root(v->asset);
  const sbfi_field *joints = sbfi_element_field(&sbfi_asset_element, "joints");
  for (uint32_t i = 0; i < v->asset->joints.count; i++) {
    const sbf_joint *joint = &v->asset->joints.at[i];
    sbfi_place place = sbfi_place_child(&root, joints, i); /* numbered among joints of its kind */
    sbfi_path path;
    sbfi_place_path(&place, NULL, path.text, sizeof path.text);
    if (joint->body_a == joint->body_b)
      sbfi_found(v, SBF_CODE_JOINT_ONE_BODY, path.text, -1, "joint '%s' joins a body to itself", joint->name);
    if (!is_unit(joint->frame_a.rotation) || !is_unit(joint->frame_b.rotation))
      sbfi_found(
          v, SBF_CODE_JOINT_FRAME, path.text, -1, "a frame of joint '%s' is not orthonormal", joint->name);
    for (uint32_t l = 0; l < joint->limits.count; l++)
      if (joint->limits.at[l].min > joint->limits.at[l].max)
        sbfi_found(v, SBF_CODE_LIMIT_ORDER, path.text, l,
            "the %s limit of joint '%s' has its minimum above its maximum",
            sbf_joint_axis_name(joint->limits.at[l].target), joint->name);
  }
}

static void check_gaits(sbfi_validation *v) {
  for (uint32_t g = 0; g < v->asset->gaits.count; g++)
    for (uint32_t l = 0; l < v->asset->gaits.at[g].legs.count; l++) {
      const sbf_ik_chain *chain = &v->asset->ik_chains.at[v->asset->gaits.at[g].legs.at[l].ik];
      int32_t bone = chain->end;
      while (bone >= 0 && bone != chain->root) bone = v->asset->bones.at[bone].parent;
      if (bone < 0)
        sbfi_found(v, SBF_CODE_IK_CHAIN_BROKEN, sbfi_path_of("/sbf/gait[%u]/leg[%u]", g + 1, l + 1).text, -1,
            "the end '%s' of the leg's chain does not hang below its root '%s'",
            v->asset->bones.at[chain->end].name, v->asset->bones.at[chain->root].name);
    }
}

void sbfi_check_rig(sbfi_validation *v) {
  check_bones(v);
  check_sections(v);
  check_bodies(v);
  check_joints(v);
  check_gaits(v);
}
