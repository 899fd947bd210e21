/* Filters: reversible rearrangements that make lists of four-byte scalars easier to compress.
 *
 * A list is cut into blocks; a block of n scalars becomes four planes of n bytes, lowest bytes first.
 * SBFI_FILTER_DELTA first replaces each scalar v by zigzag(v - u), where u is the same component of the
 * previous item (0 before the first), in unsigned 32-bit arithmetic for all types: close neighbours, as
 * integers or as floats of one sign, leave only small bytes. packed_recent.h defines SBFI_FILTER_RECENT.
 * Byte planes are like Blosc's shuffle (https://www.blosc.org), zigzag as in Protocol Buffers. Xor instead
 * of the difference was measured and is never much better. */
#ifndef SBFI_PACKED_FILTER_H
#define SBFI_PACKED_FILTER_H

#include "packed/packed_format.h"

/* Scalars in a block: the planes of one fit in the L2 cache, and items of 1 to 4 scalars never straddle
 * two blocks. */
enum { SBFI_FILTER_BLOCK = 65520 };

/* Unfiltered scalars have native byte order.
 *
 * Filters `count` scalars (SBFI_FILTER_BLOCK at most) from `from` + `done` scalars on into count * 4 bytes
 * of planes. `width` is the number of scalars in an item, 1 to 4; `done` is a multiple of it. Returns
 * false only for SBFI_FILTER_RECENT, if the scalars have too many different values. */
bool sbfi_filter_block(sbfi_packed_filter filter, const uint8_t *from, size_t done, size_t count,
    uint32_t width, uint8_t *planes);

/* Undoes the filter. Reads its own output before `done`. False, for SBFI_FILTER_RECENT only, if the planes
 * are invalid. */
bool sbfi_unfilter_block(
    sbfi_packed_filter filter, const uint8_t *planes, size_t count, uint32_t width, uint8_t *to, size_t done);

/* Swaps the bytes of unfiltered scalars, little-endian in files, on a big-endian machine. */
void sbfi_scalars_to_host(void *at, size_t scalar_count);
bool sbfi_host_is_little_endian(void);

#endif
