#include "build/levels/calibrate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "build/levels/jiggle_level.h"
#include "build/levels/level_set.h"
#include "harness.h"
#include "mechanics/static_solve.h"
#include "sbfmt/build.h"
#include "shapes.h"

static sbf_asset *asset;

static void setup(void) {
  asset = sbf_asset_create(NULL);
}
static void teardown(void) {
  sbf_asset_free(asset);
}

/* A beam of 1 x 0.2 x 0.2 m, E = 1 MPa, pinned at x = 0. */
static sbf_soft_body *add_beam(bool pinned) {
  sbf_polygon_mesh cube = shape_cube(asset, 8, 0.2f, (sbf_vec3){0, 0, 0});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)cube.positions.at;
  uint32_t *pinned_points = sbf_asset_allocate(asset, cube.positions.count, sizeof *pinned_points), count = 0;
  for (uint32_t i = 0; i < cube.positions.count; i++) {
    at[i].x = 5 * (at[i].x + 0.1f);
    if (at[i].x < 1e-6f) pinned_points[count++] = i;
  }
  sbf_soft_body *body = shape_add_body(asset, "beam", &cube, false);
  body->attributes.young_modulus = 1e6f;
  sbf_pin_set *pins = sbf_asset_allocate(asset, 1, sizeof *pins);
  sbf_pin_set_init(pins);
  pins->points = (sbf_u32_list){pinned_points, count};
  if (pinned) body->pins = (sbf_pin_set_list){pins, 1};
  return body;
}

static uint32_t grid_point(uint32_t n, uint32_t x, uint32_t y, uint32_t z) {
  return (x * (n + 1) + y) * (n + 1) + z;
}

/* The beam as a grid of 5 n x n x n cubes of six tetrahedra each, fixed at x = 0: the lattice of published
 * results. */
static void grid_level(sbf_level *level, uint32_t n) {
  static const int paths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  uint32_t points = (5 * n + 1) * (n + 1) * (n + 1), count = 0, pinned_points = (n + 1) * (n + 1);
  sbf_vec3 *at = sbf_asset_allocate(asset, points, sizeof *at);
  sbf_uint4 *tetrahedra = sbf_asset_allocate(asset, 30 * (size_t)n * n * n, sizeof *tetrahedra);
  uint32_t *pinned = sbf_asset_allocate(asset, pinned_points, sizeof *pinned);
  uint32_t *none = sbf_asset_allocate(asset, 386, sizeof *none);
  sbf_pin_set *pins = sbf_asset_allocate(asset, 1, sizeof *pins);
  for (uint32_t x = 0; x <= 5 * n; x++)
    for (uint32_t y = 0; y <= n; y++)
      for (uint32_t z = 0; z <= n; z++)
        at[grid_point(n, x, y, z)] = (sbf_vec3){
            0.2f * (float)x / (float)n, 0.2f * (float)y / (float)n - 0.1f, 0.2f * (float)z / (float)n - 0.1f};
  for (uint32_t cube = 0; cube < 5 * n * n * n; cube++)
    for (int p = 0; p < 6; p++) {
      /* Neighbours are mirror images: else the beam would bend aside. */
      const uint32_t at_cube[3] = {cube / (n * n), cube / n % n, cube % n};
      uint32_t c[3], mirrored = 0;
      for (int k = 0; k < 3; k++) {
        c[k] = at_cube[k] + at_cube[k] % 2;
        mirrored += at_cube[k] % 2;
      }
      sbf_uint4 *t = &tetrahedra[count++];
      t->at[0] = grid_point(n, c[0], c[1], c[2]);
      for (int k = 0; k < 3; k++) {
        c[paths[p][k]] = 2 * at_cube[paths[p][k]] + 1 - c[paths[p][k]];
        t->at[k + 1] = grid_point(n, c[0], c[1], c[2]);
      }
      if ((p < 3) == (mirrored % 2 == 0)) continue; /* an odd order of axes turns it inside out */
      uint32_t swapped = t->at[1];
      t->at[1] = t->at[2];
      t->at[2] = swapped;
    }
  for (uint32_t i = 0; i < pinned_points; i++) pinned[i] = i;
  memset(none, 0xff, 386 * sizeof *none);
  sbf_pin_set_init(pins);
  pins->points = (sbf_u32_list){pinned, pinned_points};
  sbf_level_init(level);
  level->model = SBF_ELASTIC_MODEL_TETRAHEDRA;
  level->cell = 0.2f / (float)n;
  level->positions = (sbf_vec3_list){at, points};
  level->new_from_old = (sbf_u32_list){none, 386};
  level->lattice.tetrahedra = (sbf_uint4_list){tetrahedra, count};
  level->pins = (sbf_pin_set_list){pins, 1};
}

