#include <math.h>
#include <string.h>

#include "harness.h"
#include "sbrun/detail.h"
#include "scenes.h"

static scene walker(void) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0.5f, 0});
  scene_body(&s, 0)->attributes.damping_ratio = 0.15f;
  scene_body(&s, 0)->attributes.sag_free = true;
  scene_section(&s, 0, (sbf_vec3){0, 0.5f, 0}, (sbf_vec3){0.3f, 0.2f, 0.5f}, 2);
  s.character_definition.position.y = 0;
  s.world_definition.ground = sbr_ground_flat(0);
  return s;
}

enum { POINTS = 51 };

static sbr_double3 world_point(const scene *s, uint32_t point) {
  sbf_vec3 p = scene_point(s, 0, point);
  sbr_double3 origin = sbr_character_get_origin(s->world, s->character);
  return (sbr_double3){origin.x + (double)p.x, origin.y + (double)p.y, origin.z + (double)p.z};
}

/* Greatest change of a distance between points against the rest shape. */
static double deformation(const scene *s) {
  sbf_vec3 now[POINTS];
  const sbf_vec3 *rest = s->asset->soft_bodies.at[0].levels.at[0].positions.at;
  ck_assert_uint_eq(scene_read(s, 0, now, POINTS), POINTS);
  double worst = 0;
  for (int i = 0; i < POINTS; i++)
    for (int k = 0; k < i; k++) {
      double a = hypot(hypot(now[i].x - now[k].x, now[i].y - now[k].y), now[i].z - now[k].z);
      double b = hypot(hypot(rest[i].x - rest[k].x, rest[i].y - rest[k].y), rest[i].z - rest[k].z);
      worst = fmax(worst, fabs(a - b));
    }
  return worst;
}

START_TEST(it_stands_where_it_is_created)
{
  scene s = walker();
  s.character_definition.position = (sbr_double3){1e6 + 0.25, 0.5, -2e6};
  s.character_definition.heading = 1.5707963f; /* +Z turned to +X */
  s.world_definition.ground = sbr_ground_flat(-3);
  scene_start(&s);
  sbf_vec3 rest = s.asset->soft_bodies.at[0].surface.positions.at[0];
  sbr_double3 p = world_point(&s, 0);
  ck_assert_double_eq_tol(p.x, 1e6 + 0.25 + (double)rest.z, 1e-6);
  ck_assert_double_eq_tol(p.y, -2.5 + (double)rest.y, 1e-6);
  ck_assert_double_eq_tol(p.z, -2e6 - (double)rest.x, 1e-6);
  scene_free(&s);
}
END_TEST

START_TEST(it_follows_the_drive_at_any_distance)
{
  scene s = walker();
  s.character_definition.position.x = 1e7;
  scene_start(&s);
  sbr_double3 before = world_point(&s, 0);
  sbr_character_set_drive(s.world, s.character, 2, 0, 0);
  double fastest = 0;
  for (int i = 0; i < 1200; i++) {
    sbr_double3 last = world_point(&s, 0);
    scene_ticks(&s, 1);
    sbr_double3 p = world_point(&s, 0);
    fastest = fmax(fastest, hypot(hypot(p.x - last.x, p.y - last.y), p.z - last.z) * 60);
  }
  sbr_double3 after = world_point(&s, 0);
  ck_assert_double_eq_tol(after.z - before.z, 2 * 20, 1);
  ck_assert_double_eq_tol(after.x, before.x, 0.01);
  ck_assert_double_lt(fastest, 4); /* no jump where the origin moves */
  ck_assert_double_eq_tol(sbr_character_get_distance(s.world, s.character), after.z - before.z, 0.05);
  ck_assert_double_lt(deformation(&s), 0.02);
  scene_free(&s);
}
END_TEST

