#include "build/springs/spring_level.h"

#include <math.h>
#include <stdlib.h>

#include "build/geometry/topology.h"
#include "harness.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena scratch;

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&scratch, NULL, 0);
}

static void teardown(void) {
  sbf_asset_free(asset);
  sbfi_arena_free(&scratch);
}

static sbf_level make(const sbf_soft_body *body, bool centroid) {
  sbfi_spring_recipe recipe = {
      .interior = centroid ? SBFI_INTERIOR_CENTROID : SBFI_INTERIOR_NONE, .flexion = true};
  sbfi_interior_map map;
  sbfi_spring_counts counts;
  sbf_level level;
  ck_assert(sbfi_spring_level_make(&level, body, &recipe, asset, &map, &counts, &scratch));
  return level;
}

/* Everything about a level that swings. */
typedef struct swing {
  sbf_spring_network network;
  float *masses;
} swing;

static swing swing_of(const sbf_soft_body *body, const sbf_level *level) {
  uint32_t count = 0, points = level->positions.count;
  for (uint32_t s = 0; s < level->springs.count; s++) count += level->springs.at[s].ends.count;
  uint8_t *pinned = sbfi_arena_allocate(&scratch, points, 1);
  sbf_uint2 *ends = sbfi_arena_allocate(&scratch, count, sizeof *ends);
  float *stiffness = sbfi_arena_allocate(&scratch, count, sizeof *stiffness);
  swing made = {.masses = sbfi_arena_allocate(&scratch, points, sizeof(float))};
  sbf_level_pinned_points(level, pinned);
  sbf_level_masses(body, level, pinned, made.masses);
  count = 0;
  for (uint32_t s = 0; s < level->springs.count; s++)
    for (uint32_t i = 0; i < level->springs.at[s].ends.count; i++) {
      ends[count] = level->springs.at[s].ends.at[i];
      stiffness[count++] = level->springs.at[s].stiffness.at[i];
    }
  made.network = (sbf_spring_network){.point_count = points,
      .spring_count = count,
      .positions = level->positions.at,
      .masses = made.masses,
      .ends = ends,
      .stiffness = stiffness};
  return made;
}

/* Mean fall of the free points under `gravity`. */
static double sag_of(const sbf_soft_body *body, double gravity) {
  sbf_level level = make(body, true);
  swing s = swing_of(body, &level);
  uint32_t points = level.positions.count, free_points = 0;
  double *forces = sbfi_arena_allocate(&scratch, 3 * points, sizeof *forces), sum = 0;
  double *moved = sbfi_arena_allocate(&scratch, 3 * points, sizeof *moved);
  double *work = sbfi_arena_allocate(&scratch, 10 * points, sizeof *work);
  for (uint32_t i = 0; i < points; i++) forces[3 * i + 1] = -gravity * s.masses[i];
  ck_assert_double_lt(sbf_network_static(&s.network, forces, 1e-8, 5000, moved, work), 1e-4);
  for (uint32_t i = 0; i < points; i++) {
    if (!(s.masses[i] > 0)) continue;
    sum -= moved[3 * i + 1];
    free_points++;
  }
  return sum / free_points;
}

static sbf_soft_body *cube_of(uint32_t n, float side, bool with_bone) {
  sbf_polygon_mesh mesh = shape_cube(asset, n, side, (sbf_vec3){0.3f, 1, 0});
  sbf_soft_body *body = shape_add_body(asset, "cube", &mesh, with_bone);
  body->attributes.young_modulus = 5e4f;
  return body;
}

START_TEST(half_the_size_is_not_softer)
{
  double large = sag_of(cube_of(2, 0.4f, true), 5), small = sag_of(cube_of(2, 0.2f, true), 10);
  /* Half the size at twice the gravity: the same stress, so the same strain. */
  ck_assert_double_eq_tol(small / 0.2 / (large / 0.4), 1, 1e-3);
}
END_TEST

START_TEST(a_finer_mesh_is_as_stiff)
{
  double coarse = sag_of(cube_of(2, 0.2f, true), 9.81);
  for (uint32_t n = 4; n <= 8; n *= 2)
    ck_assert_double_eq_tol(sag_of(cube_of(n, 0.2f, true), 9.81) / coarse, 1, 0.2);
  /* And as stiff as matter of 50 kPa: a layer half as thick as the cube sinks some 3 % under itself. */
  ck_assert_double_eq_tol(coarse, 0.0035, 0.001);
}
END_TEST

