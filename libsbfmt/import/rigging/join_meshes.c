#include "import/rigging/join_meshes.h"

#include <stdlib.h>
#include <string.h>

#include "import/rigging/mesh_borders.h"

static void *allocate(sbfi_arena *arena, size_t count, size_t size) {
  return sbfi_arena_allocate(arena, count + 1, size);
}

typedef struct piece_point {
  sbf_vec3 at;
  uint32_t source, mesh, local;
  uint32_t rank; /* rank among points of its piece at this position, which stay separate */
} piece_point;

static int compare_numbers(uint32_t a, uint32_t b) {
  return a == b ? 0 : a < b ? -1 : 1;
}

static int compare_by_piece(const void *a, const void *b) {
  const piece_point *x = a, *y = b;
  int order = sbfi_compare_positions(&x->at, &y->at);
  if (!order) order = compare_numbers(x->mesh, y->mesh);
  return order ? order : compare_numbers(x->source, y->source);
}

/* Sorts points that will be merged next to each other, in file order. */
static int compare_by_rank(const void *a, const void *b) {
  const piece_point *x = a, *y = b;
  int order = sbfi_compare_positions(&x->at, &y->at);
  if (!order) order = compare_numbers(x->rank, y->rank);
  return order ? order : compare_numbers(x->source, y->source);
}

static int compare_by_source(const void *a, const void *b) {
  const piece_point *const *x = a, *const *y = b;
  return compare_numbers((*x)->source, (*y)->source);
}

static bool is_one(const piece_point *a, const piece_point *b) {
  return a->rank == b->rank && sbfi_compare_positions(&a->at, &b->at) == 0;
}

static void rank_points(piece_point *all, uint32_t count) {
  qsort(all, count, sizeof *all, compare_by_piece);
  for (uint32_t i = 1; i < count; i++)
    if (all[i].mesh == all[i - 1].mesh && sbfi_compare_positions(&all[i].at, &all[i - 1].at) == 0)
      all[i].rank = all[i - 1].rank + 1;
  qsort(all, count, sizeof *all, compare_by_rank);
}

typedef struct joining {
  sbfi_arena *arena;
  const uint32_t *sets;
  const sbfi_scene_mesh *meshes; /* before the merge */
  uint32_t mesh_count, root;
  uint32_t **points; /* (meshes) new indices of each mesh's points */
} joining;

static bool is_of(const joining *j, uint32_t mesh) {
  return j->sets[mesh] == j->root;
}

/* Merges points of several pieces at one position, in file order. */
static bool join_points(joining *j, sbfi_scene_mesh *to) {
  uint32_t total = 0, count = 0;
  for (uint32_t m = 0; m < j->mesh_count; m++) total += is_of(j, m) ? j->meshes[m].point_count : 0;
  piece_point *all = allocate(j->arena, total, sizeof *all);
  const piece_point **first = allocate(j->arena, total, sizeof *first);
  uint32_t *number_of = allocate(j->arena, total, sizeof *number_of);
  sbf_vec3 *points = allocate(j->arena, total, sizeof *points);
  uint32_t *sources = allocate(j->arena, total, sizeof *sources), at = 0;
  if (!all || !first || !number_of || !points || !sources) return false;
  for (uint32_t m = 0; m < j->mesh_count; m++) {
    if (!is_of(j, m)) continue;
    j->points[m] = allocate(j->arena, j->meshes[m].point_count, sizeof *j->points[m]);
    if (!j->points[m]) return false;
    for (uint32_t i = 0; i < j->meshes[m].point_count; i++)
      all[at++] = (piece_point){j->meshes[m].points[i], j->meshes[m].point_sources[i], m, i, 0};
  }
  rank_points(all, total);
  for (uint32_t i = 0; i < total; i++)
    if (i == 0 || !is_one(&all[i], &all[i - 1])) first[count++] = &all[i];
  qsort(first, count, sizeof *first, compare_by_source);
  for (uint32_t n = 0; n < count; n++) {
    points[n] = first[n]->at;
    sources[n] = first[n]->source;
    number_of[first[n] - all] = n;
  }
  for (uint32_t i = 0; i < total; i++) {
    if (i > 0 && is_one(&all[i], &all[i - 1])) number_of[i] = number_of[i - 1];
    j->points[all[i].mesh][all[i].local] = number_of[i];
  }
  to->points = points;
  to->point_sources = sources;
  to->point_count = count;
  return true;
}

/* Copies indices of corners into a list of values that grew by `offset`; SBF_NONE if the piece has no such
 * list. */
static void copy_corners(const int32_t *from, uint32_t count, uint32_t offset, int32_t *to) {
  for (uint32_t i = 0; i < count; i++)
    to[i] = from && from[i] != SBF_NONE ? from[i] + (int32_t)offset : SBF_NONE;
}

