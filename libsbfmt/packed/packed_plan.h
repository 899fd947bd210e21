/* Plan of a packed file: all chunks and their bytes, before offsets are assigned. */
#ifndef SBFI_PACKED_PLAN_H
#define SBFI_PACKED_PLAN_H

#include "base/text.h"
#include "packed/packed_codec.h"
#include "sbfmt/model.h"

typedef struct sbfi_planned_chunk {
  sbfi_packed_chunk chunk; /* offset 0 */
  const void *at;          /* stored bytes, owned by the asset or the plan */
  sbfi_item item;          /* item type of a list; SBFI_ITEM_U8 for a record */
} sbfi_planned_chunk;

typedef struct sbfi_packed_plan {
  sbfi_array chunks; /* sbfi_planned_chunk: records of all parts, then lists */
  sbfi_text records; /* bytes of the records, concatenated */
  sbfi_arena arena;  /* compressed bytes */
} sbfi_packed_plan;

typedef enum sbfi_planned { SBFI_PLANNED, SBFI_PLANNED_NO_MEMORY, SBFI_PLANNED_TOO_LARGE } sbfi_planned;

/* Plans all chunks, uncompressed. With a coder (may be NULL) chunk sizes are chosen for compression. The
 * asset must not change while the plan exists. Free the plan after any result. Returns too large if a record
 * would exceed 4 GiB. */
sbfi_planned sbfi_packed_plan_make(
    sbfi_packed_plan *plan, const sbf_asset *asset, sbfi_packed_coder *coder, const sbf_allocator *allocator);
void sbfi_packed_plan_free(sbfi_packed_plan *plan);

/* Compresses the chunks that become smaller, each list with its best filter. */
sbfi_planned sbfi_packed_plan_compress(sbfi_packed_plan *plan, sbfi_packed_coder *coder);

static inline sbfi_planned_chunk *sbfi_packed_plan_chunk(const sbfi_packed_plan *plan, size_t number) {
  return (sbfi_planned_chunk *)plan->chunks.at + number;
}

#endif
