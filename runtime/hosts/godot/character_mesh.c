/* Render meshes of a character, one ArrayMesh each. Their vertices are updated every frame.
 *
 * Godot has one normal and one texture coordinate per vertex: a point of the file becomes one vertex per
 * distinct corner. A surface has the triangles of one material. */
#include "soft_character.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "surface_vertices.h"

enum {
  PRIMITIVE_TRIANGLES = 3,
  FORMAT_DYNAMIC = 1 << 26,
  ARRAY_VERTEX = 0,
  ARRAY_NORMAL = 1,
  ARRAY_TEX_UV = 4,
  ARRAY_INDEX = 12,
  ARRAY_MAX = 13,
  TEXTURE_ALBEDO = 0, /* of BaseMaterial3D */
  TEXTURE_METALLIC = 1,
  TEXTURE_ROUGHNESS = 2,
  CHANNEL_GREEN = 1,
  CHANNEL_BLUE = 2,
  INTERPOLATION_OFF = 2 /* its vertices move, not the node */
};

typedef struct shown_surface {
  surface_vertices vertices;
  gd_variant bytes;                 /* PackedByteArray of positions, then normals, in the renderer's format */
  uint32_t normals_at, normal_step; /* offset of normals, and their stride */
} shown_surface;

typedef struct shown_mesh {
  uint32_t render_mesh;
  bool corners; /* it has normals per corner, not per point */
  gd_variant mesh, instance;
  shown_surface *surfaces;
  uint32_t surface_count;
} shown_mesh;

struct character_mesh {
  shown_mesh *meshes;
  uint32_t count;
  sbf_vec3 *positions, *normals; /* capacity for the largest mesh */
};

/* ---- Material ---- */

static gd_variant decoded_texture(const sbf_texture *texture) {
  gd_variant image = gd_new("Image"), classes = gd_singleton("ClassDB");
  gd_variant bytes = gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY, texture->bytes.count);
  memcpy(gd_bytes(&bytes), texture->bytes.at, texture->bytes.count);
  const char *type = texture->media_type, *load = strstr(type, "jpeg")   ? "load_jpg_from_buffer"
                                                  : strstr(type, "webp") ? "load_webp_from_buffer"
                                                                         : "load_png_from_buffer";
  int64_t failed = gd_take_int(GD_CALL(&image, load, bytes));
  gd_variant made = gd_nil();
  if (!failed) {
    GD_DO(&image, "generate_mipmaps");
    made = GD_CALL(&classes, "class_call_static", gd_name("ImageTexture"), gd_name("create_from_image"),
        gd_copy(&image));
  }
  gd_free(&image);
  gd_free(&classes);
  return made;
}

/* A resource of the project next to the bundle. */
static gd_variant texture_beside(const soft_character *one, const sbf_texture *texture) {
  char bundle[512], path[1024], message[1280];
  gd_variant loader = gd_singleton("ResourceLoader"), from = GD_CALL(&one->asset_value, "get_path");
  gd_as_text(&from, bundle, sizeof bundle);
  const char *end = strrchr(bundle, '/');
  snprintf(path, sizeof path, "%.*s%s", end ? (int)(end + 1 - bundle) : 0, bundle, texture->path);
  gd_variant found = gd_nil();
  if (gd_take_bool(GD_CALL(&loader, "exists", gd_string(path), gd_string("Texture2D"))))
    found = GD_CALL(&loader, "load", gd_string(path), gd_string("Texture2D"));
  else {
    snprintf(message, sizeof message,
        "the texture %s is not there: put it there, or export the character with its textures in it", path);
    soft_character_warning(one, message);
  }
  gd_free(&from);
  gd_free(&loader);
  return found;
}

/* Created once for all nodes with the asset; false is stored after a failure. Nil: no texture. */
static gd_variant texture_of(const soft_character *one, int32_t index) {
  gd_variant *kept = soft_model_texture(one->model, index);
  if (!kept) return gd_nil();
  const sbf_texture *texture = &one->model->asset->textures.at[index];
  if (gd_type(kept) == GDEXTENSION_VARIANT_TYPE_NIL) {
    gd_variant made = texture->bytes.count ? decoded_texture(texture)
                      : texture->path[0]   ? texture_beside(one, texture)
                                           : gd_nil();
    *kept = gd_as_object(&made) ? made : gd_bool(false);
  }
  return gd_copy(kept);
}

