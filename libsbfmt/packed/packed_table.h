/* Header and table of contents of a packed file. The bytes are untrusted. */
#ifndef SBFI_PACKED_TABLE_H
#define SBFI_PACKED_TABLE_H

#include "packed/packed_format.h"
#include "sbfmt/packed.h"

typedef struct sbfi_packed_table {
  sbfi_packed_header header;
  sbfi_packed_chunk *chunks; /* (chunk_count) ordered by offset */
  uint32_t chunk_count;      /* header.chunk_count, or 1 if only the outline's entry was read */
  bool newer;                /* a later minor version: may have unknown content */
  sbf_allocator allocator;
} sbfi_packed_table;

/* Reads and checks header and table including checksums. Afterwards every chunk is aligned and inside the
 * file, none overlap, sizes match counts, and kinds, filters and codecs are known or may be skipped. The
 * first chunk is the root's record. Does not keep `bytes`. On failure there is nothing to free. */
sbf_status sbfi_packed_table_read(sbfi_packed_table *table, const uint8_t *bytes, size_t size,
    const sbf_limits *limits, const sbf_allocator *allocator, sbf_diagnostic *error);
/* Reads only the header and the last entry, if it is an outline: `chunks` then has this entry, otherwise
 * it is NULL. The entry's checksum protects the outline; the table's checksum is not checked. */
sbf_status sbfi_packed_table_read_outline(sbfi_packed_table *table, const uint8_t *bytes, size_t size,
    const sbf_limits *limits, const sbf_allocator *allocator, sbf_diagnostic *error);
void sbfi_packed_table_free(sbfi_packed_table *table);

/* Whether the schema has a part of that kind. */
bool sbfi_packed_kind_is_known(uint32_t kind);

/* 64 bytes each; inserts the header's own checksum. */
void sbfi_packed_header_put(uint8_t *to, const sbfi_packed_header *header);
void sbfi_packed_chunk_put(uint8_t *to, const sbfi_packed_chunk *chunk);

/* For messages: "BODY 3", "LEVL 3/1". */
typedef struct sbfi_chunk_name {
  char text[40];
} sbfi_chunk_name;
sbfi_chunk_name sbfi_packed_chunk_name(const sbfi_packed_chunk *chunk);

#endif
