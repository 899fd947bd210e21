#include "build/embed/embedder.h"

#include <math.h>

#include "build/geometry/topology.h"
#include "harness.h"
#include "random.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena arena;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&arena, NULL, 0);
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&arena);
}

static uint32_t state = 7;

static sbfi_embedder embedder_of(const sbf_soft_body *body, sbf_level *level) {
  sbfi_spring_recipe recipe = {.interior = SBFI_INTERIOR_CENTROID};
  sbfi_interior_map map;
  sbfi_spring_counts counts;
  sbfi_embedder embedder;
  ck_assert(sbfi_spring_level_make(level, body, &recipe, asset, &map, &counts, &arena));
  ck_assert(sbfi_embedder_make(&embedder, SBFI_EMBEDS_VERTICES, body, level, &map, SBFI_NO_INDEX, &arena));
  return embedder;
}

static bool is_bounded(sbfi_embedded_vertex embedded) {
  const float w[4] = {embedded.weights.x, embedded.weights.y, embedded.weights.z, embedded.weights.w};
  for (int k = 0; k < 4; k++)
    if (!(w[k] >= -0.501f && w[k] <= 1.501f)) return false;
  return true;
}

static void check_place(const sbf_level *level, sbfi_embedded_vertex embedded, sbf_vec3 p, float tolerance) {
  const float w[4] = {embedded.weights.x, embedded.weights.y, embedded.weights.z, embedded.weights.w};
  float x = 0, y = 0, z = 0;
  for (int k = 0; k < 4; k++) {
    sbf_vec3 at = level->positions.at[embedded.points.at[k]];
    x += w[k] * at.x, y += w[k] * at.y, z += w[k] * at.z;
  }
  ck_assert_float_eq_tol(w[0] + w[1] + w[2] + w[3], 1, 1e-6f);
  ck_assert_float_eq_tol(x, p.x, tolerance);
  ck_assert_float_eq_tol(y, p.y, tolerance);
  ck_assert_float_eq_tol(z, p.z, tolerance);
}

START_TEST(surface_points_embed_themselves)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 2, 2, (sbf_vec3){0, 0, 0});
  sbf_level level;
  sbfi_embedder embedder = embedder_of(shape_add_body(asset, "cube", &mesh, true), &level);
  for (uint32_t i = 0; i < 26; i++) {
    for (uint32_t likely = 0; likely < 60; likely += 30) {
      sbfi_embedded_vertex embedded = sbfi_embedder_embed(&embedder, mesh.positions.at[i], likely);
      for (int k = 0; k < 4; k++) ck_assert_uint_eq(embedded.points.at[k], i);
      ck_assert(embedded.weights.x == 1 && embedded.weights.y == 0 && embedded.weights.w == 0 &&
                embedded.error == 0);
    }
  }
}
END_TEST

START_TEST(of_equal_points_the_likely_one)
{
  const sbf_vec3 twice[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  const uint32_t size = 4, corners[] = {0, 1, 2, 3};
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.positions = (sbf_vec3_list){twice, 4};
  mesh.polygon_sizes = (sbf_u32_list){&size, 1};
  mesh.polygon_points = (sbf_u32_list){corners, 4};
  sbf_level level;
  sbfi_embedder embedder = embedder_of(shape_add_body(asset, "twice", &mesh, true), &level);
  ck_assert_uint_eq(sbfi_embedder_embed(&embedder, twice[0], 3).points.at[0], 3);
  ck_assert_uint_eq(sbfi_embedder_embed(&embedder, twice[0], 1).points.at[0], 0);
}
END_TEST

START_TEST(anywhere_around_a_cube)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 3, 2, (sbf_vec3){10, 20, 30});
  sbf_level level;
  sbfi_embedder embedder = embedder_of(shape_add_body(asset, "cube", &mesh, true), &level);
  for (int i = 0; i < 2000; i++) {
    sbf_vec3 p = {10 + random_between(&state, -1.2f, 1.2f), 20 + random_between(&state, -1.2f, 1.2f),
        30 + random_between(&state, -1.2f, 1.2f)};
    sbfi_embedded_vertex embedded = sbfi_embedder_embed(&embedder, p, 0);
    check_place(&level, embedded, p, 1e-5f);
    float size = embedded.weights.x * embedded.weights.x + embedded.weights.y * embedded.weights.y +
                 embedded.weights.z * embedded.weights.z + embedded.weights.w * embedded.weights.w;
    ck_assert_float_lt(size, 3);
    ck_assert_float_lt(embedded.error, 1e-5f);
  }
}
END_TEST

