#include "soft/solvers/rolling.h"

#include <math.h>

#include "harness.h"
#include "math/vec3.h"
#include "soft/solvers/rigid_motion.h"

enum { POINTS = 8 };
static const float tick_s = 1.0f / 60, gravity = 10, half_width = 0.1f, angular_velocity = 3;

static float masses[POINTS], velocities[3 * POINTS], planes[4 * POINTS];
static sbri_point positions[POINTS];
static uint8_t near_ground;
static sbri_island island;
static sbri_body body;
static sbf_soft_body source;

/* A box that stands on the ground with four corners, `half_width` to both sides of the middle, and turns
 * about z; `lifted` above the ground. */
static sbri_island_tick box(float fraction, float lifted) {
  sbf_soft_body_init(&source);
  for (uint32_t i = 0; i < POINTS; i++) {
    float x = i & 1 ? half_width : -half_width, y = i & 2 ? 0.4f : 0, z = i & 4 ? 0.3f : -0.3f;
    masses[i] = 0.5f;
    positions[i] = (sbri_point){x, y + lifted, z, 0};
    velocities[i] = 1 - angular_velocity * (y - 0.2f), velocities[POINTS + i] = angular_velocity * x,
    velocities[2 * POINTS + i] = 0;
    planes[i] = 0, planes[POINTS + i] = 1, planes[2 * POINTS + i] = 0, planes[3 * POINTS + i] = 0;
  }
  near_ground = 1;
  island = (sbri_island){.masses = masses, .free_count = POINTS, .slot_count = POINTS};
  body = (sbri_body){.source = &source,
      .slots = {.real_end = POINTS, .end = POINTS},
      .contact = {.rolling_fraction = fraction},
      .rest_size_m = 1};
  return (sbri_island_tick){.island = &island,
      .tick_s = tick_s,
      .environment = {.gravity = {0, -gravity, 0}},
      .positions = positions,
      .velocities = velocities,
      .contacts = {.planes = planes, .near_ground = &near_ground}};
}

static sbri_rigid_motion motion_after(sbri_island_tick tick) {
  sbri_rolling_apply_resistance(&tick, &body);
  return sbri_rigid_motion_find(&island, &body, positions, velocities);
}

START_TEST(the_rolling_radius_grows_with_the_damping)
{
  ck_assert_float_eq(sbri_rolling_fraction(0), 0);
  /* 1 - exp(-2 pi 0.2) is lost of the work. */
  ck_assert_float_eq_tol(sbri_rolling_fraction(0.2f), 0.7154f * 0.2122f, 1e-4f);
  ck_assert_float_gt(sbri_rolling_fraction(1), sbri_rolling_fraction(0.5f));
  ck_assert_float_lt(sbri_rolling_fraction(10), 0.2123f);
}
END_TEST

START_TEST(the_rolling_moment_is_that_of_the_weight_shifted_ahead)
{
  const float fraction = 0.1f;
  sbri_rigid_motion m = motion_after(box(fraction, 0));
  float inertia = POINTS * 0.5f * (half_width * half_width + 0.04f);
  float change = fraction * half_width * POINTS * 0.5f * gravity * tick_s / inertia;
  ck_assert_float_eq_tol(m.angular_velocity.z, angular_velocity - change, 1e-4f);
  ck_assert_float_eq_tol(m.angular_velocity.x, 0, 1e-5f);
  ck_assert_float_eq_tol(m.velocity.x, 1, 1e-5f); /* a moment alone */
}
END_TEST

START_TEST(rolling_resistance_only_stops_the_rotation)
{
  sbri_rigid_motion m = motion_after(box(100, 0));
  ck_assert_float_eq_tol(m.angular_velocity.z, 0, 1e-4f);
}
END_TEST

START_TEST(bodies_in_the_air_roll_on)
{ ck_assert_float_eq_tol(motion_after(box(0.1f, 0.01f)).angular_velocity.z, angular_velocity, 1e-4f); }
END_TEST

START_TEST(pinned_bodies_have_no_rolling_resistance)
{
  sbri_island_tick tick = box(0.1f, 0);
  body.is_pinned = true;
  ck_assert_float_eq_tol(motion_after(tick).angular_velocity.z, angular_velocity, 1e-4f);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("rolling");
  TCase *c = tcase_create("rolling");
  tcase_add_test(c, the_rolling_radius_grows_with_the_damping);
  tcase_add_test(c, the_rolling_moment_is_that_of_the_weight_shifted_ahead);
  tcase_add_test(c, rolling_resistance_only_stops_the_rotation);
  tcase_add_test(c, bodies_in_the_air_roll_on);
  tcase_add_test(c, pinned_bodies_have_no_rolling_resistance);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
