#include "build/lattice/lattice_limbs.h"

#include <stdlib.h>

#include "build/lattice/lattice_crossings.h"
#include "build/lattice/lattice_stuffing.h"

/* Temporary marks of nodes, in addition to the bits that stay. */
enum { CANDIDATE = 4, ISOLATED = 8, WEAK = 16 };

static const float min_part = 1e-3f; /* fraction of an edge; smaller parts are ignored */

static int compare(const void *a, const void *b) {
  const sbfi_lattice_crossing *x = a, *y = b;
  if (x->edge != y->edge) return x->edge < y->edge ? -1 : 1;
  return x->fraction < y->fraction ? -1 : x->fraction > y->fraction;
}

static uint32_t other_end(const sbfi_lattice_grid *grid, uint32_t edge) {
  uint32_t node = edge >> 3;
  return (uint32_t)((int64_t)node + grid->steps[sbfi_lattice_kind(grid, node)][edge & 7]);
}

/* The crossings of edges with both ends outside, sorted by edge. */
static bool sort_crossings(const sbfi_lattice_grid *grid, const sbfi_array *from, const uint8_t *inside,
    sbfi_lattice_crossing **sorted, size_t *count, sbfi_arena *scratch) {
  const sbfi_lattice_crossing *at = from->at;
  *count = 0;
  for (size_t i = 0; i < from->count; i++)
    *count += !((inside[at[i].edge >> 3] | inside[other_end(grid, at[i].edge)]) & SBFI_LATTICE_INSIDE);
  *sorted = sbfi_arena_allocate(scratch, *count + 1, sizeof **sorted);
  if (!*sorted) return false;
  size_t next = 0;
  for (size_t i = 0; i < from->count; i++)
    if (!((inside[at[i].edge >> 3] | inside[other_end(grid, at[i].edge)]) & SBFI_LATTICE_INSIDE))
      (*sorted)[next++] = at[i];
  qsort(*sorted, *count, sizeof **sorted, compare);
  return true;
}

static bool is_inside(
    const sbfi_lattice_grid *grid, const sbfi_winding *winding, uint32_t edge, double fraction) {
  int32_t at[3];
  const int *direction = sbfi_lattice_directions[edge & 7];
  sbfi_lattice_compute_coordinates(grid, edge >> 3, at);
  sbfi_d3 position =
      sbfi_lattice_position(grid, (sbfi_d3){at[0] + fraction * direction[0], at[1] + fraction * direction[1],
                                      at[2] + fraction * direction[2]});
  return sbfi_winding_inside(
      sbfi_winding_of_closed(winding, position), sbfi_winding_of_caps(winding, position));
}

/* Whether one of the fourteen neighbours has the given bits within the mask. */
static bool has_neighbour(
    const sbfi_lattice_grid *grid, const uint8_t *inside, uint32_t node, int mask, int bits) {
  uint32_t kind = sbfi_lattice_kind(grid, node);
  for (int k = 0; k < SBFI_LATTICE_EDGES; k++) {
    uint32_t back = k < SBFI_LATTICE_LONG_EDGES ? kind : !kind;
    if ((inside[(int64_t)node + grid->steps[kind][k]] & mask) == bits) return true;
    if ((inside[(int64_t)node - grid->steps[back][k]] & mask) == bits) return true;
  }
  return false;
}

/* The candidate nodes, without duplicates. */
typedef struct candidates {
  uint8_t *inside;
  uint32_t *at, count;
} candidates;

static void add(candidates *c, uint32_t node, uint8_t bits) {
  if (!(c->inside[node] & CANDIDATE)) c->at[c->count++] = node;
  c->inside[node] |= CANDIDATE | bits;
}

/* Adds nodes inside that are so close to a cut that it would warp them onto the surface. */
static void add_weak(candidates *c, const sbfi_lattice_grid *grid, const sbfi_array *crossings) {
  const sbfi_lattice_crossing *at = crossings->at;
  for (size_t i = 0; i < crossings->count; i++) {
    uint32_t owner = at[i].edge >> 3, other = other_end(grid, at[i].edge);
    bool first = c->inside[owner] & SBFI_LATTICE_INSIDE, second = c->inside[other] & SBFI_LATTICE_INSIDE;
    if (first == second) continue;
    double fraction = first ? at[i].fraction : 1 - at[i].fraction;
    if (fraction < sbfi_lattice_min_fraction((int)(at[i].edge & 7))) add(c, first ? owner : other, WEAK);
  }
}

static bool add_slipped(candidates *c, const sbfi_lattice_grid *grid, const sbfi_winding *winding,
    const sbfi_array *crossings, sbfi_arena *scratch) {
  sbfi_lattice_crossing *at;
  size_t count;
  if (!sort_crossings(grid, crossings, c->inside, &at, &count, scratch)) return false;
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && at[end].edge == at[i].edge;) end++;
    float low = at[i].fraction, high = at[end - 1].fraction, middle = (low + high) / 2;
    uint32_t node = middle < 0.5f ? at[i].edge >> 3 : other_end(grid, at[i].edge);
    if (high - low < min_part || (c->inside[node] & CANDIDATE)) continue;
    if (is_inside(grid, winding, at[i].edge, middle)) add(c, node, 0);
  }
  return true;
}

bool sbfi_lattice_preserve_limbs(const sbfi_lattice_grid *grid, const sbfi_winding *winding,
    const sbfi_array *crossings, uint8_t *inside, uint32_t *count, sbfi_arena *scratch) {
  candidates c = {inside, sbfi_arena_allocate(scratch, crossings->count + 1, sizeof(uint32_t)), 0};
  *count = 0;
  if (!c.at || !add_slipped(&c, grid, winding, crossings, scratch)) return false;
  add_weak(&c, grid, crossings);
  for (uint32_t i = 0; i < c.count; i++)
    if (!has_neighbour(grid, inside, c.at[i], SBFI_LATTICE_INSIDE | WEAK, SBFI_LATTICE_INSIDE))
      inside[c.at[i]] |= ISOLATED;
  /* All are selected before any is added, so the result does not depend on the order. */
  for (uint32_t i = 0; i < c.count; i++) {
    uint32_t node = c.at[i];
    if ((inside[node] & ISOLATED) || has_neighbour(grid, inside, node, ISOLATED, ISOLATED))
      c.at[(*count)++] = node;
    else
      inside[node] &= SBFI_LATTICE_INSIDE;
  }
  for (uint32_t i = 0; i < *count; i++) inside[c.at[i]] = SBFI_LATTICE_INSIDE | SBFI_LATTICE_FORCED;
  return true;
}
