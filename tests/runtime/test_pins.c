#include <math.h>

#include "harness.h"
#include "prepare/pins.h"
#include "scenes.h"
#include "state/world.h"

static sbf_pin_set *add_pins(scene *s, sbf_level *level, uint32_t set_count) {
  sbf_pin_set *sets = sbf_asset_allocate(s->asset, set_count, sizeof *sets);
  for (uint32_t i = 0; i < set_count; i++) sbf_pin_set_init(&sets[i]);
  level->pins = (sbf_pin_set_list){sets, set_count};
  return sets;
}

START_TEST(weights_stay_within_the_sets_bounds)
{
  const float weights[] = {0, 0.4f, 1};
  sbf_pin_set set;
  sbf_pin_set_init(&set);
  set.weights = (sbf_f32_list){weights, 3};
  set.minimum = 0.2f;
  set.maximum = 0.9f;
  ck_assert_float_eq(sbri_pin_weight(&set, 0), 0.2f);
  ck_assert_float_eq(sbri_pin_weight(&set, 1), 0.4f);
  ck_assert_float_eq(sbri_pin_weight(&set, 2), 0.9f);
  set.weights.count = 0;
  ck_assert_float_eq(sbri_pin_weight(&set, 1), 0.9f);
}
END_TEST

/* One point of 2 kg, pulled by a pin of weight 0.5 of a spring of 100 N/m. */
START_TEST(a_goal_acts_as_a_zero_length_spring)
{
  scene s = scene_begin();
  const sbf_vec3 position = {1, 2, 3};
  const float mass = 2, weight = 0.5f;
  const uint32_t point = 0;
  sbf_level *level = scene_points(&s, 0, &position, &mass, 1);
  sbf_pin_set *set = add_pins(&s, level, 1);
  set->points = (sbf_u32_list){&point, 1};
  set->weights = (sbf_f32_list){&weight, 1};
  set->stiffness = 100;
  set->damping = 20; /* of weight 0.5: ratio 10 / (2 sqrt(50 * 2)) = 0.5 */
  scene_start(&s);
  scene_ticks(&s, 600);
  ck_assert_float_eq_tol(scene_point(&s, 0, 0).y, 2 - 9.81f * 2 / 50, 1e-4f);
  ck_assert_double_eq_tol(s.model->islands[0].stability.fastest_rad_s, 5, 0.2);
  scene_free(&s);
}
END_TEST

START_TEST(a_goal_without_stiffness_uses_that_of_the_body)
{
  scene s = scene_begin();
  const sbf_vec3 position = {0, 0, 0};
  const float mass = 1, weight = 0.5f;
  const uint32_t point = 0;
  scene_body(&s, 0)->attributes.young_modulus = 1000;
  scene_body(&s, 0)->attributes.density = 1000; /* a cube of 0.1 m: 1000 Pa * 0.1 m * 0.5 */
  sbf_level *level = scene_points(&s, 0, &position, &mass, 1);
  sbf_pin_set *set = add_pins(&s, level, 1);
  set->points = (sbf_u32_list){&point, 1};
  set->weights = (sbf_f32_list){&weight, 1};
  scene_start(&s);
  ck_assert_uint_eq(s.model->islands[0].springs.count, 1);
  ck_assert_float_eq_tol(s.model->islands[0].springs.at[0].stiffness_n_m, 50, 0.01f);
  scene_free(&s);
}
END_TEST

START_TEST(offsets_position_points_in_their_bone)
{
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0}); /* its +Y runs along +Z */
  const sbf_vec3 position = {5, 5, 5}, offset = {0, 2, 0};
  const uint32_t point = 0;
  sbf_level *level = scene_points(&s, 0, &position, NULL, 1);
  sbf_pin_set *set = add_pins(&s, level, 1);
  set->bone = 0;
  set->points = (sbf_u32_list){&point, 1};
  set->offsets = (sbf_vec3_list){&offset, 1};
  s.character_definition.position.y = 0;
  s.world_definition.ground = sbr_ground_flat(0);
  scene_start(&s);
  sbf_vec3 p = scene_point(&s, 0, 0);
  ck_assert_float_eq_tol(p.x, 0, 1e-6f);
  ck_assert_float_eq_tol(p.y, 1, 1e-6f);
  ck_assert_float_eq_tol(p.z, 2, 1e-6f);
  scene_free(&s);
}
END_TEST

