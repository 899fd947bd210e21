/* Surfaces of bodies: closed where a volume is asked for, two polygons at an edge, all facing outwards. */
#include <string.h>

#include "build/topology.h"
#include "sbfmt/mechanics.h"
#include "validate/validation.h"

static uint32_t polygons_at(const sbfi_topology *t, uint32_t edge) {
  return t->edge_polygon_begins[edge + 1] - t->edge_polygon_begins[edge];
}

/* A polygon that stands on edges which two others already share, and has an edge of its own. */
static void find_stray_polygons(
    sbfi_validation *v, const sbfi_topology *t, const sbf_soft_body *body, const char *path) {
  for (uint32_t p = 0; p < t->polygon_count; p++) {
    uint32_t crowded = 0, lonely = 0;
    for (uint32_t c = t->corner_begins[p]; c < t->corner_begins[p + 1]; c++) {
      uint32_t edge = t->corner_edges[c];
      if (edge == SBFI_NO_INDEX) continue;
      crowded += polygons_at(t, edge) > 2;
      lonely += polygons_at(t, edge) == 1;
    }
    if (crowded && lonely)
      sbfi_found(v, SBF_CODE_SURFACE_STRAY_POLYGON, path, p,
          "polygon %u of '%s', with %u corners, stands on an edge that two others share already", p,
          body->name, t->corner_begins[p + 1] - t->corner_begins[p]);
  }
}

static void find_unused(
    sbfi_validation *v, const sbfi_topology *t, const sbf_soft_body *body, const char *path) {
  for (uint32_t i = 0; i < t->point_count; i++) {
    if (t->point_components[i] != SBFI_NO_INDEX) continue;
    if (body->source_points.count)
      sbfi_found(v, SBF_CODE_POINT_UNUSED, path, i,
          "point %u of '%s' (vertex %u of the source, from 0) is in no polygon", i, body->name,
          body->source_points.at[i]);
    else
      sbfi_found(v, SBF_CODE_POINT_UNUSED, path, i, "point %u of '%s' is in no polygon", i, body->name);
  }
}

static void find_degenerate(sbfi_validation *v, const sbf_soft_body *body, const char *path) {
  const sbf_polygon_mesh *mesh = &body->surface;
  for (uint32_t p = 0, at = 0; p < mesh->polygon_sizes.count; at += mesh->polygon_sizes.at[p++]) {
    const sbf_vec3 *points = mesh->positions.at;
    const uint32_t *corner = mesh->polygon_points.at + at;
    double n[3] = {0, 0, 0};
    for (uint32_t k = 0; k < mesh->polygon_sizes.at[p]; k++) { /* Newell's sum: twice the vector area */
      sbf_vec3 a = points[corner[k]], b = points[corner[(k + 1) % mesh->polygon_sizes.at[p]]];
      n[0] += ((double)a.y - (double)b.y) * ((double)a.z + (double)b.z);
      n[1] += ((double)a.z - (double)b.z) * ((double)a.x + (double)b.x);
      n[2] += ((double)a.x - (double)b.x) * ((double)a.y + (double)b.y);
    }
    if (n[0] * n[0] + n[1] * n[1] + n[2] * n[2] == 0)
      sbfi_found(v, SBF_CODE_POLYGON_FLAT, path, p, "polygon %u of '%s' has no area", p, body->name);
  }
}

static void check_surface(sbfi_validation *v, const sbf_soft_body *body, const char *path) {
  sbfi_topology t;
  if (!sbfi_topology_build(&t, &body->surface, &v->scratch)) {
    v->out_of_memory = true;
    return;
  }
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  find_unused(v, &t, body, path);
  find_degenerate(v, body, path);
  if (body->surface.polygon_sizes.count == 0) {
    if (body->levels.count == 0)
      sbfi_found(v, SBF_CODE_SURFACE_EMPTY, path, -1, "'%s' has neither polygons nor a level", body->name);
    return;
  }
  find_stray_polygons(v, &t, body, path);
  if (t.clashing_edge_count)
    sbfi_found(v, SBF_CODE_SURFACE_WINDING, path, -1,
        "%u edges of '%s' lie between polygons that face opposite ways", t.clashing_edge_count, body->name);
  if (t.component_count > 1)
    sbfi_found(
        v, SBF_CODE_SURFACE_PIECES, path, -1, "'%s' consists of %u pieces", body->name, t.component_count);
  if (measures.sheet) return;
  if (t.boundary_edge_count)
    sbfi_found(v, SBF_CODE_SURFACE_OPEN, path, -1, "'%s' is open: %u edges have one polygon only", body->name,
        t.boundary_edge_count);
  if (t.nonmanifold_edge_count)
    sbfi_found(v, SBF_CODE_SURFACE_NONMANIFOLD, path, -1, "%u edges of '%s' have more than two polygons",
        t.nonmanifold_edge_count, body->name);
  sbf_surface_measures surface;
  sbf_surface_measure(&body->surface, NULL, &surface);
  if (surface.volume < 0)
    sbfi_found(v, SBF_CODE_SURFACE_INSIDE_OUT, path, -1, "the polygons of '%s' face inwards", body->name);
}

void sbfi_check_surfaces(sbfi_validation *v) {
  for (uint32_t i = 0; i < v->asset->soft_bodies.count && !v->out_of_memory; i++)
    check_surface(
        v, &v->asset->soft_bodies.at[i], sbfi_path_of("/sbf/soft_body[%u]/polygon_mesh", i + 1).text);
}
