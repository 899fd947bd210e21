/* Which chunks are compressed, and how: the same bytes for the same content, level and zlib. */
#include "packed/packed_codec.h"
#include "packed/packed_plan.h"

/* The bytes that a compressed chunk may take: one block of alignment less than before, and a sixteenth, or it
 * is better left as it is and used in place. */
static size_t room_of(size_t raw_size) {
  size_t aligned = (raw_size + SBFI_PACKED_ALIGN - 1) / SBFI_PACKED_ALIGN * SBFI_PACKED_ALIGN;
  size_t by_blocks = aligned - SBFI_PACKED_ALIGN, by_share = raw_size - raw_size / 16;
  return by_blocks < by_share ? by_blocks : by_share;
}

typedef struct attempt {
  uint8_t *at;
  size_t size;
  sbfi_packed_filter filter;
} attempt;

/* Tries one filter; where it beats the best so far, the two exchange their memory. */
static sbfi_planned try_filter(sbfi_packed_coder *coder, const sbfi_planned_chunk *planned,
    sbfi_packed_filter filter, uint8_t **spare, attempt *best, size_t room) {
  size_t size, limit = best->size ? best->size - 1 : room;
  sbfi_coded coded = sbfi_packed_deflate(coder, planned->at, (size_t)planned->chunk.raw_size, filter,
      planned->chunk.stride / 4, *spare, limit, &size);
  if (coded == SBFI_CODED_NO_MEMORY) return SBFI_PLANNED_NO_MEMORY;
  if (coded != SBFI_CODED) return SBFI_PLANNED;
  uint8_t *beaten = best->at;
  *best = (attempt){*spare, size, filter};
  *spare = beaten;
  return SBFI_PLANNED;
}

static sbfi_planned compress_chunk(
    sbfi_packed_plan *plan, sbfi_packed_coder *coder, sbfi_planned_chunk *planned, uint8_t *memory[2]) {
  size_t room = room_of((size_t)planned->chunk.raw_size);
  attempt best = {.at = memory[0]};
  uint8_t *spare = memory[1];
  sbfi_planned result = SBFI_PLANNED;
  if (room == 0) return result;
  if (planned->item == SBFI_ITEM_U8) {
    result = try_filter(coder, planned, SBFI_FILTER_NONE, &spare, &best, room);
  } else {
    result = try_filter(coder, planned, SBFI_FILTER_PLANES, &spare, &best, room);
    if (result == SBFI_PLANNED) result = try_filter(coder, planned, SBFI_FILTER_DELTA, &spare, &best, room);
    if (result == SBFI_PLANNED && planned->item == SBFI_ITEM_U32)
      result = try_filter(coder, planned, SBFI_FILTER_RECENT, &spare, &best, room);
  }
  if (result != SBFI_PLANNED || best.size == 0) return result;
  void *kept = sbfi_arena_copy(&plan->arena, best.at, best.size, 1);
  if (!kept) return SBFI_PLANNED_NO_MEMORY;
  planned->at = kept;
  planned->chunk.stored_size = best.size;
  planned->chunk.filter = (uint8_t)best.filter;
  planned->chunk.codec = SBFI_CODEC_ZLIB;
  return SBFI_PLANNED;
}

sbfi_planned sbfi_packed_best_filter(
    sbfi_packed_coder *coder, const void *items, size_t size, uint32_t stride, sbfi_packed_filter *filter) {
  uint8_t memory[2][SBFI_PACKED_CHUNK_FROM_COMPRESSED], *spare = memory[1];
  const sbfi_planned_chunk planned = {.chunk = {.stride = stride, .raw_size = size}, .at = items};
  attempt best = {.at = memory[0]};
  sbfi_planned result = SBFI_PLANNED;
  for (int f = SBFI_FILTER_NONE; f <= SBFI_FILTER_DELTA && result == SBFI_PLANNED; f++)
    result = try_filter(coder, &planned, (sbfi_packed_filter)f, &spare, &best, size - 1);
  *filter = best.filter;
  return result;
}

sbfi_planned sbfi_packed_plan_compress(sbfi_packed_plan *plan, sbfi_packed_coder *coder) {
  sbf_allocator *allocator = &plan->arena.allocator;
  size_t room = 1;
  for (size_t i = 0; i < plan->chunks.count; i++) {
    size_t needed = room_of((size_t)sbfi_packed_plan_chunk(plan, i)->chunk.raw_size);
    if (needed > room) room = needed;
  }
  uint8_t *memory[2] = {sbfi_allocate(allocator, room), sbfi_allocate(allocator, room)};
  sbfi_planned result = memory[0] && memory[1] ? SBFI_PLANNED : SBFI_PLANNED_NO_MEMORY;
  for (size_t i = 0; i < plan->chunks.count && result == SBFI_PLANNED; i++)
    result = compress_chunk(plan, coder, sbfi_packed_plan_chunk(plan, i), memory);
  sbfi_free(allocator, memory[0], room);
  sbfi_free(allocator, memory[1], room);
  return result;
}
