#include "packed_patch.h"

#include "packed/packed_codec.h"

uint64_t patch_get(const uint8_t *bytes, size_t offset, int size) {
  uint64_t value = 0;
  for (int i = size; i-- > 0;) value = value << 8 | bytes[offset + (size_t)i];
  return value;
}

void patch_put(uint8_t *bytes, size_t offset, int size, uint64_t value) {
  for (int i = 0; i < size; i++) bytes[offset + (size_t)i] = (uint8_t)(value >> (8 * i));
}

void patch_seal(uint8_t *bytes, size_t size) {
  uint64_t count = patch_get(bytes, 40, 4), table_size = patch_get(bytes, 32, 8);
  for (uint32_t i = 0; i < count && patch_entry(i + 1, 0) <= size; i++) {
    uint64_t offset = patch_get(bytes, patch_entry(i, PATCH_OFFSET), 8);
    uint64_t stored = patch_get(bytes, patch_entry(i, PATCH_STORED_SIZE), 8);
    if (offset <= size && stored <= size - offset)
      patch_put(bytes, patch_entry(i, PATCH_CRC), 4, sbfi_crc32(bytes + offset, (size_t)stored));
  }
  if (table_size <= size - 64) patch_put(bytes, 44, 4, sbfi_crc32(bytes + 64, (size_t)table_size));
  patch_put(bytes, 60, 4, sbfi_crc32(bytes, 60));
}
