#include "build/lattice/lattice_stuffing.h"

#include <string.h>

#include "build/lattice/lattice_stencils.h"

/* Fractions of an edge within which a cut warps the node. The paper's pair for the maximum of the minimum
 * angle, 0.24999 and 0.41189, belongs to its own diagonals; with those of lattice_stencils.h it gives 9.3
 * degrees, and this one 10.5 to 163.8, over millions of tetrahedra of random surfaces. */
static const double warp_long = 0.28, warp_short = 0.40, short_length = 0.86602540378443865;

static const uint32_t NONE = UINT32_MAX;

double sbfi_lattice_min_fraction(int direction) {
  return (direction < SBFI_LATTICE_LONG_EDGES ? warp_long : warp_short) + 1e-3;
}

size_t sbfi_lattice_cuts_slot(const sbfi_lattice_cuts *cuts, uint32_t edge) {
  size_t slot = (size_t)((edge * UINT64_C(0x9e3779b97f4a7c15)) >> 32) & (cuts->slot_count - 1);
  while (cuts->edges[slot] != NONE && cuts->edges[slot] != edge) slot = (slot + 1) & (cuts->slot_count - 1);
  return slot;
}

/* Border nodes are outside, and so are their neighbours, so they have no cuts. */
static bool is_inner_row(const sbfi_lattice_grid *grid, uint32_t row) {
  uint32_t y = row / 2 % grid->counts[1], z = row / 2 / grid->counts[1];
  return y > 0 && y + 1 < grid->counts[1] && z > 0 && z + 1 < grid->counts[2];
}

/* Adds every edge with different ends; without slots in `cuts` they are only counted. */
static size_t visit_cuts(const sbfi_lattice_grid *grid, const uint8_t *inside, sbfi_lattice_cuts *cuts) {
  size_t count = 0;
  uint32_t length = grid->counts[0], rows = grid->node_count / length;
  for (uint32_t row = 0; row < rows; row++) {
    const int32_t *steps = grid->steps[row & 1];
    if (!is_inner_row(grid, row)) continue;
    for (uint32_t n = row * length + 1; n + 1 < (row + 1) * length; n++) {
      for (uint32_t k = 0; k < SBFI_LATTICE_EDGES; k++) {
        if (((inside[n] ^ inside[(int64_t)n + steps[k]]) & 1) == 0) continue;
        count++;
        if (!cuts->slot_count) continue;
        size_t slot = sbfi_lattice_cuts_slot(cuts, 8 * n + k);
        cuts->edges[slot] = 8 * n + k;
        cuts->fractions[slot] = -1;
      }
    }
  }
  return count;
}

bool sbfi_lattice_cuts_find(
    sbfi_lattice_cuts *cuts, const sbfi_lattice_grid *grid, const uint8_t *inside, sbfi_arena *arena) {
  *cuts = (sbfi_lattice_cuts){.slot_count = 0};
  size_t count = visit_cuts(grid, inside, cuts), slots = 16;
  while (slots < 2 * count) slots *= 2;
  cuts->edges = sbfi_arena_allocate(arena, slots, sizeof *cuts->edges);
  cuts->fractions = sbfi_arena_allocate(arena, slots, sizeof *cuts->fractions);
  cuts->points = sbfi_arena_allocate(arena, slots, sizeof *cuts->points);
  if (!cuts->edges || !cuts->fractions || !cuts->points) return false;
  memset(cuts->edges, 0xff, slots * sizeof *cuts->edges);
  memset(cuts->points, 0xff, slots * sizeof *cuts->points);
  cuts->slot_count = slots;
  cuts->count = visit_cuts(grid, inside, cuts);
  return true;
}

/* States of nodes, replacing `inside`, and a temporary mark. */
enum {
  OUTSIDE = SBFI_LATTICE_NODE_OUTSIDE,
  INSIDE = SBFI_LATTICE_NODE_INSIDE,
  ON = SBFI_LATTICE_NODE_ON,
  STATE = 3,
  AT_CUT = 4
};

