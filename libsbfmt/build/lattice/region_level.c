#include "build/lattice/region_level.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mechanics/shape_region.h"
#include "sbfmt/mechanics.h"

/* Neighbouring points, in both directions: sorted, without duplicates. */
static int compare_pairs(const void *a, const void *b) {
  const sbf_uint2 *p = a, *q = b;
  for (int k = 0; k < 2; k++)
    if (p->at[k] != q->at[k]) return p->at[k] < q->at[k] ? -1 : 1;
  return 0;
}

/* A point is a neighbour of itself, so each has its own region. */
static size_t list_pairs(const sbf_level *level, sbf_uint2 *pairs) {
  size_t count = 0, kept = 0;
  for (uint32_t t = 0; t < level->lattice.tetrahedra.count; t++)
    for (int i = 0; i < 4; i++)
      for (int k = 0; k < 4; k++)
        pairs[count++] =
            (sbf_uint2){{level->lattice.tetrahedra.at[t].at[i], level->lattice.tetrahedra.at[t].at[k]}};
  qsort(pairs, count, sizeof *pairs, compare_pairs);
  for (size_t i = 0; i < count; i++)
    if (i == 0 || compare_pairs(&pairs[i - 1], &pairs[i]) != 0) pairs[kept++] = pairs[i];
  return kept;
}

/* Sum over regions and their points of a |r|^2, kg m^2, with a the point's mass divided among its regions;
 * the points of all regions are in `points`, with the numbers in `sizes`. */
static double spread_of(const sbf_level *level, const uint32_t *sizes, uint32_t region_count,
    const uint32_t *points, const float *masses, const uint32_t *uses, double *weights, sbfi_d3 *positions) {
  double sum = 0;
  for (uint32_t r = 0; r < region_count; points += sizes[r++]) {
    for (uint32_t i = 0; i < sizes[r]; i++) {
      weights[i] = (double)masses[points[i]] / uses[points[i]];
      positions[i] = sbfi_d3_of(level->positions.at[points[i]]);
    }
    sbfi_d3 center = sbfi_region_center(weights, positions, sizes[r]);
    for (uint32_t i = 0; i < sizes[r]; i++) {
      sbfi_d3 off = sbfi_d3_sub(positions[i], center);
      sum += weights[i] * sbfi_d3_dot(off, off);
    }
  }
  return sum;
}

bool sbfi_region_level_make(
    sbf_level *level, const sbf_soft_body *body, sbf_asset *asset, sbfi_arena *scratch) {
  uint32_t count = level->positions.count, max = 0, region_count = 0;
  sbf_uint2 *pairs =
      sbfi_arena_allocate(scratch, 16 * (size_t)level->lattice.tetrahedra.count, sizeof *pairs);
  float *masses = sbfi_arena_allocate(scratch, count, sizeof *masses);
  uint32_t *uses = sbfi_arena_allocate(scratch, count, sizeof *uses);
  sbf_shape_regions *regions = sbf_asset_allocate(asset, 1, sizeof *regions);
  uint32_t *sizes = sbf_asset_allocate(asset, count, sizeof *sizes);
  if (!pairs || !masses || !uses || !regions || !sizes) return false;
  size_t pair_count = list_pairs(level, pairs);
  uint32_t *points = sbf_asset_allocate(asset, pair_count, sizeof *points);
  if (!points) return false;
  for (size_t i = 0; i < pair_count; i++) {
    if (i == 0 || pairs[i].at[0] != pairs[i - 1].at[0]) sizes[region_count++] = 0;
    uint32_t size = ++sizes[region_count - 1];
    max = size > max ? size : max;
    points[i] = pairs[i].at[1];
    uses[points[i]]++;
  }
  double *weights = sbfi_arena_allocate(scratch, max, sizeof *weights);
  sbfi_d3 *positions = sbfi_arena_allocate(scratch, max, sizeof *positions);
  if (!weights || !positions) return false;
  double mass = sbf_level_masses(body, level, NULL, masses);
  double spread = spread_of(level, sizes, region_count, points, masses, uses, weights, positions) / 3;
  double square = (double)body->attributes.young_modulus / (double)body->attributes.density * mass / spread;
  sbf_shape_regions_init(regions);
  if (square > 0 && square < 1e12) regions->stiffness = (float)sqrt(square);
  regions->sizes = (sbf_u32_list){sizes, region_count};
  regions->points = (sbf_u32_list){points, (uint32_t)pair_count};
  level->regions = regions;
  level->model = SBF_ELASTIC_MODEL_SHAPE_MATCHING;
  level->name = sbf_asset_copy_text(asset, "shape matching");
  return level->name != NULL;
}
