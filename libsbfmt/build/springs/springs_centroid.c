/* An interior with a centre and a point for each polygon, in the order and precision of the reference. */
#include "build/springs/springs.h"

static sbf_vec3 plus(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static sbf_vec3 over(sbf_vec3 a, float divisor) {
  return (sbf_vec3){a.x / divisor, a.y / divisor, a.z / divisor};
}

static bool triangles_prevail(const sbf_polygon_mesh *mesh) {
  size_t triangles = 0;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++) triangles += mesh->polygon_sizes.at[p] == 3;
  return 2 * triangles >= mesh->polygon_sizes.count;
}

bool sbfi_springs_centroid(
    sbfi_centroid_interior *interior, const sbf_polygon_mesh *mesh, uint32_t given, sbfi_arena *arena) {
  uint32_t surface_count = mesh->positions.count, polygon_count = mesh->polygon_sizes.count;
  *interior = (sbfi_centroid_interior){.points = NULL};
  if (surface_count == 0) return true;
  size_t max_springs = (size_t)surface_count + mesh->polygon_points.count + polygon_count;
  interior->points = sbfi_arena_allocate(arena, (size_t)polygon_count + 1, sizeof(sbf_vec3));
  interior->polygon_points = sbfi_arena_allocate(arena, (size_t)polygon_count + 1, sizeof(uint32_t));
  interior->internal.at = sbfi_arena_allocate(arena, max_springs, sizeof(sbf_uint2));
  /* A polygon that visits a point twice, around a hole, still has one spring to it. */
  uint32_t *last_polygons = sbfi_arena_allocate(arena, surface_count, sizeof(uint32_t));
  if (!interior->points || !interior->polygon_points || !interior->internal.at || !last_polygons)
    return false;

  sbf_vec3 sum = {0, 0, 0};
  uint32_t centre = surface_count + given;
  sbfi_spring_list *springs = &interior->internal;
  for (uint32_t i = 0; i < surface_count; i++) {
    sum = plus(sum, mesh->positions.at[i]);
    springs->at[springs->count++] = (sbf_uint2){{centre, i}};
  }
  interior->points[interior->point_count++] = over(sum, (float)surface_count);

  bool with_triangles = triangles_prevail(mesh);
  const uint32_t *corners = mesh->polygon_points.at;
  for (uint32_t p = 0; p < polygon_count; corners += mesh->polygon_sizes.at[p++]) {
    uint32_t size = mesh->polygon_sizes.at[p];
    interior->polygon_points[p] = SBFI_NO_INDEX;
    if (size == 3 && !with_triangles) continue;
    uint32_t index = interior->point_count++;
    sum = (sbf_vec3){0, 0, 0};
    for (uint32_t k = 0; k < size; k++) {
      sum = plus(sum, mesh->positions.at[corners[k]]);
      if (last_polygons[corners[k]] == p + 1) continue;
      last_polygons[corners[k]] = p + 1;
      springs->at[springs->count++] = (sbf_uint2){{centre + index, corners[k]}};
    }
    springs->at[springs->count++] = (sbf_uint2){{centre + index, centre}};
    interior->points[index] = over(plus(sum, interior->points[0]), (float)(size + 1));
    interior->polygon_points[p] = index;
  }
  return true;
}
