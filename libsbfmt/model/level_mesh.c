#include "model/level_mesh.h"

#include <string.h>

typedef struct selection {
  const sbf_render_mesh *full;
  const sbf_render_level *level;
  const uint32_t *corners; /* (corners of the level) corresponding corners of the full mesh */
  sbfi_level_mesh *made;
  sbfi_arena *arena;
} selection;

static uint32_t *new_list(const selection *t, size_t count) {
  return sbfi_arena_allocate(t->arena, count + 1, sizeof(uint32_t));
}

static bool find_vertices(selection *t) {
  uint32_t full_count = t->full->mesh.positions.count, count = 0;
  uint32_t *position_of = new_list(t, full_count), *points = new_list(t, t->level->polygon_points.count);
  if (!position_of || !points) return false;
  memset(position_of, 0xff, full_count * sizeof *position_of);
  for (uint32_t c = 0; c < t->level->polygon_points.count; c++)
    position_of[t->level->polygon_points.at[c]] = 0;
  for (uint32_t v = 0; v < full_count; v++)
    if (position_of[v] == 0) position_of[v] = count++;
  uint32_t *vertices = new_list(t, count);
  sbf_vec3 *positions = sbfi_arena_allocate(t->arena, (size_t)count + 1, sizeof *positions);
  if (!vertices || !positions) return false;
  for (uint32_t v = 0; v < full_count; v++)
    if (position_of[v] != UINT32_MAX) {
      vertices[position_of[v]] = v;
      positions[position_of[v]] = t->full->mesh.positions.at[v];
    }
  for (uint32_t c = 0; c < t->level->polygon_points.count; c++)
    points[c] = position_of[t->level->polygon_points.at[c]];
  t->made->vertices = vertices;
  t->made->vertex_count = count;
  t->made->position_of = position_of;
  t->made->mesh.mesh.positions = (sbf_vec3_list){positions, count};
  t->made->mesh.mesh.polygon_sizes = t->level->polygon_sizes;
  t->made->mesh.mesh.polygon_points = (sbf_u32_list){points, t->level->polygon_points.count};
  return true;
}

/* If the level has no corner list, uses the full mesh's first corner at each point. */
static bool find_corners(selection *t) {
  const sbf_u32_list full = t->full->mesh.polygon_points, here = t->level->polygon_points;
  t->corners = t->level->corners.at;
  if (t->level->corners.count || full.count == 0) return true;
  uint32_t *first = new_list(t, t->full->mesh.positions.count), *corners = new_list(t, here.count);
  if (!first || !corners) return false;
  for (uint32_t c = full.count; c-- > 0;) first[full.at[c]] = c;
  for (uint32_t c = 0; c < here.count; c++) corners[c] = first[here.at[c]];
  t->corners = corners;
  return true;
}

/* Reduces a corner attribute of the full mesh to the level's corners; NULL if memory runs out. */
static const uint32_t *selected_corners(const selection *t, const sbf_u32_list *of_full) {
  uint32_t *selected = new_list(t, t->level->polygon_points.count);
  for (uint32_t c = 0; selected && c < t->level->polygon_points.count; c++)
    selected[c] = of_full->at[t->corners[c]];
  return selected;
}

/* Reduces a vertex attribute of the full mesh, with items of `size` bytes, to the level's vertices. */
static const void *selected_vertices(const selection *t, const void *of_full, size_t size) {
  char *selected = sbfi_arena_allocate(t->arena, (size_t)t->made->vertex_count + 1, size);
  for (uint32_t v = 0; selected && v < t->made->vertex_count; v++)
    memcpy(selected + v * size, (const char *)of_full + t->made->vertices[v] * size, size);
  return selected;
}

static bool select_normals(selection *t) {
  sbf_render_mesh *mesh = &t->made->mesh;
  if (t->full->normal_corners.count) {
    mesh->normal_corners.count = t->level->polygon_points.count;
    return (mesh->normal_corners.at = selected_corners(t, &t->full->normal_corners)) != NULL;
  }
  if (t->full->normals.count != t->full->mesh.positions.count || !t->full->normals.count) return true;
  mesh->normals.count = t->made->vertex_count;
  return (mesh->normals.at = selected_vertices(t, t->full->normals.at, sizeof(sbf_vec3))) != NULL;
}

static bool select_colors(selection *t) {
  sbf_render_mesh *mesh = &t->made->mesh;
  if (t->full->color_corners.count) {
    mesh->color_corners.count = t->level->polygon_points.count;
    return (mesh->color_corners.at = selected_corners(t, &t->full->color_corners)) != NULL;
  }
  if (t->full->colors.count != t->full->mesh.positions.count || !t->full->colors.count) return true;
  mesh->colors.count = t->made->vertex_count;
  return (mesh->colors.at = selected_vertices(t, t->full->colors.at, sizeof(sbf_vec4))) != NULL;
}

static bool select_coordinates(const selection *t, sbf_uv_set *set) {
  if (set->corners.count) {
    set->corners.at = selected_corners(t, &set->corners);
    set->corners.count = t->level->polygon_points.count;
    return set->corners.at != NULL;
  }
  if (set->coordinates.count != t->full->mesh.positions.count || !set->coordinates.count) return true;
  set->coordinates.at = selected_vertices(t, set->coordinates.at, sizeof(sbf_vec2));
  set->coordinates.count = t->made->vertex_count;
  return set->coordinates.at != NULL;
}

static bool select_uv_sets(selection *t) {
  uint32_t count = t->full->uv_sets.count;
  if (!count) return true;
  sbf_uv_set *sets = sbfi_arena_copy(t->arena, t->full->uv_sets.at, count, sizeof *sets);
  for (uint32_t u = 0; u < count; u++)
    if (!sets || !select_coordinates(t, &sets[u])) return false;
  t->made->mesh.uv_sets.at = sets;
  return true;
}

bool sbfi_level_mesh_make(
    sbfi_level_mesh *made, const sbf_render_mesh *full, const sbf_render_level *level, sbfi_arena *arena) {
  selection t = {full, level, NULL, made, arena};
  *made = (sbfi_level_mesh){.mesh = *full};
  sbf_render_mesh *mesh = &made->mesh;
  mesh->skin = NULL;
  mesh->shape_keys.count = mesh->source_points.count = mesh->levels.count = 0;
  mesh->polygon_materials = level->polygon_materials;
  return find_vertices(&t) && find_corners(&t) && select_normals(&t) && select_colors(&t) &&
         select_uv_sets(&t);
}
