/* Coarser levels of render meshes, over the same points. */
#ifndef SBFI_RENDER_LEVELS_H
#define SBFI_RENDER_LEVELS_H

#include "base/memory.h"
#include "base/progress.h"
#include "sbfmt/asset.h"

enum { SBFI_MAX_RENDER_LEVELS = 8 };

typedef struct sbfi_render_recipe {
  uint32_t levels; /* beside the full mesh, up to SBFI_MAX_RENDER_LEVELS */
  double error;    /* m; a level that would be farther off is not made, nor those behind it. 0: no bound */
  int32_t derivation;
} sbfi_render_recipe;

/* Gives the render meshes of an asset whose structs may be written to levels, each of half the triangles of
 * the one before, made of the full mesh by collapsing edges (Garland and Heckbert's quadrics, as
 * meshoptimizer has them). Lines where texture coordinates or materials differ stay lines; so do open
 * borders, hard edges, and those along which another bone begins to hold most of the skin, but for the last
 * two where they would not let a level become half as large. A mesh that has levels keeps them. There may be
 * fewer than asked for: a level that is not a fifth smaller than the one before is left out, and so are those
 * of fewer than 32 triangles.
 *
 * `error` of each is Hausdorff's distance from the full mesh at rest. `*made` grows by how many there are.
 * Which triangles they have is up to meshoptimizer's version. False where memory runs out or `progress` ends
 * it. */
bool sbfi_render_levels_make(sbf_asset *asset, const sbfi_render_recipe *recipe, uint32_t *made,
    sbfi_progress progress, sbfi_arena *scratch);

#endif
