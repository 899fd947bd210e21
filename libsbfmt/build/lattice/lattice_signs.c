#include "build/lattice/lattice_signs.h"

#include <string.h>

#include "base/union_find.h"

/* A run: adjacent nodes of a row, connected by uncut edges. */
typedef struct runs {
  const sbfi_lattice_grid *grid;
  const uint8_t *cut;
  uint32_t *begins;     /* (run_count + 1) first nodes; every node belongs to a run */
  uint32_t *row_begins; /* (rows + 1) first runs */
  uint32_t *parents;    /* (run_count) */
  int *windings;        /* (run_count) */
  uint32_t run_count, row_count;
} runs;

static bool find_runs(runs *r, sbfi_arena *arena) {
  uint32_t length = r->grid->counts[0];
  r->row_count = r->grid->node_count / length;
  for (uint32_t n = 0; n < r->grid->node_count; n++)
    r->run_count += n % length == 0 || (r->cut[n - 1] & 1) != 0;
  r->begins = sbfi_arena_allocate(arena, (size_t)r->run_count + 1, sizeof *r->begins);
  r->parents = sbfi_arena_allocate(arena, (size_t)r->run_count + 1, sizeof *r->parents);
  r->row_begins = sbfi_arena_allocate(arena, (size_t)r->row_count + 1, sizeof *r->row_begins);
  if (!r->begins || !r->parents || !r->row_begins) return false;
  uint32_t count = 0;
  for (uint32_t row = 0; row < r->row_count; row++) {
    const uint8_t *cut = r->cut + (size_t)row * length;
    r->row_begins[row] = count;
    for (uint32_t x = 0; x < length; x++)
      if (x == 0 || (cut[x - 1] & 1)) r->begins[count++] = row * length + x;
  }
  r->row_begins[r->row_count] = count;
  r->begins[count] = r->grid->node_count;
  sbfi_sets_begin(r->parents, count);
  return true;
}

/* Joins the runs of a row with those of the row at the other end of its edges in one direction, `shift` nodes
 * aside. */
static void join_rows(runs *r, uint32_t row, uint32_t other, int64_t shift, int direction) {
  uint32_t a = r->row_begins[row], a_end = r->row_begins[row + 1];
  uint32_t b = r->row_begins[other], b_end = r->row_begins[other + 1];
  while (a < a_end && b < b_end) {
    /* The overlap, in nodes of the first row; edges across the border do not exist. */
    int64_t begin = r->begins[a], end = r->begins[a + 1];
    int64_t other_begin = r->begins[b] - shift, other_end = r->begins[b + 1] - shift;
    int64_t low = begin > other_begin ? begin : other_begin, high = end < other_end ? end : other_end;
    if (low < high && sbfi_set_root(r->parents, a) != sbfi_set_root(r->parents, b)) {
      for (int64_t n = low; n < high; n++) {
        if (r->cut[n] >> direction & 1) continue;
        sbfi_sets_join(r->parents, a, b);
        break;
      }
    }
    if (end <= other_end) a++;
    if (other_end <= end) b++;
  }
}

static void join_all(runs *r) {
  const sbfi_lattice_grid *g = r->grid;
  int64_t length = g->counts[0];
  for (uint32_t row = 0; row < r->row_count; row++) {
    uint32_t kind = row & 1, y = row / 2 % g->counts[1];
    for (int direction = 1; direction < SBFI_LATTICE_EDGES; direction++) {
      /* Other ends of the edges of the row's first node, as a row and an index in it. */
      int go_y = sbfi_lattice_directions[direction][1];
      bool is_long = direction < SBFI_LATTICE_LONG_EDGES;
      if (is_long ? direction == 1 && y + 1 >= g->counts[1]
                  : (kind == 0 && go_y < 0 && y == 0) || (kind == 1 && go_y > 0 && y + 1 >= g->counts[1]))
        continue;
      int64_t aside = 0;
      if (!is_long) aside = sbfi_lattice_directions[direction][0] < 0 ? -(kind == 0) : kind == 1;
      int64_t step = g->steps[kind][direction] - aside, other = row + step / length;
      if (other >= r->row_count) continue;
      join_rows(r, row, (uint32_t)other, step + aside, direction);
    }
  }
}

