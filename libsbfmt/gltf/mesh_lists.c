#include "gltf/mesh_lists.h"

#include <stdio.h>
#include <string.h>

#include "packed/packed_codec.h"
#include "packed/packed_filter.h"

enum { MAX_SLOTS = 1 << 20 }; /* of materials in a mesh */

static bool changed(const sbfi_glb_file *file, const char *what) {
  return sbfi_glb_fault(file, SBF_CODE_GLTF_CHANGED,
      "%s: another program changed the mesh, so use the file as it was before", what);
}

static void *allocate(const sbfi_glb_file *file, size_t count, size_t size) {
  void *memory = sbfi_arena_allocate(file->arena, count ? count : 1, size);
  if (!memory) sbfi_glb_fault(file, SBF_CODE_OUT_OF_MEMORY, "no memory for a mesh, or more than the limit");
  return memory;
}

static const sbfi_json *primitive_of(const sbfi_mesh_vertices *v, uint32_t primitive) {
  return sbfi_json_at(sbfi_json_get(v->mesh, "primitives"), primitive);
}

static const sbfi_json *attribute_of(const sbfi_mesh_vertices *v, uint32_t primitive, const char *name) {
  return sbfi_json_get(sbfi_json_get(primitive_of(v, primitive), "attributes"), name);
}

/* --- corners --- */

/* Triangles of a primitive that the polygons have not used yet. */
typedef struct triangles {
  sbfi_glb_items indices;
  uint32_t next, first_vertex, end_vertex;
} triangles;

static bool open_primitives(const sbfi_glb_file *file, sbfi_mesh_vertices *v, triangles *of) {
  uint32_t *ends = allocate(file, v->primitive_count, sizeof *ends);
  if (!ends) return false;
  for (uint32_t i = 0; i < v->primitive_count; i++) {
    sbfi_glb_items positions;
    if (!sbfi_glb_file_accessor(file, attribute_of(v, i, "POSITION"), "VEC3", &positions) ||
        !sbfi_glb_file_accessor(
            file, sbfi_json_get(primitive_of(v, i), "indices"), "SCALAR", &of[i].indices) ||
        !sbfi_glb_is_whole(file, &of[i].indices))
      return false;
    if (positions.count > UINT32_MAX - v->count) return changed(file, "a mesh has too many vertices");
    of[i].first_vertex = v->count;
    ends[i] = of[i].end_vertex = v->count += positions.count;
  }
  v->primitive_ends = ends;
  return true;
}

static bool next_triangle(triangles *t, uint32_t corners[3]) {
  if (t->indices.count < 3 || t->next > t->indices.count - 3) return false;
  for (uint32_t k = 0; k < 3; k++) {
    uint32_t index = sbfi_glb_whole(&t->indices, t->next++, 0);
    if (index >= t->end_vertex - t->first_vertex) return false;
    corners[k] = t->first_vertex + index;
  }
  return true;
}

/* A fan about the polygon's first corner. */
static bool read_polygon(triangles *t, uint32_t size, uint32_t *corners) {
  uint32_t triangle[3];
  for (uint32_t k = 2; k < size; k++) {
    if (!next_triangle(t, triangle)) return false;
    if (k > 2 && (triangle[0] != corners[0] || triangle[1] != corners[k - 1])) return false;
    if (k == 2) corners[0] = triangle[0], corners[1] = triangle[1];
    corners[k] = triangle[2];
  }
  return true;
}

/* Primitive of each slot in use, in the order of the slots; UINT32_MAX: unused. */
static uint32_t *find_primitives(
    const sbfi_glb_file *file, sbf_u32_list materials, uint32_t *slot_count, uint32_t *primitive_count) {
  uint32_t slots = 1, used = 0;
  for (uint32_t p = 0; p < materials.count; p++) {
    if (materials.at[p] >= MAX_SLOTS) return changed(file, "a polygon's material is out of range"), NULL;
    if (materials.at[p] >= slots) slots = materials.at[p] + 1;
  }
  uint32_t *primitives = allocate(file, slots, sizeof *primitives);
  if (!primitives) return NULL;
  memset(primitives, materials.count ? 0xff : 0, slots * sizeof *primitives);
  for (uint32_t p = 0; p < materials.count; p++) primitives[materials.at[p]] = 0;
  for (uint32_t s = 0; s < slots; s++)
    if (primitives[s] == 0) primitives[s] = used++;
  *slot_count = slots, *primitive_count = used;
  return primitives;
}

