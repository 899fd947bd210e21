#include "harness.h"

#include <string.h>

#include "base/hash64.h"

static uint64_t hash_of(const void *bytes, size_t size, size_t step) {
  sbfi_hash64 hash;
  sbfi_hash64_init(&hash);
  for (size_t at = 0; at < size; at += step)
    sbfi_hash64_add_bytes(&hash, (const char *)bytes + at, size - at < step ? size - at : step);
  return sbfi_hash64_value(&hash);
}

START_TEST(known_inputs_give_known_hashes)
{
  const struct {
    const char *text;
    uint64_t value;
  } known[] = {{"", UINT64_C(0xEF46DB3751D8E999)}, {"a", UINT64_C(0xD24EC4F1A98C6E5B)},
      {"as", UINT64_C(0x1C330FB2D66BE179)}, {"asd", UINT64_C(0x631C37CE72A97393)},
      {"asdf", UINT64_C(0x415872F599CEA71E)}, {"abc", UINT64_C(0x44BC2CF5AD770999)},
      {"Call me Ishmael. Some years ago--never mind how long precisely-", UINT64_C(0x02A2E85470D6FD96)}};
  for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
    for (size_t step = 1; step < 70; step++)
      ck_assert_uint_eq(hash_of(known[i].text, strlen(known[i].text), step), known[i].value);
}
END_TEST

START_TEST(numbers_are_hashed_as_little_endian_bytes)
{
  const uint8_t bytes[] = {1, 2, 3, 4, 0x88, 0x77, 0x66, 0x55, 0x44, 0x33, 0x22, 0x11, 0, 0, 0x80, 0xBF, 0, 0,
      0, 0, 0, 0, 0xF0, 0x3F};
  const uint32_t u32 = 0x04030201;
  const uint64_t u64 = UINT64_C(0x1122334455667788);
  const float f32 = -1;
  const double f64 = 1;
  sbfi_hash64 hash;
  sbfi_hash64_init(&hash);
  sbfi_hash64_add_u32(&hash, &u32, 1);
  sbfi_hash64_add_u64(&hash, &u64, 1);
  sbfi_hash64_add_f32(&hash, &f32, 1);
  sbfi_hash64_add_f64(&hash, &f64, 1);
  ck_assert_uint_eq(sbfi_hash64_value(&hash), hash_of(bytes, sizeof bytes, sizeof bytes));
  ck_assert_uint_eq(sbfi_hash64_value(&hash), hash_of(bytes, sizeof bytes, 5));
}
END_TEST

START_TEST(every_bit_changes_the_value)
{
  float state[33] = {0};
  uint64_t seen[33 * 32 + 1];
  size_t count = 0;
  seen[count++] = hash_of(state, sizeof state, sizeof state);
  for (int i = 0; i < 33; i++) {
    for (int bit = 0; bit < 32; bit++) {
      uint32_t bits = UINT32_C(1) << bit;
      memcpy(&state[i], &bits, 4);
      seen[count] = hash_of(state, sizeof state, sizeof state);
      for (size_t k = 0; k < count; k++)
        if (seen[k] == seen[count]) ck_abort_msg("number %d, bit %d", i, bit);
      count++;
    }
    state[i] = 0;
  }
  ck_assert(hash_of(state, 128, 128) != hash_of(state, 132, 132)); /* the length counts, too */
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("hash64");
  TCase *c = tcase_create("hash64");
  tcase_add_test(c, known_inputs_give_known_hashes);
  tcase_add_test(c, numbers_are_hashed_as_little_endian_bytes);
  tcase_add_test(c, every_bit_changes_the_value);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