typedef struct work {
  const sbfi_lattice_grid *grid;
  uint8_t *states;
  sbfi_lattice_cuts *cuts;
  uint32_t *node_points; /* (node_count) */
  sbfi_array points;     /* sbfi_d3 in grid coordinates */
  sbfi_array tetrahedra; /* sbf_uint4 */
  bool good;
} work;

static uint32_t add_point(work *w, sbfi_d3 at) {
  if (!sbfi_array_append(&w->points, &at, 1)) w->good = false;
  return (uint32_t)w->points.count - 1;
}

static sbfi_d3 coordinates(const work *w, uint32_t node) {
  int32_t at[3];
  sbfi_lattice_compute_coordinates(w->grid, node, at);
  return (sbfi_d3){at[0], at[1], at[2]};
}

/* Moves the node onto its nearest cut, if that is too close. Its edges then have no cuts. */
static void warp(work *w, uint32_t node) {
  double nearest = 2;
  int best = -1;
  double best_fraction = 0;
  for (int edge = 0; edge < 2 * SBFI_LATTICE_EDGES; edge++) {
    uint32_t other = sbfi_lattice_neighbour(w->grid, node, edge);
    int direction = edge % SBFI_LATTICE_EDGES;
    if ((w->states[other] & STATE) == ON || ((w->states[node] ^ w->states[other]) & STATE) == 0) continue;
    size_t slot =
        sbfi_lattice_cuts_slot(w->cuts, 8 * (edge == direction ? node : other) + (uint32_t)direction);
    double fraction = edge == direction ? w->cuts->fractions[slot] : 1 - w->cuts->fractions[slot];
    bool is_long = direction < SBFI_LATTICE_LONG_EDGES;
    double distance = is_long ? fraction : fraction * short_length;
    if (fraction >= (is_long ? warp_long : warp_short) || distance >= nearest) continue;
    nearest = distance;
    best = edge;
    best_fraction = fraction;
  }
  if (best < 0) return;
  sbfi_d3 from = coordinates(w, node), to = coordinates(w, sbfi_lattice_neighbour(w->grid, node, best));
  w->states[node] = ON;
  w->node_points[node] = add_point(w, sbfi_d3_add(from, sbfi_d3_scale(sbfi_d3_sub(to, from), best_fraction)));
}

static void warp_all(work *w) {
  for (size_t s = 0; s < w->cuts->slot_count; s++) {
    uint32_t edge = w->cuts->edges[s], node = edge >> 3;
    if (edge == NONE) continue;
    w->states[node] |= AT_CUT;
    w->states[sbfi_lattice_neighbour(w->grid, node, (int)(edge & 7))] |= AT_CUT;
  }
  for (uint32_t n = 0; n < w->grid->node_count && w->good; n++)
    if (w->states[n] & AT_CUT) {
      warp(w, n);
      w->states[n] &= STATE;
    }
}

static uint32_t node_point(work *w, uint32_t node) {
  if (w->node_points[node] == NONE) w->node_points[node] = add_point(w, coordinates(w, node));
  return w->node_points[node];
}

/* The point on the edge between two nodes; `direction` and `forward` identify the edge. */
static uint32_t cut_point(work *w, uint32_t owner, uint32_t direction) {
  size_t slot = sbfi_lattice_cuts_slot(w->cuts, 8 * owner + direction);
  if (w->cuts->points[slot] == NONE) {
    sbfi_d3 from = coordinates(w, owner),
            to = coordinates(w, sbfi_lattice_neighbour(w->grid, owner, (int)direction));
    w->cuts->points[slot] =
        add_point(w, sbfi_d3_add(from, sbfi_d3_scale(sbfi_d3_sub(to, from), w->cuts->fractions[slot])));
  }
  return w->cuts->points[slot];
}

