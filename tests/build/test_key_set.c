#include "build/geometry/key_set.h"

#include "harness.h"

START_TEST(test_values_stay_with_their_keys)
{
  sbfi_arena arena;
  sbfi_key_set set;
  sbfi_arena_init(&arena, NULL, 0);
  ck_assert(sbfi_key_set_init(&set, 5000, &arena));
  for (uint32_t i = 0; i < 5000; i++) {
    uint32_t *value = sbfi_key_set_find(&set, (sbfi_key){{i % 17, i, i / 3, 7}});
    ck_assert_uint_eq(*value, UINT32_MAX);
    *value = i;
  }
  for (uint32_t i = 0; i < 5000; i++)
    ck_assert_uint_eq(*sbfi_key_set_find(&set, (sbfi_key){{i % 17, i, i / 3, 7}}), i);
  ck_assert_uint_eq(*sbfi_key_set_find(&set, (sbfi_key){{0, 0, 0, 8}}), UINT32_MAX);
  sbfi_arena_free(&arena);
}
END_TEST

START_TEST(test_sorting)
{
  sbfi_key key = sbfi_key_sorted((sbfi_key){{9, 3, 7, 1}}, 3);
  const uint32_t expected[] = {3, 7, 9, 1};
  for (int k = 0; k < 4; k++) ck_assert_uint_eq(key.at[k], expected[k]);
}
END_TEST

START_TEST(test_positions)
{
  sbfi_key plus = sbfi_key_of_position((sbf_vec3){0, 1, 2}),
           minus = sbfi_key_of_position((sbf_vec3){-0.0f, 1, 2});
  sbfi_key other = sbfi_key_of_position((sbf_vec3){0, 1, 2.0000002f});
  ck_assert_mem_eq(&plus, &minus, sizeof plus);
  ck_assert_mem_ne(&plus, &other, sizeof plus);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("key_set");
  TCase *c = tcase_create("key_set");
  tcase_add_test(c, test_values_stay_with_their_keys);
  tcase_add_test(c, test_sorting);
  tcase_add_test(c, test_positions);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
