#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "scenes.h"

static const sbf_scheme schemes[] = {SBF_SCHEME_AUTOMATIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_HEUN,
    SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_RELAXATION};
enum { SCHEME_COUNT = 5 };

static scene walker_by(sbf_scheme scheme) {
  scene s = scene_begin();
  scene_bodies(&s, 2);
  scene_bone(&s, (sbf_vec3){0, 0.5f, 0});
  scene_section(&s, 0, (sbf_vec3){0, 0.5f, 0}, (sbf_vec3){0.3f, 0.2f, 0.5f}, 2);
  scene_section(&s, 1, (sbf_vec3){0, 0.5f, 0.6f}, (sbf_vec3){0.2f, 0.2f, 0.5f}, 3);
  s.character_definition.position.y = 0;
  s.world_definition.ground = sbr_ground_noise(0.05, 3);
  s.model_options.scheme = scheme;
  scene_start(&s);
  sbr_character_set_drive(s.world, s.character, 1, 0, 0.8f);
  return s;
}

static scene walker(void) {
  return walker_by(SBF_SCHEME_AUTOMATIC);
}

START_TEST(a_restored_world_continues_equally)
{
  scene s = walker_by(schemes[_i]);
  scene_ticks(&s, 37);
  size_t size = sbr_world_get_snapshot_size(s.world);
  void *bytes = malloc(size);
  uint64_t hashes[100];
  ck_assert_int_eq(sbr_world_save_snapshot(s.world, bytes, size), SBF_OK);
  uint64_t before = sbr_world_get_state_hash(s.world);
  for (int i = 0; i < 100; i++) {
    scene_ticks(&s, 1);
    hashes[i] = sbr_world_get_state_hash(s.world);
    ck_assert_uint_ne(hashes[i], i ? hashes[i - 1] : before);
  }
  sbr_character_set_drive(s.world, s.character, -1, 1, 0);
  scene_ticks(&s, 50);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size), SBF_OK);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), before);
  ck_assert_uint_eq(sbr_world_get_tick_count(s.world), 37);
  for (int i = 0; i < 100; i++) {
    scene_ticks(&s, 1);
    ck_assert_uint_eq(sbr_world_get_state_hash(s.world), hashes[i]);
  }
  free(bytes);
  scene_free(&s);
}
END_TEST

START_TEST(two_worlds_agree_to_the_bit)
{
  scene a = walker(), b = walker();
  for (int i = 0; i < 50; i++) {
    scene_ticks(&a, 1);
    scene_ticks(&b, 1);
    ck_assert_uint_eq(sbr_world_get_state_hash(a.world), sbr_world_get_state_hash(b.world));
  }
  sbr_character_set_drive(b.world, b.character, 1, 0, 0.80001f);
  ck_assert_uint_ne(sbr_world_get_state_hash(a.world), sbr_world_get_state_hash(b.world));
  scene_free(&a);
  scene_free(&b);
}
END_TEST

START_TEST(snapshots_of_another_world_are_refused)
{
  scene s = walker();
  size_t size = sbr_world_get_snapshot_size(s.world);
  unsigned char *bytes = malloc(size);
  ck_assert_int_eq(sbr_world_save_snapshot(s.world, bytes, size - 1), SBF_FAILED);
  ck_assert_int_eq(sbr_world_save_snapshot(s.world, bytes, size), SBF_OK);
  scene_ticks(&s, 3);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size - 1), SBF_FAILED);
  bytes[0] ^= 1;
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size), SBF_FAILED);
  bytes[0] ^= 1;
  sbr_character_id other;
  ck_assert_int_eq(sbr_character_create(s.world, s.model, &s.character_definition, &other, NULL), SBF_OK);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size), SBF_FAILED);
  sbr_character_destroy(s.world, other);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), hash);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size), SBF_OK);
  sbr_character_destroy(s.world, s.character); /* another character in the same slot */
  ck_assert_int_eq(
      sbr_character_create(s.world, s.model, &s.character_definition, &s.character, NULL), SBF_OK);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size), SBF_FAILED);
  free(bytes);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("snapshot");
  TCase *c = tcase_create("snapshot");
  tcase_add_loop_test(c, a_restored_world_continues_equally, 0, SCHEME_COUNT);
  tcase_add_test(c, two_worlds_agree_to_the_bit);
  tcase_add_test(c, snapshots_of_another_world_are_refused);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
