#include "build/sections/skin_union.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "build/geometry/key_set.h"
#include "build/geometry/polygon_repeats.h"
#include "build/geometry/topology.h"

/* Coincident vertices whose weights differ by more than this fraction are different points. */
static const double MAX_DIFFERENCE = 0.5;

typedef struct work {
  const sbf_asset *asset;
  const uint8_t *chosen;
  sbfi_skin_union *to;
  sbfi_arena *arena;
  uint32_t vertex_count, point_count; /* of all skinned meshes */
  sbf_vec3 *positions;                /* (point_count) */
  uint32_t *firsts;                   /* (point_count) first vertex of the point, counted over all meshes */
  uint32_t *numbers;                  /* (point_count) number of vertices at the point */
  uint32_t *points;                   /* (vertex_count) */
  uint32_t *begins, *counts;          /* (vertex_count + 1) first weight of each vertex; number of weights */
  sbfi_bone_weight *bone_weights;
  uint32_t *slots, *next; /* hash of positions: first point; next point in the same slot */
  size_t slot_count;
} work;

/* A mesh whose vertices are all points of one body shows that body and moves with it. */
static bool is_body(const sbf_render_mesh *mesh, const sbf_soft_body *body, bool *is, sbfi_arena *arena) {
  const sbf_vec3_list *points = &body->surface.positions, *vertices = &mesh->mesh.positions;
  sbfi_key_set positions;
  *is = false;
  if (points->count == 0) return true;
  if (!sbfi_key_set_init(&positions, points->count, arena)) return false;
  for (uint32_t i = 0; i < points->count; i++)
    *sbfi_key_set_find(&positions, sbfi_key_of_position(points->at[i])) = 0;
  *is = true;
  for (uint32_t v = 0; *is && v < vertices->count; v++)
    *is = *sbfi_key_set_find(&positions, sbfi_key_of_position(vertices->at[v])) == 0;
  return true;
}

bool sbfi_skins_choose(const sbf_asset *asset, uint8_t *chosen, uint32_t *count, sbfi_arena *arena) {
  *count = 0;
  for (uint32_t m = 0; m < asset->render_meshes.count; m++) {
    const sbf_render_mesh *mesh = &asset->render_meshes.at[m];
    bool is = false;
    chosen[m] = 0;
    if (!mesh->skin || mesh->mesh.positions.count == 0) continue;
    for (uint32_t b = 0; b < asset->soft_bodies.count && !is; b++)
      if (!is_body(mesh, &asset->soft_bodies.at[b], &is, arena)) return false;
    chosen[m] = !is;
    *count += !is;
  }
  return true;
}

static int compare_bones(const void *a, const void *b) {
  const sbfi_bone_weight *x = a, *y = b;
  return x->bone < y->bone ? -1 : x->bone > y->bone;
}

/* Sorts by bone, merges duplicates, normalizes the sum; returns the remaining count. */
static uint32_t normalise_weights(sbfi_bone_weight *bone_weights, uint32_t count) {
  uint32_t kept = 0;
  double sum = 0;
  qsort(bone_weights, count, sizeof *bone_weights, compare_bones);
  for (uint32_t i = 0; i < count; i++) {
    if (!(bone_weights[i].weight > 0)) continue;
    if (kept && bone_weights[kept - 1].bone == bone_weights[i].bone)
      bone_weights[kept - 1].weight += bone_weights[i].weight;
    else
      bone_weights[kept++] = bone_weights[i];
  }
  for (uint32_t i = 0; i < kept; i++) sum += bone_weights[i].weight;
  for (uint32_t i = 0; i < kept; i++) bone_weights[i].weight = (float)(bone_weights[i].weight / sum);
  return kept;
}

static void copy_weights(work *w, const sbf_render_mesh *mesh, uint32_t first_vertex) {
  uint32_t influence = 0;
  for (uint32_t v = first_vertex; v < first_vertex + mesh->mesh.positions.count; v++) {
    uint32_t begin = w->begins[v], count = mesh->skin->influence_counts.at[v - first_vertex];
    for (uint32_t i = 0; i < count; i++, influence++)
      w->bone_weights[begin + i] =
          (sbfi_bone_weight){mesh->skin->bones.at[influence], mesh->skin->weights.at[influence]};
    w->counts[v] = normalise_weights(w->bone_weights + begin, count);
    w->begins[v + 1] = begin + w->counts[v];
  }
}

