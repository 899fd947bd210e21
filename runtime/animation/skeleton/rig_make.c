#include "animation/skeleton/rig_make.h"

#include "animation/skeleton/rig_belly.h"
#include "animation/skeleton/rig_limits.h"
#include "animation/skeleton/rig_mass.h"
#include "animation/skeleton/rig_soles.h"
#include "animation/skeleton/rig_spine.h"
#include "animation/skeleton/rig_springs.h"
#include "animation/skeleton/rig_tails.h"
#include "animation/skeleton/rig_walks.h"
#include "animation/skeleton/wall_volume.h"
#include "math/quat.h"

/* Fraction of a leg's stretch from rest that the lean of a long foot adds to its reach. */
static const float LEANS = 0.4f;

static size_t rounded(size_t size) {
  return (size + 15) & ~(size_t)15;
}

size_t sbri_rig_size(const sbf_asset *asset) {
  size_t n = asset->bones.count;
  return rounded(n * sizeof(int32_t)) + 2 * rounded(n * sizeof(sbr_transform)) + rounded(n * sizeof(float)) +
         rounded(sbri_rig_tails_size(asset)) + rounded(n) + rounded(n * sizeof(sbri_joint_limit)) +
         3 * rounded(n * sizeof(uint32_t)) + rounded(n * sizeof(sbri_bone_mass)) +
         rounded(asset->chains.count * sizeof(sbri_bone_chain)) + rounded(sbri_walks_size(asset)) +
         rounded(sbri_rig_spine_size(asset)) + rounded(sbri_rig_springs_size(asset)) + 16;
}

static void *carve(char **memory, size_t size) {
  void *at = *memory;
  *memory += rounded(size);
  return at;
}

/* Bones from hips to chest divide the rotation between the two evenly; all others follow their parent. */
static void distribute_spine(const sbri_rig *rig, float *fraction) {
  for (uint32_t i = 0; i < rig->bones.count; i++) fraction[i] = -1;
  if (!rig->gait || rig->gait->hips < 0) return;
  int32_t hips = rig->gait->hips, chest = rig->gait->chest;
  fraction[hips] = 0;
  if (chest < 0 || chest == hips || !sbri_rig_is_below(rig, chest, hips)) return;
  uint32_t steps = 0, index = 0;
  for (int32_t b = chest; b != hips; b = rig->bones.parents[b]) steps++;
  for (int32_t b = chest; b != hips; b = rig->bones.parents[b])
    fraction[b] = 1 - (float)index++ / (float)steps;
}

