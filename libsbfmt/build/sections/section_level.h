/* Simulation model of a section cut from a skin. */
#ifndef SBFI_SECTION_LEVEL_H
#define SBFI_SECTION_LEVEL_H

#include "build/lattice/lattice.h"
#include "sbfmt/asset.h"

typedef struct sbfi_section_recipe {
  double cell;       /* m; 0: use `elements` */
  uint32_t elements; /* approximate number of tetrahedra; 0: 160 */
  int32_t derivation;
} sbfi_section_recipe;

typedef struct sbfi_section_counts {
  uint32_t points, springs, inert, pins;
} sbfi_section_counts;

/* Fills `*level` with springs along the edges of a coarse lattice (lattice.h): the cost does not depend on
 * the skin's resolution, and holes and self-intersections do not matter. None of its points are the body's
 * own. Stiffness from sbf_stiffness_of_network with SBF_STIFFNESS_VOLUME; masses by tetrahedra, scaled to the
 * mass of the closed surface. The body's bone pins points at least half as deep below the surface as the
 * deepest within two springs: a core along the whole limb.
 *
 * The level keeps the tetrahedra until the embeddings have been computed from them; then the caller removes
 * them, because they are not simulated. If the surface encloses almost nothing, like a sheet, the level has
 * no points. */
sbfi_lattice_outcome sbfi_section_level_make(sbf_level *level, const sbf_soft_body *body,
    const sbfi_section_recipe *recipe, sbf_asset *asset, sbfi_section_counts *counts, sbfi_progress progress,
    sbfi_arena *scratch);

#endif
