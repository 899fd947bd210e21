/* Sections cut from skinned meshes. */
#ifndef SBFI_SECTIONS_H
#define SBFI_SECTIONS_H

#include "base/diagnostic.h"
#include "base/progress.h"
#include "model/unique_id.h"
#include "sbfmt/asset.h"

/* What a section carries of a point that bones without sections hold too: places of the point in the frames
 * of the section's own bone and of those, so that it moves as skinning moves it. */
typedef struct sbfi_mix {
  uint32_t section; /* which of the sections */
  sbf_vec3 position;
  uint32_t count; /* of bones, up to four: those with the greatest weights */
  uint32_t bones[4];
  float weights[4];   /* summing to one */
  bool beside;        /* beside what the section itself has of the point: the share of rigid bones */
  uint32_t points[4]; /* of the section's level, once section_frame.h has made them */
} sbfi_mix;

typedef struct sbfi_sections {
  sbf_soft_body *bodies; /* (count) derived, in the order of their bones; memory of the asset */
  uint32_t count;
  sbf_soft_body *rigid_parts; /* (rigid_count) what is cut on rigid bones, for hulls alone: surfaces without
                                 levels, no bodies of the asset */
  uint32_t rigid_count;
  double *reaches_m; /* (count) from the section's middle to the farthest vertex it has a share in */
  sbf_skin *blends;  /* (render meshes) how sections share the vertices: weights of their bones; a mesh
                        without skin has none. NULL: no sections were made */
  uint32_t **mixes_of_blends; /* (render meshes) for each of those weights its mix; SBFI_NO_INDEX: none */
  sbfi_mix *mixes;            /* (mix_count) by section */
  uint32_t mix_count;
} sbfi_sections;

/* Cuts skinned meshes along their bones, but for pictures of bodies (sbfi_skins_choose), and only where the
 * asset has bones and no skin has sections which somebody made (authored_sections.h). Other bodies on bones,
 * as a hat or an eye, stay beside the sections (section_labels.h, section_merge.h, section_cut.h,
 * section_caps.h). What could not be closed is reported. `overlap_m` as sbfi_section_cutter has it.
 *
 * A bone with a rigid recipe gets no section. Vertices in which sections have no share follow the skin. Of
 * others the rigid bones' share is a mix of the section that has most of them.
 *
 * A section is what the asset's section_recipes say, of several for a bone the last. Without one its modulus
 * is 80 kPa, or as much as it takes for a column as high as the section to strain by a
 * twentieth under its own weight: a character of any size keeps its shape. False where memory runs out or
 * `progress` ends it. */
bool sbfi_sections_make(sbfi_sections *made, sbf_asset *asset, double overlap_m, int32_t derivation,
    sbfi_ids *ids, sbfi_reporter *reporter, sbfi_progress progress, sbfi_arena *scratch);

/* The recipe of the section on a bone: the last for that bone, else the last for all; NULL: there is none. */
const sbf_section_recipe *sbfi_section_recipe_find(const sbf_asset *asset, int32_t bone);

/* Whether sbfi_sections_make would cut something. False where memory runs out. */
bool sbfi_sections_are_wanted(const sbf_asset *asset, bool *wanted, sbfi_arena *scratch);

/* For each bone, the one whose section carries what it holds (section_merge.h), in memory of `scratch`; NULL
 * where nothing is to be cut. False where memory runs out. */
bool sbfi_section_owners_find(const uint32_t **owners, const sbf_asset *asset, sbfi_arena *scratch);

/* The part of the skins that would be a bone's section. */
typedef struct sbfi_skin_part {
  uint32_t polygons;        /* 0: the bone has no part */
  double area, closed_area; /* m^2, of the skin, and with the caps over its cuts */
  double volume;            /* m^3, inside both */
} sbfi_skin_part;

typedef struct sbfi_skin_parts {
  sbfi_skin_part *at;     /* (bones); NULL: nothing is to be cut */
  const uint32_t *owners; /* (bones) as sbfi_section_owners_find gives them */
  double single_fraction; /* 0..1, of the points that have weights: one bone alone holds them */
} sbfi_skin_parts;

/* Memory of `scratch`; false where it runs out. */
bool sbfi_skin_parts_measure(sbfi_skin_parts *to, const sbf_asset *asset, sbfi_arena *scratch);

#endif
