/* Loads packed files. */
#include <stdio.h>

#include "base/diagnostic.h"
#include "base/file.h"
#include "model/asset_box.h"
#include "model/check.h"
#include "model/options.h"
#include "model/version.h"
#include "packed/packed_reader.h"

/* Every chunk of a kind that this version must understand has to be referenced by the asset. */
static sbf_status check_all_used(sbfi_packed_reader *reader) {
  const sbfi_packed_table *table = &reader->table;
  if (table->newer || reader->options.selection) return SBF_OK;
  for (uint32_t i = 0; i < table->chunk_count; i++) {
    const sbfi_packed_chunk *chunk = &table->chunks[i];
    if (reader->used[i] || !sbfi_packed_kind_is_known(chunk->kind)) continue;
    sbf_status status = sbfi_diagnose(reader->error, SBF_CODE_PACKED_TABLE,
        "chunk %u (%s) belongs to no record: the file was not written whole", i,
        sbfi_packed_chunk_name(chunk).text);
    if (reader->error) reader->error->offset = (int64_t)chunk->offset;
    return status;
  }
  return SBF_OK;
}

static sbf_status fault_at(sbfi_packed_reader *reader, sbf_code code, uint64_t offset, const char *message) {
  sbf_status status = sbfi_diagnose(reader->error, code, "%s", message);
  if (reader->error) reader->error->offset = (int64_t)offset;
  return status;
}

/* Gaps are filled with zeros (spec/packed.md, 1); the table may be in one. Other versions may use them. */
static sbf_status check_gap(sbfi_packed_reader *reader, uint64_t begin, uint64_t end) {
  const sbfi_packed_header *h = &reader->table.header;
  for (uint64_t at = begin; at < end && !reader->table.newer; at++) {
    if (at == h->table_offset) at += h->table_size;
    if (at < end && reader->bytes[at])
      return fault_at(reader, SBF_CODE_PACKED_TABLE, at,
          "a byte between two chunks is not zero: the file is damaged, copy it again");
  }
  return SBF_OK;
}

/* Counts unreferenced chunks of kinds from a newer version. */
static void count_unknown_chunks(sbfi_packed_reader *reader) {
  for (uint32_t i = 0; i < reader->table.chunk_count && reader->table.newer; i++) {
    const sbfi_packed_chunk *chunk = &reader->table.chunks[i];
    if (reader->used[i] || sbfi_packed_kind_is_known(chunk->kind) || chunk->kind == SBFI_PACKED_OUTLINE)
      continue;
    if (reader->left_out++ == 0)
      snprintf(reader->first_left_out, sizeof reader->first_left_out, "chunk %u (%s)", i,
          sbfi_packed_chunk_name(chunk).text);
  }
}

/* Checks what a load does not read: the outline, chunks that are not critical, and the gaps. */
static sbf_status check_unread(sbfi_packed_reader *reader) {
  const sbfi_packed_table *table = &reader->table;
  if (!reader->options.check_crc || reader->options.selection || reader->options.outline) return SBF_OK;
  uint64_t end = SBFI_PACKED_HEADER_SIZE;
  for (uint32_t i = 0; i < table->chunk_count; i++) {
    const sbfi_packed_chunk *chunk = &table->chunks[i];
    if (!reader->used[i] &&
        sbfi_crc32(reader->bytes + chunk->offset, (size_t)chunk->stored_size) != chunk->crc)
      return fault_at(reader, SBF_CODE_PACKED_CRC, chunk->offset,
          "a chunk does not match its checksum: the file is damaged, copy it again");
    sbf_status status = check_gap(reader, end, chunk->offset);
    if (status != SBF_OK) return status;
    end = chunk->offset + chunk->stored_size;
  }
  return check_gap(reader, end, table->header.file_size);
}

/* Loads from `bytes`; `*in_place` receives whether the asset points into them. */
/* The header's version defines the known fields, so an asset with an earlier version gets the header's. */
static sbf_status set_header_version(
    sbf_asset *made, const sbfi_packed_header *header, sbf_diagnostic *error) {
  char stated[16];
  snprintf(stated, sizeof stated, "1.%u", header->minor);
  if (sbfi_version_check(stated) != SBFI_VERSION_KNOWN || sbfi_version_minor(made->version) >= header->minor)
    return SBF_OK;
  made->version = sbf_asset_copy_text(made, stated);
  return made->version ? SBF_OK
                       : sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for the version's text");
}

