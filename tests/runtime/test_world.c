#include <math.h>
#include <string.h>

#include "harness.h"
#include "scenes.h"

/* A section on a bone. */
static scene walker(void) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 0.5f, 0});
  scene_body(&s, 0)->attributes.damping_ratio = 0.15f;
  scene_section(&s, 0, (sbf_vec3){0, 0.5f, 0}, (sbf_vec3){0.3f, 0.2f, 0.5f}, 3);
  s.character_definition.position.y = 0;
  s.world_definition.ground = sbr_ground_flat(0);
  return s;
}

START_TEST(frames_add_up_to_ticks)
{
  scene s = walker();
  scene_start(&s);
  for (int i = 0; i < 60; i++) sbr_world_step(s.world, 1.0 / 60);
  ck_assert_uint_eq(sbr_world_get_tick_count(s.world), 60);
  for (int i = 0; i < 144; i++) sbr_world_step(s.world, 1.0 / 144);
  ck_assert_uint_ge(sbr_world_get_tick_count(s.world), 120);
  ck_assert_uint_le(sbr_world_get_tick_count(s.world), 121);
  scene_free(&s);
}
END_TEST

START_TEST(a_long_frame_is_cut_short)
{
  scene s = walker();
  scene_start(&s);
  sbr_world_step(s.world, 3600);
  ck_assert_uint_eq(sbr_world_get_tick_count(s.world), 15);
  sbr_world_step(s.world, NAN);
  sbr_world_step(s.world, -1);
  sbr_world_step(s.world, 0);
  ck_assert_uint_eq(sbr_world_get_tick_count(s.world), 15);
  ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  scene_free(&s);
}
END_TEST

START_TEST(definitions_are_checked)
{
  sbr_world *world;
  sbf_diagnostic error;
  sbr_world_definition definition;
  memset(&definition, 0, sizeof definition);
  ck_assert_int_eq(sbr_world_create(&definition, &world, &error), SBF_FAILED);
  ck_assert_ptr_null(world);
  ck_assert_ptr_nonnull(strstr(error.message, "sbr_default_world_definition"));
  definition = sbr_default_world_definition();
  definition.control_tick_s = -1;
  ck_assert_int_eq(sbr_world_create(&definition, &world, &error), SBF_FAILED);
  ck_assert_int_eq(sbr_world_create(NULL, &world, &error), SBF_FAILED);
  sbr_world_destroy(NULL);
}
END_TEST

START_TEST(a_full_world_returns_an_error)
{
  scene s = walker();
  s.world_definition.character_capacity = 2;
  scene_start(&s);
  sbr_character_id second, third;
  sbf_diagnostic error;
  ck_assert_int_eq(sbr_character_create(s.world, s.model, &s.character_definition, &second, &error), SBF_OK);
  ck_assert_int_eq(
      sbr_character_create(s.world, s.model, &s.character_definition, &third, &error), SBF_FAILED);
  ck_assert_ptr_nonnull(strstr(error.message, "character_capacity"));
  ck_assert_uint_eq(third.value, 0);
  sbr_character_destroy(s.world, second);
  ck_assert_int_eq(sbr_character_create(s.world, s.model, &s.character_definition, &third, &error), SBF_OK);
  ck_assert_uint_ne(third.value, second.value); /* the old handle is invalid now */
  ck_assert_double_eq(sbr_character_get_body_health(s.world, second, 0).volume_ratio, 0);
  ck_assert_uint_eq(sbr_character_get_skin(s.world, second, 0, NULL, NULL, NULL, 0), 0);
  scene_ticks(&s, 2);
  scene_free(&s);
}
END_TEST

/* Counts its calls. */
static void *counting(void *user, void *memory, size_t old_size, size_t new_size) {
  harness_memory *m = user;
  return m->allocator.reallocate(m->allocator.user, memory, old_size, new_size);
}

START_TEST(a_step_allocates_nothing)
{
  scene s = walker();
  scene_skin(&s, 0);
  harness_memory memory;
  harness_memory_init(&memory, SIZE_MAX);
  sbf_allocator allocator = {counting, &memory};
  s.world_definition.allocator = &allocator;
  s.model_options.allocator = &allocator;
  scene_start(&s);
  sbf_vec3 positions[256], normals[256];
  sbr_character_set_drive(s.world, s.character, 0.5f, 0, 0.3f);
  size_t before = memory.calls;
  for (int i = 0; i < 1000; i++) {
    sbr_world_step(s.world, 1.0 / 50);
    sbr_character_get_skin(s.world, s.character, 0, positions, normals, NULL, 256);
    sbr_character_get_body_health(s.world, s.character, 0);
    if (i % 100 == 50) sbr_character_teleport(s.world, s.character, (sbr_double3){i, 0, 0}, 1);
  }
  ck_assert_uint_eq(memory.calls, before);
  scene_free(&s);
  ck_assert_uint_eq(memory.held_bytes, 0);
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  scene s = walker();
  scene_skin(&s, 0);
  bool good = false;
  for (size_t allowed = 0; !good; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbf_allocator allocator = {counting, &memory};
    s.world_definition.allocator = &allocator;
    s.model_options.allocator = &allocator;
    sbf_diagnostic error;
    sbf_status status = sbr_model_create(s.asset, &s.model_options, &s.model, &error);
    if (status == SBF_OK) status = sbr_world_create(&s.world_definition, &s.world, &error);
    if (status == SBF_OK)
      status = sbr_character_create(s.world, s.model, &s.character_definition, &s.character, &error);
    good = status == SBF_OK;
    if (!good) ck_assert_int_eq(status, SBF_FAILED);
    sbr_world_destroy(s.world);
    sbr_model_destroy(s.model);
    s.world = NULL;
    s.model = NULL;
    ck_assert_uint_eq(memory.held_bytes, 0);
    ck_assert_uint_lt(allowed, 10000);
  }
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("world");
  TCase *c = tcase_create("world");
  tcase_add_test(c, frames_add_up_to_ticks);
  tcase_add_test(c, a_long_frame_is_cut_short);
  tcase_add_test(c, definitions_are_checked);
  tcase_add_test(c, a_full_world_returns_an_error);
  tcase_add_test(c, a_step_allocates_nothing);
  tcase_add_test(c, every_allocation_may_fail);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
