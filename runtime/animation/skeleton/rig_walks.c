#include "animation/skeleton/rig_walks.h"

#include "math/quat.h"

static const float SAME_POSITION =
    0.02f; /* fraction of the distance from the plane: tolerance of mirror images */

static bool is_of_walk(const sbf_pose *pose) {
  return pose->distance > 0;
}

static bool is_mirrored(const sbf_asset *asset, float speed) {
  for (uint32_t i = 0; i < asset->poses.count; i++)
    if (is_of_walk(&asset->poses.at[i]) && asset->poses.at[i].speed == speed && asset->poses.at[i].mirrored)
      return true;
  return false;
}

/* Maximum number of poses of all walks, with mirrored ones. */
static size_t frame_count(const sbf_asset *asset) {
  size_t count = 0;
  for (uint32_t i = 0; i < asset->poses.count; i++)
    if (is_of_walk(&asset->poses.at[i])) count += is_mirrored(asset, asset->poses.at[i].speed) ? 2 : 1;
  return count;
}

size_t sbri_walks_size(const sbf_asset *asset) {
  size_t frames = frame_count(asset), n = frames ? asset->bones.count : 0;
  size_t size = frames * (sizeof(sbri_walk) + sizeof(sbri_walk_frame)) + 2 * n * sizeof(uint32_t);
  return size + frames * n * sizeof(sbri_posed_bone);
}

static sbf_vec3 mirrored_position(sbf_vec3 p) {
  return sbri_vec3(-p.x, p.y, p.z);
}

/* Position of the bone's end, asset space. */
static sbf_vec3 tail_of(const sbri_rig *rig, uint32_t bone) {
  sbf_vec3 along = {0, rig->asset->bones.at[bone].length, 0};
  return sbri_add(rig->bones.rest[bone].position, sbri_rotate(rig->bones.rest[bone].rotation, along));
}

uint32_t sbri_mirror_bone(const sbri_rig *rig, uint32_t bone) {
  sbf_vec3 head = mirrored_position(rig->bones.rest[bone].position),
           tail = mirrored_position(tail_of(rig, bone));
  float near = SAME_POSITION * (fabsf(head.x) + fabsf(tail.x) + rig->asset->bones.at[bone].length);
  uint32_t best = bone;
  for (uint32_t k = 0; k <= rig->bones.count; k++) {
    uint32_t i = k ? k - 1 : bone; /* itself first: in the middle another one may match as well */
    float off = sbri_length(sbri_sub(rig->bones.rest[i].position, head));
    if (off >= near) continue; /* its head is too far away */
    off += sbri_length(sbri_sub(tail_of(rig, i), tail));
    if (off < near) near = off, best = i;
  }
  return best;
}

/* The mirrored key of a bone: rotation and translation reflected in asset axes, then expressed in the other
 * bone's axes. */
static sbri_posed_bone mirrored_key(const sbri_rig *rig, uint32_t from, uint32_t to, sbri_posed_bone key) {
  sbf_quat own = rig->bones.rest[from].rotation, other = rig->bones.rest[to].rotation;
  sbf_quat rotation = sbri_quat_multiply(sbri_quat_multiply(own, key.rotation), sbri_quat_conjugate(own));
  rotation = (sbf_quat){rotation.x, -rotation.y, -rotation.z, rotation.w};
  rotation = sbri_quat_multiply(sbri_quat_multiply(sbri_quat_conjugate(other), rotation), other);
  sbf_vec3 direction = key.translation;
  if (rig->bones.parents[from] >= 0)
    direction = sbri_rotate(rig->bones.rest[rig->bones.parents[from]].rotation, direction);
  direction = mirrored_position(direction);
  if (rig->bones.parents[to] >= 0)
    direction = sbri_rotate(sbri_quat_conjugate(rig->bones.rest[rig->bones.parents[to]].rotation), direction);
  return (sbri_posed_bone){direction, sbri_quat_normalize(rotation)};
}

static void fill_frame(const sbri_rig *rig, const sbf_pose *pose, bool mirrored, const uint32_t *position_of,
    sbri_posed_bone *bones, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) bones[i] = (sbri_posed_bone){.rotation = {0, 0, 0, 1}};
  for (uint32_t k = 0; k < pose->keys.count; k++) {
    const sbf_pose_key *key = &pose->keys.at[k];
    uint32_t from = (uint32_t)key->bone, to = mirrored ? sbri_mirror_bone(rig, from) : from;
    sbri_posed_bone posed = {key->translation, sbri_quat_normalize(key->rotation)};
    bones[position_of[to] - 1] = mirrored ? mirrored_key(rig, from, to, posed) : posed;
  }
}

