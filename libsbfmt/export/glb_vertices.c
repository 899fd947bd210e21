/* Writes meshes for graphics processors: one primitive per material with its own vertices, one for each
 * combination of point, normal and texture coordinates; polygons are fans from their first corner. */
#include <math.h>
#include <string.h>

#include "export/glb.h"

enum { MAX_UV_SETS = 4 };

/* Vertices of the current material. */
typedef struct vertices {
  sbfi_glb *g;
  const sbfi_glb_mesh *mesh;
  sbfi_glb_normals *normals; /* of its targets; NULL: none */
  uint32_t slot;
  uint32_t count;
  uint32_t uv_count; /* number of sets with coordinates */
  uint32_t uv_sets[MAX_UV_SETS];
  uint32_t *corners;      /* (count) first corner of each vertex */
  uint32_t *first, *next; /* vertices of one point, as linked lists; UINT32_MAX: end */
  uint32_t *indices;      /* three per triangle */
  uint32_t index_count;
} vertices;

static uint32_t coordinate_of(const sbf_render_mesh *m, const sbf_uv_set *set, uint32_t corner) {
  return set->corners.count ? set->corners.at[corner] : m->mesh.polygon_points.at[corner];
}

/* Index of a corner's colour; UINT32_MAX: none. */
static uint32_t color_of(const sbf_render_mesh *m, uint32_t corner) {
  uint32_t at = m->color_corners.count ? m->color_corners.at[corner] : m->mesh.polygon_points.at[corner];
  return at < m->colors.count ? at : UINT32_MAX;
}

static bool same_vertex(const vertices *v, uint32_t a, uint32_t b) {
  const sbf_render_mesh *m = v->mesh->shown;
  if (m->normals.count && sbfi_glb_normal_of(m, a) != sbfi_glb_normal_of(m, b)) return false;
  if (color_of(m, a) != color_of(m, b)) return false;
  for (uint32_t s = 0; s < v->uv_count; s++) {
    const sbf_uv_set *set = &m->uv_sets.at[v->uv_sets[s]];
    if (coordinate_of(m, set, a) != coordinate_of(m, set, b)) return false;
  }
  return true;
}

static uint32_t vertex_of(vertices *v, uint32_t corner) {
  uint32_t point = v->mesh->shown->mesh.polygon_points.at[corner], at = v->first[point];
  while (at != UINT32_MAX && !same_vertex(v, corner, v->corners[at])) at = v->next[at];
  if (at != UINT32_MAX) return at;
  at = v->count++;
  v->corners[at] = corner;
  v->next[at] = v->first[point];
  v->first[point] = at;
  return at;
}

static void find_vertices(vertices *v) {
  const sbf_render_mesh *m = v->mesh->shown;
  v->count = v->index_count = 0;
  memset(v->first, 0xff, m->mesh.positions.count * sizeof *v->first);
  for (uint32_t p = 0, corner = 0; p < m->mesh.polygon_sizes.count; p++) {
    uint32_t size = m->mesh.polygon_sizes.at[p];
    if ((m->polygon_materials.count ? m->polygon_materials.at[p] : 0) == v->slot)
      for (uint32_t k = 2; k < size; k++) {
        v->indices[v->index_count++] = vertex_of(v, corner);
        v->indices[v->index_count++] = vertex_of(v, corner + k - 1);
        v->indices[v->index_count++] = vertex_of(v, corner + k);
      }
    corner += size;
  }
}

static uint32_t point_of(const vertices *v, uint32_t vertex) {
  return v->mesh->shown->mesh.polygon_points.at[v->corners[vertex]];
}

static uint32_t full_point_of(const vertices *v, uint32_t vertex) {
  uint32_t point = point_of(v, vertex);
  return v->mesh->full_of_shown ? v->mesh->full_of_shown[point] : point;
}

static uint32_t write_positions(const vertices *v) {
  sbf_vec3 *at = sbfi_glb_allocate(v->g, v->count, sizeof *at);
  if (!at) return 0;
  for (uint32_t i = 0; i < v->count; i++) at[i] = v->mesh->shown->mesh.positions.at[point_of(v, i)];
  return sbfi_glb_accessor(v->g, at, v->count, SBFI_GLB_VEC3, SBFI_GLB_VERTICES);
}