static void set_texture(const gd_variant *material, int64_t parameter, gd_variant texture) {
  if (gd_as_object(&texture)) GD_DO(material, "set_texture", gd_int(parameter), gd_copy(&texture));
  gd_free(&texture);
}

/* The file's colours are linear, Godot's albedo is not. */
static float from_linear(float value) {
  return value <= 0.0031308f ? 12.92f * value : 1.055f * powf(value, 1 / 2.4f) - 0.055f;
}

static gd_variant make_material(const soft_character *one, const sbf_material *m) {
  gd_variant made = gd_new("StandardMaterial3D");
  GD_DO(&made, "set_albedo",
      gd_color_value((gd_color){from_linear(m->base_color.x), from_linear(m->base_color.y),
          from_linear(m->base_color.z), m->base_color.w}));
  GD_DO(&made, "set_metallic", gd_float(m->metallic));
  GD_DO(&made, "set_roughness", gd_float(m->roughness));
  set_texture(&made, TEXTURE_ALBEDO, texture_of(one, m->base_color_texture));
  if (m->metallic_roughness_texture >= 0) { /* metallic in blue, roughness in green, as in glTF */
    set_texture(&made, TEXTURE_METALLIC, texture_of(one, m->metallic_roughness_texture));
    set_texture(&made, TEXTURE_ROUGHNESS, texture_of(one, m->metallic_roughness_texture));
    GD_DO(&made, "set_metallic_texture_channel", gd_int(CHANNEL_BLUE));
    GD_DO(&made, "set_roughness_texture_channel", gd_int(CHANNEL_GREEN));
  }
  if (m->emissive.x > 0 || m->emissive.y > 0 || m->emissive.z > 0) {
    GD_DO(&made, "set_feature", gd_int(0), gd_bool(true));
    GD_DO(&made, "set_emission",
        gd_color_value((gd_color){
            from_linear(m->emissive.x), from_linear(m->emissive.y), from_linear(m->emissive.z), 1}));
  }
  if (m->alpha_mode == SBF_ALPHA_MODE_BLEND) GD_DO(&made, "set_transparency", gd_int(1));
  if (m->alpha_mode == SBF_ALPHA_MODE_MASK) {
    GD_DO(&made, "set_transparency", gd_int(2));
    GD_DO(&made, "set_alpha_scissor_threshold", gd_float(m->alpha_cutoff));
  }
  if (m->double_sided) GD_DO(&made, "set_cull_mode", gd_int(2));
  return made;
}

/* Shared by all nodes with the asset, as resources are. */
static gd_variant material_of(const soft_character *one, const sbf_render_mesh *mesh, uint32_t slot) {
  int32_t index = slot < mesh->material_slots.count ? mesh->material_slots.at[slot].material : SBF_NONE;
  gd_variant *kept = soft_model_material(one->model, index);
  if (!kept) return gd_new("StandardMaterial3D");
  if (gd_type(kept) == GDEXTENSION_VARIANT_TYPE_NIL)
    *kept = make_material(one, &one->model->asset->materials.at[index]);
  return gd_copy(kept);
}

/* ---- Making ---- */

