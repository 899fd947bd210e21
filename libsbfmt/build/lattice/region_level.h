/* A body's level of shape matching regions. */
#ifndef SBFI_REGION_LEVEL_H
#define SBFI_REGION_LEVEL_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* Makes of a level of tetrahedra, which enclose something, one of regions: around each of its points, of all
 * that share a tetrahedron with it. The angular frequency is that with which they hold as much energy under
 * small strains as matter of the body's modulus and Poisson's ratio 0 (mechanics/shape_region.h). The
 * tetrahedra stay, and carry what is embedded in them. Lists are memory of `asset`; false where memory runs
 * out. */
bool sbfi_region_level_make(
    sbf_level *level, const sbf_soft_body *body, sbf_asset *asset, sbfi_arena *scratch);

#endif
