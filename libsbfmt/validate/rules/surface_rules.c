/* Checks surfaces of bodies: closed if a volume is required, two polygons at an edge, all facing outwards.
 * Surfaces cut from a skin by a build keep the skin's faults, including intersections; they move with
 * lattices, which tolerate that. The build reports what it could not close. */
#include <math.h>

#include "build/geometry/key_set.h"
#include "build/geometry/polygon_repeats.h"
#include "build/geometry/topology.h"
#include "mechanics/polygon.h"
#include "sbfmt/mechanics.h"
#include "validate/rules/crossing.h"
#include "validate/validation.h"

typedef struct surface {
  sbfi_validation *v;
  const sbf_soft_body *body;
  const char *name;
  sbfi_topology t;
  sbfi_path mesh, positions, polygons, interior;
} surface;

static uint32_t polygons_at(const sbfi_topology *t, uint32_t edge) {
  return t->edge_polygon_begins[edge + 1] - t->edge_polygon_begins[edge];
}

/* Finds polygons at edges that two others already share, with an edge of their own. */
static void find_extra_polygons(const surface *s) {
  const sbfi_topology *t = &s->t;
  for (uint32_t p = 0; p < t->polygon_count; p++) {
    uint32_t crowded = 0, boundary = 0;
    for (uint32_t c = t->corner_begins[p]; c < t->corner_begins[p + 1]; c++) {
      uint32_t edge = t->corner_edges[c];
      if (edge == SBFI_NO_INDEX) continue;
      crowded += polygons_at(t, edge) > 2;
      boundary += polygons_at(t, edge) == 1;
    }
    if (crowded && boundary)
      sbfi_found(s->v, SBF_CODE_SURFACE_STRAY_POLYGON, s->polygons.text, p,
          "polygon %u of '%s', with %u corners, is on an edge that two others share already", p, s->name,
          t->corner_begins[p + 1] - t->corner_begins[p]);
  }
}

static void find_unused(const surface *s) {
  const sbf_u32_list source = s->body->source_points;
  for (uint32_t i = 0; i < s->t.point_count; i++) {
    if (s->t.point_components[i] != SBFI_NO_INDEX) continue;
    if (source.count)
      sbfi_found(s->v, SBF_CODE_POINT_UNUSED, s->positions.text, i,
          "point %u of '%s' (vertex %u of the source, from 0) is in no polygon", i, s->name, source.at[i]);
    else
      sbfi_found(
          s->v, SBF_CODE_POINT_UNUSED, s->positions.text, i, "point %u of '%s' is in no polygon", i, s->name);
  }
}

/* Whether the area is below the rounding error of its points. */
static bool is_flat(const sbf_vec3 *positions, const uint32_t *corners, uint32_t size) {
  sbfi_d3 middle = sbfi_polygon_middle(positions, corners, size);
  double farthest = 0;
  for (uint32_t k = 0; k < size; k++) {
    sbfi_d3 displacement = sbfi_d3_sub(sbfi_d3_of(positions[corners[k]]), middle);
    farthest = fmax(farthest, sbfi_d3_dot(displacement, displacement));
  }
  return sbfi_d3_length(sbfi_polygon_area(positions, corners, size, middle)) <= 1e-7 * farthest;
}

static void find_degenerate(const surface *s) {
  const sbf_polygon_mesh *mesh = &s->body->surface;
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; corners += mesh->polygon_sizes.at[p++]) {
    if (is_flat(mesh->positions.at, corners, mesh->polygon_sizes.at[p]))
      sbfi_found(
          s->v, SBF_CODE_POLYGON_FLAT, s->polygons.text, p, "polygon %u of '%s' has no area", p, s->name);
    for (uint32_t c = s->t.corner_begins[p]; c < s->t.corner_begins[p + 1]; c++)
      if (s->t.corner_edges[c] == SBFI_NO_INDEX)
        sbfi_found(s->v, SBF_CODE_POLYGON_SIDE_EMPTY, s->polygons.text, p,
            "polygon %u of '%s' names point %u twice in a row", p, s->name, mesh->polygon_points.at[c]);
  }
}

