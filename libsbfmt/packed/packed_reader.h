/* Reader of a packed file: its table, the fetched chunks and the limits. */
#ifndef SBFI_PACKED_READER_H
#define SBFI_PACKED_READER_H

#include "model/element_path.h"
#include "packed/packed_codec.h"
#include "packed/packed_table.h"

typedef struct sbfi_packed_reader {
  const uint8_t *bytes;
  sbfi_packed_table table;
  sbfi_packed_coder coder;
  sbf_load_options options; /* with defaults filled in */
  sbfi_arena *arena;        /* of the new asset */
  uint8_t *used;            /* one byte per chunk: 1 once a record refers to it */
  uint64_t read_bytes;      /* bytes read so far: header, table and chunks */
  uint64_t inflated_bytes;
  bool has_outline;  /* reads the file's outline, which is chunk 0 */
  bool in_place;     /* some list points into `bytes` */
  uint32_t left_out; /* number of skipped fields and chunks of a newer version */
  char first_left_out[160];
  sbf_diagnostic *error;
} sbfi_packed_reader;

/* Reads header and table. Lists are allocated in `arena`. On failure there is nothing to free. */
sbf_status sbfi_packed_reader_open(sbfi_packed_reader *reader, const uint8_t *bytes, size_t size,
    const sbf_load_options *filled, const sbf_allocator *allocator, sbfi_arena *arena, sbf_diagnostic *error);
void sbfi_packed_reader_close(sbfi_packed_reader *reader);

/* Claims the chunk that a record refers to; a second claim fails. `wanted` has its kind, owner, level,
 * field and list. */
sbf_status sbfi_packed_claim(sbfi_packed_reader *reader, uint32_t number, const sbfi_packed_chunk *wanted);

/* Items of a list's chunk: in the file's bytes if possible, otherwise in the arena; NULL for an outline. */
sbf_status sbfi_packed_fetch_list(
    sbfi_packed_reader *reader, uint32_t number, const sbfi_field *field, const void **items);

/* Bytes of a record: in the file, or in memory that sbfi_packed_release_record frees. */
typedef struct sbfi_packed_record {
  uint32_t number;
  const uint8_t *at;
  size_t size;
  uint8_t *allocated; /* NULL: in the file */
} sbfi_packed_record;
sbf_status sbfi_packed_fetch_record(sbfi_packed_reader *reader, uint32_t number, sbfi_packed_record *record);
void sbfi_packed_release_record(sbfi_packed_reader *reader, sbfi_packed_record *record);

/* Reads the root's record and all selected parts into `asset`, which must have default values. */
sbf_status sbfi_packed_read_asset(sbfi_packed_reader *reader, sbf_asset *asset);

/* Whether a part is selected; `part` contains its label. */
bool sbfi_packed_selects(const sbf_selection *selection, const sbfi_element_path *part);
/* Whether the root's own lists are selected. */
bool sbfi_packed_selects_root_lists(const sbf_selection *selection);

#endif
