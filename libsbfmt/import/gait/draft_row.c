/* Detects many pairs of legs on consecutive bones from the head back. Their spine is a chain that follows
 * the foremost bone, not hips and chest with a stiff back between them. */
#include "import/gait/gait_draft.h"

enum { MIN_GIRDLES = 4 };

static bool has_leg(const sbfi_gait_draft *d, int32_t bone) {
  for (uint32_t l = 0; l < d->leg_count; l++)
    if (sbfi_draft_bone(d, d->legs[l].limb)->parent == bone) return true;
  return false;
}

/* Number of bones from the root to this bone, inclusive. */
static uint32_t depth_of(const sbfi_gait_draft *d, int32_t bone) {
  uint32_t depth = 0;
  for (; bone != SBF_NONE; bone = sbfi_draft_bone(d, bone)->parent) depth++;
  return depth;
}

/* Lists bones from the first root of a limb to the last, and on to the end of the chain. Returns 0 if a root
 * is off the chain or the chain does not lead back. */
static uint32_t list_row(sbfi_gait_draft *d, int32_t last) {
  uint32_t girdles = 0, all = 0, depth = depth_of(d, last), first = depth;
  for (uint32_t i = 0; i < d->asset->bones.count; i++) all += has_leg(d, (int32_t)i);
  for (int32_t bone = last; bone != SBF_NONE; bone = sbfi_draft_bone(d, bone)->parent, depth--) {
    d->spine[depth - 1] = (uint32_t)bone;
    if (!has_leg(d, bone)) continue;
    girdles++;
    first = depth;
  }
  if (girdles < MIN_GIRDLES || girdles < all) return 0;
  uint32_t count = depth_of(d, last) - (first - 1);
  for (uint32_t i = 0; i < count; i++) d->spine[i] = d->spine[first - 1 + i];
  for (int32_t bone = sbfi_draft_only_child(d, last); bone != SBF_NONE; bone = sbfi_draft_only_child(d, bone))
    d->spine[count++] = (uint32_t)bone;
  for (uint32_t i = 1; i < count; i++)
    if (sbfi_draft_bone(d, (int32_t)d->spine[i])->head.z >=
        sbfi_draft_bone(d, (int32_t)d->spine[i - 1])->head.z)
      return 0;
  return count;
}

bool sbfi_draft_row(sbfi_gait_draft *d) {
  int32_t last = SBF_NONE;
  d->spine = sbf_asset_allocate(d->asset, d->asset->bones.count, sizeof *d->spine);
  if (!d->spine) return false;
  for (uint32_t i = 0; i < d->asset->bones.count; i++)
    if (has_leg(d, (int32_t)i) && (last == SBF_NONE || depth_of(d, (int32_t)i) > depth_of(d, last)))
      last = (int32_t)i;
  d->spine_count = last == SBF_NONE ? 0 : list_row(d, last);
  d->row = d->spine_count > 0;
  if (d->row) d->hips = d->chest = SBF_NONE; /* no stiff part rotates with the feet */
  return true;
}
