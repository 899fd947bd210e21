/* What a packed file will hold: every chunk with its bytes, before places in the file are given out. */
#ifndef SBFI_PACKED_PLAN_H
#define SBFI_PACKED_PLAN_H

#include "base/text.h"
#include "packed/packed_codec.h"
#include "sbfmt/model.h"

typedef struct sbfi_planned_chunk {
  sbfi_packed_chunk chunk; /* offset 0 */
  const void *at;          /* its stored bytes: the asset's, or the plan's */
  sbfi_item item;          /* what a list is made of; SBFI_ITEM_U8 for a record */
} sbfi_planned_chunk;

typedef struct sbfi_packed_plan {
  sbfi_array chunks; /* sbfi_planned_chunk: records of all parts, then lists */
  sbfi_text records; /* bytes of the records, one after the other */
  sbfi_arena arena;  /* bytes of what was compressed */
} sbfi_packed_plan;

typedef enum sbfi_planned { SBFI_PLANNED, SBFI_PLANNED_NO_MEMORY, SBFI_PLANNED_TOO_LARGE } sbfi_planned;

/* Plans all chunks, none of them compressed yet; with a coder (may be NULL) they are made to be. The asset
 * must stay as it is while the plan lives. Free the plan whatever is returned; too large where a record would
 * pass 4 GiB. */
sbfi_planned sbfi_packed_plan_make(
    sbfi_packed_plan *plan, const sbf_asset *asset, sbfi_packed_coder *coder, const sbf_allocator *allocator);
void sbfi_packed_plan_free(sbfi_packed_plan *plan);

/* Compresses what becomes smaller by it, each list with the filter that serves it best. */
sbfi_planned sbfi_packed_plan_compress(sbfi_packed_plan *plan, sbfi_packed_coder *coder);

static inline sbfi_planned_chunk *sbfi_packed_plan_chunk(const sbfi_packed_plan *plan, size_t number) {
  return (sbfi_planned_chunk *)plan->chunks.at + number;
}

#endif