/* Half the sum of the differences of two vertices' weights: 0 equal, 1 no common bone. */
static double difference(const work *w, uint32_t a, uint32_t b) {
  double sum = 0;
  uint32_t i = w->begins[a], j = w->begins[b];
  while (i < w->begins[a] + w->counts[a] || j < w->begins[b] + w->counts[b]) {
    uint32_t left = i < w->begins[a] + w->counts[a] ? w->bone_weights[i].bone : UINT32_MAX;
    uint32_t right = j < w->begins[b] + w->counts[b] ? w->bone_weights[j].bone : UINT32_MAX;
    double x = left <= right ? w->bone_weights[i++].weight : 0,
           y = right <= left ? w->bone_weights[j++].weight : 0;
    sum += fabs(x - y);
  }
  return sum / 2;
}

static size_t slot_of(const work *w, sbf_vec3 position) {
  uint32_t bits[3];
  memcpy(bits, &position, sizeof bits);
  uint64_t mixed = bits[0] * UINT64_C(0x9e3779b97f4a7c15) ^ bits[1] * UINT64_C(0xc2b2ae3d27d4eb4f) ^
                   bits[2] * UINT64_C(0x165667b19e3779f9);
  return (size_t)(mixed ^ mixed >> 29 ^ mixed >> 47) & (w->slot_count - 1);
}

static uint32_t find_point(work *w, uint32_t vertex, sbf_vec3 position) {
  position = (sbf_vec3){position.x + 0, position.y + 0, position.z + 0}; /* -0 becomes 0 */
  size_t slot = slot_of(w, position);
  for (uint32_t p = w->slots[slot]; p != SBFI_NO_INDEX; p = w->next[p])
    if (memcmp(&w->positions[p], &position, sizeof position) == 0 &&
        difference(w, vertex, w->firsts[p]) <= MAX_DIFFERENCE)
      return p;
  uint32_t made = w->point_count++;
  w->positions[made] = position;
  w->firsts[made] = vertex;
  w->next[made] = w->slots[slot];
  w->slots[slot] = made;
  return made;
}

static void join_vertices(work *w) {
  const sbf_render_mesh_list *meshes = &w->asset->render_meshes;
  uint32_t first = 0;
  for (uint32_t m = 0; m < meshes->count; m++) {
    const sbf_render_mesh *mesh = &meshes->at[m];
    if (!w->chosen[m]) continue;
    copy_weights(w, mesh, first);
    w->to->points_of_mesh[m] = w->points + first;
    for (uint32_t v = 0; v < mesh->mesh.positions.count; v++) {
      uint32_t point = find_point(w, first + v, mesh->mesh.positions.at[v]);
      w->points[first + v] = point;
      w->numbers[point]++;
    }
    first += mesh->mesh.positions.count;
  }
}

/* A point's weights are the means of its vertices'. */
static bool average_weights(work *w) {
  uint32_t *begins = sbfi_arena_allocate(w->arena, (size_t)w->point_count + 1, sizeof *begins);
  uint32_t *ends = sbfi_arena_allocate(w->arena, (size_t)w->point_count + 1, sizeof *ends);
  sbfi_bone_weight *bone_weights =
      sbfi_arena_allocate(w->arena, (size_t)w->begins[w->vertex_count] + 1, sizeof *bone_weights);
  if (!begins || !ends || !bone_weights) return false;
  for (uint32_t v = 0; v < w->vertex_count; v++) begins[w->points[v] + 1] += w->counts[v];
  for (uint32_t p = 0; p < w->point_count; p++) begins[p + 1] += begins[p];
  for (uint32_t p = 0; p < w->point_count; p++) ends[p] = begins[p];
  for (uint32_t v = 0; v < w->vertex_count; v++)
    for (uint32_t i = 0; i < w->counts[v]; i++) {
      sbfi_bone_weight *to = &bone_weights[ends[w->points[v]]++];
      *to = w->bone_weights[w->begins[v] + i];
      to->weight /= (float)w->numbers[w->points[v]];
    }
  uint32_t kept = 0;
  for (uint32_t p = 0; p < w->point_count; p++) {
    uint32_t begin = begins[p], count = normalise_weights(bone_weights + begin, ends[p] - begin);
    memmove(bone_weights + kept, bone_weights + begin, count * sizeof *bone_weights);
    begins[p] = kept;
    kept += count;
  }
  begins[w->point_count] = kept;
  w->to->bone_weight_begins = begins;
  w->to->bone_weights = bone_weights;
  return true;
}

/* Copies a polygon's corners without consecutive duplicates; 0: degenerate. */
static uint32_t copy_polygon(const uint32_t *corners, uint32_t size, const uint32_t *points, uint32_t *to) {
  uint32_t kept = 0;
  for (uint32_t k = 0; k < size; k++) {
    uint32_t point = points[corners[k]];
    if (kept == 0 || to[kept - 1] != point) to[kept++] = point;
  }
  while (kept > 1 && to[kept - 1] == to[0]) kept--;
  return kept < 3 ? 0 : kept;
}

