/* Crossed strips of cloth whose points are far from the other's triangles. */
#include <math.h>

#include "collision_scenes.h"
#include "harness.h"
#include "math/vec3.h"
#include "momentum.h"
#include "rigid_scenes.h"
#include "state/world.h"

/* A strip of 1 m by 4 cm in five squares' length, along x or along z, through `middle`. */
enum { ROWS = 6, POINTS = 2 * ROWS };

static sbf_level *strip(scene *s, uint32_t body, sbf_vec3 middle, bool along_z, bool pinned) {
  sbf_vec3 at[POINTS];
  float masses[POINTS], stiffness[6 * POINTS];
  sbf_uint2 ends[6 * POINTS];
  uint32_t count = 0;
  for (uint32_t i = 0; i < POINTS; i++) {
    float u = 0.2f * (float)(i / 2) - 0.5f, v = i % 2 ? 0.02f : -0.02f;
    at[i] = along_z ? (sbf_vec3){middle.x - v, middle.y, middle.z + u}
                    : (sbf_vec3){middle.x + u, middle.y, middle.z + v};
    masses[i] = 0.01f;
    const uint32_t steps[6] = {1, 2, 3, 1, 4, 6};
    for (int k = 0; k < 6; k++) {
      uint32_t to = i + steps[k];
      if (to >= POINTS || (k == 0 && i % 2) || (k == 2 && i % 2) || (k == 3 && !(i % 2))) continue;
      ends[count] = (sbf_uint2){{i, to}};
      stiffness[count++] = k < 2 ? 1000 : k < 4 ? 300 : 100;
    }
  }
  sbf_level *level = scene_points(s, body, at, masses, POINTS);
  scene_springs(s, level, ends, stiffness, count);
  const uint32_t rim[4] = {0, 1, POINTS - 2, POINTS - 1};
  if (pinned) scene_pin(s, level, -1, rim, 4);
  collision_surface(s, body, at, 2, ROWS);
  scene_body(s, body)->attributes.damping_ratio = 0.3f;
  scene_body(s, body)->attributes.friction = 1;
  return level;
}

/* The middle of a strip from end to end. */
static void find_middle_line(const scene *s, uint32_t body, sbf_vec3 line[ROWS]) {
  for (uint32_t r = 0; r < ROWS; r++)
    line[r] = sbri_lerp(scene_point(s, body, 2 * r), scene_point(s, body, 2 * r + 1), 0.5f);
}

/* Height of q over p where they cross, seen from above; INFINITY where they do not cross. A line extended
 * beyond its ends would give a wrong height. */
static float height_over(const sbf_vec3 p[2], const sbf_vec3 q[2]) {
  sbf_vec3 along = sbri_sub(p[1], p[0]), other = sbri_sub(q[1], q[0]), off = sbri_sub(q[0], p[0]);
  float whole = along.x * other.z - along.z * other.x;
  float t = (off.x * other.z - off.z * other.x) / whole, u = (off.x * along.z - off.z * along.x) / whole;
  if (!(t >= 0 && t <= 1 && u >= 0 && u <= 1)) return INFINITY;
  return sbri_lerp(q[0], q[1], u).y - sbri_lerp(p[0], p[1], t).y;
}

/* Minimum height of the second over the first, seen from above, over all pairs of squares. */
static float over(const scene *s) {
  sbf_vec3 p[ROWS], q[ROWS];
  find_middle_line(s, 0, p), find_middle_line(s, 1, q);
  float min = INFINITY;
  for (uint32_t i = 0; i + 1 < ROWS; i++)
    for (uint32_t k = 0; k + 1 < ROWS; k++) min = fminf(min, height_over(p + i, q + k));
  return min;
}

/* One falls across the other, which is held at its ends, from 10 cm and at up to 10 m/s, square to it or not
 * in its middle: it never passes. `contacts` off, it does at once. */
START_TEST(crossing_strips_do_not_pass)
{
  const float speeds[3] = {0, 2, 10};
  for (int contacts = 0; contacts < 2; contacts++) {
    scene s = rigid_begin();
    scene_bodies(&s, 2);
    (void)strip(&s, 0, (sbf_vec3){0, 0, 0}, false, true);
    (void)strip(&s, 1, (sbf_vec3){0.01f, 0.1f, 0.02f}, true, false);
    scene_start(&s);
    if (contacts) ck_assert(sbr_world_enable_body_contacts(s.world, 0, NULL) == SBF_OK);
    sbri_character *c = sbri_character_of(s.world, s.character);
    const sbri_body *body = &c->model->bodies[1];
    const sbri_island *island = &c->model->islands[body->island];
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
      (sbri_velocities(c) + 3 * (size_t)island->first_slot)[3 * (slot / SBRI_BLOCK * SBRI_BLOCK) +
                                                            SBRI_BLOCK + slot % SBRI_BLOCK] = -speeds[_i];
    collision_check_over(&s, over, contacts);
    scene_free(&s);
  }
}
END_TEST

/* In the air: momentum is conserved. */
START_TEST(momentum_is_conserved)
{
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  scene_bodies(&s, 2);
  (void)strip(&s, 0, (sbf_vec3){0, 0, 0}, false, false);
  (void)strip(&s, 1, (sbf_vec3){0.01f, 0.1f, 0.02f}, true, false);
  scene_start(&s);
  ck_assert(sbr_world_enable_body_contacts(s.world, 0, NULL) == SBF_OK);
  sbri_character *c = sbri_character_of(s.world, s.character);
  const sbri_body *body = &c->model->bodies[1];
  const sbri_island *island = &c->model->islands[body->island];
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
    (sbri_velocities(c) + 3 * (size_t)island->first_slot)[3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + SBRI_BLOCK +
                                                          slot % SBRI_BLOCK] = -3;
  sbf_vec3 before = scene_point(&s, 0, 5);
  scene_momentum was = scene_momentum_of(&s);
  scene_ticks(&s, 20);
  scene_momentum is = scene_momentum_of(&s);
  for (int k = 0; k < 3; k++) {
    ck_assert_double_eq_tol(was.linear[k], is.linear[k], 1e-4);
    ck_assert_double_eq_tol(was.angular[k], is.angular[k], 1e-4);
  }
  ck_assert_float_le(scene_point(&s, 0, 5).y, before.y - 0.05f);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("find_rims");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, crossing_strips_do_not_pass, 0, 3);
  tcase_add_test(tests, momentum_is_conserved);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
