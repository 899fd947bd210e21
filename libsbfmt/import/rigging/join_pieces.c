#include "import/rigging/join_pieces.h"

#include <stdlib.h>
#include <string.h>

#include "base/union_find.h"

static void *allocate(const sbfi_rigging *r, size_t count, size_t size) {
  return sbfi_arena_allocate(&r->c->scratch, count + 1, size);
}

static int compare_points(const sbf_vec3 *a, const sbf_vec3 *b) {
  if (a->x != b->x) return a->x < b->x ? -1 : 1;
  if (a->y != b->y) return a->y < b->y ? -1 : 1;
  return a->z == b->z ? 0 : a->z < b->z ? -1 : 1;
}

/* Whether the mesh is attached like a mesh of the rig, and its format has no vertices of its own. */
static bool is_piece(const sbfi_rigging *r, uint32_t mesh) {
  if (r->parent_nodes[mesh] == SBF_NONE || r->input.scene->meshes[mesh].corner_vertices) return false;
  for (uint32_t m = 0; m < r->rig.scene->mesh_count; m++)
    if (r->rig.scene->meshes[m].node == r->parent_nodes[mesh]) return true;
  return false;
}

/* --- Which of them belong together --------------------------------------------------------------------- */

typedef struct side {
  sbf_vec3 ends[2]; /* the smaller one first */
  uint32_t mesh;
} side;

static int compare_sides(const void *a, const void *b) {
  const side *x = a, *y = b;
  for (int k = 0; k < 2; k++) {
    int order = compare_points(&x->ends[k], &y->ends[k]);
    if (order) return order;
  }
  return x->mesh == y->mesh ? 0 : x->mesh < y->mesh ? -1 : 1;
}

static uint32_t add_sides(const sbfi_scene_mesh *mesh, uint32_t number, side *to) {
  uint32_t count = 0;
  for (uint32_t p = 0; p < mesh->polygon_count; p++)
    for (uint32_t k = mesh->polygon_starts[p]; k < mesh->polygon_starts[p + 1]; k++) {
      uint32_t next = k + 1 < mesh->polygon_starts[p + 1] ? k + 1 : mesh->polygon_starts[p];
      sbf_vec3 a = mesh->points[mesh->corner_points[k]], b = mesh->points[mesh->corner_points[next]];
      bool ordered = compare_points(&a, &b) < 0;
      to[count++] = (side){{ordered ? a : b, ordered ? b : a}, number};
    }
  return count;
}

/* Edges that an odd number of a piece's polygons share are its border. */
static bool join_along_borders(const sbfi_rigging *r, uint32_t *sets) {
  const sbfi_scene *scene = r->input.scene;
  size_t total = 0, count = 0;
  for (uint32_t m = 0; m < scene->mesh_count; m++)
    total += is_piece(r, m) ? scene->meshes[m].corner_count : 0;
  side *sides = allocate(r, total, sizeof *sides);
  if (!sides) return false;
  for (uint32_t m = 0; m < scene->mesh_count; m++)
    if (is_piece(r, m)) count += add_sides(&scene->meshes[m], m, sides + count);
  qsort(sides, count, sizeof *sides, compare_sides);
  uint32_t last = UINT32_MAX; /* the previous piece with a border here */
  for (size_t i = 0, end; i < count; i = end) {
    bool same = i > 0 && compare_points(&sides[i].ends[0], &sides[i - 1].ends[0]) == 0 &&
                compare_points(&sides[i].ends[1], &sides[i - 1].ends[1]) == 0;
    for (end = i + 1; end < count && compare_sides(&sides[end], &sides[i]) == 0;) end++;
    if (!same) last = UINT32_MAX;
    if ((end - i) % 2 == 0) continue;
    if (last != UINT32_MAX && r->parent_nodes[last] == r->parent_nodes[sides[i].mesh])
      sbfi_sets_join(sets, last, sides[i].mesh);
    last = sides[i].mesh;
  }
  return true;
}

static void join_those_by_position(const sbfi_rigging *r, uint32_t *sets) {
  for (uint32_t m = 0; m < r->input.scene->mesh_count; m++)
    for (uint32_t k = 0; is_piece(r, m) && r->matched_nodes[m] == r->parent_nodes[m] && k < m; k++)
      if (is_piece(r, k) && r->matched_nodes[k] == r->matched_nodes[m]) sbfi_sets_join(sets, k, m);
}

/* --- Making one of several ----------------------------------------------------------------------------- */

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
  int order = compare_points(&x->at, &y->at);
  if (!order) order = compare_numbers(x->mesh, y->mesh);
  return order ? order : compare_numbers(x->source, y->source);
}

