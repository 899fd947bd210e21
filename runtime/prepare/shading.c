/* Faces of a mesh, and the faces of each normal and tangent. */
#include <stdlib.h>
#include <string.h>

#include "prepare/prepare.h"

/* Cosine above which authored normals (within 1.8 degrees) are equal at an edge. */
static const float SAME_SIDE = 0.9995f;

/* ---- Faces ---- */

static uint32_t faces_of_polygon(uint32_t size) {
  return size < 3 ? 0 : (size - 1) / 2;
}

static uint32_t count_faces(const sbf_polygon_mesh *mesh) {
  uint32_t count = 0;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++)
    count += faces_of_polygon(mesh->polygon_sizes.at[p]);
  return count;
}

/* Indices of the four corners of a polygon's face k, among the polygon's corners. */
static void face_corners(uint32_t size, uint32_t k, uint32_t corners[4]) {
  uint32_t first = 2 * k + 1;
  corners[0] = 0, corners[1] = first, corners[2] = first + 1;
  corners[3] = first + 2 < size ? first + 2 : 0;
}

bool sbri_faces_make(sbri_skin *skin, const sbf_polygon_mesh *mesh, sbfi_arena *arena) {
  uint32_t face_count = count_faces(mesh), index = 0, first = 0;
  skin->face_block_count = face_count / SBRI_BLOCK + 1;
  sbri_face_block *faces = sbfi_arena_allocate(arena, skin->face_block_count, sizeof *faces);
  if (!faces) return false;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++) {
    uint32_t size = mesh->polygon_sizes.at[p];
    for (uint32_t k = 0; k < faces_of_polygon(size); k++, index++) {
      uint32_t corners[4];
      face_corners(size, k, corners);
      for (int c = 0; c < 4; c++)
        faces[index / SBRI_BLOCK].corners[c][index % SBRI_BLOCK] =
            mesh->polygon_points.at[first + corners[c]];
    }
    first += size;
  }
  skin->faces = faces;
  skin->normals.corner_count = mesh->polygon_points.count;
  return true;
}

/* ---- Sums ---- */

/* `group_of_corner` (corners): the group to which each corner's polygon contributes. */
static bool make_sums(sbri_sum_table *table, uint32_t group_count, const uint32_t *group_of_corner,
    const sbf_polygon_mesh *mesh, uint32_t inert_face, sbfi_arena *arena, sbfi_arena *scratch) {
  uint32_t block_count = (group_count + SBRI_BLOCK - 1) / SBRI_BLOCK;
  uint32_t *used = sbfi_arena_allocate(scratch, (size_t)block_count * SBRI_BLOCK + 1, sizeof *used);
  uint32_t *begins = sbfi_arena_allocate(arena, (size_t)block_count + 1, sizeof *begins);
  if (!used || !begins) return false;
  for (uint32_t p = 0, corner = 0; p < mesh->polygon_sizes.count; p++)
    for (uint32_t k = 0; k < mesh->polygon_sizes.at[p]; k++)
      used[group_of_corner[corner++]] += faces_of_polygon(mesh->polygon_sizes.at[p]);
  for (uint32_t block = 0; block < block_count; block++) {
    uint32_t max = 0;
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++)
      if (used[block * SBRI_BLOCK + lane] > max) max = used[block * SBRI_BLOCK + lane];
    begins[block + 1] = begins[block] + max;
  }
  uint32_t cell_count = begins[block_count];
  sbri_sum_cell *cells = sbfi_arena_allocate(arena, cell_count ? cell_count : 1, sizeof *cells);
  if (!cells) return false;
  for (uint32_t c = 0; c < cell_count; c++)
    for (int lane = 0; lane < SBRI_BLOCK; lane++) cells[c].faces[lane] = inert_face;
  memset(used, 0, ((size_t)block_count * SBRI_BLOCK + 1) * sizeof *used);
  for (uint32_t p = 0, corner = 0, face = 0; p < mesh->polygon_sizes.count; p++) {
    uint32_t size = mesh->polygon_sizes.at[p], faces = faces_of_polygon(size);
    for (uint32_t k = 0; k < size; k++) {
      uint32_t group = group_of_corner[corner++];
      for (uint32_t f = 0; f < faces; f++)
        cells[begins[group / SBRI_BLOCK] + used[group]++].faces[group % SBRI_BLOCK] = face + f;
    }
    face += faces;
  }
  *table = (sbri_sum_table){group_count, begins, cells};
  return true;
}

