#include "gltf/json.h"

#include <stdio.h>
#include <string.h>

#include "harness.h"

static bool parse(
    const char *text, sbfi_arena *arena, const sbfi_json **root, size_t *offset, const char **reason) {
  sbfi_arena_init(arena, NULL, 0);
  return sbfi_json_parse(text, strlen(text), arena, root, offset, reason);
}

START_TEST(test_values_are_read)
{
  sbfi_arena arena;
  const sbfi_json *root;
  size_t offset;
  const char *reason;
  uint32_t number;
  ck_assert(
      parse(" {\"a\": [1, -2.5e3, true, false, null], \"b\\u00e9\\n\": {\"c\": \"\\ud83d\\ude00\\\\\"}} ",
          &arena, &root, &offset, &reason));
  const sbfi_json *a = sbfi_json_get(root, "a");
  ck_assert_uint_eq(a->count, 5);
  ck_assert(sbfi_json_u32(sbfi_json_at(a, 0), &number));
  ck_assert_uint_eq(number, 1);
  ck_assert(!sbfi_json_u32(sbfi_json_at(a, 1), &number));
  ck_assert_uint_eq(sbfi_json_at(a, 1)->text.length, 6);
  ck_assert_int_eq(sbfi_json_at(a, 2)->type, SBFI_JSON_TRUE);
  ck_assert_int_eq(sbfi_json_at(a, 3)->type, SBFI_JSON_FALSE);
  ck_assert_int_eq(sbfi_json_at(a, 4)->type, SBFI_JSON_NULL);
  ck_assert(!sbfi_json_at(a, 5));
  ck_assert(
      sbfi_json_is_string(sbfi_json_get(sbfi_json_get(root, "b\xc3\xa9\n"), "c"), "\xf0\x9f\x98\x80\\"));
  ck_assert(!sbfi_json_get(root, "c") && !sbfi_json_get(NULL, "a") && !sbfi_json_get(a, "a"));
  sbfi_arena_free(&arena);
}
END_TEST

START_TEST(test_invalid_json_is_refused_at_its_position)
{
  static const struct {
    const char *text;
    size_t offset;
  } cases[] = {{"", 0}, {"{", 1}, {"[1,]", 3}, {"[1 2]", 3}, {"{\"a\" 1}", 5}, {"{\"a\":1,\"a\":2}", 13},
      {"{a:1}", 1}, {"01", 2}, {"1.", 2}, {"1e", 2}, {"-", 1}, {"+1", 0}, {"tru", 0}, {"nulll", 4},
      {"[] []", 3}, {"\"abc", 4}, {"\"\\q\"", 2}, {"\"\\u12g4\"", 5}, {"\"\\ud800\"", 7}, {"\"\\udc00\"", 7},
      {"\"\\u0000\"", 7}, {"\"\t\"", 2}, {"\"\xff\"", 3}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    sbfi_arena arena;
    const sbfi_json *root;
    size_t offset;
    const char *reason = NULL;
    ck_assert_msg(!parse(cases[i].text, &arena, &root, &offset, &reason), "%s", cases[i].text);
    ck_assert_msg(reason && *reason, "%s", cases[i].text);
    ck_assert_msg(offset == cases[i].offset, "%s: %zu", cases[i].text, offset);
    sbfi_arena_free(&arena);
  }
}
END_TEST

START_TEST(test_depth_and_names_are_bounded)
{
  char text[400];
  sbfi_arena arena;
  const sbfi_json *root;
  size_t offset;
  const char *reason;
  for (int depth = 64; depth <= 65; depth++) {
    memset(text, '[', (size_t)depth);
    memset(text + depth, ']', (size_t)depth);
    text[2 * depth] = 0;
    ck_assert_int_eq(parse(text, &arena, &root, &offset, &reason), depth == 64);
    sbfi_arena_free(&arena);
  }
  for (int repeats = 0; repeats < 2; repeats++) { /* more names than are compared in pairs */
    size_t at = 0;
    text[at++] = '{';
    for (int i = 0; i < 40; i++)
      at += (size_t)sprintf(text + at, "%s\"%d\":0", i ? "," : "", repeats && i == 39 ? 7 : i);
    text[at++] = '}', text[at] = 0;
    ck_assert_int_eq(parse(text, &arena, &root, &offset, &reason), !repeats);
    sbfi_arena_free(&arena);
  }
}
END_TEST

START_TEST(test_every_failing_allocation_is_reported)
{
  const char *text = "{\"a\":[1,[2,3],{\"b\":\"c\"}],\"d\":{\"e\":[{},[],\"\"]}}";
  bool done = false;
  for (size_t allowed = 0; !done; allowed++) {
    harness_memory memory;
    sbfi_arena arena;
    const sbfi_json *root;
    size_t offset;
    const char *reason = NULL;
    harness_memory_init(&memory, allowed);
    sbfi_arena_init(&arena, &memory.allocator, 0);
    done = sbfi_json_parse(text, strlen(text), &arena, &root, &offset, &reason);
    ck_assert(done == !reason);
    ck_assert(done || strstr(reason, "memory"));
    sbfi_arena_free(&arena);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

static Suite *json_suite(void) {
  Suite *suite = suite_create("json");
  TCase *c = tcase_create("json");
  tcase_add_test(c, test_values_are_read);
  tcase_add_test(c, test_invalid_json_is_refused_at_its_position);
  tcase_add_test(c, test_depth_and_names_are_bounded);
  tcase_add_test(c, test_every_failing_allocation_is_reported);
  suite_add_tcase(suite, c);
  return suite;
}

int main(void) {
  return harness_run(json_suite());
}
