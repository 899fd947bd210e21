/* Builds coarser levels of render meshes with the same points. */
#ifndef SBFI_RENDER_LEVELS_H
#define SBFI_RENDER_LEVELS_H

#include "base/memory.h"
#include "base/progress.h"
#include "sbfmt/asset.h"

enum { SBFI_MAX_RENDER_LEVELS = 8 };

typedef struct sbfi_render_recipe {
  uint32_t levels; /* in addition to the full mesh, up to SBFI_MAX_RENDER_LEVELS */
  double error;    /* m, maximum error; a level above it, and all coarser ones, are not made. 0: unlimited */
  int32_t derivation;
} sbfi_render_recipe;

/* Adds levels to the render meshes of an asset with writable structs, each with half the triangles of the
 * previous one, simplified from the full mesh by edge collapse (Garland and Heckbert's quadrics, with
 * meshoptimizer). Preserves boundaries of texture coordinates and materials, open borders, hard edges, and
 * boundaries between bones of greatest weight; drops the last two if they prevent halving. Keeps existing
 * levels. There may be fewer than requested: skips levels that are not at least a fifth smaller than the
 * previous one, or that have fewer than 32 triangles.
 *
 * `error` of each is the Hausdorff distance from the full mesh at rest. Adds their number to `*made`. The
 * selection of triangles depends on meshoptimizer's version. False if memory runs out or `progress`
 * cancels. */
bool sbfi_render_levels_make(sbf_asset *asset, const sbfi_render_recipe *recipe, uint32_t *made,
    sbfi_progress progress, sbfi_arena *scratch);

#endif
