#include "import/scene/baked_keys.h"

#include <math.h>

#include "harness.h"

#define PI 3.14159265358979323846

static sbfi_arena arena, scratch;

static void begin(void) {
  sbfi_arena_init(&arena, NULL, 0);
  sbfi_arena_init(&scratch, NULL, 0);
}

static void end(void) {
  sbfi_arena_free(&arena);
  sbfi_arena_free(&scratch);
}

static const float two_times[] = {0, 2}, half = 0.70710678f;

/* A chain as FBX has it: translation above, rotation below, each with keys at times of its own. */
START_TEST(a_chain_becomes_one_transform)
{
  static const float moves[] = {0, 0, 0, 4, 0, 0}, one_time[] = {1},
                     turn[] = {0, 0, 0.70710678f, 0.70710678f};
  sbfi_link links[] = {{.local = sbfi_matrix_identity()}, {.local = sbfi_matrix_identity()},
      {.local = sbfi_matrix_identity()}};
  links[2].keys.tracks[SBFI_RAW_POSITION] = (sbfi_track){2, two_times, moves};
  links[1].keys.tracks[SBFI_RAW_ROTATION] = (sbfi_track){1, one_time, turn};
  links[0].local.at[1][3] = 1; /* a pivot at rest, turned by the rotation above it */
  sbfi_keys keys;
  ck_assert(sbfi_bake_keys(links, 3, &arena, &scratch, &keys));
  const sbfi_track *p = &keys.tracks[SBFI_RAW_POSITION], *r = &keys.tracks[SBFI_RAW_ROTATION];
  ck_assert_uint_eq(p->count, 3);
  for (uint32_t i = 0; i < 3; i++) {
    ck_assert_float_eq(p->times[i], (float)i);
    ck_assert_float_eq_tol(p->values[3 * i], 2 * (float)i - 1, 1e-6f);
    ck_assert_float_eq_tol(p->values[3 * i + 1], 0, 1e-6f);
  }
  ck_assert_uint_eq(r->count, 1);
  ck_assert_float_eq_tol(r->values[2], half, 1e-6f);
  ck_assert_uint_eq(keys.tracks[SBFI_RAW_SCALE].count, 1);
}
END_TEST

/* A track with keys for some parts only keeps the rest of its transform at rest. */
START_TEST(tracks_without_keys_stay_at_rest)
{
  static const float sizes[] = {1, 1, 1, 3, 3, 3};
  sbfi_link link = {.local = {{{0, -1, 0, 5}, {1, 0, 0, 6}, {0, 0, 1, 7}, {0, 0, 0, 1}}}};
  link.keys.tracks[SBFI_RAW_SCALE] = (sbfi_track){2, two_times, sizes};
  sbfi_keys keys;
  ck_assert(sbfi_bake_keys(&link, 1, &arena, &scratch, &keys));
  ck_assert_uint_eq(keys.tracks[SBFI_RAW_SCALE].count, 2);
  ck_assert_float_eq_tol(keys.tracks[SBFI_RAW_SCALE].values[3], 3, 1e-6f);
  ck_assert_float_eq(keys.tracks[SBFI_RAW_POSITION].values[2], 7);
  ck_assert_float_eq_tol(keys.tracks[SBFI_RAW_ROTATION].values[2], half, 1e-6f);
}
END_TEST

/* A full turn in three keys: neighbouring quaternions never jump to the other sign. */
START_TEST(rotations_follow_on)
{
  static const float times[] = {0, 1, 2, 3};
  float turns[16];
  for (int i = 0; i < 4; i++) {
    double angle = i * 2 * PI / 3;
    for (int k = 0; k < 4; k++) turns[4 * i + k] = 0;
    turns[4 * i] = (float)sin(angle / 2);
    turns[4 * i + 3] = (float)cos(angle / 2);
  }
  sbfi_link links[] = {{.local = sbfi_matrix_identity()}, {.local = sbfi_matrix_identity()}};
  links[1].keys.tracks[SBFI_RAW_ROTATION] = (sbfi_track){4, times, turns};
  sbfi_keys keys;
  ck_assert(sbfi_bake_keys(links, 2, &arena, &scratch, &keys));
  const sbfi_track *r = &keys.tracks[SBFI_RAW_ROTATION];
  ck_assert_uint_eq(r->count, 4);
  for (uint32_t i = 1; i < 4; i++) {
    float dot = 0;
    for (int k = 0; k < 4; k++) dot += r->values[4 * i + k] * r->values[4 * (i - 1) + k];
    ck_assert_float_gt(dot, 0);
  }
}
END_TEST

/* Seen from something that moves: its transform is undone; where it has no size it is passed over. */
START_TEST(a_link_may_be_undone)
{
  static const float moves[] = {1, 0, 0, 5, 0, 0}, sizes[] = {1, 1, 1, 0, 0, 0};
  sbfi_link links[] = {{.local = sbfi_matrix_identity()}, {.local = sbfi_matrix_identity(), .undone = true}};
  links[0].local.at[1][3] = 2;
  links[1].keys.tracks[SBFI_RAW_POSITION] = (sbfi_track){2, two_times, moves};
  sbfi_keys keys;
  ck_assert(sbfi_bake_keys(links, 2, &arena, &scratch, &keys));
  const sbfi_track *p = &keys.tracks[SBFI_RAW_POSITION];
  ck_assert_uint_eq(p->count, 2);
  ck_assert_float_eq(p->values[0], -1);
  ck_assert_float_eq(p->values[3], -5);
  ck_assert_float_eq(p->values[4], 2);
  links[1].keys.tracks[SBFI_RAW_SCALE] = (sbfi_track){2, two_times, sizes};
  ck_assert(sbfi_bake_keys(links, 2, &arena, &scratch, &keys));
  ck_assert_float_eq(keys.tracks[SBFI_RAW_POSITION].values[3], 0);
}
END_TEST

START_TEST(no_keys_no_tracks)
{
  sbfi_link link = {.local = sbfi_matrix_identity()};
  sbfi_keys keys;
  ck_assert(sbfi_bake_keys(&link, 1, &arena, &scratch, &keys));
  for (int i = 0; i < SBFI_RAW_TRACKS; i++) ck_assert_uint_eq(keys.tracks[i].count, 0);
}
END_TEST

static Suite *baked_keys_suite(void) {
  Suite *suite = suite_create("baked_keys");
  TCase *tests = tcase_create("all");
  tcase_add_checked_fixture(tests, begin, end);
  tcase_add_test(tests, a_chain_becomes_one_transform);
  tcase_add_test(tests, tracks_without_keys_stay_at_rest);
  tcase_add_test(tests, rotations_follow_on);
  tcase_add_test(tests, a_link_may_be_undone);
  tcase_add_test(tests, no_keys_no_tracks);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(baked_keys_suite());
}
