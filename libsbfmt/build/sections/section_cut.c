#include "build/sections/section_cut.h"

#include <stdlib.h>
#include <string.h>

#include "mechanics/vector.h"

static const double NOT_REACHED = -1e300;
static const double TWO_PI = 6.283185307179586;

/* Groups polygons by bone, ascending. */
static void group_polygons(sbfi_section_cutter *c) {
  for (uint32_t p = 0; p < c->t->polygon_count; p++)
    if (c->labels[p] != SBFI_NO_INDEX) c->group_begins[c->labels[p] + 2]++;
  for (uint32_t b = 2; b < c->bone_count + 2; b++) c->group_begins[b] += c->group_begins[b - 1];
  /* Each begin has advanced to its end, which is the next one's begin. */
  for (uint32_t p = 0; p < c->t->polygon_count; p++)
    if (c->labels[p] != SBFI_NO_INDEX) c->grouped[c->group_begins[c->labels[p] + 1]++] = p;
}

bool sbfi_section_cutter_init(sbfi_section_cutter *c, uint32_t bone_count, sbfi_arena *arena) {
  size_t points = (size_t)c->t->point_count + 1, polygons = (size_t)c->t->polygon_count + 1;
  c->bone_count = bone_count;
  c->reach = sbfi_arena_allocate(arena, points, sizeof *c->reach);
  c->shared = sbfi_arena_allocate(arena, (size_t)bone_count + 1, sizeof *c->shared);
  c->queue = sbfi_arena_allocate(arena, points, sizeof *c->queue);
  c->new_points = sbfi_arena_allocate(arena, points, sizeof *c->new_points);
  c->queued = sbfi_arena_allocate(arena, points, 1);
  c->reached = sbfi_arena_allocate(arena, points, sizeof *c->reached);
  c->border = sbfi_arena_allocate(arena, (size_t)c->t->corner_count + 1, sizeof *c->border);
  c->selected = sbfi_arena_allocate(arena, polygons, sizeof *c->selected);
  c->is_candidate = sbfi_arena_allocate(arena, polygons, 1);
  c->grouped = sbfi_arena_allocate(arena, polygons, sizeof *c->grouped);
  c->group_begins = sbfi_arena_allocate(arena, (size_t)bone_count + 3, sizeof *c->group_begins);
  if (!c->reach || !c->shared || !c->queue || !c->new_points || !c->queued || !c->reached || !c->border ||
      !c->selected || !c->is_candidate || !c->grouped || !c->group_begins)
    return false;
  for (uint32_t p = 0; p < c->t->point_count; p++) c->reach[p] = NOT_REACHED;
  memset(c->new_points, 0xff, points * sizeof *c->new_points);
  group_polygons(c);
  return true;
}

static int by_number(const void *a, const void *b) {
  uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
  return (x > y) - (x < y);
}

static double length_of(const sbfi_section_cutter *c, uint32_t edge) {
  sbf_uint2 ends = c->t->edges[edge];
  const sbf_vec3 *at = c->skin->mesh.positions.at;
  return sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(at[ends.at[0]]), sbfi_d3_of(at[ends.at[1]])));
}

/* Label across an edge at the border of the bone's part; SBFI_NO_INDEX: no border, or the border of the
 * skin. */
static uint32_t label_beyond(const sbfi_section_cutter *c, uint32_t edge, uint32_t bone) {
  uint32_t beyond = SBFI_NO_INDEX;
  bool own = false;
  for (uint32_t i = c->t->edge_polygon_begins[edge]; i < c->t->edge_polygon_begins[edge + 1]; i++) {
    uint32_t label = c->labels[c->t->edge_polygons[i]];
    own = own || label == bone;
    if (label != bone && beyond == SBFI_NO_INDEX) beyond = label;
  }
  return own ? beyond : SBFI_NO_INDEX;
}

/* Finds the edges where the bone's part borders another, ascending. */
static void find_border(sbfi_section_cutter *c, uint32_t bone) {
  uint32_t kept = 0;
  c->border_count = 0;
  for (uint32_t i = c->group_begins[bone]; i < c->group_begins[bone + 1]; i++) {
    uint32_t polygon = c->grouped[i];
    for (uint32_t k = c->t->corner_begins[polygon]; k < c->t->corner_begins[polygon + 1]; k++) {
      uint32_t edge = c->t->corner_edges[k];
      if (edge == SBFI_NO_INDEX || label_beyond(c, edge, bone) == SBFI_NO_INDEX) continue;
      c->border[c->border_count++] = edge;
    }
  }
  qsort(c->border, c->border_count, sizeof *c->border, by_number);
  /* Removes duplicates: an edge of several of its polygons was found by each. */
  for (uint32_t i = 0; i < c->border_count; i++)
    if (kept == 0 || c->border[kept - 1] != c->border[i]) c->border[kept++] = c->border[i];
  c->border_count = kept;
}

static void raise_reach(sbfi_section_cutter *c, uint32_t point, double reach) {
  if (c->reach[point] <= NOT_REACHED) c->reached[c->reached_count++] = point;
  c->reach[point] = reach;
}

/* Initial distance budget of each point of the border. */
static void begin_at_border(sbfi_section_cutter *c, uint32_t bone) {
  find_border(c, bone);
  c->reached_count = 0;
  for (uint32_t i = 0; i < c->border_count; i++)
    c->shared[label_beyond(c, c->border[i], bone)] += length_of(c, c->border[i]);
  for (uint32_t i = 0; i < c->border_count; i++) {
    uint32_t edge = c->border[i];
    double shared = c->shared[label_beyond(c, edge, bone)];
    double reach = c->overlap_m >= 0 ? c->overlap_m : -c->overlap_m * shared / TWO_PI;
    for (int k = 0; k < 2; k++)
      if (reach > c->reach[c->t->edges[edge].at[k]]) raise_reach(c, c->t->edges[edge].at[k], reach);
  }
  for (uint32_t i = 0; i < c->border_count; i++) c->shared[label_beyond(c, c->border[i], bone)] = 0;
}

