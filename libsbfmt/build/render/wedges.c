#include "build/render/wedges.h"

#include <string.h>

#include "build/geometry/key_set.h"

enum { LONG_POLYGON = 64 };

typedef struct splitting {
  uint32_t *of_corner; /* current class of each corner */
  uint32_t corner_count, class_count;
  sbfi_arena *arena;
} splitting;

/* Splits classes whose corners have different keys; `at[0]` of a key is the class. */
static bool split(splitting *s, sbfi_key (*key_of)(const void *user, uint32_t corner), const void *user) {
  sbfi_key_set set;
  uint32_t count = 0;
  if (!sbfi_key_set_init(&set, s->corner_count, s->arena)) return false;
  for (uint32_t c = 0; c < s->corner_count; c++) {
    sbfi_key key = key_of(user, c);
    key.at[0] = s->of_corner[c];
    uint32_t *value = sbfi_key_set_find(&set, key);
    if (*value == UINT32_MAX) *value = count++;
    s->of_corner[c] = *value;
  }
  s->class_count = count;
  return true;
}

static sbfi_key key_of_number(const void *user, uint32_t corner) {
  const uint32_t *numbers = user;
  return (sbfi_key){{0, numbers[corner], 0, 0}};
}

static sbfi_key key_of_coordinates(const void *user, uint32_t corner) {
  const sbf_vec2 *at = (const sbf_vec2 *)user + corner;
  float numbers[2] = {at->x + 0.0f, at->y + 0.0f};
  sbfi_key key = {{0, 0, 0, 0}};
  memcpy(key.at + 1, numbers, sizeof numbers);
  return key;
}

static sbfi_key key_of_color(const void *user, uint32_t corner) {
  const sbf_vec4 *at = (const sbf_vec4 *)user + corner;
  const float numbers[4] = {at->x, at->y, at->z, at->w};
  uint32_t steps = 0; /* quantized to eight bits */
  for (int k = 0; k < 4; k++) steps = steps << 8 | (uint32_t)(numbers[k] * 255 + 0.5f);
  return (sbfi_key){{0, steps, 0, 0}};
}

static sbfi_key key_of_normal(const void *user, uint32_t corner) {
  sbfi_key position = sbfi_key_of_position(((const sbf_vec3 *)user)[corner]);
  return (sbfi_key){{0, position.at[0], position.at[1], position.at[2]}};
}

static bool split_by_coordinates(splitting *s, const sbf_render_mesh *mesh, const sbf_uv_set *set) {
  sbf_vec2 *of_corner = sbfi_arena_allocate(s->arena, (size_t)s->corner_count + 1, sizeof *of_corner);
  if (!of_corner) return false;
  for (uint32_t c = 0; c < s->corner_count; c++) {
    uint32_t index = set->corners.count ? set->corners.at[c] : mesh->mesh.polygon_points.at[c];
    if (index < set->coordinates.count) of_corner[c] = set->coordinates.at[index];
  }
  return split(s, key_of_coordinates, of_corner);
}

/* Normals per point split nothing. */
static bool split_by_normals(splitting *s, const sbf_render_mesh *mesh) {
  if (!mesh->normal_corners.count) return true;
  sbf_vec3 *of_corner = sbfi_arena_allocate(s->arena, (size_t)s->corner_count + 1, sizeof *of_corner);
  if (!of_corner) return false;
  for (uint32_t c = 0; c < s->corner_count; c++) of_corner[c] = mesh->normals.at[mesh->normal_corners.at[c]];
  return split(s, key_of_normal, of_corner);
}

/* Colours per point split nothing. */
static bool split_by_colors(splitting *s, const sbf_render_mesh *mesh) {
  if (!mesh->color_corners.count) return true;
  sbf_vec4 *of_corner = sbfi_arena_allocate(s->arena, (size_t)s->corner_count + 1, sizeof *of_corner);
  if (!of_corner) return false;
  for (uint32_t c = 0; c < s->corner_count; c++) of_corner[c] = mesh->colors.at[mesh->color_corners.at[c]];
  return split(s, key_of_color, of_corner);
}

/* Bone of greatest weight at each point, the first if equal; UINT32_MAX: none. */
static void find_dominant_bones(uint32_t *dominant_bones, const sbf_render_mesh *mesh) {
  const sbf_skin *skin = mesh->skin;
  for (uint32_t p = 0, i = 0; p < skin->influence_counts.count; p++) {
    float max = 0;
    dominant_bones[p] = UINT32_MAX;
    for (uint32_t left = skin->influence_counts.at[p]; left > 0; left--, i++)
      if (skin->weights.at[i] > max) {
        max = skin->weights.at[i];
        dominant_bones[p] = skin->bones.at[i];
      }
  }
}

/* Bone of most of a polygon's corners, the first if equal; for a very large polygon that of its first
 * corner. */
static uint32_t dominant_bone_of(const uint32_t *dominant_bones, const uint32_t *points, uint32_t size) {
  uint32_t best = dominant_bones[points[0]], max = 0;
  if (size > LONG_POLYGON) return best;
  for (uint32_t k = 0; k < size; k++) {
    uint32_t same = 0;
    for (uint32_t o = 0; o < size; o++) same += dominant_bones[points[o]] == dominant_bones[points[k]];
    if (same > max) {
      max = same;
      best = dominant_bones[points[k]];
    }
    if (2 * max > size) break;
  }
  return best;
}

