/* Compression and CRC-32 of chunks. The only user of zlib. */
#ifndef SBFI_PACKED_CODEC_H
#define SBFI_PACKED_CODEC_H

#include "base/memory.h"
#include "packed/packed_format.h"

uint32_t sbfi_crc32(const void *bytes, size_t size);

/* Working memory for any number of chunks, one after the other. */
typedef struct sbfi_packed_coder {
  sbf_allocator allocator;
  void *inflater, *deflater; /* created on first use */
  uint8_t *block;            /* one block of planes */
  int level;                 /* zlib's, 1 to 9 */
} sbfi_packed_coder;

void sbfi_packed_coder_init(sbfi_packed_coder *coder, const sbf_allocator *allocator, int level);
void sbfi_packed_coder_free(sbfi_packed_coder *coder);

typedef enum sbfi_coded {
  SBFI_CODED,
  SBFI_CODED_DAMAGED,
  SBFI_CODED_TOO_LONG,
  SBFI_CODED_NO_MEMORY
} sbfi_coded;

/* Inflates `stored` into exactly `raw_size` bytes and undoes the filter (scalars of `width` per item; any
 * value with SBFI_FILTER_NONE). Returns damaged if the stream is broken, too short or followed by more bytes.
 */
sbfi_coded sbfi_packed_inflate(sbfi_packed_coder *coder, const uint8_t *stored, size_t stored_size,
    sbfi_packed_filter filter, uint32_t width, uint8_t *to, size_t raw_size);

/* Filters and deflates into at most `capacity` bytes. Returns too long if they do not suffice or the filter
 * does not apply to such scalars. */
sbfi_coded sbfi_packed_deflate(sbfi_packed_coder *coder, const uint8_t *raw, size_t raw_size,
    sbfi_packed_filter filter, uint32_t width, uint8_t *to, size_t capacity, size_t *stored_size);

#endif