/* The cut of the edge between two nodes of a tetrahedron. */
static uint32_t cut_between(work *w, uint32_t a, uint32_t b) {
  for (int edge = 0; edge < SBFI_LATTICE_EDGES; edge++) {
    if (sbfi_lattice_neighbour(w->grid, a, edge) == b) return cut_point(w, a, (uint32_t)edge);
    if (sbfi_lattice_neighbour(w->grid, b, edge) == a) return cut_point(w, b, (uint32_t)edge);
  }
  return 0; /* unreachable: the six edges of a tetrahedron are edges of the grid */
}

static void add(work *w, const uint32_t points[4]) {
  if (!sbfi_array_append(&w->tetrahedra, points, 1)) w->good = false;
}

static const sbfi_d3 *position(const work *w, uint32_t point) {
  return (const sbfi_d3 *)w->points.at + point;
}

/* Adds the inner part of one tetrahedron of the grid. */
static void fill_cut(work *w, const uint32_t nodes[4]) {
  sbfi_stencil_corner corners[4];
  uint32_t names[4][4];
  sbfi_d3 positions[4][4];
  for (int i = 0; i < 4; i++) {
    uint8_t state = w->states[nodes[i]] & STATE;
    corners[i] = state == ON ? SBFI_STENCIL_ON : state == INSIDE ? SBFI_STENCIL_INSIDE : SBFI_STENCIL_OUTSIDE;
  }
  for (int i = 0; i < 4; i++) {
    if (corners[i] == SBFI_STENCIL_OUTSIDE) continue;
    names[i][i] = node_point(w, nodes[i]);
    for (int j = 0; j < 4 && corners[i] == SBFI_STENCIL_INSIDE; j++)
      if (corners[j] == SBFI_STENCIL_OUTSIDE) names[i][j] = names[j][i] = cut_between(w, nodes[i], nodes[j]);
  }
  if (!w->good) return;
  for (int i = 0; i < 4; i++) {
    if (corners[i] == SBFI_STENCIL_OUTSIDE) continue;
    positions[i][i] = *position(w, names[i][i]);
    for (int j = 0; j < 4 && corners[i] == SBFI_STENCIL_INSIDE; j++)
      if (corners[j] == SBFI_STENCIL_OUTSIDE) positions[i][j] = positions[j][i] = *position(w, names[i][j]);
  }
  sbfi_stencil_piece pieces[SBFI_STENCIL_MAX];
  int count = sbfi_stencil_apply(corners, nodes, (const sbfi_d3(*)[4])positions, pieces);
  for (int p = 0; p < count; p++) {
    uint32_t points[4];
    for (int k = 0; k < 4; k++) points[k] = names[pieces[p].at[k][0]][pieces[p].at[k][1]];
    add(w, points);
  }
}

static void fill(work *w, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  const uint32_t nodes[4] = {a, b, c, d};
  uint8_t any = 0, outside = 0;
  for (int i = 0; i < 4; i++) {
    uint8_t state = w->states[nodes[i]] & STATE;
    any |= state == INSIDE;
    outside |= state == OUTSIDE;
  }
  if (!any) return;
  if (outside) {
    fill_cut(w, nodes);
    return;
  }
  uint32_t points[4];
  for (int i = 0; i < 4; i++) points[i] = node_point(w, nodes[i]);
  add(w, points);
}

/* The four tetrahedra around each long edge between two centres. */
static void fill_all(work *w) {
  const sbfi_lattice_grid *g = w->grid;
  const int32_t *steps = g->steps[1];
  uint32_t length = g->counts[0], rows = g->node_count / length;
  /* From a centre to the corners of its cube. */
  const int64_t corner = steps[3] - steps[2], x = 1, y = steps[1], z = steps[2];
  const int64_t rings[3][4] = {
      {corner + x, corner + x + y, corner + x + y + z, corner + x + z},
      {corner + y, corner + y + z, corner + y + z + x, corner + y + x},
      {corner + z, corner + z + x, corner + z + x + y, corner + z + y},
  };
  for (uint32_t row = 1; row < rows && w->good; row += 2) {
    if (!is_inner_row(g, row)) continue;
    for (uint32_t n = row * length + 1; n + 1 < (row + 1) * length; n++) {
      for (int direction = 0; direction < 3; direction++) {
        uint32_t other = (uint32_t)((int64_t)n + steps[direction]);
        uint32_t ring[4];
        for (int k = 0; k < 4; k++) ring[k] = (uint32_t)((int64_t)n + rings[direction][k]);
        for (int k = 0; k < 4; k++) fill(w, n, other, ring[k], ring[(k + 1) & 3]);
      }
    }
  }
}