START_TEST(vertices_follow_a_deformed_body)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 3, 2, (sbf_vec3){0, 0, 0});
  sbf_level level;
  sbfi_embedder embedder = embedder_of(shape_add_body(asset, "cube", &mesh, true), &level);
  /* Any map of the form A x + b is embedded exactly: weights sum to one. */
  sbf_vec3 moved[200];
  for (uint32_t i = 0; i < level.positions.count; i++) {
    sbf_vec3 p = level.positions.at[i];
    moved[i] = (sbf_vec3){2 * p.x + p.y + 1, p.y - 0.5f * p.z, 3 * p.z - p.x};
  }
  sbf_level deformed = level;
  deformed.positions.at = moved;
  for (int i = 0; i < 200; i++) {
    sbf_vec3 p = {random_between(&state, -1.1f, 1.1f), random_between(&state, -1.1f, 1.1f),
        random_between(&state, -1.1f, 1.1f)};
    sbf_vec3 image = {2 * p.x + p.y + 1, p.y - 0.5f * p.z, 3 * p.z - p.x};
    check_place(&deformed, sbfi_embedder_embed(&embedder, p, 0), image, 2e-5f);
  }
}
END_TEST

START_TEST(long_bodies_keep_small_weights)
{
  /* A bar of 1 x 1 x 20: near its axis, far from the centre, the nearest triangle alone would be
   * inaccurate. */
  sbf_polygon_mesh mesh = shape_cube(asset, 8, 1, (sbf_vec3){0, 0, 0});
  sbf_vec3 stretched[386];
  for (uint32_t i = 0; i < mesh.positions.count; i++) {
    sbf_vec3 p = mesh.positions.at[i];
    stretched[i] = (sbf_vec3){p.x, p.y, 20 * p.z};
  }
  mesh.positions.at = stretched;
  sbf_level level;
  sbfi_embedder embedder = embedder_of(shape_add_body(asset, "bar", &mesh, true), &level);
  for (int i = 0; i < 500; i++) {
    sbf_vec3 p = {random_between(&state, -0.5f, 0.5f), random_between(&state, -0.5f, 0.5f),
        random_between(&state, -10, 10)};
    sbfi_embedded_vertex c = sbfi_embedder_embed(&embedder, p, 0);
    check_place(&level, c, p, 1e-4f);
    ck_assert_float_lt(fabsf(c.weights.x) + fabsf(c.weights.y) + fabsf(c.weights.z) + fabsf(c.weights.w), 4);
  }
}
END_TEST

START_TEST(flat_bodies_report_distances)
{
  sbf_polygon_mesh mesh = shape_sheet(asset, 3, 3);
  sbf_level level;
  sbfi_embedder embedder = embedder_of(shape_add_body(asset, "sheet", &mesh, true), &level);
  sbfi_embedded_vertex embedded = sbfi_embedder_embed(&embedder, (sbf_vec3){1.25f, 0.5f, 1.5f}, 0);
  check_place(&level, embedded, (sbf_vec3){1.25f, 0, 1.5f}, 1e-6f);
  ck_assert_float_eq_tol(embedded.error, 0.5f, 1e-6f);
  ck_assert(embedded.weights.w == 0);
}
END_TEST

START_TEST(lattices)
{
  /* A cube of five tetrahedra; its own surface is embedded by them as well. */
  sbf_polygon_mesh mesh = shape_cube(asset, 1, 1, (sbf_vec3){0.5f, 0.5f, 0.5f});
  sbf_soft_body *body = shape_add_body(asset, "cube", &mesh, true);
  const sbf_vec3 corners[] = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  const sbf_uint4 five[] = {{{0, 3, 6, 5}}, {{0, 1, 3, 5}}, {{0, 3, 2, 6}}, {{0, 6, 4, 5}}, {{3, 5, 6, 7}}};
  sbf_level level;
  sbf_level_init(&level);
  level.positions = (sbf_vec3_list){corners, 8};
  level.lattice.tetrahedra = (sbf_uint4_list){five, 5};
  sbfi_embedder embedder;
  ck_assert(sbfi_embedder_make(&embedder, SBFI_EMBEDS_VERTICES, body, &level, NULL, SBFI_NO_INDEX, &arena));
  for (int i = 0; i < 500; i++) {
    sbf_vec3 p = {random_between(&state, 0, 1), random_between(&state, 0, 1), random_between(&state, 0, 1)};
    sbfi_embedded_vertex c = sbfi_embedder_embed(&embedder, p, 0);
    check_place(&level, c, p, 1e-5f);
    float min = fminf(fminf(c.weights.x, c.weights.y), fminf(c.weights.z, c.weights.w));
    ck_assert_float_ge(min, -1e-6f);
  }
  check_place(&level, sbfi_embedder_embed(&embedder, (sbf_vec3){1.2f, 0.5f, 0.5f}, 0),
      (sbf_vec3){1.2f, 0.5f, 0.5f}, 1e-5f);
}
END_TEST

/* Two prongs of unit cubes, six high and one cube apart, on one foot; each cube is six tetrahedra. */
enum { FORK_CUBES = 13, FORK_WIDTH = 4, FORK_HEIGHT = 7, FORK_POINTS = FORK_WIDTH * FORK_HEIGHT * 2 };

static uint32_t fork_point(uint32_t x, uint32_t y, uint32_t z) {
  return (z * FORK_HEIGHT + y) * FORK_WIDTH + x;
}