/* Displacement of the middle of the far end and rotation of the end, under gravity along `g` and a couple of
 * `couple` N*m about the beam. */
typedef struct end_motion {
  double y, z, turn;
} end_motion;

static end_motion move_end(
    const sbf_soft_body *body, const sbf_level *level, uint32_t n, sbf_vec3 g, double couple) {
  sbfi_arena arena;
  sbfi_level_statics s;
  sbfi_static_outcome outcome;
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_level_statics_make(&s, body, level, NULL, &arena));
  double *forces = sbfi_arena_allocate(&arena, s.network.point_count, 3 * sizeof *forces);
  double *positions = sbfi_arena_allocate(&arena, s.network.point_count, 3 * sizeof *positions);
  uint32_t first = grid_point(n, 5 * n, 0, 0), last = grid_point(n, 5 * n, n, n);
  double sum = 0;
  for (uint32_t i = first; i <= last; i++) {
    sbf_vec3 p = level->positions.at[i];
    sum += (double)p.y * p.y + (double)p.z * p.z;
  }
  for (uint32_t i = first; i <= last; i++) {
    forces[3 * i + 1] = -couple * level->positions.at[i].z / sum;
    forces[3 * i + 2] = couple * level->positions.at[i].y / sum;
  }
  sbfi_static_start(&s.network, positions);
  const sbfi_static_problem problem = {
      .network = &s.network, .gravity = g, .forces = forces, .tolerance = 1e-6};
  ck_assert(sbfi_static_solve(&problem, positions, &outcome, NULL));
  ck_assert(outcome.converged);
  end_motion end = {0, 0, 0};
  for (uint32_t i = first; i <= last; i++) {
    sbf_vec3 p = level->positions.at[i];
    double dy = positions[3 * i + 1] - p.y, dz = positions[3 * i + 2] - p.z, points = last - first + 1;
    end.y += dy / points;
    end.z += dz / points;
    end.turn += (p.y * dz - p.z * dy) / sum;
  }
  sbfi_arena_free(&arena);
  return end;
}

/* The case of the research: 240 elements, of which 15,360 make up the reference. */
START_TEST(a_beam_of_240_bends_as_one_of_15360)
{
  const sbf_soft_body *body = add_beam(true);
  sbf_level fine, coarse;
  sbfi_reference r;
  sbfi_calibration c;
  grid_level(&fine, 8);
  grid_level(&coarse, 2);
  ck_assert_uint_eq(fine.lattice.tetrahedra.count, 15360);
  ck_assert_uint_eq(coarse.lattice.tetrahedra.count, 240);
  ck_assert_int_eq(
      sbfi_reference_from_level(&r, body, &fine, NULL, asset,
          &(sbfi_reference_use){.gravity_displacements = true, .twists = true, .pushes = true}, NULL),
      0);
  ck_assert(r.is_valid);
  ck_assert(
      sbfi_level_calibrate(&coarse, body, NULL, &r, false, 1.0 / 60, asset, &c, (sbfi_progress){0}, NULL));
  ck_assert_double_lt(fabs(c.period_error), 0.02);
  ck_assert_float_eq(coarse.lattice.reference_modulus.at[0], 1e6f);
  ck_assert_uint_eq(coarse.lattice.young_modulus.count, 240);
  double mean = 0;
  for (uint32_t t = 0; t < 240; t++) mean += coarse.lattice.young_modulus.at[t] / 240; /* all as large */
  ck_assert_double_eq_tol(mean, 1e6 * c.factor, 100);
  ck_assert_float_eq(coarse.calibration->factor, (float)c.factor);
  ck_assert_uint_eq(coarse.calibration->reference_elements, 15360);
  /* Large strains, which the fit did not include; then across, diagonal, and twisted. */
  const sbf_vec3 loads[] = {{0, -9.81f, 0}, {0, 0, 9.81f}, {0, -7, 7}, {0, 0, 0}};
  for (int i = 0; i < 4; i++) {
    double couple = i == 3 ? 2 : 0;
    end_motion wanted = move_end(body, &fine, 8, loads[i], couple),
               is = move_end(body, &coarse, 2, loads[i], couple);
    double size = hypot(wanted.y, wanted.z);
    if (i < 3)
      ck_assert_double_lt(hypot(is.y - wanted.y, is.z - wanted.z), 0.02 * size);
    else /* no modulus corrects that: equally cut cubes, two across, twist less */
      ck_assert_double_eq_tol(is.turn / wanted.turn, 0.73, 0.03);
  }
  sbfi_reference_free(&r);
}
END_TEST