START_TEST(a_teleport_keeps_the_shape_and_stops_it)
{
  scene s = walker();
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 1, 0, 1);
  scene_ticks(&s, 20);
  double before = deformation(&s);
  ck_assert_double_gt(before, 1e-4);
  sbr_character_teleport(s.world, s.character, (sbr_double3){-500.5, 2, 80}, -2);
  ck_assert_double_eq_tol(deformation(&s), before, 2e-5);
  sbr_double3 p = world_point(&s, 26); /* the centre */
  ck_assert_double_eq_tol(p.x, -500.5, 0.3);
  ck_assert_double_eq_tol(p.y, 2.5, 0.1);
  ck_assert_double_eq_tol(sbr_character_get_body_health(s.world, s.character, 0).kinetic_j, 0, 1e-12);
  sbr_character_set_drive(s.world, s.character, 0, 0, 0);
  scene_ticks(&s, 5);
  ck_assert_double_lt(deformation(&s), 2 * before);
  scene_free(&s);
}
END_TEST

START_TEST(a_reset_restores_the_rest_shape)
{
  scene s = walker();
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 1, 0, 1);
  scene_ticks(&s, 50);
  sbr_double3 before = world_point(&s, 26);
  sbr_character_reset(s.world, s.character);
  ck_assert_double_lt(deformation(&s), 1e-5);
  sbr_double3 after = world_point(&s, 26);
  ck_assert_double_eq_tol(after.x, before.x, 1e-4);
  ck_assert_double_eq_tol(after.z, before.z, 1e-4);
  scene_ticks(&s, 60);
  ck_assert_double_lt(deformation(&s), 1e-4); /* and it supports its weight: nothing moves */
  scene_free(&s);
}
END_TEST

START_TEST(a_paused_character_stands_still)
{
  scene s = walker();
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 1, 0, 0);
  scene_ticks(&s, 20);
  sbr_character_set_paused(s.world, s.character, true);
  sbr_double3 before = world_point(&s, 3);
  sbr_world_step(s.world, 0.1037);
  sbr_double3 during = world_point(&s, 3);
  ck_assert_mem_eq(&before, &during, sizeof before);
  sbr_character_set_paused(s.world, s.character, false);
  scene_ticks(&s, 20);
  ck_assert_double_gt(world_point(&s, 3).z, before.z + 0.2);
  scene_free(&s);
}
END_TEST

/* The same shape at the same number of its own ticks: a character of scale 4 in twice the ticks. */
START_TEST(scaled_bodies_move_equally)
{
  scene small = walker(), large = walker();
  scene *scenes[] = {&small, &large};
  for (int i = 0; i < 2; i++) {
    scene_body(scenes[i], 0)->attributes.sag_free = false; /* it swings under its weight */
    scenes[i]->character_definition.hold_pose = true;
    scenes[i]->character_definition.scale = i ? 4 : 1;
    scenes[i]->world_definition.control_tick_s = i ? 1.0 / 30 : 1.0 / 60;
    scene_start(scenes[i]);
  }
  for (int tick = 0; tick < 40; tick++) {
    scene_ticks(&small, 1);
    scene_ticks(&large, 1);
    for (uint32_t point = 0; point < POINTS; point += 5) {
      sbr_double3 a = world_point(&small, point), b = world_point(&large, point);
      ck_assert_double_eq_tol(b.x, 4 * a.x, 1e-4);
      ck_assert_double_eq_tol(b.y, 4 * a.y, 1e-4);
      ck_assert_double_eq_tol(b.z, 4 * a.z, 1e-4);
    }
  }
  ck_assert_double_gt(deformation(&small), 1e-3);
  sbr_body_health a = sbr_character_get_body_health(small.world, small.character, 0),
                  b = sbr_character_get_body_health(large.world, large.character, 0);
  ck_assert_double_eq_tol(b.kinetic_j, 256 * a.kinetic_j, 0.01 * b.kinetic_j);
  ck_assert_double_eq_tol(b.elastic_j, 256 * a.elastic_j, 0.01 * b.elastic_j);
  scene_free(&small);
  scene_free(&large);
}
END_TEST

