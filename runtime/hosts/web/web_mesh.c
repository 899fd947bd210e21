/* Meshes for a graphics card: triangles over vertices with one normal and one texture coordinate each, where
 * a file has those per corner. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "web.h"

typedef struct web_mesh {
  uint32_t mesh, level;
  uint32_t vertex_count, index_count, group_count, point_count, corner_count;
  uint32_t *vertex_points;  /* (vertex_count) point of the runtime's output */
  uint32_t *vertex_corners; /* (vertex_count) corner with its normal */
  uint32_t *indices;        /* (index_count) */
  uint32_t *groups;         /* (group_count x 3) first index, count, material + 1 */
  float *uvs;               /* (vertex_count x 2) from the top left; NULL: none */
  sbf_vec3 *positions, *normals;
  sbf_vec3 *points, *point_normals, *corner_normals; /* storage for the runtime's output */
  bool by_corner;
} web_mesh;

void WEB_CALL(web_mesh_free)(web_mesh *m) {
  if (!m) return;
  void *const parts[] = {m->vertex_points, m->vertex_corners, m->indices, m->groups, m->uvs, m->positions,
      m->normals, m->points, m->point_normals, m->corner_normals};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) free(parts[i]);
  free(m);
}

/* The polygons of the mesh or of one of its levels. */
typedef struct polygons {
  sbf_u32_list sizes, points, materials;
  uint32_t *position_of; /* (points of the mesh) index in the runtime's output */
  uint32_t *corner_of;   /* (corners) equivalent corner of the full mesh */
} polygons;

static bool find_polygons(const sbf_render_mesh *mesh, const sbr_model *model, web_mesh *m, polygons *p) {
  const sbf_render_level *level = m->level ? &mesh->levels.at[m->level - 1] : NULL;
  uint32_t points = mesh->mesh.positions.count;
  p->sizes = level ? level->polygon_sizes : mesh->mesh.polygon_sizes;
  p->points = level ? level->polygon_points : mesh->mesh.polygon_points;
  p->materials = level ? level->polygon_materials : mesh->polygon_materials;
  p->position_of = malloc((points + 1u) * sizeof *p->position_of);
  p->corner_of = malloc((p->points.count + 1u) * sizeof *p->corner_of);
  uint32_t *scratch = calloc(points + 1u, sizeof *scratch);
  bool good = p->position_of && p->corner_of && scratch;
  m->corner_count = p->points.count;
  m->point_count = level ? sbr_model_get_level_vertices(model, m->mesh, m->level, NULL, 0) : points;
  for (uint32_t i = 0; good && i < points; i++) p->position_of[i] = i;
  for (uint32_t i = 0; good && i < p->points.count; i++) p->corner_of[i] = i;
  if (good && level) {
    sbr_model_get_level_vertices(model, m->mesh, m->level, scratch, points);
    for (uint32_t i = 0; i < m->point_count; i++) p->position_of[scratch[i]] = i;
    /* A level may lack the equivalent corners in the full mesh: then the first one at the point. */
    memset(scratch, 0, (points + 1u) * sizeof *scratch);
    for (uint32_t i = mesh->mesh.polygon_points.count; i-- > 0;) scratch[mesh->mesh.polygon_points.at[i]] = i;
    for (uint32_t i = 0; i < p->points.count; i++)
      p->corner_of[i] = level->corners.count ? level->corners.at[i] : scratch[p->points.at[i]];
  }
  free(scratch);
  return good;
}

/* Key of a vertex: corners with equal keys share one. */
typedef struct vertex_key {
  uint32_t point, uv, normal;
} vertex_key;

static vertex_key key_of(const sbf_render_mesh *mesh, const polygons *p, uint32_t corner) {
  uint32_t corner_index = p->corner_of[corner], point = p->points.at[corner];
  const sbf_uv_set *uv = mesh->uv_sets.count ? &mesh->uv_sets.at[0] : NULL;
  return (vertex_key){point, uv ? (uv->corners.count ? uv->corners.at[corner_index] : point) : 0,
      mesh->normal_corners.count ? mesh->normal_corners.at[corner_index] : 0};
}

/* Assigns a vertex to every corner, by a hash table of keys. */
static bool make_vertices(const sbf_render_mesh *mesh, const polygons *p, web_mesh *m, uint32_t *vertex_of) {
  uint32_t slots = 16, corners = p->points.count;
  while (slots < 2 * corners) slots *= 2;
  uint32_t *table = malloc((size_t)slots * sizeof *table);
  vertex_key *keys = malloc((corners + 1u) * sizeof *keys);
  bool good = table && keys;
  if (good) memset(table, 0xFF, (size_t)slots * sizeof *table);
  for (uint32_t c = 0; good && c < corners; c++) {
    vertex_key key = key_of(mesh, p, c);
    uint32_t slot = (key.point * 0x9E3779B1u ^ key.uv * 0x85EBCA6Bu ^ key.normal * 0xC2B2AE35u) & (slots - 1);
    while (table[slot] != UINT32_MAX && memcmp(&keys[table[slot]], &key, sizeof key) != 0)
      slot = (slot + 1) & (slots - 1);
    if (table[slot] == UINT32_MAX) {
      table[slot] = m->vertex_count;
      keys[m->vertex_count] = key;
      m->vertex_points[m->vertex_count] = p->position_of[key.point];
      m->vertex_corners[m->vertex_count++] = c;
    }
    vertex_of[c] = table[slot];
  }
  const sbf_uv_set *uv = mesh->uv_sets.count ? &mesh->uv_sets.at[0] : NULL;
  if (good && uv) m->uvs = malloc((m->vertex_count + 1u) * 2 * sizeof *m->uvs);
  for (uint32_t v = 0; good && m->uvs && v < m->vertex_count; v++) {
    m->uvs[2 * v] = uv->coordinates.at[keys[v].uv].x;
    m->uvs[2 * v + 1] = 1 - uv->coordinates.at[keys[v].uv].y;
  }
  free(table);
  free(keys);
  return good && (!uv || m->uvs);
}

