/* Checks chains, their springs and colliders, followers and bone lists: order, duplicates, damped
 * oscillators. */
#include "validate/rules/bone_chain.h"
#include "validate/validation.h"

typedef struct bone_list {
  const char *what, *name, *path;
  sbf_u32_list bones;
} bone_list;

static void find_repeated(sbfi_validation *v, const bone_list *l) {
  uint8_t *seen = sbfi_scratch(v, v->asset->bones.count, 1);
  for (uint32_t i = 0; seen && i < l->bones.count; i++) {
    if (seen[l->bones.at[i]])
      sbfi_found(v, SBF_CODE_BONE_REPEATED, sbfi_path_of("%s/bones", l->path).text, i,
          "%s '%s' names the bone '%s' twice", l->what, l->name, sbfi_bone_label(v->asset, l->bones.at[i]));
    seen[l->bones.at[i]] = 1;
  }
}

static void check_order(sbfi_validation *v, const bone_list *l) {
  for (uint32_t i = 1; i < l->bones.count; i++) {
    int32_t above = (int32_t)l->bones.at[i - 1], below = (int32_t)l->bones.at[i];
    if (above != below && !sbfi_bone_is_descendant(v->asset, below, above))
      sbfi_found(v, SBF_CODE_CHAIN_BROKEN, sbfi_path_of("%s/bones", l->path).text, i,
          "'%s' follows '%s' in %s '%s' but is not its child", sbfi_bone_label(v->asset, l->bones.at[i]),
          sbfi_bone_label(v->asset, l->bones.at[i - 1]), l->what, l->name);
  }
}

static void check_chains(sbfi_validation *v) {
  for (uint32_t i = 0; i < v->asset->chains.count && !v->out_of_memory; i++) {
    const sbf_chain *chain = &v->asset->chains.at[i];
    sbfi_path path = sbfi_path_of("/sbf/chains/chain[%u]", i + 1);
    bone_list l = {"chain", sbfi_label(chain->name, chain->id), path.text, chain->bones};
    if (chain->bones.count < (chain->spring ? 1 : 2))
      sbfi_found(v, SBF_CODE_CHAIN_EMPTY, path.text, -1, "chain '%s' has %u bone%s", l.name,
          chain->bones.count, sbfi_plural(chain->bones.count));
    find_repeated(v, &l);
    check_order(v, &l);
  }
}

static void check_springs(sbfi_validation *v) {
  /* chain number from 1 */
  uint32_t *first = sbfi_scratch(v, v->asset->bones.count, sizeof *first);
  for (uint32_t i = 0; first && i < v->asset->chains.count; i++) {
    const sbf_chain *chain = &v->asset->chains.at[i];
    sbfi_path path = sbfi_path_of("/sbf/chains/chain[%u]/chain_spring", i + 1);
    if (!chain->spring) continue;
    for (uint32_t k = 0; k < chain->bones.count; k++) {
      uint32_t bone = chain->bones.at[k], *holder = &first[bone];
      if (*holder && *holder != i + 1)
        sbfi_found(v, SBF_CODE_CHAIN_SPRING_REPEATED, path.text, -1, "chains %u and %u swing the bone '%s'",
            *holder, i + 1, sbfi_bone_label(v->asset, bone));
      *holder = i + 1;
    }
    int32_t center = chain->spring->center;
    bool is_above = center < 0 || !chain->bones.count || center == (int32_t)chain->bones.at[0] ||
                    sbfi_bone_is_descendant(v->asset, (int32_t)chain->bones.at[0], center);
    if (!is_above)
      sbfi_found(v, SBF_CODE_CHAIN_CENTER, path.text, -1, "the center '%s' of chain '%s' is not above it",
          sbfi_bone_label(v->asset, (uint32_t)center), sbfi_label(chain->name, chain->id));
  }
}

static void check_colliders(sbfi_validation *v) {
  for (uint32_t i = 0; i < v->asset->chain_colliders.count; i++) {
    const sbf_chain_collider *c = &v->asset->chain_colliders.at[i];
    const sbf_vec3 n = c->normal;
    if (c->shape == SBF_CHAIN_COLLIDER_SHAPE_PLANE && n.x == 0 && n.y == 0 && n.z == 0)
      sbfi_found(v, SBF_CODE_CHAIN_COLLIDER_NORMAL,
          sbfi_path_of("/sbf/chain_colliders/chain_collider[%u]", i + 1).text, -1,
          "the normal of the plane '%s' is 0", sbfi_label(c->name, c->id));
  }
}