static bool init_leg(const sbri_rig *rig, const sbf_leg *from, sbri_leg *leg) {
  const sbf_ik_chain *chain = &rig->asset->ik_chains.at[from->ik];
  int32_t foot = chain->end, lower = rig->bones.parents[foot],
          upper = lower >= 0 ? rig->bones.parents[lower] : -1, toe = -1;
  if (upper >= 0 && upper != chain->root && lower != chain->root && rig->bones.parents[upper] == chain->root)
    toe = foot, foot = lower, lower = upper, upper = chain->root;
  bool peg = lower >= 0 && lower == chain->root;
  if (peg) upper = lower;
  if (upper < 0 || upper != chain->root) return false;
  sbf_vec3 hip = rig->bones.rest[upper].position, ankle = rig->bones.rest[foot].position;
  sbf_vec3 knee = peg ? ankle : rig->bones.rest[lower].position;
  *leg = (sbri_leg){.upper = upper,
      .lower = peg ? -1 : lower,
      .foot = foot,
      .has_toe = toe >= 0,
      .toe = toe >= 0 ? toe : 0,
      .pole = {.bone = chain->pole_bone >= 0 ? chain->pole_bone : rig->bones.parents[upper]},
      .home = {.position = from->home},
      .length = {.upper = sbri_length(sbri_sub(knee, hip)),
          .lower = sbri_length(sbri_sub(ankle, knee)),
          .soft_reach = chain->soft_reach},
      .toe_copies = chain->copy_rotation,
      .copy_rotation = toe >= 0 ? 1 : chain->copy_rotation,
      .group = from->group};
  leg->home.position.y = from->sole;
  /* Without a pole the leg keeps bending in its direction at rest. */
  sbf_vec3 middle = sbri_lerp(hip, ankle, 0.5f), out = sbri_sub(knee, middle);
  leg->pole.direction = chain->has_pole ? chain->pole : sbri_add_scaled(knee, out, 2);
  leg->pole.position = leg->pole.direction;
  if (leg->pole.bone >= 0) {
    const sbr_transform *rest = &rig->bones.rest[leg->pole.bone];
    leg->pole.position =
        sbri_rotate(sbri_quat_conjugate(rest->rotation), sbri_sub(leg->pole.direction, rest->position));
  }
  sbf_vec3 side = sbri_cross(sbri_sub(ankle, hip), sbri_sub(leg->pole.direction, hip));
  leg->upper_inverse = sbri_quat_conjugate(sbri_bone_facing(sbri_sub(knee, hip), side));
  leg->lower_inverse = sbri_quat_conjugate(sbri_bone_facing(sbri_sub(ankle, knee), side));
  leg->length.rest_span = sbri_length(sbri_sub(ankle, hip));
  leg->length.reach = sbri_rig_leg_reach(rig, leg);
  if (toe >= 0) leg->length.reach += LEANS * (leg->length.reach - leg->length.rest_span);
  float rest_reach = leg->length.rest_span / leg->length.reach; /* a leg straight at rest stays so */
  if (leg->length.soft_reach > 1 - rest_reach) leg->length.soft_reach = rest_reach < 1 ? 1 - rest_reach : 0;
  leg->length.rest_stretch = rest_reach / (1 - leg->length.soft_reach);
  uint32_t own = peg ? 1 : 2, all = rig->bones.subtree_end[upper] - rig->bones.subtree_begin[upper];
  leg->has_others = all - (rig->bones.subtree_end[foot] - rig->bones.subtree_begin[foot]) > own;
  leg->hind = rig->gait->chest < 0 || !sbri_rig_is_below(rig, upper, rig->gait->chest);
  return leg->length.upper > 0 && (peg || leg->length.lower > 0);
}

/* Legs on the chest are in front; without a chest, for four legs or more, those before the mean of all. */
static void find_fore_legs(sbri_rig *rig) {
  float fore = 0, hind = 0, middle = 0;
  uint32_t fore_count = 0, count = rig->leg_count;
  for (uint32_t i = 0; i < count; i++) middle += rig->legs[i].home.position.z / (float)count;
  for (uint32_t i = 0; i < count; i++) {
    sbri_leg *leg = &rig->legs[i];
    leg->fore = rig->gait->chest >= 0 ? !leg->hind : count >= 4 && leg->home.position.z > middle;
    fore_count += leg->fore;
    *(leg->fore ? &fore : &hind) += leg->home.position.z;
  }
  rig->stand.hind_z = fore_count < count ? hind / (float)(count - fore_count) : 0;
  rig->stand.fore_z = fore_count ? fore / (float)fore_count : rig->stand.hind_z;
}

static void init_legs(sbri_rig *rig) {
  float width = 0;
  for (uint32_t i = 0; i < rig->gait->legs.count && rig->leg_count < SBRI_MAX_LEGS; i++) {
    sbri_leg *leg = &rig->legs[rig->leg_count];
    if (!init_leg(rig, &rig->gait->legs.at[i], leg)) continue;
    rig->leg_count++;
    rig->stand.has_one_bone_legs = rig->stand.has_one_bone_legs || leg->lower < 0;
    sbri_rig_find_sole(rig, leg);
    rig->stand.reach += leg->length.upper + leg->length.lower;
    if (leg->group + 1 > rig->stand.group_count) rig->stand.group_count = leg->group + 1;
    rig->stand.hips_y += rig->bones.rest[leg->upper].position.y;
    width += fabsf(leg->home.position.x);
    float away =
        sqrtf(leg->home.position.x * leg->home.position.x + leg->home.position.z * leg->home.position.z);
    rig->stand.spread = away > rig->stand.spread ? away : rig->stand.spread;
  }
  find_fore_legs(rig);
  rig->stand.reach = rig->leg_count ? rig->stand.reach / (float)rig->leg_count : 0;
  rig->stand.hips_y = rig->leg_count ? rig->stand.hips_y / (float)rig->leg_count : 0;
  rig->stand.half_width = rig->leg_count ? width / (float)rig->leg_count : 0;
}

