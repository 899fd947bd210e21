#include <string.h>

#include "harness.h"
#include "mechanics/flat_body.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

static sbf_asset *asset;
static sbf_soft_body *body;
static sbf_level level;
static uint8_t pinned[256];
static float masses[256];

static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbf_polygon_mesh mesh = shape_cube(asset, 2, 0.2f, (sbf_vec3){0, 1, 0});
  body = shape_add_body(asset, "cube", &mesh, false);
  sbf_level_init(&level);
  level.positions = body->surface.positions;
}
static void teardown(void) {
  sbf_asset_free(asset);
}

static double sum(void) {
  double all = 0;
  for (uint32_t i = 0; i < level.positions.count; i++) all += masses[i];
  return all;
}

START_TEST(volume_by_tributary_area)
{
  ck_assert_double_eq_tol(sbf_level_masses(body, &level, NULL, masses), 8, 1e-5); /* 1000 kg/m^3 * 8 litres */
  ck_assert_double_eq_tol(sum(), 8, 1e-5);
  /* 24 squares: a corner has a quarter of three, the middle of a side of two times two, of a face of four. */
  float min = 1e9f, max = 0;
  for (int i = 0; i < 26; i++) {
    if (masses[i] < min) min = masses[i];
    if (masses[i] > max) max = masses[i];
  }
  ck_assert_float_eq_tol(min, 8 / 24.0f * 0.75f, 1e-5f);
  ck_assert_float_eq_tol(max, 8 / 24.0f, 1e-5f);
}
END_TEST

/* Pinned points have no mass, both with stated masses and with those of a lattice. */
START_TEST(pinned_points_of_other_bodies_have_no_mass)
{
  static const sbf_uint4 tetrahedra[] = {{{0, 1, 2, 3}}};
  static const sbf_vec3 corners[] = {{0, 0, 0}, {0.6f, 0, 0}, {0, 0.1f, 0}, {0, 0, 0.1f}}; /* a litre */
  float stated[4] = {1, 2, 3, 4};
  sbf_level other;
  sbf_level_init(&other);
  other.positions = (sbf_vec3_list){corners, 4};
  memset(pinned, 0, sizeof pinned);
  pinned[1] = 1;
  other.lattice.tetrahedra = (sbf_uint4_list){tetrahedra, 1};
  ck_assert_double_eq_tol(sbf_level_masses(body, &other, pinned, masses), 0.75, 1e-5);
  ck_assert_float_eq(masses[1], 0);
  ck_assert_float_eq_tol(masses[2], 0.25f, 1e-6f);
  other.masses = (sbf_f32_list){stated, 4};
  ck_assert_double_eq_tol(sbf_level_masses(body, &other, pinned, masses), 8, 1e-6);
  ck_assert_float_eq(masses[1], 0);
}
END_TEST

START_TEST(pinned_points_have_no_mass)
{
  const uint32_t points[] = {3, 7, 9};
  const float weights[] = {1, 0.5f, 0.25f};
  sbf_pin_set pins;
  sbf_pin_set_init(&pins);
  pins.points = (sbf_u32_list){points, 3};
  level.pins = (sbf_pin_set_list){&pins, 1};
  ck_assert_uint_eq(sbf_level_pinned_points(&level, pinned), 3);
  pins.weights = (sbf_f32_list){weights, 3};
  ck_assert_uint_eq(sbf_level_pinned_points(&level, pinned), 1);
  ck_assert(pinned[3] && !pinned[7]);
  ck_assert_double_eq_tol(
      sbf_level_masses(body, &level, pinned, masses), 8, 1e-5); /* the rest carries it all */
  ck_assert(masses[3] == 0);
  pins.minimum = 1;
  ck_assert_uint_eq(sbf_level_pinned_points(&level, pinned), 3);
  pins.minimum = 0, pins.maximum = 0.9f;
  ck_assert_uint_eq(sbf_level_pinned_points(&level, pinned), 0);
}
END_TEST

START_TEST(points_without_area_get_the_mean_mass)
{
  sbf_vec3 positions[28] = {{0, 0, 0}};
  for (int i = 0; i < 26; i++) positions[i] = body->surface.positions.at[i];
  level.positions = (sbf_vec3_list){positions, 28};
  ck_assert_double_eq_tol(sbf_level_masses(body, &level, NULL, masses), 8, 1e-5);
  ck_assert_float_eq_tol(masses[27], 8 / 28.0f, 1e-5f);
}
END_TEST

START_TEST(stated_mass_and_maps)
{
  float factors[26];
  for (int i = 0; i < 26; i++) factors[i] = 2;
  sbf_weight_map map;
  sbf_weight_map_init(&map);
  map.property = SBF_WEIGHT_PROPERTY_DENSITY;
  map.values = (sbf_f32_list){factors, 26};
  body->weight_maps = (sbf_weight_map_list){&map, 1};
  ck_assert_double_eq_tol(sbf_level_masses(body, &level, NULL, masses), 16, 1e-5);
  body->attributes.mass = 3;
  ck_assert_double_eq_tol(sbf_level_masses(body, &level, NULL, masses), 3, 1e-5);
  ck_assert_double_eq_tol(sum(), 3, 1e-5);
}
END_TEST

