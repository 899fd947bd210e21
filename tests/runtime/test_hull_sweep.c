/* Fast rigid bodies that would pass through each other within a tick. */
#include <math.h>

#include "collision_scenes.h"
#include "harness.h"
#include "math/quat.h"
#include "math/vec3.h"
#include "momentum.h"
#include "rigid_scenes.h"
#include "state/world.h"

/* A box of 5 cm, 0.2 kg, that stands `back` metres before a plate of 1 cm by a metre, and off its middle. */
static scene begin(sbf_vec3 at, float plate_kg) {
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  rigid_box(&s, at, (sbf_vec3){0.05f, 0.05f, 0.05f}, 0.2f);
  rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){1, 1, 0.01f}, plate_kg);
  scene_start(&s);
  ck_assert(sbr_world_enable_body_contacts(s.world, 0, NULL) == SBF_OK);
  return s;
}

static sbri_rigid_body_state *state(const scene *s, uint32_t body) {
  return &sbri_rigid_bodies(sbri_character_of(s->world, s->character))[body];
}

/* Where the box's middle is from the plate's, in the plate's own frame. */
static sbf_vec3 off_plate(const scene *s) {
  const sbri_rigid_body_state *box = state(s, 0), *plate = state(s, 1);
  return sbri_rotate(
      sbri_quat_conjugate(plate->pose.rotation), sbri_sub(box->pose.position, plate->pose.position));
}

/* Starts from ten distances, so that ticks end at different points of the path, straight or tilted so that it
 * is not over the plate when the tick begins. It stays on its side while it is over the plate, and the plate
 * receives the momentum that it loses. */
START_TEST(a_fast_box_does_not_pass_a_thin_plate)
{
  float back = 2 + 0.17f * (float)(_i % 10), aside = _i < 10 ? 0 : 0.4f * back;
  scene s = begin((sbf_vec3){0.1f - aside, 0.05f, -back}, 5);
  state(&s, 0)->velocity = (sbf_vec3){_i < 10 ? 0 : 40, 0, 100};
  scene_momentum was = scene_momentum_of(&s);
  for (int i = 0; i < 20; i++) {
    scene_ticks(&s, 1);
    sbf_vec3 off = off_plate(&s);
    if (fabsf(off.x) < 0.5f) ck_assert_float_le(off.z, -0.025f);
  }
  scene_momentum is = scene_momentum_of(&s);
  for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(was.linear[k], is.linear[k], 1e-3);
  ck_assert_float_ge(state(&s, 1)->velocity.z, 2);
  scene_free(&s);
}
END_TEST

/* Past its edge, ten centimetres off: neither feels anything. */
START_TEST(a_fast_box_passes_beside_a_plate)
{
  scene s = begin((sbf_vec3){0.625f, 0, -2 - 0.17f * (float)_i}, 5);
  state(&s, 0)->velocity = (sbf_vec3){0, 0, 100};
  scene_ticks(&s, 5);
  ck_assert_float_eq(state(&s, 0)->velocity.z, 100);
  ck_assert_float_eq(state(&s, 1)->velocity.z, 0);
  scene_free(&s);
}
END_TEST

/* Two boxes at each other, 200 m/s between them. */
START_TEST(two_fast_boxes_collide)
{
  scene s = rigid_begin();
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  for (uint32_t i = 0; i < 2; i++) {
    rigid_box(&s, (sbf_vec3){0, 0.01f * (float)i, (i ? 1 : -1) * (4 + 0.13f * (float)_i)},
        (sbf_vec3){0.05f, 0.05f, 0.05f}, 1);
    rigid_body(&s, i)->restitution = 0.5f;
  }
  scene_start(&s);
  ck_assert(sbr_world_enable_body_contacts(s.world, 0, NULL) == SBF_OK);
  for (uint32_t i = 0; i < 2; i++) state(&s, i)->velocity = (sbf_vec3){0, 0, i ? -100 : 100};
  for (int i = 0; i < 10; i++) {
    scene_ticks(&s, 1);
    ck_assert_float_ge(state(&s, 1)->pose.position.z - state(&s, 0)->pose.position.z, 0.049f);
  }
  ck_assert_float_ge(state(&s, 1)->velocity.z, 30);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("hull_sweep");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, a_fast_box_does_not_pass_a_thin_plate, 0, 20);
  tcase_add_loop_test(tests, a_fast_box_passes_beside_a_plate, 0, 10);
  tcase_add_loop_test(tests, two_fast_boxes_collide, 0, 10);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