static void init_chains(sbri_rig *rig, sbri_bone_chain *chains) {
  for (uint32_t i = 0; i < rig->asset->chains.count; i++) {
    const sbf_chain *source = &rig->asset->chains.at[i];
    if (source->bones.count < 2 || source->spring || sbri_rig_moves_as_tail(rig, i)) continue;
    chains[rig->chains.count++] = (sbri_bone_chain){source, rig->chains.bone_count};
    rig->chains.bone_count += source->bones.count;
  }
}

/* Legs on a chain have homes that follow it. */
static void find_leg_chain_bones(sbri_rig *rig) {
  for (uint32_t l = 0; l < rig->leg_count; l++) {
    sbri_leg *leg = &rig->legs[l];
    leg->home.chain_bone = -1;
    for (uint32_t c = 0; c < rig->chains.count; c++) {
      const sbf_u32_list *bones = &rig->chains.at[c].source->bones;
      for (uint32_t k = 0; k < bones->count; k++) {
        const sbr_transform *rest = &rig->bones.rest[bones->at[k]];
        if (rig->bones.parents[leg->upper] != (int32_t)bones->at[k]) continue;
        leg->home.chain_bone = (int32_t)(rig->chains.at[c].first_state + k);
        sbf_vec3 home = sbri_vec3(leg->home.position.x, 0, leg->home.position.z);
        leg->home.in_bone = sbri_rotate(sbri_quat_conjugate(rest->rotation), sbri_sub(home, rest->position));
      }
    }
  }
}

/* Order of bones in which the subtree of a bone follows it directly. */
static void order_bones(const sbri_rig *rig, uint32_t *subtree, uint32_t *begin, uint32_t *end) {
  uint32_t n = rig->bones.count, roots = 0;
  for (uint32_t i = 0; i < n; i++) end[i] = 1; /* size of the subtree */
  for (uint32_t i = n; i-- > 0;)
    if (rig->bones.parents[i] >= 0) end[rig->bones.parents[i]] += end[i];
  for (uint32_t i = 0; i < n; i++) { /* `subtree` temporarily holds the position of a bone's next child */
    int32_t parent = rig->bones.parents[i];
    begin[i] = parent >= 0 ? subtree[parent] : roots;
    *(parent >= 0 ? &subtree[parent] : &roots) += end[i];
    subtree[i] = begin[i] + 1;
  }
  for (uint32_t i = 0; i < n; i++) end[i] += begin[i];
  for (uint32_t i = 0; i < n; i++) subtree[i] = 0;
  for (uint32_t i = 0; i < n; i++) subtree[begin[i]] = i;
}

static void find_roles(const sbri_rig *rig, uint8_t *roles) {
  for (uint32_t i = 0; i < rig->bones.count; i++)
    roles[i] = rig->bones.spine_fraction[i] >= 0 ? SBRI_ROLE_SPINE : SBRI_ROLE_NONE;
  if (rig->gait && rig->gait->head) roles[rig->gait->head->bone] = SBRI_ROLE_HEAD;
  for (uint32_t t = 0; t < rig->tails.count; t++)
    for (uint32_t k = 0; k < rig->tails.at[t].bone_count; k++)
      roles[rig->tails.at[t].bone_indices[k]] = SBRI_ROLE_TAIL;
}

static bool on_chain(const sbri_rig *rig, uint32_t bone) {
  for (uint32_t c = 0; c < rig->chains.count; c++)
    for (uint32_t k = 0; k < rig->chains.at[c].source->bones.count; k++)
      if (rig->chains.at[c].source->bones.at[k] == bone) return true;
  return false;
}