START_TEST(the_first_of_several_pins_is_used)
{
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  const sbf_vec3 position = {0, 1, 0};
  const uint32_t point = 0;
  sbf_level *level = scene_points(&s, 0, &position, NULL, 1);
  sbf_pin_set *sets = add_pins(&s, level, 2);
  sets[0].bone = 0;
  sets[0].points = sets[1].points = (sbf_u32_list){&point, 1}; /* the second by the world */
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 1, 0, 0);
  scene_ticks(&s, 120);
  sbr_double3 origin = sbr_character_get_origin(s.world, s.character);
  ck_assert_double_gt(origin.z + (double)scene_point(&s, 0, 0).z, 1);
  scene_free(&s);
}
END_TEST

START_TEST(pins_without_a_bone_fix_points_at_the_initial_position)
{
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  const sbf_vec3 position = {0.5f, 1, 0};
  const uint32_t point = 0;
  sbf_level *level = scene_points(&s, 0, &position, NULL, 1);
  add_pins(&s, level, 1)->points = (sbf_u32_list){&point, 1};
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 1, 0, 0);
  scene_ticks(&s, 600); /* the origin has moved by then */
  sbr_double3 origin = sbr_character_get_origin(s.world, s.character);
  sbf_vec3 p = scene_point(&s, 0, 0);
  ck_assert_double_ge(origin.z, 4);
  ck_assert_double_eq_tol(origin.z + (double)p.z, 0, 1e-5);
  ck_assert_double_eq_tol(origin.x + (double)p.x, 0.5, 1e-5);
  sbr_character_teleport(s.world, s.character, (sbr_double3){100, 1000, 0}, 0);
  scene_ticks(&s, 60);
  origin = sbr_character_get_origin(s.world, s.character);
  ck_assert_double_eq_tol(origin.x + (double)scene_point(&s, 0, 0).x, 100.5, 1e-5);
  scene_free(&s);
}
END_TEST

/* A row of points between two bones' ends: their pin frames blend from one bone to the other. */
START_TEST(drivers_blend_between_the_pinning_bones)
{
  scene s = scene_begin();
  sbf_bone *bones = sbf_asset_allocate(s.asset, 2, sizeof *bones);
  for (int i = 0; i < 2; i++) {
    sbf_bone_init(&bones[i]);
    bones[i].id = i ? "b" : "a";
    bones[i].rotation = (sbf_quat){0, 0, 0, 1};
  }
  s.asset->bones = (sbf_bone_list){bones, 2};
  enum { POINTS = 11 };
  sbf_level *level = scene_chain(&s, 0, (sbf_vec3){1, 0, 0}, POINTS - 1, 10, 1, 1);
  const uint32_t first = 0, last = POINTS - 1;
  sbf_pin_set *sets = add_pins(&s, level, 2);
  sets[0].bone = 0, sets[0].points = (sbf_u32_list){&first, 1};
  sets[1].bone = 1, sets[1].points = (sbf_u32_list){&last, 1};
  scene_start(&s);
  const sbri_body *body = &s.model->bodies[0];
  ck_assert(body->is_pinned);
  ck_assert_ptr_nonnull(body->drivers);
  for (uint32_t i = 1; i + 1 < POINTS; i++) {
    const sbri_driver *driver = &body->drivers[body->slots.from_point[i] - body->slots.begin];
    float of_second = 0, sum = 0;
    for (int k = 0; k < SBRI_DRIVERS; k++) {
      sum += driver->weights[k];
      if (driver->frames[k] == 1) of_second += driver->weights[k];
    }
    ck_assert_float_eq_tol(sum, 1, 1e-6f);
    ck_assert_float_eq_tol(of_second, (float)i / (POINTS - 1), 0.02f);
  }
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("pins");
  TCase *c = tcase_create("pins");
  tcase_add_test(c, weights_stay_within_the_sets_bounds);
  tcase_add_test(c, a_goal_acts_as_a_zero_length_spring);
  tcase_add_test(c, a_goal_without_stiffness_uses_that_of_the_body);
  tcase_add_test(c, offsets_position_points_in_their_bone);
  tcase_add_test(c, the_first_of_several_pins_is_used);
  tcase_add_test(c, pins_without_a_bone_fix_points_at_the_initial_position);
  tcase_add_test(c, drivers_blend_between_the_pinning_bones);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
