/* A body's level of shape matching regions. */
#ifndef SBFI_REGION_LEVEL_H
#define SBFI_REGION_LEVEL_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* Turns a level of tetrahedra, of which there is at least one, into one of regions: one around each point,
 * with all points that share a tetrahedron with it. The angular frequency is chosen so that the regions store
 * as much energy under small strains as material of the body's modulus and Poisson's ratio 0
 * (mechanics/shape_region.h). The tetrahedra stay for the embeddings. `asset` owns the lists; false if memory
 * runs out. */
bool sbfi_region_level_make(
    sbf_level *level, const sbf_soft_body *body, sbf_asset *asset, sbfi_arena *scratch);

#endif
