/* An interior on a body-centred grid, connected only where the surface is not between. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "build/geometry/triangle_tree.h"
#include "build/lattice/lattice_crossings.h"
#include "build/lattice/lattice_signs.h"
#include "build/springs/pair_set.h"
#include "build/springs/springs.h"

/* Nodes closer to a cut than this fraction of an edge are dropped: their springs would be short and stiff. */
static const double min_fraction = 0.25;
/* In cells: search distance of a surface point for nodes, and if it finds none. */
static const double near_reach = 1.25, far_reach = 2.5;
enum { MAX_OF_A_POINT = 4, MAX_HALVINGS = 4 };

typedef struct work {
  const sbf_polygon_mesh *mesh;
  sbfi_lattice_grid grid;
  sbfi_triangle_tree tree;
  uint8_t *cut, *inside;
  uint32_t *points; /* (node_count) index of kept nodes; SBFI_NO_INDEX: dropped */
  uint32_t *nodes;  /* of the points */
  uint32_t count;
  sbfi_progress progress;
  sbfi_arena *arena;
} work;

static sbf_vec3 position_of(const work *w, uint32_t node) {
  int32_t at[3];
  sbfi_lattice_compute_coordinates(&w->grid, node, at);
  return sbfi_d3_rounded(sbfi_lattice_position(&w->grid, (sbfi_d3){at[0], at[1], at[2]}));
}

static bool find_nodes(work *w, const sbfi_winding *winding, sbfi_array *crossings) {
  uint32_t count = w->grid.node_count;
  w->cut = sbfi_arena_allocate(w->arena, count, 1);
  w->inside = sbfi_arena_allocate(w->arena, count, 1);
  w->points = sbfi_arena_allocate(w->arena, count, sizeof *w->points);
  if (!w->cut || !w->inside || !w->points) return false;
  if (!sbfi_lattice_cross(&w->grid, winding->soup, w->cut, crossings)) return false;
  if (!sbfi_lattice_signs(&w->grid, winding, w->cut, w->inside, w->arena)) return false;
  const sbfi_lattice_crossing *at = crossings->at;
  for (size_t i = 0; i < crossings->count; i++) {
    uint32_t owner = at[i].edge >> 3;
    int32_t step = w->grid.steps[sbfi_lattice_kind(&w->grid, owner)][at[i].edge & 7];
    if (at[i].fraction < min_fraction) w->inside[owner] = 0;
    if (at[i].fraction > 1 - min_fraction) w->inside[(int64_t)owner + step] = 0;
  }
  for (uint32_t n = 0; n < count; n++) w->count += w->inside[n];
  return true;
}

/* Numbers the kept nodes: first those at least half as deep as the deepest. */
static bool number_nodes(work *w, sbfi_lattice_interior *interior) {
  double deepest = 0;
  double *depths = sbfi_arena_allocate(w->arena, w->count, sizeof *depths);
  uint32_t *found = sbfi_arena_allocate(w->arena, w->count, sizeof *found);
  w->nodes = sbfi_arena_allocate(w->arena, w->count, sizeof *w->nodes);
  interior->points = sbfi_arena_allocate(w->arena, w->count, sizeof *interior->points);
  if (!depths || !found || !w->nodes || !interior->points) return false;
  uint32_t next = 0;
  for (uint32_t n = 0; n < w->grid.node_count; n++) {
    w->points[n] = SBFI_NO_INDEX;
    if (!w->inside[n]) continue;
    if (!sbfi_progress_step(sbfi_progress_part(w->progress, 0.2, 0.5), next, w->count)) return false;
    depths[next] = INFINITY;
    sbfi_triangle_tree_nearest(&w->tree, position_of(w, n), &depths[next]);
    if (depths[next] > deepest) deepest = depths[next];
    found[next++] = n;
  }
  for (int round = 0; round < 2; round++) {
    for (uint32_t i = 0; i < w->count; i++) {
      if ((depths[i] >= deepest / 4) != (round == 0)) continue;
      w->points[found[i]] = interior->point_count;
      w->nodes[interior->point_count] = found[i];
      interior->points[interior->point_count++] = position_of(w, found[i]);
    }
    if (round == 0) interior->deep_count = interior->point_count;
  }
  return true;
}

static bool join_nodes(const work *w, uint32_t first, sbfi_array *springs) {
  for (uint32_t i = 0; i < w->count; i++) {
    uint32_t node = w->nodes[i];
    const int32_t *steps = w->grid.steps[sbfi_lattice_kind(&w->grid, node)];
    for (int k = 0; k < SBFI_LATTICE_EDGES; k++) {
      uint32_t other = w->points[(int64_t)node + steps[k]];
      if (other == SBFI_NO_INDEX || (w->cut[node] >> k & 1)) continue;
      if (!sbfi_array_append(springs, &(sbf_uint2){{first + i, first + other}}, 1)) return false;
    }
  }
  return true;
}

