#include "build/springs/springs_matched.h"

#include <math.h>

#include "build/lattice/lattice_grid.h"
#include "harness.h"
#include "sbfmt/build.h"
#include "sbfmt/mechanics.h"
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

/* A point in the middle and its springs to all its neighbours on a body-centred grid of cell 1. */
static uint32_t make_star(sbf_vec3 positions[15], sbf_uint2 ends[14]) {
  positions[0] = (sbf_vec3){0, 0, 0};
  for (uint32_t i = 0; i < 14; i++) {
    const int *direction = sbfi_lattice_directions[i % SBFI_LATTICE_EDGES];
    float half = i < SBFI_LATTICE_EDGES ? 0.5f : -0.5f;
    positions[i + 1] =
        (sbf_vec3){half * (float)direction[0], half * (float)direction[1], half * (float)direction[2]};
    ends[i] = (sbf_uint2){{0, i + 1}};
  }
  return 14;
}

START_TEST(a_body_centred_grid_is_isotropic)
{
  sbf_vec3 positions[15];
  sbf_uint2 ends[14];
  float volumes[15] = {0.5f}, stiffness[14];
  uint32_t count = make_star(positions, ends);
  ck_assert(
      sbfi_springs_matched(1e4, positions, 15, volumes, ends, count, stiffness, (sbfi_progress){0}, &arena));
  /* The point's own half; its neighbours would give as much again. */
  for (uint32_t i = 0; i < count; i++)
    ck_assert_double_eq_tol(
        2 * (double)stiffness[i], i % SBFI_LATTICE_EDGES < SBFI_LATTICE_LONG_EDGES ? 4000 : 6000, 10);
}
END_TEST

START_TEST(energy_is_conserved_in_any_direction)
{
  const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0.3f, 0.1f, 1}, {0, 0, 0}, {0.01f, 0, 0}};
  const sbf_uint2 ends[] = {{{0, 1}}, {{0, 2}}, {{3, 0}}, {{0, 4}}, {{0, 5}}};
  const float volumes[6] = {2, 0, 0, 0, 0, 0};
  float stiffness[5];
  ck_assert(sbfi_springs_matched(50, positions, 6, volumes, ends, 3, stiffness, (sbfi_progress){0}, &arena));
  ck_assert_double_eq_tol(stiffness[0] * 1.0 + stiffness[1] * 4.0 + stiffness[2] * 1.1, 6 * 50 * 2, 1e-2);
  for (int i = 0; i < 3; i++) ck_assert_float_gt(stiffness[i], 0);
  /* One of no length has nothing, a short one no more than one of half the mean of its neighbours. */
  ck_assert(sbfi_springs_matched(50, positions, 6, volumes, ends, 5, stiffness, (sbfi_progress){0}, &arena));
  ck_assert_float_eq(stiffness[3], 0);
  ck_assert_float_lt(stiffness[4], 600 / (0.01f * 0.2f));
  for (int i = 0; i < 5; i++) ck_assert(isfinite(stiffness[i]));
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  sbf_vec3 positions[15];
  sbf_uint2 ends[14];
  const float volumes[15] = {0.5f};
  float stiffness[14];
  uint32_t count = make_star(positions, ends);
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_arena small;
    sbfi_arena_init(&small, &memory.allocator, 0);
    bool good =
        sbfi_springs_matched(1, positions, 15, volumes, ends, count, stiffness, (sbfi_progress){0}, &small);
    sbfi_arena_free(&small);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (good) break;
    ck_assert_uint_lt(allowed, 20);
  }
}
END_TEST

/* A bar held at its end x = 0. */
typedef struct bar {
  uint32_t n;         /* squares of its surface across */
  float length, side; /* m */
  float modulus, density;
  sbf_build_options options;
} bar;

static sbf_asset *build(const bar *b) {
  float squares = (float)b->n * b->length / b->side;
  sbf_polygon_mesh mesh = shape_bar(asset, (uint32_t)(squares + 0.5f), b->n, b->length, b->side);
  sbf_soft_body *body = shape_add_body(asset, "bar", &mesh, false);
  asset->soft_bodies = (sbf_soft_body_list){body, 1};
  uint32_t *points = sbf_asset_allocate(asset, mesh.positions.count, sizeof *points), count = 0;
  for (uint32_t i = 0; i < mesh.positions.count; i++)
    if (mesh.positions.at[i].x == 0) points[count++] = i;
  sbf_pin_set *pins = sbf_asset_allocate(asset, 1, sizeof *pins);
  sbf_pin_set_init(pins);
  pins->points = (sbf_u32_list){points, count};
  body->pins = (sbf_pin_set_list){pins, 1};
  body->attributes.young_modulus = b->modulus;
  body->attributes.density = b->density;
  sbf_asset *built;
  sbf_diagnostic error;
  ck_assert_msg(sbf_build(asset, &b->options, &built, NULL, &error) == SBF_OK, "%s", error.message);
  return built;
}

