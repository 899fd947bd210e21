#include "build/lattice/lattice.h"

#include <math.h>
#include <string.h>

#include "build/lattice/lattice_crossings.h"
#include "build/lattice/lattice_hinges.h"
#include "build/lattice/lattice_limbs.h"
#include "build/lattice/lattice_signs.h"

/* Cuts of edges with different ends: of several, the one nearest to the outer end, so that the whole surface
 * is inside. */
static void store_cuts(const sbfi_array *crossings, const uint8_t *inside, sbfi_lattice_cuts *cuts) {
  const sbfi_lattice_crossing *at = crossings->at;
  for (size_t i = 0; i < crossings->count; i++) {
    size_t slot = sbfi_lattice_cuts_slot(cuts, at[i].edge);
    if (cuts->edges[slot] != at[i].edge) continue;
    float *fraction = &cuts->fractions[slot];
    bool outwards = inside[at[i].edge >> 3] & SBFI_LATTICE_INSIDE;
    if (*fraction < 0 || (outwards ? at[i].fraction > *fraction : at[i].fraction < *fraction))
      *fraction = at[i].fraction;
  }
}

/* At a hole: the position with a winding number of a half. */
static float bisect(const sbfi_lattice_grid *grid, const sbfi_winding *winding, uint32_t edge, bool inside) {
  enum { ROUNDS = 12 };
  double low = 0, high = 1;
  int32_t at[3];
  const int *direction = sbfi_lattice_directions[edge & 7];
  sbfi_lattice_compute_coordinates(grid, edge >> 3, at);
  for (int round = 0; round < ROUNDS; round++) {
    double fraction = (low + high) / 2;
    sbfi_d3 position = {
        at[0] + fraction * direction[0], at[1] + fraction * direction[1], at[2] + fraction * direction[2]};
    sbfi_d3 point = sbfi_lattice_position(grid, position);
    if (sbfi_winding_inside(sbfi_winding_of_closed(winding, point), sbfi_winding_of_caps(winding, point)) ==
        inside)
      low = fraction;
    else
      high = fraction;
  }
  return (float)((low + high) / 2);
}

static uint32_t bisect_cuts(const sbfi_lattice_grid *grid, const sbfi_winding *winding, const uint8_t *inside,
    sbfi_lattice_cuts *cuts) {
  uint32_t count = 0;
  for (size_t s = 0; s < cuts->slot_count; s++) {
    if (cuts->edges[s] == UINT32_MAX || cuts->fractions[s] >= 0) continue;
    cuts->fractions[s] = bisect(grid, winding, cuts->edges[s], inside[cuts->edges[s] >> 3] != 0);
    count++;
  }
  return count;
}

/* A forced node is not really inside: cuts keep a distance from it, so that it is not warped. */
static void widen_forced(const sbfi_lattice_grid *grid, uint8_t *inside, sbfi_lattice_cuts *cuts) {
  for (size_t s = 0; s < cuts->slot_count; s++) {
    if (cuts->edges[s] == UINT32_MAX) continue;
    uint32_t edge = cuts->edges[s], owner = edge >> 3;
    uint32_t other = (uint32_t)((int64_t)owner + grid->steps[sbfi_lattice_kind(grid, owner)][edge & 7]);
    float min = (float)sbfi_lattice_min_fraction((int)(edge & 7)), fraction = cuts->fractions[s];
    if (inside[owner] & SBFI_LATTICE_FORCED) cuts->fractions[s] = fraction < min ? min : fraction;
    if (inside[other] & SBFI_LATTICE_FORCED)
      cuts->fractions[s] = fraction < 0 || fraction > 1 - min ? 1 - min : fraction;
  }
}

/* Builds tetrahedra from the nodes inside; `inside` then has the states of the nodes. */
static bool stuff(sbfi_lattice *lattice, const sbfi_lattice_grid *grid, const sbfi_winding *winding,
    const sbfi_array *crossings, uint8_t *inside, sbfi_arena *scratch) {
  sbfi_lattice_cuts cuts;
  if (!sbfi_lattice_cuts_find(&cuts, grid, inside, scratch)) return false;
  store_cuts(crossings, inside, &cuts);
  if (lattice->forced_count > 0) widen_forced(grid, inside, &cuts);
  lattice->dim_count = bisect_cuts(grid, winding, inside, &cuts);
  for (uint32_t n = 0; n < grid->node_count && lattice->forced_count > 0; n++)
    inside[n] &= SBFI_LATTICE_INSIDE;
  return sbfi_lattice_stuff(grid, inside, &cuts, &lattice->made, scratch, scratch);
}

