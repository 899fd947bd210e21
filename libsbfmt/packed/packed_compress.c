/* Selects which chunks to compress and with which filter. The result is deterministic for equal content,
 * level and zlib version. */
#include "packed/packed_attempt.h"
#include "packed/packed_plan.h"

/* Greatest size of a compressed chunk: it must save a block of alignment and a sixteenth. Otherwise the chunk
 * stays uncompressed and is used in place. */
static size_t compressed_capacity(size_t raw_size) {
  size_t aligned = (raw_size + SBFI_PACKED_ALIGN - 1) / SBFI_PACKED_ALIGN * SBFI_PACKED_ALIGN;
  size_t by_blocks = aligned - SBFI_PACKED_ALIGN, by_fraction = raw_size - raw_size / 16;
  return by_blocks < by_fraction ? by_blocks : by_fraction;
}

static bool try_filters(sbfi_packed_attempt *attempt, sbfi_packed_coder *coder,
    const sbfi_planned_chunk *planned, size_t capacity) {
  bool is_record = planned->item == SBFI_ITEM_U8, is_index = planned->item == SBFI_ITEM_U32;
  int first = is_record ? SBFI_FILTER_NONE : SBFI_FILTER_PLANES;
  int last = is_record ? SBFI_FILTER_NONE : is_index ? SBFI_FILTER_RECENT : SBFI_FILTER_DELTA;
  for (int f = first; f <= last; f++)
    if (!sbfi_packed_try(attempt, coder, planned->at, (size_t)planned->chunk.raw_size, planned->chunk.stride,
            (sbfi_packed_filter)f, capacity))
      return false;
  return true;
}

static sbfi_planned compress_chunk(
    sbfi_packed_plan *plan, sbfi_packed_coder *coder, sbfi_planned_chunk *planned, uint8_t *memory[2]) {
  size_t capacity = compressed_capacity((size_t)planned->chunk.raw_size);
  sbfi_packed_attempt attempt = {.best = memory[0], .spare = memory[1]};
  if (capacity == 0) return SBFI_PLANNED;
  if (!try_filters(&attempt, coder, planned, capacity)) return SBFI_PLANNED_NO_MEMORY;
  if (attempt.size == 0) return SBFI_PLANNED;
  void *kept = sbfi_arena_copy(&plan->arena, attempt.best, attempt.size, 1);
  if (!kept) return SBFI_PLANNED_NO_MEMORY;
  planned->at = kept;
  planned->chunk.stored_size = attempt.size;
  planned->chunk.filter = (uint8_t)attempt.filter;
  planned->chunk.codec = SBFI_CODEC_ZLIB;
  return SBFI_PLANNED;
}

sbfi_planned sbfi_packed_plan_compress(sbfi_packed_plan *plan, sbfi_packed_coder *coder) {
  sbf_allocator *allocator = &plan->arena.allocator;
  size_t capacity = 1;
  for (size_t i = 0; i < plan->chunks.count; i++) {
    size_t needed = compressed_capacity((size_t)sbfi_packed_plan_chunk(plan, i)->chunk.raw_size);
    if (needed > capacity) capacity = needed;
  }
  uint8_t *memory[2] = {sbfi_allocate(allocator, capacity), sbfi_allocate(allocator, capacity)};
  sbfi_planned result = memory[0] && memory[1] ? SBFI_PLANNED : SBFI_PLANNED_NO_MEMORY;
  for (size_t i = 0; i < plan->chunks.count && result == SBFI_PLANNED; i++)
    result = compress_chunk(plan, coder, sbfi_packed_plan_chunk(plan, i), memory);
  sbfi_free(allocator, memory[0], capacity);
  sbfi_free(allocator, memory[1], capacity);
  return result;
}
