#include "build/sections/section_cut.h"

#include <string.h>

#include "mechanics/vector.h"

static const double NOT_REACHED = -1e300;
static const double TWO_PI = 6.283185307179586;

bool sbfi_section_cutter_init(sbfi_section_cutter *c, uint32_t bone_count, sbfi_arena *arena) {
  size_t points = (size_t)c->t->point_count + 1;
  c->bone_count = bone_count;
  c->reach = sbfi_arena_allocate(arena, points, sizeof *c->reach);
  c->shared = sbfi_arena_allocate(arena, (size_t)bone_count + 1, sizeof *c->shared);
  c->queue = sbfi_arena_allocate(arena, points, sizeof *c->queue);
  c->new_points = sbfi_arena_allocate(arena, points, sizeof *c->new_points);
  c->queued = sbfi_arena_allocate(arena, points, 1);
  return c->reach && c->shared && c->queue && c->new_points && c->queued;
}

static double length_of(const sbfi_section_cutter *c, uint32_t edge) {
  sbf_uint2 ends = c->t->edges[edge];
  const sbf_vec3 *at = c->skin->mesh.positions.at;
  return sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(at[ends.at[0]]), sbfi_d3_of(at[ends.at[1]])));
}

/* The label beyond an edge at which the bone's part ends; SBFI_NO_INDEX: it does not end there, or with the
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

/* What each point of the border may spend on its way out. */
static void begin_at_border(sbfi_section_cutter *c, uint32_t bone) {
  for (uint32_t p = 0; p < c->t->point_count; p++) c->reach[p] = NOT_REACHED;
  memset(c->shared, 0, c->bone_count * sizeof *c->shared);
  for (uint32_t e = 0; e < c->t->edge_count; e++) {
    uint32_t beyond = label_beyond(c, e, bone);
    if (beyond != SBFI_NO_INDEX) c->shared[beyond] += length_of(c, e);
  }
  for (uint32_t e = 0; e < c->t->edge_count; e++) {
    uint32_t beyond = label_beyond(c, e, bone);
    if (beyond == SBFI_NO_INDEX) continue;
    double reach = c->overlap_m >= 0 ? c->overlap_m : -c->overlap_m * c->shared[beyond] / TWO_PI;
    for (int k = 0; k < 2; k++)
      if (reach > c->reach[c->t->edges[e].at[k]]) c->reach[c->t->edges[e].at[k]] = reach;
  }
}

/* Spreads the reach along edges: a queue of points whose reach has grown. */
static void spread(sbfi_section_cutter *c) {
  uint32_t room = c->t->point_count + 1, head = 0, tail = 0;
  for (uint32_t p = 0; p < c->t->point_count; p++) {
    c->queued[p] = c->reach[p] > 0;
    if (c->queued[p]) c->queue[tail++] = p;
  }
  while (head != tail) {
    uint32_t p = c->queue[head];
    head = head + 1 < room ? head + 1 : 0;
    c->queued[p] = 0;
    for (uint32_t i = c->t->point_edge_begins[p]; i < c->t->point_edge_begins[p + 1]; i++) {
      uint32_t edge = c->t->point_edges[i], other = sbfi_edge_other(c->t, edge, p);
      double left = c->reach[p] - length_of(c, edge);
      if (left <= c->reach[other]) continue;
      c->reach[other] = left;
      if (left <= 0 || c->queued[other]) continue;
      c->queued[other] = 1;
      c->queue[tail] = other;
      tail = tail + 1 < room ? tail + 1 : 0;
    }
  }
}

static bool is_taken(const sbfi_section_cutter *c, uint32_t polygon, uint32_t bone) {
  double sum = 0;
  if (c->labels[polygon] == bone) return true;
  for (uint32_t k = c->t->corner_begins[polygon]; k < c->t->corner_begins[polygon + 1]; k++) {
    double reach = c->reach[c->skin->mesh.polygon_points.at[k]];
    if (reach <= NOT_REACHED) return false;
    sum += reach;
  }
  return sum > 0;
}

bool sbfi_section_cut(sbfi_section_cutter *c, uint32_t bone, sbf_polygon_mesh *mesh, sbfi_arena *arena) {
  const sbf_polygon_mesh *from = &c->skin->mesh;
  uint32_t polygons = 0, corners = 0, points = 0;
  begin_at_border(c, bone);
  spread(c);
  for (uint32_t p = 0; p < c->t->polygon_count; p++) {
    if (!is_taken(c, p, bone)) continue;
    polygons++;
    corners += from->polygon_sizes.at[p];
  }
  uint32_t *sizes = sbfi_arena_allocate(arena, (size_t)polygons + 1, sizeof *sizes);
  uint32_t *at = sbfi_arena_allocate(arena, (size_t)corners + 1, sizeof *at);
  sbf_vec3 *positions = sbfi_arena_allocate(arena, (size_t)corners + 1, sizeof *positions);
  if (!sizes || !at || !positions) return false;
  memset(c->new_points, 0xff, c->t->point_count * sizeof *c->new_points);
  polygons = corners = 0;
  for (uint32_t p = 0; p < c->t->polygon_count; p++) {
    if (!is_taken(c, p, bone)) continue;
    sizes[polygons++] = from->polygon_sizes.at[p];
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
  mesh->polygon_sizes = (sbf_u32_list){sizes, polygons};
  mesh->polygon_points = (sbf_u32_list){at, corners};
  return true;
}
