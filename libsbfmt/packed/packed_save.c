/* Saves assets to packed files. */
#include "base/diagnostic.h"
#include "base/file.h"
#include "model/asset_box.h"
#include "model/check.h"
#include "model/options.h"
#include "model/version.h"
#include "packed/packed_codec.h"
#include "packed/packed_filter.h"
#include "packed/packed_plan.h"
#include "packed/packed_table.h"

typedef struct layout {
  sbf_asset stated; /* the asset with the version to write */
  char version[SBFI_VERSION_TEXT];
  sbfi_packed_plan plan;
  sbfi_packed_header header;
  uint8_t *front; /* header and table as bytes */
  size_t front_size;
} layout;

static sbf_status diagnose_plan(sbfi_planned planned, sbf_diagnostic *error) {
  switch (planned) {
  case SBFI_PLANNED:
    return SBF_OK;
  case SBFI_PLANNED_NO_MEMORY:
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory to pack the asset");
  default:
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "the asset has too many parts, or a part whose record exceeds 4 GiB: divide it");
  }
}

static uint64_t align(uint64_t offset) {
  return (offset + SBFI_PACKED_ALIGN - 1) / SBFI_PACKED_ALIGN * SBFI_PACKED_ALIGN;
}

static uint16_t minor_of(const char *version) {
  uint32_t minor = sbfi_version_minor(version);
  return (uint16_t)(minor < UINT16_MAX ? minor : UINT16_MAX);
}

/* Converts scalars to little-endian; no effect on a little-endian machine. */
static bool order_bytes(sbfi_packed_plan *plan) {
  if (sbfi_host_is_little_endian()) return true;
  for (size_t i = 0; i < plan->chunks.count; i++) {
    sbfi_planned_chunk *planned = sbfi_packed_plan_chunk(plan, i);
    const sbfi_packed_chunk *chunk = &planned->chunk;
    if (planned->item == SBFI_ITEM_U8 || chunk->codec != SBFI_CODEC_NONE) continue;
    void *copy = sbfi_arena_copy(&plan->arena, planned->at, (size_t)chunk->count, chunk->stride);
    if (!copy) return false;
    sbfi_scalars_to_host(copy, (size_t)chunk->raw_size / 4);
    planned->at = copy;
  }
  return true;
}

/* Assigns offsets: header, table, then the chunks in order. */
static sbf_status assign_offsets(layout *l, sbf_diagnostic *error) {
  size_t count = l->plan.chunks.count;
  l->front_size = SBFI_PACKED_HEADER_SIZE + count * SBFI_PACKED_ENTRY_SIZE;
  l->front = sbfi_arena_allocate(&l->plan.arena, 1, l->front_size);
  if (!l->front || !order_bytes(&l->plan)) return diagnose_plan(SBFI_PLANNED_NO_MEMORY, error);
  uint64_t offset = l->front_size;
  uint8_t *table = l->front + SBFI_PACKED_HEADER_SIZE;
  for (size_t i = 0; i < count; i++) {
    sbfi_planned_chunk *planned = sbfi_packed_plan_chunk(&l->plan, i);
    planned->chunk.offset = align(offset);
    planned->chunk.crc = sbfi_crc32(planned->at, (size_t)planned->chunk.stored_size);
    offset = planned->chunk.offset + planned->chunk.stored_size;
    sbfi_packed_chunk_put(table + i * SBFI_PACKED_ENTRY_SIZE, &planned->chunk);
  }
  l->header = (sbfi_packed_header){.major = SBFI_PACKED_MAJOR,
      .minor = minor_of(l->stated.version),
      .min_major = SBFI_PACKED_MAJOR,
      .file_size = offset,
      .table_offset = SBFI_PACKED_HEADER_SIZE,
      .table_size = count * SBFI_PACKED_ENTRY_SIZE,
      .chunk_count = (uint32_t)count};
  l->header.table_crc = sbfi_crc32(table, (size_t)l->header.table_size);
  sbfi_packed_header_put(l->front, &l->header);
  return SBF_OK;
}

