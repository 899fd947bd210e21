/* Materials and textures of an asset as Godot's, made once for all nodes with it. */
#include "soft_material.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
  TEXTURE_ALBEDO = 0, /* of BaseMaterial3D */
  TEXTURE_METALLIC = 1,
  TEXTURE_ROUGHNESS = 2,
  TEXTURE_NORMAL = 4,
  FEATURE_EMISSION = 0,
  FEATURE_NORMAL_MAPPING = 1,
  FLAG_ALBEDO_FROM_VERTEX_COLOR = 1,
  CHANNEL_GREEN = 1,
  CHANNEL_BLUE = 2
};

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
  gd_variant loader = gd_singleton("ResourceLoader"), from = GD_CALL(&one->resources.asset, "get_path");
  gd_as_text(&from, bundle, sizeof bundle);
  const char *end = strrchr(bundle, '/');
  snprintf(path, sizeof path, "%.*s%s", end ? (int)(end + 1 - bundle) : 0, bundle, texture->path);
  gd_variant found = gd_nil();
  if (gd_take_bool(GD_CALL(&loader, "exists", gd_string(path), gd_string("Texture2D"))))
    found = GD_CALL(&loader, "load", gd_string(path), gd_string("Texture2D"));
  else {
    snprintf(message, sizeof message,
        "the texture %s does not exist: put it there, or export the character with embedded textures", path);
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

/* Meshes without colours are white. */
static bool has_colors(const sbf_asset *asset) {
  bool any = false;
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    any = any || asset->render_meshes.at[i].colors.count;
  return any;
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
  if (m->normal_texture >= 0) {
    GD_DO(&made, "set_feature", gd_int(FEATURE_NORMAL_MAPPING), gd_bool(true));
    set_texture(&made, TEXTURE_NORMAL, texture_of(one, m->normal_texture));
  }
  if (has_colors(one->model->asset))
    GD_DO(&made, "set_flag", gd_int(FLAG_ALBEDO_FROM_VERTEX_COLOR), gd_bool(true));
  if (m->emissive.x > 0 || m->emissive.y > 0 || m->emissive.z > 0) {
    GD_DO(&made, "set_feature", gd_int(FEATURE_EMISSION), gd_bool(true));
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
gd_variant soft_material_of(const soft_character *one, const sbf_render_mesh *mesh, uint32_t slot) {
  int32_t index = slot < mesh->material_slots.count ? mesh->material_slots.at[slot].material : SBF_NONE;
  gd_variant *kept = soft_model_material(one->model, index);
  if (!kept) return gd_new("StandardMaterial3D");
  if (gd_type(kept) == GDEXTENSION_VARIANT_TYPE_NIL)
    *kept = make_material(one, &one->model->asset->materials.at[index]);
  return gd_copy(kept);
}

const sbf_uv_transform *soft_material_uv(const sbf_material *m) {
  if (!m) return NULL;
  if (m->base_color_texture >= 0) return m->base_color_uv;
  if (m->normal_texture >= 0) return m->normal_uv;
  return m->metallic_roughness_uv;
}
