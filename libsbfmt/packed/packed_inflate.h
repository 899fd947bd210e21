/* Inflates zlib streams (RFC 1950, 1951) without zlib, for targets without it. */
#ifndef SBFI_PACKED_INFLATE_H
#define SBFI_PACKED_INFLATE_H

#include "sbfmt/base.h"

/* Inflates all of `stored` into exactly `size` bytes. False if the stream is invalid or truncated, has
 * another size or checksum, or is followed by more bytes; `to` is then undefined. Needs only a few KiB of
 * stack. */
bool sbfi_inflate(const uint8_t *stored, size_t stored_size, uint8_t *to, size_t size);

#endif
