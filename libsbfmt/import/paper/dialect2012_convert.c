/* Converts a model of the 2012 dialect to an asset: soft bodies, meshes and attachments. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "import/convert/convert_tets.h"
#include "import/paper/dialect2012.h"
#include "interchange/paper_units.h"

/* Number of corners with a normal, and with a texture coordinate. */
typedef struct corner_counts {
  size_t normals, coordinates;
} corner_counts;

static corner_counts count_corners(const sbfi_paper_surface *surface) {
  corner_counts counts = {0, 0};
  const sbfi_paper_corner *corners = surface->corners.at;
  for (size_t i = 0; i < surface->corners.count; i++) {
    counts.normals += corners[i].normal != 0;
    counts.coordinates += corners[i].coordinate != 0;
  }
  return counts;
}

/* Indices of the items that the corners refer to with `id_of`; every corner must have one. */
static uint32_t *named_indices(sbfi_conversion *c, const sbfi_paper_surface *surface, const sbfi_array *ids,
    size_t id_offset, const char *what) {
  uint32_t *indices = sbfi_convert_allocate(c, surface->corners.count, sizeof *indices);
  sbfi_paper_table table;
  if (!indices) {
    sbfi_convert_no_memory(c);
    return NULL;
  }
  if (!sbfi_paper_table_make(c, &table, ids, what)) return NULL;
  for (size_t i = 0; i < surface->corners.count; i++) {
    uint32_t id;
    memcpy(&id, (const char *)surface->corners.at + i * sizeof(sbfi_paper_corner) + id_offset, sizeof id);
    if (!sbfi_paper_find(c, &table, id, what, &indices[i])) return NULL;
  }
  return indices;
}

static sbf_vec3 turn(const sbfi_matrix *m, sbf_vec3 v) {
  sbfi_matrix direction = *m;
  for (int r = 0; r < 3; r++) direction.at[r][3] = 0;
  return sbfi_transform_point(&direction, v);
}

static sbf_status fill_normals(sbfi_conversion *c, const sbfi_paper_surface *surface, sbf_render_mesh *mesh) {
  uint32_t count = (uint32_t)surface->normals.values.count;
  uint32_t *indices =
      named_indices(c, surface, &surface->normals.ids, offsetof(sbfi_paper_corner, normal), "normals");
  sbf_vec3 *normals = sbfi_convert_allocate(c, count, sizeof *normals);
  if (!indices) return sbfi_paper_fault(c);
  if (!normals) return sbfi_convert_no_memory(c);
  /* Rotates normals with the axes but without the unit's scale. */
  sbfi_matrix axes = c->to_asset;
  double unit = axes.at[0][0] != 0 ? axes.at[0][0] : 1;
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 3; k++) axes.at[r][k] /= unit;
  const sbf_vec3 *from = surface->normals.values.at;
  for (uint32_t i = 0; i < count; i++) normals[i] = turn(&axes, from[i]);
  mesh->normals = (sbf_vec3_list){normals, count};
  mesh->normal_corners = (sbf_u32_list){indices, (uint32_t)surface->corners.count};
  return SBF_OK;
}

static sbf_status fill_coordinates(
    sbfi_conversion *c, const sbfi_paper_surface *surface, sbf_render_mesh *mesh) {
  uint32_t count = (uint32_t)surface->coordinates.values.count;
  sbf_uv_set *set = sbfi_convert_allocate(c, 1, sizeof *set);
  uint32_t *indices = named_indices(
      c, surface, &surface->coordinates.ids, offsetof(sbfi_paper_corner, coordinate), "texture coordinates");
  sbf_vec2 *coordinates = sbfi_convert_allocate(c, count, sizeof *coordinates);
  if (!indices) return sbfi_paper_fault(c);
  if (!set || !coordinates) return sbfi_convert_no_memory(c);
  memcpy(coordinates, surface->coordinates.values.at, count * sizeof *coordinates);
  sbf_uv_set_init(set);
  set->coordinates = (sbf_vec2_list){coordinates, count};
  set->corners = (sbf_u32_list){indices, (uint32_t)surface->corners.count};
  mesh->uv_sets = (sbf_uv_set_list){set, 1};
  return SBF_OK;
}

