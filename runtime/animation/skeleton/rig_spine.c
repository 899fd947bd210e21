#include "animation/skeleton/rig_spine.h"

#include "math/quat.h"

static const sbf_gait *gait_of(const sbf_asset *asset) {
  return asset->gaits.count ? &asset->gaits.at[0] : NULL;
}

static uint32_t chain_length(const sbf_asset *asset) {
  const sbf_gait *gait = gait_of(asset);
  return gait && gait->undulation ? gait->undulation->bones.count : 0;
}

static bool has_rest_pose(const sbf_asset *asset) {
  return gait_of(asset) && gait_of(asset)->rest_pose != SBF_NONE;
}

size_t sbri_rig_spine_size(const sbf_asset *asset) {
  size_t n = chain_length(asset), posed = has_rest_pose(asset) ? asset->bones.count : 0;
  return posed * sizeof(sbr_transform) + n * 2 * sizeof(sbf_vec3) + n * 2 * sizeof(float);
}

static void take(sbri_rig *rig, sbf_vec3 p, bool *any) {
  if (!*any) rig->stand.low = rig->stand.high = p;
  *any = true;
  rig->stand.low = sbri_vec3(p.x < rig->stand.low.x ? p.x : rig->stand.low.x,
      p.y < rig->stand.low.y ? p.y : rig->stand.low.y, p.z < rig->stand.low.z ? p.z : rig->stand.low.z);
  rig->stand.high = sbri_vec3(p.x > rig->stand.high.x ? p.x : rig->stand.high.x,
      p.y > rig->stand.high.y ? p.y : rig->stand.high.y, p.z > rig->stand.high.z ? p.z : rig->stand.high.z);
}

static sbf_vec3 tail_of(const sbri_rig *rig, uint32_t bone) {
  sbf_vec3 along = {0, rig->asset->bones.at[bone].length, 0};
  return sbri_add(rig->bones.rest[bone].position, sbri_rotate(rig->bones.rest[bone].rotation, along));
}

/* Bounds of the visible parts; else of the bodies; else of the bones. */
static void find_bounds(sbri_rig *rig) {
  const sbf_asset *asset = rig->asset;
  bool any = false;
  for (uint32_t m = 0; m < asset->render_meshes.count; m++)
    for (uint32_t i = 0; i < asset->render_meshes.at[m].mesh.positions.count; i++)
      take(rig, asset->render_meshes.at[m].mesh.positions.at[i], &any);
  bool seen = any;
  for (uint32_t b = 0; !seen && b < asset->soft_bodies.count; b++)
    for (uint32_t i = 0; i < asset->soft_bodies.at[b].surface.positions.count; i++)
      take(rig, asset->soft_bodies.at[b].surface.positions.at[i], &any);
  bool bodies = any;
  for (uint32_t i = 0; !bodies && i < rig->bones.count; i++) {
    take(rig, rig->bones.rest[i].position, &any);
    take(rig, tail_of(rig, i), &any);
  }
}

static sbf_vec3 middle_of(const sbri_rig *rig, uint32_t bone) {
  return sbri_lerp(rig->bones.rest[bone].position, tail_of(rig, bone), 0.5f);
}

static float distance(sbf_vec3 a, sbf_vec3 b) {
  return sbri_length(sbri_sub(a, b));
}

/* Front and back end of each bone, and their positions along the chain. */
static void find_chain(
    sbri_rig *rig, const sbf_undulation *wave, sbf_vec3 *joints, float *middles, float *heads) {
  uint32_t n = wave->bones.count;
  float along = 0;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t bone = wave->bones.at[k];
    sbf_vec3 head = rig->bones.rest[bone].position, tail = tail_of(rig, bone);
    bool leads = true; /* its head is the end towards the nose */
    if (k + 1 < n) {
      sbf_vec3 next = middle_of(rig, wave->bones.at[k + 1]);
      leads = distance(head, next) >= distance(tail, next);
    } else if (n > 1) {
      sbf_vec3 last = middle_of(rig, wave->bones.at[k - 1]);
      leads = distance(head, last) <= distance(tail, last);
    }
    joints[2 * k] = leads ? head : tail, joints[2 * k + 1] = leads ? tail : head;
    if (k > 0) along += distance(joints[2 * k - 1], joints[2 * k]);
    float length = distance(head, tail);
    middles[k] = along + 0.5f * length;
    heads[k] = leads ? along : along + length;
    along += length;
  }
  rig->wave.length = wave->length > 0 ? wave->length : along;
  float beyond = 0.5f * (rig->wave.length - along), scale = rig->wave.length > 0 ? 1 / rig->wave.length : 0;
  for (uint32_t k = 0; k < n; k++) {
    middles[k] = sbri_clamp((middles[k] + beyond) * scale, 0, 1);
    heads[k] = sbri_clamp((heads[k] + beyond) * scale, 0, 1);
  }
}

static void find_base(const sbri_rig *rig, const sbf_pose *pose, sbr_transform *base) {
  for (uint32_t i = 0; i < rig->bones.count; i++) base[i] = rig->bones.rest_local[i];
  for (uint32_t k = 0; k < pose->keys.count; k++) {
    const sbf_pose_key *key = &pose->keys.at[k];
    const sbr_transform *rest = &rig->bones.rest_local[key->bone];
    base[key->bone].position = sbri_add(rest->position, key->translation);
    base[key->bone].rotation =
        sbri_quat_normalize(sbri_quat_multiply(rest->rotation, sbri_quat_normalize(key->rotation)));
  }
}

void sbri_rig_find_spine(sbri_rig *rig, void *memory) {
  uint32_t n = chain_length(rig->asset);
  sbr_transform *base = memory;
  rig->bones.base_local = rig->bones.rest_local;
  if (has_rest_pose(rig->asset)) {
    find_base(rig, &rig->asset->poses.at[rig->gait->rest_pose], base);
    rig->bones.base_local = base;
    base += rig->bones.count;
  }
  sbf_vec3 *joints = (sbf_vec3 *)(void *)base;
  float *middles = (float *)(void *)(joints + 2 * n), *heads = middles + n;
  rig->wave.joints = joints, rig->wave.middles = middles, rig->wave.heads = heads;
  if (n) find_chain(rig, rig->gait->undulation, joints, middles, heads);
  if (rig->gait && rig->gait->kind != SBF_GAIT_KIND_WALK) find_bounds(rig);
}
