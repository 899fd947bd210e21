/* The only place that knows zlib: chunks to bytes and back, and CRC-32. */
#ifndef SBFI_PACKED_CODEC_H
#define SBFI_PACKED_CODEC_H

#include "base/memory.h"
#include "packed/packed_format.h"

uint32_t sbfi_crc32(const void *bytes, size_t size);

/* Working memory for any number of chunks, one after the other. */
typedef struct sbfi_packed_coder {
  sbf_allocator allocator;
  void *inflater, *deflater; /* made when first needed */
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

/* Inflates all of `stored` into exactly `raw_size` bytes, the filter undone (scalars of `width` in an item;
 * with SBFI_FILTER_NONE anything). Damaged: the stream is broken, ends early, or has more behind it. */
sbfi_coded sbfi_packed_inflate(sbfi_packed_coder *coder, const uint8_t *stored, size_t stored_size,
    sbfi_packed_filter filter, uint32_t width, uint8_t *to, size_t raw_size);

/* Filters and deflates into `room` bytes; too long where they do not suffice, or where the filter is not for
 * such scalars. */
sbfi_coded sbfi_packed_deflate(sbfi_packed_coder *coder, const uint8_t *raw, size_t raw_size,
    sbfi_packed_filter filter, uint32_t width, uint8_t *to, size_t room, size_t *stored_size);

#endif