static bool add_surface(
    shown_mesh *shown, const soft_character *one, const sbf_render_mesh *mesh, uint32_t slot) {
  shown_surface *surface = &shown->surfaces[shown->surface_count];
  surface_vertices *v = &surface->vertices;
  if (!surface_vertices_make(v, mesh, slot, shown->corners)) return false;
  if (!v->index_count) return surface_vertices_free(v), true;
  gd_variant arrays = gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY);
  gd_variant points = gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY, v->count);
  gd_variant normals = gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY, v->count);
  gd_variant indices = gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_INT32_ARRAY, v->index_count);
  gd_variant server = gd_singleton("RenderingServer");
  sbf_vec3 *p = gd_vector3s(&points), *n = gd_vector3s(&normals);
  GD_DO(&arrays, "resize", gd_int(ARRAY_MAX));
  for (uint32_t i = 0; i < v->count; i++)
    p[i] = mesh->mesh.positions.at[v->points[i]], n[i] = (sbf_vec3){0, 1, 0};
  memcpy(gd_int32s(&indices), v->indices, v->index_count * sizeof *v->indices);
  gd_put(&arrays, ARRAY_VERTEX, points);
  gd_put(&arrays, ARRAY_NORMAL, normals);
  gd_put(&arrays, ARRAY_INDEX, indices);
  if (v->uvs) {
    gd_variant uvs = gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR2_ARRAY, v->count);
    memcpy(gd_vector2s(&uvs), v->uvs, v->count * sizeof *v->uvs);
    gd_put(&arrays, ARRAY_TEX_UV, uvs);
  }
  GD_DO(&shown->mesh, "add_surface_from_arrays", gd_int(PRIMITIVE_TRIANGLES), arrays,
      gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY), gd_empty(GDEXTENSION_VARIANT_TYPE_DICTIONARY),
      gd_int(FORMAT_DYNAMIC));
  GD_DO(&shown->mesh, "surface_set_material", gd_int(shown->surface_count), material_of(one, mesh, slot));
  int64_t format = gd_take_int(GD_CALL(&shown->mesh, "surface_get_format", gd_int(shown->surface_count)));
  surface->normals_at = (uint32_t)gd_take_int(GD_CALL(
      &server, "mesh_surface_get_format_offset", gd_int(format), gd_int(v->count), gd_int(ARRAY_NORMAL)));
  surface->normal_step = (uint32_t)gd_take_int(
      GD_CALL(&server, "mesh_surface_get_format_normal_tangent_stride", gd_int(format), gd_int(v->count)));
  surface->bytes = gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY,
      (int64_t)surface->normals_at + (int64_t)surface->normal_step * v->count);
  gd_free(&server);
  shown->surface_count++;
  return true;
}

static bool show(shown_mesh *shown, soft_character *one, uint32_t index) {
  const sbf_asset *asset = one->model->asset;
  const sbf_render_mesh *mesh = &asset->render_meshes.at[index];
  uint32_t slots = mesh->material_slots.count ? mesh->material_slots.count : 1;
  shown->render_mesh = index;
  shown->corners = mesh->normal_corners.count > 0;
  shown->surfaces = calloc(slots, sizeof *shown->surfaces);
  shown->mesh = gd_new("ArrayMesh");
  shown->instance = gd_new("MeshInstance3D");
  for (uint32_t slot = 0; shown->surfaces && slot < slots; slot++)
    if (!add_surface(shown, one, mesh, slot)) return false;
  GD_DO(&shown->instance, "set_mesh", gd_copy(&shown->mesh));
  GD_DO(&shown->instance, "set_name", gd_string(mesh->name[0] ? mesh->name : mesh->id));
  GD_DO(&shown->instance, "set_as_top_level", gd_bool(true));
  GD_DO(&shown->instance, "set_physics_interpolation_mode", gd_int(INTERPOLATION_OFF));
  GD_DO(&one->node, "add_child", gd_copy(&shown->instance), gd_bool(false),
      gd_int(1)); /* INTERNAL_MODE_FRONT */
  return shown->surfaces != NULL;
}

character_mesh *character_mesh_make(soft_character *one) {
  const sbf_asset *asset = one->model->asset;
  character_mesh *made = calloc(1, sizeof *made);
  uint32_t points = 0, corners = 0;
  if (!made || !asset->render_meshes.count) return made;
  made->meshes = calloc(asset->render_meshes.count, sizeof *made->meshes);
  for (uint32_t i = 0; i < asset->render_meshes.count; i++) {
    const sbf_polygon_mesh *mesh = &asset->render_meshes.at[i].mesh;
    points = points > mesh->positions.count ? points : mesh->positions.count;
    corners = corners > mesh->polygon_points.count ? corners : mesh->polygon_points.count;
  }
  made->positions = malloc((points + 1) * sizeof *made->positions);
  made->normals = malloc((size_t)(points + corners + 1) * sizeof *made->normals);
  bool good = made->meshes && made->positions && made->normals;
  for (uint32_t i = 0; good && i < asset->render_meshes.count; i++)
    good = show(&made->meshes[made->count++], one, i);
  if (good) {
    character_mesh_dress(made, one);
    return made;
  }
  gd_error("no memory for a character's mesh");
  character_mesh_free(made);
  return NULL;
}

void character_mesh_free(character_mesh *mesh) {
  if (!mesh) return;
  for (uint32_t i = 0; i < mesh->count; i++) {
    shown_mesh *shown = &mesh->meshes[i];
    for (uint32_t k = 0; k < shown->surface_count; k++) {
      surface_vertices_free(&shown->surfaces[k].vertices);
      gd_free(&shown->surfaces[k].bytes);
    }
    free(shown->surfaces);
    GD_DO(&shown->instance, "queue_free");
    gd_free(&shown->instance);
    gd_free(&shown->mesh);
  }
  free(mesh->meshes);
  free(mesh->positions);
  free(mesh->normals);
  free(mesh);
}

