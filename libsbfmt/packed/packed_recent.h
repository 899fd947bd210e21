/* Filter for indices: neighbouring elements refer to the same points, so most indices are among the most
 * recent distinct ones. These are stored as one byte, an index into a list that moves each used value to
 * its front (move-to-front coding: Bentley, Sleator, Tarjan and Wei 1986); the others as differences. */
#ifndef SBFI_PACKED_RECENT_H
#define SBFI_PACKED_RECENT_H

#include "sbfmt/base.h"

/* Length of the move-to-front list. 16 to 64 differ by a few per cent on lattices, springs and polygons. */
enum { SBFI_RECENT_COUNT = 32 };

/* Encodes a block of `count` scalars from `from` + `done` on into count * 4 bytes. Returns false if too
 * many values are new to fit. */
bool sbfi_filter_recent(const uint8_t *from, size_t done, size_t count, uint8_t *block);

/* Undoes the filter; false if the block is invalid. */
bool sbfi_unfilter_recent(const uint8_t *block, size_t count, uint8_t *to, size_t done);

#endif
