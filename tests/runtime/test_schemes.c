/* Every scheme against closed forms: one mass on a spring, a chain, a pendulum, a fall. Also tests the error
 * that each scheme predicts for a given step. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "scenes.h"
#include "state/state.h"
#include "state/world.h"

static const double pi = 3.14159265358979323846, tick = 1.0 / 60;

static const sbf_scheme schemes[] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED,
    SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_HEUN, SBF_SCHEME_BLOCK_DESCENT};
enum {
  SCHEME_COUNT = 5,
  SYMPLECTIC = 0,
  POSITION_BASED = 1,
  EXPLICIT_EULER = 2,
  HEUN = 3,
  BLOCK_DESCENT = 4
};

static const float MASS = 2, STIFFNESS = 50; /* w = 5 rad/s */

/* One mass on a spring of 1 m along x; a constant pull of 0.5 m/s^2 lets it swing by 0.02 m about 1.02 m. */
static scene oscillator(int scheme, uint32_t substeps) {
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}};
  const float masses[] = {0, MASS};
  const uint32_t pinned = 0;
  sbf_level *level = scene_points(&s, 0, positions, masses, 2);
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &STIFFNESS, 1);
  scene_pin(&s, level, -1, &pinned, 1);
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0.5f, 0, 0};
  s.model_options.scheme = schemes[scheme];
  s.model_options.substeps = substeps;
  return s;
}

static double off_at(scene *s) {
  return (double)scene_point(s, 0, 1).x - 1.02;
}

/* Complex growth of x'' = -w^2 x in a substep: `damping` is the ratio that the scheme adds, `slow` its
 * share of the period on top; see docs/solvers.md. */
typedef struct bias {
  double damping, slow;
} bias;

static bias bias_of(int scheme, double wh) {
  switch (scheme) {
  case SYMPLECTIC:
    return (bias){0, -wh * wh / 24};
  case POSITION_BASED:
  case BLOCK_DESCENT:
    return (bias){wh / 2, wh * wh / 3};
  case EXPLICIT_EULER:
    return (bias){-wh / 2, wh * wh / 3};
  default:
    return (bias){-wh * wh * wh / 8, -wh * wh / 6};
  }
}

START_TEST(a_spring_swings_and_fades_as_the_scheme_is_predicted_to)
{
  const uint32_t substeps = 4;
  double w = 5, wh = w * tick / substeps;
  bias expected = bias_of(_i, wh);
  scene s = oscillator(_i, substeps);
  scene_start(&s);
  double before = off_at(&s), begin = -1, end = -1;
  int crossings = 0, ticks = 600;
  double high = 0, first_high = 0, last_high = 0;
  for (int i = 1; i <= ticks; i++) {
    scene_ticks(&s, 1);
    double now = off_at(&s);
    high = fmax(high, now);
    if (before < 0 && now >= 0) {
      end = (i - 1 + before / (before - now)) * tick;
      if (begin < 0)
        begin = end;
      else
        crossings++;
    }
    if (before > 0 && now <= 0) { /* a half swing is over */
      if (!(first_high > 0)) first_high = high;
      last_high = high, high = 0;
    }
    before = now;
  }
  double period = (end - begin) / crossings, exact = 2 * pi / w;
  ck_assert_double_eq_tol(period, exact * (1 + expected.slow), 2e-4 * exact);
  double fade = log(first_high / last_high) / (2 * pi * crossings);
  ck_assert_double_eq_tol(fade, expected.damping, 3e-4 + 0.05 * fabs(expected.damping));
  scene_free(&s);
}
END_TEST

/* The error at one moment falls with the power of the step that the scheme's order is. */
START_TEST(errors_fall_with_the_order)
{
  static const double orders[SCHEME_COUNT] = {1, 1, 1, 2, 1};
  double errors[2];
  for (int k = 0; k < 2; k++) {
    scene s = oscillator(_i, 4u << k);
    scene_body(&s, 0)->attributes.stiffness_damping = 0.02f; /* 0.05 of critical */
    scene_start(&s);
    scene_ticks(&s, 50);
    double z = 0.05, w = 5, wd = w * sqrt(1 - z * z), t = 50 * tick;
    double exact = -0.02 * exp(-z * w * t) * (cos(wd * t) + z / sqrt(1 - z * z) * sin(wd * t));
    errors[k] = fabs(off_at(&s) - exact);
    scene_free(&s);
  }
  double order = log2(errors[0] / errors[1]);
  ck_assert_msg(fabs(order - orders[_i]) < 0.35, "order %g: %g %g", order, errors[0], errors[1]);
}
END_TEST

