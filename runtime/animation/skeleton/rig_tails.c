#include "animation/skeleton/rig_tails.h"

#include "animation/skeleton/bone_points.h"
#include "math/quat.h"
#include "math/vec3.h"

static const float MARGIN = 1.1f; /* factor on the skin's depth below the bone */

static const sbf_chain *chain_of(const sbf_asset *asset, uint32_t tail) {
  return &asset->chains.at[asset->gaits.at[0].tails.at[tail].chain];
}

static uint32_t tail_count(const sbf_asset *asset) {
  return asset->gaits.count ? asset->gaits.at[0].tails.count : 0;
}

static size_t headers_size(const sbf_asset *asset) {
  return (tail_count(asset) * sizeof(sbri_tail) + 15) & ~(size_t)15;
}

size_t sbri_rig_tails_size(const sbf_asset *asset) {
  size_t bones = 0;
  for (uint32_t t = 0; t < tail_count(asset); t++) bones += chain_of(asset, t)->bones.count;
  return headers_size(asset) + bones * sizeof(sbri_tail_bone);
}

typedef struct depths {
  const sbri_tail *tails;
  sbri_tail_bone *bones; /* of all tails */
} depths;

/* Updates the depth of a point below its bone's axis. */
static void deepen(void *user, const sbri_rig *rig, int32_t bone, sbf_vec3 position) {
  const depths *d = user;
  for (uint32_t t = 0; t < rig->tails.count; t++)
    for (uint32_t k = 0; k < d->tails[t].bone_count; k++) {
      if (d->tails[t].bone_indices[k] != (uint32_t)bone) continue;
      sbri_tail_bone *own = &d->bones[d->tails[t].first_state + k];
      sbf_vec3 from_head = sbri_sub(position, rig->bones.rest[bone].position);
      float length_squared = sbri_dot(own->step, own->step);
      float along = length_squared > 0 ? sbri_dot(from_head, own->step) / length_squared : 0;
      float depth = sbri_clamp(along, 0, 1) * own->step.y - from_head.y;
      if (depth > own->clearance) own->clearance = depth;
    }
}

static sbf_vec3 step_of(const sbri_rig *rig, const sbri_tail *tail, uint32_t k) {
  uint32_t bone = tail->bone_indices[k];
  const sbr_transform *rest = &rig->bones.rest[bone];
  if (k + 1 < tail->bone_count)
    return sbri_sub(rig->bones.rest[tail->bone_indices[k + 1]].position, rest->position);
  return sbri_rotate(rest->rotation, sbri_vec3(0, rig->asset->bones.at[bone].length, 0));
}

/* A joint has the larger clearance of its two bones, but at most that at rest. */
static void set_clearances(const sbri_rig *rig, const sbri_tail *tail, sbri_tail_bone *bones) {
  for (uint32_t k = 0; k < tail->bone_count; k++) {
    float tip_y = rig->bones.rest[tail->bone_indices[k]].position.y + bones[k].step.y,
          wanted = bones[k].clearance;
    if (k + 1 < tail->bone_count) wanted = fmaxf(wanted, bones[k + 1].clearance);
    bones[k].clearance = fminf(MARGIN * wanted, fmaxf(tip_y, 0));
  }
}

void sbri_rig_find_tails(sbri_rig *rig, void *memory) {
  sbri_tail *tails = memory;
  sbri_tail_bone *bones = (void *)((char *)memory + headers_size(rig->asset));
  rig->tails.at = tails;
  for (uint32_t t = 0; t < tail_count(rig->asset); t++) {
    const sbf_tail *from = &rig->gait->tails.at[t];
    const sbf_chain *chain = chain_of(rig->asset, t);
    tails[t] = (sbri_tail){chain->bones.at, bones + rig->tails.bone_count, chain->bones.count,
        rig->tails.bone_count, from->frequency, from->damping_ratio, from->limit};
    rig->tails.bone_count += chain->bones.count;
    rig->tails.count++;
    for (uint32_t k = 0; k < chain->bones.count; k++)
      bones[tails[t].first_state + k] = (sbri_tail_bone){.step = step_of(rig, &tails[t], k)};
  }
  sbri_rig_visit_points(rig, deepen, &(depths){tails, bones});
  for (uint32_t t = 0; t < rig->tails.count; t++)
    set_clearances(rig, &tails[t], bones + tails[t].first_state);
}

bool sbri_rig_moves_as_tail(const sbri_rig *rig, uint32_t chain) {
  for (uint32_t t = 0; rig->gait && t < rig->gait->tails.count; t++)
    if (rig->gait->tails.at[t].chain == (int32_t)chain) return true;
  return false;
}