/* Mean displacement of the points beyond `x` under a force distributed over them. */
static sbfi_d3 push(const sbf_soft_body *body, const sbf_level *level, float x, sbfi_d3 force) {
  sbfi_arena arena;
  sbfi_level_statics s;
  sbfi_static_outcome outcome;
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_level_statics_make(&s, body, level, NULL, &arena));
  double *forces = sbfi_arena_allocate(&arena, s.network.point_count, 3 * sizeof *forces);
  double *positions = sbfi_arena_allocate(&arena, s.network.point_count, 3 * sizeof *positions);
  double mass = 0;
  sbfi_d3 sum = {0, 0, 0};
  for (uint32_t i = 0; i < s.network.point_count; i++)
    mass += level->positions.at[i].x > x ? s.network.masses[i] : 0;
  for (uint32_t i = 0; i < s.network.point_count; i++) {
    double fraction = level->positions.at[i].x > x ? s.network.masses[i] / mass : 0;
    forces[3 * i] = fraction * force.x, forces[3 * i + 1] = fraction * force.y,
               forces[3 * i + 2] = fraction * force.z;
  }
  sbfi_static_start(&s.network, positions);
  const sbfi_static_problem problem = {.network = &s.network, .forces = forces, .tolerance = 1e-5};
  ck_assert(sbfi_static_solve(&problem, positions, &outcome, NULL) && outcome.converged);
  for (uint32_t i = 0; i < s.network.point_count; i++) {
    double fraction = level->positions.at[i].x > x ? s.network.masses[i] / mass : 0;
    sum.x += fraction * (positions[3 * i] - level->positions.at[i].x);
    sum.y += fraction * (positions[3 * i + 1] - level->positions.at[i].y);
    sum.z += fraction * (positions[3 * i + 2] - level->positions.at[i].z);
  }
  sbfi_arena_free(&arena);
  return sum;
}

/* The armadillo's left arm in its bent rest pose, fixed where it joins the body. Fitted to gravity, tested
 * with forces at the hand. */
START_TEST(an_arm_of_the_armadillo)
{
  const char *path = harness_shared("armadillo/armadillo_25k.obj");
  if (!path) return;
  sbf_polygon_mesh mesh = shape_of_obj(asset, path);
  float low = INFINITY, high = -INFINITY;
  for (uint32_t i = 0; i < mesh.positions.count; i++) {
    low = fminf(low, mesh.positions.at[i].x);
    high = fmaxf(high, mesh.positions.at[i].x);
  }
  float size = high - low, shoulder = low + 0.68f * size, hand = low + 0.92f * size;
  sbf_soft_body *body = shape_add_body(asset, "armadillo", &mesh, false);
  uint32_t *pinned = sbf_asset_allocate(asset, mesh.positions.count, sizeof *pinned), count = 0;
  for (uint32_t i = 0; i < mesh.positions.count; i++)
    if (mesh.positions.at[i].x < shoulder) pinned[count++] = i;
  sbf_pin_set *pins = sbf_asset_allocate(asset, 1, sizeof *pins);
  sbf_pin_set_init(pins);
  pins->points = (sbf_u32_list){pinned, count};
  body->pins = (sbf_pin_set_list){pins, 1};
  body->attributes.young_modulus = 1000 * 9.81f * size * 20;
  sbfi_reference r;
  ck_assert_int_eq(sbfi_reference_make(&r, body, 16000, false, asset,
                       &(sbfi_reference_use){.twists = true, .pushes = true}, NULL),
      0);
  sbf_level level;
  sbfi_arena scratch;
  sbfi_lattice_counts counts;
  sbfi_calibration c;
  const sbfi_lattice_recipe recipe = {.elements = 2000};
  sbfi_arena_init(&scratch, NULL, 0);
  ck_assert_int_eq(
      sbfi_lattice_level_make(&level, body, &recipe, asset, &counts, (sbfi_progress){0}, &scratch), 0);
  double weight = 1000 * 9.81 * size * size * size * 1e-4;
  double off[2][3];
  for (int calibrated = 0; calibrated < 2; calibrated++) {
    if (calibrated)
      ck_assert(
          sbfi_level_calibrate(&level, body, NULL, &r, false, 1.0 / 60, asset, &c, (sbfi_progress){0}, NULL));
    for (int axis = 0; axis < 3; axis++) {
      sbfi_d3 force = {axis == 0 ? weight : 0, axis == 1 ? weight : 0, axis == 2 ? weight : 0};
      sbfi_d3 wanted = push(body, &r.made, hand, force), is = push(body, &level, hand, force);
      off[calibrated][axis] = sbfi_d3_length(sbfi_d3_sub(is, wanted)) / sbfi_d3_length(wanted);
    }
  }
  /* The arm has one or two hundred elements, and hardly any in a finger. */
  ck_assert_double_lt(c.residual, 0.02);
  ck_assert_double_lt(fabs(c.period_error), 0.03);
  for (int axis = 0; axis < 3; axis++) {
    ck_assert_double_gt(off[0][axis], 0.4);
    ck_assert_double_lt(off[1][axis], 0.07);
  }
  sbfi_arena_free(&scratch);
  sbfi_reference_free(&r);
}
END_TEST

