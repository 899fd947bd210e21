#include <math.h>

#include "harness.h"
#include "random.h"
#include "scene_state.h"
#include "scenes.h"
#include "soft/solvers/motion.h"

static const double pi = 3.14159265358979323846;
static const double tick = 1.0 / 60;

/* One mass on a spring along x, held by the world at 0. */
static scene oscillator(float mass, float stiffness, float length) {
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0, 0, 0}, {length, 0, 0}};
  const float masses[] = {0, mass};
  const uint32_t pinned = 0;
  sbf_level *level = scene_points(&s, 0, positions, masses, 2);
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &stiffness, 1);
  scene_pin(&s, level, -1, &pinned, 1);
  s.world_definition.has_gravity = true;
  return s;
}

/* Mean time between upward crossings of `level` by the point's `axis`. */
static double period(scene *s, int axis, float level, uint32_t ticks) {
  double first = -1, last = -1, before = 0;
  int crossings = 0;
  for (uint32_t i = 0; i <= ticks; i++) {
    sbf_vec3 p = scene_point(s, 0, 1);
    double value = (axis == 0 ? p.x : axis == 1 ? p.y : p.z) - level;
    if (i > 0 && before < 0 && value >= 0) {
      double time = (i - 1 + before / (before - value)) * tick;
      if (first < 0)
        first = time;
      else
        crossings++;
      last = time;
    }
    before = value;
    scene_ticks(s, 1);
  }
  ck_assert_int_gt(crossings, 3);
  return (last - first) / crossings;
}

START_TEST(a_spring_swings_with_its_period)
{
  scene s = oscillator(2, 50, 1);
  s.world_definition.gravity = (sbf_vec3){0.5f, 0, 0}; /* swings about 0.02 m beyond its rest length */
  s.model_options.substeps = 8;
  scene_start(&s);
  double exact = 2 * pi * sqrt(2.0 / 50), measured = period(&s, 0, 1.02f, 1200);
  ck_assert_double_eq_tol(measured, exact, 2e-4 * exact);
  scene_free(&s);
}
END_TEST

START_TEST(a_scaled_spring_swings_slower_by_the_root)
{
  scene s = oscillator(2, 50, 1);
  s.world_definition.gravity = (sbf_vec3){0.5f, 0, 0};
  s.model_options.substeps = 8;
  s.character_definition.scale = 4;
  scene_start(&s);
  /* Lengths grow with the scale, the stretch under the same weight as well. */
  double exact = 2 * 2 * pi * sqrt(2.0 / 50), measured = period(&s, 0, 4 * 1.02f, 1200);
  ck_assert_double_eq_tol(measured, exact, 2e-4 * exact);
  scene_free(&s);
}
END_TEST

START_TEST(energy_does_not_drift)
{
  scene s = oscillator(2, 50, 1);
  s.world_definition.gravity = (sbf_vec3){3, -2, 1};
  s.model_options.substeps = 4;
  scene_start(&s);
  double sums[2] = {0, 0};
  for (int half = 0; half < 2; half++)
    for (int i = 0; i < 6000; i++) {
      scene_ticks(&s, 1);
      sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
      sums[half] += h.kinetic_j + h.elastic_j + h.potential_j;
    }
  sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(h.finite);
  double swing = 2.0 * 3.74 * 3.74 / 50; /* about the work of the weight over the stretch */
  ck_assert_double_eq_tol(sums[1] / 6000, sums[0] / 6000, 0.01 * swing);
  scene_free(&s);
}
END_TEST

START_TEST(a_free_body_falls_as_it_should)
{
  scene s = scene_begin();
  scene_body(&s, 0)->attributes.damping_ratio = 0.5f;
  const sbf_vec3 positions[] = {{0, 0, 0}, {0.2f, 0, 0}, {0, 0.2f, 0}, {0, 0, 0.2f}};
  const float masses[] = {1, 2, 1, 1}, stiffness[] = {400, 400, 400, 400, 400, 400};
  const sbf_uint2 ends[] = {{{0, 1}}, {{0, 2}}, {{0, 3}}, {{1, 2}}, {{1, 3}}, {{2, 3}}};
  sbf_level *level = scene_points(&s, 0, positions, masses, 4);
  scene_springs(&s, level, ends, stiffness, 6);
  s.model_options.substeps = 4;
  scene_start(&s);
  scene_ticks(&s, 60);
  double h = tick / 4, n = 240;
  sbf_vec3 p = scene_point(&s, 0, 0);
  ck_assert_double_eq_tol(p.y, -9.81 * h * h * n * (n + 1) / 2, 2e-4);
  ck_assert_double_eq_tol(p.x, 0, 1e-5);
  scene_free(&s);
}
END_TEST