static void check_retarget_chains(sbfi_validation *v) {
  for (uint32_t i = 0; i < v->asset->retarget_chains.count && !v->out_of_memory; i++) {
    const sbf_retarget_chain *chain = &v->asset->retarget_chains.at[i];
    sbfi_path path = sbfi_path_of("/sbf/retarget_chains/retarget_chain[%u]", i + 1);
    bone_list l = {"retarget chain", sbfi_label(chain->name, chain->id), path.text, chain->bones};
    if (chain->bones.count == 0)
      sbfi_found(v, SBF_CODE_CHAIN_EMPTY, path.text, -1, "retarget chain '%s' has no bone", l.name);
    find_repeated(v, &l);
    check_order(v, &l);
  }
}

static void check_masks(sbfi_validation *v) {
  for (uint32_t i = 0; i < v->asset->bone_masks.count && !v->out_of_memory; i++) {
    const sbf_bone_mask *mask = &v->asset->bone_masks.at[i];
    sbfi_path path = sbfi_path_of("/sbf/bone_masks/bone_mask[%u]", i + 1);
    find_repeated(v, &(bone_list){"bone mask", sbfi_label(mask->name, mask->id), path.text, mask->bones});
  }
}

/* Checks frequency in Hz and damping ratio of a second-order follower. */
static void check_oscillator(
    sbfi_validation *v, const char *what, double frequency, double damping_ratio, const char *path) {
  double tick = (double)v->asset->environment.control_tick;
  if (2 * frequency * tick > 1)
    sbfi_found(v, SBF_CODE_FOLLOWER_TOO_FAST, path, -1,
        "%s has a frequency of %.4g Hz, but the control ticks can resolve only %.4g Hz", what, frequency,
        0.5 / tick);
  if (damping_ratio == 0)
    sbfi_found(v, SBF_CODE_FOLLOWER_UNDAMPED, path, -1, "%s has the damping ratio 0", what);
}

static bool is_same_channel(sbf_follower_channel a, sbf_follower_channel b) {
  return a == b || a == SBF_FOLLOWER_CHANNEL_BOTH || b == SBF_FOLLOWER_CHANNEL_BOTH;
}

static void check_followers(sbfi_validation *v) {
  const sbf_follower_list all = v->asset->followers;
  /* follower number from 1 */
  uint32_t *first = sbfi_scratch(v, 2 * (size_t)v->asset->bones.count, sizeof *first);
  for (uint32_t i = 0; first && i < all.count; i++) {
    const sbf_follower *follower = &all.at[i];
    sbfi_path path = sbfi_path_of("/sbf/followers/follower[%u]", i + 1);
    for (int k = 0; k < 2; k++) {
      sbf_follower_channel channel = k ? SBF_FOLLOWER_CHANNEL_POSITION : SBF_FOLLOWER_CHANNEL_ROTATION;
      uint32_t *holder = &first[2 * (size_t)follower->bone + (size_t)k];
      if (!is_same_channel(follower->channel, channel)) continue;
      if (*holder)
        sbfi_found(v, SBF_CODE_FOLLOWER_REPEATED, path.text, -1, "followers %u and %u move the %s of '%s'",
            *holder, i + 1, sbf_follower_channel_name(channel),
            sbfi_bone_label(v->asset, (uint32_t)follower->bone));
      else
        *holder = i + 1;
    }
    check_oscillator(
        v, "a follower", (double)follower->frequency, (double)follower->damping_ratio, path.text);
  }
}

static void check_gait_parts(sbfi_validation *v) {
  for (uint32_t g = 0; g < v->asset->gaits.count; g++) {
    const sbf_gait *gait = &v->asset->gaits.at[g];
    if (gait->head)
      check_oscillator(v, "the head", (double)gait->head->frequency, (double)gait->head->damping_ratio,
          sbfi_path_of("/sbf/gait[%u]/head_turn", g + 1).text);
    for (uint32_t t = 0; t < gait->tails.count; t++)
      check_oscillator(v, "a tail", (double)gait->tails.at[t].frequency,
          (double)gait->tails.at[t].damping_ratio, sbfi_path_of("/sbf/gait[%u]/tail[%u]", g + 1, t + 1).text);
  }
}

static void check_jiggles(sbfi_validation *v) {
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++)
    for (uint32_t l = 0; l < v->asset->soft_bodies.at[b].levels.count; l++) {
      const sbf_jiggle *jiggle = v->asset->soft_bodies.at[b].levels.at[l].jiggle;
      if (jiggle)
        check_oscillator(v, "a jiggle", (double)jiggle->frequency, (double)jiggle->damping_ratio,
            sbfi_path_of("/sbf/soft_body[%u]/level[%u]/jiggle", b + 1, l + 1).text);
    }
}

void sbfi_check_chains(sbfi_validation *v) {
  check_chains(v);
  check_springs(v);
  check_colliders(v);
  check_retarget_chains(v);
  check_masks(v);
  check_followers(v);
  check_gait_parts(v);
  check_jiggles(v);
}
