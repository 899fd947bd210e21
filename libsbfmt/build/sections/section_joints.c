#include "build/sections/section_joints.h"

#include <string.h>

/* Frame of the bone with cyclically permuted axes: multiplication from the right by a rotation of 120
 * degrees about (1, 1, 1). */
static sbf_quat joint_rotation(sbf_quat q) {
  const double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w;
  double out[4] = {w + x + y - z, w - x + y + z, w + x - y + z, w - x - y - z};
  double scale = out[3] < 0 ? -0.5 : 0.5;
  return (sbf_quat){
      (float)(out[0] * scale), (float)(out[1] * scale), (float)(out[2] * scale), (float)(out[3] * scale)};
}

sbf_frame sbfi_bone_joint_frame(const sbf_bone *bone, const sbf_rigid_body *body) {
  sbf_frame frame;
  sbf_frame_init(&frame);
  frame.position =
      (sbf_vec3){bone->head.x - body->center.x, bone->head.y - body->center.y, bone->head.z - body->center.z};
  frame.rotation = joint_rotation(bone->rotation);
  return frame;
}

static bool is_point_pinned(const sbf_asset *asset, uint32_t authored, int32_t body) {
  for (uint32_t j = 0; j < authored; j++)
    if (asset->joints.at[j].body_b == body) return true;
  return false;
}

static void fill(sbf_joint *to, const sbf_asset *asset, int32_t a, int32_t b) {
  const sbf_rigid_body *bodies = asset->rigid_bodies.at;
  const sbf_bone *bone = &asset->bones.at[bodies[b].bone];
  sbf_joint_init(to);
  to->name = bone->name;
  to->kind = SBF_JOINT_KIND_SPHERICAL;
  to->body_a = a;
  to->body_b = b;
  to->frame_a = sbfi_bone_joint_frame(bone, &bodies[a]);
  to->frame_b = sbfi_bone_joint_frame(bone, &bodies[b]);
  to->proposed = true;
}

bool sbfi_section_joints_make(sbf_asset *asset, int32_t derivation, sbfi_ids *ids, sbfi_arena *scratch) {
  uint32_t bones = asset->bones.count, authored = asset->joints.count, count = authored;
  int32_t *body_of_bone = sbfi_arena_allocate(scratch, (size_t)bones + 1, sizeof *body_of_bone);
  uint8_t *is_cut = sbfi_arena_allocate(scratch, (size_t)bones + 1, 1);
  sbf_joint *joints = sbf_asset_allocate(asset, (size_t)authored + bones + 1, sizeof *joints);
  if (!body_of_bone || !is_cut || !joints) return false;
  if (authored) memcpy(joints, asset->joints.at, authored * sizeof *joints);
  for (uint32_t b = 0; b < bones; b++) body_of_bone[b] = SBF_NONE;
  for (uint32_t i = asset->rigid_bodies.count; i-- > 0;)
    if (asset->rigid_bodies.at[i].bone != SBF_NONE) body_of_bone[asset->rigid_bodies.at[i].bone] = (int32_t)i;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    if (asset->soft_bodies.at[i].derived != SBF_NONE && asset->soft_bodies.at[i].bone != SBF_NONE)
      is_cut[asset->soft_bodies.at[i].bone] = 1;
  for (uint32_t b = 0; b < bones; b++) {
    if (!is_cut[b] || body_of_bone[b] == SBF_NONE || is_point_pinned(asset, authored, body_of_bone[b]))
      continue;
    int32_t above = asset->bones.at[b].parent;
    while (above != SBF_NONE && body_of_bone[above] == SBF_NONE) above = asset->bones.at[above].parent;
    if (above == SBF_NONE) continue;
    fill(&joints[count], asset, body_of_bone[above], body_of_bone[b]);
    joints[count].derived = derivation;
    joints[count].id = sbfi_unique_id(ids, "joint_", asset->bones.at[b].id, count, asset);
    if (!joints[count].id) return false;
    count++;
  }
  asset->joints = (sbf_joint_list){count ? joints : NULL, count};
  return true;
}
