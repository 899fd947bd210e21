/* Packed files changed on purpose: numbers put anywhere, and the checksums made right again, so that a test
 * reaches the checks behind them. */
#ifndef TEST_PACKED_PATCH_H
#define TEST_PACKED_PATCH_H

#include <stddef.h>
#include <stdint.h>

/* Where a field of chunk `number`'s table entry lies in a file whose table follows its header. */
static inline size_t patch_entry(uint32_t number, size_t field) {
  return 64 + (size_t)number * 64 + field;
}

/* Fields of a table entry, for patch_entry. */
enum {
  PATCH_KIND = 0,
  PATCH_OWNER = 4,
  PATCH_LEVEL = 8,
  PATCH_FIELD = 12,
  PATCH_LIST = 14,
  PATCH_FILTER = 16,
  PATCH_CODEC = 17,
  PATCH_FLAGS = 18,
  PATCH_STRIDE = 20,
  PATCH_OFFSET = 24,
  PATCH_STORED_SIZE = 32,
  PATCH_RAW_SIZE = 40,
  PATCH_COUNT = 48,
  PATCH_CRC = 56,
  PATCH_RESERVED = 60
};

uint64_t patch_get(const uint8_t *bytes, size_t offset, int size); /* little-endian, `size` bytes */
void patch_put(uint8_t *bytes, size_t offset, int size, uint64_t value);

/* Makes the checksums of all chunks, the table and the header those of the bytes as they are; a chunk or
 * table that does not lie in the file is left alone. */
void patch_seal(uint8_t *bytes, size_t size);

#endif
