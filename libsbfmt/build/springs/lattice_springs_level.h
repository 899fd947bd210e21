/* A level of springs as cheap as a coarse lattice: its sides, and nothing of the surface. */
#ifndef SBFI_LATTICE_SPRINGS_LEVEL_H
#define SBFI_LATTICE_SPRINGS_LEVEL_H

#include "base/memory.h"
#include "base/progress.h"
#include "sbfmt/asset.h"

/* Makes the level of tetrahedra `*level`, fresh from sbfi_lattice_level_make, one of springs: the sides of
 * its tetrahedra, but for those between two held points, stiff as the same matter by springs_matched.h; the
 * masses that the tetrahedra have; points and pins stay. The tetrahedra stay as well, without moduli, until
 * the embeddings are made, which go by them; then the caller takes them out, for they are no second model.
 * `*inert` receives how many springs were left out. Lists are memory of `asset`; false where memory runs out
 * or `progress` ends it. */
bool sbfi_lattice_springs_level_make(sbf_level *level, const sbf_soft_body *body, int32_t derivation,
    sbf_asset *asset, uint32_t *inert, sbfi_progress progress, sbfi_arena *scratch);

#endif