static sbf_vec3 center_of_mass(scene *s) {
  sbf_vec3 at[8];
  double sum[3] = {0, 0, 0}, mass = 0;
  const float *masses = scene_body(s, 0)->levels.at[0].masses.at;
  ck_assert_uint_eq(scene_read(s, 0, at, 8), 8);
  for (int i = 0; i < 8; i++) {
    sum[0] += masses[i] * at[i].x, sum[1] += masses[i] * at[i].y, sum[2] += masses[i] * at[i].z;
    mass += masses[i];
  }
  return (sbf_vec3){(float)(sum[0] / mass), (float)(sum[1] / mass), (float)(sum[2] / mass)};
}

START_TEST(momentum_is_conserved)
{
  scene s = scene_begin();
  scene_body(&s, 0)->attributes.damping_ratio = 0.2f;
  scene_body(&s, 0)->attributes.stiffness_damping = 1e-3f;
  scene_net_of_eight(&s, 0.4f, 0.05f); /* far from rest */
  scene_start(&s);
  sbf_vec3 before = center_of_mass(&s);
  scene_ticks(&s, 1000);
  sbf_vec3 after = center_of_mass(&s);
  ck_assert_float_eq_tol(after.x, before.x, 1e-4f);
  ck_assert_float_eq_tol(after.y, before.y, 1e-4f);
  ck_assert_float_eq_tol(after.z, before.z, 1e-4f);
  scene_free(&s);
}
END_TEST

/* Small swings of a mass on a stiff spring: a pendulum of the spring's stretched length. */
START_TEST(a_pendulum_keeps_its_period)
{
  scene s = oscillator(1, 20000, 1);
  s.world_definition.gravity = (sbf_vec3){0.6f, -9.81f, 0};
  scene_start(&s);
  /* Weight slants by 3.5 degrees; it hangs out of its way by 86.5 and swings far: T/T0 of agm for that. */
  double g = sqrt(0.36 + 9.81 * 9.81), amplitude = atan2(9.81, 0.6);
  double a = 1, b = cos(amplitude / 2);
  for (int i = 0; i < 20; i++) {
    double middle = 0.5 * (a + b);
    b = sqrt(a * b), a = middle;
  }
  double exact = 2 * pi * sqrt(1 / g) / a, measured = period(&s, 0, 0.061f, 1800);
  ck_assert_double_eq_tol(measured, exact, 0.01 * exact);
  scene_free(&s);
}
END_TEST

/* Ten links that hang: each stretches by the weight below it, u = (m g / k) n (n + 1) / 2 all together. */
START_TEST(a_hanging_chain_stretches_by_its_weight)
{
  enum { LINKS = 10 };
  scene s = scene_begin();
  scene_body(&s, 0)->attributes.damping_ratio = 1;
  const uint32_t pinned = 0;
  scene_pin(&s, scene_chain(&s, 0, (sbf_vec3){0, -0.1f, 0}, LINKS, 400, 0.2f, 0.2f), -1, &pinned, 1);
  scene_start(&s);
  scene_ticks(&s, 600);
  double stretch = 0.2 * 9.81 / 400 * LINKS * (LINKS + 1) / 2;
  ck_assert_double_eq_tol(scene_point(&s, 0, LINKS).y, -0.1 * LINKS - stretch, 1e-4);
  scene_free(&s);
}
END_TEST

/* The same chain released from level: it gains no energy, and its links stay connected. */
START_TEST(a_pendulum_chain_swings_without_gain)
{
  enum { LINKS = 10 };
  scene s = scene_begin();
  const uint32_t pinned = 0;
  scene_pin(&s, scene_chain(&s, 0, (sbf_vec3){0.1f, 0, 0}, LINKS, 20000, 0.2f, 0.2f), -1, &pinned, 1);
  s.model_options.substeps = 20;
  scene_start(&s);
  double depth = 0.2 * 9.81 * 0.1 * LINKS * (LINKS + 1) / 2; /* J from level to hanging */
  double lowest = 0;
  sbr_body_health begin = sbr_character_get_body_health(s.world, s.character, 0);
  for (int i = 0; i < 600; i++) {
    scene_ticks(&s, 1);
    sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
    double gained = h.kinetic_j + h.elastic_j + h.potential_j - begin.potential_j;
    ck_assert_double_lt(fabs(gained), 0.1 * depth);
    ck_assert_float_lt(h.max_strain, 0.3f); /* as its end cracks */
    lowest = fmin(lowest, scene_point(&s, 0, LINKS).y);
  }
  ck_assert_double_lt(lowest, -0.8);
  scene_free(&s);
}
END_TEST