START_TEST(definitions_are_checked)
{
  scene s = walker();
  scene_start(&s);
  sbf_diagnostic error;
  sbr_character_id id;
  sbr_character_definition definition;
  memset(&definition, 0, sizeof definition);
  ck_assert_int_eq(sbr_character_create(s.world, s.model, &definition, &id, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "sbr_default_character_definition"));
  definition = sbr_default_character_definition();
  const float scales[] = {0, -1, 1e-30f, 1e30f, NAN};
  for (int k = 0; k < 5; k++) {
    definition.scale = scales[k];
    ck_assert_int_eq(sbr_character_create(s.world, s.model, &definition, &id, &error), SBF_FAILED);
    ck_assert_ptr_nonnull(strstr(error.message, "1e-06 to 1e+06"));
  }
  ck_assert_int_eq(sbr_character_create(s.world, NULL, &definition, &id, &error), SBF_FAILED);
  sbr_character_id none = {0}, wrong = {0x00050099};
  sbr_character_set_drive(s.world, none, 1, 1, 1);
  sbr_character_teleport(s.world, wrong, (sbr_double3){0, 0, 0}, 0);
  sbr_character_reset(s.world, wrong);
  sbr_character_destroy(s.world, none);
  scene_free(&s);
}
END_TEST

START_TEST(handles_are_valid_while_it_lives)
{
  int first, second;
  scene s = walker();
  s.world_definition.user_data = &first;
  s.character_definition.user_data = &second;
  scene_start(&s);
  ck_assert_ptr_eq(sbr_world_get_user_data(s.world), &first);
  ck_assert_ptr_eq(sbr_character_get_user_data(s.world, s.character), &second);
  sbr_world_set_user_data(s.world, NULL);
  sbr_character_set_user_data(s.world, s.character, &first);
  ck_assert_ptr_null(sbr_world_get_user_data(s.world));
  scene_ticks(&s, 2);
  ck_assert_ptr_eq(sbr_character_get_user_data(s.world, s.character), &first);
  ck_assert(sbr_character_is_valid(s.world, s.character));
  ck_assert(!sbr_character_is_valid(s.world, (sbr_character_id){0}));
  ck_assert(!sbr_character_is_valid(NULL, s.character));
  sbr_character_destroy(s.world, s.character);
  ck_assert(!sbr_character_is_valid(s.world, s.character));
  ck_assert_ptr_null(sbr_character_get_user_data(s.world, s.character));
  sbr_character_set_user_data(s.world, s.character, &second);
  sbr_character_id next;
  s.character_definition.user_data = NULL;
  ck_assert_int_eq(sbr_character_create(s.world, s.model, &s.character_definition, &next, NULL), SBF_OK);
  ck_assert(!sbr_character_is_valid(s.world, s.character)); /* the same place, another generation */
  ck_assert(sbr_character_is_valid(s.world, next));
  ck_assert_ptr_null(sbr_character_get_user_data(s.world, next));
  scene_free(&s);
}
END_TEST