/* Undamped, explicit Euler gains energy in every substep. With damped springs it is stable while w h < 2 z
 * and unstable beyond. */
START_TEST(explicit_euler_fails_where_it_must)
{
  const struct {
    float ratio;
    uint32_t substeps;
    bool holds;
  } cases[] = {{0.3f, 6, true}, {0.1f, 1, true}, {0.03f, 1, false}, {0, 16, false}};
  for (int i = 0; i < 4; i++) {
    scene s = oscillator(EXPLICIT_EULER, cases[i].substeps);
    /* w h is 5 / 60 at one substep */
    scene_body(&s, 0)->attributes.stiffness_damping = 2 * cases[i].ratio / 5;
    scene_start(&s);
    double high[2] = {0, 0};
    for (int k = 0; k < 600; k++) {
      scene_ticks(&s, 1);
      double off = fabs(off_at(&s));
      high[k >= 300] = fmax(high[k >= 300], off);
    }
    ck_assert_msg((high[1] < high[0]) == cases[i].holds, "case %d: %g then %g", i, high[0], high[1]);
    scene_free(&s);
  }
}
END_TEST

START_TEST(heun_stays_within_its_error_tolerance)
{
  double errors[3];
  for (int k = 0; k < 3; k++) {
    scene s = oscillator(HEUN, 0);
    s.world_definition.gravity = (sbf_vec3){50, 0, 0}; /* swings by 2 m */
    s.model_options.step_error_m = k == 0 ? 1e-2f : k == 1 ? 1e-4f : 1e-6f;
    scene_start(&s);
    scene_ticks(&s, 75);
    errors[k] = fabs((double)scene_point(&s, 0, 1).x - (3 - 2 * cos(5 * 75 * tick)));
    scene_free(&s);
  }
  ck_assert_double_gt(errors[0], 4 * errors[1]);
  ck_assert_double_lt(errors[1], 1e-3);
  ck_assert_double_lt(errors[2], 3e-4);
}
END_TEST

/* The host's choice has precedence; the default is the one that sbrun.h names. */
START_TEST(heun_uses_the_error_tolerance_of_the_file)
{
  enum { cases = 5 };
  double errors[cases];
  const float of_file[cases] = {1e-2f, 1e-4f, 0, 1e-4f, 0}, of_host[cases] = {0, 0, 1e-2f, 1e-2f, 0};
  for (int k = 0; k < cases; k++) {
    scene s = oscillator(HEUN, 0);
    s.world_definition.gravity = (sbf_vec3){50, 0, 0};
    s.model_options.step_error_m = of_host[k];
    ((sbf_level *)scene_body(&s, 0)->levels.at)->simulation.step_error = of_file[k];
    scene_start(&s);
    scene_ticks(&s, 75);
    errors[k] = fabs((double)scene_point(&s, 0, 1).x - (3 - 2 * cos(5 * 75 * tick)));
    scene_free(&s);
  }
  ck_assert_double_gt(errors[0], 4 * errors[1]);
  ck_assert_double_eq(errors[2], errors[0]);
  ck_assert_double_eq(errors[3], errors[0]);
  ck_assert_double_eq(errors[4], errors[1]);
}
END_TEST

/* For any requested error, the result equals that of the chosen number of substeps, a power of two. */
START_TEST(heun_uses_the_step_bounds_of_the_file)
{
  const uint32_t min[] = {48, 0, 0, 0}, max[] = {0, 9, 0, 0}, of_host[] = {0, 0, 64, 8};
  const float error[] = {1, 1e-9f, 1e-3f, 1e-3f};
  float positions[4];
  for (int k = 0; k < 4; k++) {
    scene s = oscillator(HEUN, of_host[k]);
    sbf_simulation *simulation = &((sbf_level *)scene_body(&s, 0)->levels.at)->simulation;
    simulation->step_error = error[k];
    simulation->substeps_least = min[k], simulation->substeps_most = max[k];
    scene_start(&s);
    scene_ticks(&s, 45);
    positions[k] = scene_point(&s, 0, 1).x;
    scene_free(&s);
  }
  ck_assert_float_eq(positions[0], positions[2]);
  ck_assert_float_eq(positions[1], positions[3]);
  ck_assert_float_ne(positions[0], positions[1]);
}
END_TEST

