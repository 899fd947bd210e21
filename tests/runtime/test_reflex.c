/* A person is hit, falls, gets up and stands. */
#include <math.h>

#include "harness.h"
#include "rigid_person.h"
#include "sbrun/events.h"

static float larger(float a, float b) {
  return a > b ? a : b;
}

static scene standing(void) {
  scene s = person();
  for (uint32_t b = 0; b < PARTS; b++) rigid_body(&s, b)->motion = SBF_BODY_MOTION_KINEMATIC;
  scene_start(&s);
  return s;
}

static void hit(const scene *s, sbf_vec3 impulse) {
  sbr_fall_definition fall = sbr_default_fall_definition();
  sbr_character_knock_over(s->world, s->character, &fall);
  person_shove(s, 1, impulse);
}

static float worst_limit(const scene *s) {
  float beyond = 0;
  for (uint32_t j = 0; j < PARTS - 1; j++) beyond = larger(beyond, rigid_joint_state(s, j).angle_violation);
  return beyond;
}

/* Maximum difference between a body's motion in this tick and in the one before, m. */
static float worst_jump(const scene *s, sbf_vec3 positions[PARTS], sbf_vec3 directions[PARTS]) {
  float max = 0;
  for (uint32_t b = 0; b < PARTS; b++) {
    sbf_vec3 now = rigid_state(s, b).center, was = positions[b];
    sbf_vec3 displacement = {now.x - was.x, now.y - was.y, now.z - was.z};
    sbf_vec3 d = {
        displacement.x - directions[b].x, displacement.y - directions[b].y, displacement.z - directions[b].z};
    max = larger(max, sqrtf(d.x * d.x + d.y * d.y + d.z * d.z));
    positions[b] = now, directions[b] = displacement;
  }
  return max;
}

/* The landings in the last tick, and the position of the last one. */
static uint32_t landings(const scene *s, sbr_double3 *position) {
  sbr_foot_events events = sbr_world_get_foot_events(s->world);
  if (events.landed_count) *position = events.landed[events.landed_count - 1].position;
  return events.landed_count;
}

/* The person falls within two seconds and is up again within eight. An event reports the landing and its
 * position. No joint exceeds its limit by a degree or separates. Nothing jumps while it gets up or
 * afterwards. Its pose is the one from before, at most a step away. */
START_TEST(hit_falls_and_gets_up)
{
  static const sbf_vec3 hits[4] = {{0, 0, 120}, {150, 0, -40}, {-80, 60, 0}, {0, 0, -150}};
  scene s = standing();
  scene_ticks(&s, 30);
  ck_assert_int_eq(sbr_character_get_posture(s.world, s.character), SBR_POSTURE_UPRIGHT);
  hit(&s, hits[_i]);
  float beyond = 0, separation = 0, lowest = 10, resting = 0;
  float jump = 0;
  sbf_vec3 positions[PARTS] = {{0}}, directions[PARTS] = {{0}};
  int down = 0, rising = 0, up = 0, landed = 0;
  sbr_double3 position = {NAN, 0, 0};
  for (int i = 1; i <= 480 && !up; i++) {
    sbr_world_tick(s.world);
    sbr_posture posture = sbr_character_get_posture(s.world, s.character);
    float head = rigid_state(&s, 2).center.y, off = worst_jump(&s, positions, directions);
    if (posture != SBR_POSTURE_FALLING) jump = larger(jump, off);
    lowest = head < lowest ? head : lowest;
    beyond = larger(beyond, worst_limit(&s));
    for (uint32_t j = 0; j < PARTS - 1; j++)
      separation = larger(separation, rigid_joint_state(&s, j).separation);
    if (head < 0.6f && !down) down = i;
    if (posture == SBR_POSTURE_RISING && !rising) rising = i, resting = worst_limit(&s);
    if (posture == SBR_POSTURE_UPRIGHT) up = i;
    uint32_t reported = landings(&s, &position);
    ck_assert_uint_eq(reported, rising == i);
    landed += (int)reported;
  }
  ck_assert(down > 0 && down <= 120);
  ck_assert_int_gt(rising, down);
  ck_assert_int_eq(landed, 1);
  ck_assert_int_gt(up, rising);
  ck_assert_float_le(beyond, 0.01745f);
  ck_assert_float_le(resting, 0.001745f);
  ck_assert_float_le(separation, 1e-3f);
  ck_assert_float_le(jump, 0.025f); /* the assistance of 40 m/s^2 makes 11 mm, drives and ground the rest */
  scene_ticks(&s, 30);
  sbf_vec3 chest = rigid_state(&s, 1).center;
  ck_assert_float_le(hypotf(chest.x - (float)position.x, chest.z - (float)position.z), 0.2f);
  ck_assert_float_eq_tol(rigid_state(&s, 2).center.y, 1.625f, 0.03f);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("reflex");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, hit_falls_and_gets_up, 0, 4);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
