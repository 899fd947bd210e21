/* Bodies of tetrahedra against closed forms, scheme by scheme. The statics of the energy itself are compared
 * with closed forms in tests/mechanics/test_static_solve.c. */
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "mechanics/vector.h"
#include "scenes.h"
#include "state/state.h"
#include "state/world.h"

static lattice_box box;
static scene s;
static const sbf_scheme schemes[] = {
    SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_HEUN, SBF_SCHEME_EXPLICIT_EULER};

static void begin(uint32_t along, float density, float young_pa, float poisson, bool pinned) {
  box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, along, along / 5, along / 5, density,
      young_pa, poisson);
  if (pinned) lattice_box_hold(&box);
  s = scene_begin();
  s.world_definition.has_gravity = true;
}
static void start(sbf_scheme scheme, uint32_t substeps, sbf_vec3 gravity) {
  scene_lattice(&s, 0, &box);
  s.world_definition.gravity = gravity;
  s.model_options.scheme = scheme, s.model_options.substeps = substeps;
  scene_start(&s);
}
static void end(void) {
  scene_free(&s);
  lattice_box_free(&box);
}

/* ---- Rest ---- */

START_TEST(stretch_under_its_own_weight)
{
  /* rho g L^2 / (2 E), hanging along x, nu = 0; second-order terms are half a per cent. */
  begin(10, 1000, 1e6f, 0, true);
  scene_body(&s, 0)->attributes.damping_ratio = 1;
  start(schemes[_i], _i == 1 ? 60 : 0, (sbf_vec3){9.81f, 0, 0});
  scene_ticks(&s, 180);
  float x = scene_point(&s, 0, lattice_box_point(&box, 10, 1, 1)).x;
  ck_assert_float_eq_tol(x - 1, 1000 * 9.81f / 2e6f, 0.01f * 4.9e-3f);
  end();
}
END_TEST

/* Tip of the beam under a load at its end, from two lattices: linear tetrahedra are too stiff, with an error
 * that falls by the square of the cell. */
static float loaded_tip(uint32_t along, float load_n) {
  const float end_kg = 100;
  begin(along, 100, 1e6f, 0.3f, true);
  uint32_t side = along / 5 + 1;
  for (uint32_t y = 0; y < side; y++)
    for (uint32_t z = 0; z < side; z++)
      box.masses[lattice_box_point(&box, along, y, z)] += end_kg / (float)(side * side);
  scene_body(&s, 0)->attributes.damping_ratio = 1;
  start(SBF_SCHEME_SYMPLECTIC, 0, (sbf_vec3){0, -load_n / end_kg, 0});
  scene_ticks(&s, 300);
  float sum = 0;
  for (uint32_t z = 0; z < side; z++) sum += scene_point(&s, 0, lattice_box_point(&box, along, 0, z)).y;
  end();
  return -sum / (float)side;
}

START_TEST(cantilever_with_a_load_at_its_tip)
{
  /* P L^2 / (E I) = 0.1 and 2, E I = 133 N m^2: the elastica's tip is 0.033295 and 0.493457 m down; shear
   * adds P L / (kappa A G) = 1.2 and 20.8 mm to the side, and the beam's own 4 kg are 1.5 % of the load. */
  static const float loads[] = {13.333f, 266.67f}, tips[] = {0.033295f, 0.493457f},
                     shear[] = {1.04e-3f, 0.0208f}, within[] = {0.085f, 0.1f};
  float coarse = loaded_tip(10, loads[_i]), fine = loaded_tip(20, loads[_i]);
  float exact = tips[_i] * 1.015f + shear[_i], extrapolated = fine + (fine - coarse) / 3;
  ck_assert_float_lt(coarse, fine);
  ck_assert_float_lt(fine, exact);
  ck_assert_msg(fabsf(extrapolated / exact - 1) < within[_i], "%f, %f: %f of %f", (double)coarse,
      (double)fine, (double)extrapolated, (double)exact);
}
END_TEST

/* ---- Motion ---- */