static sbf_asset *build(sbf_build_options options, sbf_build_report *report) {
  sbf_asset *built;
  sbf_diagnostic error;
  options.interior = SBF_BUILD_INTERIOR_TETRAHEDRA;
  ck_assert_msg(sbf_build(asset, &options, &built, report, &error) == SBF_OK, "%s", error.message);
  return built;
}

/* Each factor is within its bounds; the average agrees with the stated one. */
static void check_moduli(const sbf_level *level) {
  const sbf_f32_list *moduli = &level->lattice.young_modulus;
  double sum = 0, whole = 0;
  ck_assert_uint_eq(moduli->count, level->lattice.tetrahedra.count);
  for (uint32_t t = 0; t < moduli->count; t++) {
    sbfi_d3 p[4];
    for (int k = 0; k < 4; k++) p[k] = sbfi_d3_of(level->positions.at[level->lattice.tetrahedra.at[t].at[k]]);
    double volume =
        sbfi_d3_dot(sbfi_d3_sub(p[1], p[0]), sbfi_d3_cross(sbfi_d3_sub(p[2], p[0]), sbfi_d3_sub(p[3], p[0])));
    ck_assert_float_gt(moduli->at[t], 0.1e6f);
    ck_assert_float_lt(moduli->at[t], 2.5e6f);
    sum += volume * (double)moduli->at[t];
    whole += volume;
  }
  ck_assert_double_eq_tol(sum / whole, 1e6 * (double)level->calibration->factor, 1e3);
}

/* Reported load by load: gravity along each axis, of which the greatest residual counts, and twists. */
static void check_errors(const sbf_level *level, uint32_t loads) {
  const sbf_calibration *c = level->calibration;
  float max = 0;
  ck_assert_uint_eq(c->load_errors.count, loads);
  ck_assert_uint_eq(c->twist_errors.count, 3);
  for (uint32_t i = 0; i < loads; i++) max = fmaxf(max, fabsf(c->load_errors.at[i]));
  ck_assert_float_eq_tol(max, c->residual, 1e-6f);
  for (uint32_t i = 0; i < 3; i++) {
    ck_assert_float_ne(c->twist_errors.at[i], 0);
    ck_assert_float_lt(fabsf(c->twist_errors.at[i]), 0.6f);
  }
}

START_TEST(coarse_levels_are_calibrated)
{
  sbf_build_report report;
  add_beam(true);
  sbf_asset *built = build((sbf_build_options){.cell_m = 0.1}, &report);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  ck_assert_uint_eq(report.lattice_calibration.count, 1);
  ck_assert_double_lt(report.lattice_calibration.max_period_error, 0.02);
  ck_assert_float_eq(level->lattice.reference_modulus.at[0], 1e6f);
  ck_assert_float_lt(level->calibration->factor, 0.95f);
  ck_assert_float_gt(level->calibration->factor, 0.5f);
  check_moduli(level);
  check_errors(level, 3);
  ck_assert_float_gt(level->simulation.cost, 100);
  sbf_asset_free(built);
  built = build((sbf_build_options){.cell_m = 0.1, .without_calibration = true}, &report);
  ck_assert_uint_eq(report.lattice_calibration.count, 0);
  ck_assert_uint_eq(built->soft_bodies.at[0].levels.at[0].lattice.young_modulus.count, 0);
  sbf_asset_free(built);
}
END_TEST