/* Mean displacement in metres of the level points at the far end under gravity along an axis. */
static double sag(const bar *b, int axis) {
  sbf_asset *built = build(b);
  const sbf_soft_body *body = &built->soft_bodies.at[0];
  const sbf_level *level = &body->levels.at[0];
  uint32_t points = level->positions.count, springs = 0, tetrahedra = level->lattice.tetrahedra.count,
           ends = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) springs += level->springs.at[s].ends.count;
  uint8_t *pinned = sbfi_arena_allocate(&arena, points, 1);
  float *masses = sbfi_arena_allocate(&arena, points, sizeof *masses);
  float *stiffness = sbfi_arena_allocate(&arena, springs + 1, sizeof *stiffness);
  float *moduli = sbfi_arena_allocate(&arena, tetrahedra + 1, sizeof *moduli);
  float *ratios = sbfi_arena_allocate(&arena, tetrahedra + 1, sizeof *ratios);
  sbf_uint2 *joined = sbfi_arena_allocate(&arena, springs + 1, sizeof *joined);
  double *forces = sbfi_arena_allocate(&arena, 3 * (size_t)points, sizeof *forces);
  double *moved = sbfi_arena_allocate(&arena, 3 * (size_t)points, sizeof *moved);
  double *scratch = sbfi_arena_allocate(&arena, 10 * (size_t)points, sizeof *scratch), sum = 0;
  springs = 0;
  for (uint32_t s = 0; s < level->springs.count; s++)
    for (uint32_t i = 0; i < level->springs.at[s].ends.count; i++, springs++) {
      joined[springs] = level->springs.at[s].ends.at[i];
      stiffness[springs] = level->springs.at[s].stiffness.at[i];
    }
  for (uint32_t t = 0; t < tetrahedra; t++) {
    moduli[t] = b->modulus;
    ratios[t] = 0.25f;
  }
  sbf_level_pinned_points(level, pinned);
  sbf_level_masses(body, level, pinned, masses);
  for (uint32_t i = 0; i < points; i++) masses[i] = pinned[i] ? 0 : masses[i];
  for (uint32_t i = 0; i < points; i++) forces[3 * i + (uint32_t)axis] = 9.81 * masses[i];
  const sbf_spring_network network = {points, springs, level->positions.at, masses, NULL, joined, stiffness,
      tetrahedra, level->lattice.tetrahedra.at, moduli, ratios, 0, NULL, NULL, NULL};
  ck_assert_double_lt(sbf_network_static(&network, forces, 1e-8, 20000, moved, scratch), 1e-7);
  for (uint32_t i = 0; i < points; i++) {
    if (level->positions.at[i].x < b->length * (1 - 1e-5f)) continue;
    sum += moved[3 * i + (uint32_t)axis];
    ends++;
  }
  ck_assert_uint_gt(ends, 0);
  sbf_asset_free(built);
  return sum / ends;
}

/* The motion of a bar depends on rho g L / E only, for any size, material and kind of level. */
START_TEST(sag_scales_with_weight_over_modulus)
{
  static const sbf_build_interior interiors[] = {
      SBF_BUILD_INTERIOR_CENTROID, SBF_BUILD_INTERIOR_LATTICE, SBF_BUILD_INTERIOR_TETRAHEDRA};
  static const bar scales[] = {
      {3, 0.1f, 0.025f, 1e4f, 800, {0}}, {3, 1, 0.25f, 1e5f, 1000, {0}}, {3, 12, 3, 3e6f, 1200, {0}}};
  for (int i = 0; i < 3; i++) {
    double first = 0;
    for (int s = 0; s < 3; s++) {
      bar b = scales[s];
      b.options.interior = interiors[i];
      b.options.without_calibration = true;
      double fraction = sag(&b, 1) / b.length / (b.density * 9.81 * b.length / b.modulus);
      if (s == 0) first = fraction;
      ck_assert_double_gt(fraction, 0);
      ck_assert_double_eq_tol(fraction / first, 1, 0.05);
    }
  }
}
END_TEST

/* A bar that bends and stretches under its weight: three resolutions agree, with each other and with what
 * Timoshenko's theory says (fixed end, shear included). */
START_TEST(refining_changes_next_to_nothing)
{
  enum { RESOLUTIONS = 3 };
  static const uint32_t fine[RESOLUTIONS] = {5, 7, 10};
  double bent[RESOLUTIONS], stretched[RESOLUTIONS];
  for (int r = 0; r < RESOLUTIONS; r++) {
    bar b = {
        fine[r], 1, 0.25f, 1e5f, 1000, {.interior = SBF_BUILD_INTERIOR_LATTICE, .cell_m = 0.25 / fine[r]}};
    bent[r] = sag(&b, 1);
    stretched[r] = sag(&b, 0);
  }
  for (int r = 1; r < RESOLUTIONS; r++) {
    ck_assert_double_eq_tol(bent[r] / bent[r - 1], 1, 0.05);
    ck_assert_double_eq_tol(stretched[r] / stretched[r - 1], 1, 0.05);
  }
  ck_assert_double_eq_tol(bent[0] / bent[RESOLUTIONS - 1], 1, 0.05);
  ck_assert_double_eq_tol(stretched[0] / stretched[RESOLUTIONS - 1], 1, 0.05);
  double weight = 1000 * 9.81, shear = 1e5 / 2.5 * 5 / 6;
  ck_assert_double_eq_tol(
      bent[RESOLUTIONS - 1] / (weight * 12 / (8 * 1e5 * 0.25 * 0.25) + weight / (2 * shear)), 1, 0.05);
  ck_assert_double_eq_tol(stretched[RESOLUTIONS - 1] / (weight / (2 * 1e5)), 1, 0.05);
}
END_TEST

int main(void) {
  Suite *s = suite_create("springs_matched");
  TCase *c = tcase_create("springs_matched");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, a_body_centred_grid_is_isotropic);
  tcase_add_test(c, energy_is_conserved_in_any_direction);
  tcase_add_test(c, every_allocation_may_fail);
  tcase_add_test(c, sag_scales_with_weight_over_modulus);
  tcase_add_test(c, refining_changes_next_to_nothing);
  suite_add_tcase(s, c);
  return harness_run(s);
}
