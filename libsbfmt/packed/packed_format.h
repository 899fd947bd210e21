/* Byte format of a packed file as in spec/packed.md: numbers, sizes, and the decoded header and table
 * entry. */
#ifndef SBFI_PACKED_FORMAT_H
#define SBFI_PACKED_FORMAT_H

#include <string.h>

#include "model/schema.h"

enum {
  SBFI_PACKED_MAJOR = 1, /* newest version that this library fully supports */
  SBFI_PACKED_MINOR = 4,
  SBFI_PACKED_HEADER_SIZE = 64,
  SBFI_PACKED_ENTRY_SIZE = 64,
  SBFI_PACKED_ALIGN = 64,       /* alignment of chunks */
  SBFI_PACKED_CHUNK_FROM = 256, /* minimum size of a list with its own chunk, bytes */
  /* the same with compression: short lists share the stream of their record */
  SBFI_PACKED_CHUNK_FROM_COMPRESSED = 1024,
  SBFI_PACKED_OUTLINE_FROM =
      128, /* minimum number of chunks of a file with an outline, which follows all others */
  SBFI_PACKED_FIELD_SIZE = 8 /* number, form and payload size before each payload of a record */
};

#define SBFI_PACKED_MAGIC "\x89SBF\r\n\x1a\n"
#define SBFI_PACKED_OUTLINE SBFI_KIND('O', 'U', 'T', 'L')
#define SBFI_PACKED_NO_LEVEL UINT32_MAX /* level of a chunk outside nested parts */

typedef enum sbfi_packed_filter {
  SBFI_FILTER_NONE,
  SBFI_FILTER_PLANES, /* bytes of equal significance are grouped */
  SBFI_FILTER_DELTA,  /* planes of zigzag differences to the previous item */
  SBFI_FILTER_RECENT, /* move-to-front indices of recent scalars, and differences of new ones */
  SBFI_FILTER_COUNT
} sbfi_packed_filter;

typedef enum sbfi_packed_codec { SBFI_CODEC_NONE, SBFI_CODEC_ZLIB, SBFI_CODEC_COUNT } sbfi_packed_codec;

enum { SBFI_CHUNK_CRITICAL = 1, SBFI_CHUNK_SAFE_TO_COPY = 2, SBFI_CHUNK_FLAGS = 3 };

typedef struct sbfi_packed_header {
  uint16_t major, minor, min_major, min_minor;
  uint64_t file_size, table_offset, table_size;
  uint32_t chunk_count, table_crc;
} sbfi_packed_header;

typedef struct sbfi_packed_chunk {
  uint32_t kind;        /* kind of its part */
  uint32_t owner;       /* index of that part, or of its parent, in its collection of the root */
  uint32_t level;       /* index of a nested part in its parent; else SBFI_PACKED_NO_LEVEL */
  uint16_t field, list; /* both 0: the part's record; else the part's field and the number of the list */
  uint8_t filter, codec;
  uint16_t flags;
  uint32_t stride; /* bytes per item */
  uint64_t offset, stored_size, raw_size, count;
  uint32_t crc; /* CRC-32 of the stored bytes */
} sbfi_packed_chunk;

/* How the payload of a record's field is written. */
typedef enum sbfi_packed_form {
  SBFI_FORM_VALUE,   /* scalars of four bytes */
  SBFI_FORM_TEXT,    /* UTF-8 without an end mark */
  SBFI_FORM_LIST,    /* items */
  SBFI_FORM_CHUNK,   /* index of the chunk with the items */
  SBFI_FORM_RECORD,  /* fields of one child */
  SBFI_FORM_RECORDS, /* count, then size and fields of each child */
  SBFI_FORM_PARTS,   /* count, then chunk number, size and label fields of each part */
  SBFI_FORM_PLANES,  /* items, through SBFI_FILTER_PLANES */
  SBFI_FORM_DELTA,   /* items, through SBFI_FILTER_DELTA */
  SBFI_FORM_COUNT    /* number of items; in an outline */
} sbfi_packed_form;

/* Whether the field belongs to the label that a part's parent stores for it, so that a part can be found
 * by id or name without being read. */
static inline bool sbfi_packed_is_label(const sbfi_field *field) {
  return field->type == SBFI_ID || (field->type == SBFI_STRING && strcmp(field->name, "name") == 0);
}

static inline uint16_t sbfi_get_u16(const uint8_t *at) {
  return (uint16_t)(at[0] | at[1] << 8);
}
static inline uint32_t sbfi_get_u32(const uint8_t *at) {
  return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}
static inline uint64_t sbfi_get_u64(const uint8_t *at) {
  return sbfi_get_u32(at) | (uint64_t)sbfi_get_u32(at + 4) << 32;
}
static inline void sbfi_put_u16(uint8_t *at, uint16_t value) {
  at[0] = (uint8_t)value;
  at[1] = (uint8_t)(value >> 8);
}
static inline void sbfi_put_u32(uint8_t *at, uint32_t value) {
  for (int i = 0; i < 4; i++) at[i] = (uint8_t)(value >> (8 * i));
}
static inline void sbfi_put_u64(uint8_t *at, uint64_t value) {
  sbfi_put_u32(at, (uint32_t)value);
  sbfi_put_u32(at + 4, (uint32_t)(value >> 32));
}

/* The four letters of a kind in printable form. */
typedef struct sbfi_kind_name {
  char text[5];
} sbfi_kind_name;
static inline sbfi_kind_name sbfi_kind_print(uint32_t kind) {
  sbfi_kind_name name = {{0}};
  for (int i = 0; i < 4; i++) {
    uint32_t letter = kind >> (8 * i) & 0xff;
    name.text[i] = letter > ' ' && letter < 0x7f ? (char)letter : '?';
  }
  return name;
}

#endif
