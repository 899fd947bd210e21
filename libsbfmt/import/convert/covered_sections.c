#include "import/convert/covered_sections.h"

#include <math.h>

#include "build/geometry/triangle_tree.h"
#include "build/geometry/winding_number.h"
#include "mechanics/extent.h"
#include "mechanics/polygon.h"

/* Points this close to a skin's surface count as inside; fraction of the section's extent. */
static const double IN_SURFACE = 0.005;
/* Minimum winding number of an enclosed point. */
static const double ENCLOSED = 0.95;

struct sbfi_one_skin {
  sbfi_triangle_tree surface;
  sbfi_soup soup;
  sbfi_winding winding;
};

bool sbfi_skins_make(
    sbfi_skins *skins, const sbf_render_mesh *meshes, uint32_t mesh_count, sbfi_arena *arena) {
  skins->count = 0;
  skins->at = sbfi_arena_allocate(arena, (size_t)mesh_count + 1, sizeof *skins->at);
  if (!skins->at) return false;
  for (uint32_t m = 0; m < mesh_count; m++) {
    struct sbfi_one_skin *skin = &skins->at[skins->count];
    if (!meshes[m].skin || !meshes[m].mesh.polygon_sizes.count) continue;
    if (!sbfi_triangle_tree_build(&skin->surface, &meshes[m].mesh, arena) ||
        !sbfi_soup_make(&skin->soup, &meshes[m].mesh, arena) ||
        !sbfi_winding_make(&skin->winding, &skin->soup, arena))
      return false;
    skins->count++;
  }
  return true;
}

static bool is_hidden(const sbfi_skins *skins, sbfi_d3 point, double squared_reach) {
  const sbf_vec3 at = {(float)point.x, (float)point.y, (float)point.z};
  for (uint32_t s = 0; s < skins->count; s++) {
    const sbfi_winding *winding = &skins->at[s].winding;
    double min = squared_reach;
    if (sbfi_triangle_tree_nearest(&skins->at[s].surface, at, &min) != UINT32_MAX) return true;
    if (fabs(sbfi_winding_of_closed(winding, point) - sbfi_winding_of_caps(winding, point)) >= ENCLOSED)
      return true;
  }
  return false;
}

bool sbfi_skins_hide(const sbfi_skins *skins, const sbf_polygon_mesh *surface) {
  double squared_reach = pow(IN_SURFACE * sbfi_extent(surface->positions), 2);
  if (!skins->count) return false;
  for (uint32_t p = 0, at = 0; p < surface->polygon_sizes.count; at += surface->polygon_sizes.at[p++]) {
    const uint32_t *points = surface->polygon_points.at + at, size = surface->polygon_sizes.at[p];
    if (!is_hidden(skins, sbfi_polygon_middle(surface->positions.at, points, size), squared_reach))
      return false;
    for (uint32_t k = 0; k < size; k++)
      if (!is_hidden(skins, sbfi_d3_of(surface->positions.at[points[k]]), squared_reach)) return false;
  }
  return true;
}
