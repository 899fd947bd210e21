/* What the rules share: where findings go, and scratch memory. */
#ifndef SBFI_VALIDATION_H
#define SBFI_VALIDATION_H

#include "base/diagnostic.h"
#include "base/memory.h"
#include "sbfmt/validate.h"

/* How often one code was found at one place: only the first of them are listed. */
typedef struct sbfi_tally {
  sbf_code code;
  uint32_t count;
} sbfi_tally;

enum { SBFI_MAX_TALLIES = 16 };

typedef struct sbfi_validation {
  const sbf_asset *asset;
  const sbf_validate_options *options;
  sbf_validate_result *result;
  sbfi_arena scratch; /* emptied after each family of rules */
  uint32_t repeats;
  char path[256]; /* what `tallies` are about */
  sbfi_tally tallies[SBFI_MAX_TALLIES];
  uint32_t tally_count;
  bool out_of_memory;
} sbfi_validation;

/* Element path, as XPath would have it: "/sbf/soft_body[3]/level[1]". */
typedef struct sbfi_path {
  char text[256];
} sbfi_path;
sbfi_path sbfi_path_of(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* A finding at an element path, about one item of the list there (-1: about the element). The text says what
 * is wrong; what to do about it is added from the code's own text, where that has something behind a colon.
 */
void sbfi_found(sbfi_validation *v, sbf_code code, const char *path, int64_t index, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Says how many findings were not listed at the place that is left now. */
void sbfi_report_unlisted(sbfi_validation *v);

/* Zeroed scratch memory, never NULL for want of a count; NULL, with out_of_memory set, where it ran out. */
void *sbfi_scratch(sbfi_validation *v, size_t count, size_t size);

/* Whether there is more than one, for messages. */
static inline const char *sbfi_plural(uint64_t count) {
  return count == 1 ? "" : "s";
}

/* What messages call an object: by its name, or by its id where it has none. */
static inline const char *sbfi_label(const char *name, const char *id) {
  return *name ? name : id;
}

static inline const char *sbfi_bone_label(const sbf_asset *asset, uint32_t bone) {
  return sbfi_label(asset->bones.at[bone].name, asset->bones.at[bone].id);
}

/* Each family of rules, one file each. */
void sbfi_check_surfaces(sbfi_validation *v);
void sbfi_check_lattices(sbfi_validation *v);
void sbfi_check_regions(sbfi_validation *v);
void sbfi_check_springs(sbfi_validation *v);
void sbfi_check_cross_springs(sbfi_validation *v);
void sbfi_check_colors(sbfi_validation *v);
void sbfi_check_levels(sbfi_validation *v);
void sbfi_check_weight_maps(sbfi_validation *v);
void sbfi_check_pins(sbfi_validation *v);
void sbfi_check_collisions(sbfi_validation *v);
void sbfi_check_embeddings(sbfi_validation *v);
void sbfi_check_meshes(sbfi_validation *v);
void sbfi_check_render_levels(sbfi_validation *v);
void sbfi_check_skins(sbfi_validation *v);
void sbfi_check_textures(sbfi_validation *v);
void sbfi_check_names(sbfi_validation *v);
void sbfi_check_rotations(sbfi_validation *v);
void sbfi_check_sections(sbfi_validation *v);
void sbfi_check_rigid_bodies(sbfi_validation *v);
void sbfi_check_joints(sbfi_validation *v);
void sbfi_check_ik(sbfi_validation *v);
void sbfi_check_gaits(sbfi_validation *v);
void sbfi_check_chains(sbfi_validation *v);
void sbfi_check_clips(sbfi_validation *v);
void sbfi_check_physics(sbfi_validation *v);
void sbfi_check_environment(sbfi_validation *v);
void sbfi_check_derived(sbfi_validation *v);

#endif