/* ---- Groups: vertices or corners at one position with equal authored normals ---- */

typedef struct placed {
  uint32_t bits[3], vertex;
} placed;

static int compare_positions(const void *a, const void *b) {
  const placed *p = a, *q = b;
  for (int k = 0; k < 3; k++)
    if (p->bits[k] != q->bits[k]) return p->bits[k] < q->bits[k] ? -1 : 1;
  return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

/* The first vertex at the position of each. */
static bool find_positions(uint32_t *first_at_position, const sbf_polygon_mesh *mesh, sbfi_arena *scratch) {
  uint32_t count = mesh->positions.count;
  placed *sorted = sbfi_arena_allocate(scratch, count, sizeof *sorted);
  if (!sorted) return false;
  for (uint32_t v = 0; v < count; v++) {
    const sbf_vec3 *p = &mesh->positions.at[v];
    float position[3] = {p->x + 0.0f, p->y + 0.0f, p->z + 0.0f}; /* -0 becomes 0 */
    memcpy(sorted[v].bits, position, sizeof position);
    sorted[v].vertex = v;
  }
  qsort(sorted, count, sizeof *sorted, compare_positions);
  for (uint32_t i = 0; i < count; i++) {
    bool same = i > 0 && memcmp(sorted[i].bits, sorted[i - 1].bits, sizeof sorted[i].bits) == 0;
    first_at_position[sorted[i].vertex] = same ? first_at_position[sorted[i - 1].vertex] : sorted[i].vertex;
  }
  return true;
}

typedef struct group {
  sbf_vec3 normal;
  uint32_t next; /* another group at the same position, or UINT32_MAX */
} group;

/* Assigns each item the group at its position with the same normal; `normals` NULL: one group per position.
 */
typedef struct grouping {
  group *groups;
  uint32_t group_count;
  uint32_t *first_group; /* (vertices) of the position, by its first vertex */
} grouping;

static bool begin_grouping(grouping *g, uint32_t max, uint32_t vertex_count, sbfi_arena *scratch) {
  g->group_count = 0;
  g->groups = sbfi_arena_allocate(scratch, max, sizeof *g->groups);
  g->first_group = sbfi_arena_allocate(scratch, vertex_count, sizeof *g->first_group);
  if (g->first_group) memset(g->first_group, 0xff, vertex_count * sizeof *g->first_group);
  return g->groups && g->first_group;
}

static uint32_t group_for(grouping *g, uint32_t index, const sbf_vec3 *normal) {
  uint32_t *link = &g->first_group[index];
  for (; *link != UINT32_MAX; link = &g->groups[*link].next) {
    const sbf_vec3 *n = &g->groups[*link].normal;
    if (!normal || n->x * normal->x + n->y * normal->y + n->z * normal->z >= SAME_SIDE) return *link;
  }
  uint32_t fresh = g->group_count++;
  *link = fresh;
  g->groups[fresh] = (group){normal ? *normal : (sbf_vec3){0, 0, 0}, UINT32_MAX};
  return fresh;
}

/* ---- Tangents ---- */

static sbf_vec2 corner_uv(const sbf_uv_set *set, const sbf_polygon_mesh *mesh, uint32_t corner) {
  uint32_t at = set->corners.count ? set->corners.at[corner] : mesh->polygon_points.at[corner];
  return at < set->coordinates.count ? set->coordinates.at[at] : (sbf_vec2){0, 0};
}

/* The tangent of a face with diagonals d1, d2 and texture diagonals (u1, v1), (u2, v2) runs along
 * (v2 d1 - v1 d2) / (u1 v2 - u2 v1); it is weighted by the size of that determinant. */
static bool make_tangents(sbri_skin *skin, const sbf_polygon_mesh *mesh, const sbf_uv_set *set,
    sbfi_arena *arena, sbfi_arena *scratch) {
  sbri_tangent_block *blocks = sbfi_arena_allocate(arena, skin->face_block_count, sizeof *blocks);
  float *handedness = sbfi_arena_allocate(arena, skin->vertex_count, sizeof *handedness);
  if (!blocks || !handedness) return false;
  for (uint32_t p = 0, face = 0, first = 0; p < mesh->polygon_sizes.count; p++) {
    uint32_t size = mesh->polygon_sizes.at[p];
    for (uint32_t k = 0; k < faces_of_polygon(size); k++, face++) {
      uint32_t corners[4];
      face_corners(size, k, corners);
      sbf_vec2 uv[4];
      for (int c = 0; c < 4; c++) uv[c] = corner_uv(set, mesh, first + corners[c]);
      float u1 = uv[2].x - uv[0].x, v1 = uv[2].y - uv[0].y, u2 = uv[3].x - uv[1].x, v2 = uv[3].y - uv[1].y;
      float determinant = u1 * v2 - u2 * v1, sign = determinant < 0 ? -1.0f : 1.0f;
      blocks[face / SBRI_BLOCK].fractions[0][face % SBRI_BLOCK] = sign * v2;
      blocks[face / SBRI_BLOCK].fractions[1][face % SBRI_BLOCK] = -sign * v1;
      for (int c = 0; c < 4; c++) handedness[mesh->polygon_points.at[first + corners[c]]] += determinant;
    }
    first += size;
  }
  for (uint32_t v = 0; v < skin->vertex_count; v++) handedness[v] = handedness[v] < 0 ? -1.0f : 1.0f;
  skin->tangents.blocks = blocks;
  skin->tangents.handedness = handedness;
  uint32_t inert = skin->face_block_count * SBRI_BLOCK - 1;
  return make_sums(
      &skin->tangents.sums, skin->vertex_count, mesh->polygon_points.at, mesh, inert, arena, scratch);
}

static bool make_shading(sbri_skin *skin, const sbf_polygon_mesh *mesh, const sbf_render_mesh *authored,
    sbfi_arena *arena, sbfi_arena *scratch) {
  uint32_t vertex_count = skin->vertex_count, corner_count = mesh->polygon_points.count;
  uint32_t *indices = sbfi_arena_allocate(scratch, vertex_count, sizeof *indices);
  uint32_t *of_vertex = sbfi_arena_allocate(arena, vertex_count, sizeof *of_vertex);
  uint32_t *of_corner = sbfi_arena_allocate(scratch, (size_t)corner_count + 1, sizeof *of_corner);
  uint32_t *split_of = sbfi_arena_allocate(arena, (size_t)corner_count + 1, sizeof *split_of);
  grouping g;
  if (!indices || !of_vertex || !of_corner || !split_of || !find_positions(indices, mesh, scratch) ||
      !begin_grouping(&g, vertex_count, vertex_count, scratch))
    return false;
  bool by_corner = authored->normal_corners.count == corner_count && corner_count > 0;
  bool by_vertex = !by_corner && authored->normals.count == vertex_count;
  for (uint32_t v = 0; v < vertex_count; v++)
    of_vertex[v] = group_for(&g, indices[v], by_vertex ? &authored->normals.at[v] : NULL);
  for (uint32_t c = 0; c < corner_count; c++) of_corner[c] = of_vertex[mesh->polygon_points.at[c]];
  uint32_t inert = skin->face_block_count * SBRI_BLOCK - 1;
  if (!make_sums(&skin->normals.smooth, g.group_count, of_corner, mesh, inert, arena, scratch)) return false;
  skin->normals.smooth_of = of_vertex;
  skin->normals.split_of = split_of;
  memcpy(split_of, of_corner, corner_count * sizeof *split_of);
  skin->normals.split = skin->normals.smooth;
  if (!by_corner) return true;
  if (!begin_grouping(&g, corner_count, vertex_count, scratch)) return false;
  for (uint32_t c = 0; c < corner_count; c++)
    split_of[c] = group_for(
        &g, indices[mesh->polygon_points.at[c]], &authored->normals.at[authored->normal_corners.at[c]]);
  return make_sums(&skin->normals.split, g.group_count, split_of, mesh, inert, arena, scratch);
}

bool sbri_shading_make(
    sbri_skin *skin, const sbf_polygon_mesh *mesh, const sbf_render_mesh *authored, sbfi_arena *arena) {
  if (!sbri_faces_make(skin, mesh, arena)) return false;
  if (skin->vertex_count == 0) return true;
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &arena->allocator, 0);
  bool good = make_shading(skin, mesh, authored, arena, &scratch);
  if (good && authored->uv_sets.count && mesh->polygon_sizes.count)
    good = make_tangents(skin, mesh, &authored->uv_sets.at[0], arena, &scratch);
  sbfi_arena_free(&scratch);
  return good;
}
