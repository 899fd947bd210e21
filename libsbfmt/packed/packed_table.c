#include "packed/packed_table.h"

#include <stdio.h>

#include "base/diagnostic.h"
#include "base/memory.h"
#include "packed/packed_codec.h"

/* Byte offsets of fields in the header and in an entry. */
enum {
  HEADER_MAJOR = 8,
  HEADER_MINOR = 10,
  HEADER_MIN_MAJOR = 12,
  HEADER_MIN_MINOR = 14,
  HEADER_FILE_SIZE = 16,
  HEADER_TABLE_OFFSET = 24,
  HEADER_TABLE_SIZE = 32,
  HEADER_COUNT = 40,
  HEADER_TABLE_CRC = 44,
  HEADER_RESERVED = 48,
  HEADER_CRC = 60,

  ENTRY_KIND = 0,
  ENTRY_OWNER = 4,
  ENTRY_LEVEL = 8,
  ENTRY_FIELD = 12,
  ENTRY_LIST = 14,
  ENTRY_FILTER = 16,
  ENTRY_CODEC = 17,
  ENTRY_FLAGS = 18,
  ENTRY_STRIDE = 20,
  ENTRY_OFFSET = 24,
  ENTRY_STORED_SIZE = 32,
  ENTRY_RAW_SIZE = 40,
  ENTRY_COUNT = 48,
  ENTRY_CRC = 56,
  ENTRY_RESERVED = 60
};