static float square(const sbf_vec3 *a, const sbf_vec3 *b) {
  float x = a->x - b->x, y = a->y - b->y, z = a->z - b->z;
  return x * x + y * y + z * z;
}

/* Fans; a quad is divided along its shorter diagonal. */
static void cut_polygon(const sbf_render_mesh *mesh, const polygons *p, const uint32_t *vertex_of,
    uint32_t at, uint32_t size, web_mesh *m) {
  const sbf_vec3 *positions_at = mesh->mesh.positions.at;
  const uint32_t *points = p->points.at + at;
  uint32_t turn = size == 4 && square(&positions_at[points[1]], &positions_at[points[3]]) <
                                   square(&positions_at[points[0]], &positions_at[points[2]]);
  for (uint32_t k = 2; k < size; k++) {
    m->indices[m->index_count++] = vertex_of[at + turn];
    m->indices[m->index_count++] = vertex_of[at + (k - 1 + turn) % size];
    m->indices[m->index_count++] = vertex_of[at + (k + turn) % size];
  }
}

static bool make_triangles(
    const sbf_render_mesh *mesh, const polygons *p, web_mesh *m, const uint32_t *vertex_of) {
  uint32_t slots = mesh->material_slots.count ? mesh->material_slots.count : 1;
  m->indices = malloc((3 * (size_t)p->points.count + 1) * sizeof *m->indices);
  m->groups = malloc(3 * (size_t)slots * sizeof *m->groups);
  if (!m->indices || !m->groups) return false;
  for (uint32_t s = 0; s < slots; s++) {
    uint32_t first = m->index_count;
    for (uint32_t i = 0, at = 0; i < p->sizes.count; at += p->sizes.at[i++])
      if ((p->materials.count ? p->materials.at[i] : 0) == s)
        cut_polygon(mesh, p, vertex_of, at, p->sizes.at[i], m);
    if (m->index_count == first) continue;
    uint32_t *group = m->groups + 3 * (size_t)m->group_count++;
    group[0] = first;
    group[1] = m->index_count - first;
    group[2] = mesh->material_slots.count ? (uint32_t)(mesh->material_slots.at[s].material + 1) : 0;
  }
  return true;
}

/* NULL: no memory, or no such mesh. `level`: at most the last one. */
web_mesh *WEB_CALL(web_mesh_create)(
    const sbf_asset *asset, const sbr_model *model, uint32_t number, uint32_t level) {
  if (number >= asset->render_meshes.count) return NULL;
  const sbf_render_mesh *mesh = &asset->render_meshes.at[number];
  web_mesh *m = calloc(1, sizeof *m);
  polygons p = {.position_of = NULL};
  if (!m) return NULL;
  m->mesh = number;
  m->level = level < mesh->levels.count ? level : mesh->levels.count;
  m->by_corner = mesh->normal_corners.count > 0;
  bool good = find_polygons(mesh, model, m, &p);
  uint32_t *vertex_of = malloc((p.points.count + 1u) * sizeof *vertex_of);
  m->vertex_points = malloc((p.points.count + 1u) * sizeof *m->vertex_points);
  m->vertex_corners = malloc((p.points.count + 1u) * sizeof *m->vertex_corners);
  m->points = malloc((m->point_count + 1u) * sizeof *m->points);
  m->point_normals = malloc((m->point_count + 1u) * sizeof *m->point_normals);
  m->corner_normals = malloc((m->by_corner ? p.points.count + 1u : 1u) * sizeof *m->corner_normals);
  good = good && vertex_of && m->vertex_points && m->vertex_corners && m->points && m->point_normals &&
         m->corner_normals && make_vertices(mesh, &p, m, vertex_of) && make_triangles(mesh, &p, m, vertex_of);
  m->positions = calloc(m->vertex_count + 1u, sizeof *m->positions);
  m->normals = calloc(m->vertex_count + 1u, sizeof *m->normals);
  free(vertex_of);
  free(p.position_of);
  free(p.corner_of);
  if (good && m->positions && m->normals) return m;
  web_mesh_free(m);
  return NULL;
}

/* Six numbers: vertices, indices, groups, and addresses of indices, groups, uvs (0: none), positions and
 * normals. */
void WEB_CALL(web_mesh_layout)(const web_mesh *m, uint32_t *to) {
  const uint32_t numbers[8] = {m->vertex_count, m->index_count, m->group_count,
      (uint32_t)(uintptr_t)m->indices, (uint32_t)(uintptr_t)m->groups, (uint32_t)(uintptr_t)m->uvs,
      (uint32_t)(uintptr_t)m->positions, (uint32_t)(uintptr_t)m->normals};
  memcpy(to, numbers, sizeof numbers);
}

/* Positions and normals at the sampled time, relative to the character's origin. */
void WEB_CALL(web_mesh_update)(web_mesh *m, const sbr_world *world, uint32_t character) {
  sbr_character_id id = {character};
  sbr_character_get_level_skin(
      world, id, m->mesh, m->level, m->points, m->by_corner ? NULL : m->point_normals, NULL, m->point_count);
  if (m->by_corner)
    sbr_character_get_level_corner_normals(world, id, m->mesh, m->level, m->corner_normals, m->corner_count);
  for (uint32_t v = 0; v < m->vertex_count; v++) {
    m->positions[v] = m->points[m->vertex_points[v]];
    m->normals[v] =
        m->by_corner ? m->corner_normals[m->vertex_corners[v]] : m->point_normals[m->vertex_points[v]];
  }
}
