#include "import/rigging/surface_finder.h"

#include <math.h>

#include "harness.h"

enum { RINGS = 40, SIDES = 60, POINTS = RINGS * SIDES, TRIANGLES = 2 * (RINGS - 1) * SIDES };

static sbf_vec3 points[POINTS], normals[POINTS];
static uint32_t sizes[TRIANGLES], corners[3 * TRIANGLES];
static uint32_t state;

static double random_between(double low, double high) {
  state = state * 1664525u + 1013904223u;
  return low + (high - low) * (state >> 8) / 16777216.0;
}

static sbfi_d3 random_direction(void) {
  return sbfi_d3_normal((sbfi_d3){random_between(-1, 1), random_between(-1, 1), random_between(-1, 1)});
}

/* A rough tube around y whose normals face outwards, a few of them missing. */
static sbfi_scene_surface make_tube(double noise) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < POINTS; i++) {
    double angle = 6.283185307179586 * (i % SIDES) / SIDES;
    sbfi_d3 out = {cos(angle), 0, sin(angle)}, off = sbfi_d3_scale(random_direction(), noise);
    points[i] = sbfi_d3_rounded(sbfi_d3_add(sbfi_d3_add(out, (sbfi_d3){0, 0.1 * (i / SIDES), 0}), off));
    normals[i] = sbfi_d3_rounded(sbfi_d3_normal(sbfi_d3_add(out, sbfi_d3_scale(off, 5))));
    if (i % 97 == 5) normals[i] = (sbf_vec3){0, 0, 0};
  }
  for (uint32_t i = 0; i + SIDES < POINTS; i++) {
    uint32_t next = i % SIDES + 1 == SIDES ? i + 1 - SIDES : i + 1;
    const uint32_t at[6] = {i, i + SIDES, next, next, i + SIDES, next + SIDES};
    for (int k = 0; k < 6; k++) corners[count++] = at[k];
  }
  for (uint32_t t = 0; t < TRIANGLES; t++) sizes[t] = 3;
  return (sbfi_scene_surface){.mesh = {.positions = {points, POINTS},
                                  .polygon_sizes = {sizes, TRIANGLES},
                                  .polygon_points = {corners, 3 * TRIANGLES}},
      .normals = normals};
}

/* Every triangle in turn. */
static double nearest_of_all(const sbfi_surface_finder *all, sbfi_d3 at, sbfi_d3 normal) {
  double min = INFINITY;
  const double position[3] = {at.x, at.y, at.z};
  for (uint32_t t = 0; t < TRIANGLES; t++) {
    double c[3][3];
    sbfi_surface_location here;
    for (int k = 0; k < 3; k++) {
      here.points[k] = corners[3 * t + k];
      const sbf_vec3 p = points[here.points[k]];
      c[k][0] = (double)p.x, c[k][1] = (double)p.y, c[k][2] = (double)p.z;
    }
    here.distance = sbfi_triangle_closest(c[0], c[1], c[2], position, here.weights);
    if (sbfi_d3_dot(sbfi_surface_normal(all->surface, &here), normal) > 0.5) min = fmin(min, here.distance);
  }
  return sqrt(min);
}

START_TEST(it_finds_the_nearest_facing_triangle)
{
  static const double noises[] = {0, 0.02, 0.2};
  for (int n = 0; n < 3; n++) {
    sbfi_arena arena;
    sbfi_surface_finder finder;
    state = 3;
    const sbfi_scene_surface tube = make_tube(noises[n]);
    sbfi_arena_init(&arena, NULL, 0);
    ck_assert(sbfi_surface_finder_make(&finder, &tube, &arena));
    for (int i = 0; i < 200; i++) {
      sbfi_surface_location found;
      sbfi_d3 at = {random_between(-2, 2), random_between(-1, 5), random_between(-2, 2)};
      sbfi_d3 normal = random_direction();
      double expected = nearest_of_all(&finder, at, normal);
      bool any = sbfi_surface_nearest(&finder, at, &normal, 10, &found);
      ck_assert_int_eq(any, isfinite(expected));
      if (any) ck_assert_double_eq(found.distance, expected);
    }
    sbfi_arena_free(&arena);
  }
}
END_TEST

/* A search does not look at the half of a tube that faces away. */
START_TEST(nodes_that_face_away_are_skipped)
{
  sbfi_arena arena;
  sbfi_surface_finder finder;
  const sbfi_scene_surface tube = make_tube(0);
  uint32_t leaves = 0, facing = 0;
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_surface_finder_make(&finder, &tube, &arena));
  for (uint32_t n = 0; n < finder.tree.tree.node_count; n++) {
    if (!finder.tree.tree.nodes[n].count) continue;
    leaves++;
    facing += sbfi_normal_cone_may_face(&finder.cones[n], (sbfi_d3){1, 0, 0});
  }
  ck_assert_uint_gt(facing, leaves / 4);
  ck_assert_uint_lt(facing, leaves / 2);
  sbfi_arena_free(&arena);
}
END_TEST

/* Directions of both cones lie in their cone. */
START_TEST(cones_contain_the_cones_they_join)
{
  state = 5;
  for (int i = 0; i < 2000; i++) {
    sbfi_d3 directions[4];
    sbfi_normal_cone cones[4], both;
    sbfi_d3 middle = random_direction();
    double spread = random_between(0, 1.5);
    for (int k = 0; k < 4; k++) {
      directions[k] = sbfi_d3_normal(sbfi_d3_add(middle, sbfi_d3_scale(random_direction(), spread)));
      cones[k] = (sbfi_normal_cone){directions[k], 1, false};
    }
    cones[0] = sbfi_normal_cone_join(&cones[0], &cones[1]);
    cones[2] = sbfi_normal_cone_join(&cones[2], &cones[3]);
    both = sbfi_normal_cone_join(&cones[0], &cones[2]);
    ck_assert(both.cosine == -1 || both.cosine >= 0);
    for (int k = 0; k < 4; k++) ck_assert_double_ge(sbfi_d3_dot(both.axis, directions[k]), both.cosine);
  }
}
END_TEST

int main(void) {
  Suite *s = suite_create("surface_finder");
  TCase *c = tcase_create("surface_finder");
  tcase_add_test(c, it_finds_the_nearest_facing_triangle);
  tcase_add_test(c, nodes_that_face_away_are_skipped);
  tcase_add_test(c, cones_contain_the_cones_they_join);
  suite_add_tcase(s, c);
  return harness_run(s);
}