static sbf_status fill_render_mesh(
    sbfi_conversion *c, const sbfi_paper_surface *surface, const char *name, sbf_render_mesh *mesh) {
  sbf_render_mesh_init(mesh);
  mesh->id = sbfi_new_id(c, "mesh", name);
  mesh->name = name;
  if (!mesh->id) return sbfi_convert_no_memory(c);
  corner_counts counts = count_corners(surface);
  sbf_status status = sbfi_paper_polygons(c, surface, "vertices", &mesh->mesh);
  if (status == SBF_OK && counts.normals) {
    if (counts.normals == surface->corners.count)
      status = fill_normals(c, surface, mesh);
    else
      sbfi_convert_warn(c, SBF_CODE_IMPORT_IGNORED,
          "only some corners of the faces have normals: all normals are left out");
  }
  if (status == SBF_OK && counts.coordinates) {
    if (counts.coordinates == surface->corners.count)
      status = fill_coordinates(c, surface, mesh);
    else
      sbfi_convert_warn(c, SBF_CODE_IMPORT_IGNORED,
          "only some corners of the faces have texture coordinates: all of them are left out");
  }
  return status;
}

/* ---- The lattice ---- */

static sbf_status fill_tet_mesh(sbfi_conversion *c, const sbfi_paper_body *from, sbfi_tet_mesh *mesh) {
  sbfi_paper_table table;
  if (!sbfi_paper_table_make(c, &table, &from->lattice.ids, "vertices of the lattice"))
    return sbfi_paper_fault(c);
  if (!sbfi_array_append(&mesh->points, from->lattice.values.at, from->lattice.values.count) ||
      !sbfi_array_push(&mesh->tetrahedra, from->tetrahedron_ids.count))
    return sbfi_convert_no_memory(c);
  uint32_t *indices = mesh->tetrahedra.at;
  const uint32_t *ids = from->nodes.at;
  for (size_t i = 0; i < from->nodes.count; i++)
    if (!sbfi_paper_find(c, &table, ids[i], "vertices of the lattice", &indices[i]))
      return sbfi_paper_fault(c);
  return sbfi_tet_mesh_repair(mesh, c->scene->file, c->error);
}

/* `nodes`: indices of each tetrahedron's four nodes as in the file. */
static sbf_status fill_embedding(sbfi_conversion *c, const sbfi_paper_body *from, const sbf_uint4 *nodes,
    const uint32_t *new_from_old, int32_t mesh, sbf_level *level) {
  uint32_t count = (uint32_t)from->embedded_vertices.count;
  sbf_embedding *embedding = sbfi_convert_allocate(c, 1, sizeof *embedding);
  uint32_t *vertices = sbfi_convert_allocate(c, count, sizeof *vertices);
  sbf_uint4 *points = sbfi_convert_allocate(c, count, sizeof *points);
  sbf_vec4 *weights = sbfi_convert_allocate(c, count, sizeof *weights);
  sbfi_paper_table vertex_table, tetrahedron_table;
  if (!embedding || !vertices || !points || !weights) return sbfi_convert_no_memory(c);
  if (!sbfi_paper_table_make(c, &vertex_table, &from->surface.vertices.ids, "vertices") ||
      !sbfi_paper_table_make(c, &tetrahedron_table, &from->tetrahedron_ids, "tetrahedra"))
    return sbfi_paper_fault(c);
  const sbfi_paper_embedding *embedded_vertices = from->embedded_vertices.at;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t index;
    if (!sbfi_paper_find(c, &vertex_table, embedded_vertices[i].vertex, "vertices", &vertices[i]) ||
        !sbfi_paper_find(c, &tetrahedron_table, embedded_vertices[i].tetrahedron, "tetrahedra", &index))
      return sbfi_paper_fault(c);
    const float *v = embedded_vertices[i].weights;
    for (int k = 0; k < 4; k++) points[i].at[k] = new_from_old[nodes[index].at[k]];
    weights[i] = (sbf_vec4){v[0], v[1], v[2], (float)(1.0 - (double)v[0] - (double)v[1] - (double)v[2])};
  }
  sbf_embedding_init(embedding);
  embedding->render_mesh = mesh;
  embedding->vertices = (sbf_u32_list){vertices, count};
  embedding->points = (sbf_uint4_list){points, count};
  embedding->weights = (sbf_vec4_list){weights, count};
  level->embeddings = (sbf_embedding_list){embedding, 1};
  return SBF_OK;
}

