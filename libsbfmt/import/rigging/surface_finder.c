#include "import/rigging/surface_finder.h"

static const double FACING = 0.5, FACING_SINE = 0.8660254037844386; /* of 60 degrees */
static const double ROUNDING = 1e-6;                                /* of cosines */

/* --- Cones of normals ---------------------------------------------------------------------------------- */

static double sine_of(double cosine) {
  return sqrt(fmax(1 - cosine * cosine, 0));
}

/* Cosine of the angle between the axes plus the angle of the cone; -1 if that is more than 90 degrees. */
static double cosine_around(sbfi_d3 axis, const sbfi_normal_cone *cone) {
  double between = fmin(sbfi_d3_dot(axis, cone->axis), 1);
  if (between < 0 || cone->cosine < 0) return -1;
  double cosine = between * cone->cosine - sine_of(between) * sine_of(cone->cosine) - ROUNDING;
  return cosine < 0 ? -1 : cosine;
}

sbfi_normal_cone sbfi_normal_cone_join(const sbfi_normal_cone *a, const sbfi_normal_cone *b) {
  if (a->is_empty) return *b;
  if (b->is_empty) return *a;
  sbfi_normal_cone both = {sbfi_d3_normal(sbfi_d3_add(a->axis, b->axis)), 0, false};
  both.cosine = fmin(cosine_around(both.axis, a), cosine_around(both.axis, b));
  return both;
}

bool sbfi_normal_cone_may_face(const sbfi_normal_cone *cone, sbfi_d3 normal) {
  if (cone->is_empty) return false;
  if (cone->cosine < 0) return true;
  /* The cosine of 60 degrees plus the angle of the cone. */
  double limit = FACING * cone->cosine - FACING_SINE * sine_of(cone->cosine);
  return sbfi_d3_dot(cone->axis, normal) > limit - ROUNDING;
}

/* Mixed normals of a triangle lie between those of its corners if the cone is no wider than a half sphere. */
static sbfi_normal_cone cone_of_leaf(const sbfi_surface_finder *finder, const sbfi_box_node *leaf) {
  sbfi_normal_cone cone = {.is_empty = true};
  for (uint32_t i = leaf->first; i < leaf->first + leaf->count; i++)
    for (int k = 0; k < 3; k++) {
      uint32_t point = finder->tree.triangles[finder->tree.tree.items[i]].points[k];
      sbfi_d3 normal = sbfi_d3_of(finder->surface->normals[point]);
      const sbfi_normal_cone one = {sbfi_d3_normal(normal), 1, !(sbfi_d3_length(normal) > 0)};
      cone = sbfi_normal_cone_join(&cone, &one);
    }
  return cone;
}

static bool make_cones(sbfi_surface_finder *finder, sbfi_arena *arena) {
  const sbfi_box_tree *tree = &finder->tree.tree;
  finder->cones = sbfi_arena_allocate(arena, (size_t)tree->node_count + 1, sizeof *finder->cones);
  if (!finder->cones) return false;
  /* Children come after their parents. */
  for (uint32_t n = tree->node_count; n-- > 0;) {
    const sbfi_box_node *node = &tree->nodes[n];
    finder->cones[n] =
        node->count ? cone_of_leaf(finder, node)
                    : sbfi_normal_cone_join(&finder->cones[node->first], &finder->cones[node->first + 1]);
  }
  return true;
}

bool sbfi_surface_finder_make(
    sbfi_surface_finder *finder, const sbfi_scene_surface *surface, sbfi_arena *arena) {
  *finder = (sbfi_surface_finder){.surface = surface};
  return sbfi_triangle_tree_build(&finder->tree, &surface->mesh, arena) &&
         (!surface->normals || make_cones(finder, arena));
}

/* --- Searches ------------------------------------------------------------------------------------------ */

typedef struct query {
  const sbfi_surface_finder *finder;
  const sbfi_d3 *normal;
} query;

static void closest(const sbfi_surface_finder *finder, uint32_t triangle, const double position[3],
    sbfi_surface_location *to) {
  const sbfi_triangle *t = &finder->tree.triangles[triangle];
  double corners[3][3];
  for (int k = 0; k < 3; k++) {
    sbf_vec3 p = finder->surface->mesh.positions.at[t->points[k]];
    to->points[k] = t->points[k];
    corners[k][0] = (double)p.x;
    corners[k][1] = (double)p.y;
    corners[k][2] = (double)p.z;
  }
  to->distance = sbfi_triangle_closest(corners[0], corners[1], corners[2], position, to->weights);
}

static double facing_distance(const void *user, uint32_t item, const double position[3]) {
  const query *q = user;
  sbfi_surface_location here;
  closest(q->finder, item, position, &here);
  if (!q->normal) return here.distance;
  sbfi_d3 normal = sbfi_surface_normal(q->finder->surface, &here);
  return sbfi_d3_dot(normal, *q->normal) > FACING ? here.distance : INFINITY;
}

static bool may_face(const void *user, uint32_t node) {
  const query *q = user;
  return sbfi_normal_cone_may_face(&q->finder->cones[node], *q->normal);
}

bool sbfi_surface_nearest(const sbfi_surface_finder *finder, sbfi_d3 position, const sbfi_d3 *normal,
    double within, sbfi_surface_location *found) {
  const double at[3] = {position.x, position.y, position.z};
  const query q = {finder, normal};
  double min = within * within;
  uint32_t triangle = sbfi_box_tree_nearest_among(
      &finder->tree.tree, at, facing_distance, normal ? may_face : NULL, &q, &min);
  if (triangle == UINT32_MAX) return false;
  closest(finder, triangle, at, found);
  found->distance = sqrt(found->distance);
  return true;
}

sbfi_d3 sbfi_surface_point(const sbfi_scene_surface *surface, const sbfi_surface_location *location) {
  sbfi_d3 sum = {0, 0, 0};
  for (int k = 0; k < 3; k++)
    sum = sbfi_d3_add(sum,
        sbfi_d3_scale(sbfi_d3_of(surface->mesh.positions.at[location->points[k]]), location->weights[k]));
  return sum;
}

sbfi_d3 sbfi_surface_normal(const sbfi_scene_surface *surface, const sbfi_surface_location *location) {
  sbfi_d3 sum = {0, 0, 0};
  for (int k = 0; k < 3; k++)
    sum = sbfi_d3_add(
        sum, sbfi_d3_scale(sbfi_d3_of(surface->normals[location->points[k]]), location->weights[k]));
  return sbfi_d3_normal(sum);
}
