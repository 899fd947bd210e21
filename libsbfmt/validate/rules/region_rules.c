/* Checks shape matching and jiggle: non-degenerate regions that cover every free point. */
#include "mechanics/vector.h"
#include "sbfmt/mechanics.h"
#include "validate/validation.h"

typedef struct region {
  uint32_t number, size;
  const uint32_t *points;
} region;

/* Whether the points are in a plane, on a line or at one position, within rounding of their extent. */
static bool is_flat(const sbf_vec3 *positions, const region *r) {
  sbfi_d3 origin = sbfi_d3_of(positions[r->points[0]]), along = {0, 0, 0}, across = {0, 0, 0};
  double far = 0, wide = 0, deep = 0;
  for (uint32_t i = 1; i < r->size; i++) {
    sbfi_d3 displacement = sbfi_d3_sub(sbfi_d3_of(positions[r->points[i]]), origin);
    if (sbfi_d3_length(displacement) > far) far = sbfi_d3_length(along = displacement);
  }
  for (uint32_t i = 1; i < r->size; i++) {
    sbfi_d3 area = sbfi_d3_cross(along, sbfi_d3_sub(sbfi_d3_of(positions[r->points[i]]), origin));
    if (sbfi_d3_length(area) > wide) wide = sbfi_d3_length(across = area);
  }
  for (uint32_t i = 1; i < r->size; i++) {
    sbfi_d3 displacement = sbfi_d3_sub(sbfi_d3_of(positions[r->points[i]]), origin);
    deep = fmax(deep, fabs(sbfi_d3_dot(sbfi_d3_normal(across), displacement)));
  }
  return deep <= 1e-4 * far;
}

static void check_regions(sbfi_validation *v, const sbf_level *level, const char *path) {
  const sbf_shape_regions *regions = level->regions;
  uint32_t *seen =
      sbfi_scratch(v, level->positions.count, sizeof *seen); /* number from 1 of the last region */
  uint8_t *pinned = sbfi_scratch(v, level->positions.count, 1);
  if (!seen || !pinned) return;
  region r = {0, 0, regions->points.at};
  for (; r.number < regions->sizes.count; r.points += r.size, r.number++) {
    r.size = regions->sizes.at[r.number];
    for (uint32_t i = 0; i < r.size; i++) {
      if (seen[r.points[i]] == r.number + 1)
        sbfi_found(v, SBF_CODE_REGION_REPEATED, sbfi_path_of("%s/shape_regions/points", path).text,
            r.points + i - regions->points.at, "region %u names point %u twice", r.number, r.points[i]);
      seen[r.points[i]] = r.number + 1;
    }
    if (is_flat(level->positions.at, &r))
      sbfi_found(v, SBF_CODE_REGION_FLAT, sbfi_path_of("%s/shape_regions/sizes", path).text, r.number,
          "region %u with %u point%s is flat", r.number, r.size, sbfi_plural(r.size));
  }
  uint32_t left_out = 0;
  sbf_level_pinned_points(level, pinned);
  for (uint32_t i = 0; i < level->positions.count; i++) left_out += !seen[i] && !pinned[i];
  if (left_out)
    sbfi_found(v, SBF_CODE_REGION_POINT_LEFT_OUT, sbfi_path_of("%s/shape_regions", path).text, -1,
        "%u free point%s in no region", left_out, left_out == 1 ? " is" : "s are");
}

static void check_level(sbfi_validation *v, const sbf_level *level, const char *path) {
  if (level->model == SBF_ELASTIC_MODEL_SHAPE_MATCHING) {
    if (level->regions && level->regions->sizes.count)
      check_regions(v, level, path);
    else
      sbfi_found(
          v, SBF_CODE_LEVEL_EMPTY, path, -1, "the level's model is shape_matching, but it has no region");
  }
  if (level->model == SBF_ELASTIC_MODEL_JIGGLE && !level->jiggle)
    sbfi_found(v, SBF_CODE_LEVEL_EMPTY, path, -1, "the level's model is jiggle, but it has no jiggle");
}

void sbfi_check_regions(sbfi_validation *v) {
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++)
    for (uint32_t l = 0; l < v->asset->soft_bodies.at[b].levels.count && !v->out_of_memory; l++)
      check_level(v, &v->asset->soft_bodies.at[b].levels.at[l],
          sbfi_path_of("/sbf/soft_body[%u]/level[%u]", b + 1, l + 1).text);
}