/* Whether the segment from the node to the surface point does not cross the surface before it. */
static bool is_clear(const work *w, sbf_vec3 node, sbf_vec3 point) {
  double corners[3][3], at[3] = {point.x, point.y, point.z}, unused[3];
  uint32_t hits = sbfi_triangle_tree_pierced(&w->tree, node, point, INFINITY);
  if (hits == UINT32_MAX) return true;
  for (int k = 0; k < 3; k++) {
    sbf_vec3 p = w->tree.positions[w->tree.triangles[hits].points[k]];
    corners[k][0] = p.x, corners[k][1] = p.y, corners[k][2] = p.z;
  }
  double near = 1e-4 * w->grid.cell;
  return sbfi_triangle_closest(corners[0], corners[1], corners[2], at, unused) < near * near;
}

typedef struct neighbour {
  double distance2;
  uint32_t point;
} neighbour;

static int compare(const void *a, const void *b) {
  const neighbour *x = a, *y = b;
  if (x->distance2 != y->distance2) return x->distance2 < y->distance2 ? -1 : 1;
  return x->point < y->point ? -1 : x->point > y->point;
}

/* Nodes within `reach` cells of the point, by increasing distance. */
static uint32_t find_near(
    const work *w, const sbf_vec3 *interior, sbf_vec3 point, double reach, neighbour *near, uint32_t max) {
  sbfi_d3 at = sbfi_d3_scale(sbfi_d3_sub(sbfi_d3_of(point), w->grid.origin), 2 / w->grid.cell);
  const double position[3] = {at.x, at.y, at.z};
  int32_t low[3], high[3];
  uint32_t count = 0;
  for (int k = 0; k < 3; k++) {
    int32_t last = 2 * (int32_t)w->grid.counts[k] - 1;
    low[k] = (int32_t)ceil(position[k] - 2 * reach);
    high[k] = (int32_t)floor(position[k] + 2 * reach);
    if (low[k] < 0) low[k] = 0;
    if (high[k] > last) high[k] = last;
  }
  for (int32_t z = low[2]; z <= high[2]; z++) {
    for (int32_t y = low[1] + ((low[1] ^ z) & 1); y <= high[1]; y += 2) {
      for (int32_t x = low[0] + ((low[0] ^ z) & 1); x <= high[0]; x += 2) {
        uint32_t i = w->points[sbfi_lattice_node(&w->grid, x, y, z)];
        if (i == SBFI_NO_INDEX || count == max) continue;
        sbfi_d3 displacement = sbfi_d3_sub(sbfi_d3_of(interior[i]), sbfi_d3_of(point));
        double limit = reach * w->grid.cell;
        if (sbfi_d3_dot(displacement, displacement) > limit * limit) continue;
        near[count++] = (neighbour){sbfi_d3_dot(displacement, displacement), i};
      }
    }
  }
  qsort(near, count, sizeof *near, compare);
  return count;
}

/* Connects a surface point to the nearest nodes in its line of sight; false: no memory. */
static bool join_point(
    const work *w, const sbf_vec3 *interior, uint32_t first, uint32_t i, sbfi_array *springs) {
  enum { MAX_NEAR = 256 };
  neighbour near[MAX_NEAR];
  sbf_vec3 point = w->mesh->positions.at[i];
  uint32_t joined = 0;
  for (int round = 0; round < 2 && joined == 0; round++) {
    uint32_t count = find_near(w, interior, point, round ? far_reach : near_reach, near, MAX_NEAR);
    for (uint32_t k = 0; k < count && joined < MAX_OF_A_POINT; k++) {
      if (!is_clear(w, interior[near[k].point], point)) continue;
      if (!sbfi_array_append(springs, &(sbf_uint2){{first + near[k].point, i}}, 1)) return false;
      joined++;
    }
  }
  return true;
}

static bool join_surface(const work *w, const sbf_vec3 *interior, uint32_t first, sbfi_array *springs) {
  uint32_t count = w->mesh->positions.count;
  for (uint32_t i = 0; i < count; i++) {
    if (!sbfi_progress_step(sbfi_progress_part(w->progress, 0.5, 0.8), i, count)) return false;
    if (!join_point(w, interior, first, i, springs)) return false;
  }
  return true;
}

