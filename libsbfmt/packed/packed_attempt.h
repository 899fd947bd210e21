/* Tries filters on the same bytes and keeps the smallest result. */
#ifndef SBFI_PACKED_ATTEMPT_H
#define SBFI_PACKED_ATTEMPT_H

#include "packed/packed_codec.h"

typedef struct sbfi_packed_attempt {
  uint8_t *best, *spare; /* each has the capacity passed to the attempts */
  size_t size;           /* size of the best; 0: none was small enough */
  sbfi_packed_filter filter;
} sbfi_packed_attempt;

/* Tries one filter on items of `stride` bytes. Initialise `best` and `spare` with memory and the rest with 0.
 * Keeps the result if it is smaller than the best so far and fits into `capacity`; the first of equal results
 * wins. False if memory runs out. */
bool sbfi_packed_try(sbfi_packed_attempt *attempt, sbfi_packed_coder *coder, const void *items, size_t size,
    uint32_t stride, sbfi_packed_filter filter, size_t capacity);

/* Finds the filter (none, planes or delta) with which items of fewer than SBFI_PACKED_CHUNK_FROM_COMPRESSED
 * bytes deflate best; none if no filter makes them smaller than `size`. False if memory runs out. */
bool sbfi_packed_best_filter(
    sbfi_packed_coder *coder, const void *items, size_t size, uint32_t stride, sbfi_packed_filter *filter);

#endif
