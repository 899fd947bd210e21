/* The source parts of an asset: everything that no derivation claims. */
#ifndef SBFI_SOURCE_VIEW_H
#define SBFI_SOURCE_VIEW_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* Fills `*view` with the asset less all that is marked derived and less the derivations. Its structs are
 * copies in the arena; lists and texts are the asset's own. References keep the numbers they have in `asset`
 * until sbfi_references_renumber. False where memory runs out. */
bool sbfi_source_view(const sbf_asset *asset, sbfi_arena *arena, sbf_asset *view);

/* New places of what references may name: from the place in the old list to that in the new one, SBF_NONE for
 * what is gone. Collections that are not listed keep their numbers. */
typedef struct sbfi_renumbering {
  size_t collection;           /* offset of the list in sbf_asset */
  const int32_t *new_from_old; /* (old_count) */
  uint32_t old_count;
} sbfi_renumbering;

/* A reference to something that is gone and cannot be empty. */
typedef struct sbfi_lost_reference {
  char path[256]; /* of the element that refers */
  const char *collection;
} sbfi_lost_reference;

/* Renumbers every reference in `asset`, whose structs may be written to. Where one to something that is gone
 * is required, the first such goes into `*lost` and the result is false; others become SBF_NONE. */
bool sbfi_references_renumber(
    sbf_asset *asset, const sbfi_renumbering *renumberings, uint32_t count, sbfi_lost_reference *lost);

/* Place in the view of each item of one of the root's collections of the asset (old_count): SBF_NONE where
 * it is derived. `derived` is the offset of the item's own mark. */
void sbfi_find_source_indices(
    const void *items, uint32_t count, size_t size, size_t derived, int32_t *new_from_old);

#endif
