#include "build/weights/body_grid.h"

#include "build/weights/box_triangle.h"

enum { OUTSIDE = 0, SURFACE = 1, CAP = 2, SOLID = 4, REACHED = 8 };

typedef struct marking {
  const sbfi_body_grid *grid;
  uint8_t *marks;
  uint8_t mark;
  sbfi_d3 corners[3];
} marking;

sbfi_d3 sbfi_body_box_middle(const sbfi_body_grid *g, uint32_t box) {
  uint32_t x = box % g->counts[0], y = box / g->counts[0] % g->counts[1],
           z = box / g->counts[0] / g->counts[1];
  return sbfi_d3_scale((sbfi_d3){x - 0.5, y - 0.5, z - 0.5}, 1.0 / SBFI_BODY_CELLS);
}

uint32_t sbfi_body_box_at(const sbfi_body_grid *g, sbfi_d3 point) {
  const double at[3] = {point.x, point.y, point.z};
  uint32_t box = 0;
  for (int k = 2; k >= 0; k--) {
    double coordinate = floor(at[k] * SBFI_BODY_CELLS) + 1, max = g->counts[k] - 2;
    box = box * g->counts[k] + (uint32_t)(coordinate < 1 ? 1 : coordinate > max ? max : coordinate);
  }
  return box;
}

/* Marks the boxes that a triangle intersects, by recursive subdivision of a block of boxes. */
static void mark_block(const marking *m, const uint32_t low[3], const uint32_t high[3]) {
  sbfi_d3 middle = {(low[0] + high[0]) / 2.0 - 1, (low[1] + high[1]) / 2.0 - 1, (low[2] + high[2]) / 2.0 - 1};
  sbfi_d3 half = {(high[0] - low[0]) / 2.0, (high[1] - low[1]) / 2.0, (high[2] - low[2]) / 2.0};
  double cell = 1.0 / SBFI_BODY_CELLS;
  if (!sbfi_box_overlaps_triangle(sbfi_d3_scale(middle, cell), sbfi_d3_scale(half, cell), m->corners)) return;
  const uint32_t *counts = m->grid->counts;
  if (high[0] - low[0] == 1 && high[1] - low[1] == 1 && high[2] - low[2] == 1) {
    m->marks[(low[2] * counts[1] + low[1]) * counts[0] + low[0]] |= m->mark;
    return;
  }
  for (uint32_t part = 0; part < 8; part++) {
    uint32_t from[3], to[3];
    bool is_empty = false;
    for (int k = 0; k < 3; k++) {
      uint32_t cut = (low[k] + high[k]) / 2;
      from[k] = part >> k & 1 ? cut : low[k];
      to[k] = part >> k & 1 ? high[k] : cut;
      is_empty |= from[k] == to[k];
    }
    if (!is_empty) mark_block(m, from, to);
  }
}

static void mark_triangle(marking *m) {
  uint32_t low[3], high[3];
  for (int k = 0; k < 3; k++) {
    double min = INFINITY, max = -INFINITY;
    for (int c = 0; c < 3; c++) {
      const double at[3] = {m->corners[c].x, m->corners[c].y, m->corners[c].z};
      min = fmin(min, at[k]);
      max = fmax(max, at[k]);
    }
    double first = floor(min * SBFI_BODY_CELLS) + 1, last = floor(max * SBFI_BODY_CELLS) + 1;
    double limit = m->grid->counts[k] - 2;
    low[k] = (uint32_t)(first < 1 ? 1 : first > limit ? limit : first);
    high[k] = (uint32_t)(last < 1 ? 1 : last > limit ? limit : last) + 1;
  }
  mark_block(m, low, high);
}

static void mark_surface(const sbfi_body_grid *g, const sbfi_weight_mesh *mesh, uint8_t *marks) {
  marking m = {.grid = g, .marks = marks, .mark = SURFACE};
  for (uint32_t t = 0; t < mesh->triangle_count; t++) {
    for (int k = 0; k < 3; k++) m.corners[k] = sbfi_d3_of(mesh->sites[mesh->triangles[t][k]]);
    mark_triangle(&m);
  }
}

static void mark_caps(const sbfi_body_grid *g, const sbfi_soup *soup, uint8_t *marks) {
  marking m = {.grid = g, .marks = marks, .mark = CAP};
  for (uint32_t t = soup->triangle_count; t < soup->triangle_count + soup->cap_count; t++) {
    for (int k = 0; k < 3; k++) m.corners[k] = soup->points[soup->triangles[t][k]];
    mark_triangle(&m);
  }
}

/* Whether a box belongs to the margin, which stays empty so that every cell has all neighbours. */
static bool is_margin(const sbfi_body_grid *g, uint32_t box) {
  const uint32_t at[3] = {
      box % g->counts[0], box / g->counts[0] % g->counts[1], box / g->counts[0] / g->counts[1]};
  for (int k = 0; k < 3; k++)
    if (at[k] == 0 || at[k] + 1 == g->counts[k]) return true;
  return false;
}

