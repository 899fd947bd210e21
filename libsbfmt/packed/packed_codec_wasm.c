/* Codec for targets without zlib: reads chunks of every codec, writes them uncompressed. */
#include "packed/packed_codec.h"
#include "packed/packed_filter.h"
#include "packed/packed_inflate.h"

enum { BLOCK_BYTES = SBFI_FILTER_BLOCK * 4 };

uint32_t sbfi_crc32(const void *bytes, size_t size) {
  static const uint32_t nibbles[16] = {0, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4,
      0x4DB26158, 0x5005713C, 0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C, 0x9B64C2B0, 0x86D3D2D4,
      0xA00AE278, 0xBDBDF21C};
  const uint8_t *at = bytes;
  uint32_t crc = 0xFFFFFFFF;
  for (; size; size--) {
    crc ^= *at++;
    crc = nibbles[crc & 15] ^ crc >> 4;
    crc = nibbles[crc & 15] ^ crc >> 4;
  }
  return ~crc;
}

void sbfi_packed_coder_init(sbfi_packed_coder *coder, const sbf_allocator *allocator, int level) {
  *coder = (sbfi_packed_coder){.allocator = sbfi_allocator_or_default(allocator), .level = level};
}

void sbfi_packed_coder_free(sbfi_packed_coder *coder) {
  (void)coder;
}

sbfi_coded sbfi_packed_inflate(sbfi_packed_coder *coder, const uint8_t *stored, size_t stored_size,
    sbfi_packed_filter filter, uint32_t width, uint8_t *to, size_t raw_size) {
  if (!filter) return sbfi_inflate(stored, stored_size, to, raw_size) ? SBFI_CODED : SBFI_CODED_DAMAGED;
  uint8_t *planes = sbfi_allocate(&coder->allocator, raw_size);
  if (!planes && raw_size) return SBFI_CODED_NO_MEMORY;
  bool sound = sbfi_inflate(stored, stored_size, planes, raw_size);
  for (size_t done = 0; sound && done < raw_size; done += BLOCK_BYTES) {
    size_t some = raw_size - done < BLOCK_BYTES ? raw_size - done : BLOCK_BYTES;
    sound = sbfi_unfilter_block(filter, planes + done, some / 4, width, to, done / 4);
  }
  sbfi_free(&coder->allocator, planes, raw_size);
  return sound ? SBFI_CODED : SBFI_CODED_DAMAGED;
}

sbfi_coded sbfi_packed_deflate(sbfi_packed_coder *coder, const uint8_t *raw, size_t raw_size,
    sbfi_packed_filter filter, uint32_t width, uint8_t *to, size_t capacity, size_t *stored_size) {
  (void)coder, (void)raw, (void)raw_size, (void)filter, (void)width, (void)to, (void)capacity;
  *stored_size = 0;
  return SBFI_CODED_TOO_LONG;
}