START_TEST(the_coarsest_sufficient_level_is_chosen)
{
  sbf_build_report report;
  uint32_t counts[2];
  const double errors[] = {0.1, 0.005};
  add_beam(true);
  for (int i = 0; i < 2; i++) {
    sbf_asset *built = build((sbf_build_options){.error_m = errors[i]}, &report);
    const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
    counts[i] = level->lattice.tetrahedra.count;
    ck_assert_float_gt(level->simulation.error, 0);
    ck_assert_float_le(level->simulation.error, (float)errors[i]);
    sbf_asset_free(built);
  }
  ck_assert_uint_lt(counts[0], counts[1]);
}
END_TEST

START_TEST(levels_go_from_lattices_to_jiggle)
{
  sbf_build_report report;
  add_beam(true);
  sbf_render_mesh *skin = sbf_asset_allocate(asset, 1, sizeof *skin);
  sbf_render_mesh_init(skin);
  skin->id = skin->name = "skin";
  skin->mesh = asset->soft_bodies.at[0].surface;
  skin->mesh.target = SBF_MESH_TARGET_RENDERING;
  asset->render_meshes = (sbf_render_mesh_list){skin, 1};
  sbf_asset *built = build((sbf_build_options){.cell_m = 0.05, .levels = 4}, &report);
  static const sbf_elastic_model models[] = {SBF_ELASTIC_MODEL_TETRAHEDRA, SBF_ELASTIC_MODEL_TETRAHEDRA,
      SBF_ELASTIC_MODEL_SPRINGS, SBF_ELASTIC_MODEL_JIGGLE};
  const sbf_level_list *levels = &built->soft_bodies.at[0].levels;
  ck_assert_uint_eq(levels->count, 4);
  for (uint32_t l = 0; l < 4; l++) {
    const sbf_level *level = &levels->at[l];
    ck_assert_int_eq(level->model, models[l]);
    ck_assert_int_eq(level->derived, 0);
    ck_assert_uint_eq(level->embeddings.count, 2); /* of the surface and of the skin */
    ck_assert_uint_eq(level->embeddings.at[1].points.count, skin->mesh.positions.count);
    ck_assert_float_gt(level->simulation.cost, 0);
    if (l > 0) ck_assert_float_gt(level->simulation.error, 0);
    ck_assert_uint_eq(level->lattice.tetrahedra.count > 0, l < 2);
    if (l > 0) ck_assert_float_lt(level->simulation.cost, levels->at[l - 1].simulation.cost);
    if (l > 0) ck_assert_float_gt(level->simulation.error, levels->at[l - 1].simulation.error);
  }
  ck_assert_float_eq_tol(levels->at[3].jiggle->frequency, 1.02f, 0.06f); /* a clamped beam */
  sbf_asset_free(built);
}
END_TEST

/* An unpinned body is bent about itself and stretched. With moduli fitted to bending alone, it stretched by
 * 37 % too much. */
START_TEST(a_free_body_is_calibrated_too)
{
  sbf_build_report report;
  add_beam(false);
  sbf_asset *built = build((sbf_build_options){.cell_m = 0.1}, &report);
  const sbf_level *level = &built->soft_bodies.at[0].levels.at[0];
  ck_assert_uint_eq(report.lattice_calibration.count, 1);
  ck_assert_float_gt(level->calibration->factor, 0.5f);
  ck_assert_float_lt(level->calibration->factor, 1.1f);
  ck_assert_uint_eq(level->calibration->load_errors.count, SBFI_FREE_LOADS);
  for (uint32_t l = 0; l < SBFI_FREE_LOADS; l++)
    ck_assert_float_lt(fabsf(level->calibration->load_errors.at[l]), l < SBFI_BENDS ? 0.1f : 0.2f);
  ck_assert_uint_eq(level->calibration->twist_errors.count, SBFI_TWISTS);
  ck_assert_double_lt(report.lattice_calibration.max_period_error, 0.02);
  check_moduli(level);
  sbf_asset_free(built);
}
END_TEST

/* A blade of eight corners, thinner than an element. To match its frequency, its lattice would have to be
 * several times softer. It is softened so far where it has spare stiffness, but not where it has to carry its
 * own weight. */