static sbf_vec3 unit_normal(const sbf_render_mesh *m, uint32_t corner) {
  sbf_vec3 n = m->normals.at[sbfi_glb_normal_of(m, corner)];
  double length = sqrt((double)n.x * (double)n.x + (double)n.y * (double)n.y + (double)n.z * (double)n.z);
  return length > 0 ? (sbf_vec3){(float)((double)n.x / length), (float)((double)n.y / length),
                          (float)((double)n.z / length)}
                    : (sbf_vec3){0, 1, 0};
}

static uint32_t write_normals(const vertices *v) {
  sbf_vec3 *at = sbfi_glb_allocate(v->g, v->count, sizeof *at);
  if (!at) return 0;
  for (uint32_t i = 0; i < v->count; i++) at[i] = unit_normal(v->mesh->shown, v->corners[i]);
  return sbfi_glb_accessor(v->g, at, v->count, SBFI_GLB_VEC3, SBFI_GLB_VERTICES);
}

static uint32_t write_colors(const vertices *v) {
  sbf_vec4 *at = sbfi_glb_allocate(v->g, v->count, sizeof *at);
  if (!at) return 0;
  for (uint32_t i = 0; i < v->count; i++) {
    uint32_t from = color_of(v->mesh->shown, v->corners[i]);
    at[i] = from == UINT32_MAX ? (sbf_vec4){1, 1, 1, 1} : v->mesh->shown->colors.at[from];
  }
  return sbfi_glb_accessor(v->g, at, v->count, SBFI_GLB_VEC4, SBFI_GLB_VERTICES);
}

/* glTF has the origin at the upper left corner. */
static uint32_t write_coordinates(const vertices *v, const sbf_uv_set *set) {
  sbf_vec2 *at = sbfi_glb_allocate(v->g, v->count, sizeof *at);
  if (!at) return 0;
  for (uint32_t i = 0; i < v->count; i++) {
    sbf_vec2 uv = set->coordinates.at[coordinate_of(v->mesh->shown, set, v->corners[i])];
    at[i] = (sbf_vec2){uv.x, 1 - uv.y};
  }
  return sbfi_glb_accessor(v->g, at, v->count, SBFI_GLB_VEC2, SBFI_GLB_VERTICES);
}

/* Unique bones of one point, by descending weight, normalized. */
typedef struct influences {
  uint32_t *bones;
  double *weights;
  uint32_t count;
} influences;

static void gather(const sbf_skin *skin, uint32_t from, uint32_t count, uint32_t root_joint, influences *to) {
  double sum = 0;
  to->count = 0;
  for (uint32_t i = from; i < from + count; i++) {
    uint32_t k = 0;
    if (!(skin->weights.at[i] > 0)) continue;
    while (k < to->count && to->bones[k] != skin->bones.at[i]) k++;
    if (k == to->count) {
      to->bones[to->count] = skin->bones.at[i];
      to->weights[to->count++] = 0;
    }
    to->weights[k] += (double)skin->weights.at[i];
    sum += (double)skin->weights.at[i];
  }
  if (!to->count) {
    *to = (influences){to->bones, to->weights, 1};
    to->bones[0] = root_joint;
    to->weights[0] = sum = 1;
  }
  for (uint32_t k = 0; k < to->count; k++) {
    double weight = to->weights[k] / sum;
    uint32_t bone = to->bones[k], at = k;
    for (; at > 0 && to->weights[at - 1] < weight; at--) {
      to->weights[at] = to->weights[at - 1];
      to->bones[at] = to->bones[at - 1];
    }
    to->weights[at] = weight;
    to->bones[at] = bone;
  }
}

/* Bytes where they suffice for all joints. */
static uint32_t write_joints(const vertices *v, uint16_t *joints) {
  size_t scalars = 4 * (size_t)v->count;
  uint8_t *small = (uint8_t *)joints;
  if (v->g->e->asset->bones.count > UINT8_MAX)
    return sbfi_glb_accessor(v->g, joints, v->count, SBFI_GLB_USHORT4, SBFI_GLB_VERTICES);
  for (size_t i = 0; i < scalars; i++) small[i] = (uint8_t)joints[i];
  return sbfi_glb_accessor(v->g, small, v->count, SBFI_GLB_UBYTE4, SBFI_GLB_VERTICES);
}

