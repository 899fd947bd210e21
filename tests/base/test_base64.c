#include "harness.h"

#include <stdlib.h>
#include <string.h>

#include "base/base64.h"

static const struct {
  const char *plain, *text;
} known[] = {/* RFC 4648, section 10 */
    {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="},
    {"foobar", "Zm9vYmFy"}};

/* Decodes in pieces of `step` characters into a block of exactly the promised room. */
static bool decoded(const char *text, size_t step, sbfi_text *to) {
  sbfi_base64_reader reader = {0};
  size_t length = strlen(text);
  for (size_t at = 0; at < length; at += step) {
    size_t piece = length - at < step ? length - at : step, size;
    uint8_t *buffer = malloc(SBFI_BASE64_CAPACITY(piece));
    bool good = sbfi_base64_read(&reader, text + at, piece, buffer, &size) == piece;
    sbfi_text_append(to, buffer, size);
    free(buffer);
    if (!good) return false;
  }
  return sbfi_base64_is_complete(&reader);
}

START_TEST(known_texts_encode_and_decode)
{
  for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
    sbfi_text text;
    sbfi_text_init(&text, NULL);
    ck_assert(sbfi_base64_encode(&text, (const uint8_t *)known[i].plain, strlen(known[i].plain)));
    ck_assert_uint_eq(text.length, strlen(known[i].text));
    if (text.length) ck_assert_mem_eq(text.at, known[i].text, text.length);
    sbfi_text_clear(&text);
    ck_assert(decoded(known[i].text, 100, &text));
    ck_assert(sbfi_span_is((sbfi_span){text.at, text.length}, known[i].plain));
    sbfi_text_free(&text);
  }
}
END_TEST

START_TEST(all_bytes_survive_any_split)
{
  uint8_t bytes[256 * 3];
  for (size_t i = 0; i < sizeof bytes; i++) bytes[i] = (uint8_t)(i * 167 + i / 256);
  for (size_t size = sizeof bytes - 3; size <= sizeof bytes; size++) {
    sbfi_text text, back;
    sbfi_text_init(&text, NULL);
    sbfi_text_init(&back, NULL);
    sbfi_base64_encode(&text, bytes, size);
    sbfi_text_char(&text, 0);
    for (size_t step = 1; step < 9; step++) {
      sbfi_text_clear(&back);
      ck_assert(decoded(text.at, step, &back));
      ck_assert_uint_eq(back.length, size);
      ck_assert_mem_eq(back.at, bytes, size);
    }
    sbfi_text_free(&text);
    sbfi_text_free(&back);
  }
}
END_TEST

START_TEST(white_space_is_skipped)
{
  sbfi_text back;
  sbfi_text_init(&back, NULL);
  ck_assert(decoded("\n  Zm9v\r\n\tYg = = \n", 100, &back));
  ck_assert(sbfi_span_is((sbfi_span){back.at, back.length}, "foob"));
  sbfi_text_free(&back);
}
END_TEST

START_TEST(invalid_characters_are_refused_at_their_offset)
{
  const struct {
    const char *text;
    size_t bad; /* SIZE_MAX: well so far, but not complete */
  } cases[] = {{"Zm9v!", 4}, {"Zm-v", 2}, {"=", 0}, {"Z===", 1}, {"Zg=", SIZE_MAX}, {"Zg=v", 3},
      {"Zg==Zg==", 4}, {"Zg===", 4}, {"Zh==", 2}, {"Zm9=", 3}, {"Zm9", SIZE_MAX}, {"Z", SIZE_MAX},
      {"Zm8=\xC3", 4}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    sbfi_base64_reader reader = {0};
    uint8_t buffer[32];
    size_t size, length = strlen(cases[i].text);
    size_t bad = sbfi_base64_read(&reader, cases[i].text, length, buffer, &size);
    ck_assert_msg(bad == (cases[i].bad == SIZE_MAX ? length : cases[i].bad), "%s: %zu", cases[i].text, bad);
    if (bad == length) ck_assert_msg(!sbfi_base64_is_complete(&reader), "%s", cases[i].text);
  }
}
END_TEST

START_TEST(no_memory_is_reported)
{
  harness_memory memory;
  sbfi_text text;
  harness_memory_init(&memory, 0);
  sbfi_text_init(&text, &memory.allocator);
  ck_assert(!sbfi_base64_encode(&text, (const uint8_t *)"foo", 3));
  ck_assert(text.failed);
  sbfi_text_free(&text);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("base64");
  TCase *c = tcase_create("base64");
  tcase_add_test(c, known_texts_encode_and_decode);
  tcase_add_test(c, all_bytes_survive_any_split);
  tcase_add_test(c, white_space_is_skipped);
  tcase_add_test(c, invalid_characters_are_refused_at_their_offset);
  tcase_add_test(c, no_memory_is_reported);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