START_TEST(standing_bodies_keep_the_stiffness_that_their_weight_needs)
{
  sbf_polygon_mesh blade = shape_cube(asset, 1, 1, (sbf_vec3){0, 0, 0});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)blade.positions.at;
  for (uint32_t i = 0; i < blade.positions.count; i++) at[i].x *= 0.05f;
  sbf_soft_body *body = shape_add_body(asset, "blade", &blade, false);
  sbf_build_options options = {.elements = 100};
  sbf_build_report report;
  /* At 1000 kg/m^3 a metre strains by a twentieth with 200 kPa, of two digits. */
  const float moduli[] = {1e7f, 4e5f, 1e5f};
  double factors[3];
  for (int i = 0; i < 3; i++) {
    body->attributes.young_modulus = moduli[i];
    sbf_asset *built = build(options, &report);
    ck_assert_uint_eq(report.lattice_calibration.count, 1);
    factors[i] = (double)built->soft_bodies.at[0].levels.at[0].calibration->factor;
    sbf_asset_free(built);
  }
  ck_assert_double_lt(factors[0], 0.4);
  ck_assert_double_eq_tol(factors[1], 0.5, 1e-3);
  ck_assert_double_eq_tol(factors[2], 1, 1e-3);
}
END_TEST

/* A plate of 1 x 0.2 x 0.04 m, held at one end; `order` says which of its sides lies along x, y and z. */
static sbf_soft_body *add_plate(const int order[3]) {
  static const float sides[3] = {1, 0.2f, 0.04f};
  sbf_polygon_mesh cube = shape_cube(asset, 4, 1, (sbf_vec3){0.5f, 0.5f, 0.5f});
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)cube.positions.at;
  uint32_t *pinned = sbf_asset_allocate(asset, cube.positions.count, sizeof *pinned), count = 0;
  for (uint32_t i = 0; i < cube.positions.count; i++) {
    const float corner[3] = {at[i].x, at[i].y, at[i].z};
    for (int k = 0; k < 3; k++)
      if (order[k] == 0 && corner[k] < 1e-4f) pinned[count++] = i;
    at[i] = (sbf_vec3){corner[0] * sides[order[0]], corner[1] * sides[order[1]], corner[2] * sides[order[2]]};
  }
  sbf_soft_body *body = shape_add_body(asset, "plate", &cube, false);
  body->attributes.young_modulus = 1e8f;
  sbf_pin_set *pins = sbf_asset_allocate(asset, 1, sizeof *pins);
  sbf_pin_set_init(pins);
  pins->points = (sbf_u32_list){pinned, count};
  body->pins = (sbf_pin_set_list){pins, 1};
  return body;
}

/* A lattice that does not yield at all has the reference's own displacement as error: the maximum over all
 * loads, for any order of the loads. */
START_TEST(the_error_is_the_greatest_over_all_loads)
{
  static const int orders[3][3] = {{2, 0, 1}, {0, 2, 1}, {0, 1, 2}};
  sbf_soft_body *body = add_plate(orders[_i]);
  sbfi_reference r;
  sbfi_calibration c;
  ck_assert_int_eq(sbfi_reference_make(&r, body, 1500, false, asset,
                       &(sbfi_reference_use){.gravity_displacements = true}, NULL),
      0);
  double max = 0;
  uint32_t load = 0;
  for (uint32_t l = 0; l < r.statics.load_count; l++) {
    ck_assert_ptr_nonnull(r.gravity_displacements[l]);
    for (uint32_t i = 0; i < body->surface.positions.count; i++) {
      const double *d = r.gravity_displacements[l] + 3 * (size_t)i;
      double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      if (length > max) max = length, load = l;
    }
  }
  ck_assert_uint_eq(load, (uint32_t)_i); /* each is the decisive one in turn */
  sbf_level level;
  ck_assert(sbfi_jiggle_level_make(&level, body, 1, SBF_NONE, asset));
  ck_assert(
      sbfi_level_calibrate(&level, body, NULL, &r, false, 1.0 / 60, asset, &c, (sbfi_progress){0}, NULL));
  ck_assert_double_eq_tol(c.error, max, 1e-9);
  ck_assert_float_eq_tol(level.simulation.error, (float)max, 1e-6f);
  sbfi_reference_free(&r);
}
END_TEST

