/* Bodies that are copies of earlier ones, moved to another position: one set of levels stands for all. */
#ifndef SBFI_EQUAL_BODIES_H
#define SBFI_EQUAL_BODIES_H

#include "base/memory.h"
#include "mechanics/vector.h"
#include "sbfmt/asset.h"

typedef struct sbfi_equal_bodies {
  const sbf_soft_body *bodies;
  uint32_t slot_count; /* a power of two */
  uint32_t *slots;     /* (slot_count) the latest body of a hash, or UINT32_MAX */
  uint32_t *earlier;   /* (bodies) the one before it of the same slot, or UINT32_MAX */
} sbfi_equal_bodies;

/* Memory of `arena`, but for the bodies, which must stay. False where memory runs out. */
bool sbfi_equal_bodies_make(
    sbfi_equal_bodies *made, const sbf_soft_body *bodies, uint32_t count, sbfi_arena *arena);

/* An added body that equals body `number` but for its identity and a translation `*offset`, m, from that one
 * to this; UINT32_MAX where there is none. Points may lie apart by a ten-thousandth of the body's size, as
 * rounding in files leaves them. Nothing equals a body that a bone, pins or attachments hold, or one with
 * levels. Looks at the latest 64 of the same polygons and attributes. */
uint32_t sbfi_equal_bodies_find(const sbfi_equal_bodies *all, uint32_t number, sbfi_d3 *offset);

/* Adds body `number`, once. */
void sbfi_equal_bodies_add(sbfi_equal_bodies *all, uint32_t number);

/* The body's levels with their points moved by `offset`, as memory of `asset`; other lists are shared. False
 * where memory runs out. */
bool sbfi_levels_moved(sbf_level_list *moved, const sbf_level_list *levels, sbfi_d3 offset, sbf_asset *asset);

#endif