/* Sorts points that will be merged next to each other, in file order. */
static int compare_by_rank(const void *a, const void *b) {
  const piece_point *x = a, *y = b;
  int order = compare_points(&x->at, &y->at);
  if (!order) order = compare_numbers(x->rank, y->rank);
  return order ? order : compare_numbers(x->source, y->source);
}

static int compare_by_source(const void *a, const void *b) {
  const piece_point *const *x = a, *const *y = b;
  return compare_numbers((*x)->source, (*y)->source);
}

static bool is_one(const piece_point *a, const piece_point *b) {
  return a->rank == b->rank && compare_points(&a->at, &b->at) == 0;
}

static void rank_points(piece_point *all, uint32_t count) {
  qsort(all, count, sizeof *all, compare_by_piece);
  for (uint32_t i = 1; i < count; i++)
    if (all[i].mesh == all[i - 1].mesh && compare_points(&all[i].at, &all[i - 1].at) == 0)
      all[i].rank = all[i - 1].rank + 1;
  qsort(all, count, sizeof *all, compare_by_rank);
}

typedef struct joining {
  const sbfi_rigging *r;
  const uint32_t *sets;
  const sbfi_scene_mesh *meshes; /* before the merge */
  uint32_t mesh_count, root;
  uint32_t **points; /* (meshes) new indices of each mesh's points */
} joining;

static bool is_of(const joining *j, uint32_t mesh) {
  return j->sets[mesh] == j->root && is_piece(j->r, mesh);
}

/* Merges points of several pieces at one position, in file order. */
static bool join_points(joining *j, sbfi_scene_mesh *to) {
  uint32_t total = 0, count = 0;
  for (uint32_t m = 0; m < j->mesh_count; m++) total += is_of(j, m) ? j->meshes[m].point_count : 0;
  piece_point *all = allocate(j->r, total, sizeof *all);
  const piece_point **first = allocate(j->r, total, sizeof *first);
  uint32_t *number_of = allocate(j->r, total, sizeof *number_of);
  sbf_vec3 *points = allocate(j->r, total, sizeof *points);
  uint32_t *sources = allocate(j->r, total, sizeof *sources), at = 0;
  if (!all || !first || !number_of || !points || !sources) return false;
  for (uint32_t m = 0; m < j->mesh_count; m++) {
    if (!is_of(j, m)) continue;
    j->points[m] = allocate(j->r, j->meshes[m].point_count, sizeof *j->points[m]);
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
  uint32_t *starts = allocate(j->r, (size_t)to->polygon_count + 1, sizeof *starts);
  int32_t *materials = allocate(j->r, to->polygon_count, sizeof *materials);
  uint32_t *corners = allocate(j->r, to->corner_count, sizeof *corners), polygon = 0, corner = 0;
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
  sbf_vec3 *normals = allocate(j->r, total, sizeof *normals);
  int32_t *corners = allocate(j->r, to->corner_count, sizeof *corners);
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
  sbf_vec4 *colors = allocate(j->r, total, sizeof *colors);
  int32_t *corners = allocate(j->r, to->corner_count, sizeof *corners);
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
  sbfi_scene_uvs *set = allocate(j->r, 1, sizeof *set);
  sbf_vec2 *uvs = allocate(j->r, total, sizeof *uvs);
  int32_t *corners = allocate(j->r, to->corner_count, sizeof *corners);
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

static bool join_set(joining *j, sbfi_scene_mesh *to) {
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

bool sbfi_join_pieces(
    const sbfi_rigging *r, sbfi_scene_node *nodes, sbfi_scene_mesh *meshes, uint32_t *count) {
  uint32_t mesh_count = *count, kept = 0;
  uint32_t *sets = allocate(r, mesh_count, sizeof *sets), *sizes = allocate(r, mesh_count, sizeof *sizes);
  sbfi_scene_mesh *before = sbfi_arena_copy(&r->c->scratch, meshes, mesh_count, sizeof *before);
  uint32_t **points = allocate(r, mesh_count, sizeof *points);
  if (!sets || !sizes || !before || !points) return false;
  sbfi_sets_begin(sets, mesh_count);
  if (!join_along_borders(r, sets)) return false;
  join_those_by_position(r, sets);
  for (uint32_t m = 0; m < mesh_count; m++) sizes[sets[m] = sbfi_set_root(sets, m)]++;
  for (uint32_t m = 0; m < mesh_count; m++) {
    if (sets[m] != m) continue;
    joining j = {r, sets, before, mesh_count, m, points};
    meshes[kept] = before[m];
    if (sizes[m] > 1 && !join_set(&j, &meshes[kept])) return false;
    if (sizes[m] > 1) nodes[before[m].node].name = r->rig.scene->nodes[r->parent_nodes[m]].name;
    kept++;
  }
  *count = kept;
  return true;
}
