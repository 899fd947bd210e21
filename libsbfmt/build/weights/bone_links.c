#include "build/weights/bone_links.h"

/* Minimum distance of a limb from its parent for a link, in units of the longest side; minimum fraction of a
 * limb in a shell for the shell to belong to it. */
static const double BESIDE = 0.01, PINNED_FRACTION = 0.125;

bool sbfi_bone_links_make(sbfi_bone_links *l, uint32_t bone_count, sbfi_arena *arena) {
  *l = (sbfi_bone_links){.segments = sbfi_arena_allocate(arena, (size_t)bone_count + 1, sizeof *l->segments),
      .limbs = sbfi_arena_allocate(arena, (size_t)bone_count + 1, sizeof *l->limbs)};
  return l->segments && l->limbs;
}

/* Nearest ancestor of a limb that deforms; SBF_NONE if there is none. */
static int32_t deforming_ancestor_of(
    const sbfi_weights_input *in, const sbfi_bone_segment *segments, uint32_t limb) {
  int32_t bone = in->bones[limb].parent;
  while (bone != SBF_NONE && !segments[bone].is_deforming) bone = in->bones[bone].parent;
  return bone;
}

void sbfi_bone_links_find(
    sbfi_bone_links *l, const sbfi_weights_input *in, const sbfi_bone_segment *segments, uint32_t parent) {
  const sbfi_bone_segment *bone = &segments[parent];
  l->segments[0] = *bone;
  l->count = 0;
  for (uint32_t limb = parent + 1; limb < in->bone_count; limb++) {
    if (!segments[limb].is_deforming || bone->next == (int32_t)limb ||
        deforming_ancestor_of(in, segments, limb) != (int32_t)parent)
      continue;
    sbfi_d3 from = sbfi_segment_nearest(bone, segments[limb].head);
    if (sbfi_d3_length(sbfi_d3_sub(segments[limb].head, from)) < BESIDE) continue;
    l->limbs[l->count++] = limb;
    l->segments[l->count] = *bone;
    l->segments[l->count].head = from;
    l->segments[l->count].tail = segments[limb].head;
  }
}

bool sbfi_bone_link_counts(
    const sbfi_bone_links *l, uint32_t link, const sbfi_bone_reach *reach, uint32_t shell) {
  return (double)sbfi_bone_fraction_in(reach, l->limbs[link], shell) <= PINNED_FRACTION;
}