static bool is_positive(const sbf_vec3 *positions, const uint32_t at[4]) {
  sbfi_d3 origin = sbfi_d3_of(positions[at[0]]), edges[3];
  double longest = 0;
  for (int k = 0; k < 3; k++) {
    edges[k] = sbfi_d3_sub(sbfi_d3_of(positions[at[k + 1]]), origin);
    longest = fmax(longest, sbfi_d3_length(edges[k]));
  }
  return sbfi_d3_dot(edges[0], sbfi_d3_cross(edges[1], edges[2])) > 1e-3 * longest * longest * longest;
}

/* Numbers the points in the order of the tetrahedra. */
static bool number_points(work *w, sbfi_tetrahedra *made, sbfi_arena *arena, sbfi_arena *scratch) {
  const sbfi_d3 *points = w->points.at;
  const sbf_uint4 *from = w->tetrahedra.at;
  size_t count = w->tetrahedra.count, point_count = w->points.count;
  if (count >= UINT32_MAX / 8) return false;
  made->at = sbfi_arena_allocate(arena, count + 1, sizeof *made->at);
  made->positions = sbfi_arena_allocate(arena, point_count + 1, sizeof *made->positions);
  sbf_vec3 *rounded = sbfi_arena_allocate(scratch, point_count + 1, sizeof *rounded);
  uint32_t *new_from_old = sbfi_arena_allocate(scratch, point_count + 1, sizeof *new_from_old);
  if (!made->at || !made->positions || !rounded || !new_from_old) return false;
  memset(new_from_old, 0xff, point_count * sizeof *new_from_old);
  for (size_t i = 0; i < point_count; i++)
    rounded[i] = sbfi_d3_rounded(sbfi_lattice_position(w->grid, points[i]));
  for (size_t t = 0; t < count; t++) {
    if (!is_positive(rounded, from[t].at)) {
      made->flat_count++;
      continue;
    }
    for (int k = 0; k < 4; k++) {
      uint32_t *slots = &new_from_old[from[t].at[k]];
      if (*slots == NONE) {
        *slots = made->point_count;
        made->positions[made->point_count++] = rounded[from[t].at[k]];
      }
      made->at[made->count].at[k] = *slots;
    }
    made->count++;
  }
  return true;
}

bool sbfi_lattice_stuff(const sbfi_lattice_grid *grid, uint8_t *inside, sbfi_lattice_cuts *cuts,
    sbfi_tetrahedra *made, sbfi_arena *arena, sbfi_arena *scratch) {
  *made = (sbfi_tetrahedra){.count = 0};
  work w = {.grid = grid, .states = inside, .cuts = cuts, .good = true};
  w.node_points = sbfi_arena_allocate(scratch, grid->node_count, sizeof *w.node_points);
  if (!w.node_points) return false;
  memset(w.node_points, 0xff, grid->node_count * sizeof *w.node_points);
  sbfi_array_init(&w.points, &scratch->allocator, sizeof(sbfi_d3));
  sbfi_array_init(&w.tetrahedra, &scratch->allocator, sizeof(sbf_uint4));
  warp_all(&w);
  if (w.good) fill_all(&w);
  bool good = w.good && number_points(&w, made, arena, scratch);
  sbfi_array_free(&w.points);
  sbfi_array_free(&w.tetrahedra);
  return good;
}
