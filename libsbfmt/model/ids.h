/* Ids of an asset: a hash table from id to index, and conversion of references between id and index. */
#ifndef SBFI_IDS_H
#define SBFI_IDS_H

#include "base/memory.h"
#include "model/schema.h"
#include "sbfmt/model.h"

typedef struct sbfi_id_entry {
  const char *id; /* owned by the asset */
  uint64_t hash;
  const sbfi_field *collection; /* field of the root; NULL: nested deeper */
  uint32_t index;               /* in that collection */
} sbfi_id_entry;

/* Open addressing; the hash key is an address, so that a file cannot force collisions. */
typedef struct sbfi_ids {
  sbf_allocator allocator;
  uint64_t key;
  sbfi_id_entry *slots;
  size_t count, capacity;
} sbfi_ids;

void sbfi_ids_init(sbfi_ids *ids, const sbf_allocator *allocator);
void sbfi_ids_free(sbfi_ids *ids);

/* Adds the entry unless its id exists: then *first receives the existing entry, else NULL. False if memory
 * runs out. Fills in `entry.hash`. */
bool sbfi_ids_add(sbfi_ids *ids, sbfi_id_entry entry, const sbfi_id_entry **first);
/* Adds all ids of the root's collections; the first of duplicates wins. */
bool sbfi_ids_add_collections(sbfi_ids *ids, const sbf_asset *asset);
const sbfi_id_entry *sbfi_ids_find(const sbfi_ids *ids, const char *id);

/* Collection of the root that a reference refers to. */
const sbfi_field *sbfi_ref_collection(const sbfi_field *ref);
/* Number of items in that collection. */
uint32_t sbfi_ref_count(const sbf_asset *asset, const sbfi_field *ref);
/* Id that a reference refers to; NULL for SBF_NONE and out of range values. */
const char *sbfi_ref_id(const sbf_asset *asset, const sbfi_field *ref, int32_t value);

#endif
