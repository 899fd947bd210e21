/* Writes Wavefront OBJ with its MTL: render meshes at rest, or the bodies' surfaces if there are none. */
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "export/exporting.h"
#include "model/level_mesh.h"

/* OBJ numbers count over the whole file, from 1. */
typedef struct obj_counts {
  uint32_t points, coordinates, normals;
} obj_counts;

/* Writes a name on its own line: without control characters, and without blanks if `word`. */
static void write_name(sbfi_export *e, const char *name, bool word) {
  if (!*name) name = "unnamed";
  for (; *name; name++) {
    bool bad = (unsigned char)*name < ' ' || (word && *name == ' ') || *name == 127;
    sbfi_text_char(&e->text, bad ? '_' : *name);
  }
}

static const char *name_of(const char *name, const char *id) {
  return *name ? name : id;
}

static void write_points(sbfi_export *e, sbf_vec3_list points) {
  for (uint32_t i = 0; i < points.count; i++) {
    sbfi_text_char(&e->text, 'v');
    sbfi_export_vec3(e, points.at[i]);
    sbfi_text_char(&e->text, '\n');
  }
}

/* Materials are named by their unique id. */
static const sbf_material *material_of(
    const sbf_asset *asset, const sbf_render_mesh *mesh, uint32_t polygon) {
  uint32_t slot = mesh->polygon_materials.count ? mesh->polygon_materials.at[polygon] : 0;
  if (slot >= mesh->material_slots.count || mesh->material_slots.at[slot].material < 0) return NULL;
  return &asset->materials.at[mesh->material_slots.at[slot].material];
}

static void write_corner(
    sbfi_export *e, const sbf_render_mesh *mesh, const obj_counts *before, uint32_t corner) {
  uint32_t point = mesh->mesh.polygon_points.at[corner];
  sbfi_export_format(e, " %u", before->points + point + 1);
  const sbf_uv_set *uv =
      mesh->uv_sets.count && mesh->uv_sets.at[0].coordinates.count ? mesh->uv_sets.at : NULL;
  if (!uv && !mesh->normals.count) return;
  sbfi_text_char(&e->text, '/');
  if (uv)
    sbfi_export_format(
        e, "%u", before->coordinates + (uv->corners.count ? uv->corners.at[corner] : point) + 1);
  if (mesh->normals.count)
    sbfi_export_format(e, "/%u",
        before->normals + (mesh->normal_corners.count ? mesh->normal_corners.at[corner] : point) + 1);
}

static void write_mesh(sbfi_export *e, const sbf_render_mesh *mesh, obj_counts *before) {
  sbfi_text_string(&e->text, "o ");
  write_name(e, name_of(mesh->name, mesh->id), false);
  sbfi_text_char(&e->text, '\n');
  write_points(e, mesh->mesh.positions);
  sbf_vec2_list coordinates =
      mesh->uv_sets.count ? mesh->uv_sets.at[0].coordinates : (sbf_vec2_list){NULL, 0};
  for (uint32_t i = 0; i < coordinates.count; i++) {
    sbfi_text_string(&e->text, "vt ");
    sbfi_text_f32(&e->text, coordinates.at[i].x);
    sbfi_text_char(&e->text, ' ');
    sbfi_text_f32(&e->text, coordinates.at[i].y);
    sbfi_text_char(&e->text, '\n');
  }
  for (uint32_t i = 0; i < mesh->normals.count; i++) {
    sbfi_text_string(&e->text, "vn");
    sbfi_export_vec3(e, mesh->normals.at[i]);
    sbfi_text_char(&e->text, '\n');
  }
  const sbf_material *last = NULL;
  for (uint32_t i = 0, corner = 0; i < mesh->mesh.polygon_sizes.count; i++) {
    const sbf_material *material = material_of(e->asset, mesh, i);
    if (material && material != last) {
      sbfi_text_string(&e->text, "usemtl ");
      write_name(e, material->id, true);
      sbfi_text_char(&e->text, '\n');
      last = material;
    }
    sbfi_text_char(&e->text, 'f');
    for (uint32_t k = 0; k < mesh->mesh.polygon_sizes.at[i]; k++) write_corner(e, mesh, before, corner++);
    sbfi_text_char(&e->text, '\n');
  }
  before->points += mesh->mesh.positions.count;
  before->coordinates += coordinates.count;
  before->normals += mesh->normals.count;
}

/* Writes the requested level, or the last if there are fewer; 0: the mesh itself. */
static sbf_status write_render_mesh(sbfi_export *e, const sbf_render_mesh *mesh, obj_counts *before) {
  uint32_t number = e->render_level < mesh->levels.count ? e->render_level : mesh->levels.count;
  if (number == 0) {
    write_mesh(e, mesh, before);
    return SBF_OK;
  }
  sbfi_arena arena;
  sbfi_level_mesh level;
  sbfi_arena_init(&arena, &e->allocator, 0);
  bool good = sbfi_level_mesh_make(&level, mesh, &mesh->levels.at[number - 1], &arena);
  if (good) write_mesh(e, &level.mesh, before);
  sbfi_arena_free(&arena);
  return good ? SBF_OK : sbfi_export_no_memory(e);
}

