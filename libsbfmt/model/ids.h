/* Ids of an asset: a hash table from id to where it stands, and references from id to place and back. */
#ifndef SBFI_IDS_H
#define SBFI_IDS_H

#include "base/memory.h"
#include "model/schema.h"
#include "sbfmt/model.h"

typedef struct sbfi_id_entry {
  const char *id; /* the asset's own string */
  uint64_t hash;
  const sbfi_field *collection; /* field of the root it stands in; NULL: deeper down */
  uint32_t index;               /* in that collection */
} sbfi_id_entry;

/* Open addressing; the hash is keyed by an address, so that a file cannot be made to collide. */
typedef struct sbfi_ids {
  sbf_allocator allocator;
  uint64_t key;
  sbfi_id_entry *slots;
  size_t count, capacity;
} sbfi_ids;

void sbfi_ids_init(sbfi_ids *ids, const sbf_allocator *allocator);
void sbfi_ids_free(sbfi_ids *ids);

/* Adds the entry, unless its id is there already: then *first becomes the one that was, else NULL. False
 * where memory runs out. `entry.hash` is filled in here. */
bool sbfi_ids_add(sbfi_ids *ids, sbfi_id_entry entry, const sbfi_id_entry **first);
/* Adds all ids of the root's collections; of several that are equal the first stays. */
bool sbfi_ids_add_collections(sbfi_ids *ids, const sbf_asset *asset);
const sbfi_id_entry *sbfi_ids_find(const sbfi_ids *ids, const char *id);

/* The root's field that a reference looks into. */
const sbfi_field *sbfi_ref_collection(const sbfi_field *ref);
/* How many items that has. */
uint32_t sbfi_ref_count(const sbf_asset *asset, const sbfi_field *ref);
/* The id that a reference stands for; NULL for SBF_NONE and what is out of range. */
const char *sbfi_ref_id(const sbf_asset *asset, const sbfi_field *ref, int32_t value);

#endif
