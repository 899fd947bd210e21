/* Weight maps at a level's points, and from there at its elements. */
#ifndef SBFI_POINT_FACTORS_H
#define SBFI_POINT_FACTORS_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* The product of the body's weight maps of one property at each point of a level none of whose points need be
 * the body's: that of the nearest place on the surface, interpolated over its triangle, or of the nearest
 * authored interior point where that is nearer. `*factors` (level->positions.count) is memory of `scratch`;
 * NULL where the body has no such map. False where memory runs out. */
bool sbfi_point_factors(const sbf_soft_body *body, const sbf_level *level, sbf_weight_property property,
    sbfi_arena *scratch, float **factors);

/* Gives each tetrahedron of the level the modulus and the density that the body's maps ask for, where there
 * are such: the body's, or the one density that the lattice states, times the mean factor of its four points.
 * The reference modulus is the same. Lists are memory of `asset`. */
bool sbfi_lattice_weigh(sbf_level *level, const sbf_soft_body *body, sbf_asset *asset, sbfi_arena *scratch);

#endif
