/* Checks coarser levels of render meshes: finest first, corners at their own points, error bounds that are
 * true. */
#include <math.h>

#include "build/geometry/triangle_tree.h"
#include "validate/validation.h"

/* Tolerances for single precision and for the measurement itself, as fractions of the error and of the
 * mesh's size. */
static const double SLACK_OF_ERROR = 1e-3, SLACK_OF_SIZE = 1e-6;

typedef struct seen_level {
  sbfi_validation *v;
  const sbf_render_mesh *mesh;
  const sbf_render_level *level;
  uint32_t number; /* from 1 */
  sbfi_path path;
} seen_level;

static const char *label(const seen_level *s) {
  return sbfi_label(s->mesh->name, s->mesh->id);
}

static uint32_t triangle_count(uint32_t corners, uint32_t polygons) {
  return corners - 2 * polygons;
}

static void check_order(const seen_level *s, uint32_t here, uint32_t before) {
  if (here >= before)
    sbfi_found(s->v, SBF_CODE_RENDER_LEVEL_ORDER, s->path.text, -1,
        "render level %u of '%s' has %u triangles, but the level before it has %u", s->number, label(s), here,
        before);
}

static void check_corners(const seen_level *s) {
  const uint32_t *full = s->mesh->mesh.polygon_points.at;
  for (uint32_t i = 0; i < s->level->corners.count; i++)
    if (full[s->level->corners.at[i]] != s->level->polygon_points.at[i])
      sbfi_found(s->v, SBF_CODE_RENDER_LEVEL_CORNER, sbfi_path_of("%s/corners", s->path.text).text, i,
          "corner %u of render level %u of '%s' is at point %u, but refers to corner %u at point %u", i,
          s->number, label(s), s->level->polygon_points.at[i], s->level->corners.at[i],
          full[s->level->corners.at[i]]);
}

static double size_of(const sbfi_triangle_tree *tree) {
  const sbfi_box *box = &tree->tree.nodes[0].box;
  double sum = 0;
  for (int k = 0; k < 3; k++)
    sum += ((double)box->high[k] - box->low[k]) * ((double)box->high[k] - box->low[k]);
  return sqrt(sum);
}

/* The distances of the full mesh's points are a lower bound of a level's error. */
static void check_error(const seen_level *s) {
  const sbf_polygon_mesh *full = &s->mesh->mesh;
  sbf_polygon_mesh coarse = *full;
  sbfi_triangle_tree tree;
  coarse.polygon_sizes = s->level->polygon_sizes;
  coarse.polygon_points = s->level->polygon_points;
  if (!sbfi_triangle_tree_build(&tree, &coarse, &s->v->scratch)) {
    s->v->out_of_memory = true;
    return;
  }
  if (tree.triangle_count == 0) return;
  double stated = (double)s->level->error * (1 + SLACK_OF_ERROR) + SLACK_OF_SIZE * size_of(&tree), far = 0;
  uint8_t *seen = sbfi_scratch(s->v, full->positions.count, 1);
  for (uint32_t c = 0; seen && c < full->polygon_points.count; c++) {
    uint32_t point = full->polygon_points.at[c];
    double squared = INFINITY;
    if (seen[point]) continue;
    seen[point] = 1;
    sbfi_triangle_tree_nearest(&tree, full->positions.at[point], &squared);
    if (squared > far) far = squared;
  }
  if (sqrt(far) > stated)
    sbfi_found(s->v, SBF_CODE_RENDER_LEVEL_ERROR, s->path.text, -1,
        "render level %u of '%s' states an error of %.4g m, but a point of the mesh is %.4g m from it",
        s->number, label(s), (double)s->level->error, sqrt(far));
}

void sbfi_check_render_levels(sbfi_validation *v) {
  for (uint32_t m = 0; m < v->asset->render_meshes.count; m++) {
    const sbf_render_mesh *mesh = &v->asset->render_meshes.at[m];
    uint32_t before = triangle_count(mesh->mesh.polygon_points.count, mesh->mesh.polygon_sizes.count);
    for (uint32_t l = 0; l < mesh->levels.count && !v->out_of_memory; l++) {
      const sbf_render_level *level = &mesh->levels.at[l];
      seen_level s = {
          v, mesh, level, l + 1, sbfi_path_of("/sbf/render_mesh[%u]/render_level[%u]", m + 1, l + 1)};
      uint32_t here = triangle_count(level->polygon_points.count, level->polygon_sizes.count);
      check_order(&s, here, before);
      before = here;
      check_corners(&s);
      check_error(&s);
    }
  }
}