/* A level is fitted to a reference of another modulus by one factor for all, unless that is below 1/16. */
START_TEST(one_factor_for_all_has_bounds)
{
  static const struct {
    float times;
    bool fitted;
  } cases[] = {{3, true}, {3.9f, true}, {4.3f, true}, {20, true}, {1.0f / 14, true}, {1.0f / 18, false}};
  sbf_soft_body *body = add_beam(true);
  sbf_level level;
  sbfi_reference r;
  sbfi_calibration c;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    sbf_level fine;
    grid_level(&fine, 2);
    grid_level(&level, 2);
    body->attributes.young_modulus = 1e6f * cases[i].times;
    ck_assert_int_eq(
        sbfi_reference_from_level(&r, body, &fine, NULL, asset, &(sbfi_reference_use){0}, NULL), 0);
    body->attributes.young_modulus = 1e6f;
    ck_assert(
        sbfi_level_calibrate(&level, body, NULL, &r, false, 1.0 / 60, asset, &c, (sbfi_progress){0}, NULL));
    double wanted = cases[i].fitted ? (double)cases[i].times : 1;
    ck_assert_double_eq_tol(c.factor, wanted, 0.01 * wanted);
    ck_assert_double_eq_tol(
        c.residual, cases[i].fitted ? 0 : fabs((double)cases[i].times - 1), 0.02 * cases[i].times);
    sbfi_reference_free(&r);
  }
}
END_TEST

/* Softens the `last` elements of a level. */
static void soften(sbf_level *level, uint32_t last, float factor) {
  uint32_t count = level->lattice.tetrahedra.count;
  float *moduli = sbf_asset_allocate(asset, count, sizeof *moduli);
  for (uint32_t t = 0; t < count; t++) moduli[t] = 1e6f * (t + last < count ? 1 : factor);
  level->lattice.young_modulus = (sbf_f32_list){moduli, count};
}

/* A small part of the level that is weakly connected does not determine the common factor. */
START_TEST(a_crumb_does_not_set_the_factor)
{
  sbf_soft_body *body = add_beam(true);
  sbf_level fine, level;
  sbfi_reference r;
  sbfi_calibration c;
  body->attributes.young_modulus = 1e6f;
  grid_level(&fine, 2);
  grid_level(&level, 2);
  soften(&level, 6, 1e-6f);
  ck_assert_int_eq(
      sbfi_reference_from_level(&r, body, &fine, NULL, asset, &(sbfi_reference_use){0}, NULL), 0);
  ck_assert(
      sbfi_level_calibrate(&level, body, NULL, &r, false, 1.0 / 60, asset, &c, (sbfi_progress){0}, NULL));
  ck_assert_double_gt(c.residual, 50);
  ck_assert_double_eq_tol(c.factor, 1, 0.02); /* by the mean over the surface it is 5.3 */
  sbfi_reference_free(&r);
}
END_TEST

/* No element's modulus is more than doubled, for any stiffness of the same part of the reference. */
START_TEST(moduli_are_doubled_or_less)
{
  sbf_soft_body *body = add_beam(true);
  sbf_level fine, level;
  sbfi_reference r;
  sbfi_calibration c;
  grid_level(&fine, 4);
  grid_level(&level, 2);
  body->attributes.young_modulus = 1e6f;
  soften(&fine, 30 * 4 * 4 * 4 / 2, 20); /* the outer half is stiffer: along x, as elements are listed */
  ck_assert_int_eq(sbfi_reference_from_level(&r, body, &fine, NULL, asset,
                       &(sbfi_reference_use){.twists = true, .pushes = true}, NULL),
      0);
  ck_assert(
      sbfi_level_calibrate(&level, body, NULL, &r, false, 1.0 / 60, asset, &c, (sbfi_progress){0}, NULL));
  ck_assert_double_lt(c.max, 2.2);
  ck_assert_double_gt(c.max, 1.7);
  sbfi_reference_free(&r);
}
END_TEST

/* Springs that are made stiffer or softer are damped as much more or less. */
START_TEST(damping_of_springs_scales_with_their_stiffness)
{
  static float dampings[1000];
  sbf_soft_body *body = add_beam(true);
  sbf_weight_map map;
  sbf_weight_map_init(&map);
  map.property = SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING;
  for (uint32_t i = 0; i < body->surface.positions.count; i++)
    dampings[i] = 1 + body->surface.positions.at[i].x;
  map.values = (sbf_f32_list){dampings, body->surface.positions.count};
  body->weight_maps = (sbf_weight_map_list){&map, 1};
  body->attributes.stiffness_damping = 0.002f;
  sbf_asset *built[2];
  sbf_diagnostic error;
  for (int fitted = 0; fitted < 2; fitted++) {
    sbf_build_options options = {
        .interior = SBF_BUILD_INTERIOR_CENTROID, .levels = 2, .without_calibration = !fitted};
    ck_assert_msg(sbf_build(asset, &options, &built[fitted], NULL, &error) == SBF_OK, "%s", error.message);
  }
  const sbf_spring_set_list *before = &built[0]->soft_bodies.at[0].levels.at[0].springs,
                            *after = &built[1]->soft_bodies.at[0].levels.at[0].springs;
  uint32_t changed = 0;
  ck_assert_uint_eq(before->count, after->count);
  for (uint32_t s = 0; s < before->count; s++) {
    const sbf_spring_set *a = &before->at[s], *b = &after->at[s];
    ck_assert_uint_eq(a->damping.count, a->ends.count);
    ck_assert_uint_eq(b->damping.count, a->ends.count);
    for (uint32_t i = 0; i < a->ends.count; i++) {
      float of_a = a->damping.at[i] / a->stiffness.at[i], of_b = b->damping.at[i] / b->stiffness.at[i];
      ck_assert_float_eq_tol(of_a, of_b, 1e-4f * of_a);
      changed += fabsf(b->stiffness.at[i] / a->stiffness.at[i] - 1) > 0.05f;
    }
  }
  ck_assert_uint_gt(changed, 10);
  sbf_asset_free(built[0]);
  sbf_asset_free(built[1]);
}
END_TEST