static void find_repeated(const surface *s) {
  uint32_t *firsts = sbfi_scratch(s->v, s->t.polygon_count, sizeof *firsts);
  if (!firsts) return;
  if (!sbfi_polygon_repeats_find(&s->body->surface, firsts, &s->v->scratch)) {
    s->v->out_of_memory = true;
    return;
  }
  for (uint32_t p = 0; p < s->t.polygon_count; p++)
    if (firsts[p] != p)
      sbfi_found(s->v, SBF_CODE_POLYGON_REPEATED, s->polygons.text, p,
          "polygon %u of '%s' has the points of polygon %u", p, s->name, firsts[p]);
}

/* Second polygon at the first edge that two traverse in the same direction. */
static uint32_t first_opposite_pair(const surface *s) {
  const sbfi_topology *t = &s->t;
  const uint32_t *corners = s->body->surface.polygon_points.at;
  for (uint32_t p = 0; p < t->polygon_count; p++)
    for (uint32_t c = t->corner_begins[p]; c < t->corner_begins[p + 1]; c++) {
      uint32_t e = t->corner_edges[c];
      if (e == SBFI_NO_INDEX || polygons_at(t, e) != 2) continue;
      const uint32_t *both = &t->edge_polygons[t->edge_polygon_begins[e]];
      /* the first of the two traversed it from end 0 to end 1 */
      if (both[1] == p && both[0] != p && corners[c] == t->edges[e].at[0]) return p;
    }
  return 0;
}

static void check_winding(const surface *s) {
  if (s->t.clashing_edge_count == 0) return;
  uint32_t p = first_opposite_pair(s);
  sbfi_found(s->v, SBF_CODE_SURFACE_WINDING, s->polygons.text, p,
      "%u edge%s of '%s' lie%s between polygons that face opposite directions, the first at polygon %u",
      s->t.clashing_edge_count, sbfi_plural(s->t.clashing_edge_count), s->name,
      s->t.clashing_edge_count == 1 ? "s" : "", p);
}

/* Finds coincident points at the border of an open surface: a seam that was never welded. */
static void find_seams(const surface *s) {
  const sbfi_topology *t = &s->t;
  sbfi_key_set positions;
  uint32_t count = 0, first = 0;
  uint8_t *at_border = sbfi_scratch(s->v, t->point_count, 1);
  if (!at_border) return;
  if (!sbfi_key_set_init(&positions, 2 * (size_t)t->boundary_edge_count, &s->v->scratch)) {
    s->v->out_of_memory = true;
    return;
  }
  for (uint32_t e = 0; e < t->edge_count; e++)
    if (polygons_at(t, e) == 1) at_border[t->edges[e].at[0]] = at_border[t->edges[e].at[1]] = 1;
  for (uint32_t i = 0; i < t->point_count; i++) {
    if (!at_border[i]) continue;
    uint32_t *seen = sbfi_key_set_find(&positions, sbfi_key_of_position(s->body->surface.positions.at[i]));
    if (*seen == UINT32_MAX)
      *seen = i;
    else if (count++ == 0)
      first = i;
  }
  if (count)
    sbfi_found(s->v, SBF_CODE_SURFACE_UNWELDED, s->positions.text, first,
        "%u point%s at open edges of '%s' stand%s where another stands, the first is point %u", count,
        sbfi_plural(count), s->name, count == 1 ? "s" : "", first);
}

static void find_crossings(const surface *s) {
  uint32_t *partners = sbfi_scratch(s->v, s->t.polygon_count, sizeof *partners);
  if (!partners) return;
  if (!sbfi_crossings_find(&s->body->surface, partners, &s->v->scratch)) {
    s->v->out_of_memory = true;
    return;
  }
  for (uint32_t p = 0; p < s->t.polygon_count; p++)
    if (partners[p] != SBFI_NO_CROSSING)
      sbfi_found(s->v, SBF_CODE_SURFACE_CROSSES, s->polygons.text, p, "polygon %u of '%s' crosses polygon %u",
          p, s->name, partners[p]);
}

