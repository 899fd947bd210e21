/* Links: line segments from a bone to limbs that begin beside it, such as from the spine to the hips.
 *
 * Artists assign the region before a limb's joint to the limb's parent. In a connected skin
 * diffusion over the surface decides. A separate shell there, such as a pad over a machine's hip, would
 * follow the limb, because its joint is nearer than the parent. */
#ifndef SBFI_BONE_LINKS_H
#define SBFI_BONE_LINKS_H

#include "build/weights/bone_reach.h"

typedef struct sbfi_bone_links {
  sbfi_bone_segment *segments; /* (count + 1) the parent first, then its links */
  uint32_t *limbs;             /* (count) bone at the end of each link */
  uint32_t count;
} sbfi_bone_links;

/* Allocates for any bone of the rig. False if memory runs out. */
bool sbfi_bone_links_make(sbfi_bone_links *links, uint32_t bone_count, sbfi_arena *arena);

/* Replaces the links by those of one deforming bone, `parent`. */
void sbfi_bone_links_find(
    sbfi_bone_links *links, const sbfi_weights_input *in, const sbfi_bone_segment *segments, uint32_t parent);

/* Whether a link counts in a shell: not if the limb passes through it. */
bool sbfi_bone_link_counts(
    const sbfi_bone_links *links, uint32_t link, const sbfi_bone_reach *reach, uint32_t shell);

#endif