bool sbfi_mesh_vertices_find(const sbfi_glb_file *file, const sbfi_json *mesh, sbf_u32_list sizes,
    sbf_u32_list materials, sbfi_mesh_vertices *v) {
  const sbfi_json *given = sbfi_json_get(mesh, "primitives");
  uint32_t slots;
  uint64_t corners = 0, corner = 0;
  *v = (sbfi_mesh_vertices){.mesh = mesh};
  if (materials.count && materials.count != sizes.count) return changed(file, "polygons lack a material");
  uint32_t *primitives = find_primitives(file, materials, &slots, &v->primitive_count);
  if (!primitives) return false;
  if (!given || given->type != SBFI_JSON_ARRAY || given->count != v->primitive_count)
    return changed(file, "a mesh has more or fewer primitives");
  triangles *of = allocate(file, v->primitive_count, sizeof *of);
  if (!of || !open_primitives(file, v, of)) return false;
  uint64_t triangle_corners = 0; /* bounds the memory below by the file's size */
  for (uint32_t i = 0; i < v->primitive_count; i++) triangle_corners += of[i].indices.count;
  for (uint32_t p = 0; p < sizes.count; p++) corners += sizes.at[p];
  if (corners > UINT32_MAX || corners > triangle_corners) return changed(file, "a mesh has other triangles");
  uint32_t *corner_vertices = allocate(file, (size_t)corners, sizeof *corner_vertices);
  if (!corner_vertices) return false;
  for (uint32_t p = 0; p < sizes.count; p++) {
    triangles *t = &of[primitives[materials.count ? materials.at[p] : 0]];
    if (sizes.at[p] < 3 || !read_polygon(t, sizes.at[p], corner_vertices + corner))
      return changed(file, "a mesh has other triangles");
    corner += sizes.at[p];
  }
  v->corner_vertices = corner_vertices;
  v->corner_count = (uint32_t)corners;
  return true;
}

/* --- attributes --- */

static const float *read_floats(const sbfi_glb_file *file, const sbfi_mesh_vertices *v,
    const sbfi_json *(*accessor_of)(const sbfi_mesh_vertices *v, uint32_t primitive, const void *key),
    const void *key, uint32_t width) {
  static const char *const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  float *values = allocate(file, (size_t)v->count * width, sizeof *values);
  if (!values) return NULL;
  for (uint32_t i = 0, begin = 0; i < v->primitive_count; begin = v->primitive_ends[i++]) {
    sbfi_glb_items items;
    if (!sbfi_glb_file_accessor(file, accessor_of(v, i, key), types[width], &items) ||
        !sbfi_glb_is_float(file, &items))
      return NULL;
    if (items.count != v->primitive_ends[i] - begin) {
      changed(file, "attributes of a mesh have different counts");
      return NULL;
    }
    for (uint32_t k = 0; k < items.count; k++)
      for (uint32_t s = 0; s < width; s++)
        values[(size_t)(begin + k) * width + s] = sbfi_glb_float(&items, k, s);
  }
  return values;
}

static const sbfi_json *named_accessor(const sbfi_mesh_vertices *v, uint32_t primitive, const void *key) {
  return attribute_of(v, primitive, key);
}

const float *sbfi_mesh_attribute(
    const sbfi_glb_file *file, const sbfi_mesh_vertices *v, const char *name, uint32_t width) {
  return read_floats(file, v, named_accessor, name, width);
}

static const sbfi_json *target_accessor(const sbfi_mesh_vertices *v, uint32_t primitive, const void *key) {
  const sbfi_json *targets = sbfi_json_get(primitive_of(v, primitive), "targets");
  return sbfi_json_get(sbfi_json_at(targets, *(const uint32_t *)key), "POSITION");
}

const float *sbfi_mesh_target(const sbfi_glb_file *file, const sbfi_mesh_vertices *v, uint32_t target) {
  return read_floats(file, v, target_accessor, &target, 3);
}

/* Of scalars in the byte order of files. */
static uint32_t checksum_of(void *scalars, size_t count) {
  sbfi_scalars_to_host(scalars, count);
  uint32_t crc = sbfi_crc32(scalars, 4 * count);
  sbfi_scalars_to_host(scalars, count);
  return crc;
}

bool sbfi_mesh_checksum(const sbfi_glb_file *file, const sbfi_mesh_vertices *v, uint32_t *crc) {
  const float *positions = sbfi_mesh_attribute(file, v, "POSITION", 3);
  if (!positions) return false;
  uint32_t parts[2] = {checksum_of((float *)(uintptr_t)positions, 3 * (size_t)v->count),
      checksum_of((uint32_t *)(uintptr_t)v->corner_vertices, v->corner_count)};
  *crc = checksum_of(parts, 2);
  return true;
}

bool sbfi_scatter(const sbfi_mesh_vertices *v, const uint32_t *item_of_vertex, const float *of_vertices,
    uint32_t width, float *to, uint32_t count) {
  for (uint32_t i = 0; i < v->count; i++) {
    if (item_of_vertex[i] >= count) return false;
    memcpy(to + (size_t)item_of_vertex[i] * width, of_vertices + (size_t)i * width, width * sizeof *to);
  }
  return true;
}

void sbfi_gather_corners(const sbfi_mesh_vertices *v, const uint32_t *item_of_vertex, uint32_t *to) {
  for (uint32_t c = 0; c < v->corner_count; c++) to[c] = item_of_vertex[v->corner_vertices[c]];
}

