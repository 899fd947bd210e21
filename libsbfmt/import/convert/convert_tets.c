#include "import/convert/convert_tets.h"

#include <string.h>

static const uint32_t INSIDE = UINT32_MAX;

/* Source points in the body's order: boundary points first, then interior points, both in file order. */
typedef struct order {
  uint32_t *new_from_old, *old_from_new;
  uint32_t surface_count, count;
} order;

static bool find_order(sbfi_conversion *c, const sbfi_tet_mesh *mesh, const sbfi_array *triangles, order *o) {
  o->count = (uint32_t)mesh->points.count;
  o->new_from_old = sbfi_arena_allocate(&c->scratch, o->count, sizeof(uint32_t));
  o->old_from_new = sbfi_arena_allocate(&c->scratch, o->count, sizeof(uint32_t));
  if (!o->new_from_old || !o->old_from_new) return false;
  const uint32_t *corners = triangles->at;
  for (uint32_t i = 0; i < o->count; i++) o->new_from_old[i] = INSIDE;
  for (size_t i = 0; i < triangles->count; i++) o->new_from_old[corners[i]] = 0;
  uint32_t at = 0;
  for (int pass = 0; pass < 2; pass++) {
    for (uint32_t i = 0; i < o->count; i++) {
      bool outside = o->new_from_old[i] != INSIDE;
      if (outside == (pass == 0)) o->old_from_new[at++] = i;
    }
    if (pass == 0) o->surface_count = at;
  }
  for (uint32_t i = 0; i < o->count; i++) o->new_from_old[o->old_from_new[i]] = i;
  return true;
}

static sbf_status fill_surface(sbfi_conversion *c, const sbfi_array *triangles, const order *o,
    const sbf_vec3 *points, sbf_polygon_mesh *mesh) {
  uint32_t count = (uint32_t)(triangles->count / 3);
  uint32_t *sizes = sbfi_convert_allocate(c, count, sizeof *sizes);
  uint32_t *corners = sbfi_convert_allocate(c, triangles->count, sizeof *corners);
  if (!sizes || !corners) return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < count; i++) sizes[i] = 3;
  for (size_t i = 0; i < triangles->count; i++)
    corners[i] = o->new_from_old[((const uint32_t *)triangles->at)[i]];
  mesh->positions = (sbf_vec3_list){points, o->surface_count};
  mesh->polygon_sizes = (sbf_u32_list){sizes, count};
  mesh->polygon_points = (sbf_u32_list){corners, 3 * count};
  return SBF_OK;
}

static sbf_status fill_level(sbfi_conversion *c, const sbfi_tet_mesh *mesh, const order *o,
    const sbf_vec3 *points, sbf_soft_body *body) {
  sbf_level *level = sbfi_convert_allocate(c, 1, sizeof *level);
  sbf_uint4 *tetrahedra = sbfi_convert_allocate(c, mesh->tetrahedra.count, sizeof *tetrahedra);
  if (!level || !tetrahedra) return sbfi_convert_no_memory(c);
  const sbf_uint4 *from = mesh->tetrahedra.at;
  for (size_t i = 0; i < mesh->tetrahedra.count; i++)
    for (int k = 0; k < 4; k++) tetrahedra[i].at[k] = o->new_from_old[from[i].at[k]];
  sbf_level_init(level);
  level->model = SBF_ELASTIC_MODEL_TETRAHEDRA;
  level->positions = (sbf_vec3_list){points, o->count};
  level->lattice.tetrahedra = (sbf_uint4_list){tetrahedra, (uint32_t)mesh->tetrahedra.count};
  body->levels = (sbf_level_list){level, 1};
  return SBF_OK;
}

