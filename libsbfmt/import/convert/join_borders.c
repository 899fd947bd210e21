#include "import/convert/join_borders.h"

#include <stdlib.h>

#include "base/union_find.h"
#include "mechanics/vector.h"

/* An edge of a polygon by the positions of its ends. */
typedef struct edge {
  sbf_vec3 low, high;
  uint32_t points[2]; /* at `low`, at `high` */
  sbfi_d3 polygon;    /* sum of the polygon's corners, exact for coordinates of similar size */
} edge;

static int compare_positions(const sbf_vec3 *a, const sbf_vec3 *b) {
  if (a->x != b->x) return a->x < b->x ? -1 : 1;
  if (a->y != b->y) return a->y < b->y ? -1 : 1;
  return a->z == b->z ? 0 : a->z < b->z ? -1 : 1;
}

static int compare_ends(const edge *a, const edge *b) {
  int order = compare_positions(&a->low, &b->low);
  return order ? order : compare_positions(&a->high, &b->high);
}

static int compare_edges(const void *left, const void *right) {
  const edge *a = left, *b = right;
  int order = compare_ends(a, b);
  for (int k = 0; order == 0 && k < 2; k++)
    order = (a->points[k] > b->points[k]) - (a->points[k] < b->points[k]);
  return order;
}

static bool are_one(const edge *a, const edge *b) {
  return a->points[0] == b->points[0] && a->points[1] == b->points[1];
}

/* Whether both are the same edge of the two sides of a sheet, which stay separate. */
static bool are_back_to_back(const edge *a, const edge *b) {
  return a->polygon.x == b->polygon.x && a->polygon.y == b->polygon.y && a->polygon.z == b->polygon.z;
}

static sbfi_d3 sum_of_corners(const sbfi_scene_mesh *mesh, uint32_t polygon) {
  sbfi_d3 sum = {0, 0, 0};
  for (uint32_t k = mesh->polygon_starts[polygon]; k < mesh->polygon_starts[polygon + 1]; k++)
    sum = sbfi_d3_add(sum, sbfi_d3_of(mesh->points[mesh->corner_points[k]]));
  return sum;
}

static uint32_t list_edges(const sbfi_scene_mesh *mesh, edge *edges) {
  uint32_t count = 0;
  for (uint32_t p = 0; p < mesh->polygon_count; p++) {
    sbfi_d3 sum = sum_of_corners(mesh, p);
    for (uint32_t k = mesh->polygon_starts[p]; k < mesh->polygon_starts[p + 1]; k++) {
      uint32_t next = k + 1 < mesh->polygon_starts[p + 1] ? k + 1 : mesh->polygon_starts[p];
      uint32_t a = mesh->corner_points[k], b = mesh->corner_points[next];
      int order = compare_positions(&mesh->points[a], &mesh->points[b]);
      if (order == 0) continue;
      uint32_t low = order < 0 ? a : b, high = order < 0 ? b : a;
      edges[count++] = (edge){mesh->points[low], mesh->points[high], {low, high}, sum};
    }
  }
  return count;
}

/* Joins the ends of two border edges at one position. If more edges end there, it is not known which belong
 * together. */
static void join_ends(const edge *edges, uint32_t count, uint32_t *sets) {
  for (uint32_t first = 0, end; first < count; first = end) {
    for (end = first + 1; end < count && compare_ends(&edges[first], &edges[end]) == 0;) end++;
    const edge *a = &edges[first], *b = a + 1;
    if (end - first != 2 || are_one(a, b) || are_back_to_back(a, b)) continue;
    for (int k = 0; k < 2; k++) sbfi_sets_join(sets, a->points[k], b->points[k]);
  }
}

/* Gives the points of a set the first one's index. */
static bool merge_points(sbfi_conversion *c, uint32_t *sets, sbfi_scene_mesh *mesh) {
  const sbfi_scene_mesh from = *mesh;
  sbf_vec3 *points = sbfi_arena_allocate(&c->scratch, from.point_count, sizeof *points);
  uint32_t *sources = sbfi_arena_allocate(&c->scratch, from.point_count, sizeof *sources);
  uint32_t *numbers = sbfi_arena_allocate(&c->scratch, from.point_count, sizeof *numbers);
  uint32_t *corners = sbfi_arena_allocate(&c->scratch, from.corner_count, sizeof *corners);
  if (!points || !sources || !numbers || !corners) return false;
  mesh->point_count = 0;
  for (uint32_t i = 0; i < from.point_count; i++) {
    uint32_t root = sbfi_set_root(sets, i);
    numbers[i] = root == i ? mesh->point_count : numbers[root];
    if (root != i) continue;
    points[mesh->point_count] = from.points[i];
    sources[mesh->point_count++] = from.point_sources[i];
  }
  for (uint32_t i = 0; i < from.corner_count; i++) corners[i] = numbers[from.corner_points[i]];
  mesh->points = points;
  mesh->point_sources = sources;
  mesh->corner_points = corners;
  return true;
}

static bool join_mesh(sbfi_conversion *c, sbfi_scene_mesh *mesh) {
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &c->scratch.allocator, 0);
  edge *edges = sbfi_arena_allocate(&scratch, (size_t)mesh->corner_count + 1, sizeof *edges);
  uint32_t *sets = sbfi_arena_allocate(&scratch, (size_t)mesh->point_count + 1, sizeof *sets);
  bool good = edges && sets;
  if (good) {
    uint32_t count = list_edges(mesh, edges);
    sbfi_sets_begin(sets, mesh->point_count);
    qsort(edges, count, sizeof *edges, compare_edges);
    join_ends(edges, count, sets);
    good = merge_points(c, sets, mesh);
  }
  sbfi_arena_free(&scratch);
  return good;
}

/* Formats with vertices of their own are joined when they are read. */
static bool is_open_to_joining(const sbfi_scene_mesh *mesh) {
  return !mesh->corner_vertices && !mesh->skin.joint_count && !mesh->shape_count && !mesh->group_count &&
         mesh->point_count && mesh->corner_count;
}

sbf_status sbfi_join_borders(sbfi_conversion *c) {
  uint32_t before = 0, after = 0;
  sbfi_scene *scene = sbfi_arena_copy(&c->scratch, c->scene, 1, sizeof *scene);
  sbfi_scene_mesh *meshes =
      sbfi_arena_copy(&c->scratch, c->scene->meshes, c->scene->mesh_count, sizeof *meshes);
  if (c->scene->mesh_count == 0) return SBF_OK;
  if (!scene || !meshes) return sbfi_convert_no_memory(c);
  for (uint32_t m = 0; m < scene->mesh_count; m++) {
    if (!is_open_to_joining(&meshes[m])) continue;
    before += meshes[m].point_count;
    if (!join_mesh(c, &meshes[m])) return sbfi_convert_no_memory(c);
    after += meshes[m].point_count;
  }
  if (before == after) return SBF_OK;
  sbfi_convert_warn(c, SBF_CODE_IMPORT_POINTS_JOINED,
      "%u points of the file became %u: polygons of an object that meet along an edge without sharing its "
      "points were joined, because a soft body would fall apart there",
      before, after);
  scene->meshes = meshes;
  if (c->rig == c->scene) c->rig = scene;
  c->scene = scene;
  return SBF_OK;
}
