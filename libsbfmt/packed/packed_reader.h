/* A packed file being read: its table, the chunks fetched so far, and what that may cost. */
#ifndef SBFI_PACKED_READER_H
#define SBFI_PACKED_READER_H

#include "model/place.h"
#include "packed/packed_codec.h"
#include "packed/packed_table.h"

typedef struct sbfi_packed_reader {
  const uint8_t *bytes;
  sbfi_packed_table table;
  sbfi_packed_coder coder;
  sbf_load_options options; /* filled */
  sbfi_arena *arena;        /* of the asset being made */
  uint8_t *used;            /* a byte a chunk: already referred to */
  uint64_t read_bytes;      /* of the file: header, table and chunks fetched */
  uint64_t inflated_bytes;
  bool has_outline;  /* the file's outline is read, and is chunk 0 */
  bool in_place;     /* some list points into `bytes` */
  uint32_t left_out; /* fields and chunks of a newer version */
  char first_left_out[160];
  sbf_diagnostic *error;
} sbfi_packed_reader;

/* Reads header and table. `arena` is where lists go. On failure nothing is left to free. */
sbf_status sbfi_packed_reader_open(sbfi_packed_reader *reader, const uint8_t *bytes, size_t size,
    const sbf_load_options *filled, const sbf_allocator *allocator, sbfi_arena *arena, sbf_diagnostic *error);
void sbfi_packed_reader_close(sbfi_packed_reader *reader);

/* Takes a chunk that a record refers to; every chunk is referred to once. `wanted` says which it must be, by
 * kind, owner, level, field and list. */
sbf_status sbfi_packed_claim(sbfi_packed_reader *reader, uint32_t number, const sbfi_packed_chunk *wanted);

/* The items of a list's chunk: in the file itself where they can be used there, else in the arena; NULL where
 * an outline is read. */
sbf_status sbfi_packed_fetch_list(
    sbfi_packed_reader *reader, uint32_t number, const sbfi_field *field, const void **items);

/* The bytes of a record: in the file, or in memory to be given back with sbfi_packed_release_record. */
typedef struct sbfi_packed_record {
  uint32_t number;
  const uint8_t *at;
  size_t size;
  uint8_t *allocated; /* NULL: in the file */
} sbfi_packed_record;
sbf_status sbfi_packed_fetch_record(sbfi_packed_reader *reader, uint32_t number, sbfi_packed_record *record);
void sbfi_packed_release_record(sbfi_packed_reader *reader, sbfi_packed_record *record);

/* Reads the root's record and all that is selected into `asset`, which is at its defaults. */
sbf_status sbfi_packed_read_asset(sbfi_packed_reader *reader, sbf_asset *asset);

/* Whether a part is to be read: `part` holds its label. */
bool sbfi_packed_selects(const sbf_selection *selection, const sbfi_place *part);
/* Whether the lists of the root itself are. */
bool sbfi_packed_selects_root_lists(const sbf_selection *selection);

#endif