static void report_repairs(sbfi_conversion *c, const sbfi_tet_mesh *mesh) {
  if (mesh->inverted_count)
    sbfi_convert_warn(c, SBF_CODE_IMPORT_TETRAHEDRA_TURNED,
        "%u tetrahedra were inverted: their points were reordered", mesh->inverted_count);
  if (mesh->flat_count)
    sbfi_convert_warn(
        c, SBF_CODE_IMPORT_TETRAHEDRA_FLAT, "%u tetrahedra without volume were left out", mesh->flat_count);
  if (mesh->repeat_count)
    sbfi_convert_warn(c, SBF_CODE_IMPORT_IGNORED,
        "%u tetrahedra with the same four points as another were left out", mesh->repeat_count);
  if (mesh->passed_over)
    sbfi_convert_warn(
        c, SBF_CODE_IMPORT_IGNORED, "%u elements that are not tetrahedra were skipped", mesh->passed_over);
}

static sbf_status fill_body(sbfi_conversion *c, const sbfi_tet_mesh *mesh, const sbfi_array *triangles,
    const char *name, sbf_soft_body *body, const uint32_t **new_from_old) {
  order o = {0};
  if (!find_order(c, mesh, triangles, &o)) return sbfi_convert_no_memory(c);
  sbf_vec3 *points = sbfi_convert_allocate(c, o.count, sizeof *points);
  uint32_t *sources = sbfi_convert_allocate(c, o.surface_count, sizeof *sources);
  if (!points || !sources) return sbfi_convert_no_memory(c);
  const sbf_vec3 *from = mesh->points.at;
  for (uint32_t i = 0; i < o.count; i++)
    points[i] = sbfi_transform_point(&c->to_asset, from[o.old_from_new[i]]);
  memcpy(sources, o.old_from_new, o.surface_count * sizeof *sources);
  sbf_soft_body_init(body);
  body->id = sbfi_new_id(c, "body", name);
  body->name = sbf_asset_copy_text(c->asset, name);
  if (!body->id || !body->name) return sbfi_convert_no_memory(c);
  sbf_status status = fill_surface(c, triangles, &o, points, &body->surface);
  if (status == SBF_OK) status = fill_level(c, mesh, &o, points, body);
  body->interior =
      (sbf_vec3_list){o.count > o.surface_count ? points + o.surface_count : NULL, o.count - o.surface_count};
  body->source_points = (sbf_u32_list){sources, o.surface_count};
  if (new_from_old) *new_from_old = o.new_from_old;
  report_repairs(c, mesh);
  return status;
}

sbf_status sbfi_convert_tet_body(sbfi_conversion *c, const sbfi_tet_mesh *mesh, const char *name,
    sbf_soft_body *body, const uint32_t **new_from_old) {
  sbfi_array triangles;
  sbfi_array_init(&triangles, &mesh->allocator, sizeof(uint32_t));
  sbf_status status = sbfi_tet_mesh_boundary(mesh, &triangles)
                          ? fill_body(c, mesh, &triangles, name, body, new_from_old)
                          : sbfi_convert_no_memory(c);
  sbfi_array_free(&triangles);
  return status;
}

sbf_status sbfi_convert_tets(sbfi_conversion *c, const sbfi_tet_mesh *mesh, const char *name) {
  sbf_soft_body *body = sbfi_convert_allocate(c, 1, sizeof *body);
  sbf_render_mesh *render = sbfi_convert_allocate(c, 1, sizeof *render);
  if (!body || !render) return sbfi_convert_no_memory(c);
  sbf_status status = sbfi_convert_tet_body(c, mesh, name, body, NULL);
  if (status != SBF_OK) return status;
  sbf_render_mesh_init(render);
  render->id = sbfi_new_id(c, "mesh", name);
  if (!render->id) return sbfi_convert_no_memory(c);
  render->name = body->name;
  render->mesh = body->surface;
  render->mesh.target = SBF_MESH_TARGET_RENDERING;
  render->source_points = body->source_points;
  c->asset->soft_bodies = (sbf_soft_body_list){body, 1};
  c->asset->render_meshes = (sbf_render_mesh_list){render, 1};
  return SBF_OK;
}
