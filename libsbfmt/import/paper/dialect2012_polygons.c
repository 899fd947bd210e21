/* Polygons of the 2012 dialect, whose corners name vertices by id. */
#include <string.h>

#include "import/paper/dialect2012.h"

sbf_status sbfi_paper_polygons(
    sbfi_conversion *c, const sbfi_paper_surface *surface, const char *what, sbf_polygon_mesh *mesh) {
  uint32_t point_count = (uint32_t)surface->vertices.values.count;
  uint32_t corner_count = (uint32_t)surface->corners.count;
  sbf_vec3 *points = sbfi_convert_allocate(c, point_count, sizeof *points);
  uint32_t *indices = sbfi_convert_allocate(c, corner_count, sizeof *indices);
  uint32_t *sizes = sbfi_convert_allocate(c, surface->sizes.count, sizeof *sizes);
  sbfi_paper_table table;
  if ((point_count && !points) || (corner_count && (!indices || !sizes))) return sbfi_convert_no_memory(c);
  if (!sbfi_paper_table_make(c, &table, &surface->vertices.ids, what)) return sbfi_paper_fault(c);
  const sbf_vec3 *from = surface->vertices.values.at;
  const sbfi_paper_corner *corners = surface->corners.at;
  for (uint32_t i = 0; i < point_count; i++) points[i] = sbfi_transform_point(&c->to_asset, from[i]);
  for (uint32_t i = 0; i < corner_count; i++)
    if (!sbfi_paper_find(c, &table, corners[i].vertex, what, &indices[i])) return sbfi_paper_fault(c);
  if (sizes) memcpy(sizes, surface->sizes.at, surface->sizes.count * sizeof *sizes);
  mesh->positions = (sbf_vec3_list){points, point_count};
  mesh->polygon_sizes = (sbf_u32_list){sizes, (uint32_t)surface->sizes.count};
  mesh->polygon_points = (sbf_u32_list){indices, corner_count};
  return SBF_OK;
}