/* Falls for a second; the same a kilometre away, and with 200 substeps. */
START_TEST(a_body_falls_as_at_the_origin)
{
  const struct {
    double x;
    uint32_t substeps;
  } cases[] = {{1, 8}, {1000, 8}, {1, 200}, {1000, 200}};
  for (int i = 0; i < 4; i++) {
    scene s = scene_begin();
    const sbf_vec3 positions[] = {{0, 0, 0}, {0.3f, 0, 0}, {0, 0.3f, 0}, {0, 0, 0.3f}};
    const float masses[] = {1, 2, 1, 1}, stiffness[] = {400, 400, 400, 400, 400, 400};
    const sbf_uint2 ends[] = {{{0, 1}}, {{0, 2}}, {{0, 3}}, {{1, 2}}, {{1, 3}}, {{2, 3}}};
    sbf_level *level = scene_points(&s, 0, positions, masses, 4);
    scene_springs(&s, level, ends, stiffness, 6);
    s.model_options.scheme = schemes[_i];
    s.model_options.substeps = cases[i].substeps;
    s.character_definition.position.x = cases[i].x;
    scene_start(&s);
    double begin = (double)scene_point(&s, 0, 0).y + sbr_character_get_origin(s.world, s.character).y;
    scene_ticks(&s, 60);
    /* Heun's steps are a power of two; the order of a fall is exact for it, and h g t / 2 for the others. */
    double h = tick / cases[i].substeps, g = 9.81;
    double late = _i == HEUN ? 0 : _i == EXPLICIT_EULER ? -h * g / 2 : h * g / 2;
    double fallen =
        begin - ((double)scene_point(&s, 0, 0).y + sbr_character_get_origin(s.world, s.character).y);
    ck_assert_double_eq_tol(fallen, g / 2 + late, 4e-4);
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert_float_lt(health.max_strain, 1e-4f);
    scene_free(&s);
  }
}
END_TEST

/* Sum over m of x and of x cross v, v from two ticks. */
static void moments(const sbf_vec3 *a, const sbf_vec3 *b, double linear[3], double angular[3]) {
  for (int k = 0; k < 3; k++) linear[k] = angular[k] = 0;
  for (int i = 0; i < 8; i++) {
    double m = 1 + 0.25 * i, x[3] = {(double)a[i].x, (double)a[i].y, (double)a[i].z};
    double d[3] = {(double)b[i].x - x[0], (double)b[i].y - x[1], (double)b[i].z - x[2]};
    for (int k = 0; k < 3; k++) {
      linear[k] += m * d[k];
      angular[k] += m * (x[(k + 1) % 3] * d[(k + 2) % 3] - x[(k + 2) % 3] * d[(k + 1) % 3]);
    }
  }
}

START_TEST(momentum_is_conserved)
{
  scene s = scene_begin();
  scene_net_of_eight(&s, 0.8f, 0.015f); /* off its rest */
  scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
  scene_body(&s, 0)->attributes.stiffness_damping = 2e-3f;
  s.model_options.scheme = schemes[_i];
  s.model_options.substeps = _i == EXPLICIT_EULER ? 64 : 8;
  scene_start(&s);
  for (int i = 0; i < 500; i++) {
    sbf_vec3 before[8], after[8];
    double linear[3], angular[3];
    ck_assert_uint_eq(scene_read(&s, 0, before, 8), 8);
    scene_ticks(&s, 1);
    ck_assert_uint_eq(scene_read(&s, 0, after, 8), 8);
    moments(before, after, linear, angular);
    for (int k = 0; k < 3; k++) { /* 16 kg, per tick: a drift of 1e-4 m/s is 2.7e-5 */
      ck_assert_double_lt(fabs(linear[k]), 3e-5);
      /* An implicit step keeps angular momentum to the second order only. */
      bool implicit = _i == POSITION_BASED || _i == BLOCK_DESCENT;
      ck_assert_double_lt(fabs(angular[k]), implicit ? 4e-3 : 6e-4);
    }
  }
  scene_free(&s);
}
END_TEST