static sbf_status fill_lattice(
    sbfi_conversion *c, const sbfi_paper_body *from, const char *name, int32_t mesh, sbf_soft_body *body) {
  sbfi_tet_mesh tets = {.allocator = c->scratch.allocator, .format = "2012 dialect"};
  sbfi_array_init(&tets.points, &tets.allocator, sizeof(sbf_vec3));
  sbfi_array_init(&tets.tetrahedra, &tets.allocator, sizeof(sbf_uint4));
  const uint32_t *new_from_old = NULL;
  sbf_uint4 *nodes = NULL;
  sbf_status status = fill_tet_mesh(c, from, &tets);
  if (status == SBF_OK) {
    /* Repair may drop or flip tetrahedra; the weights refer to the original ones. */
    nodes = sbfi_arena_allocate(&c->scratch, from->tetrahedron_ids.count, sizeof *nodes);
    sbfi_paper_table table;
    if (!nodes || !sbfi_paper_table_make(c, &table, &from->lattice.ids, "vertices of the lattice"))
      status = sbfi_convert_no_memory(c);
    else
      for (size_t i = 0; i < from->nodes.count; i++)
        sbfi_paper_find(c, &table, ((const uint32_t *)from->nodes.at)[i], "", &nodes[i / 4].at[i % 4]);
  }
  if (status == SBF_OK) status = sbfi_convert_tet_body(c, &tets, name, body, &new_from_old);
  if (status == SBF_OK && from->embedded_vertices.count && mesh >= 0) {
    sbf_level level = body->levels.at[0], *changed = sbfi_convert_allocate(c, 1, sizeof *changed);
    status = changed ? fill_embedding(c, from, nodes, new_from_old, mesh, &level) : sbfi_convert_no_memory(c);
    if (status == SBF_OK) {
      *changed = level;
      body->levels = (sbf_level_list){changed, 1};
    }
  }
  sbfi_array_free(&tets.points);
  sbfi_array_free(&tets.tetrahedra);
  return status;
}

/* ---- Attributes ---- */

static sbf_status fill_attributes(sbfi_conversion *c, const sbfi_paper_body *from, sbf_soft_body *body) {
  const sbf_level *level = &body->levels.at[0];
  sbfi_paper_sums sums;
  bool any = false;
  for (int i = 0; i < SBFI_PAPER_ATTRIBUTES; i++) any |= from->given[i];
  if (!any) return SBF_OK;
  sbf_legacy *sliders = sbfi_convert_allocate(c, 1, sizeof *sliders);
  if (!sliders ||
      !sbfi_paper_measure(level->positions, level->lattice.tetrahedra, &c->scratch.allocator, &sums))
    return sbfi_convert_no_memory(c);
  const float *value = from->attributes;
  uint32_t iterations = from->given[SBFI_PAPER_SOLVER_ITERATIONS]
                            ? (uint32_t)value[SBFI_PAPER_SOLVER_ITERATIONS]
                            : SBFI_PAPER_ITERATIONS;
  sbf_legacy_init(sliders);
  sbfi_paper_from_si(&body->attributes, &body->collision, &sums, iterations, sliders);
  if (from->given[SBFI_PAPER_MASS]) sliders->mass = value[SBFI_PAPER_MASS];
  if (from->given[SBFI_PAPER_VOLUME_STIFFNESS])
    sliders->volume_stiffness = value[SBFI_PAPER_VOLUME_STIFFNESS];
  if (from->given[SBFI_PAPER_STRETCHING_STIFFNESS])
    sliders->stretching_stiffness = value[SBFI_PAPER_STRETCHING_STIFFNESS];
  if (from->given[SBFI_PAPER_FRICTION]) sliders->friction = value[SBFI_PAPER_FRICTION];
  sbfi_paper_to_si(sliders, &sums, &body->attributes);
  if (from->given[SBFI_PAPER_PARTICLE_RADIUS]) {
    double unit = cbrt(fabs(sbfi_matrix_determinant(&c->to_asset)));
    sliders->particle_radius = value[SBFI_PAPER_PARTICLE_RADIUS];
    body->collision.particle_radius = (float)((double)sliders->particle_radius * unit);
  }
  body->legacy = sliders;
  return SBF_OK;
}

