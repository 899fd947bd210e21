/* Evaluates weight maps at a level's points and elements. */
#ifndef SBFI_POINT_FACTORS_H
#define SBFI_POINT_FACTORS_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* Product of the body's weight maps of one property at each point of a level: interpolated at the nearest
 * surface triangle, or taken from the nearest authored interior point if that is closer. `*factors`
 * (level->positions.count) is allocated from `scratch`; NULL if the body has no such map. False if memory
 * runs out. */
bool sbfi_point_factors(const sbf_soft_body *body, const sbf_level *level, sbf_weight_property property,
    sbfi_arena *scratch, float **factors);

/* Sets modulus and density of each tetrahedron of the level from the body's maps, if there are any: the
 * body's values, or the lattice's single density, times the mean factor of its four points. The reference
 * modulus is the same. `asset` owns the lists. */
bool sbfi_lattice_weigh(sbf_level *level, const sbf_soft_body *body, sbf_asset *asset, sbfi_arena *scratch);

#endif