static bool lacks_neighbour(const work *w, uint32_t node) {
  uint32_t kind = sbfi_lattice_kind(&w->grid, node);
  for (int k = 0; k < SBFI_LATTICE_EDGES; k++) {
    uint32_t back = k < SBFI_LATTICE_LONG_EDGES ? kind : !kind;
    uint32_t before = (uint32_t)((int64_t)node - w->grid.steps[back][k]);
    uint32_t after = (uint32_t)((int64_t)node + w->grid.steps[kind][k]);
    if (w->points[after] == SBFI_NO_INDEX || (w->cut[node] >> k & 1)) return true;
    if (w->points[before] == SBFI_NO_INDEX || (w->cut[before] >> k & 1)) return true;
  }
  return false;
}

/* Connects nodes at the lattice's border to the corners of the nearest triangle: if surface points are
 * farther apart than the nodes, most nodes are nearest to no point. */
static bool join_border(const work *w, const sbf_vec3 *interior, uint32_t first, sbfi_array *springs) {
  sbfi_pair_set known;
  const sbf_uint2 *at = springs->at;
  if (!sbfi_pair_set_init(&known, springs->count + 3 * (size_t)w->count, w->arena)) return false;
  for (size_t i = 0; i < springs->count; i++) sbfi_pair_set_add(&known, at[i].at[0], at[i].at[1], 0);
  for (uint32_t i = 0; i < w->count; i++) {
    if (!sbfi_progress_step(sbfi_progress_part(w->progress, 0.8, 1), i, w->count)) return false;
    if (!lacks_neighbour(w, w->nodes[i])) continue;
    double min = INFINITY;
    uint32_t triangle = sbfi_triangle_tree_nearest(&w->tree, interior[i], &min);
    for (int k = 0; k < 3; k++) {
      uint32_t corner = w->tree.triangles[triangle].points[k];
      if (!is_clear(w, interior[i], w->mesh->positions.at[corner])) continue;
      if (sbfi_pair_set_has(&known, first + i, corner)) continue;
      sbfi_pair_set_add(&known, first + i, corner, 0);
      if (!sbfi_array_append(springs, &(sbf_uint2){{first + i, corner}}, 1)) return false;
    }
  }
  return true;
}

/* The mean length of the surface's edges, so that nodes have about that distance. */
static double usual_cell(const sbf_polygon_mesh *mesh) {
  double sum = 0;
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++]) {
    uint32_t size = mesh->polygon_sizes.at[p];
    for (uint32_t k = 0; k < size; k++)
      sum += sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(mesh->positions.at[corners[k]]),
          sbfi_d3_of(mesh->positions.at[corners[k + 1 < size ? k + 1 : 0]])));
  }
  return mesh->polygon_points.count ? 1.25 * sum / mesh->polygon_points.count : 0;
}

static bool make(work *w, sbfi_lattice_interior *interior, uint32_t given) {
  sbfi_array springs;
  uint32_t first = w->mesh->positions.count + given;
  if (!number_nodes(w, interior)) return false;
  sbfi_array_init(&springs, &w->arena->allocator, sizeof(sbf_uint2));
  bool good = join_surface(w, interior->points, first, &springs) &&
              join_border(w, interior->points, first, &springs) && join_nodes(w, first, &springs);
  if (good && springs.count > 0) {
    interior->internal.at = sbfi_arena_copy(w->arena, springs.at, springs.count, sizeof(sbf_uint2));
    interior->internal.count = (uint32_t)springs.count;
    good = interior->internal.at != NULL;
  }
  sbfi_array_free(&springs);
  return good;
}

bool sbfi_springs_lattice(sbfi_lattice_interior *interior, const sbf_polygon_mesh *mesh, uint32_t given,
    double cell, sbfi_progress progress, sbfi_arena *arena) {
  sbfi_soup soup;
  sbfi_winding winding;
  sbfi_array crossings;
  *interior = (sbfi_lattice_interior){.cell = cell > 0 ? cell : usual_cell(mesh)};
  if (!sbfi_soup_make(&soup, mesh, arena) || !sbfi_winding_make(&winding, &soup, arena)) return false;
  if (soup.triangle_count == 0 || !(interior->cell > 0)) return true;
  work w = {.mesh = mesh, .progress = progress, .arena = arena};
  if (!sbfi_triangle_tree_build(&w.tree, mesh, arena)) return false;
  bool good = true;
  sbfi_array_init(&crossings, &arena->allocator, sizeof(sbfi_lattice_crossing));
  for (int halving = 0; good && w.count == 0 && halving <= MAX_HALVINGS; halving++) {
    if (halving > 0) interior->cell /= 2;
    crossings.count = 0;
    good = sbfi_progress_report(progress, 0.04 * halving);
    if (!sbfi_lattice_grid_fit(&w.grid, soup.low, soup.high, interior->cell)) break;
    good = good && find_nodes(&w, &winding, &crossings);
    if (cell > 0) break;
  }
  sbfi_array_free(&crossings);
  return good && (w.count == 0 || make(&w, interior, given));
}
