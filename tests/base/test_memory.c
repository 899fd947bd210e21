#include "harness.h"

#include <string.h>

#include "base/memory.h"

START_TEST(sizes_are_checked)
{
  size_t result;
  ck_assert(sbfi_multiply_size(SIZE_MAX, 1, &result) && result == SIZE_MAX);
  ck_assert(sbfi_multiply_size(SIZE_MAX, 0, &result) && result == 0);
  ck_assert(sbfi_multiply_size(SIZE_MAX / 2, 2, &result) && result == SIZE_MAX - 1);
  ck_assert(!sbfi_multiply_size(SIZE_MAX / 2 + 1, 2, &result));
  ck_assert(sbfi_add_size(SIZE_MAX - 1, 1, &result) && result == SIZE_MAX);
  ck_assert(!sbfi_add_size(SIZE_MAX, 1, &result));
}
END_TEST

START_TEST(an_arena_gives_zeroed_and_aligned_memory)
{
  harness_memory memory;
  sbfi_arena arena;
  harness_memory_init(&memory, SIZE_MAX);
  sbfi_arena_init(&arena, &memory.allocator, 0);
  const size_t sizes[] = {1, 3, 16, 100, 255, 256, 1000, 5000, 100000, 3000000, 7};
  for (int round = 0; round < 20; round++)
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
      unsigned char *at = sbfi_arena_allocate(&arena, 1, sizes[i]);
      ck_assert_ptr_nonnull(at);
      ck_assert_uint_eq((uintptr_t)at % (sizes[i] >= 256 ? 64 : 16), 0);
      for (size_t k = 0; k < sizes[i]; k++)
        if (at[k]) ck_abort_msg("byte %zu of %zu", k, sizes[i]);
      memset(at, 0xAA, sizes[i]); /* a block that overlaps an earlier one would not be zero */
    }
  ck_assert_ptr_null(sbfi_arena_allocate(&arena, 0, 4));
  ck_assert_ptr_null(sbfi_arena_allocate(&arena, SIZE_MAX / 2, 4));
  ck_assert_ptr_null(sbfi_arena_allocate(&arena, 1, SIZE_MAX - 8));
  ck_assert_str_eq(sbfi_arena_string(&arena, "bones", 4), "bone");
  ck_assert_str_eq(sbfi_arena_string(&arena, NULL, 0), "");
  ck_assert_mem_eq(sbfi_arena_copy(&arena, "abcd", 2, 2), "abcd", 4);
  sbfi_arena_free(&arena);
  ck_assert_uint_eq(memory.held_bytes, 0);
}
END_TEST

START_TEST(an_arena_respects_its_limit)
{
  sbfi_arena arena;
  sbfi_arena_init(&arena, NULL, 1000);
  ck_assert_ptr_nonnull(sbfi_arena_allocate(&arena, 1, 600));
  ck_assert_ptr_null(sbfi_arena_allocate(&arena, 1, 401));
  ck_assert_ptr_nonnull(sbfi_arena_allocate(&arena, 1, 400));
  ck_assert_ptr_null(sbfi_arena_allocate(&arena, 1, 1));
  ck_assert_uint_eq(arena.used_bytes, 1000);
  sbfi_arena_free(&arena);
}
END_TEST

START_TEST(failing_allocations_lose_nothing)
{
  harness_memory memory;
  for (size_t allowed = 0; allowed < 6; allowed++) {
    sbfi_arena arena;
    sbfi_array array;
    harness_memory_init(&memory, allowed);
    sbfi_arena_init(&arena, &memory.allocator, 0);
    size_t given = 0;
    while (sbfi_arena_allocate(&arena, 1, 3000)) given++;
    ck_assert_uint_ge(given, allowed);
    sbfi_arena_free(&arena);
    ck_assert_uint_eq(memory.held_bytes, 0);

    harness_memory_init(&memory, allowed);
    sbfi_array_init(&array, &memory.allocator, sizeof(uint32_t));
    uint32_t count = 0;
    while (sbfi_array_append(&array, &count, 1)) count++;
    ck_assert_uint_eq(array.count, count);
    for (uint32_t i = 0; i < count; i++) ck_assert_uint_eq(((uint32_t *)array.at)[i], i);
    sbfi_array_free(&array);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

START_TEST(an_array_grows_by_pieces)
{
  sbfi_array array;
  sbfi_array_init(&array, NULL, sizeof(uint16_t));
  ck_assert(sbfi_array_append(&array, NULL, 0));
  ck_assert_ptr_nonnull(sbfi_array_push(&array, 0)); /* NULL would say that memory ran out */
  uint16_t *destination = sbfi_array_push(&array, 3);
  ck_assert_ptr_nonnull(destination);
  ck_assert(destination[0] == 0 && destination[2] == 0);
  const uint16_t more[] = {7, 8};
  ck_assert(sbfi_array_append(&array, more, 2));
  ck_assert_uint_eq(array.count, 5);
  ck_assert_uint_eq(((uint16_t *)array.at)[4], 8);
  ck_assert(sbfi_array_reserve(&array, 1000));
  ck_assert_uint_ge(array.capacity, 1000);
  ck_assert_ptr_null(sbfi_array_push(&array, SIZE_MAX - 2));
  ck_assert_uint_eq(array.count, 5);
  sbfi_array_free(&array);
  ck_assert_uint_eq(array.count, 0);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("memory");
  TCase *c = tcase_create("memory");
  tcase_add_test(c, sizes_are_checked);
  tcase_add_test(c, an_arena_gives_zeroed_and_aligned_memory);
  tcase_add_test(c, an_arena_respects_its_limit);
  tcase_add_test(c, failing_allocations_lose_nothing);
  tcase_add_test(c, an_array_grows_by_pieces);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