void sbfi_flip_coordinates(float *coordinates, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) coordinates[2 * (size_t)i + 1] = 1 - coordinates[2 * (size_t)i + 1];
}

bool sbfi_first_vertices(
    const sbfi_mesh_vertices *v, const uint32_t *point_of_vertex, uint32_t *to, uint32_t points) {
  memset(to, 0xff, points * sizeof *to);
  for (uint32_t i = v->count; i-- > 0;) {
    if (point_of_vertex[i] >= points) return false;
    to[point_of_vertex[i]] = i;
  }
  return true;
}

/* --- skins and shape keys --- */

typedef struct joint_set {
  sbfi_glb_items joints, weights;
} joint_set;

static uint32_t primitive_at(const sbfi_mesh_vertices *v, uint32_t vertex) {
  uint32_t i = 0;
  while (vertex >= v->primitive_ends[i]) i++;
  return i;
}

static float weight_of(const joint_set *sets, uint32_t count, uint32_t vertex, uint32_t bone) {
  for (uint32_t s = 0; s < count; s++)
    for (uint32_t k = 0; k < 4; k++) {
      float weight = sbfi_glb_float(&sets[s].weights, vertex, k);
      if (sbfi_glb_whole(&sets[s].joints, vertex, k) == bone && weight > 0) return weight;
    }
  return 0;
}

/* Number of sets that the primitive has; `sets` has room for `capacity`. */
static bool open_joint_sets(const sbfi_glb_file *file, const sbfi_mesh_vertices *v, uint32_t primitive,
    joint_set *sets, uint32_t capacity, uint32_t *count) {
  char joints[24], weights[24];
  for (*count = 0; *count < capacity; ++*count) {
    joint_set *set = &sets[*count];
    snprintf(joints, sizeof joints, "JOINTS_%u", *count);
    snprintf(weights, sizeof weights, "WEIGHTS_%u", *count);
    if (!attribute_of(v, primitive, joints)) return true;
    if (!sbfi_glb_file_accessor(file, attribute_of(v, primitive, joints), "VEC4", &set->joints) ||
        !sbfi_glb_file_accessor(file, attribute_of(v, primitive, weights), "VEC4", &set->weights) ||
        !sbfi_glb_is_whole(file, &set->joints) || !sbfi_glb_is_float(file, &set->weights))
      return false;
    uint32_t begin = primitive ? v->primitive_ends[primitive - 1] : 0;
    if (set->joints.count != v->primitive_ends[primitive] - begin || set->weights.count != set->joints.count)
      return changed(file, "attributes of a mesh have different counts");
  }
  return true;
}

static uint32_t count_joint_sets(const sbfi_mesh_vertices *v) {
  uint32_t max = 0;
  for (uint32_t i = 0; i < v->primitive_count; i++) {
    const sbfi_json *attributes = sbfi_json_get(primitive_of(v, i), "attributes");
    if (attributes && attributes->count > max) max = attributes->count;
  }
  return max;
}

bool sbfi_gather_weights(const sbfi_glb_file *file, const sbfi_mesh_vertices *v,
    const uint32_t *first_vertices, sbf_u32_list influence_counts, sbf_u32_list bones, float *to) {
  uint32_t capacity = count_joint_sets(v);
  joint_set *sets = allocate(file, (size_t)capacity * v->primitive_count, sizeof *sets);
  uint32_t *counts = allocate(file, v->primitive_count, sizeof *counts);
  if (!sets || !counts) return false;
  for (uint32_t i = 0; i < v->primitive_count; i++)
    if (!open_joint_sets(file, v, i, sets + (size_t)i * capacity, capacity, &counts[i])) return false;
  for (uint32_t p = 0, at = 0; p < influence_counts.count; p++)
    for (uint32_t k = 0; k < influence_counts.at[p]; k++, at++) {
      if (at >= bones.count) return changed(file, "a skin has fewer bones than influences");
      if (first_vertices[p] == UINT32_MAX) continue;
      uint32_t i = primitive_at(v, first_vertices[p]), begin = i ? v->primitive_ends[i - 1] : 0;
      to[at] = weight_of(sets + (size_t)i * capacity, counts[i], first_vertices[p] - begin, bones.at[at]);
    }
  return true;
}

bool sbfi_gather_offsets(const sbfi_glb_file *file, const sbfi_mesh_vertices *v,
    const uint32_t *first_vertices, uint32_t point_count, uint32_t target, sbf_u32_list points, float *to) {
  const float *offsets = sbfi_mesh_target(file, v, target);
  if (!offsets) return false;
  for (uint32_t i = 0; i < points.count; i++) {
    if (points.at[i] >= point_count) return changed(file, "a shape key has a point out of range");
    if (first_vertices[points.at[i]] != UINT32_MAX)
      memcpy(to + 3 * (size_t)i, offsets + 3 * (size_t)first_vertices[points.at[i]], 3 * sizeof *to);
  }
  return true;
}