static sbf_status load(const void *bytes, size_t size, const sbf_load_options *options, sbf_asset **asset,
    bool *in_place, sbf_diagnostic *error) {
  if (options->read_bytes) *options->read_bytes = 0;
  sbf_asset *made = sbf_asset_create(options->allocator);
  if (!made) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for an asset");
  sbfi_asset_box *box = sbfi_asset_box_of(made);
  uint64_t limit = options->limits.memory_bytes;
  box->arena.limit_bytes = limit < SIZE_MAX ? (size_t)limit : SIZE_MAX;
  sbfi_packed_reader reader;
  sbf_status status =
      sbfi_packed_reader_open(&reader, bytes, size, options, &box->arena.allocator, &box->arena, error);
  if (status == SBF_OK) {
    status = sbfi_packed_read_asset(&reader, made);
    if (status == SBF_OK) status = check_all_used(&reader);
    if (status == SBF_OK) status = check_unread(&reader);
    if (status == SBF_OK) count_unknown_chunks(&reader);
    *in_place = reader.in_place;
    if (options->read_bytes) *options->read_bytes = reader.read_bytes;
    sbfi_packed_reader_close(&reader);
  }
  if (status == SBF_OK) status = sbfi_check_loaded(made, options, error);
  box->arena.limit_bytes = 0;
  /* Content of a newer version was skipped. */
  if (status == SBF_OK) {
    char stated[16];
    snprintf(stated, sizeof stated, "1.%u", reader.table.header.minor);
    sbfi_report_left_out(options, stated, reader.left_out, reader.first_left_out);
    if (sbfi_version_check(made->version) == SBFI_VERSION_NEWER_MINOR) made->version = SBF_FORMAT_VERSION;
    status = set_header_version(made, &reader.table.header, error);
  }
  if (status != SBF_OK) {
    sbf_asset_free(made);
    return status;
  }
  *asset = made;
  return SBF_OK;
}

static void name_file(sbf_diagnostic *error, const char *name) {
  if (error && name) sbfi_copy_text(error->file, sizeof error->file, name);
}

sbf_status sbf_packed_load_memory(const void *bytes, size_t size, const sbf_load_options *options,
    sbf_asset **asset, sbf_diagnostic *error) {
  sbf_load_options filled = sbfi_load_options_of(options);
  bool in_place;
  *asset = NULL;
  sbf_status status = load(bytes, size, &filled, asset, &in_place, error);
  if (status != SBF_OK) name_file(error, filled.name);
  return status;
}

static void release_content(void *content) {
  sbfi_file_content_free(content);
}

/* Makes the asset own the file that its lists point into. */
static sbf_status attach_content(sbf_asset *asset, sbfi_file_content *content, sbf_diagnostic *error) {
  sbfi_asset_box *box = sbfi_asset_box_of(asset);
  sbfi_file_content *kept = sbfi_arena_copy(&box->arena, content, 1, sizeof *content);
  if (!kept) return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for an asset");
  box->release = release_content;
  box->released = kept;
  return SBF_OK;
}

sbf_status sbf_packed_load_file(
    const char *path, const sbf_load_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  sbf_load_options filled = sbfi_load_options_of(options);
  sbfi_file_content content;
  bool in_place = false;
  *asset = NULL;
  sbf_status status = (filled.copy_file ? sbfi_file_read : sbfi_file_map)(
      path, filled.limits.file_bytes, filled.allocator, &content, error);
  if (status != SBF_OK) return status;
  status = load(content.at, content.size, &filled, asset, &in_place, error);
  if (status == SBF_OK && in_place) {
    status = attach_content(*asset, &content, error);
    if (status == SBF_OK) return SBF_OK;
    sbf_asset_free(*asset);
    *asset = NULL;
  }
  sbfi_file_content_free(&content);
  if (status != SBF_OK) name_file(error, path);
  return status;
}
