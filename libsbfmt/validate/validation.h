/* Shared by the rules: destination of findings, and scratch memory. */
#ifndef SBFI_VALIDATION_H
#define SBFI_VALIDATION_H

#include "base/diagnostic.h"
#include "base/memory.h"
#include "sbfmt/validate.h"

/* Number of findings of one code at one path: only the first ones are listed. */
typedef struct sbfi_tally {
  sbf_code code;
  uint32_t count;
} sbfi_tally;

enum { SBFI_MAX_TALLIES = 16 };

typedef struct sbfi_validation {
  const sbf_asset *asset;
  const sbf_validate_options *options;
  sbf_validate_result *result;
  sbfi_arena scratch; /* reset after each family of rules */
  uint32_t repeats;
  char path[256]; /* path of `tallies` */
  sbfi_tally tallies[SBFI_MAX_TALLIES];
  uint32_t tally_count;
  bool out_of_memory;
} sbfi_validation;

/* Element path, as XPath would have it: "/sbf/soft_body[3]/level[1]". */
typedef struct sbfi_path {
  char text[256];
} sbfi_path;
sbfi_path sbfi_path_of(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Reports a finding at an element path, about one item of the list there (-1: about the element). The text
 * describes the problem; advice is appended from the code's own text, if that has any after a colon. */
void sbfi_found(sbfi_validation *v, sbf_code code, const char *path, int64_t index, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Reports the number of unlisted findings at the current path before it changes. */
void sbfi_report_unlisted(sbfi_validation *v);

/* Zeroed scratch memory, not NULL for a count of 0; NULL, with out_of_memory set, if memory runs out. */
void *sbfi_scratch(sbfi_validation *v, size_t count, size_t size);

/* Plural ending, for messages. */
static inline const char *sbfi_plural(uint64_t count) {
  return count == 1 ? "" : "s";
}

/* Name of an object in messages: its name, or its id if it has none. */
static inline const char *sbfi_label(const char *name, const char *id) {
  return *name ? name : id;
}

static inline const char *sbfi_bone_label(const sbf_asset *asset, uint32_t bone) {
  return sbfi_label(asset->bones.at[bone].name, asset->bones.at[bone].id);
}

/* The families of rules, one file each. */
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