/* Repeats with more nodes inside if parts are connected by hinges only. */
static sbfi_lattice_outcome stuff_without_hinges(sbfi_lattice *lattice, const sbfi_lattice_grid *grid,
    const sbfi_winding *winding, const sbfi_array *crossings, uint8_t *inside, sbfi_progress progress,
    sbfi_arena *scratch) {
  enum { ROUNDS = 4 };
  uint8_t *states = sbfi_arena_allocate(scratch, grid->node_count, 1);
  if (!states) return SBFI_LATTICE_NO_MEMORY;
  for (int round = 0; round < ROUNDS; round++) {
    uint32_t count;
    memcpy(states, inside, grid->node_count);
    if (!stuff(lattice, grid, winding, crossings, states, scratch) ||
        !sbfi_lattice_join_hinges(grid, states, inside, &count, scratch))
      return SBFI_LATTICE_NO_MEMORY;
    if (count == 0) break;
    lattice->forced_count += count;
    if (!sbfi_progress_report(progress, 0.6 + 0.1 * round)) return SBFI_LATTICE_CANCELLED;
  }
  return SBFI_LATTICE_MADE;
}

/* Copies the lattice without its scratch memory. */
static bool copy_lattice(sbfi_lattice *lattice, sbfi_arena *arena) {
  sbfi_tetrahedra *made = &lattice->made;
  made->positions = sbfi_arena_copy(arena, made->positions, made->point_count, sizeof *made->positions);
  made->at = sbfi_arena_copy(arena, made->at, made->count, sizeof *made->at);
  return (made->positions || made->point_count == 0) && (made->at || made->count == 0);
}

static sbfi_lattice_outcome make(sbfi_lattice *lattice, const sbfi_winding *winding, sbfi_progress progress,
    sbfi_arena *arena, sbfi_array *crossings, sbfi_arena *scratch) {
  sbfi_lattice_grid grid;
  const sbfi_soup *soup = winding->soup;
  if (!sbfi_lattice_grid_fit(&grid, soup->low, soup->high, lattice->cell)) return SBFI_LATTICE_TOO_FINE;
  uint8_t *cut = sbfi_arena_allocate(scratch, grid.node_count, 1);
  uint8_t *inside = sbfi_arena_allocate(scratch, grid.node_count, 1);
  if (!cut || !inside) return SBFI_LATTICE_NO_MEMORY;
  if (!sbfi_progress_report(progress, 0)) return SBFI_LATTICE_CANCELLED;
  if (!sbfi_lattice_cross(&grid, soup, cut, crossings)) return SBFI_LATTICE_NO_MEMORY;
  if (!sbfi_progress_report(progress, 0.1)) return SBFI_LATTICE_CANCELLED;
  if (!sbfi_lattice_signs(&grid, winding, cut, inside, scratch)) return SBFI_LATTICE_NO_MEMORY;
  if (!sbfi_progress_report(progress, 0.4)) return SBFI_LATTICE_CANCELLED;
  if (!sbfi_lattice_preserve_limbs(&grid, winding, crossings, inside, &lattice->forced_count, scratch))
    return SBFI_LATTICE_NO_MEMORY;
  if (!sbfi_progress_report(progress, 0.6)) return SBFI_LATTICE_CANCELLED;
  sbfi_lattice_outcome outcome =
      stuff_without_hinges(lattice, &grid, winding, crossings, inside, progress, scratch);
  if (outcome != SBFI_LATTICE_MADE) return outcome;
  if (!copy_lattice(lattice, arena)) return SBFI_LATTICE_NO_MEMORY;
  return sbfi_progress_report(progress, 1) ? SBFI_LATTICE_MADE : SBFI_LATTICE_CANCELLED;
}

sbfi_lattice_outcome sbfi_lattice_make(sbfi_lattice *lattice, const sbfi_winding *winding, double cell,
    sbfi_progress progress, sbfi_arena *arena) {
  *lattice = (sbfi_lattice){.cell = cell};
  if (winding->soup->triangle_count == 0) return SBFI_LATTICE_MADE;
  sbfi_arena scratch;
  sbfi_array crossings;
  sbfi_arena_init(&scratch, &arena->allocator, 0);
  sbfi_array_init(&crossings, &arena->allocator, sizeof(sbfi_lattice_crossing));
  sbfi_lattice_outcome outcome = make(lattice, winding, progress, arena, &crossings, &scratch);
  sbfi_array_free(&crossings);
  sbfi_arena_free(&scratch);
  return outcome;
}

