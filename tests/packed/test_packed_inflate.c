#include "packed/packed_inflate.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "harness.h"

enum { MAX = 300000 };

static uint32_t state;
static uint32_t chance(void) {
  state = state * 1664525 + 1013904223;
  return state >> 8;
}

/* Bytes of several kinds: noise, runs, words that come back from near and far. */
static uint8_t *content(uint32_t seed, size_t size) {
  uint8_t *bytes = malloc(size + 1);
  state = seed;
  for (size_t i = 0; i < size;) {
    uint32_t kind = chance() % 4, length = 1 + chance() % 700;
    uint8_t value = (uint8_t)chance();
    size_t back = i ? 1 + chance() % i : 0;
    for (uint32_t k = 0; k < length && i < size; k++, i++)
      bytes[i] = kind == 0   ? (uint8_t)chance()
                 : kind == 1 ? value
                 : kind == 2 ? (uint8_t)("aeiou st"[chance() % 8])
                 : back      ? bytes[i - back]
                             : 0;
  }
  return bytes;
}

static size_t deflated(
    const uint8_t *bytes, size_t size, int level, int strategy, uint8_t *to, size_t capacity) {
  z_stream stream = {.next_in = (Bytef *)(uintptr_t)bytes,
      .avail_in = (uInt)size,
      .next_out = to,
      .avail_out = (uInt)capacity};
  ck_assert_int_eq(deflateInit2(&stream, level, Z_DEFLATED, 15, 8, strategy), Z_OK);
  ck_assert_int_eq(deflate(&stream, Z_FINISH), Z_STREAM_END);
  deflateEnd(&stream);
  return capacity - stream.avail_out;
}

START_TEST(test_zlib_streams_are_inflated)
{
  static const size_t sizes[] = {0, 1, 2, 100, 5000, 70000, MAX};
  static const int strategies[] = {Z_DEFAULT_STRATEGY, Z_FILTERED, Z_HUFFMAN_ONLY, Z_RLE, Z_FIXED};
  uint8_t *stored = malloc(2 * MAX), *back = malloc(MAX + 1);
  for (uint32_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
    for (int level = 0; level <= 9; level += 3)
      for (uint32_t s = 0; s < sizeof strategies / sizeof *strategies; s++) {
        uint8_t *bytes = content(7 * i + s, sizes[i]);
        size_t size = deflated(bytes, sizes[i], level, strategies[s], stored, 2 * MAX);
        back[sizes[i]] = 0xee;
        ck_assert_msg(sbfi_inflate(stored, size, back, sizes[i]), "%zu bytes, level %d, strategy %d",
            sizes[i], level, strategies[s]);
        ck_assert(memcmp(back, bytes, sizes[i]) == 0 && back[sizes[i]] == 0xee);
        free(bytes);
      }
  free(stored);
  free(back);
}
END_TEST

/* zlib and we take the same streams for whole, and make the same of them. */
START_TEST(test_broken_streams_are_refused_as_zlib_does)
{
  enum { SIZE = 3000 };
  uint32_t refused = 0, tried = 0;
  for (int strategy = Z_DEFAULT_STRATEGY; strategy <= Z_FIXED; strategy++) {
    uint8_t *bytes = content(99 + (uint32_t)strategy, SIZE);
    uint8_t stored[2 * SIZE];
    size_t size = deflated(bytes, SIZE, 9, strategy, stored, sizeof stored);
    for (size_t cut = 0; cut < size; cut++) { /* blocks of their own, so that reading beyond is seen */
      uint8_t *part = malloc(cut + 1), *back = malloc(SIZE);
      memcpy(part, stored, cut);
      ck_assert(!sbfi_inflate(part, cut, back, SIZE));
      free(part);
      free(back);
    }
    for (int i = 0; i < 20000; i++, tried++) {
      uint8_t *broken = malloc(size), *ours = calloc(SIZE, 1), theirs[SIZE];
      memcpy(broken, stored, size);
      for (uint32_t k = 1 + chance() % 3; k > 0; k--) broken[chance() % size] ^= (uint8_t)(1 << chance() % 8);
      uLongf made = SIZE;
      uLong taken = (uLong)size;
      bool good = uncompress2(theirs, &made, broken, &taken) == Z_OK && made == SIZE && taken == size;
      ck_assert_int_eq(sbfi_inflate(broken, size, ours, SIZE), good);
      if (good) ck_assert_mem_eq(ours, theirs, SIZE);
      refused += !good;
      free(broken);
      free(ours);
    }
    uint8_t back[SIZE + 1];
    stored[size] = 0;
    ck_assert(!sbfi_inflate(stored, size + 1, back, SIZE));
    ck_assert(!sbfi_inflate(stored, size, back, SIZE - 1));
    ck_assert(!sbfi_inflate(stored, size, back, SIZE + 1));
    free(bytes);
  }
  ck_assert_uint_gt(refused, tried / 2);
}
END_TEST

int main(void) {
  Suite *s = suite_create("packed inflate");
  TCase *c = tcase_create("packed inflate");
  tcase_add_test(c, test_zlib_streams_are_inflated);
  tcase_add_test(c, test_broken_streams_are_refused_as_zlib_does);
  suite_add_tcase(s, c);
  return harness_run(s);
}