/* The paper's second method: every rigid body attaches the soft bodies that it overlaps. */
static sbf_status fill_attachments(sbfi_conversion *c, sbf_soft_body *body) {
  uint32_t count = c->asset->rigid_bodies.count;
  if (!count) return SBF_OK;
  sbf_attachment *attachments = sbfi_convert_allocate(c, count, sizeof *attachments);
  if (!attachments) return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < count; i++) {
    sbf_attachment_init(&attachments[i]);
    attachments[i].name = c->asset->rigid_bodies.at[i].name;
    attachments[i].rule = SBF_ATTACHMENT_RULE_INSIDE_HULL;
    attachments[i].rigid_body = (int32_t)i;
  }
  body->attachments = (sbf_attachment_list){attachments, count};
  return SBF_OK;
}

static sbf_status convert_body(sbfi_conversion *c, const sbfi_paper_body *from, const char *name,
    sbf_soft_body *body, sbf_render_mesh *mesh) {
  int32_t index = (int32_t)c->asset->render_meshes.count;
  bool has_mesh = from->surface.vertices.values.count > 0;
  sbf_status status = SBF_OK;
  if (has_mesh) {
    status = fill_render_mesh(c, &from->surface, name, mesh);
    c->asset->render_meshes.count++;
  }
  if (status == SBF_OK) status = fill_lattice(c, from, name, has_mesh ? index : SBF_NONE, body);
  if (status == SBF_OK) status = fill_attributes(c, from, body);
  return status == SBF_OK ? fill_attachments(c, body) : status;
}

sbf_status sbfi_convert_paper(sbfi_conversion *c, const sbfi_paper_model *model, const char *name) {
  uint32_t count = (uint32_t)model->soft_bodies.count;
  if (!count && !model->rigid_bodies.count)
    return sbfi_diagnose(
        c->error, SBF_CODE_IMPORT_EMPTY, "%s has neither a soft body nor a rigid body", c->scene->file);
  if (model->ignored_count)
    sbfi_convert_warn(c, SBF_CODE_IMPORT_IGNORED,
        "%u elements that the dialect does not have are skipped, the first is <%s> on line %u",
        model->ignored_count, model->ignored_name, model->ignored_line);
  sbf_status status = sbfi_convert_paper_skeleton(c, model);
  if (status != SBF_OK || !count) return status;
  sbf_soft_body *bodies = sbfi_convert_allocate(c, count, sizeof *bodies);
  sbf_render_mesh *meshes = sbfi_convert_allocate(c, count, sizeof *meshes);
  if (!bodies || !meshes) return sbfi_convert_no_memory(c);
  c->asset->render_meshes = (sbf_render_mesh_list){meshes, 0};
  for (uint32_t i = 0; i < count && status == SBF_OK; i++) {
    char numbered[256];
    snprintf(numbered, sizeof numbered, count > 1 ? "%.200s_%u" : "%.200s", name, i + 1);
    const char *own = sbf_asset_copy_text(c->asset, numbered);
    status = own ? convert_body(c, (const sbfi_paper_body *)model->soft_bodies.at + i, own, &bodies[i],
                       &meshes[c->asset->render_meshes.count])
                 : sbfi_convert_no_memory(c);
  }
  if (!c->asset->render_meshes.count) c->asset->render_meshes.at = NULL;
  c->asset->soft_bodies = (sbf_soft_body_list){bodies, count};
  return status;
}
