/* What moves a section that was cut from a skin. */
#ifndef SBFI_SECTION_LEVEL_H
#define SBFI_SECTION_LEVEL_H

#include "build/lattice/lattice.h"
#include "sbfmt/asset.h"

typedef struct sbfi_section_recipe {
  double cell;       /* m; 0: by `elements` */
  uint32_t elements; /* about so many tetrahedra; 0: 160 */
  int32_t derivation;
} sbfi_section_recipe;

typedef struct sbfi_section_counts {
  uint32_t points, springs, inert, pins;
} sbfi_section_counts;

/* Fills `*level` with a coarse lattice (lattice.h) of which the tetrahedra's sides are springs: so its cost
 * does not hang on how fine the skin is, and neither holes nor crossings of the surface matter. None of its
 * points are the body's own. Stiffness by sbf_stiffness_of_network with SBF_STIFFNESS_VOLUME; masses by the
 * tetrahedra, together what the closed surface holds. The body's bone holds the points
 * at least half as deep under the surface as the deepest that two springs lead to: a core along all of the
 * limb.
 *
 * The level keeps the tetrahedra until the embeddings are made, which go by them; then the caller takes them
 * out, for they are no second model. A surface that encloses next to nothing, as a sheet does, leaves
 * the level without points. */
sbfi_lattice_outcome sbfi_section_level_make(sbf_level *level, const sbf_soft_body *body,
    const sbfi_section_recipe *recipe, sbf_asset *asset, sbfi_section_counts *counts, sbfi_progress progress,
    sbfi_arena *scratch);

#endif
