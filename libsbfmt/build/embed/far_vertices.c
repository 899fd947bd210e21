#include "build/embed/far_vertices.h"

#include <stdio.h>

enum { IN_POLYGON = 1, COUNTED = 2 };

static bool visit_polygons(sbfi_far_vertices *to, sbfi_arena *arena) {
  const sbf_polygon_mesh *mesh = &to->mesh->mesh;
  to->known = sbfi_arena_allocate(arena, mesh->positions.count, 1);
  for (uint32_t i = 0; to->known && i < mesh->polygon_points.count; i++)
    to->known[mesh->polygon_points.at[i]] = IN_POLYGON;
  return to->known != NULL;
}

bool sbfi_far_vertices_add(
    sbfi_far_vertices *to, uint32_t vertex, double outside_m, uint32_t body, sbfi_arena *arena) {
  if (!to->known && !visit_polygons(to, arena)) return false;
  if (outside_m > to->farthest_m) {
    to->farthest_m = outside_m;
    to->body = body;
  }
  if (to->known[vertex] & COUNTED) return true; /* in another body's part of it */
  to->known[vertex] |= COUNTED;
  to->in_polygons += to->known[vertex] & IN_POLYGON;
  if (to->count < SBFI_FAR_VERTICES_NAMED) to->named[to->count] = vertex;
  to->count++;
  return true;
}

static void list_vertices(const sbfi_far_vertices *of, char *text, size_t size) {
  int used = snprintf(text, size, "%s", of->count == 1 ? "vertex" : "vertices");
  for (uint32_t i = 0; i < of->count && i < SBFI_FAR_VERTICES_NAMED; i++)
    used += snprintf(text + used, size - (size_t)used, "%s %u", i ? "," : "", (unsigned)of->named[i]);
  if (of->count > SBFI_FAR_VERTICES_NAMED)
    snprintf(
        text + used, size - (size_t)used, " and %u more", (unsigned)(of->count - SBFI_FAR_VERTICES_NAMED));
}

void sbfi_far_vertices_report(const sbfi_far_vertices *of, const sbf_asset *asset, sbfi_reporter *reporter) {
  char vertices[128];
  sbf_diagnostic diagnostic;
  const char *what_next =
      of->in_polygons == of->count ? "use a smaller cell"
      : of->in_polygons
          ? "some are in no polygon: remove those from the source; for the others use a smaller cell"
      : of->count == 1 ? "it is in no polygon and therefore invisible: remove it from the source"
                       : "they are in no polygon and therefore invisible: remove them from the source";
  if (of->count == 0) return;
  list_vertices(of, vertices, sizeof vertices);
  sbfi_diagnose(&diagnostic, SBF_CODE_EMBEDDING_FAR,
      "%s of render mesh \"%s\" lie%s more than a cell outside the lattice that deforms %s, up to %.3g m "
      "from the lattice of soft body \"%s\": %s",
      vertices, of->mesh->name, of->count == 1 ? "s" : "", of->count == 1 ? "it" : "them", of->farthest_m,
      asset->soft_bodies.at[of->body].name, what_next);
  sbfi_report(reporter, &diagnostic);
}
