/* Source parts of an asset: all parts that are not derived. */
#ifndef SBFI_SOURCE_VIEW_H
#define SBFI_SOURCE_VIEW_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* Fills `*view` with the asset without derived parts and derivations. Its structs are copies in the arena;
 * lists and texts are the asset's own. References keep their indices in `asset` until
 * sbfi_references_renumber. Returns false if memory runs out. */
bool sbfi_source_view(const sbf_asset *asset, sbfi_arena *arena, sbf_asset *view);

/* New indices of referenced items: from the old index to the new one, SBF_NONE for removed items. Collections
 * that are not listed keep their indices. */
typedef struct sbfi_renumbering {
  size_t collection;           /* offset of the list in sbf_asset */
  const int32_t *new_from_old; /* (old_count) */
  uint32_t old_count;
} sbfi_renumbering;

/* A required reference to a removed item. */
typedef struct sbfi_lost_reference {
  char path[256]; /* of the referring element */
  const char *collection;
} sbfi_lost_reference;

/* Renumbers every reference in `asset`, whose structs are writable. Returns false if a required reference is
 * to a removed item, with the first one in `*lost`; other references become SBF_NONE. */
bool sbfi_references_renumber(
    sbf_asset *asset, const sbfi_renumbering *renumberings, uint32_t count, sbfi_lost_reference *lost);

/* Index in the view of each item of one of the root's collections (old_count): SBF_NONE if it is derived.
 * `derived` is the offset of the item's mark. */
void sbfi_find_source_indices(
    const void *items, uint32_t count, size_t size, size_t derived, int32_t *new_from_old);

#endif