/* Links hang from a point: each stretches by the weight below it. */
static scene chain(int scheme, uint32_t links, float stiffness, float mass, bool level_start) {
  scene s = scene_begin();
  const uint32_t pinned = 0;
  sbf_vec3 step = level_start ? (sbf_vec3){0.1f, 0, 0} : (sbf_vec3){0, -0.1f, 0};
  scene_pin(&s, scene_chain(&s, 0, step, links, stiffness, mass, mass), -1, &pinned, 1);
  s.model_options.scheme = schemes[scheme];
  return s;
}

START_TEST(a_hanging_chain_stretches_by_its_weight)
{
  enum { LINKS = 10 };
  scene s = chain(_i, LINKS, 400, 0.2f, false);
  scene_body(&s, 0)->attributes.damping_ratio = 1;
  if (_i == EXPLICIT_EULER) scene_body(&s, 0)->attributes.stiffness_damping = 0.01f;
  scene_start(&s);
  scene_ticks(&s, 900);
  double stretch = 0.2 * 9.81 / 400 * LINKS * (LINKS + 1) / 2;
  /* One sweep of position-based leaves springs softer by about (k/m) h^2, here 0.9 %. */
  double softer = _i == POSITION_BASED ? 400 / 0.2 * tick * tick / 64 : 0;
  ck_assert_double_eq_tol((double)scene_point(&s, 0, LINKS).y, -0.1 * LINKS - stretch * (1 + softer),
      2e-4 + 0.2 * softer * stretch);
  scene_free(&s);
}
END_TEST

/* The slowest mode of a chain fixed at one end: 2 sqrt(k/m) sin(pi / (2 (2 n + 1))). */
START_TEST(a_chain_has_its_lowest_frequency)
{
  enum { LINKS = 10 };
  scene s = chain(_i, LINKS, 400, 0.2f, false);
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, -0.5f, 0}; /* swings about its stretched shape */
  s.model_options.substeps = _i == HEUN ? 32 : _i == SYMPLECTIC ? 16 : 200;
  if (_i == EXPLICIT_EULER) scene_body(&s, 0)->attributes.stiffness_damping = 2e-3f;
  scene_start(&s);
  double w = 2 * sqrt(400 / 0.2) * sin(pi / (2.0 * (2 * LINKS + 1)));
  /* By the low mode, which holds nearly all of the motion: half a period to the lowest place. */
  double lowest = 0, when = 0, before = 0, two_before = 0;
  for (int i = 1; i < 60; i++) {
    scene_ticks(&s, 1);
    double y = (double)scene_point(&s, 0, LINKS).y;
    if (before < lowest && y > before && when == 0) {
      lowest = before;
      double bend = y - 2 * before + two_before;
      when = (i - 1 - 0.5 * (y - two_before) / bend) * tick;
      break;
    }
    two_before = before, before = y;
  }
  ck_assert_double_eq_tol(when, pi / w, 0.05 * pi / w);
  scene_free(&s);
}
END_TEST

/* Half a rope of `links` springs with equal masses between them, hung up at one height: from its middle to
 * its end under the horizontal pull H, each link by the direction and the size of its tension. */
static void half_rope(int links, double pull, double weight, double k, double length, double direction[2]) {
  direction[0] = direction[1] = 0;
  for (int i = 0; i < links / 2; i++) {
    double down = (i + 0.5) * weight, tension = hypot(pull, down), l = length + tension / k;
    direction[0] += l * pull / tension, direction[1] += l * down / tension;
  }
}

static double sag(int links, double weight, double k, double length) {
  double low = 1e-3, high = 1e4, direction[2] = {0, 0};
  for (int i = 0; i < 100; i++) {
    double middle = sqrt(low * high);
    half_rope(links, middle, weight, k, length, direction);
    *(direction[0] > 0.5 ? &high : &low) = middle;
  }
  return direction[1];
}

