#include "build/lattice/lattice_hinges.h"

#include "base/union_find.h"
#include "build/lattice/lattice_limbs.h"
#include "build/lattice/lattice_stuffing.h"

enum { AROUND = 2 * SBFI_LATTICE_EDGES };

/* Which of the fourteen neighbours of a node are connected by an edge. */
static void join_neighbours(uint16_t joined[AROUND]) {
  int indices[AROUND][3];
  for (int a = 0; a < AROUND; a++)
    for (int k = 0; k < 3; k++)
      indices[a][k] = (a < SBFI_LATTICE_EDGES ? 1 : -1) * sbfi_lattice_directions[a % SBFI_LATTICE_EDGES][k];
  for (int a = 0; a < AROUND; a++) {
    joined[a] = 0;
    for (int b = 0; b < AROUND; b++) {
      int squared = 0;
      for (int k = 0; k < 3; k++)
        squared += (indices[a][k] - indices[b][k]) * (indices[a][k] - indices[b][k]);
      if (squared == 3 || squared == 4) joined[a] |= (uint16_t)(1 << b);
    }
  }
}

static uint16_t inside_around(const sbfi_lattice_grid *grid, const uint8_t *states, uint32_t node) {
  uint16_t around = 0;
  for (int edge = 0; edge < AROUND; edge++)
    if (states[sbfi_lattice_neighbour(grid, node, edge)] == SBFI_LATTICE_NODE_INSIDE)
      around |= (uint16_t)(1 << edge);
  return around;
}

/* Whether the neighbours in the mask are connected. */
static bool is_one_piece(uint16_t around, const uint16_t joined[AROUND]) {
  uint16_t piece = (uint16_t)(around & -around), before = 0;
  while (piece != before) {
    before = piece;
    for (int a = 0; a < AROUND; a++)
      if (piece >> a & 1) piece |= joined[a] & around;
  }
  return piece == around;
}

/* Nodes on the surface between parts that are not connected next to them: a small fraction, mostly on the rim
 * of one part. Border nodes have no neighbours, and are outside. */
static bool find_doubtful(const sbfi_lattice_grid *grid, const uint8_t *states, sbfi_array *found) {
  uint16_t joined[AROUND];
  join_neighbours(joined);
  for (uint32_t n = 0; n < grid->node_count; n++) {
    if (states[n] != SBFI_LATTICE_NODE_ON || is_one_piece(inside_around(grid, states, n), joined)) continue;
    if (!sbfi_array_append(found, &n, 1)) return false;
  }
  return true;
}

static bool join(const sbfi_lattice_grid *grid, const uint8_t *states, const sbfi_array *doubtful,
    uint8_t *inside, uint32_t *count, sbfi_arena *scratch) {
  uint32_t *parents = sbfi_arena_allocate(scratch, grid->node_count, sizeof *parents);
  if (!parents) return false;
  sbfi_sets_begin(parents, grid->node_count);
  for (uint32_t n = 0; n < grid->node_count; n++)
    for (int edge = 0; states[n] == SBFI_LATTICE_NODE_INSIDE && edge < SBFI_LATTICE_EDGES; edge++) {
      uint32_t other = sbfi_lattice_neighbour(grid, n, edge);
      if (states[other] == SBFI_LATTICE_NODE_INSIDE) sbfi_sets_join(parents, n, other);
    }
  for (size_t i = 0; i < doubtful->count; i++) {
    uint32_t node = ((const uint32_t *)doubtful->at)[i], first = UINT32_MAX, parts = 0;
    for (int edge = 0; edge < AROUND && parts < 2; edge++) {
      uint32_t other = sbfi_lattice_neighbour(grid, node, edge);
      if (states[other] != SBFI_LATTICE_NODE_INSIDE) continue;
      uint32_t root = sbfi_set_root(parents, other);
      if (root == first) continue;
      first = root;
      parts++;
    }
    if (parts < 2) continue;
    inside[node] = SBFI_LATTICE_INSIDE | SBFI_LATTICE_FORCED;
    ++*count;
  }
  return true;
}

bool sbfi_lattice_join_hinges(const sbfi_lattice_grid *grid, const uint8_t *states, uint8_t *inside,
    uint32_t *count, sbfi_arena *scratch) {
  sbfi_array doubtful;
  *count = 0;
  sbfi_array_init(&doubtful, &scratch->allocator, sizeof(uint32_t));
  bool good = find_doubtful(grid, states, &doubtful) &&
              (doubtful.count == 0 || join(grid, states, &doubtful, inside, count, scratch));
  sbfi_array_free(&doubtful);
  return good;
}