/* Writes a surface through the same code as a mesh. */
static void write_surface(sbfi_export *e, const sbf_soft_body *body, obj_counts *before) {
  sbf_render_mesh mesh;
  sbf_render_mesh_init(&mesh);
  mesh.id = body->id;
  mesh.name = body->name;
  mesh.mesh = body->surface;
  write_mesh(e, &mesh, before);
}

static void write_number(sbfi_export *e, const char *key, float value) {
  sbfi_text_string(&e->text, key);
  sbfi_text_char(&e->text, ' ');
  sbfi_text_f32(&e->text, value);
  sbfi_text_char(&e->text, '\n');
}

static void write_material(sbfi_export *e, const sbf_material *m) {
  sbfi_text_string(&e->text, "newmtl ");
  write_name(e, m->id, true);
  sbfi_text_string(&e->text, "\nKd");
  sbfi_export_vec3(e, (sbf_vec3){m->base_color.x, m->base_color.y, m->base_color.z});
  sbfi_text_string(&e->text, "\nKe");
  sbfi_export_vec3(e, m->emissive);
  sbfi_text_char(&e->text, '\n');
  write_number(e, "d", m->base_color.w);
  write_number(e, "Pr", m->roughness);
  write_number(e, "Pm", m->metallic);
  const sbf_texture *texture =
      m->base_color_texture >= 0 ? &e->asset->textures.at[m->base_color_texture] : NULL;
  if (!texture || texture->bytes.count || !*texture->path) return;
  sbfi_text_string(&e->text, "map_Kd ");
  write_name(e, texture->path, false);
  sbfi_text_char(&e->text, '\n');
}

static void report_unsupported(sbfi_export *e, bool surfaces) {
  const sbf_asset *a = e->asset;
  uint32_t embedded = 0, uv_sets = 0, keys = 0, skins = 0;
  for (uint32_t i = 0; i < a->textures.count; i++) embedded += a->textures.at[i].bytes.count > 0;
  for (uint32_t i = 0; i < a->render_meshes.count; i++) {
    const sbf_render_mesh *mesh = &a->render_meshes.at[i];
    uv_sets += mesh->uv_sets.count > 1 ? mesh->uv_sets.count - 1 : 0;
    keys += mesh->shape_keys.count;
    skins += mesh->skin != NULL;
  }
  const sbfi_left_out things[] = {{a->bones.count, "bones"}, {skins, "skins"}, {keys, "shape keys"},
      {uv_sets, "further uv sets"}, {embedded, "embedded images"}, {a->rigid_bodies.count, "rigid bodies"},
      {a->joints.count, "joints"}, {surfaces ? 0 : a->soft_bodies.count, "soft bodies"},
      {a->gaits.count, "gaits"}, {a->clips.count, "clips"}};
  sbfi_export_left_out(e, "OBJ", things, sizeof things / sizeof *things);
}

/* Path of the library: the file's with another extension. */
static bool library_path(const char *path, char *to, size_t size) {
  size_t stem = strlen(path) - 4;
  int length = snprintf(to, size, "%.*s.mtl", (int)stem, path);
  return length > 0 && (size_t)length < size;
}

static sbf_status write_library(sbfi_export *e, const char *path) {
  sbfi_text_string(&e->text, "# materials of sbfmt\n");
  for (uint32_t i = 0; i < e->asset->materials.count; i++) write_material(e, &e->asset->materials.at[i]);
  return sbfi_export_commit(e, path);
}

static sbf_status write_meshes(sbfi_export *e, const char *library, bool surfaces) {
  const sbf_asset *asset = e->asset;
  obj_counts before = {0, 0, 0};
  sbfi_text_string(&e->text, "# meshes of sbfmt: metres, +Y up\n");
  if (asset->materials.count) {
    sbfi_text_string(&e->text, "mtllib ");
    write_name(e, sbfi_path_name(library), false);
    sbfi_text_char(&e->text, '\n');
  }
  for (uint32_t i = 0; i < asset->render_meshes.count; i++) {
    sbf_status status = write_render_mesh(e, &asset->render_meshes.at[i], &before);
    if (status != SBF_OK) return status;
  }
  for (uint32_t i = 0; surfaces && i < asset->soft_bodies.count; i++)
    write_surface(e, &asset->soft_bodies.at[i], &before);
  report_unsupported(e, surfaces);
  return sbfi_export_commit(e, e->path);
}

static bool exists(const char *path) {
  sbfi_file file;
  if (sbfi_file_open(path, &file, NULL) != SBF_OK) return false;
  sbfi_file_close(&file);
  return true;
}

sbf_status sbfi_export_obj(sbfi_export *e) {
  const sbf_asset *asset = e->asset;
  char library[4096];
  bool surfaces = asset->render_meshes.count == 0;
  if (surfaces && !asset->soft_bodies.count)
    return sbfi_diagnose(e->error, SBF_CODE_EXPORT_EMPTY,
        "the file has neither a render mesh nor a soft body: there is nothing to write to %s", e->path);
  if (!library_path(e->path, library, sizeof library))
    return sbfi_diagnose(e->error, SBF_CODE_IO_CANNOT_WRITE, "the path is too long: %.80s...", e->path);
  bool is_new = asset->materials.count && !exists(library);
  sbf_status status = asset->materials.count ? write_library(e, library) : SBF_OK;
  if (status != SBF_OK) return status;
  status = write_meshes(e, library, surfaces);
  if (status != SBF_OK && is_new) remove(library); /* of no use alone */
  return status;
}
