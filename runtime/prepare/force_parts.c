/* Division of an island's tetrahedra among tasks: which blocks each computes, and where the forces on points
 * that several of them touch go. */
#include <string.h>

#include "prepare/prepare.h"

/* The forces on a point may be summed by one task without entries if no other part has touched it before. If
 * more than this fraction of the corners needs entries, their order is so scattered that dividing does not
 * pay. */
static const double MAX_ENTRY_FRACTION = 0.25;

typedef struct division {
  const sbri_island *island;
  uint32_t *owners;       /* (slot_count) part that touches the slot first; UINT32_MAX: none yet */
  uint32_t *entry_counts; /* (slot_count) */
  uint32_t *rows_of;      /* (dense_count) row of each block; UINT32_MAX: its corners */
  uint32_t row_count, entry_count;
  sbri_force_parts *parts;
} division;

static bool is_divided(const sbri_island *island) {
  return island->tetrahedra.part_count > 1 && !island->splits && island->regions.block_count == 0;
}

static bool has_entry(const division *d, uint32_t part, uint32_t slot) {
  return d->owners[slot] != part;
}

/* Finds the owners of all slots, and counts entries and the blocks that have some. */
static void count(division *d, const uint32_t *begins, uint32_t part_count) {
  for (uint32_t p = 0; p < part_count; p++)
    for (uint32_t b = begins[p]; b < begins[p + 1]; b++) {
      uint32_t before = d->entry_count;
      for (int k = 0; k < 4; k++)
        for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
          uint32_t slot = d->island->tetrahedra.blocks[b].corners[k][lane];
          if (d->owners[slot] == UINT32_MAX) d->owners[slot] = p;
          if (!has_entry(d, p, slot)) continue;
          d->entry_counts[slot]++, d->entry_count++;
        }
      d->rows_of[b] = d->entry_count > before ? d->row_count++ : UINT32_MAX;
    }
}

/* Lists the shared slots with the begin of their entries. Makes `entry_counts` the next entry of each slot.
 */
static void list_shared(division *d, uint32_t *slots, uint32_t *begins) {
  uint32_t shared = 0, next = 0;
  for (uint32_t slot = 0; slot < d->island->slot_count; slot++) {
    uint32_t entries = d->entry_counts[slot];
    if (!entries) continue;
    slots[shared] = slot, begins[shared++] = next;
    d->entry_counts[slot] = next;
    next += entries;
  }
  begins[shared] = next;
}

/* Entries of a slot follow each other in the order in which one task alone would add them. */
static void fill_rows(division *d, const uint32_t *begins, uint32_t part_count, sbri_force_targets *rows) {
  for (uint32_t p = 0; p < part_count; p++)
    for (uint32_t b = begins[p]; b < begins[p + 1]; b++)
      for (int k = 0; k < 4 && d->rows_of[b] != UINT32_MAX; k++)
        for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
          uint32_t slot = d->island->tetrahedra.blocks[b].corners[k][lane];
          rows[d->rows_of[b]].at[k][lane] =
              has_entry(d, p, slot) ? d->parts->first_entry + d->entry_counts[slot]++ : slot;
        }
}

static bool make(sbr_model *model, sbri_island *island, sbfi_arena *scratch) {
  const uint32_t part_count = island->tetrahedra.part_count, blocks = island->tetrahedra.dense_count;
  const uint32_t *begins = island->tetrahedra.part_begins;
  division d = {.island = island};
  d.owners = sbfi_arena_allocate(scratch, island->slot_count, sizeof *d.owners);
  d.entry_counts = sbfi_arena_allocate(scratch, island->slot_count, sizeof *d.entry_counts);
  d.rows_of = sbfi_arena_allocate(&model->arena, blocks, sizeof *d.rows_of);
  if (!d.owners || !d.entry_counts || !d.rows_of) return false;
  memset(d.owners, 0xff, island->slot_count * sizeof *d.owners);
  count(&d, begins, part_count);
  if (d.entry_count > MAX_ENTRY_FRACTION * 4 * SBRI_BLOCK * blocks) return true;
  uint32_t shared = 0;
  for (uint32_t slot = 0; slot < island->slot_count; slot++) shared += d.entry_counts[slot] > 0;
  uint32_t *slots = sbfi_arena_allocate(&model->arena, (size_t)shared + 1, sizeof *slots),
           *entry_begins = sbfi_arena_allocate(&model->arena, (size_t)shared + 1, sizeof *entry_begins);
  sbri_force_targets *rows = sbfi_arena_allocate(&model->arena, (size_t)d.row_count + 1, sizeof *rows);
  d.parts = sbfi_arena_allocate(&model->arena, 1, sizeof *d.parts);
  if (!slots || !entry_begins || !rows || !d.parts) return false;
  *d.parts = (sbri_force_parts){.count = part_count,
      .begins = begins,
      .rows_of = d.rows_of,
      .rows = rows,
      .shared_slots = slots,
      .entry_begins = entry_begins,
      .shared_count = shared,
      .first_entry = model->slot_count - island->first_slot + model->counts.force_entries,
      .entry_count = d.entry_count};
  list_shared(&d, slots, entry_begins);
  fill_rows(&d, begins, part_count, rows);
  model->counts.force_entries += d.entry_count;
  island->tetrahedra.parts = d.parts;
  return true;
}

bool sbri_force_parts_make(sbr_model *model, sbri_island *island) {
  if (!is_divided(island)) return true;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &model->arena.allocator, 0);
  bool good = make(model, island, &scratch);
  sbfi_arena_free(&scratch);
  return good;
}
