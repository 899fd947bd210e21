/* Inflates zlib streams (RFC 1950, 1951) without zlib, for machines that have none. */
#ifndef SBFI_PACKED_INFLATE_H
#define SBFI_PACKED_INFLATE_H

#include "sbfmt/base.h"

/* Inflates all of `stored` into exactly `size` bytes. False: the stream is broken, ends early, makes more or
 * fewer bytes, has another checksum, or more behind it; `to` then holds anything. Needs no memory beyond a
 * few KiB of stack. */
bool sbfi_inflate(const uint8_t *stored, size_t stored_size, uint8_t *to, size_t size);

#endif