static bool split_by_bones(splitting *s, const sbf_render_mesh *mesh) {
  const sbf_polygon_mesh *m = &mesh->mesh;
  if (!mesh->skin || !mesh->skin->influence_counts.count) return true;
  uint32_t *dominant_bones =
      sbfi_arena_allocate(s->arena, (size_t)m->positions.count + 1, sizeof *dominant_bones);
  uint32_t *of_corner = sbfi_arena_allocate(s->arena, (size_t)s->corner_count + 1, sizeof *of_corner);
  if (!dominant_bones || !of_corner) return false;
  find_dominant_bones(dominant_bones, mesh);
  for (uint32_t p = 0, first = 0; p < m->polygon_sizes.count; first += m->polygon_sizes.at[p++]) {
    uint32_t dominant_bone =
        dominant_bone_of(dominant_bones, m->polygon_points.at + first, m->polygon_sizes.at[p]);
    for (uint32_t k = 0; k < m->polygon_sizes.at[p]; k++) of_corner[first + k] = dominant_bone;
  }
  return split(s, key_of_number, of_corner);
}

static bool split_by_materials(splitting *s, const sbf_render_mesh *mesh, uint32_t *slot_of_corner) {
  const sbf_polygon_mesh *m = &mesh->mesh;
  for (uint32_t p = 0, c = 0; p < m->polygon_sizes.count; p++)
    for (uint32_t k = 0; k < m->polygon_sizes.at[p]; k++)
      slot_of_corner[c++] = mesh->polygon_materials.count ? mesh->polygon_materials.at[p] : 0;
  return !mesh->polygon_materials.count || split(s, key_of_number, slot_of_corner);
}

static bool list_wedges(
    sbfi_wedges *wedges, const sbf_render_mesh *mesh, const uint32_t *slots, sbfi_arena *arena) {
  uint32_t corner_count = mesh->mesh.polygon_points.count;
  wedges->corners = sbfi_arena_allocate(arena, (size_t)wedges->count + 1, sizeof *wedges->corners);
  wedges->slots = sbfi_arena_allocate(arena, (size_t)wedges->count + 1, sizeof *wedges->slots);
  wedges->positions = sbfi_arena_allocate(arena, (size_t)wedges->count + 1, sizeof *wedges->positions);
  if (!wedges->corners || !wedges->slots || !wedges->positions) return false;
  for (uint32_t c = corner_count; c-- > 0;) {
    uint32_t wedge = wedges->of_corner[c];
    wedges->corners[wedge] = c;
    wedges->slots[wedge] = slots[c];
    wedges->positions[wedge] = mesh->mesh.positions.at[mesh->mesh.polygon_points.at[c]];
  }
  return true;
}

static bool list_triangles(sbfi_wedges *wedges, const sbf_polygon_mesh *mesh, sbfi_arena *arena) {
  size_t max = mesh->polygon_points.count - 2 * (size_t)mesh->polygon_sizes.count;
  wedges->triangles = sbfi_arena_allocate(arena, 3 * max + 1, sizeof *wedges->triangles);
  if (!wedges->triangles) return false;
  const uint32_t *points = mesh->polygon_points.at;
  for (uint32_t p = 0, first = 0; p < mesh->polygon_sizes.count; first += mesh->polygon_sizes.at[p++])
    for (uint32_t k = first + 2; k < first + mesh->polygon_sizes.at[p]; k++) {
      if (points[first] == points[k - 1] || points[k - 1] == points[k] || points[k] == points[first])
        continue;
      uint32_t *to = wedges->triangles + 3 * (size_t)wedges->triangle_count++;
      to[0] = wedges->of_corner[first];
      to[1] = wedges->of_corner[k - 1];
      to[2] = wedges->of_corner[k];
    }
  return true;
}

bool sbfi_wedges_make(
    sbfi_wedges *wedges, const sbf_render_mesh *mesh, sbfi_wedge_rule rule, sbfi_arena *arena) {
  uint32_t corner_count = mesh->mesh.polygon_points.count;
  *wedges = (sbfi_wedges){.of_corner = sbfi_arena_copy(
                              arena, mesh->mesh.polygon_points.at, (size_t)corner_count, sizeof(uint32_t))};
  uint32_t *slots = sbfi_arena_allocate(arena, (size_t)corner_count + 1, sizeof *slots);
  splitting s = {wedges->of_corner, corner_count, 0, arena};
  /* The first pass, by points, numbers the classes without gaps. */
  if (!wedges->of_corner || !slots || !split(&s, key_of_number, wedges->of_corner) ||
      !split_by_materials(&s, mesh, slots))
    return false;
  if (!split_by_colors(&s, mesh)) return false;
  for (uint32_t u = 0; u < mesh->uv_sets.count; u++)
    if (!split_by_coordinates(&s, mesh, &mesh->uv_sets.at[u])) return false;
  if ((rule.normals && !split_by_normals(&s, mesh)) || (rule.bones && !split_by_bones(&s, mesh)))
    return false;
  wedges->count = s.class_count;
  return list_wedges(wedges, mesh, slots, arena) && list_triangles(wedges, &mesh->mesh, arena);
}