START_TEST(triangles_are_as_stiff_as_quads)
{
  sbf_soft_body *cube = cube_of(4, 0.2f, true);
  sbf_polygon_mesh cut = shape_triangulated(asset, &cube->surface);
  double quads = sag_of(cube, 9.81), triangles;
  sbf_soft_body *of_triangles = shape_add_body(asset, "cut", &cut, true);
  of_triangles->attributes.young_modulus = 5e4f;
  triangles = sag_of(of_triangles, 9.81);
  ck_assert_double_eq_tol(triangles / quads, 1, 0.2);
}
END_TEST

START_TEST(twice_the_modulus_twice_as_stiff)
{
  sbf_soft_body *body = cube_of(2, 0.2f, true);
  double soft = sag_of(body, 9.81);
  body->attributes.young_modulus *= 2;
  ck_assert_double_eq_tol(sag_of(body, 9.81), soft / 2, 1e-3 * soft);
}
END_TEST

START_TEST(modulus_map)
{
  sbf_soft_body *body = cube_of(2, 0.2f, true);
  double soft = sag_of(body, 9.81);
  float *factors = sbfi_arena_allocate(&scratch, 26, sizeof *factors);
  for (int i = 0; i < 26; i++) factors[i] = 3;
  sbf_weight_map map;
  sbf_weight_map_init(&map);
  map.property = SBF_WEIGHT_PROPERTY_YOUNG_MODULUS;
  map.values = (sbf_f32_list){factors, 26};
  body->weight_maps = (sbf_weight_map_list){&map, 1};
  ck_assert_double_eq_tol(sag_of(body, 9.81), soft / 3, 1e-3 * soft);
}
END_TEST

START_TEST(frequencies_bracket)
{
  sbf_soft_body *body = cube_of(3, 0.2f, true);
  sbf_level level = make(body, true);
  swing s = swing_of(body, &level);
  double *work = sbfi_arena_allocate(&scratch, 16 * level.positions.count, sizeof *work);
  double bound = sbf_network_highest_bound(&s.network, work),
         highest = sbf_network_highest(&s.network, 100, work);
  double lowest = sbf_network_lowest(&s.network, true, work);
  ck_assert_double_ge(bound, highest);
  ck_assert_double_ge(highest, 0.4 * bound);
  ck_assert_double_gt(highest, lowest);
  /* The whole skin against the core: 2/3 E / (rho d^2), 30 rad/s and more, for d = 0.1 m. */
  ck_assert_double_ge(lowest, 20);
  ck_assert_double_le(lowest, 60);
}
END_TEST

static double moment_of(const sbf_level *level, int from_kind, int to_kind) {
  double sum = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) {
    const sbf_spring_set *set = &level->springs.at[s];
    if ((int)set->kind < from_kind || (int)set->kind > to_kind) continue;
    for (uint32_t i = 0; i < set->ends.count; i++) {
      sbf_vec3 a = level->positions.at[set->ends.at[i].at[0]], b = level->positions.at[set->ends.at[i].at[1]];
      double x = (double)a.x - b.x, y = (double)a.y - b.y, z = (double)a.z - b.z;
      sum += set->stiffness.at[i] * (x * x + y * y + z * z);
    }
  }
  return sum;
}

START_TEST(sums_of_stiffness)
{
  sbf_soft_body *pinned = cube_of(3, 0.2f, true), *loose = cube_of(3, 0.2f, false);
  sbf_level level = make(pinned, true);
  double ev = 5e4 * 0.008;
  ck_assert_double_eq_tol(
      moment_of(&level, SBF_SPRING_KIND_STRUCTURAL, SBF_SPRING_KIND_FLEXION), 4 * ev, 1e-3 * ev);
  level = make(loose, true);
  ck_assert_double_eq_tol(
      moment_of(&level, SBF_SPRING_KIND_STRUCTURAL, SBF_SPRING_KIND_INTERNAL), 6 * ev, 1e-3 * ev);
  level = make(loose, false);
  ck_assert_double_eq_tol(
      moment_of(&level, SBF_SPRING_KIND_STRUCTURAL, SBF_SPRING_KIND_INTERNAL), 6 * ev, 1e-3 * ev);
  sbf_polygon_mesh mesh = shape_sheet(asset, 4, 4);
  sbf_soft_body *sheet = shape_add_body(asset, "sheet", &mesh, false);
  sheet->attributes.young_modulus = 5e4f;
  sheet->attributes.thickness = 0.001f;
  level = make(sheet, false);
  ck_assert_double_eq_tol(
      moment_of(&level, SBF_SPRING_KIND_STRUCTURAL, SBF_SPRING_KIND_INTERNAL), 3 * 5e4 * 16e-3, 1);
}
END_TEST