START_TEST(free_fall_keeps_the_shape_anywhere)
{
  /* At 1 m and at 1000 m from the origin, with 8 and 200 substeps: y = -g h^2 n (n + 1) / 2 of symplectic
   * steps, and nothing is strained. */
  static const struct {
    double away;
    uint32_t substeps;
  } cases[] = {{1, 8}, {1, 200}, {1000, 8}, {1000, 200}};
  for (uint32_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    begin(5, 1000, 1e5f, 0.4f, false);
    s.character_definition.position = (sbr_double3){cases[k].away, 1000, -cases[k].away};
    start(schemes[_i], cases[k].substeps, (sbf_vec3){0, -9.81f, 0});
    scene_ticks(&s, 30);
    sbr_double3 origin = sbr_character_get_origin(s.world, s.character);
    sbf_vec3 p = scene_point(&s, 0, 0);
    uint32_t n = schemes[_i] == SBF_SCHEME_HEUN && cases[k].substeps == 200 ? 256 : cases[k].substeps;
    double h = 1.0 / 60 / n, all = 30.0 * n, fallen = 0.5 * 9.81 * 0.25;
    if (_i < 2) fallen = 9.81 * h * h * all * (all + 1) / 2;
    ck_assert_double_eq_tol(origin.y + p.y - box.positions[0].y, -fallen, 2e-5);
    ck_assert_double_eq_tol(origin.x + p.x - box.positions[0].x, cases[k].away, 2e-6);
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert_float_lt(health.max_strain, 2e-5f);
    end();
  }
}
END_TEST

/* Positions of the points of a bent and released bar after a tenth of a second. */
static void swing(sbf_scheme scheme, uint32_t substeps, sbf_vec3 *positions) {
  begin(5, 1000, 1e5f, 0.3f, true);
  start(scheme, substeps, (sbf_vec3){0, 0, 0});
  sbri_character *c = &s.world->characters[0];
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++) {
    sbri_point *x = &sbri_positions(c)[i];
    x->y += 0.2f * x->x * x->x, x->z += 0.05f * x->x;
  }
  scene_ticks(&s, 6);
  ck_assert_uint_eq(scene_read(&s, 0, positions, 64), box.point_count);
  end();
}

START_TEST(errors_fall_with_the_order)
{
  /* 1 for all but Heun's method, which has 2. */
  static const double orders[] = {1, 1, 2, 1};
  static const uint32_t min[] = {16, 64, 16, 256};
  static sbf_vec3 exact[64], positions[64];
  double errors[2] = {0, 0};
  swing(SBF_SCHEME_HEUN, 512, exact);
  for (uint32_t n = 0; n < 2; n++) {
    swing(schemes[_i], min[_i] << n, positions);
    for (uint32_t i = 0; i < box.point_count; i++) {
      double off = sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(positions[i]), sbfi_d3_of(exact[i])));
      errors[n] = off > errors[n] ? off : errors[n];
    }
  }
  ck_assert_double_gt(errors[1], 1e-6);
  ck_assert_double_lt(errors[0], 0.05);
  double order = log2(errors[0] / errors[1]);
  ck_assert_msg(
      fabs(order - orders[_i]) < 0.25, "order %.2f, of errors %.2e, %.2e", order, errors[0], errors[1]);
}
END_TEST

START_TEST(energy_does_not_drift)
{
  /* 24,000 symplectic substeps: means over the first and the last sixth. */
  begin(5, 1000, 1e5f, 0.3f, true);
  start(SBF_SCHEME_SYMPLECTIC, 8, (sbf_vec3){0, 0, 0});
  sbri_character *c = &s.world->characters[0];
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++)
    sbri_positions(c)[i].y += 0.1f * sbri_positions(c)[i].x;
  double means[2] = {0, 0};
  for (int i = 0; i < 3000; i++) {
    sbr_body_health h = {0};
    if (i < 500 || i >= 2500) h = sbr_character_get_body_health(s.world, s.character, 0);
    means[i >= 2500] += (h.kinetic_j + h.elastic_j) / 500;
    scene_ticks(&s, 1);
  }
  ck_assert_double_gt(means[0], 1);
  ck_assert_double_eq_tol(means[1] / means[0], 1, 2e-3); /* over 42 s between them */
  end();
}
END_TEST

int main(void) {
  Suite *suite = suite_create("solid_cases");
  TCase *c = tcase_create("solid_cases");
  tcase_add_loop_test(c, stretch_under_its_own_weight, 0, 3);
  tcase_add_loop_test(c, cantilever_with_a_load_at_its_tip, 0, 2);
  tcase_add_loop_test(c, free_fall_keeps_the_shape_anywhere, 0, 3);
  tcase_add_loop_test(c, errors_fall_with_the_order, 0, 4);
  tcase_add_test(c, energy_does_not_drift);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