/* Ratio of the count to the requested one, at least 1. */
static double count_ratio(uint32_t count, uint32_t elements) {
  double ratio = (count + 1.0) / (elements + 1.0);
  return ratio < 1 ? 1 / ratio : ratio;
}

/* Cube root by Newton's method, from above. */
static double cube_root(double x) {
  double root = x > 1 ? x : 1;
  for (int step = 0; step < 200; step++) {
    double next = (2 * root + x / (root * root)) / 3;
    if (!(next < root)) break;
    root = next;
  }
  return root;
}

/* Whether a body without tetrahedra at this cell probably has too few at any cell: a thin layer or rod, which
 * would need a grid with many times as many nodes. */
static bool is_hollow(const sbfi_soup *soup, double cell, uint32_t elements) {
  sbfi_lattice_grid grid;
  return !sbfi_lattice_grid_fit(&grid, soup->low, soup->high, cell) ||
         grid.node_count > 64.0 * elements + 65536;
}

/* m^3, within surface and caps. */
static double enclosed_volume(const sbfi_soup *soup) {
  double sum = 0;
  for (uint32_t t = 0; t < soup->triangle_count + soup->cap_count; t++) {
    const uint32_t *at = soup->triangles[t];
    sbfi_d3 a = sbfi_d3_sub(soup->points[at[0]], soup->low), b = sbfi_d3_sub(soup->points[at[1]], soup->low),
            c = sbfi_d3_sub(soup->points[at[2]], soup->low);
    sum += sbfi_d3_dot(a, sbfi_d3_cross(b, c)) / 6;
  }
  return fabs(sum);
}

sbfi_lattice_outcome sbfi_lattice_make_count(sbfi_lattice *lattice, const sbfi_winding *winding,
    uint32_t elements, double tolerance, sbfi_progress progress, sbfi_arena *arena) {
  enum { ROUNDS = 8, TETRAHEDRA_OF_CELL = 14 };
  const sbfi_soup *soup = winding->soup;
  sbfi_d3 size = sbfi_d3_sub(soup->high, soup->low);
  double largest = fmax(size.x, fmax(size.y, size.z));
  /* Twelve tetrahedra fill a cube. A body fills about a third of its box. */
  double volume = size.x * size.y * size.z / 3, cell = largest / 16;
  *lattice = (sbfi_lattice){.cell = cell};
  if (soup->triangle_count == 0) return SBFI_LATTICE_MADE;
  if (volume > 0) cell = fmin(cell, cube_root(12 * volume / elements));
  /* With a large tolerance, the first cell is usually good enough. */
  double enclosed = tolerance > SBFI_LATTICE_TOLERANCE ? enclosed_volume(soup) : 0;
  if (enclosed > 0) cell = cube_root(TETRAHEDRA_OF_CELL * enclosed / elements);
  double best = INFINITY;
  sbfi_lattice kept = *lattice;
  sbfi_arena trial, best_memory;
  sbfi_arena_init(&best_memory, &arena->allocator, 0);
  for (int round = 0; round < ROUNDS && best > 1 + tolerance; round++) {
    sbfi_progress part = sbfi_progress_part(progress, (double)round / ROUNDS, (round + 1.0) / ROUNDS);
    sbfi_arena_init(&trial, &arena->allocator, 0);
    sbfi_lattice_outcome outcome = sbfi_lattice_make(lattice, winding, cell, part, &trial);
    uint32_t count = lattice->made.count;
    bool is_best = outcome == SBFI_LATTICE_MADE && count_ratio(count, elements) < best;
    if (is_best) {
      best = count_ratio(count, elements);
      kept = *lattice;
      sbfi_arena_free(&best_memory);
      best_memory = trial;
    } else {
      sbfi_arena_free(&trial);
    }
    if (outcome != SBFI_LATTICE_MADE) {
      sbfi_arena_free(&best_memory);
      return outcome;
    }
    if (count == 0 && is_hollow(soup, cell, elements)) break;
    /* No tetrahedra: the body is thinner than the cell. */
    double ratio = count ? (double)count / elements : 1.0 / 8;
    cell *= cube_root(ratio < 1.0 / 64 ? 1.0 / 64 : ratio > 64 ? 64 : ratio);
  }
  *lattice = kept;
  bool good = copy_lattice(lattice, arena);
  sbfi_arena_free(&best_memory);
  if (!good) return SBFI_LATTICE_NO_MEMORY;
  return sbfi_progress_report(progress, 1) ? SBFI_LATTICE_MADE : SBFI_LATTICE_CANCELLED;
}
