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

static bool join_normals(const joining *j, sbfi_scene_mesh *to) {
  uint32_t total = 0, count = 0, corner = 0;
  for (uint32_t m = 0; m < j->mesh_count; m++) total += is_of(j, m) ? j->meshes[m].normals.count : 0;
  sbf_vec3 *normals = allocate(j->arena, total, sizeof *normals);
  int32_t *corners = allocate(j->arena, to->corner_count, sizeof *corners);
  if (!normals || !corners) return false;
  for (uint32_t m = 0; m < j->mesh_count; m++) {
    const sbfi_scene_mesh *from = &j->meshes[m];
    if (!is_of(j, m)) continue;
    copy_corners(from->normals.corner_index, from->corner_count, count, corners + corner);
    if (from->normals.count) memcpy(normals + count, from->normals.at, from->normals.count * sizeof *normals);
    count += from->normals.count;
    corner += from->corner_count;
  }
  to->normals.at = normals;
  to->normals.count = total;
  to->normals.corner_index = total ? corners : NULL;
  return true;
}

static bool join_colors(const joining *j, sbfi_scene_mesh *to) {
  uint32_t total = 0, count = 0, corner = 0;
  for (uint32_t m = 0; m < j->mesh_count; m++) total += is_of(j, m) ? j->meshes[m].colors.count : 0;
  sbf_vec4 *colors = allocate(j->arena, total, sizeof *colors);
  int32_t *corners = allocate(j->arena, to->corner_count, sizeof *corners);
  if (!colors || !corners) return false;
  for (uint32_t m = 0; m < j->mesh_count; m++) {
    const sbfi_scene_mesh *from = &j->meshes[m];
    if (!is_of(j, m)) continue;
    copy_corners(from->colors.corner_index, from->corner_count, count, corners + corner);
    if (from->colors.count) memcpy(colors + count, from->colors.at, from->colors.count * sizeof *colors);
    count += from->colors.count;
    corner += from->corner_count;
  }
  to->colors.at = colors;
  to->colors.count = total;
  to->colors.corner_index = total ? corners : NULL;
  return true;
}

/* An OBJ has at most one set. */
static bool join_uvs(const joining *j, sbfi_scene_mesh *to) {
  uint32_t total = 0, count = 0, corner = 0;
  for (uint32_t m = 0; m < j->mesh_count; m++)
    total += is_of(j, m) && j->meshes[m].uv_set_count ? j->meshes[m].uv_sets[0].count : 0;
  sbfi_scene_uvs *set = allocate(j->arena, 1, sizeof *set);
  sbf_vec2 *uvs = allocate(j->arena, total, sizeof *uvs);
  int32_t *corners = allocate(j->arena, to->corner_count, sizeof *corners);
  if (!set || !uvs || !corners) return false;
  for (uint32_t m = 0; m < j->mesh_count; m++) {
    const sbfi_scene_uvs *from = j->meshes[m].uv_set_count ? j->meshes[m].uv_sets : NULL;
    if (!is_of(j, m)) continue;
    copy_corners(from ? from->corner : NULL, j->meshes[m].corner_count, count, corners + corner);
    if (from && from->count) memcpy(uvs + count, from->at, from->count * sizeof *uvs);
    count += from ? from->count : 0;
    corner += j->meshes[m].corner_count;
  }
  *set = (sbfi_scene_uvs){"", total, uvs, corners};
  to->uv_sets = set;
  to->uv_set_count = total ? 1 : 0;
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
  return join_points(j, to) && join_polygons(j, to) && join_normals(j, to) && join_colors(j, to) &&
         join_uvs(j, to);
}
