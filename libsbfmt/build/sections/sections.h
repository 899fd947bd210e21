/* Cuts sections from skinned meshes. */
#ifndef SBFI_SECTIONS_H
#define SBFI_SECTIONS_H

#include "base/diagnostic.h"
#include "base/progress.h"
#include "model/unique_id.h"
#include "sbfmt/asset.h"

/* A section's part of a point that also has weights of bones without sections: positions of the point in
 * the frames of these bones and of the section's own, so that it moves as with skinning. */
typedef struct sbfi_mix {
  uint32_t section; /* index of the section */
  sbf_vec3 position;
  uint32_t count; /* number of bones, up to four: those with the greatest weights */
  uint32_t bones[4];
  float weights[4];   /* normalized */
  bool beside;        /* in addition to the section's own part of the point: the part of rigid bones */
  uint32_t points[4]; /* in the section's level, filled by section_frame.h */
} sbfi_mix;

typedef struct sbfi_sections {
  sbf_soft_body *bodies; /* (count) derived, in the order of their bones; owned by the asset */
  uint32_t count;
  sbf_soft_body *rigid_parts; /* (rigid_count) parts of rigid bones, for hulls only: surfaces without levels
                                 that are not bodies of the asset */
  uint32_t rigid_count;
  double *reaches_m; /* (count) from the section's centre to the farthest vertex that it moves */
  sbf_skin *blends;  /* (render meshes) distribution of the vertices over sections, as weights of their bones;
                        a mesh without skin has none. NULL: no sections were made */
  uint32_t **mixes_of_blends; /* (render meshes) mix of each of these weights; SBFI_NO_INDEX: none */
  sbfi_mix *mixes;            /* (mix_count) by section */
  uint32_t mix_count;
} sbfi_sections;

/* Cuts skinned meshes along their bones, except those that show bodies (sbfi_skins_choose), if the asset has
 * bones and no skin has authored sections (authored_sections.h). Other bodies on bones, such as a hat or an
 * eye, stay independent (section_labels.h, section_merge.h, section_cut.h, section_caps.h). Reports what
 * could not be closed. `overlap_m` as in sbfi_section_cutter.
 *
 * A bone with a rigid recipe gets no section. Vertices without section weights follow the skin. At others the
 * rigid bones' weights become a mix of the section with the greatest weight.
 *
 * The asset's section_recipes define a section; the last one wins for a bone. Without one its modulus is
 * 80 kPa, or as much as a column of the section's height needs for a strain of a twentieth under its own
 * weight, so that characters of any size keep their shape. False if memory runs out or `progress` cancels. */
bool sbfi_sections_make(sbfi_sections *made, sbf_asset *asset, double overlap_m, int32_t derivation,
    sbfi_ids *ids, sbfi_reporter *reporter, sbfi_progress progress, sbfi_arena *scratch);

/* Recipe of the section on a bone: the last for that bone, else the last for all; NULL: none. */
const sbf_section_recipe *sbfi_section_recipe_find(const sbf_asset *asset, int32_t bone);

/* Whether sbfi_sections_make would cut something. False if memory runs out. */
bool sbfi_sections_are_wanted(const sbf_asset *asset, bool *wanted, sbfi_arena *scratch);

/* For each bone, the bone of the section that moves its vertices (section_merge.h), allocated from
 * `scratch`; NULL if nothing is cut. False if memory runs out. */
bool sbfi_section_owners_find(const uint32_t **owners, const sbf_asset *asset, sbfi_arena *scratch);

/* Part of the skins that would become a bone's section. */
typedef struct sbfi_skin_part {
  uint32_t polygons;        /* 0: the bone has no part */
  double area, closed_area; /* m^2, of the skin, and including the caps over its cuts */
  double volume;            /* m^3, enclosed by both */
} sbfi_skin_part;

typedef struct sbfi_skin_parts {
  sbfi_skin_part *at;     /* (bones); NULL: nothing is cut */
  const uint32_t *owners; /* (bones) as from sbfi_section_owners_find */
  double single_fraction; /* 0..1, fraction of weighted points with a single bone */
} sbfi_skin_parts;

/* Allocates from `scratch`; false if memory runs out. */
bool sbfi_skin_parts_measure(sbfi_skin_parts *to, const sbf_asset *asset, sbfi_arena *scratch);

#endif