START_TEST(springs_between_pinned_points_are_inert)
{
  sbf_soft_body *body = cube_of(1, 0.2f, true);
  const uint32_t points[] = {0, 1};
  sbf_pin_set pins;
  sbf_pin_set_init(&pins);
  pins.points = (sbf_u32_list){points, 2};
  body->pins = (sbf_pin_set_list){&pins, 1};
  sbfi_spring_recipe recipe = {.interior = SBFI_INTERIOR_CENTROID, .flexion = true};
  sbfi_interior_map map;
  sbfi_spring_counts counts;
  sbf_level level;
  ck_assert(sbfi_spring_level_make(&level, body, &recipe, asset, &map, &counts, &scratch));
  /* The side between them; centre to both; of the three quads at each of them a spring, and six to the
   * centre. */
  ck_assert_uint_eq(counts.springs[SBF_SPRING_KIND_STRUCTURAL], 12 - 1);
  ck_assert_uint_eq(counts.springs[SBF_SPRING_KIND_INTERNAL], 8 + 30 - 2 - 6 - 6);
  ck_assert_uint_eq(counts.inert, 1 + 2 + 6 + 6);
  ck_assert_uint_eq(counts.pins, 2 + 7);
  ck_assert_uint_eq(map.centre, 8);
  ck_assert_uint_eq(map.polygon_points[5], 14);
}
END_TEST

START_TEST(coincident_points_get_no_spring)
{
  sbf_soft_body *body = cube_of(1, 0.2f, true);
  sbf_vec3 folded[8];
  for (int i = 0; i < 8; i++) folded[i] = body->surface.positions.at[i];
  folded[1] = folded[0]; /* a side of the cube */
  body->surface.positions.at = folded;
  sbf_level level = make(body, true);
  for (uint32_t s = 0; s < level.springs.count; s++)
    for (uint32_t i = 0; i < level.springs.at[s].ends.count; i++) {
      sbf_uint2 ends = level.springs.at[s].ends.at[i];
      ck_assert(!(ends.at[0] < 2 && ends.at[1] < 2));
      ck_assert_float_gt(level.springs.at[s].stiffness.at[i], 0);
    }
}
END_TEST

START_TEST(authored_interior_points_are_joined)
{
  sbf_soft_body *body = cube_of(2, 0.2f, true);
  const sbf_vec3 inside[] = {{0.31f, 1, 0}, {0.35f, 1.05f, 0.02f}};
  body->interior = (sbf_vec3_list){inside, 2};
  sbf_level level = make(body, true);
  ck_assert_uint_eq(level.positions.count, 26 + 2 + 25);
  uint32_t of_first = 0;
  for (uint32_t s = 0; s < level.springs.count; s++)
    for (uint32_t i = 0; i < level.springs.at[s].ends.count; i++)
      for (int end = 0; end < 2; end++)
        if (level.springs.at[s].ends.at[i].at[end] == 26) {
          of_first++;
          ck_assert_float_gt(level.springs.at[s].stiffness.at[i], 0);
        }
  ck_assert_uint_eq(of_first, 4); /* three corners and the centre */
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("spring_level");
  TCase *c = tcase_create("spring_level");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, half_the_size_is_not_softer);
  tcase_add_test(c, a_finer_mesh_is_as_stiff);
  tcase_add_test(c, triangles_are_as_stiff_as_quads);
  tcase_add_test(c, twice_the_modulus_twice_as_stiff);
  tcase_add_test(c, modulus_map);
  tcase_add_test(c, frequencies_bracket);
  tcase_add_test(c, sums_of_stiffness);
  tcase_add_test(c, springs_between_pinned_points_are_inert);
  tcase_add_test(c, coincident_points_get_no_spring);
  tcase_add_test(c, authored_interior_points_are_joined);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
