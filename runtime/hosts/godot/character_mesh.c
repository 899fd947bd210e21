/* Render meshes of a character, one ArrayMesh each. Their vertices are updated every frame.
 *
 * Godot has one normal and one texture coordinate per vertex: a point of the file becomes one vertex per
 * distinct corner. A surface has the triangles of one material. */
#include "soft_character.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "soft_material.h"
#include "surface_vertices.h"
#include "turns.h"

enum {
  PRIMITIVE_TRIANGLES = 3,
  FORMAT_DYNAMIC = 1 << 26,
  ARRAY_VERTEX = 0,
  ARRAY_NORMAL = 1,
  ARRAY_TANGENT = 2,
  ARRAY_COLOR = 3,
  ARRAY_TEX_UV = 4,
  ARRAY_INDEX = 12,
  ARRAY_MAX = 13,
  INTERPOLATION_OFF = 2 /* its vertices move, not the node */
};

typedef struct shown_surface {
  surface_vertices vertices;
  gd_variant bytes;                 /* PackedByteArray of positions, then normals, in the renderer's format */
  uint32_t normals_at, normal_step; /* offset of normals, and their stride */
  bool has_tangents;                /* each after its normal, turned in its plane by: */
  float sine, cosine;
} shown_surface;

typedef struct shown_mesh {
  uint32_t render_mesh;
  bool corners, tangents; /* it has normals per corner, not per point; a surface has tangents */
  gd_variant mesh, instance;
  shown_surface *surfaces;
  uint32_t surface_count;
} shown_mesh;

struct character_mesh {
  shown_mesh *meshes;
  uint32_t count;
  sbf_vec3 *positions, *normals; /* capacity for the largest mesh */
  sbf_vec4 *tangents;
};

/* ---- Making ---- */

/* Any, until the first update. */
static gd_variant tangents_of(uint32_t count) {
  gd_variant tangents = gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT32_ARRAY, 4 * (int64_t)count);
  float *numbers = gd_floats(&tangents);
  for (uint32_t i = 0; i < count; i++) numbers[4 * i] = numbers[4 * i + 3] = 1;
  return tangents;
}