/* Finds interior points outside the surface by more than rounding. */
static void find_outside_points(const surface *s, const sbf_body_measures *measures) {
  const sbf_soft_body *body = s->body;
  sbfi_triangle_tree tree;
  if (body->interior.count == 0 || s->t.boundary_edge_count || s->t.nonmanifold_edge_count) return;
  if (!sbfi_triangle_tree_build(&tree, &body->surface, &s->v->scratch)) {
    s->v->out_of_memory = true;
    return;
  }
  for (uint32_t i = 0; i < body->interior.count; i++) {
    if (sbfi_surface_encloses(&tree, body->interior.at[i])) continue;
    double near = 1e-6 * measures->depth * measures->depth;
    if (sbfi_triangle_tree_nearest(&tree, body->interior.at[i], &near) == UINT32_MAX)
      sbfi_found(s->v, SBF_CODE_INTERIOR_OUTSIDE, s->interior.text, i,
          "interior point %u of '%s' lies outside its surface", i, s->name);
  }
}

static void check_volume(const surface *s, const sbf_body_measures *measures) {
  const sbfi_topology *t = &s->t;
  if (t->boundary_edge_count)
    sbfi_found(s->v, SBF_CODE_SURFACE_OPEN, s->mesh.text, -1, "'%s' is open, %u edge%s one polygon only",
        s->name, t->boundary_edge_count, t->boundary_edge_count == 1 ? " has" : "s have");
  if (t->nonmanifold_edge_count)
    sbfi_found(s->v, SBF_CODE_SURFACE_NONMANIFOLD, s->mesh.text, -1,
        "%u edge%s of '%s' %s more than two polygons", t->nonmanifold_edge_count,
        sbfi_plural(t->nonmanifold_edge_count), s->name, t->nonmanifold_edge_count == 1 ? "has" : "have");
  sbf_surface_measures whole;
  sbf_surface_measure(&s->body->surface, NULL, &whole);
  if (whole.volume < 0)
    sbfi_found(
        s->v, SBF_CODE_SURFACE_INSIDE_OUT, s->mesh.text, -1, "the polygons of '%s' face inwards", s->name);
  find_crossings(s);
  find_outside_points(s, measures);
}

static void check_surface(sbfi_validation *v, uint32_t number) {
  const sbf_soft_body *body = &v->asset->soft_bodies.at[number];
  surface s = {.v = v,
      .body = body,
      .name = sbfi_label(body->name, body->id),
      .mesh = sbfi_path_of("/sbf/soft_body[%u]/polygon_mesh", number + 1),
      .positions = sbfi_path_of("/sbf/soft_body[%u]/polygon_mesh/positions", number + 1),
      .polygons = sbfi_path_of("/sbf/soft_body[%u]/polygon_mesh/polygon_sizes", number + 1),
      .interior = sbfi_path_of("/sbf/soft_body[%u]/interior", number + 1)};
  if (body->surface.polygon_sizes.count == 0) {
    if (body->levels.count == 0)
      sbfi_found(v, SBF_CODE_SURFACE_EMPTY, sbfi_path_of("/sbf/soft_body[%u]", number + 1).text, -1,
          "'%s' has neither polygons nor a level", s.name);
    return;
  }
  if (!sbfi_topology_build(&s.t, &body->surface, &v->scratch)) {
    v->out_of_memory = true;
    return;
  }
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  find_unused(&s);
  find_degenerate(&s);
  find_repeated(&s);
  find_extra_polygons(&s);
  check_winding(&s);
  find_seams(&s);
  if (s.t.component_count > 1)
    sbfi_found(v, SBF_CODE_SURFACE_PIECES, s.mesh.text, -1, "'%s' consists of %u pieces", s.name,
        s.t.component_count);
  if (!measures.sheet) check_volume(&s, &measures);
}

void sbfi_check_surfaces(sbfi_validation *v) {
  for (uint32_t i = 0; i < v->asset->soft_bodies.count && !v->out_of_memory; i++)
    if (v->asset->soft_bodies.at[i].derived == SBF_NONE || !v->asset->soft_bodies.at[i].levels.count)
      check_surface(v, i);
}