static sbf_status make_layout(layout *l, const sbf_asset *asset, const sbf_save_options *options,
    const sbf_allocator *allocator, sbf_diagnostic *error) {
  sbf_status status = sbfi_check_saved(asset, error);
  if (status != SBF_OK) return status;
  l->stated = *asset;
  l->stated.version = sbfi_version_to_state(asset, l->version);
  sbfi_packed_coder coder;
  sbfi_packed_coder_init(&coder, allocator, options->level);
  sbfi_planned planned =
      sbfi_packed_plan_make(&l->plan, &l->stated, options->store ? NULL : &coder, allocator);
  if (planned == SBFI_PLANNED && !options->store) planned = sbfi_packed_plan_compress(&l->plan, &coder);
  sbfi_packed_coder_free(&coder);
  status = diagnose_plan(planned, error);
  if (status == SBF_OK) status = assign_offsets(l, error);
  if (status != SBF_OK) sbfi_packed_plan_free(&l->plan);
  return status;
}

typedef sbf_status (*write_function)(void *to, const void *bytes, size_t size, sbf_diagnostic *error);

static sbf_status write_layout(const layout *l, write_function write, void *to, sbf_diagnostic *error) {
  static const uint8_t zeros[SBFI_PACKED_ALIGN];
  sbf_status status = write(to, l->front, l->front_size, error);
  uint64_t offset = l->front_size;
  for (size_t i = 0; i < l->plan.chunks.count && status == SBF_OK; i++) {
    const sbfi_planned_chunk *planned = sbfi_packed_plan_chunk(&l->plan, i);
    status = write(to, zeros, (size_t)(planned->chunk.offset - offset), error);
    if (status == SBF_OK) status = write(to, planned->at, (size_t)planned->chunk.stored_size, error);
    offset = planned->chunk.offset + planned->chunk.stored_size;
  }
  return status;
}

static sbf_status write_to_file(void *to, const void *bytes, size_t size, sbf_diagnostic *error) {
  return size ? sbfi_file_writer_write(to, bytes, size, error) : SBF_OK;
}

static sbf_status write_to_buffer(void *to, const void *bytes, size_t size, sbf_diagnostic *error) {
  sbf_buffer *buffer = to;
  (void)error;
  if (size) memcpy(buffer->at + buffer->size, bytes, size);
  buffer->size += size;
  return SBF_OK;
}

sbf_status sbf_packed_save_file(
    const sbf_asset *asset, const char *path, const sbf_save_options *options, sbf_diagnostic *error) {
  sbf_save_options filled = sbfi_save_options_of(options);
  layout l = {0};
  sbfi_file_writer writer;
  const sbf_allocator *allocator = &sbfi_asset_box_of(asset)->arena.allocator;
  sbf_status status = make_layout(&l, asset, &filled, allocator, error);
  if (status == SBF_OK) {
    status = sbfi_file_writer_open(&writer, path, allocator, error);
    if (status == SBF_OK) {
      status = write_layout(&l, write_to_file, &writer, error);
      if (status == SBF_OK)
        status = sbfi_file_writer_commit(&writer, error);
      else
        sbfi_file_writer_abandon(&writer);
    }
    sbfi_packed_plan_free(&l.plan);
  }
  if (status != SBF_OK && error) sbfi_copy_text(error->file, sizeof error->file, path);
  return status;
}

sbf_status sbf_packed_save_memory(const sbf_asset *asset, const sbf_save_options *options,
    const sbf_allocator *allocator, sbf_buffer *buffer, sbf_diagnostic *error) {
  sbf_save_options filled = sbfi_save_options_of(options);
  layout l = {0};
  *buffer = (sbf_buffer){.allocator = sbfi_allocator_or_default(allocator)};
  sbf_status status = make_layout(&l, asset, &filled, &buffer->allocator, error);
  if (status != SBF_OK) return status;
  size_t size = (size_t)l.header.file_size;
  if (l.header.file_size <= SIZE_MAX) buffer->at = sbfi_allocate(&buffer->allocator, size);
  if (buffer->at) {
    buffer->capacity = size;
    status = write_layout(&l, write_to_buffer, buffer, error);
  } else {
    status = diagnose_plan(SBFI_PLANNED_NO_MEMORY, error);
  }
  sbfi_packed_plan_free(&l.plan);
  return status;
}
