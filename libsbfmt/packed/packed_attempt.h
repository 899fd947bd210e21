/* How small bytes become by a filter: attempts at the same bytes, of which the smallest is kept. */
#ifndef SBFI_PACKED_ATTEMPT_H
#define SBFI_PACKED_ATTEMPT_H

#include "packed/packed_codec.h"

typedef struct sbfi_packed_attempt {
  uint8_t *best, *spare; /* each as large as the room that is given to tries */
  size_t size;           /* of the best; 0: none has been small enough */
  sbfi_packed_filter filter;
} sbfi_packed_attempt;

/* Tries one filter on items of `stride` bytes, beginning with memory for `best` and `spare` and all else 0.
 * It is kept where it is smaller than what is kept, and needs no more than `room`; of equals the first stays.
 * False where memory runs out. */
bool sbfi_packed_try(sbfi_packed_attempt *attempt, sbfi_packed_coder *coder, const void *items, size_t size,
    uint32_t stride, sbfi_packed_filter filter, size_t room);

/* The filter, among none, planes and delta, with which items of fewer than SBFI_PACKED_CHUNK_FROM_COMPRESSED
 * bytes deflate to the least; none where no filter makes that less than `size`. False where memory runs out.
 */
bool sbfi_packed_best_filter(
    sbfi_packed_coder *coder, const void *items, size_t size, uint32_t stride, sbfi_packed_filter *filter);

#endif