/* A rope between two points at one height. */
START_TEST(a_rope_hangs_as_a_catenary)
{
  enum { LINKS = 50 };
  scene s = scene_begin();
  sbf_vec3 positions[LINKS + 1];
  float masses[LINKS + 1], k[LINKS], *rest = sbf_asset_allocate(s.asset, LINKS, sizeof *rest);
  sbf_uint2 ends[LINKS];
  for (uint32_t i = 0; i <= LINKS; i++) {
    uint32_t far = i < LINKS - i ? i : LINKS - i; /* two straight halves of the rope's own length */
    positions[i] = (sbf_vec3){(float)i / LINKS, -0.375f * 2 / LINKS * (float)far, 0};
    masses[i] = 0.02f;
    if (i < LINKS) ends[i] = (sbf_uint2){{i, i + 1}}, k[i] = 50000, rest[i] = 1.25f / LINKS;
  }
  const uint32_t pinned[2] = {0, LINKS};
  sbf_level *level = scene_points(&s, 0, positions, masses, LINKS + 1);
  scene_springs(&s, level, ends, k, LINKS);
  ((sbf_spring_set *)(uintptr_t)level->springs.at)->rest_lengths = (sbf_f32_list){rest, LINKS};
  scene_pin(&s, level, -1, pinned, 2);
  scene_body(&s, 0)->attributes.mass_damping = 4;
  s.model_options.scheme = schemes[_i];
  if (_i == HEUN) scene_body(&s, 0)->attributes.stiffness_damping = 1e-4f;
  if (_i == POSITION_BASED) s.model_options.substeps = 60;
  scene_start(&s);
  scene_ticks(&s, 600);
  /* The closed form of a rope without links or stretch is 0.33180. */
  ck_assert_double_eq_tol(sag(LINKS, 0.02 * 9.81, 1e9, 0.025), 0.3318, 1e-4);
  double expected = sag(LINKS, 0.02 * 9.81, 50000, 0.025);
  ck_assert_double_eq_tol(
      (double)scene_point(&s, 0, LINKS / 2).y, -expected, _i == POSITION_BASED ? 1e-3 : 2e-4);
  scene_free(&s);
}
END_TEST

START_TEST(a_pendulum_keeps_its_period)
{
  scene s = oscillator(_i, _i == POSITION_BASED ? 100 : 32);
  ((sbf_spring_set *)(uintptr_t)s.asset->soft_bodies.at[0].levels.at[0].springs.at)->stiffness =
      (sbf_f32_list){&(const float){20000}, 1};
  if (_i == EXPLICIT_EULER) { /* which needs them damped, and many substeps */
    scene_body(&s, 0)->attributes.stiffness_damping = 2e-3f;
    s.model_options.substeps = 256;
  }
  s.world_definition.gravity = (sbf_vec3){0, -9.81f, 0};
  scene_start(&s);
  /* Released from level: 90 degrees. */
  double exact = 2 * pi * sqrt(1 / 9.81) * 1.1803406, before = 1, first = -1, last = -1;
  int crossings = 0;
  for (int i = 1; i < 600; i++) {
    scene_ticks(&s, 1);
    double x = (double)scene_point(&s, 0, 1).x;
    if (before > 0 && x <= 0) {
      last = (i - 1 + before / (before - x)) * tick;
      if (first < 0)
        first = last;
      else
        crossings++;
    }
    before = x;
  }
  ck_assert_int_ge(crossings, 2);
  /* The position-based scheme and the damped one lose amplitude, which shortens the period. */
  ck_assert_double_eq_tol((last - first) / crossings, exact, 0.03 * exact);
  scene_free(&s);
}
END_TEST

/* Two masses of one body, each on its own spring, factors 0.5 and 3 on a damping of 0.8 /s: the scheme's own
 * damping is equal for both. */