/* Propagates the remaining distance along edges, with a queue of updated points. */
static void spread(sbfi_section_cutter *c) {
  uint32_t capacity = c->t->point_count + 1, head = 0, tail = 0;
  for (uint32_t i = 0; i < c->reached_count; i++) {
    uint32_t p = c->reached[i];
    c->queued[p] = c->reach[p] > 0;
    if (c->queued[p]) c->queue[tail++] = p;
  }
  while (head != tail) {
    uint32_t p = c->queue[head];
    head = head + 1 < capacity ? head + 1 : 0;
    c->queued[p] = 0;
    for (uint32_t i = c->t->point_edge_begins[p]; i < c->t->point_edge_begins[p + 1]; i++) {
      uint32_t edge = c->t->point_edges[i], other = sbfi_edge_other(c->t, edge, p);
      double left = c->reach[p] - length_of(c, edge);
      if (left <= c->reach[other]) continue;
      raise_reach(c, other, left);
      if (left <= 0 || c->queued[other]) continue;
      c->queued[other] = 1;
      c->queue[tail] = other;
      tail = tail + 1 < capacity ? tail + 1 : 0;
    }
  }
}

static bool is_selected(const sbfi_section_cutter *c, uint32_t polygon, uint32_t bone) {
  double sum = 0;
  if (c->labels[polygon] == bone) return true;
  for (uint32_t k = c->t->corner_begins[polygon]; k < c->t->corner_begins[polygon + 1]; k++) {
    double reach = c->reach[c->skin->mesh.polygon_points.at[k]];
    if (reach <= NOT_REACHED) return false;
    sum += reach;
  }
  return sum > 0;
}

static void consider(sbfi_section_cutter *c, uint32_t polygon) {
  if (c->is_candidate[polygon]) return;
  c->is_candidate[polygon] = 1;
  c->selected[c->selected_count++] = polygon;
}

/* Collects the bone's polygons and those within reach, ascending. */
static void find_selected(sbfi_section_cutter *c, uint32_t bone) {
  uint32_t kept = 0;
  c->selected_count = 0;
  for (uint32_t i = c->group_begins[bone]; i < c->group_begins[bone + 1]; i++) consider(c, c->grouped[i]);
  for (uint32_t i = 0; i < c->reached_count; i++) {
    uint32_t p = c->reached[i];
    for (uint32_t k = c->t->point_edge_begins[p]; k < c->t->point_edge_begins[p + 1]; k++) {
      uint32_t edge = c->t->point_edges[k];
      for (uint32_t n = c->t->edge_polygon_begins[edge]; n < c->t->edge_polygon_begins[edge + 1]; n++)
        consider(c, c->t->edge_polygons[n]);
    }
  }
  for (uint32_t i = 0; i < c->selected_count; i++) {
    c->is_candidate[c->selected[i]] = 0;
    if (is_selected(c, c->selected[i], bone)) c->selected[kept++] = c->selected[i];
  }
  c->selected_count = kept;
  qsort(c->selected, kept, sizeof *c->selected, by_number);
}

/* Clears the previous cut: its point map was needed until now. */
static void forget_points(sbfi_section_cutter *c) {
  for (uint32_t i = 0; i < c->selected_count; i++)
    for (uint32_t k = c->t->corner_begins[c->selected[i]]; k < c->t->corner_begins[c->selected[i] + 1]; k++)
      c->new_points[c->skin->mesh.polygon_points.at[k]] = SBFI_NO_INDEX;
}

bool sbfi_section_cut(sbfi_section_cutter *c, uint32_t bone, sbf_polygon_mesh *mesh, sbfi_arena *arena) {
  const sbf_polygon_mesh *from = &c->skin->mesh;
  uint32_t corners = 0, points = 0;
  forget_points(c);
  begin_at_border(c, bone);
  spread(c);
  find_selected(c, bone);
  for (uint32_t i = 0; i < c->reached_count; i++) c->reach[c->reached[i]] = NOT_REACHED;
  for (uint32_t i = 0; i < c->selected_count; i++) corners += from->polygon_sizes.at[c->selected[i]];
  uint32_t *sizes = sbfi_arena_allocate(arena, (size_t)c->selected_count + 1, sizeof *sizes);
  uint32_t *at = sbfi_arena_allocate(arena, (size_t)corners + 1, sizeof *at);
  sbf_vec3 *positions = sbfi_arena_allocate(arena, (size_t)corners + 1, sizeof *positions);
  if (!sizes || !at || !positions) return false;
  corners = 0;
  for (uint32_t i = 0; i < c->selected_count; i++) {
    uint32_t p = c->selected[i];
    sizes[i] = from->polygon_sizes.at[p];
    for (uint32_t k = c->t->corner_begins[p]; k < c->t->corner_begins[p + 1]; k++) {
      uint32_t point = from->polygon_points.at[k];
      if (c->new_points[point] == SBFI_NO_INDEX) {
        positions[points] = from->positions.at[point];
        c->new_points[point] = points++;
      }
      at[corners++] = c->new_points[point];
    }
  }
  mesh->positions = (sbf_vec3_list){positions, points};
  mesh->polygon_sizes = (sbf_u32_list){sizes, c->selected_count};
  mesh->polygon_points = (sbf_u32_list){at, corners};
  return true;
}