/* Sets each number of a definition to an invalid value, and calls functions whose failure is silent. */
START_TEST(invalid_numbers_are_never_accepted)
{
  static const float bad[4] = {NAN, INFINITY, -INFINITY, 1e16f};
  const float no = bad[_i];
  scene s = walker();
  scene_start(&s);
  sbf_diagnostic error;
  for (int k = 0; k < 4; k++) {
    sbr_character_definition d = sbr_default_character_definition();
    sbr_character_id id;
    double *at[3] = {&d.position.x, &d.position.y, &d.position.z};
    if (k < 3)
      *at[k] = (double)no;
    else
      d.heading = no;
    ck_assert_int_eq(sbr_character_create(s.world, s.model, &d, &id, &error), SBF_FAILED);
    ck_assert_ptr_nonnull(strstr(error.message, "finite"));
    ck_assert_uint_eq(id.value, 0);
  }
  sbr_world_definition d = s.world_definition;
  sbr_world *world;
  d.has_gravity = true;
  d.gravity.y = no;
  ck_assert_int_eq(sbr_world_create(&d, &world, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "finite"));
  ck_assert_ptr_null(world);
  d = s.world_definition;
  d.sleep_after_s = (double)no;
  ck_assert_int_eq(sbr_world_create(&d, &world, &error), SBF_FAILED);
  for (int k = 0; k < 4; k++) {
    sbr_model_options options = s.model_options;
    float *at[4] = {&options.gravity.x, &options.gravity.y, &options.gravity.z, &options.step_error_m};
    sbr_model *model;
    options.has_gravity = true;
    *at[k] = no;
    ck_assert_int_eq(sbr_model_create(s.asset, &options, &model, &error), SBF_FAILED);
    ck_assert_ptr_nonnull(strstr(error.message, "finite"));
    ck_assert_ptr_null(model);
  }
  for (int k = 0; k < 5; k++) {
    sbr_detail_definition detail = sbr_default_detail_definition();
    float *at[5] = {
        &detail.error_px, &detail.budget_us, &detail.ns_per_visit, &detail.stay_s, &detail.offscreen_after_s};
    *at[k] = no;
    ck_assert_int_eq(sbr_world_select_detail_levels(s.world, &detail, &error), SBF_FAILED);
  }
  scene_ticks(&s, 10);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  sbr_character_set_drive(s.world, s.character, no, 0, 0);
  sbr_character_set_drive(s.world, s.character, 0, 0, no);
  sbr_character_teleport(s.world, s.character, (sbr_double3){0, (double)no, 0}, 0);
  sbr_character_teleport(s.world, s.character, (sbr_double3){0, 0, 0}, no);
  sbr_world_step(s.world, (double)no);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), hash);
  scene_ticks(&s, 10);
  ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  sbr_character_set_drive(s.world, s.character, 1, 0, 0);
  ck_assert_uint_ne(sbr_world_get_state_hash(s.world), hash);
  scene_free(&s);
}
END_TEST

/* One world with two floors: a character on the upper one moves like the other, higher by the same
 * distance. */
START_TEST(each_may_have_its_own_ground)
{
  scene s = walker();
  scene_start(&s);
  sbr_character_definition above = s.character_definition;
  above.ground = sbr_ground_flat(3);
  sbr_character_id upper;
  ck_assert(sbr_character_create(s.world, s.model, &above, &upper, NULL) == SBF_OK);
  sbr_character_set_drive(s.world, s.character, 0.5f, 0, 0);
  sbr_character_set_drive(s.world, upper, 0.5f, 0, 0);
  scene_ticks(&s, 120);
  sbr_character_teleport(s.world, upper, (sbr_double3){2, 0, 5}, 0);
  sbr_character_teleport(s.world, s.character, (sbr_double3){2, 0, 5}, 0);
  scene_ticks(&s, 60);
  sbr_double3 low = world_point(&s, 0);
  s.character = upper;
  sbr_double3 high = world_point(&s, 0);
  ck_assert_double_eq_tol(high.y - low.y, 3, 1e-5);
  ck_assert_double_eq_tol(high.z, low.z, 1e-5);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("character");
  TCase *c = tcase_create("character");
  tcase_add_test(c, it_stands_where_it_is_created);
  tcase_add_test(c, it_follows_the_drive_at_any_distance);
  tcase_add_test(c, a_teleport_keeps_the_shape_and_stops_it);
  tcase_add_test(c, a_reset_restores_the_rest_shape);
  tcase_add_test(c, a_paused_character_stands_still);
  tcase_add_test(c, scaled_bodies_move_equally);
  tcase_add_test(c, each_may_have_its_own_ground);
  tcase_add_test(c, definitions_are_checked);
  tcase_add_test(c, handles_are_valid_while_it_lives);
  tcase_add_loop_test(c, invalid_numbers_are_never_accepted, 0, 4);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
