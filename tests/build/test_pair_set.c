#include "build/springs/pair_set.h"

#include "harness.h"

START_TEST(pairs_have_no_direction)
{
  sbfi_arena arena;
  sbfi_arena_init(&arena, NULL, 0);
  sbfi_pair_set set;
  ck_assert(sbfi_pair_set_init(&set, 10, &arena));
  ck_assert(!sbfi_pair_set_has(&set, 3, 4));
  ck_assert_uint_eq(sbfi_pair_set_add(&set, 3, 4, 7), 7);
  ck_assert_uint_eq(sbfi_pair_set_add(&set, 4, 3, 8), 7);
  ck_assert(sbfi_pair_set_has(&set, 4, 3));
  ck_assert(!sbfi_pair_set_has(&set, 0, 4));
  sbfi_arena_free(&arena);
}
END_TEST

START_TEST(a_full_set_finds_all)
{
  enum { SIDE = 60 };
  sbfi_arena arena;
  sbfi_arena_init(&arena, NULL, 0);
  sbfi_pair_set set;
  ck_assert(sbfi_pair_set_init(&set, SIDE * (SIDE - 1) / 2, &arena));
  uint32_t count = 0;
  for (uint32_t a = 0; a < SIDE; a++)
    for (uint32_t b = a + 1; b < SIDE; b++)
      ck_assert_uint_eq(sbfi_pair_set_add(&set, a, b << 20, count), count++);
  count = 0;
  for (uint32_t a = 0; a < SIDE; a++)
    for (uint32_t b = a + 1; b < SIDE; b++)
      ck_assert_uint_eq(sbfi_pair_set_add(&set, b << 20, a, 0), count++);
  sbfi_arena_free(&arena);
}
END_TEST

START_TEST(memory_may_run_out)
{
  for (size_t allowed = 0; allowed < 2; allowed++) { /* the keys, then the values */
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_arena arena;
    sbfi_arena_init(&arena, &memory.allocator, 0);
    sbfi_pair_set set;
    ck_assert(!sbfi_pair_set_init(&set, 100000, &arena));
    sbfi_arena_free(&arena);
  }
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("pair_set");
  TCase *c = tcase_create("pair_set");
  tcase_add_test(c, pairs_have_no_direction);
  tcase_add_test(c, a_full_set_finds_all);
  tcase_add_test(c, memory_may_run_out);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