static void fill_cube(sbf_uint4 *six, uint32_t x, uint32_t y) {
  static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int t = 0; t < 6; t++) {
    uint32_t at[3] = {x, y, 0};
    for (int k = 0; k < 4; k++) {
      six[t].at[k] = fork_point(at[0], at[1], at[2]);
      if (k < 3) at[orders[t][k]]++;
    }
  }
}

static sbf_level fork_level(void) {
  static const sbf_vec3 frame[] = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
  sbf_vec3 *points = sbf_asset_allocate(asset, FORK_POINTS + 4, sizeof *points);
  sbf_uint4 *made = sbf_asset_allocate(asset, 6 * FORK_CUBES, sizeof *made);
  sbf_level level;
  sbf_level_init(&level);
  for (uint32_t i = 0; i < FORK_POINTS; i++)
    points[i] = (sbf_vec3){(float)(i % FORK_WIDTH), (float)(i / FORK_WIDTH % FORK_HEIGHT),
        (float)(i / FORK_WIDTH / FORK_HEIGHT)};
  for (int k = 0; k < 4; k++) points[FORK_POINTS + k] = frame[k];
  for (uint32_t cube = 0; cube < FORK_CUBES; cube++)
    fill_cube(&made[6 * cube], cube < 12 ? cube % 2 * 2 : 1, cube < 12 ? cube / 2 : 0);
  level.positions = (sbf_vec3_list){points, FORK_POINTS + 4};
  level.lattice.tetrahedra = (sbf_uint4_list){made, 6 * FORK_CUBES};
  return level;
}

/* Points of the whole body would not do: a tip would stay in place when its prong bends. */
START_TEST(vertices_beside_a_tip_embed_in_their_own_prong)
{
  sbf_polygon_mesh mesh = shape_cube(asset, 1, 1, (sbf_vec3){0.5f, 0.5f, 0.5f});
  sbf_soft_body *body = shape_add_body(asset, "fork", &mesh, true);
  sbf_level level = fork_level();
  sbfi_embedder embedder;
  ck_assert(sbfi_embedder_make(&embedder, SBFI_EMBEDS_VERTICES, body, &level, NULL, SBFI_NO_INDEX, &arena));
  for (int i = 0; i < 1000; i++) {
    float left = i % 2 ? 0 : 2;
    sbf_vec3 p = {left + random_between(&state, 0, 1), 6 + random_between(&state, 0, 0.8f),
        random_between(&state, 0, 1)};
    sbfi_embedded_vertex c = sbfi_embedder_embed(&embedder, p, UINT32_MAX);
    check_place(&level, c, p, 1e-5f);
    ck_assert(is_bounded(c));
    ck_assert_double_le(
        hypot(hypot(c.weights.x, c.weights.y), hypot(c.weights.z, c.weights.w)), sqrt(3) + 1e-6);
    for (int k = 0; k < 4; k++) {
      ck_assert_float_ge(level.positions.at[c.points.at[k]].x, left);
      ck_assert_float_le(level.positions.at[c.points.at[k]].x, left + 1);
      ck_assert_float_ge(level.positions.at[c.points.at[k]].y, 3);
    }
  }
  const sbf_vec3 far = {2.5f, 60, 0.5f};
  sbfi_embedded_vertex beyond = sbfi_embedder_embed(&embedder, far, UINT32_MAX);
  ck_assert(is_bounded(beyond));
  ck_assert_float_gt(beyond.error, 1);
  ck_assert(sbfi_embedder_make(&embedder, SBFI_EMBEDS_VERTICES, body, &level, NULL, FORK_POINTS, &arena));
  ck_assert_uint_eq(sbfi_embedder_embed(&embedder, far, UINT32_MAX).points.at[0], FORK_POINTS);
}
END_TEST

START_TEST(points_without_polygons)
{
  const sbf_vec3 rope[] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  sbf_polygon_mesh mesh;
  sbf_polygon_mesh_init(&mesh);
  mesh.positions = (sbf_vec3_list){rope, 3};
  sbf_level level;
  sbfi_embedder embedder = embedder_of(shape_add_body(asset, "rope", &mesh, false), &level);
  sbfi_embedded_vertex embedded = sbfi_embedder_embed(&embedder, (sbf_vec3){1.9f, 0.1f, 0}, 0);
  ck_assert_uint_eq(embedded.points.at[0], 2);
  ck_assert_float_gt(embedded.error, 0.1f);
  ck_assert_double_lt(sbfi_embedder_distance(&embedder, (sbf_vec3){1.9f, 0.1f, 0}, INFINITY), 0.03);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("carrier");
  TCase *c = tcase_create("carrier");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, surface_points_embed_themselves);
  tcase_add_test(c, of_equal_points_the_likely_one);
  tcase_add_test(c, anywhere_around_a_cube);
  tcase_add_test(c, vertices_follow_a_deformed_body);
  tcase_add_test(c, long_bodies_keep_small_weights);
  tcase_add_test(c, flat_bodies_report_distances);
  tcase_add_test(c, lattices);
  tcase_add_test(c, vertices_beside_a_tip_embed_in_their_own_prong);
  tcase_add_test(c, points_without_polygons);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