static bool join_polygons(const joining *j, sbfi_scene_mesh *to) {
  uint32_t *starts = allocate(j->arena, (size_t)to->polygon_count + 1, sizeof *starts);
  int32_t *materials = allocate(j->arena, to->polygon_count, sizeof *materials);
  uint32_t *corners = allocate(j->arena, to->corner_count, sizeof *corners), polygon = 0, corner = 0;
  if (!starts || !materials || !corners) return false;
  for (uint32_t m = 0; m < j->mesh_count; m++) {
    const sbfi_scene_mesh *from = &j->meshes[m];
    for (uint32_t p = 0; is_of(j, m) && p < from->polygon_count; p++) {
      materials[polygon] = from->polygon_materials[p];
      for (uint32_t k = from->polygon_starts[p]; k < from->polygon_starts[p + 1]; k++)
        corners[corner++] = j->points[m][from->corner_points[k]];
      starts[++polygon] = corner;
    }
  }
  to->polygon_starts = starts;
  to->polygon_materials = materials;
  to->corner_points = corners;
  return true;
}

/* A list of values that corners index. */
typedef struct corner_values {
  uint32_t count;
  const void *at;
  const int32_t *corners; /* (corner_count) index or SBF_NONE; NULL: no values */
} corner_values;

static corner_values normals_of(const sbfi_scene_mesh *mesh) {
  return (corner_values){mesh->normals.count, mesh->normals.at, mesh->normals.corner_index};
}

static corner_values colors_of(const sbfi_scene_mesh *mesh) {
  return (corner_values){mesh->colors.count, mesh->colors.at, mesh->colors.corner_index};
}

/* An OBJ has at most one set. */
static corner_values uvs_of(const sbfi_scene_mesh *mesh) {
  if (!mesh->uv_set_count) return (corner_values){0, NULL, NULL};
  return (corner_values){mesh->uv_sets[0].count, mesh->uv_sets[0].at, mesh->uv_sets[0].corner};
}

/* Appends the values of all pieces; `size` is that of a value. */
static bool join_values(const joining *j, uint32_t corner_count,
    corner_values (*values_of)(const sbfi_scene_mesh *mesh), size_t size, corner_values *joined) {
  uint32_t total = 0, count = 0, corner = 0;
  for (uint32_t m = 0; m < j->mesh_count; m++) total += is_of(j, m) ? values_of(&j->meshes[m]).count : 0;
  char *values = allocate(j->arena, total, size);
  int32_t *corners = allocate(j->arena, corner_count, sizeof *corners);
  if (!values || !corners) return false;
  for (uint32_t m = 0; m < j->mesh_count; m++) {
    if (!is_of(j, m)) continue;
    corner_values from = values_of(&j->meshes[m]);
    copy_corners(from.corners, j->meshes[m].corner_count, count, corners + corner);
    if (from.count) memcpy(values + count * size, from.at, from.count * size);
    count += from.count;
    corner += j->meshes[m].corner_count;
  }
  *joined = (corner_values){total, values, total ? corners : NULL};
  return true;
}

static bool join_attributes(const joining *j, sbfi_scene_mesh *to) {
  corner_values normals, colors, uvs;
  sbfi_scene_uvs *set = allocate(j->arena, 1, sizeof *set);
  if (!set || !join_values(j, to->corner_count, normals_of, sizeof(sbf_vec3), &normals) ||
      !join_values(j, to->corner_count, colors_of, sizeof(sbf_vec4), &colors) ||
      !join_values(j, to->corner_count, uvs_of, sizeof(sbf_vec2), &uvs))
    return false;
  to->normals = (sbfi_scene_normals){normals.count, normals.at, normals.corners};
  to->colors = (sbfi_scene_colors){colors.count, colors.at, colors.corners};
  *set = (sbfi_scene_uvs){"", uvs.count, uvs.at, uvs.corners};
  to->uv_sets = set;
  to->uv_set_count = uvs.count ? 1 : 0;
  return true;
}

bool sbfi_join_meshes(sbfi_arena *arena, const uint32_t *sets, uint32_t root, const sbfi_scene_mesh *meshes,
    uint32_t mesh_count, sbfi_scene_mesh *to) {
  joining all = {arena, sets, meshes, mesh_count, root, allocate(arena, mesh_count, sizeof *all.points)};
  joining *j = &all;
  if (!j->points) return false;
  *to = j->meshes[j->root];
  to->polygon_count = to->corner_count = 0;
  for (uint32_t m = 0; m < j->mesh_count; m++) {
    if (!is_of(j, m)) continue;
    to->polygon_count += j->meshes[m].polygon_count;
    to->corner_count += j->meshes[m].corner_count;
  }
  return join_points(j, to) && join_polygons(j, to) && join_attributes(j, to);
}
