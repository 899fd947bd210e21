#include "build/sections/section_caps.h"

#include <string.h>

#include "build/geometry/topology.h"
#include "mechanics/vector.h"

/* An edge of a polygon without a neighbour, from point to point. */
typedef struct side {
  uint32_t from, to;
  bool used;
} side;

typedef struct work {
  sbfi_arena *arena;
  side *sides;      /* (side_count) by `from`, then in polygon order */
  uint32_t *begins; /* (points + 1) */
  uint32_t side_count;
  uint32_t *path;                      /* points of the current loop */
  uint32_t *index;                     /* (points) index in the path, from 1; 0: not in it */
  sbfi_array positions, sizes, points; /* the new mesh */
} work;

/* Counts traversals of each edge from its first end to its second minus reverse ones. */
static bool count_passes(const sbfi_topology *t, const sbf_polygon_mesh *mesh, int32_t *passes) {
  for (uint32_t c = 0; c < t->corner_count; c++) {
    uint32_t edge = t->corner_edges[c];
    if (edge != SBFI_NO_INDEX) passes[edge] += mesh->polygon_points.at[c] == t->edges[edge].at[0] ? 1 : -1;
  }
  return true;
}

static bool collect_sides(work *w, const sbf_polygon_mesh *mesh) {
  sbfi_topology t;
  if (!sbfi_topology_build(&t, mesh, w->arena)) return false;
  int32_t *passes = sbfi_arena_allocate(w->arena, (size_t)t.edge_count + 1, sizeof *passes);
  w->begins = sbfi_arena_allocate(w->arena, (size_t)t.point_count + 2, sizeof *w->begins);
  uint32_t *next = sbfi_arena_allocate(w->arena, (size_t)t.point_count + 2, sizeof *next);
  if (!passes || !w->begins || !next) return false;
  count_passes(&t, mesh, passes);
  for (uint32_t e = 0; e < t.edge_count; e++)
    for (int32_t k = passes[e]; k != 0; k += k > 0 ? -1 : 1, w->side_count++)
      w->begins[t.edges[e].at[k > 0 ? 0 : 1] + 1]++;
  for (uint32_t p = 0; p < t.point_count; p++) w->begins[p + 1] += w->begins[p];
  memcpy(next, w->begins, ((size_t)t.point_count + 1) * sizeof *next);
  w->sides = sbfi_arena_allocate(w->arena, (size_t)w->side_count + 1, sizeof *w->sides);
  w->path = sbfi_arena_allocate(w->arena, (size_t)w->side_count + 2, sizeof *w->path);
  w->index = sbfi_arena_allocate(w->arena, (size_t)t.point_count + 1, sizeof *w->index);
  if (!w->sides || !w->path || !w->index) return false;
  for (uint32_t e = 0; e < t.edge_count; e++)
    for (int32_t k = passes[e]; k != 0; k += k > 0 ? -1 : 1) {
      uint32_t from = t.edges[e].at[k > 0 ? 0 : 1], to = t.edges[e].at[k > 0 ? 1 : 0];
      w->sides[next[from]++] = (side){from, to, false};
    }
  return true;
}

/* Adds a polygon or a fan over the loop, which has the direction of the hole's edges and so the reverse of
 * the cap's. */
static bool close_loop(work *w, const uint32_t *loop, uint32_t count) {
  if (count <= 4) {
    uint32_t *points = sbfi_array_push(&w->points, count);
    for (uint32_t k = 0; points && k < count; k++) points[k] = loop[count - 1 - k];
    return points && sbfi_array_append(&w->sizes, &count, 1);
  }
  sbfi_d3 sum = {0, 0, 0};
  for (uint32_t k = 0; k < count; k++)
    sum = sbfi_d3_add(sum, sbfi_d3_of(((sbf_vec3 *)w->positions.at)[loop[k]]));
  sbf_vec3 middle = sbfi_d3_rounded(sbfi_d3_scale(sum, 1.0 / count));
  uint32_t centre = (uint32_t)w->positions.count, three = 3;
  if (!sbfi_array_append(&w->positions, &middle, 1)) return false;
  for (uint32_t k = 0; k < count; k++) {
    const uint32_t corners[3] = {loop[k + 1 < count ? k + 1 : 0], loop[k], centre};
    if (!sbfi_array_append(&w->points, corners, 3) || !sbfi_array_append(&w->sizes, &three, 1)) return false;
  }
  return true;
}

static side *next_side(work *w, uint32_t from) {
  for (uint32_t s = w->begins[from]; s < w->begins[from + 1]; s++)
    if (!w->sides[s].used) return &w->sides[s];
  return NULL;
}

/* Follows edges from `start` until none is left; closes each loop when it is complete. */
static bool follow(work *w, uint32_t start, sbfi_caps *caps) {
  uint32_t length = 0;
  w->path[length++] = start;
  w->index[start] = length;
  while (length) {
    uint32_t at = w->path[length - 1];
    side *next = next_side(w, at);
    if (!next) { /* a dead end: the edge to this point is in no loop */
      w->index[at] = 0;
      caps->left_sides += --length > 0;
      continue;
    }
    next->used = true;
    uint32_t to = next->to;
    if (!w->index[to]) {
      w->path[length++] = to;
      w->index[to] = length;
      continue;
    }
    uint32_t begin = w->index[to] - 1, count = length - begin;
    if (count >= 3) caps->loops++;
    if (count >= 3 && !close_loop(w, w->path + begin, count)) return false;
    while (length > begin + 1) w->index[w->path[--length]] = 0;
  }
  return true;
}

bool sbfi_section_caps_make(sbf_polygon_mesh *mesh, sbfi_caps *caps, sbfi_arena *arena) {
  work w = {.arena = arena};
  *caps = (sbfi_caps){0, 0};
  if (!collect_sides(&w, mesh)) return false;
  if (w.side_count == 0) return true;
  sbfi_array_init(&w.positions, &arena->allocator, sizeof(sbf_vec3));
  sbfi_array_init(&w.sizes, &arena->allocator, sizeof(uint32_t));
  sbfi_array_init(&w.points, &arena->allocator, sizeof(uint32_t));
  bool good = sbfi_array_append(&w.positions, mesh->positions.at, mesh->positions.count) &&
              sbfi_array_append(&w.sizes, mesh->polygon_sizes.at, mesh->polygon_sizes.count) &&
              sbfi_array_append(&w.points, mesh->polygon_points.at, mesh->polygon_points.count);
  for (uint32_t p = 0; good && p < mesh->positions.count; p++)
    while (good && next_side(&w, p)) good = follow(&w, p, caps);
  if (good) {
    const sbf_vec3 *positions = sbfi_arena_copy(arena, w.positions.at, w.positions.count, sizeof *positions);
    const uint32_t *sizes = sbfi_arena_copy(arena, w.sizes.at, w.sizes.count, sizeof *sizes);
    const uint32_t *points = sbfi_arena_copy(arena, w.points.at, w.points.count, sizeof *points);
    mesh->positions = (sbf_vec3_list){positions, (uint32_t)w.positions.count};
    mesh->polygon_sizes = (sbf_u32_list){sizes, (uint32_t)w.sizes.count};
    mesh->polygon_points = (sbf_u32_list){points, (uint32_t)w.points.count};
    good = positions && sizes && points;
  }
  sbfi_array_free(&w.positions);
  sbfi_array_free(&w.sizes);
  sbfi_array_free(&w.points);
  return good;
}
