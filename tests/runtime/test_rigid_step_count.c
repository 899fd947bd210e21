/* Number of steps in a tick of rigid parts, and its effect on accuracy. */
#include <math.h>

#include "coupling/ragdoll/ragdoll.h"
#include "harness.h"
#include "rigid_person.h"

static const sbf_vec3 SHOVES[2] = {{25, 0, 60}, {-10, 30, 120}};
/* Steps per tick above which flight takes only one. */
enum { FINE = 64, TICKS = 60 };

/* High above the ground. */
static scene thrown(sbf_vec3 shove, uint32_t steps) {
  scene s = whole_person();
  s.character_definition.position.y = 100;
  s.model_options.rigid_substeps = steps;
  scene_start(&s);
  person_shove(&s, 1, shove);
  return s;
}

static uint32_t steps_of(const scene *s) {
  return sbri_rigid_drive(&s->world->characters[0])->substeps;
}

static double separation(const scene *a, const scene *b, uint32_t body) {
  sbf_vec3 x = rigid_state(a, body).center, y = rigid_state(b, body).center;
  sbr_double3 from = sbr_character_get_origin(a->world, a->character),
              of = sbr_character_get_origin(b->world, b->character);
  double d[3] = {from.x + (double)x.x - of.x - (double)y.x, from.y + (double)x.y - of.y - (double)y.y,
      from.z + (double)x.z - of.z - (double)y.z};
  return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

/* A person of 20 parts tumbles through the air in one step in most ticks. Joints and limits are satisfied,
 * and no part is farther off than with twice as many steps. */
START_TEST(flight_takes_few_steps)
{
  scene s = thrown(SHOVES[_i], 0), fine = thrown(SHOVES[_i], FINE);
  static const uint32_t max[2] = {TICKS * 11 / 10, TICKS * 16 / 10};
  uint32_t steps = 0;
  float off = 0, beyond = 0;
  double worst = 0;
  for (int t = 0; t < TICKS; t++) {
    sbr_world_tick(s.world);
    sbr_world_tick(fine.world);
    if (t > 0) steps += steps_of(&s);
    for (uint32_t j = 0; j + 1 < ALL_PARTS; j++) {
      sbr_joint_state now = rigid_joint_state(&s, j);
      off = fmaxf(off, now.separation), beyond = fmaxf(beyond, now.angle_violation);
    }
    for (uint32_t b = 0; b < ALL_PARTS; b++) worst = fmax(worst, separation(&s, &fine, b));
  }
  ck_assert_uint_le(steps, max[_i]);
  ck_assert_float_le(off, 3e-5f);
  ck_assert_float_le(beyond, 0.00349f);
  ck_assert_double_le(worst, 0.04);
  scene_free(&s);
  scene_free(&fine);
}
END_TEST

/* An initial impulse passes through the joints within a step. It is no lasting force and needs no more steps
 * than the rotation afterwards. */
START_TEST(a_push_is_no_pull)
{
  scene s = thrown(SHOVES[_i], 0);
  sbr_world_tick(s.world);
  ck_assert_uint_le(steps_of(&s), 8);
  scene_free(&s);
}
END_TEST

/* After an impact, rotation and forces are large for a tick or two. Then the step count falls back to what is
 * needed. */
START_TEST(the_number_of_steps_returns_after_a_hit)
{
  scene s = whole_person();
  s.world_definition.sleep_after_s = 0;
  scene_start(&s);
  person_shove(&s, 1, (sbf_vec3){40, 0, _i ? -150 : 110});
  uint32_t steps = 0, max = 0;
  for (int t = 0; t < 2 * TICKS; t++) {
    sbr_world_tick(s.world);
    steps += steps_of(&s);
    max = steps_of(&s) > max ? steps_of(&s) : max;
  }
  ck_assert_uint_ge(max, 8);
  ck_assert_uint_le(steps, 2 * TICKS * 9 / 2);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rigid pace");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, flight_takes_few_steps, 0, 2);
  tcase_add_loop_test(tests, a_push_is_no_pull, 0, 2);
  tcase_add_loop_test(tests, the_number_of_steps_returns_after_a_hit, 0, 2);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