START_TEST(points_in_another_order)
{
  uint32_t reversed[26];
  sbf_vec3 positions[26];
  for (uint32_t i = 0; i < 26; i++) {
    reversed[i] = 25 - i;
    positions[25 - i] = body->surface.positions.at[i];
  }
  float straight[26];
  sbf_level_masses(body, &level, NULL, straight);
  level.positions.at = positions;
  level.new_from_old = (sbf_u32_list){reversed, 26};
  sbf_level_masses(body, &level, NULL, masses);
  for (uint32_t i = 0; i < 26; i++) ck_assert_float_eq_tol(masses[25 - i], straight[i], 1e-7f);
}
END_TEST

START_TEST(sheets)
{
  sbf_polygon_mesh mesh = shape_sheet(asset, 4, 5);
  body->surface = mesh;
  level.positions = mesh.positions;
  body->attributes.thickness = 0.002f;
  sbf_body_measures m;
  sbf_body_measure(body, &m);
  ck_assert(m.sheet);
  ck_assert_double_eq_tol(m.volume, 20 * 0.002, 1e-6);
  ck_assert_double_eq_tol(sbf_level_masses(body, &level, NULL, masses), 40, 1e-4);
  body->attributes.area_density = 0.3f;
  ck_assert_double_eq_tol(sbf_level_masses(body, &level, NULL, masses), 6, 1e-5);
}
END_TEST

/* A fin that is drawn from both sides: closed, and nothing inside. */
START_TEST(a_flat_closed_surface_has_the_mass_of_one_layer)
{
  static const sbf_vec3 corners[] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  static const uint32_t sizes[] = {4, 4}, points[] = {0, 1, 2, 3, 3, 2, 1, 0};
  sbf_body_measures m;
  ck_assert(!sbfi_flat_body_weigh(body)); /* the cube */
  ck_assert_float_eq(body->attributes.area_density, 0);
  body->surface.positions = (sbf_vec3_list){corners, 4};
  body->surface.polygon_sizes = (sbf_u32_list){sizes, 2};
  body->surface.polygon_points = (sbf_u32_list){points, 8};
  body->attributes.density = 1000;
  body->attributes.thickness = 0.004f;
  sbf_body_measure(body, &m);
  ck_assert(!(m.mass > 0));
  ck_assert(sbfi_flat_body_weigh(body));
  sbf_body_measure(body, &m);
  ck_assert(m.sheet);
  ck_assert_double_eq_tol(m.mass, 2 * 0.004 * 1000, 1e-5);
  ck_assert(!sbfi_flat_body_weigh(body)); /* it is stated now */
}
END_TEST

START_TEST(depth_is_the_radius_of_a_ball)
{
  sbf_body_measures m;
  sbf_body_measure(body, &m);
  ck_assert(!m.sheet);
  ck_assert_double_eq_tol(m.depth, 0.1, 1e-6); /* of a cube, half its side */
}
END_TEST

START_TEST(tetrahedra_give_each_corner_a_quarter)
{
  const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const sbf_uint4 tetrahedra[] = {{{0, 1, 2, 3}}, {{1, 2, 3, 4}}};
  const float densities[] = {12, 24};
  level.positions = (sbf_vec3_list){positions, 5};
  level.lattice.tetrahedra = (sbf_uint4_list){tetrahedra, 2};
  level.lattice.densities = (sbf_f32_list){densities, 2};
  ck_assert_double_eq_tol(sbf_level_masses(body, &level, NULL, masses), 2 + 24 / 3.0, 1e-5);
  ck_assert_float_eq_tol(masses[0], 0.5f, 1e-6f);
  ck_assert_float_eq_tol(masses[4], 2, 1e-6f);
  ck_assert_float_eq_tol(masses[1], 2.5f, 1e-6f);
}
END_TEST

START_TEST(points_alone_are_balls)
{
  body->surface.polygon_sizes.count = body->surface.polygon_points.count = 0;
  body->collision.particle_radius = 0.1f;
  ck_assert_double_eq_tol(sbf_level_masses(body, &level, NULL, masses), 26 * 4.18879, 1e-3);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("body_mass");
  TCase *c = tcase_create("body_mass");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, volume_by_tributary_area);
  tcase_add_test(c, pinned_points_have_no_mass);
  tcase_add_test(c, pinned_points_of_other_bodies_have_no_mass);
  tcase_add_test(c, points_without_area_get_the_mean_mass);
  tcase_add_test(c, stated_mass_and_maps);
  tcase_add_test(c, points_in_another_order);
  tcase_add_test(c, sheets);
  tcase_add_test(c, a_flat_closed_surface_has_the_mass_of_one_layer);
  tcase_add_test(c, depth_is_the_radius_of_a_ball);
  tcase_add_test(c, tetrahedra_give_each_corner_a_quarter);
  tcase_add_test(c, points_alone_are_balls);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