/* Appends attributes in sets of four. */
static void write_skin(const vertices *v, sbfi_text *attributes) {
  const sbf_skin *skin = v->mesh->skin;
  uint32_t points = v->mesh->full->mesh.positions.count, max = 1, sets = 0;
  uint32_t *begins = sbfi_glb_allocate(v->g, points, sizeof *begins);
  if (!begins) return;
  for (uint32_t p = 0, at = 0; p < points; p++) {
    begins[p] = at;
    at += skin->influence_counts.at[p];
    if (skin->influence_counts.at[p] > max) max = skin->influence_counts.at[p];
  }
  influences found = {sbfi_glb_allocate(v->g, max, sizeof *found.bones),
      sbfi_glb_allocate(v->g, max, sizeof *found.weights), 0};
  uint32_t capacity = (max + 3) / 4;
  uint16_t *joints = sbfi_glb_allocate(v->g, (size_t)capacity * v->count, 4 * sizeof *joints);
  float *weights = sbfi_glb_allocate(v->g, (size_t)capacity * v->count, 4 * sizeof *weights);
  if (v->g->failed) return;
  for (uint32_t i = 0; i < v->count; i++) {
    uint32_t p = full_point_of(v, i);
    gather(skin, begins[p], skin->influence_counts.at[p], v->g->e->asset->bones.count, &found);
    for (uint32_t k = 0; k < found.count; k++) {
      float weight = (float)found.weights[k];
      size_t at = ((size_t)(k / 4) * v->count + i) * 4 + k % 4;
      joints[at] = weight > 0 ? (uint16_t)found.bones[k] : 0;
      weights[at] = weight;
    }
    if ((found.count + 3) / 4 > sets) sets = (found.count + 3) / 4;
  }
  for (uint32_t s = 0; s < sets; s++) {
    uint32_t j = write_joints(v, joints + 4 * (size_t)s * v->count);
    uint32_t w = sbfi_glb_accessor(
        v->g, weights + 4 * (size_t)s * v->count, v->count, SBFI_GLB_VEC4, SBFI_GLB_VERTICES);
    sbfi_export_print(attributes, ",\"JOINTS_%u\":%u,\"WEIGHTS_%u\":%u", s, j, s, w);
  }
}

/* Offsets of the points of `shown` in a target: shape keys come first, then the motion's frames. */
static void get_target_offsets(const vertices *v, uint32_t target, sbf_vec3 *of_full, sbf_vec3 *of_shown) {
  const sbfi_glb_mesh *mesh = v->mesh;
  uint32_t keys = mesh->full->shape_keys.count;
  if (target >= keys) {
    sbfi_glb_compute_offsets(v->g, mesh, target - keys, of_shown);
    return;
  }
  const sbf_shape_key *key = &mesh->full->shape_keys.at[target];
  memset(of_full, 0, mesh->full->mesh.positions.count * sizeof *of_full);
  for (uint32_t i = 0; i < key->points.count; i++) of_full[key->points.at[i]] = key->offsets.at[i];
  for (uint32_t p = 0; p < mesh->shown->mesh.positions.count; p++)
    of_shown[p] = of_full[mesh->full_of_shown ? mesh->full_of_shown[p] : p];
}

static void write_targets(const vertices *v, sbfi_text *text) {
  const sbfi_glb_mesh *mesh = v->mesh;
  sbf_vec3 *of_full = sbfi_glb_allocate(v->g, mesh->full->mesh.positions.count, sizeof *of_full);
  sbf_vec3 *of_shown = sbfi_glb_allocate(v->g, mesh->shown->mesh.positions.count, sizeof *of_shown);
  sbf_vec3 *at = sbfi_glb_allocate(v->g, v->count, sizeof *at);
  for (uint32_t t = 0; t < mesh->target_count && !v->g->failed; t++) {
    get_target_offsets(v, t, of_full, of_shown);
    for (uint32_t i = 0; i < v->count; i++) at[i] = of_shown[point_of(v, i)];
    uint32_t number = sbfi_glb_accessor(v->g, at, v->count, SBFI_GLB_VEC3, SBFI_GLB_VERTICES);
    sbfi_export_print(text, "%s{\"POSITION\":%u", t ? "," : ",\"targets\":[", number);
    if (v->normals) {
      sbfi_glb_normals_move(v->normals, of_shown);
      for (uint32_t i = 0; i < v->count; i++)
        at[i] = sbfi_glb_normals_offset(v->normals, v->corners[i], unit_normal(mesh->shown, v->corners[i]));
      number = sbfi_glb_accessor(v->g, at, v->count, SBFI_GLB_VEC3, SBFI_GLB_VERTICES);
      sbfi_export_print(text, ",\"NORMAL\":%u", number);
    }
    sbfi_text_char(text, '}');
  }
  sbfi_text_char(text, ']');
}

