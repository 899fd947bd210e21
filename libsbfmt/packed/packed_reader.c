#include "packed/packed_reader.h"

#include "base/diagnostic.h"
#include "model/options.h"
#include "packed/packed_filter.h"

/* Reads the table; for an outline only its entry, if the file has one. */
static sbf_status read_table(
    sbfi_packed_reader *reader, size_t size, const sbf_allocator *allocator, sbf_diagnostic *error) {
  const sbf_limits *limits = &reader->options.limits;
  sbf_status status = SBF_OK;
  if (reader->options.outline) {
    status = sbfi_packed_table_read_outline(&reader->table, reader->bytes, size, limits, allocator, error);
    reader->has_outline = status == SBF_OK && reader->table.chunks;
  }
  if (status == SBF_OK && !reader->has_outline)
    status = sbfi_packed_table_read(&reader->table, reader->bytes, size, limits, allocator, error);
  if (reader->has_outline) reader->options.check_crc = true;
  return status;
}

/* A fault of a whole chunk. */
__attribute__((format(printf, 4, 5))) static sbf_status fault(
    sbfi_packed_reader *reader, sbf_code code, uint32_t number, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sbf_status status = sbfi_diagnose_v(reader->error, code, format, arguments);
  va_end(arguments);
  if (reader->error) reader->error->offset = (int64_t)reader->table.chunks[number].offset;
  return status;
}

static sbf_status inflates_too_far(sbfi_packed_reader *reader, uint32_t number) {
  const sbfi_packed_chunk *c = &reader->table.chunks[number];
  return fault(reader, SBF_CODE_PACKED_RATIO, number,
      "with chunk %u (%s) of %llu bytes the file would inflate to more than %llu: raise the limit if the "
      "file is trusted",
      number, sbfi_packed_chunk_name(c).text, (unsigned long long)c->raw_size,
      (unsigned long long)reader->options.limits.inflated_bytes);
}

/* For a complete read: rejects the file before anything is inflated. */
static sbf_status check_inflated(sbfi_packed_reader *reader) {
  uint64_t left = reader->options.limits.inflated_bytes;
  if (reader->options.selection || reader->options.outline) return SBF_OK;
  for (uint32_t i = 0; i < reader->table.chunk_count; i++) {
    const sbfi_packed_chunk *c = &reader->table.chunks[i];
    if (c->codec == SBFI_CODEC_NONE || c->kind == SBFI_PACKED_OUTLINE) continue;
    if (c->raw_size > left) return inflates_too_far(reader, i);
    left -= c->raw_size;
  }
  return SBF_OK;
}

sbf_status sbfi_packed_reader_open(sbfi_packed_reader *reader, const uint8_t *bytes, size_t size,
    const sbf_load_options *filled, const sbf_allocator *allocator, sbfi_arena *arena,
    sbf_diagnostic *error) {
  *reader = (sbfi_packed_reader){.bytes = bytes, .options = *filled, .arena = arena, .error = error};
  sbfi_packed_coder_init(&reader->coder, allocator, 0);
  reader->options.limits.inflated_bytes = sbfi_inflated_limit(&filled->limits, size);
  sbf_status status = read_table(reader, size, allocator, error);
  if (status != SBF_OK) return status;
  status = check_inflated(reader);
  if (status != SBF_OK) {
    sbfi_packed_reader_close(reader);
    return status;
  }
  uint32_t chunk_count = reader->table.chunk_count;
  reader->read_bytes = SBFI_PACKED_HEADER_SIZE + (uint64_t)chunk_count * SBFI_PACKED_ENTRY_SIZE;
  reader->used = sbfi_allocate(&reader->coder.allocator, chunk_count);
  if (!reader->used) {
    sbfi_packed_reader_close(reader);
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for a table of %u chunks", chunk_count);
  }
  memset(reader->used, 0, chunk_count);
  return SBF_OK;
}

void sbfi_packed_reader_close(sbfi_packed_reader *reader) {
  sbfi_free(&reader->coder.allocator, reader->used, reader->table.chunk_count);
  reader->used = NULL;
  sbfi_packed_coder_free(&reader->coder);
  sbfi_packed_table_free(&reader->table);
}

sbf_status sbfi_packed_claim(sbfi_packed_reader *reader, uint32_t number, const sbfi_packed_chunk *wanted) {
  if (number >= reader->table.chunk_count)
    return sbfi_diagnose(reader->error, SBF_CODE_PACKED_RECORD,
        "a record refers to chunk %u, but the table has %u chunks", number, reader->table.chunk_count);
  const sbfi_packed_chunk *chunk = &reader->table.chunks[number];
  if (reader->used[number])
    return fault(reader, SBF_CODE_PACKED_RECORD, number, "records refer to chunk %u twice", number);
  if (chunk->kind != wanted->kind || chunk->owner != wanted->owner || chunk->level != wanted->level ||
      chunk->field != wanted->field || chunk->list != wanted->list)
    return fault(reader, SBF_CODE_PACKED_RECORD, number,
        "chunk %u is %s, field %u.%u, but a record refers to it as %s, field %u.%u", number,
        sbfi_packed_chunk_name(chunk).text, chunk->field, chunk->list, sbfi_packed_chunk_name(wanted).text,
        wanted->field, wanted->list);
  reader->used[number] = 1;
  return SBF_OK;
}

