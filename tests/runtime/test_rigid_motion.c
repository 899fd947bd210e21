#include "harness.h"
#include "random.h"
#include "soft/solvers/rigid_motion.h"

enum { POINTS = 16, REAL = 13 };

static float masses[POINTS], velocities[3 * POINTS];
static sbri_point positions[POINTS];
static sbri_island island;
static sbri_body body;

static float *velocity_of(uint32_t slot, int axis) {
  return &velocities[3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + (uint32_t)axis * SBRI_BLOCK + slot % SBRI_BLOCK];
}

/* Points that move as v + w x r, with some noise of their own. */
static void make(sbf_vec3 v, sbf_vec3 w, float noise) {
  uint32_t random = 3;
  for (uint32_t i = 0; i < POINTS; i++) {
    float n[6];
    for (int k = 0; k < 6; k++) { n[k] = (float)(int32_t)random_next(&random) / 2147483648.0f; }
    masses[i] = i < REAL ? 0.5f + 0.1f * (float)i : 0;
    positions[i] = (sbri_point){10 + n[0], 2 * n[1], -5 + 3 * n[2], 0};
    sbf_vec3 r = {positions[i].x, positions[i].y, positions[i].z}, turn = sbri_cross(w, r);
    *velocity_of(i, 0) = v.x + turn.x + noise * n[3];
    *velocity_of(i, 1) = v.y + turn.y + noise * n[4];
    *velocity_of(i, 2) = v.z + turn.z + noise * n[5];
  }
  island = (sbri_island){.masses = masses, .free_count = POINTS};
  body = (sbri_body){.slots = {.begin = 0, .real_end = REAL, .end = POINTS}};
}

static void momenta(double linear[3], double angular[3]) {
  for (int k = 0; k < 3; k++) linear[k] = angular[k] = 0;
  for (uint32_t i = 0; i < REAL; i++) {
    double m = masses[i], x = positions[i].x, y = positions[i].y, z = positions[i].z;
    double u = *velocity_of(i, 0), v = *velocity_of(i, 1), w = *velocity_of(i, 2);
    linear[0] += m * u, linear[1] += m * v, linear[2] += m * w;
    angular[0] += m * (y * w - z * v), angular[1] += m * (z * u - x * w), angular[2] += m * (x * v - y * u);
  }
}

START_TEST(a_rigid_motion_is_found)
{
  make((sbf_vec3){1, -2, 0.5f}, (sbf_vec3){0.3f, 2, -1}, 0);
  sbri_rigid_motion m = sbri_rigid_motion_find(&island, &body, positions, velocities);
  ck_assert_float_eq_tol(m.angular_velocity.x, 0.3f, 1e-4f);
  ck_assert_float_eq_tol(m.angular_velocity.y, 2, 1e-4f);
  ck_assert_float_eq_tol(m.angular_velocity.z, -1, 1e-4f);
  ck_assert_float_eq_tol(m.mass_kg, 13 * 0.5f + 0.1f * 78, 1e-4f);
}
END_TEST

START_TEST(damping_does_not_change_it)
{
  double before[2][3], after[2][3];
  make((sbf_vec3){1, -2, 0.5f}, (sbf_vec3){0.3f, 2, -1}, 0.5f);
  momenta(before[0], before[1]);
  sbri_rigid_motion first = sbri_rigid_motion_find(&island, &body, positions, velocities);
  for (int i = 0; i < 200; i++) sbri_rigid_motion_damp(&island, &body, positions, velocities, 0.9f, 0);
  momenta(after[0], after[1]);
  for (int k = 0; k < 3; k++) {
    ck_assert_double_eq_tol(after[0][k], before[0][k], 1e-3);
    ck_assert_double_eq_tol(after[1][k], before[1][k], 1e-2);
  }
  sbf_vec3 r = {
      positions[4].x - first.center.x, positions[4].y - first.center.y, positions[4].z - first.center.z};
  sbf_vec3 rigid = sbri_add(first.velocity, sbri_cross(first.angular_velocity, r));
  ck_assert_float_eq_tol(*velocity_of(4, 0), rigid.x, 1e-3f);
  ck_assert_float_eq_tol(*velocity_of(4, 1), rigid.y, 1e-3f);
}
END_TEST

START_TEST(points_on_a_line_have_no_angular_velocity_about_it)
{
  make((sbf_vec3){0, 0, 0}, (sbf_vec3){0, 0, 0}, 0.1f);
  for (uint32_t i = 0; i < POINTS; i++) positions[i] = (sbri_point){(float)i, 0, 0, 0};
  sbri_rigid_motion m = sbri_rigid_motion_find(&island, &body, positions, velocities);
  ck_assert_float_eq_tol(m.angular_velocity.x, 0, 1e-3f);
  for (uint32_t i = 0; i < POINTS; i++) positions[i] = (sbri_point){1, 2, 3, 0};
  m = sbri_rigid_motion_find(&island, &body, positions, velocities);
  ck_assert(m.angular_velocity.x == 0 && m.angular_velocity.y == 0 && m.angular_velocity.z == 0);
  body.slots.end = body.slots.real_end = 0;
  ck_assert_float_eq(sbri_rigid_motion_find(&island, &body, positions, velocities).mass_kg, 0);
}
END_TEST

/* Each point has its own damping rate: momentum and angular momentum stay, and the most damped point loses
 * the most. */
START_TEST(damping_rates_of_bodies_do_not_change_it)
{
  double before[2][3], after[2][3];
  float rates[POINTS];
  make((sbf_vec3){1, -2, 0.5f}, (sbf_vec3){0.3f, 2, -1}, 0.5f);
  for (int i = 0; i < POINTS; i++) rates[i] = i % 2 ? 8 : 0.5f;
  momenta(before[0], before[1]);
  for (int i = 0; i < 100; i++)
    sbri_rigid_motion_damp_each(&island, &body, positions, velocities, rates, 0.01f, 0);
  momenta(after[0], after[1]);
  for (int k = 0; k < 3; k++) {
    ck_assert_double_eq_tol(after[0][k], before[0][k], 2e-3);
    ck_assert_double_eq_tol(after[1][k], before[1][k], 2e-2);
  }
  sbri_rigid_motion m = sbri_rigid_motion_find(&island, &body, positions, velocities);
  float left[2] = {0, 0};
  for (uint32_t i = 0; i < REAL; i++) {
    sbf_vec3 r = sbri_sub((sbf_vec3){positions[i].x, positions[i].y, positions[i].z}, m.center);
    sbf_vec3 u = sbri_add(m.velocity, sbri_cross(m.angular_velocity, r));
    sbf_vec3 v = {*velocity_of(i, 0), *velocity_of(i, 1), *velocity_of(i, 2)};
    left[i % 2] += sbri_length(sbri_sub(v, u));
  }
  ck_assert_float_gt(left[0], 2 * left[1]);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("rigid motion");
  TCase *c = tcase_create("rigid motion");
  tcase_add_test(c, a_rigid_motion_is_found);
  tcase_add_test(c, damping_does_not_change_it);
  tcase_add_test(c, damping_rates_of_bodies_do_not_change_it);
  tcase_add_test(c, points_on_a_line_have_no_angular_velocity_about_it);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