/* Lists the bones that walks move; `position_of` receives the index of each from 1, 0 for others. */
static uint32_t list_bones(const sbri_rig *rig, uint32_t *position_of, uint32_t *bones) {
  const sbf_pose_list *poses = &rig->asset->poses;
  uint32_t count = 0;
  for (uint32_t b = 0; b < rig->bones.count; b++) position_of[b] = 0;
  for (uint32_t i = 0; i < poses->count; i++)
    for (uint32_t k = 0; is_of_walk(&poses->at[i]) && k < poses->at[i].keys.count; k++) {
      uint32_t bone = (uint32_t)poses->at[i].keys.at[k].bone;
      position_of[bone] = 1;
      if (is_mirrored(rig->asset, poses->at[i].speed)) position_of[sbri_mirror_bone(rig, bone)] = 1;
    }
  for (uint32_t b = 0; b < rig->bones.count; b++)
    if (position_of[b]) bones[count] = b, position_of[b] = ++count;
  return count;
}

/* The next pose of a walk after a distance; NULL after the last. */
static const sbf_pose *next_pose(const sbf_asset *asset, float speed, float distance) {
  const sbf_pose *next = NULL;
  for (uint32_t i = 0; i < asset->poses.count; i++) {
    const sbf_pose *pose = &asset->poses.at[i];
    if (is_of_walk(pose) && pose->speed == speed && pose->distance > distance &&
        (!next || pose->distance < next->distance))
      next = pose;
  }
  return next;
}

/* The leg that begins the first half of a mirrored walk, and the opposite one. */
static void find_legs(sbri_walks *walks, const sbri_rig *rig) {
  walks->first_leg = walks->other_leg = -1;
  for (uint32_t i = 1; i < rig->leg_count; i++)
    if ((int32_t)sbri_mirror_bone(rig, (uint32_t)rig->legs[0].foot) == rig->legs[i].foot)
      walks->first_leg = 0, walks->other_leg = (int32_t)i;
}

void sbri_walks_init(sbri_walks *walks, const sbri_rig *rig, void *memory) {
  const sbf_asset *asset = rig->asset;
  size_t max = frame_count(asset);
  *walks = (sbri_walks){.first_leg = -1, .other_leg = -1};
  if (!max) return;
  sbri_walk *walk = memory; /* strictest alignment first */
  sbri_walk_frame *frame = (sbri_walk_frame *)(void *)(walk + max);
  sbri_posed_bone *posed = (sbri_posed_bone *)(void *)(frame + max);
  uint32_t *position_of = (uint32_t *)(void *)(posed + max * rig->bones.count),
           *bones = position_of + rig->bones.count;
  walks->walks = walk;
  walks->bones = bones;
  walks->bone_count = list_bones(rig, position_of, bones);
  for (float speed = -1;;) {
    float next = -1;
    for (uint32_t i = 0; i < asset->poses.count; i++) {
      const sbf_pose *pose = &asset->poses.at[i];
      if (is_of_walk(pose) && pose->speed > speed && (next < 0 || pose->speed < next)) next = pose->speed;
    }
    if (next < 0) break;
    speed = next;
    bool mirrored = is_mirrored(asset, speed);
    float length = 0;
    for (const sbf_pose *p = next_pose(asset, speed, 0); p; p = next_pose(asset, speed, p->distance))
      length = p->distance;
    *walk = (sbri_walk){
        .speed = speed, .cycle_m = mirrored ? 2 * length : length, .mirrored = mirrored, .frames = frame};
    for (uint32_t half = 0; half < (mirrored ? 2u : 1u); half++)
      for (const sbf_pose *p = next_pose(asset, speed, 0); p; p = next_pose(asset, speed, p->distance)) {
        fill_frame(rig, p, half == 1, position_of, posed, walks->bone_count);
        *frame++ = (sbri_walk_frame){(p->distance + (float)half * length) / walk->cycle_m, posed};
        posed += walks->bone_count;
        walk->frame_count++;
      }
    walk++, walks->walk_count++;
  }
  find_legs(walks, rig);
}