/* Checks a chunk before use: its checksum if requested, and its inflated size. */
static sbf_status admit(sbfi_packed_reader *reader, uint32_t number) {
  const sbfi_packed_chunk *c = &reader->table.chunks[number];
  const sbf_limits *limits = &reader->options.limits;
  if (c->codec != SBFI_CODEC_NONE) {
    if (c->raw_size / limits->inflate_ratio > c->stored_size ||
        (c->raw_size / limits->inflate_ratio == c->stored_size && c->raw_size % limits->inflate_ratio))
      return fault(reader, SBF_CODE_PACKED_RATIO, number,
          "chunk %u (%s) would inflate from %llu to %llu bytes, more than %u times: raise the limit if the "
          "file is trusted",
          number, sbfi_packed_chunk_name(c).text, (unsigned long long)c->stored_size,
          (unsigned long long)c->raw_size, limits->inflate_ratio);
    if (c->raw_size > limits->inflated_bytes - reader->inflated_bytes)
      return inflates_too_far(reader, number);
    reader->inflated_bytes += c->raw_size;
  }
  reader->read_bytes += c->stored_size;
  if (reader->options.check_crc && sbfi_crc32(reader->bytes + c->offset, (size_t)c->stored_size) != c->crc)
    return fault(reader, SBF_CODE_PACKED_CRC, number,
        "chunk %u (%s) does not match its checksum: the file is damaged, copy it again", number,
        sbfi_packed_chunk_name(c).text);
  return SBF_OK;
}

static sbf_status no_memory(sbfi_packed_reader *reader, uint32_t number) {
  const sbfi_packed_chunk *c = &reader->table.chunks[number];
  return fault(reader, SBF_CODE_OUT_OF_MEMORY, number,
      "no memory for the %llu bytes of chunk %u (%s), or more than the limit of %llu in all",
      (unsigned long long)c->raw_size, number, sbfi_packed_chunk_name(c).text,
      (unsigned long long)reader->options.limits.memory_bytes);
}

static sbf_status inflate_chunk(sbfi_packed_reader *reader, uint32_t number, uint8_t *to) {
  const sbfi_packed_chunk *c = &reader->table.chunks[number];
  switch (sbfi_packed_inflate(&reader->coder, reader->bytes + c->offset, (size_t)c->stored_size,
      (sbfi_packed_filter)c->filter, c->stride / 4, to, (size_t)c->raw_size)) {
  case SBFI_CODED:
    return SBF_OK;
  case SBFI_CODED_NO_MEMORY:
    return no_memory(reader, number);
  default:
    return fault(reader, SBF_CODE_PACKED_INFLATE, number,
        "chunk %u (%s) does not inflate to %llu bytes: the file is damaged, copy it again", number,
        sbfi_packed_chunk_name(c).text, (unsigned long long)c->raw_size);
  }
}

sbf_status sbfi_packed_fetch_list(
    sbfi_packed_reader *reader, uint32_t number, const sbfi_field *field, const void **items) {
  const sbfi_packed_chunk *c = &reader->table.chunks[number];
  const uint8_t *stored = reader->bytes + c->offset;
  if (c->stride != sbfi_item_size(field))
    return fault(reader, SBF_CODE_PACKED_RECORD, number,
        "chunk %u has items of %u bytes, but those of `%s` have %u", number, c->stride, field->name,
        sbfi_item_size(field));
  if (c->count > reader->options.limits.list_items)
    return fault(reader, SBF_CODE_LIST_TOO_LONG, number,
        "`%s` has %llu items, more than the limit of %u: raise it if the file is trusted", field->name,
        (unsigned long long)c->count, reader->options.limits.list_items);
  *items = NULL;
  if (reader->options.outline) return SBF_OK;
  sbf_status status = admit(reader, number);
  if (status != SBF_OK) return status;
  bool bytes = field->item == SBFI_ITEM_U8;
  if (c->count == 0) return SBF_OK;
  if (c->codec == SBFI_CODEC_NONE && (bytes || sbfi_host_is_little_endian()) &&
      (bytes || (uintptr_t)stored % sizeof(uint32_t) == 0)) {
    reader->in_place = true;
    *items = stored;
    return SBF_OK;
  }
  uint8_t *to = sbfi_arena_allocate(reader->arena, (size_t)c->count, c->stride);
  if (!to) return no_memory(reader, number);
  if (c->codec == SBFI_CODEC_NONE)
    memcpy(to, stored, (size_t)c->raw_size);
  else if ((status = inflate_chunk(reader, number, to)) != SBF_OK)
    return status;
  if (!bytes && c->filter == SBFI_FILTER_NONE) sbfi_scalars_to_host(to, (size_t)c->raw_size / 4);
  *items = to;
  return SBF_OK;
}

sbf_status sbfi_packed_fetch_record(sbfi_packed_reader *reader, uint32_t number, sbfi_packed_record *record) {
  const sbfi_packed_chunk *c = &reader->table.chunks[number];
  *record = (sbfi_packed_record){.number = number};
  if (c->stride != 1 || c->filter != SBFI_FILTER_NONE)
    return fault(reader, SBF_CODE_PACKED_RECORD, number, "chunk %u (%s) is a record, but is stored as items",
        number, sbfi_packed_chunk_name(c).text);
  sbf_status status = admit(reader, number);
  if (status != SBF_OK) return status;
  record->at = reader->bytes + c->offset;
  record->size = (size_t)c->raw_size;
  if (c->codec == SBFI_CODEC_NONE) return SBF_OK;
  const sbf_limits *limits = &reader->options.limits;
  if (c->raw_size <= limits->memory_bytes && c->raw_size <= SIZE_MAX)
    record->allocated = sbfi_allocate(&reader->coder.allocator, record->size);
  if (!record->allocated) return no_memory(reader, number);
  record->at = record->allocated;
  status = inflate_chunk(reader, number, record->allocated);
  if (status != SBF_OK) sbfi_packed_release_record(reader, record);
  return status;
}

void sbfi_packed_release_record(sbfi_packed_reader *reader, sbfi_packed_record *record) {
  sbfi_free(&reader->coder.allocator, record->allocated, record->size);
  record->allocated = NULL;
}