START_TEST(weight_maps_damp_point_by_point)
{
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}};
  const float masses[] = {0, MASS, MASS}, stiffness[] = {STIFFNESS, STIFFNESS};
  static const float factors[] = {1, 0.5f, 3};
  const uint32_t pinned = 0;
  sbf_level *level = scene_points(&s, 0, positions, masses, 3);
  scene_springs(&s, level, (const sbf_uint2[]){{{0, 1}}, {{0, 2}}}, stiffness, 2);
  scene_pin(&s, level, -1, &pinned, 1);
  sbf_weight_map *map = sbf_asset_allocate(s.asset, 1, sizeof *map);
  sbf_weight_map_init(map);
  map->property = SBF_WEIGHT_PROPERTY_MASS_DAMPING;
  map->values = (sbf_f32_list){factors, 3};
  scene_body(&s, 0)->weight_maps = (sbf_weight_map_list){map, 1};
  scene_body(&s, 0)->attributes.mass_damping = 0.8f;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  s.model_options.scheme = schemes[_i];
  s.model_options.substeps = 16;
  scene_start(&s);
  sbri_character *c = &s.world->characters[0];
  sbri_point *x = sbri_positions(c);
  const uint32_t *slots = s.model->bodies[0].slots.from_point;
  x[slots[1]].x *= 1.02f, x[slots[2]].x *= 1.02f, x[slots[2]].z *= 1.02f;
  double high[2] = {0, 0}, periods[2], rates[2] = {0.8 * 0.5, 0.8 * 3};
  for (int i = 0; i < 95; i++) {
    scene_ticks(&s, 1);
    for (uint32_t k = 0; i >= 56 && k < 2; k++) { /* the elongation after one period */
      const sbri_point *p = &x[slots[k + 1]];
      double length = sqrt((double)p->x * p->x + (double)p->z * p->z), rest = k ? sqrt(2) : 1;
      high[k] = fmax(high[k], (length - rest) / rest);
    }
  }
  for (int k = 0; k < 2; k++) periods[k] = 2 * pi / sqrt(25 - 0.25 * rates[k] * rates[k]);
  double expected = 0.5 * (rates[1] * periods[1] - rates[0] * periods[0]);
  ck_assert_double_eq_tol(log(high[0] / high[1]), expected, 0.02 * expected);
  scene_free(&s);
}
END_TEST

/* A pin of weight 0.5 is a spring of half its set's stiffness and zero length: m g / k below its target. */
START_TEST(a_goal_pulls_a_point_to_its_target)
{
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0.2f, 0, 0}, {0.5f, 0, 0}};
  const float masses[] = {1, 1}, stiffness = 1e-3f;
  static const float weight = 0.5f;
  const uint32_t pinned = 0;
  sbf_level *level = scene_points(&s, 0, positions, masses, 2);
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &stiffness, 1); /* next to nothing */
  scene_pin(&s, level, -1, &pinned, 1);
  sbf_pin_set *set = (sbf_pin_set *)(uintptr_t)level->pins.at;
  set->weights = (sbf_f32_list){&weight, 1};
  set->stiffness = 200, set->damping = 20;
  s.model_options.scheme = schemes[_i];
  if (_i == EXPLICIT_EULER) s.model_options.substeps = 64;
  scene_start(&s);
  scene_ticks(&s, 240);
  sbf_vec3 p = scene_point(&s, 0, 0);
  ck_assert_float_eq_tol(p.y, -9.81f / 100, 1e-3f);
  ck_assert_float_eq_tol(p.x, 0.2f, 1e-3f);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("schemes");
  TCase *c = tcase_create("schemes");
  tcase_add_loop_test(c, a_spring_swings_and_fades_as_the_scheme_is_predicted_to, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, errors_fall_with_the_order, 0, SCHEME_COUNT);
  tcase_add_test(c, explicit_euler_fails_where_it_must);
  tcase_add_test(c, heun_stays_within_its_error_tolerance);
  tcase_add_test(c, heun_uses_the_error_tolerance_of_the_file);
  tcase_add_test(c, heun_uses_the_step_bounds_of_the_file);
  tcase_add_loop_test(c, a_body_falls_as_at_the_origin, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, momentum_is_conserved, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, a_hanging_chain_stretches_by_its_weight, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, a_chain_has_its_lowest_frequency, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, a_rope_hangs_as_a_catenary, 0, EXPLICIT_EULER); /* explicit Euler is unstable here */
  tcase_add_loop_test(c, a_rope_hangs_as_a_catenary, EXPLICIT_EULER + 1, SCHEME_COUNT);
  tcase_add_loop_test(c, weight_maps_damp_point_by_point, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, a_goal_pulls_a_point_to_its_target, 0, SCHEME_COUNT);
  tcase_add_loop_test(c, a_pendulum_keeps_its_period, 0, SCHEME_COUNT);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