/* Legs whose subtree has nothing that moves by itself, and that are not on a moving chain. */
static void find_last_legs(sbri_rig *rig, uint8_t *roles) {
  for (uint32_t l = 0; l < rig->leg_count; l++) {
    sbri_leg *leg = &rig->legs[l];
    uint32_t begin = rig->bones.subtree_begin[leg->upper], end = rig->bones.subtree_end[leg->upper];
    leg->is_last = leg->lower >= 0;
    for (int32_t b = rig->bones.parents[leg->upper]; b >= 0; b = rig->bones.parents[b])
      if (on_chain(rig, (uint32_t)b)) leg->is_last = false;
    for (uint32_t k = begin; k < end; k++) {
      uint32_t b = rig->bones.subtree[k];
      if (roles[b] != SBRI_ROLE_NONE || on_chain(rig, b)) leg->is_last = false;
    }
    for (uint32_t other = 0; other < rig->leg_count; other++) {
      const sbri_leg *o = &rig->legs[other];
      bool hangs = other != l && sbri_rig_is_below(rig, o->upper, leg->upper);
      if (hangs || (o->pole.bone >= 0 && sbri_rig_is_below(rig, o->pole.bone, leg->upper)))
        leg->is_last = false;
    }
    for (uint32_t k = begin + 1; leg->is_last && k < end; k++) roles[rig->bones.subtree[k]] = SBRI_ROLE_LEG;
  }
}

static void init_bones(const sbf_asset *asset, int32_t *parents, sbr_transform *rest, sbr_transform *local) {
  for (uint32_t i = 0; i < asset->bones.count; i++) {
    const sbf_bone *bone = &asset->bones.at[i];
    parents[i] = bone->parent;
    local[i] = rest[i] = (sbr_transform){bone->head, sbri_quat_normalize(bone->rotation)};
    if (bone->parent < 0) continue;
    const sbr_transform *parent = &rest[bone->parent];
    sbf_quat back = sbri_quat_conjugate(parent->rotation);
    local[i].position = sbri_rotate(back, sbri_sub(rest[i].position, parent->position));
    local[i].rotation = sbri_quat_multiply(back, rest[i].rotation);
  }
}

void sbri_rig_init(sbri_rig *rig, const sbf_asset *asset, void *memory) {
  uint32_t n = asset->bones.count;
  char *free_memory = memory;
  int32_t *parents = carve(&free_memory, n * sizeof *parents);
  sbr_transform *rest = carve(&free_memory, n * sizeof *rest),
                *local = carve(&free_memory, n * sizeof *local);
  float *fraction = carve(&free_memory, n * sizeof *fraction);
  void *tails = carve(&free_memory, sbri_rig_tails_size(asset));
  uint8_t *roles = carve(&free_memory, n);
  sbri_joint_limit *limits = carve(&free_memory, n * sizeof *limits);
  uint32_t *subtree = carve(&free_memory, n * sizeof *subtree),
           *begin = carve(&free_memory, n * sizeof *begin), *end = carve(&free_memory, n * sizeof *end);
  sbri_bone_mass *masses = carve(&free_memory, n * sizeof *masses);
  sbri_bone_chain *chains = carve(&free_memory, asset->chains.count * sizeof *chains);
  *rig = (sbri_rig){.asset = asset,
      .bones = {.count = n,
          .parents = parents,
          .rest = rest,
          .rest_local = local,
          .spine_fraction = fraction,
          .roles = roles,
          .limits = limits,
          .subtree = subtree,
          .subtree_begin = begin,
          .subtree_end = end,
          .masses = masses},
      .chains = {.at = chains},
      .gait = asset->gaits.count ? &asset->gaits.at[0] : NULL};
  init_bones(asset, parents, rest, local);
  order_bones(rig, subtree, begin, end);
  distribute_spine(rig, fraction);
  sbri_rig_find_limits(rig, limits);
  sbri_rig_find_masses(rig, masses);
  if (rig->gait) {
    if (rig->gait->kind == SBF_GAIT_KIND_WALK) init_legs(rig);
    sbri_rig_find_tails(rig, tails);
  }
  init_chains(rig, chains);
  find_leg_chain_bones(rig);
  find_roles(rig, roles);
  find_last_legs(rig, roles);
  sbri_rig_find_belly(rig);
  sbri_walks_init(&rig->walks, rig, carve(&free_memory, sbri_walks_size(asset)));
  sbri_rig_find_spine(rig, carve(&free_memory, sbri_rig_spine_size(asset)));
  sbri_rig_find_springs(rig, carve(&free_memory, sbri_rig_springs_size(asset)));
  sbri_rig_find_wall_volume(rig);
}