START_TEST(damping_follows_its_ratio)
{
  scene s = oscillator(2, 50, 1);
  scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
  s.world_definition.gravity = (sbf_vec3){0.5f, 0, 0};
  s.model_options.substeps = 16;
  scene_start(&s);
  double w = 5, decay = exp(-0.1 * w * 2), low = 9, high = -9;
  for (int i = 0; i < 120 + 76; i++) {
    scene_ticks(&s, 1);
    double off = scene_point(&s, 0, 1).x - 1.02;
    if (i >= 120) low = fmin(low, off), high = fmax(high, off);
  }
  /* After 2 s, over one period: extremes of 0.02 exp(-z w t). */
  ck_assert_double_gt(high, 0.02 * decay * 0.5);
  ck_assert_double_lt(high, 0.02 * decay);
  ck_assert_double_gt(low, -0.02 * decay);
  scene_free(&s);
}
END_TEST

START_TEST(springs_damp_their_rate_of_stretch)
{
  scene s = oscillator(2, 50, 1);
  scene_body(&s, 0)->attributes.stiffness_damping = 0.04f; /* ratio beta w / 2 = 0.1 */
  s.world_definition.gravity = (sbf_vec3){0.5f, 0, 0};
  s.model_options.substeps = 64;
  scene_start(&s);
  double w = 5, wd = w * sqrt(0.99), t = 1.5;
  scene_ticks(&s, 90);
  double off = -0.02 * exp(-0.1 * w * t) * (cos(wd * t) + 0.1 / sqrt(0.99) * sin(wd * t));
  ck_assert_double_eq_tol(scene_point(&s, 0, 1).x - 1.02, off, 2e-4);
  scene_free(&s);
}
END_TEST

/* Its damping is put off to each fourth substep in flight, which must not swing what it should calm: bars
 * whose modes lie anywhere between the stable ones. */
START_TEST(a_damped_body_in_free_flight_stays_at_rest)
{
  for (int i = 0; i < 8; i++) {
    scene s = scene_begin();
    lattice_box box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.25f, 0.25f}, 8, 2, 2, 1000,
        1e6f * (1 + 0.2f * (float)(i / 2)), i % 2 ? 0.3f : 0);
    scene_lattice(&s, 0, &box);
    lattice_box_free(&box);
    scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
    s.world_definition.has_gravity = true;
    s.world_definition.gravity = (sbf_vec3){0, 0, 0};
    scene_start(&s);
    scene_ticks(&s, 150);
    sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert_msg(h.kinetic_j + h.elastic_j < 1e-4, "bar %d: %g and %g J", i, h.kinetic_j, h.elastic_j);
    scene_free(&s);
  }
}
END_TEST

/* The bound on the speed is never below the exact speed: points that fly apart equally or almost equally.
 */
START_TEST(the_bound_on_impact_speed_is_respected)
{
  scene s = scene_begin();
  lattice_box box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 1, 1}, 2, 2, 2, 1000, 1e5f, 0.4f);
  uint32_t state = 7;
  scene_lattice(&s, 0, &box);
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  sbri_island_tick t = {
      .model = s.model, .island = island, .velocities = sbri_velocities(&s.world->characters[0])};
  for (int i = 0; i < 300; i++) {
    float fall = (float)(i % 3) * 5, apart = i % 5 ? 1 : 0;
    for (uint32_t slot = 0; slot < island->free_count; slot++)
      for (int k = 0; k < 3; k++)
        scene_velocity(&s, slot)[k * SBRI_BLOCK] = fall + apart * random_between(&state, -1, 1);
    ck_assert_float_ge(sbri_impact_speed_bound(&t), sbri_impact_speed(&t));
  }
  lattice_box_free(&box);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("symplectic");
  TCase *c = tcase_create("symplectic");
  tcase_add_test(c, a_spring_swings_with_its_period);
  tcase_add_test(c, a_scaled_spring_swings_slower_by_the_root);
  tcase_add_test(c, energy_does_not_drift);
  tcase_add_test(c, a_free_body_falls_as_it_should);
  tcase_add_test(c, momentum_is_conserved);
  tcase_add_test(c, a_pendulum_keeps_its_period);
  tcase_add_test(c, a_hanging_chain_stretches_by_its_weight);
  tcase_add_test(c, a_pendulum_chain_swings_without_gain);
  tcase_add_test(c, damping_follows_its_ratio);
  tcase_add_test(c, springs_damp_their_rate_of_stretch);
  tcase_add_test(c, a_damped_body_in_free_flight_stays_at_rest);
  tcase_add_test(c, the_bound_on_impact_speed_is_respected);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