/* Inside by winding number: one evaluation for each run of boxes in a row without surface or cap. */
static void mark_solid(const sbfi_body_grid *g, const sbfi_winding *winding, uint8_t *marks) {
  int closed = 0;
  for (uint32_t box = 0; box < g->box_count; box++) {
    if (marks[box] & SURFACE) continue;
    bool begins = box % g->counts[0] == 0 || (marks[box - 1] | marks[box]) & (SURFACE | CAP);
    sbfi_d3 at = sbfi_body_box_middle(g, box);
    if (begins) closed = sbfi_winding_of_closed(winding, at);
    if (is_margin(g, box)) continue;
    if (!winding->soup->cap_count ? closed != 0
                                  : sbfi_winding_inside(closed, sbfi_winding_of_caps(winding, at)))
      marks[box] |= SOLID;
  }
}

/* Boxes that are unreachable from the border without crossing the surface are inside, for any orientation of
 * its triangles. */
static bool mark_enclosed(const sbfi_body_grid *g, uint8_t *marks, sbfi_arena *arena) {
  uint32_t *queue = sbfi_arena_allocate(arena, g->box_count, sizeof *queue), count = 0;
  if (!queue) return false;
  const int64_t steps[3] = {1, g->counts[0], (int64_t)g->counts[0] * g->counts[1]};
  queue[count++] = 0;
  marks[0] |= REACHED;
  for (uint32_t next = 0; next < count; next++)
    for (int k = 0; k < 6; k++) {
      int64_t box = queue[next] + (k & 1 ? steps[k / 2] : -steps[k / 2]);
      /* Beyond the end of a row the next row begins, which is margin too. */
      if (box < 0 || box >= g->box_count || marks[box] & (SURFACE | REACHED)) continue;
      marks[box] |= REACHED;
      queue[count++] = (uint32_t)box;
    }
  for (uint32_t box = 0; box < g->box_count; box++)
    if (!(marks[box] & (SURFACE | REACHED))) marks[box] |= SOLID;
  return true;
}

static bool collect_cells(sbfi_body_grid *g, const uint8_t *marks, sbfi_arena *arena) {
  g->cell_of_box = sbfi_arena_allocate(arena, g->box_count, sizeof *g->cell_of_box);
  for (uint32_t box = 0; box < g->box_count; box++) g->cell_count += (marks[box] & (SURFACE | SOLID)) != 0;
  g->box_of_cell = sbfi_arena_allocate(arena, (size_t)g->cell_count + 1, sizeof *g->box_of_cell);
  if (!g->cell_of_box || !g->box_of_cell) return false;
  uint32_t count = 0;
  for (uint32_t box = 0; box < g->box_count; box++) {
    g->cell_of_box[box] = marks[box] & (SURFACE | SOLID) ? (int32_t)count : SBF_NONE;
    if (marks[box] & (SURFACE | SOLID)) g->box_of_cell[count++] = box;
  }
  return true;
}

static void lay_out(sbfi_body_grid *g, const sbfi_weight_mesh *mesh) {
  sbfi_d3 size = {0, 0, 0};
  for (uint32_t s = 0; s < mesh->shell_count; s++) {
    sbfi_d3 high = mesh->shells[s].high;
    size = (sbfi_d3){fmax(size.x, high.x), fmax(size.y, high.y), fmax(size.z, high.z)};
  }
  const double sides[3] = {size.x, size.y, size.z};
  g->box_count = 1;
  for (int k = 0; k < 3; k++) {
    g->counts[k] = (uint32_t)fmin(floor(sides[k] * SBFI_BODY_CELLS) + 1, SBFI_BODY_CELLS) + 2;
    g->box_count *= g->counts[k];
  }
  int direction = 0;
  for (int z = -1; z <= 1; z++)
    for (int y = -1; y <= 1; y++)
      for (int x = -1; x <= 1; x++) {
        if (!x && !y && !z) continue;
        g->steps[direction] = (z * (int32_t)g->counts[1] + y) * (int32_t)g->counts[0] + x;
        g->lengths[direction++] = (float)sqrt((double)(x * x + y * y + z * z));
      }
}

bool sbfi_body_grid_make(
    sbfi_body_grid *g, const sbfi_weight_mesh *mesh, const sbfi_body_rays *rays, sbfi_arena *arena) {
  *g = (sbfi_body_grid){0};
  lay_out(g, mesh);
  uint8_t *marks = sbfi_arena_allocate(arena, g->box_count, sizeof *marks);
  if (!marks) return false;
  mark_surface(g, mesh, marks);
  mark_caps(g, &rays->soup, marks);
  mark_solid(g, &rays->winding, marks);
  return mark_enclosed(g, marks, arena) && collect_cells(g, marks, arena);
}
