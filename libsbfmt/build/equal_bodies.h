/* Bodies that are translated copies of earlier ones: they share one set of levels. */
#ifndef SBFI_EQUAL_BODIES_H
#define SBFI_EQUAL_BODIES_H

#include "base/memory.h"
#include "mechanics/vector.h"
#include "sbfmt/asset.h"

typedef struct sbfi_equal_bodies {
  const sbf_soft_body *bodies;
  uint32_t slot_count; /* a power of two */
  uint32_t *slots;     /* (slot_count) the latest body of a hash, or UINT32_MAX */
  uint32_t *earlier;   /* (bodies) previous body in the same slot, or UINT32_MAX */
} sbfi_equal_bodies;

/* Uses memory of `arena`; the bodies must stay. Returns false if memory runs out. */
bool sbfi_equal_bodies_make(
    sbfi_equal_bodies *made, const sbf_soft_body *bodies, uint32_t count, sbfi_arena *arena);

/* An added body that equals body `number` except for its identity and a translation `*offset`, m, from that
 * one to this; UINT32_MAX: none. Points may differ by a ten-thousandth of the body's size, as by rounding in
 * files. Bodies with a bone, pins, attachments or levels equal none. Checks the latest 64 bodies with the
 * same polygons and attributes. */
uint32_t sbfi_equal_bodies_find(const sbfi_equal_bodies *all, uint32_t number, sbfi_d3 *offset);

/* Adds body `number`, once. */
void sbfi_equal_bodies_add(sbfi_equal_bodies *all, uint32_t number);

/* Copies the body's levels with their points moved by `offset`, in memory of `asset`; other lists are shared.
 * Returns false if memory runs out. */
bool sbfi_levels_moved(sbf_level_list *moved, const sbf_level_list *levels, sbfi_d3 offset, sbf_asset *asset);

#endif