static sbfi_d3 position_of(const sbfi_lattice_grid *grid, uint32_t node) {
  int32_t at[3];
  sbfi_lattice_compute_coordinates(grid, node, at);
  return sbfi_lattice_position(grid, (sbfi_d3){at[0], at[1], at[2]});
}

/* One evaluation for each set of runs: in the middle of its longest run. */
static bool wind_runs(runs *r, const sbfi_winding *winding, sbfi_arena *arena) {
  uint32_t *longest = sbfi_arena_allocate(arena, (size_t)r->run_count + 1, sizeof *longest);
  r->windings = sbfi_arena_allocate(arena, (size_t)r->run_count + 1, sizeof *r->windings);
  if (!longest || !r->windings) return false;
  for (uint32_t i = 0; i < r->run_count; i++) {
    uint32_t root = sbfi_set_root(r->parents, i), best = longest[root];
    /* Roots are the lowest of their sets, so `longest` starts with the root itself. */
    if (root == i || r->begins[i + 1] - r->begins[i] > r->begins[best + 1] - r->begins[best])
      longest[root] = i;
  }
  for (uint32_t i = 0; i < r->run_count; i++) {
    uint32_t root = sbfi_set_root(r->parents, i), run = longest[root];
    uint32_t middle = r->begins[run] + (r->begins[run + 1] - r->begins[run]) / 2;
    r->windings[i] =
        root == i ? sbfi_winding_of_closed(winding, position_of(r->grid, middle)) : r->windings[root];
  }
  return true;
}

/* Squared distance from the caps' centre beyond which they contribute less than a half: their winding number
 * is at most their area over 4 pi times the squared distance to their nearest point. */
static double reach_of_caps(const sbfi_soup *soup, sbfi_d3 *middle) {
  double area = 0, radius2 = 0;
  sbfi_d3 low = soup->high, high = soup->low;
  for (uint32_t t = soup->triangle_count; t < soup->triangle_count + soup->cap_count; t++) {
    sbfi_d3 c[3];
    for (int k = 0; k < 3; k++) {
      c[k] = soup->points[soup->triangles[t][k]];
      low = (sbfi_d3){fmin(low.x, c[k].x), fmin(low.y, c[k].y), fmin(low.z, c[k].z)};
      high = (sbfi_d3){fmax(high.x, c[k].x), fmax(high.y, c[k].y), fmax(high.z, c[k].z)};
    }
    area += sbfi_d3_length(sbfi_d3_cross(sbfi_d3_sub(c[1], c[0]), sbfi_d3_sub(c[2], c[0]))) / 2;
  }
  *middle = sbfi_d3_scale(sbfi_d3_add(low, high), 0.5);
  sbfi_d3 half = sbfi_d3_sub(high, *middle);
  radius2 = sbfi_d3_dot(half, half);
  double reach = sqrt(radius2) + sqrt(area / 6);
  return reach * reach;
}

bool sbfi_lattice_signs(const sbfi_lattice_grid *grid, const sbfi_winding *winding, const uint8_t *cut,
    uint8_t *inside, sbfi_arena *arena) {
  runs r = {.grid = grid, .cut = cut};
  if (!find_runs(&r, arena)) return false;
  join_all(&r);
  if (!wind_runs(&r, winding, arena)) return false;
  for (uint32_t i = 0; i < r.run_count; i++)
    memset(inside + r.begins[i], r.windings[i] != 0, r.begins[i + 1] - r.begins[i]);
  if (winding->soup->cap_count == 0) return true;
  sbfi_d3 middle;
  double reach = reach_of_caps(winding->soup, &middle);
  for (uint32_t i = 0; i < r.run_count; i++) {
    for (uint32_t n = r.begins[i]; n < r.begins[i + 1]; n++) {
      sbfi_d3 position = position_of(grid, n), displacement = sbfi_d3_sub(position, middle);
      if (sbfi_d3_dot(displacement, displacement) > reach) continue;
      inside[n] = sbfi_winding_inside(r.windings[i], sbfi_winding_of_caps(winding, position));
    }
  }
  return true;
}