void character_mesh_dress(character_mesh *mesh, const soft_character *one) {
  for (uint32_t i = 0; mesh && i < mesh->count; i++) {
    const gd_variant *instance = &mesh->meshes[i].instance;
    GD_DO(instance, "set_material_override", gd_copy(&one->material));
    GD_DO(instance, "set_cast_shadows_setting", gd_int(one->settings.cast_shadow));
    GD_DO(instance, "set_layer_mask", gd_int(one->settings.layers));
  }
}

gd_variant character_mesh_instance(const character_mesh *mesh, int64_t render_mesh) {
  for (uint32_t i = 0; mesh && i < mesh->count; i++)
    if (mesh->meshes[i].render_mesh == render_mesh) return gd_copy(&mesh->meshes[i].instance);
  return gd_nil();
}

/* ---- Each frame ---- */

/* Octahedral encoding of a unit vector in two numbers of 16 bits (Meyer et al. 2010), as Godot's renderer
 * reads normals. */
static uint32_t on_octahedron(sbf_vec3 n) {
  float sum = fabsf(n.x) + fabsf(n.y) + fabsf(n.z);
  float x = sum > 0 ? n.x / sum : 0, y = sum > 0 ? n.y / sum : 1;
  if (n.z < 0) {
    float folded = copysignf(1 - fabsf(y), x);
    y = copysignf(1 - fabsf(x), y);
    x = folded;
  }
  uint32_t u = (uint32_t)fmaxf(0, fminf(65535, (x * 0.5f + 0.5f) * 65535));
  uint32_t v = (uint32_t)fmaxf(0, fminf(65535, (y * 0.5f + 0.5f) * 65535));
  return u | v << 16;
}

static void write_surface(
    shown_surface *surface, const sbf_vec3 *positions, const sbf_vec3 *normals, bool corners) {
  const surface_vertices *v = &surface->vertices;
  uint8_t *bytes = gd_bytes(&surface->bytes);
  for (uint32_t i = 0; i < v->count; i++) {
    uint32_t normal = on_octahedron(normals[corners ? v->corners[i] : v->points[i]]);
    memcpy(bytes + 12 * (size_t)i, &positions[v->points[i]], 12);
    memcpy(bytes + surface->normals_at + (size_t)surface->normal_step * i, &normal, sizeof normal);
  }
}

void character_mesh_update(character_mesh *mesh, soft_character *one) {
  if (!mesh) return;
  sbr_double3 origin = sbr_character_get_origin(one->world, one->id);
  for (uint32_t i = 0; i < mesh->count; i++) {
    shown_mesh *shown = &mesh->meshes[i];
    const sbf_polygon_mesh *form = &one->model->asset->render_meshes.at[shown->render_mesh].mesh;
    uint32_t count = form->positions.count;
    sbr_character_get_skin(
        one->world, one->id, shown->render_mesh, mesh->positions, mesh->normals, NULL, count);
    if (shown->corners)
      sbr_character_get_corner_normals(
          one->world, one->id, shown->render_mesh, mesh->normals, form->polygon_points.count);
    sbf_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t k = 0; k < count; k++) {
      sbf_vec3 p = mesh->positions[k];
      low = (sbf_vec3){fminf(low.x, p.x), fminf(low.y, p.y), fminf(low.z, p.z)};
      high = (sbf_vec3){fmaxf(high.x, p.x), fmaxf(high.y, p.y), fmaxf(high.z, p.z)};
    }
    for (uint32_t k = 0; k < shown->surface_count; k++) {
      write_surface(&shown->surfaces[k], mesh->positions, mesh->normals, shown->corners);
      GD_DO(&shown->mesh, "surface_update_vertex_region", gd_int(k), gd_int(0),
          gd_copy(&shown->surfaces[k].bytes));
    }
    if (!count) continue;
    sbf_vec3 size = {high.x - low.x, high.y - low.y, high.z - low.z};
    GD_DO(&shown->mesh, "set_custom_aabb", gd_aabb_value((gd_aabb){low, size}));
    GD_DO(&shown->instance, "set_global_transform",
        gd_transform_value((gd_transform){
            {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {(float)origin.x, (float)origin.y, (float)origin.z}}));
  }
}