/* Two-sided sheets and duplicate layers become one layer. */
static bool drop_repeats(sbf_polygon_mesh *mesh, uint32_t *sizes, uint32_t *points, sbfi_arena *arena) {
  uint32_t *firsts = sbfi_arena_allocate(arena, (size_t)mesh->polygon_sizes.count + 1, sizeof *firsts);
  if (!firsts || !sbfi_polygon_repeats_find(mesh, firsts, arena)) return false;
  uint32_t polygons = 0, corners = 0, from = 0;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; p++) {
    uint32_t size = sizes[p];
    if (firsts[p] == p) {
      memmove(points + corners, points + from, size * sizeof *points);
      sizes[polygons++] = size;
      corners += size;
    }
    from += size;
  }
  mesh->polygon_sizes.count = polygons;
  mesh->polygon_points.count = corners;
  return true;
}

static bool copy_polygons(work *w) {
  size_t polygons = 0, corners = 0;
  const sbf_render_mesh_list *meshes = &w->asset->render_meshes;
  for (uint32_t m = 0; m < meshes->count; m++) {
    if (!w->chosen[m]) continue;
    polygons += meshes->at[m].mesh.polygon_sizes.count;
    corners += meshes->at[m].mesh.polygon_points.count;
  }
  uint32_t *sizes = sbfi_arena_allocate(w->arena, polygons + 1, sizeof *sizes);
  uint32_t *points = sbfi_arena_allocate(w->arena, corners + 1, sizeof *points);
  if (!sizes || !points) return false;
  uint32_t polygon_count = 0, corner_count = 0;
  for (uint32_t m = 0; m < meshes->count; m++) {
    const sbf_polygon_mesh *mesh = &meshes->at[m].mesh;
    const uint32_t *from = mesh->polygon_points.at;
    if (!w->chosen[m]) continue;
    for (uint32_t p = 0; p < mesh->polygon_sizes.count; from += mesh->polygon_sizes.at[p++]) {
      uint32_t kept =
          copy_polygon(from, mesh->polygon_sizes.at[p], w->to->points_of_mesh[m], points + corner_count);
      if (kept) sizes[polygon_count++] = kept;
      corner_count += kept;
    }
  }
  sbf_polygon_mesh *mesh = &w->to->mesh;
  sbf_polygon_mesh_init(mesh);
  mesh->positions = (sbf_vec3_list){w->positions, w->point_count};
  mesh->polygon_sizes = (sbf_u32_list){sizes, polygon_count};
  mesh->polygon_points = (sbf_u32_list){points, corner_count};
  return drop_repeats(mesh, sizes, points, w->arena);
}

bool sbfi_skin_union_make(
    sbfi_skin_union *to, const sbf_asset *asset, const uint8_t *chosen, sbfi_arena *arena) {
  work w = {.asset = asset, .chosen = chosen, .to = to, .arena = arena};
  size_t vertices = 0, bone_weights = 0;
  for (uint32_t m = 0; m < asset->render_meshes.count; m++) {
    if (!chosen[m]) continue;
    vertices += asset->render_meshes.at[m].mesh.positions.count;
    bone_weights += asset->render_meshes.at[m].skin->bones.count;
  }
  if (vertices >= SBFI_NO_INDEX || bone_weights >= SBFI_NO_INDEX) return false;
  w.vertex_count = (uint32_t)vertices;
  for (w.slot_count = 16; w.slot_count < 2 * vertices;) w.slot_count *= 2;
  to->points_of_mesh =
      sbfi_arena_allocate(arena, (size_t)asset->render_meshes.count + 1, sizeof *to->points_of_mesh);
  w.positions = sbfi_arena_allocate(arena, vertices + 1, sizeof *w.positions);
  w.firsts = sbfi_arena_allocate(arena, vertices + 1, sizeof *w.firsts);
  w.numbers = sbfi_arena_allocate(arena, vertices + 1, sizeof *w.numbers);
  w.points = sbfi_arena_allocate(arena, vertices + 1, sizeof *w.points);
  w.begins = sbfi_arena_allocate(arena, vertices + 1, sizeof *w.begins);
  w.counts = sbfi_arena_allocate(arena, vertices + 1, sizeof *w.counts);
  w.bone_weights = sbfi_arena_allocate(arena, bone_weights + 1, sizeof *w.bone_weights);
  w.next = sbfi_arena_allocate(arena, vertices + 1, sizeof *w.next);
  w.slots = sbfi_arena_allocate(arena, w.slot_count, sizeof *w.slots);
  if (!to->points_of_mesh || !w.positions || !w.firsts || !w.numbers || !w.points || !w.begins || !w.counts ||
      !w.bone_weights || !w.next || !w.slots)
    return false;
  memset(w.slots, 0xff, w.slot_count * sizeof *w.slots);
  join_vertices(&w);
  return average_weights(&w) && copy_polygons(&w);
}
