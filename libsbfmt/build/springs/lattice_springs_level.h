/* A level of springs as cheap as a coarse lattice: the edges of the lattice, without the surface. */
#ifndef SBFI_LATTICE_SPRINGS_LEVEL_H
#define SBFI_LATTICE_SPRINGS_LEVEL_H

#include "base/memory.h"
#include "base/progress.h"
#include "sbfmt/asset.h"

/* Turns the level of tetrahedra `*level`, fresh from sbfi_lattice_level_make, into one of springs: the edges
 * of its tetrahedra, except those between two pinned points, with the stiffness of the same material by
 * springs_matched.h, and the masses of the tetrahedra; points and pins stay. The tetrahedra stay too, without
 * moduli, until the embeddings that use them are complete; then the caller removes them, because they are no
 * second model. `*inert` receives the number of dropped springs. Lists are memory of `asset`; returns false
 * if memory runs out or `progress` ends it. */
bool sbfi_lattice_springs_level_make(sbf_level *level, const sbf_soft_body *body, int32_t derivation,
    sbf_asset *asset, uint32_t *inert, sbfi_progress progress, sbfi_arena *scratch);

#endif
