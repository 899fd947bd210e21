#include "build/springs/lattice_springs_level.h"

#include "build/lattice/lattice_level.h"
#include "harness.h"
#include "mechanics/vector.h"
#include "shapes.h"

static sbf_asset *asset;
static sbfi_arena arena;
static sbf_soft_body *body;
static sbf_level level;
static double volume;
static float lattice_masses[4000];
static uint32_t inert;
static sbf_weight_map map;
static float factors[1000];

/* A bar of 1 x 0.2 x 0.2 m of 1 MPa. */
static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&arena, NULL, 0);
  sbf_polygon_mesh bar = shape_bar(asset, 10, 2, 1, 0.2f);
  body = shape_add_body(asset, "bar", &bar, false);
  body->attributes.young_modulus = 1e6f;
}

static void teardown(void) {
  sbfi_arena_free(&arena);
  sbf_asset_free(asset);
}

static void make_level(void) {
  const sbfi_lattice_recipe recipe = {.cell = 0.1, .derivation = SBF_NONE};
  sbfi_lattice_counts counts;
  ck_assert_int_eq(sbfi_lattice_level_make(&level, body, &recipe, asset, &counts, (sbfi_progress){0}, &arena),
      SBFI_LATTICE_MADE);
  volume = counts.quality.volume;
  ck_assert_uint_le(level.positions.count, 4000);
  uint8_t *pinned = sbfi_arena_allocate(&arena, level.positions.count, 1);
  sbf_level_pinned_points(&level, pinned);
  sbf_level_masses(body, &level, pinned, lattice_masses);
  ck_assert(
      sbfi_lattice_springs_level_make(&level, body, SBF_NONE, asset, &inert, (sbfi_progress){0}, &arena));
}

START_TEST(springs_store_the_energy_of_the_volume)
{
  make_level();
  ck_assert_int_eq(level.model, SBF_ELASTIC_MODEL_SPRINGS);
  ck_assert_uint_eq(level.springs.count, 1);
  ck_assert_uint_eq(inert, 0);
  const sbf_spring_set *set = &level.springs.at[0];
  double sum = 0;
  for (uint32_t s = 0; s < set->ends.count; s++) {
    sbfi_d3 along = sbfi_d3_sub(sbfi_d3_of(level.positions.at[set->ends.at[s].at[1]]),
        sbfi_d3_of(level.positions.at[set->ends.at[s].at[0]]));
    sum += (double)set->stiffness.at[s] * sbfi_d3_dot(along, along);
  }
  /* Springs shorter than half of their neighbours are made no stiffer than those (springs_matched.h). */
  ck_assert_double_le(sum, 1.001 * 6 * 1e6 * volume);
  ck_assert_double_ge(sum, 0.95 * 6 * 1e6 * volume);
}
END_TEST

START_TEST(point_masses_equal_those_of_the_lattice)
{
  make_level();
  double sum = 0;
  ck_assert_uint_eq(level.masses.count, level.positions.count);
  for (uint32_t i = 0; i < level.masses.count; i++) {
    ck_assert_float_eq(level.masses.at[i], lattice_masses[i]);
    sum += (double)level.masses.at[i];
  }
  ck_assert_double_eq_tol(sum, 40, 0.1);
}
END_TEST

/* A modulus and a damping that rise along the bar, and a pinned end. */
START_TEST(maps_and_pins_are_applied)
{
  uint32_t count = body->surface.positions.count, pinned_count = 0, soft = 0, stiff = 0;
  uint32_t *pinned = sbf_asset_allocate(asset, count, sizeof *pinned);
  sbf_weight_map maps[2];
  for (uint32_t i = 0; i < count; i++) {
    factors[i] = 0.1f + 0.9f * body->surface.positions.at[i].x;
    if (body->surface.positions.at[i].x < 1e-6f) pinned[pinned_count++] = i;
  }
  sbf_weight_map_init(&map);
  map.values = (sbf_f32_list){factors, count};
  maps[0] = maps[1] = map;
  maps[0].property = SBF_WEIGHT_PROPERTY_YOUNG_MODULUS;
  maps[1].property = SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING;
  body->weight_maps = (sbf_weight_map_list){maps, 2};
  body->attributes.stiffness_damping = 0.01f;
  sbf_pin_set pins;
  sbf_pin_set_init(&pins);
  pins.points = (sbf_u32_list){pinned, pinned_count};
  body->pins = (sbf_pin_set_list){&pins, 1};
  make_level();
  const sbf_spring_set *set = &level.springs.at[0];
  ck_assert_uint_gt(inert, 0);
  ck_assert_uint_eq(set->inert_count, inert);
  ck_assert_uint_eq(set->damping.count, set->ends.count);
  double ratios[2] = {0}, strengths[2] = {0};
  for (uint32_t s = 0; s < set->ends.count; s++) {
    float middle =
        (level.positions.at[set->ends.at[s].at[0]].x + level.positions.at[set->ends.at[s].at[1]].x) / 2;
    int end = middle > 0.75f ? 1 : middle < 0.25f ? 0 : 2;
    if (end == 2) continue;
    ratios[end] += (double)(set->damping.at[s] / set->stiffness.at[s]);
    strengths[end] += (double)set->stiffness.at[s];
    *(end ? &stiff : &soft) += 1;
  }
  ck_assert_double_gt(strengths[1] / stiff, 2 * strengths[0] / soft);
  ck_assert_double_eq_tol(ratios[1] / stiff, 0.0089, 0.001);
  ck_assert_double_gt(ratios[1] / stiff, 2 * ratios[0] / soft);
  body->weight_maps = (sbf_weight_map_list){NULL, 0};
  body->pins = (sbf_pin_set_list){NULL, 0};
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("lattice_springs_level");
  TCase *c = tcase_create("lattice_springs_level");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, springs_store_the_energy_of_the_volume);
  tcase_add_test(c, point_masses_equal_those_of_the_lattice);
  tcase_add_test(c, maps_and_pins_are_applied);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