static bool stop(void *user, const char *pass, double done) {
  (void)pass;
  *(int *)user += 1;
  return done < 0.3;
}

/* Eight corners cannot represent how a cube bends. */
START_TEST(a_surface_of_few_points_is_enough)
{
  sbf_polygon_mesh cube = shape_cube(asset, 1, 1, (sbf_vec3){0, 0, 0});
  shape_add_body(asset, "cube", &cube, false);
  sbf_build_options options = {.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = 200};
  sbf_build_report report;
  sbf_asset *built;
  sbf_diagnostic error;
  ck_assert_int_eq(sbf_build(asset, &options, &built, &report, &error), SBF_OK);
  ck_assert_uint_eq(report.lattice_calibration.count, 1);
  ck_assert_double_gt(report.lattice_calibration.min_factor, 0.8);
  ck_assert_double_lt(report.lattice_calibration.max_factor, 1.3);
  ck_assert_double_lt(report.lattice_calibration.max_residual, 0.1);
  ck_assert_double_lt(report.lattice_calibration.max_period_error, 0.05);
  /* Its twist shows as a low frequency of that mode. */
  const sbf_f32_list *twists = &built->soft_bodies.at[0].levels.at[0].calibration->twist_errors;
  ck_assert_uint_eq(twists->count, SBFI_TWISTS);
  for (uint32_t k = 0; k < SBFI_TWISTS; k++) ck_assert_float_lt(fabsf(twists->at[k]), 0.3f);
  sbf_asset_free(built);
}
END_TEST

START_TEST(it_can_be_cancelled)
{
  sbf_asset *built;
  sbf_diagnostic error;
  int calls = 0;
  add_beam(true);
  sbf_build_options options = {
      .interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .cell_m = 0.1, .progress = stop, .user = &calls};
  ck_assert_int_ne(sbf_build(asset, &options, &built, NULL, &error), SBF_OK);
  ck_assert_int_eq(error.code, SBF_CODE_CANCELLED);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("calibrate");
  TCase *c = tcase_create("calibrate");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_loop_test(c, a_beam_of_240_bends_as_one_of_15360, 0, HARNESS_FEW(1, 0));
  tcase_add_loop_test(c, an_arm_of_the_armadillo, 0, HARNESS_FEW(1, 0));
  tcase_add_test(c, coarse_levels_are_calibrated);
  tcase_add_test(c, the_coarsest_sufficient_level_is_chosen);
  tcase_add_test(c, levels_go_from_lattices_to_jiggle);
  tcase_add_test(c, a_free_body_is_calibrated_too);
  tcase_add_test(c, a_surface_of_few_points_is_enough);
  tcase_add_test(c, standing_bodies_keep_the_stiffness_that_their_weight_needs);
  tcase_add_test(c, it_can_be_cancelled);
  suite_add_tcase(s, c);
  TCase *bounds = tcase_create("bounds");
  tcase_add_checked_fixture(bounds, setup, teardown);
  tcase_add_loop_test(bounds, the_error_is_the_greatest_over_all_loads, 0, HARNESS_FEW(3, 1));
  tcase_add_test(bounds, one_factor_for_all_has_bounds);
  tcase_add_test(bounds, a_crumb_does_not_set_the_factor);
  tcase_add_test(bounds, moduli_are_doubled_or_less);
  tcase_add_test(bounds, damping_of_springs_scales_with_their_stiffness);
  suite_add_tcase(s, bounds);
  return s;
}

int main(void) {
  return harness_run(suite());
}
