#include "harness.h"

#include <string.h>

#include "base/crc32_fold.h"
#include "random.h"

enum { SIZE = 1200, OFFSETS = 16 };

/* Bit by bit, as the definition has it. */
static uint32_t crc_of(uint32_t crc, const uint8_t *bytes, size_t size) {
  crc = ~crc;
  for (size_t i = 0; i < size; i++) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0);
  }
  return ~crc;
}

static void fill(uint8_t *bytes, size_t size) {
  uint32_t random = 7;
  for (size_t i = 0; i < size; i++) { bytes[i] = (uint8_t)(random_next(&random) >> 24); }
}

START_TEST(the_reference_is_crc_32)
{ ck_assert_uint_eq(crc_of(0, (const uint8_t *)"123456789", 9), 0xCBF43926u); }
END_TEST

START_TEST(folded_and_remaining_bytes_give_the_same_crc)
{
  static uint8_t bytes[SIZE + OFFSETS];
  fill(bytes, sizeof bytes);
  uint32_t begun = 0;
  for (size_t size = 0; size <= SIZE; size++) {
    const uint8_t *from = bytes + size % OFFSETS;
    uint8_t folded[SBFI_CRC32_FOLDED];
    size_t done = sbfi_crc32_fold(begun, from, size, folded);
    ck_assert_uint_le(done, size);
    if (size < 64) ck_assert_uint_eq(done, 0);
    uint32_t crc = done ? crc_of(0xFFFFFFFF, folded, sizeof folded) : begun;
    crc = crc_of(crc, from + done, size - done);
    ck_assert_msg(crc == crc_of(begun, from, size), "%zu bytes, begun with %08x", size, begun);
    begun = crc;
  }
}
END_TEST

START_TEST(every_full_block_is_folded)
{
  static uint8_t bytes[SIZE];
  uint8_t folded[SBFI_CRC32_FOLDED];
  fill(bytes, sizeof bytes);
  size_t done = sbfi_crc32_fold(0, bytes, SIZE, folded);
  if (done) ck_assert_uint_lt(SIZE - done, 16);
}
END_TEST

int main(void) {
  Suite *s = suite_create("crc32_fold");
  TCase *c = tcase_create("crc32_fold");
  tcase_add_test(c, the_reference_is_crc_32);
  tcase_add_test(c, folded_and_remaining_bytes_give_the_same_crc);
  tcase_add_test(c, every_full_block_is_folded);
  suite_add_tcase(s, c);
  return harness_run(s);
}
