#include "import/rigging/surface_pieces.h"

#include "base/union_find.h"

uint32_t *sbfi_surface_pieces(const sbfi_scene_surface *s, sbfi_arena *arena) {
  uint32_t count = s->mesh.positions.count, slots = 16;
  while (slots < 2 * count) slots *= 2;
  uint32_t *table = sbfi_arena_allocate(arena, slots, sizeof *table); /* point + 1 */
  uint32_t *pieces = sbfi_arena_allocate(arena, (size_t)count + 1, sizeof *pieces);
  if (!table || !pieces) return NULL;
  sbfi_sets_begin(pieces, count);
  for (uint32_t i = 0; i < count; i++) {
    for (uint32_t k = s->neighbour_starts[i]; k < s->neighbour_starts[i + 1]; k++)
      sbfi_sets_join(pieces, i, s->neighbours[k]);
    const sbf_vec3 p = s->mesh.positions.at[i];
    uint64_t hash = 1469598103934665603u;
    const float at[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; k++) hash = (hash ^ (uint64_t)(int64_t)((double)at[k] * 1e6)) * 1099511628211u;
    uint32_t slot = (uint32_t)(hash >> 32) & (slots - 1);
    for (;; slot = (slot + 1) & (slots - 1)) {
      if (!table[slot]) {
        table[slot] = i + 1;
        break;
      }
      const sbf_vec3 q = s->mesh.positions.at[table[slot] - 1];
      if (q.x == p.x && q.y == p.y && q.z == p.z) {
        sbfi_sets_join(pieces, i, table[slot] - 1);
        break;
      }
    }
  }
  for (uint32_t i = 0; i < count; i++) pieces[i] = sbfi_set_root(pieces, i);
  return pieces;
}
