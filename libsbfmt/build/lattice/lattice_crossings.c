#include "build/lattice/lattice_crossings.h"

/* A cut within this fraction of an edge from a node is a cut at the node. Positions in single precision have
 * a smaller error. */
static const double at_node = 1e-5;

typedef struct work {
  const sbfi_lattice_grid *grid;
  uint8_t *cut;
  sbfi_array *crossings;
  uint32_t points[3];            /* of the present triangle */
  double at[3][3];               /* in grid coordinates */
  double across[3][2], along[3]; /* in a plane perpendicular to the present direction */
  double min_area; /* twice the area: below it the triangle is seen edge-on, where rounding dominates */
  bool is_cap, good;
} work;

static void add(work *w, int direction, const int32_t at[3], double fraction) {
  uint32_t node = sbfi_lattice_node(w->grid, at[0], at[1], at[2]);
  sbfi_lattice_crossing crossing = {8 * node + (uint32_t)direction, (float)fraction};
  w->cut[node] |= (uint8_t)(1u << direction);
  if (!w->is_cap && !sbfi_array_append(w->crossings, &crossing, 1)) w->good = false;
}

/* Adds a cut of the line at `coordinate` along it; `base` is a node of the line with `along` 0 or 1. */
static void add_on_line(work *w, int direction, const int32_t base[3], double step, double coordinate) {
  int32_t at[3], steps = (int32_t)floor(coordinate / step);
  double fraction = coordinate / step - steps;
  for (int k = 0; k < 3; k++) at[k] = base[k] + steps * sbfi_lattice_directions[direction][k];
  add(w, direction, at, fraction);
  if (fraction >= at_node && fraction <= 1 - at_node) return;
  int32_t other = fraction < at_node ? -1 : 1;
  for (int k = 0; k < 3; k++) at[k] += other * sbfi_lattice_directions[direction][k];
  add(w, direction, at, fraction < at_node ? 1 : 0);
}

/* Side of (u, v) relative to a triangle's edge, seen along the line. The ends are ordered by index, so that
 * two triangles with a common edge agree to the bit. */
static double side_of(const work *w, int from, int to, double u, double v) {
  bool swap = w->points[from] > w->points[to];
  const double *a = w->across[swap ? to : from], *b = w->across[swap ? from : to];
  double side = (b[0] - a[0]) * (v - a[1]) - (b[1] - a[1]) * (u - a[0]);
  return swap ? -side : side;
}

/* Whether the triangle cuts the line at (u, v), and where. */
static bool collide(const work *w, double u, double v, double *position) {
  double c = side_of(w, 0, 1, u, v), a = side_of(w, 1, 2, u, v), b = side_of(w, 2, 0, u, v);
  bool within = (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
  double sum = a + b + c;
  if (!within || fabs(sum) <= w->min_area) return false;
  *position = (a * w->along[0] + b * w->along[1] + c * w->along[2]) / sum;
  return true;
}

static double min_of(double p[3][2], int k) {
  double min = p[0][k] < p[1][k] ? p[0][k] : p[1][k];
  return p[2][k] < min ? p[2][k] : min;
}

static double max_of(double p[3][2], int k) {
  double max = p[0][k] > p[1][k] ? p[0][k] : p[1][k];
  return p[2][k] > max ? p[2][k] : max;
}

/* The first integer with the remainder (0 or 1) modulo 2 that is not below `min`. (Most triangles are smaller
 * than a cell and need this ten times; ceil may be a call.) */
static int32_t first_from(double min, int32_t remainder) {
  double half = (min - remainder) / 2;
  int32_t whole = (int32_t)half;
  return 2 * (whole + (whole < half)) + remainder;
}

/* All lines of one direction whose (u, v) have the remainder. */
static void cross_lines(work *w, int direction, int32_t remainder) {
  bool is_long = direction < SBFI_LATTICE_LONG_EDGES;
  const int *go = sbfi_lattice_directions[direction];
  double u_min = min_of(w->across, 0), u_max = max_of(w->across, 0), coordinate;
  int32_t u_first = first_from(u_min, remainder);
  if (u_first > u_max) return;
  double v_min = min_of(w->across, 1), v_max = max_of(w->across, 1);
  int32_t v_first = first_from(v_min, remainder);
  w->min_area = 1e-9 * (u_max - u_min) * (v_max - v_min);
  for (int32_t v = v_first; v <= v_max; v += 2) {
    for (int32_t u = u_first; u <= u_max; u += 2) {
      if (!collide(w, u, v, &coordinate)) continue;
      if (is_long) {
        int32_t base[3];
        base[direction] = remainder;
        base[(direction + 1) % 3] = u;
        base[(direction + 2) % 3] = v;
        add_on_line(w, direction, base, 2, coordinate - remainder);
      } else {
        /* u and v are x and y of the line at z = 0. */
        int32_t steps = (int32_t)floor(coordinate);
        const int32_t base[3] = {u + steps * go[0], v + steps * go[1], steps};
        add_on_line(w, direction, base, 1, coordinate - steps);
      }
    }
  }
}

static void cross_triangle(work *w) {
  for (int direction = 0; direction < SBFI_LATTICE_LONG_EDGES; direction++) {
    for (int k = 0; k < 3; k++) {
      w->along[k] = w->at[k][direction];
      w->across[k][0] = w->at[k][(direction + 1) % 3];
      w->across[k][1] = w->at[k][(direction + 2) % 3];
    }
    cross_lines(w, direction, 0);
    cross_lines(w, direction, 1);
  }
  for (int direction = SBFI_LATTICE_LONG_EDGES; direction < SBFI_LATTICE_EDGES; direction++) {
    const int *go = sbfi_lattice_directions[direction];
    for (int k = 0; k < 3; k++) {
      w->along[k] = w->at[k][2];
      w->across[k][0] = w->at[k][0] - go[0] * w->at[k][2];
      w->across[k][1] = w->at[k][1] - go[1] * w->at[k][2];
    }
    cross_lines(w, direction, 0);
  }
}

bool sbfi_lattice_cross(
    const sbfi_lattice_grid *grid, const sbfi_soup *soup, uint8_t *cut, sbfi_array *crossings) {
  work w = {.grid = grid, .cut = cut, .crossings = crossings, .good = true};
  double scale = 2 / grid->cell;
  for (uint32_t t = 0; t < soup->triangle_count + soup->cap_count && w.good; t++) {
    w.is_cap = t >= soup->triangle_count;
    for (int k = 0; k < 3; k++) {
      w.points[k] = soup->triangles[t][k];
      sbfi_d3 p = sbfi_d3_sub(soup->points[w.points[k]], grid->origin);
      w.at[k][0] = p.x * scale, w.at[k][1] = p.y * scale, w.at[k][2] = p.z * scale;
    }
    cross_triangle(&w);
  }
  return w.good;
}