/* 65535 may not be an index of two bytes. */
static uint32_t write_indices(const vertices *v) {
  if (v->count > UINT16_MAX)
    return sbfi_glb_accessor(v->g, v->indices, v->index_count, SBFI_GLB_UINT, SBFI_GLB_INDICES);
  uint16_t *small = sbfi_glb_allocate(v->g, v->index_count, sizeof *small);
  if (!small) return 0;
  for (uint32_t i = 0; i < v->index_count; i++) small[i] = (uint16_t)v->indices[i];
  return sbfi_glb_accessor(v->g, small, v->index_count, SBFI_GLB_USHORT, SBFI_GLB_INDICES);
}

static void write_primitive(vertices *v, sbfi_text *text) {
  const sbf_render_mesh *m = v->mesh->shown;
  sbfi_export_print(text, "{\"attributes\":{\"POSITION\":%u", write_positions(v));
  if (m->normals.count) sbfi_export_print(text, ",\"NORMAL\":%u", write_normals(v));
  if (m->colors.count) sbfi_export_print(text, ",\"COLOR_0\":%u", write_colors(v));
  for (uint32_t s = 0; s < v->uv_count; s++)
    sbfi_export_print(text, ",\"TEXCOORD_%u\":%u", s, write_coordinates(v, &m->uv_sets.at[v->uv_sets[s]]));
  if (v->mesh->skin) write_skin(v, text);
  uint32_t indices = write_indices(v);
  sbfi_export_print(text, "},\"indices\":%u", indices);
  if (v->slot < m->material_slots.count && m->material_slots.at[v->slot].material >= 0)
    sbfi_export_print(text, ",\"material\":%d", (int)m->material_slots.at[v->slot].material);
  if (v->mesh->target_count) write_targets(v, text);
  sbfi_text_char(text, '}');
}

static void write_target_names(const sbfi_glb_mesh *mesh, sbfi_text *text) {
  uint32_t keys = mesh->full->shape_keys.count;
  if (!mesh->target_count) return;
  sbfi_text_string(text, ",\"weights\":");
  for (uint32_t t = 0; t < mesh->target_count; t++) sbfi_text_string(text, t ? ",0" : "[0");
  sbfi_text_string(text, "],\"extras\":{\"targetNames\":[");
  for (uint32_t t = 0; t < mesh->target_count; t++) {
    if (t) sbfi_text_char(text, ',');
    if (t < keys)
      sbfi_glb_write_string(text, mesh->full->shape_keys.at[t].name);
    else
      sbfi_export_print(text, "\"frame %u\"", t - keys);
  }
  sbfi_text_string(text, "]}");
}

static void write_mesh(sbfi_glb *g, const sbfi_glb_mesh *mesh) {
  const sbf_render_mesh *m = mesh->shown;
  uint32_t corners = m->mesh.polygon_points.count, slots = m->material_slots.count;
  vertices v = {.g = g,
      .mesh = mesh,
      .normals = sbfi_glb_normals_begin(g, mesh),
      .corners = sbfi_glb_allocate(g, corners, sizeof *v.corners),
      .next = sbfi_glb_allocate(g, corners, sizeof *v.next),
      .first = sbfi_glb_allocate(g, m->mesh.positions.count, sizeof *v.first),
      .indices = sbfi_glb_allocate(g, 3 * (size_t)corners, sizeof *v.indices)};
  for (uint32_t s = 0; s < m->uv_sets.count && v.uv_count < MAX_UV_SETS; s++)
    if (m->uv_sets.at[s].coordinates.count) v.uv_sets[v.uv_count++] = s;
  if (g->failed) return;
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_MESHES, NULL);
  sbfi_text_string(text, "{\"name\":");
  sbfi_glb_write_string(text, *mesh->full->name ? mesh->full->name : mesh->full->id);
  const char *before = ",\"primitives\":[";
  for (v.slot = 0; v.slot < (slots ? slots : 1) && !g->failed; v.slot++) {
    find_vertices(&v);
    if (!v.count) continue;
    sbfi_text_string(text, before);
    write_primitive(&v, text);
    before = ",";
  }
  sbfi_text_char(text, ']');
  write_target_names(mesh, text);
  sbfi_text_char(text, '}');
}

void sbfi_glb_write_meshes(sbfi_glb *g) {
  for (uint32_t i = 0; i < g->e->asset->render_meshes.count && !g->failed; i++)
    if (g->meshes[i].node != UINT32_MAX) write_mesh(g, &g->meshes[i]);
}