static bool add_surface(
    shown_mesh *shown, const soft_character *one, const sbf_render_mesh *mesh, uint32_t slot) {
  shown_surface *surface = &shown->surfaces[shown->surface_count];
  surface_vertices *v = &surface->vertices;
  int32_t index = slot < mesh->material_slots.count ? mesh->material_slots.at[slot].material : SBF_NONE;
  const sbf_material *material = index >= 0 ? &one->model->asset->materials.at[index] : NULL;
  if (!surface_vertices_make(v, mesh, slot, shown->corners, soft_material_uv(material))) return false;
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
  const sbf_uv_transform *turn = soft_material_uv(material);
  surface->sine = turn ? sinf(turn->rotation) : 0, surface->cosine = turn ? cosf(turn->rotation) : 1;
  surface->has_tangents = v->uvs && material && material->normal_texture >= 0;
  shown->tangents = shown->tangents || surface->has_tangents;
  if (surface->has_tangents) gd_put(&arrays, ARRAY_TANGENT, tangents_of(v->count));
  if (v->colors) {
    gd_variant colors = gd_packed(GDEXTENSION_VARIANT_TYPE_PACKED_COLOR_ARRAY, v->count);
    memcpy(gd_colors(&colors), v->colors, v->count * sizeof *v->colors);
    gd_put(&arrays, ARRAY_COLOR, colors);
  }
  GD_DO(&shown->mesh, "add_surface_from_arrays", gd_int(PRIMITIVE_TRIANGLES), arrays,
      gd_empty(GDEXTENSION_VARIANT_TYPE_ARRAY), gd_empty(GDEXTENSION_VARIANT_TYPE_DICTIONARY),
      gd_int(FORMAT_DYNAMIC));
  GD_DO(
      &shown->mesh, "surface_set_material", gd_int(shown->surface_count), soft_material_of(one, mesh, slot));
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
  made->tangents = malloc((points + 1) * sizeof *made->tangents);
  bool good = made->meshes && made->positions && made->normals && made->tangents;
  for (uint32_t i = 0; good && i < asset->render_meshes.count; i++)
    good = show(&made->meshes[made->count++], one, i);
  if (good) {
    character_mesh_apply_settings(made, one);
    if (gd_size(&one->resources.surface_materials)) character_mesh_apply_materials(made, one);
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
  free(mesh->tangents);
  free(mesh);
}

/* A key is the mesh's name, a slash and the surface's number. Returns false where there is no such surface.
 */
static bool apply_surface_material(
    character_mesh *mesh, const soft_character *one, const gd_variant *key, gd_variant material) {
  char text[256];
  gd_as_text(key, text, sizeof text);
  char *slash = strrchr(text, '/'), *rest = NULL;
  long surface = slash ? strtol(slash + 1, &rest, 10) : -1;
  bool found = false;
  if (slash) *slash = 0;
  for (uint32_t i = 0; rest && rest != slash + 1 && !*rest && i < mesh->count && !found; i++) {
    const shown_mesh *shown = &mesh->meshes[i];
    const sbf_render_mesh *of = &one->model->asset->render_meshes.at[shown->render_mesh];
    found = (!strcmp(of->name, text) || !strcmp(of->id, text)) && surface >= 0 &&
            surface < (long)shown->surface_count;
    if (found) GD_DO(&shown->instance, "set_surface_override_material", gd_int(surface), gd_copy(&material));
  }
  gd_free(&material);
  return found;
}

void character_mesh_apply_materials(character_mesh *mesh, const soft_character *one) {
  if (!mesh) return;
  gd_variant keys = GD_CALL(&one->resources.surface_materials, "keys");
  for (uint32_t i = 0; i < mesh->count; i++)
    for (uint32_t k = 0; k < mesh->meshes[i].surface_count; k++)
      GD_DO(&mesh->meshes[i].instance, "set_surface_override_material", gd_int(k), gd_nil());
  for (int64_t i = 0, count = gd_size(&keys); i < count; i++) {
    gd_variant key = gd_at(&keys, i),
               material = GD_CALL(&one->resources.surface_materials, "get", gd_copy(&key));
    bool is_material =
        !gd_as_object(&material) || gd_take_bool(GD_CALL(&material, "is_class", gd_string("Material")));
    if (!is_material) gd_assign(&material, gd_nil());
    if (!apply_surface_material(mesh, one, &key, material) || !is_material) {
      char text[256], message[512];
      gd_as_text(&key, text, sizeof text);
      snprintf(message, sizeof message, "surface_materials: %s: %s", text,
          is_material
              ? "a key is a render mesh's name, a slash and the number of one of its surfaces, as Head/0"
              : "the value is not a Material");
      soft_character_error(one, message);
    }
    gd_free(&key);
  }
  gd_free(&keys);
}

void character_mesh_apply_settings(character_mesh *mesh, const soft_character *one) {
  for (uint32_t i = 0; mesh && i < mesh->count; i++) {
    const gd_variant *instance = &mesh->meshes[i].instance;
    GD_DO(instance, "set_material_override", gd_copy(&one->resources.material));
    GD_DO(instance, "set_cast_shadows_setting", gd_int(one->settings.display.cast_shadow));
    GD_DO(instance, "set_layer_mask", gd_int(one->settings.display.layers));
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
    float mapped = copysignf(1 - fabsf(y), x);
    y = copysignf(1 - fabsf(x), y);
    x = mapped;
  }
  uint32_t u = (uint32_t)fmaxf(0, fminf(65535, (x * 0.5f + 0.5f) * 65535));
  uint32_t v = (uint32_t)fmaxf(0, fminf(65535, (y * 0.5f + 0.5f) * 65535));
  return u | v << 16;
}

/* Tangents lie in the half of the square that their sign says. */
static uint32_t on_half_octahedron(sbf_vec4 tangent) {
  uint32_t packed = on_octahedron((sbf_vec3){tangent.x, tangent.y, tangent.z}), u = packed & 0xffff;
  float v = fmaxf((float)(packed >> 16) / 65535, 1.0f / 32767) * 0.5f + 0.5f;
  uint32_t mapped = (uint32_t)((tangent.w >= 0 ? v : 1 - v) * 65535);
  if (!u && mapped == 65535) u = 65535; /* the same direction; the other one marks compressed surfaces */
  return u | mapped << 16;
}

/* The tangent of turned texture coordinates. */
static sbf_vec4 turned_tangent(const shown_surface *surface, sbf_vec4 t, sbf_vec3 n) {
  sbf_vec3 b = turn_cross(n, (sbf_vec3){t.x, t.y, t.z});
  float c = surface->cosine, s = -surface->sine * t.w;
  return (sbf_vec4){c * t.x + s * b.x, c * t.y + s * b.y, c * t.z + s * b.z, t.w};
}

static void write_surface(shown_surface *surface, const character_mesh *mesh, bool corners) {
  const surface_vertices *v = &surface->vertices;
  const sbf_vec3 *positions = mesh->positions, *normals = mesh->normals;
  uint8_t *bytes = gd_bytes(&surface->bytes);
  for (uint32_t i = 0; i < v->count; i++) {
    uint32_t normal = on_octahedron(normals[corners ? v->corners[i] : v->points[i]]);
    memcpy(bytes + 12 * (size_t)i, &positions[v->points[i]], 12);
    memcpy(bytes + surface->normals_at + (size_t)surface->normal_step * i, &normal, sizeof normal);
    if (!surface->has_tangents) continue;
    sbf_vec3 n = normals[corners ? v->corners[i] : v->points[i]];
    uint32_t tangent = on_half_octahedron(turned_tangent(surface, mesh->tangents[v->points[i]], n));
    memcpy(bytes + surface->normals_at + (size_t)surface->normal_step * i + 4, &tangent, sizeof tangent);
  }
}

void character_mesh_update(character_mesh *mesh, soft_character *one) {
  if (!mesh) return;
  sbr_double3 origin = sbr_character_get_origin(one->world, one->id);
  for (uint32_t i = 0; i < mesh->count; i++) {
    shown_mesh *shown = &mesh->meshes[i];
    const sbf_polygon_mesh *form = &one->model->asset->render_meshes.at[shown->render_mesh].mesh;
    uint32_t count = form->positions.count;
    sbr_character_get_skin(one->world, one->id, shown->render_mesh, mesh->positions, mesh->normals,
        shown->tangents ? mesh->tangents : NULL, count);
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
      write_surface(&shown->surfaces[k], mesh, shown->corners);
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
