/* Materials and their images. */
#include <string.h>

#include "base/text.h"
#include "import/convert/conversion.h"
#include "import/quote.h"

static const char *media_type_of(const char *extension) {
  if (strcmp(extension, "png") == 0) return "image/png";
  if (strcmp(extension, "jpg") == 0 || strcmp(extension, "jpeg") == 0) return "image/jpeg";
  if (strcmp(extension, "webp") == 0) return "image/webp";
  return "";
}

/* File name of a path outside the file's folder, such as one on the author's disk: the image is then
 * searched beside the bundle. */
static const char *path_within(sbfi_conversion *c, const char *path) {
  if (!path) return "";
  if (!sbfi_path_leaves_folder(path)) return path;
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
  if (sbfi_path_leaves_folder(name)) name = "";
  sbfi_convert_warn(c, SBF_CODE_IMPORT_IMAGE,
      "the image path \"%s\" leaves the file's folder: \"%s\" is used instead; put the image beside the "
      "bundle",
      sbfi_quote_of(sbfi_span_of(path)).text, sbfi_quote_of(sbfi_span_of(name)).text);
  return name;
}

static sbf_status convert_images(sbfi_conversion *c) {
  uint32_t count = c->scene->image_count;
  if (count == 0) return SBF_OK;
  sbf_texture *textures = sbfi_convert_allocate(c, count, sizeof *textures);
  if (!textures) return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < count; i++) {
    const sbfi_scene_image *image = &c->scene->images[i];
    sbf_texture *texture = &textures[i];
    sbf_texture_init(texture);
    texture->id = sbfi_new_id(c, "texture", image->name);
    texture->name = sbf_asset_copy_text(c->asset, image->name);
    texture->path = sbf_asset_copy_text(c->asset, path_within(c, image->path));
    if (!texture->id || !texture->name || !texture->path) return sbfi_convert_no_memory(c);
    if (!image->bytes) continue;
    uint8_t *bytes = sbfi_convert_allocate(c, image->byte_count, 1);
    if (!bytes) return sbfi_convert_no_memory(c);
    memcpy(bytes, image->bytes, image->byte_count);
    texture->bytes = (sbf_u8_list){bytes, image->byte_count};
    texture->media_type = media_type_of(image->extension);
  }
  c->asset->textures = (sbf_texture_list){textures, count};
  return SBF_OK;
}

/* Sets `*to` to NULL for an identity transform. False if memory runs out. */
static bool convert_uv(sbfi_conversion *c, const sbfi_scene_uv_transform *from, const sbf_uv_transform **to) {
  *to = NULL;
  if (from->offset[0] == 0 && from->offset[1] == 0 && from->rotation == 0 && from->scale[0] == 1 &&
      from->scale[1] == 1)
    return true;
  sbf_uv_transform *made = sbfi_convert_allocate(c, 1, sizeof *made);
  if (!made) return false;
  sbf_uv_transform_init(made);
  made->offset = (sbf_vec2){from->offset[0], from->offset[1]};
  made->rotation = from->rotation;
  made->scale = (sbf_vec2){from->scale[0], from->scale[1]};
  *to = made;
  return true;
}

sbf_status sbfi_convert_materials(sbfi_conversion *c) {
  sbf_status status = convert_images(c);
  uint32_t count = c->scene->material_count;
  if (status != SBF_OK || count == 0) return status;
  sbf_material *materials = sbfi_convert_allocate(c, count, sizeof *materials);
  if (!materials) return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < count; i++) {
    const sbfi_scene_material *from = &c->scene->materials[i];
    sbf_material *to = &materials[i];
    sbf_material_init(to);
    to->id = sbfi_new_id(c, "material", from->name);
    to->name = sbf_asset_copy_text(c->asset, from->name);
    if (!to->id || !to->name) return sbfi_convert_no_memory(c);
    to->base_color =
        (sbf_vec4){from->base_color[0], from->base_color[1], from->base_color[2], from->base_color[3]};
    to->emissive = (sbf_vec3){from->emissive[0], from->emissive[1], from->emissive[2]};
    to->metallic = from->metallic;
    to->roughness = from->roughness;
    to->alpha_mode = (sbf_alpha_mode)from->alpha_mode; /* both enums have the same values */
    if (from->alpha_mode == SBFI_ALPHA_MASK) to->alpha_cutoff = from->alpha_cutoff;
    to->double_sided = from->double_sided;
    to->base_color_texture = from->base_color_image;
    to->metallic_roughness_texture = from->metallic_roughness_image;
    to->normal_texture = from->normal_image;
    if ((to->base_color_texture >= 0 && !convert_uv(c, &from->base_color_uv, &to->base_color_uv)) ||
        (to->metallic_roughness_texture >= 0 &&
            !convert_uv(c, &from->metallic_roughness_uv, &to->metallic_roughness_uv)) ||
        (to->normal_texture >= 0 && !convert_uv(c, &from->normal_uv, &to->normal_uv)))
      return sbfi_convert_no_memory(c);
  }
  c->asset->materials = (sbf_material_list){materials, count};
  return SBF_OK;
}