static sbf_status fault(sbf_diagnostic *error, sbf_code code, uint64_t offset, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
static sbf_status fault(sbf_diagnostic *error, sbf_code code, uint64_t offset, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sbf_status status = sbfi_diagnose_v(error, code, format, arguments);
  va_end(arguments);
  if (error) error->offset = (int64_t)offset;
  return status;
}

void sbfi_packed_header_put(uint8_t *to, const sbfi_packed_header *header) {
  memset(to, 0, SBFI_PACKED_HEADER_SIZE);
  memcpy(to, SBFI_PACKED_MAGIC, 8);
  sbfi_put_u16(to + HEADER_MAJOR, header->major);
  sbfi_put_u16(to + HEADER_MINOR, header->minor);
  sbfi_put_u16(to + HEADER_MIN_MAJOR, header->min_major);
  sbfi_put_u16(to + HEADER_MIN_MINOR, header->min_minor);
  sbfi_put_u64(to + HEADER_FILE_SIZE, header->file_size);
  sbfi_put_u64(to + HEADER_TABLE_OFFSET, header->table_offset);
  sbfi_put_u64(to + HEADER_TABLE_SIZE, header->table_size);
  sbfi_put_u32(to + HEADER_COUNT, header->chunk_count);
  sbfi_put_u32(to + HEADER_TABLE_CRC, header->table_crc);
  sbfi_put_u32(to + HEADER_CRC, sbfi_crc32(to, HEADER_CRC));
}

static sbfi_packed_header get_header(const uint8_t *from) {
  return (sbfi_packed_header){
      .major = sbfi_get_u16(from + HEADER_MAJOR),
      .minor = sbfi_get_u16(from + HEADER_MINOR),
      .min_major = sbfi_get_u16(from + HEADER_MIN_MAJOR),
      .min_minor = sbfi_get_u16(from + HEADER_MIN_MINOR),
      .file_size = sbfi_get_u64(from + HEADER_FILE_SIZE),
      .table_offset = sbfi_get_u64(from + HEADER_TABLE_OFFSET),
      .table_size = sbfi_get_u64(from + HEADER_TABLE_SIZE),
      .chunk_count = sbfi_get_u32(from + HEADER_COUNT),
      .table_crc = sbfi_get_u32(from + HEADER_TABLE_CRC),
  };
}

void sbfi_packed_chunk_put(uint8_t *to, const sbfi_packed_chunk *chunk) {
  memset(to, 0, SBFI_PACKED_ENTRY_SIZE);
  sbfi_put_u32(to + ENTRY_KIND, chunk->kind);
  sbfi_put_u32(to + ENTRY_OWNER, chunk->owner);
  sbfi_put_u32(to + ENTRY_LEVEL, chunk->level);
  sbfi_put_u16(to + ENTRY_FIELD, chunk->field);
  sbfi_put_u16(to + ENTRY_LIST, chunk->list);
  to[ENTRY_FILTER] = chunk->filter;
  to[ENTRY_CODEC] = chunk->codec;
  sbfi_put_u16(to + ENTRY_FLAGS, chunk->flags);
  sbfi_put_u32(to + ENTRY_STRIDE, chunk->stride);
  sbfi_put_u64(to + ENTRY_OFFSET, chunk->offset);
  sbfi_put_u64(to + ENTRY_STORED_SIZE, chunk->stored_size);
  sbfi_put_u64(to + ENTRY_RAW_SIZE, chunk->raw_size);
  sbfi_put_u64(to + ENTRY_COUNT, chunk->count);
  sbfi_put_u32(to + ENTRY_CRC, chunk->crc);
}

static sbfi_packed_chunk get_chunk(const uint8_t *from) {
  return (sbfi_packed_chunk){
      .kind = sbfi_get_u32(from + ENTRY_KIND),
      .owner = sbfi_get_u32(from + ENTRY_OWNER),
      .level = sbfi_get_u32(from + ENTRY_LEVEL),
      .field = sbfi_get_u16(from + ENTRY_FIELD),
      .list = sbfi_get_u16(from + ENTRY_LIST),
      .filter = from[ENTRY_FILTER],
      .codec = from[ENTRY_CODEC],
      .flags = sbfi_get_u16(from + ENTRY_FLAGS),
      .stride = sbfi_get_u32(from + ENTRY_STRIDE),
      .offset = sbfi_get_u64(from + ENTRY_OFFSET),
      .stored_size = sbfi_get_u64(from + ENTRY_STORED_SIZE),
      .raw_size = sbfi_get_u64(from + ENTRY_RAW_SIZE),
      .count = sbfi_get_u64(from + ENTRY_COUNT),
      .crc = sbfi_get_u32(from + ENTRY_CRC),
  };
}

sbfi_chunk_name sbfi_packed_chunk_name(const sbfi_packed_chunk *chunk) {
  sbfi_chunk_name name;
  sbfi_kind_name kind = sbfi_kind_print(chunk->kind);
  if (chunk->level == SBFI_PACKED_NO_LEVEL)
    snprintf(name.text, sizeof name.text, "%s %u", kind.text, chunk->owner);
  else
    snprintf(name.text, sizeof name.text, "%s %u/%u", kind.text, chunk->owner, chunk->level);
  return name;
}

static bool kind_is_in(const sbfi_element *element, uint32_t kind) {
  if (element->kind == kind) return true;
  for (uint32_t i = 0; i < element->field_count; i++) {
    const sbfi_element *child = element->fields[i].element;
    if (child && child->kind && kind_is_in(child, kind)) return true;
  }
  return false;
}

bool sbfi_packed_kind_is_known(uint32_t kind) {
  return kind && kind_is_in(&sbfi_asset_element, kind);
}

/* The damage to the magic number indicates how the file was damaged. */
static sbf_status magic_fault(sbf_diagnostic *error, const uint8_t *bytes, size_t size) {
  static const char magic[] = SBFI_PACKED_MAGIC;
  size_t same = 0;
  while (same < size && same < 8 && bytes[same] == (uint8_t)magic[same]) same++;
  if (same == size)
    return fault(error, SBF_CODE_PACKED_TRUNCATED, size,
        "the file ends after %zu bytes: copy it again from an intact file", size);
  if (same >= 4)
    return fault(error, SBF_CODE_PACKED_MAGIC, same,
        "line ends were converted, as by a transfer in text mode: copy the file again in binary mode");
  if (same == 0 && size >= 4 && bytes[0] == 0x09 && memcmp(bytes + 1, "SBF", 3) == 0)
    return fault(error, SBF_CODE_PACKED_MAGIC, 0,
        "the eighth bit was stripped, as by an old transfer: copy the file again in binary mode");
  return fault(error, SBF_CODE_PACKED_MAGIC, same, "this is not a packed asset (.sbfz)");
}

static bool is_zero(const uint8_t *bytes, size_t size) {
  for (size_t i = 0; i < size; i++)
    if (bytes[i]) return false;
  return true;
}

static sbf_status check_header(
    sbfi_packed_table *table, const uint8_t *bytes, size_t size, sbf_diagnostic *error) {
  const sbfi_packed_header *h = &table->header;
  if (size < 8 || memcmp(bytes, SBFI_PACKED_MAGIC, 8) != 0) return magic_fault(error, bytes, size);
  if (size < SBFI_PACKED_HEADER_SIZE)
    return fault(error, SBF_CODE_PACKED_TRUNCATED, size,
        "the file ends inside its header, after %zu bytes: copy it again from an intact file", size);
  if (sbfi_crc32(bytes, HEADER_CRC) != sbfi_get_u32(bytes + HEADER_CRC))
    return fault(error, SBF_CODE_PACKED_CRC, HEADER_CRC,
        "the header does not match its checksum: the file is damaged, copy it again");
  table->header = get_header(bytes);
  if (h->min_major > SBFI_PACKED_MAJOR ||
      (h->min_major == SBFI_PACKED_MAJOR && h->min_minor > SBFI_PACKED_MINOR))
    return fault(error, SBF_CODE_VERSION_TOO_NEW, HEADER_MIN_MAJOR,
        "the file needs a reader of version %u.%u, this one has version %d.%d: update the library",
        h->min_major, h->min_minor, SBFI_PACKED_MAJOR, SBFI_PACKED_MINOR);
  if (h->major != SBFI_PACKED_MAJOR || h->min_major != SBFI_PACKED_MAJOR || (h->min_minor > h->minor))
    return fault(error, SBF_CODE_PACKED_TABLE, HEADER_MAJOR,
        "the header states version %u.%u for readers from %u.%u, which no writer does: the file is damaged",
        h->major, h->minor, h->min_major, h->min_minor);
  table->newer = h->minor > SBFI_PACKED_MINOR;
  if (!table->newer && !is_zero(bytes + HEADER_RESERVED, HEADER_CRC - HEADER_RESERVED))
    return fault(error, SBF_CODE_PACKED_TABLE, HEADER_RESERVED, "reserved bytes of the header are not zero");
  if (h->file_size > size)
    return fault(error, SBF_CODE_PACKED_TRUNCATED, size,
        "the file has %zu of its %llu bytes: copy it again from an intact file", size,
        (unsigned long long)h->file_size);
  if (h->file_size < size)
    return fault(error, SBF_CODE_PACKED_TABLE, h->file_size,
        "the file has %zu bytes, but its header says %llu: something was appended, copy it again", size,
        (unsigned long long)h->file_size);
  return SBF_OK;
}

static sbf_status check_table_offset(const sbfi_packed_header *h, sbf_diagnostic *error) {
  if (h->table_size != (uint64_t)h->chunk_count * SBFI_PACKED_ENTRY_SIZE || h->chunk_count == 0)
    return fault(error, SBF_CODE_PACKED_TABLE, HEADER_TABLE_SIZE,
        "a table of %llu bytes is too small for %u entries", (unsigned long long)h->table_size,
        h->chunk_count);
  if (h->table_offset < SBFI_PACKED_HEADER_SIZE || h->table_offset % SBFI_PACKED_ALIGN ||
      h->table_offset > h->file_size || h->table_size > h->file_size - h->table_offset)
    return fault(error, SBF_CODE_PACKED_TABLE, HEADER_TABLE_OFFSET,
        "the table of %llu bytes at %llu is not inside the file at a multiple of %d",
        (unsigned long long)h->table_size, (unsigned long long)h->table_offset, SBFI_PACKED_ALIGN);
  return SBF_OK;
}

static sbf_status check_table_crc(const sbfi_packed_header *h, const uint8_t *bytes, sbf_diagnostic *error) {
  if (sbfi_crc32(bytes + h->table_offset, (size_t)h->table_size) != h->table_crc)
    return fault(error, SBF_CODE_PACKED_CRC, h->table_offset,
        "the table of contents does not match its checksum: the file is damaged, copy it again");
  return SBF_OK;
}

/* Checks one entry; `previous_end` is the end of the previous chunk. */
static sbf_status check_chunk(const sbfi_packed_table *table, uint32_t number, const uint8_t *entry,
    uint64_t previous_end, sbf_diagnostic *error) {
  const sbfi_packed_header *h = &table->header;
  const sbfi_packed_chunk *c = &table->chunks[number];
  uint64_t at = h->table_offset + (uint64_t)number * SBFI_PACKED_ENTRY_SIZE;
  if (c->offset < SBFI_PACKED_HEADER_SIZE || c->offset % SBFI_PACKED_ALIGN)
    return fault(error, SBF_CODE_PACKED_TABLE, at + ENTRY_OFFSET,
        "chunk %u (%s) begins at %llu, which is not a multiple of %d after the header", number,
        sbfi_packed_chunk_name(c).text, (unsigned long long)c->offset, SBFI_PACKED_ALIGN);
  if (c->offset > h->file_size || c->stored_size > h->file_size - c->offset)
    return fault(error, SBF_CODE_PACKED_TABLE, at + ENTRY_STORED_SIZE,
        "chunk %u (%s) of %llu bytes at %llu is not inside the file", number, sbfi_packed_chunk_name(c).text,
        (unsigned long long)c->stored_size, (unsigned long long)c->offset);
  if (c->offset < previous_end ||
      (c->offset < h->table_offset + h->table_size && c->offset + c->stored_size > h->table_offset))
    return fault(error, SBF_CODE_PACKED_TABLE, at + ENTRY_OFFSET,
        "chunk %u (%s) overlaps another one or the table, or is out of the order of the table", number,
        sbfi_packed_chunk_name(c).text);
  if (c->stride == 0 || c->count > UINT64_MAX / c->stride || c->raw_size != c->count * c->stride)
    return fault(error, SBF_CODE_PACKED_TABLE, at + ENTRY_COUNT,
        "chunk %u (%s): %llu items of %u bytes are not %llu bytes", number, sbfi_packed_chunk_name(c).text,
        (unsigned long long)c->count, c->stride, (unsigned long long)c->raw_size);
  if (!table->newer && ((c->flags & ~SBFI_CHUNK_FLAGS) || !is_zero(entry + ENTRY_RESERVED, 4)))
    return fault(error, SBF_CODE_PACKED_TABLE, at + ENTRY_FLAGS,
        "chunk %u (%s) has flags or reserved bytes that this version does not know", number,
        sbfi_packed_chunk_name(c).text);
  if (!sbfi_packed_kind_is_known(c->kind) && c->kind != SBFI_PACKED_OUTLINE) {
    if (!(c->flags & SBFI_CHUNK_CRITICAL)) return SBF_OK;
    return fault(error, SBF_CODE_PACKED_UNKNOWN_PART, at,
        "chunk %u is critical and has the unknown kind %s: update the library", number,
        sbfi_kind_print(c->kind).text);
  }
  if (c->filter >= SBFI_FILTER_COUNT || c->codec >= SBFI_CODEC_COUNT)
    return fault(error, SBF_CODE_PACKED_CODEC, at + ENTRY_FILTER,
        "chunk %u (%s) uses filter %u and codec %u, one of which is unknown: update the library", number,
        sbfi_packed_chunk_name(c).text, c->filter, c->codec);
  if (c->codec == SBFI_CODEC_NONE ? c->filter != SBFI_FILTER_NONE || c->stored_size != c->raw_size
                                  : c->raw_size == 0)
    return fault(error, SBF_CODE_PACKED_TABLE, at + ENTRY_CODEC,
        "chunk %u (%s): %llu bytes stored as %llu contradict its filter and codec", number,
        sbfi_packed_chunk_name(c).text, (unsigned long long)c->raw_size, (unsigned long long)c->stored_size);
  if (c->filter != SBFI_FILTER_NONE && (c->stride % 4 || c->stride > 16))
    return fault(error, SBF_CODE_PACKED_TABLE, at + ENTRY_STRIDE,
        "chunk %u (%s): its filter needs items of 4, 8, 12 or 16 bytes, not of %u", number,
        sbfi_packed_chunk_name(c).text, c->stride);
  return SBF_OK;
}

static sbf_status read_entries(sbfi_packed_table *table, const uint8_t *bytes, sbf_diagnostic *error) {
  const sbfi_packed_header *h = &table->header;
  uint64_t previous_end = 0;
  for (uint32_t i = 0; i < h->chunk_count; i++) {
    const uint8_t *entry = bytes + h->table_offset + (uint64_t)i * SBFI_PACKED_ENTRY_SIZE;
    table->chunks[i] = get_chunk(entry);
    sbf_status status = check_chunk(table, i, entry, previous_end, error);
    if (status != SBF_OK) return status;
    previous_end = table->chunks[i].offset + table->chunks[i].stored_size;
  }
  const sbfi_packed_chunk *root = &table->chunks[0];
  if (root->kind != sbfi_asset_element.kind || root->field || root->list)
    return fault(error, SBF_CODE_PACKED_TABLE, h->table_offset,
        "the first chunk is not the record of the whole asset");
  return SBF_OK;
}

/* Reads the header of the table and allocates the entries to read. */
static sbf_status begin_table(sbfi_packed_table *table, const uint8_t *bytes, size_t size,
    const sbf_limits *limits, const sbf_allocator *allocator, bool last_only, sbf_diagnostic *error) {
  *table = (sbfi_packed_table){.allocator = sbfi_allocator_or_default(allocator)};
  if (size > limits->file_bytes)
    return fault(error, SBF_CODE_IO_TOO_LARGE, 0, "the file has %zu bytes, more than the limit of %llu", size,
        (unsigned long long)limits->file_bytes);
  sbf_status status = check_header(table, bytes, size, error);
  if (status == SBF_OK) status = check_table_offset(&table->header, error);
  if (status == SBF_OK && !last_only) status = check_table_crc(&table->header, bytes, error);
  if (status != SBF_OK) return status;
  table->chunk_count = last_only ? 1 : table->header.chunk_count;
  size_t memory;
  if (!sbfi_multiply_size(table->chunk_count, sizeof *table->chunks, &memory) ||
      !(table->chunks = sbfi_allocate(&table->allocator, memory)))
    return fault(error, SBF_CODE_OUT_OF_MEMORY, 0, "no memory for a table of %u chunks", table->chunk_count);
  return SBF_OK;
}

sbf_status sbfi_packed_table_read(sbfi_packed_table *table, const uint8_t *bytes, size_t size,
    const sbf_limits *limits, const sbf_allocator *allocator, sbf_diagnostic *error) {
  sbf_status status = begin_table(table, bytes, size, limits, allocator, false, error);
  if (status != SBF_OK) return status;
  status = read_entries(table, bytes, error);
  if (status != SBF_OK) sbfi_packed_table_free(table);
  return status;
}

sbf_status sbfi_packed_table_read_outline(sbfi_packed_table *table, const uint8_t *bytes, size_t size,
    const sbf_limits *limits, const sbf_allocator *allocator, sbf_diagnostic *error) {
  sbf_status status = begin_table(table, bytes, size, limits, allocator, true, error);
  if (status != SBF_OK) return status;
  const sbfi_packed_header *h = &table->header;
  const uint8_t *entry = bytes + h->table_offset + h->table_size - SBFI_PACKED_ENTRY_SIZE;
  table->chunks[0] = get_chunk(entry);
  if (table->chunks[0].kind == SBFI_PACKED_OUTLINE)
    status = check_chunk(table, 0, entry, 0, error);
  else
    sbfi_packed_table_free(table);
  if (status != SBF_OK) sbfi_packed_table_free(table);
  return status;
}

void sbfi_packed_table_free(sbfi_packed_table *table) {
  sbfi_free(&table->allocator, table->chunks, table->chunk_count * sizeof *table->chunks);
  table->chunks = NULL;
}
