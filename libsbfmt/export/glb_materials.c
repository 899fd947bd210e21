/* Writes materials, which both formats define alike, and their images as original bytes. */
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "export/glb.h"

enum { LARGEST_IMAGE_BYTES = 1 << 28 };

/* From the first bytes; NULL: not a format of glTF. */
static const char *media_type(const uint8_t *bytes, size_t size) {
  if (size >= 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0) return "image/png";
  if (size >= 3 && memcmp(bytes, "\xff\xd8\xff", 3) == 0) return "image/jpeg";
  if (size >= 12 && memcmp(bytes, "RIFF", 4) == 0 && memcmp(bytes + 8, "WEBP", 4) == 0) return "image/webp";
  return NULL;
}

static bool write_image(sbfi_glb *g, const sbf_texture *texture, const uint8_t *bytes, size_t size) {
  const char *type = media_type(bytes, size);
  if (!type) return false;
  uint32_t view = sbfi_glb_view(g, bytes, size), image;
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_IMAGES, &image);
  sbfi_text_string(text, "{\"name\":");
  sbfi_glb_write_string(text, *texture->name ? texture->name : texture->id);
  sbfi_export_print(text, ",\"bufferView\":%u,\"mimeType\":\"%s\"}", view, type);
  bool is_webp = strcmp(type, "image/webp") == 0;
  g->texture_webp = g->texture_webp || is_webp;
  sbfi_export_print(sbfi_glb_item(g, SBFI_GLB_TEXTURES, NULL),
      is_webp ? "{\"extensions\":{\"EXT_texture_webp\":{\"source\":%u}}}" : "{\"source\":%u}", image);
  return true;
}

static bool read_image(sbfi_glb *g, const sbf_texture *texture) {
  char path[4096];
  if (!g->e->folder || !*texture->path) return false;
  int length = snprintf(path, sizeof path, "%s/%s", g->e->folder, texture->path);
  if (length < 0 || (size_t)length >= sizeof path) return false;
  sbfi_file_content file;
  sbf_diagnostic why;
  if (sbfi_file_read(path, LARGEST_IMAGE_BYTES, &g->e->allocator, &file, &why) != SBF_OK) {
    g->failed = g->failed || why.code == SBF_CODE_OUT_OF_MEMORY;
    return false;
  }
  bool good = write_image(g, texture, file.at, file.size);
  sbfi_file_content_free(&file);
  return good;
}

static void write_images(sbfi_glb *g) {
  const sbf_texture_list textures = g->e->asset->textures;
  int32_t *indices = sbfi_glb_allocate(g, textures.count, sizeof *indices);
  g->texture_indices = indices;
  for (uint32_t i = 0; i < textures.count && indices; i++) {
    const sbf_texture *texture = &textures.at[i];
    indices[i] = (int32_t)g->parts[SBFI_GLB_TEXTURES].count;
    sbf_u8_list given = texture->bytes;
    if (!given.count && g->e->images && i < g->e->images->count) given = g->e->images->at[i].bytes;
    bool written = given.count ? write_image(g, texture, given.at, given.count) : read_image(g, texture);
    if (written) continue;
    indices[i] = SBF_NONE;
    g->omitted_images++;
  }
}

static void write_texture(
    sbfi_glb *g, sbfi_text *text, const char *key, int32_t texture, const sbf_uv_transform *uv) {
  if (texture < 0 || !g->texture_indices || g->texture_indices[texture] < 0) return;
  sbfi_export_print(text, ",\"%s\":{\"index\":%d", key, (int)g->texture_indices[texture]);
  if (uv) {
    g->texture_transform = true;
    const float offset[2] = {uv->offset.x, uv->offset.y}, scale[2] = {uv->scale.x, uv->scale.y};
    sbfi_text_string(text, ",\"extensions\":{\"KHR_texture_transform\":{\"offset\":");
    sbfi_glb_write_numbers(text, offset, 2);
    sbfi_text_string(text, ",\"rotation\":");
    sbfi_text_f32(text, uv->rotation);
    sbfi_text_string(text, ",\"scale\":");
    sbfi_glb_write_numbers(text, scale, 2);
    sbfi_text_string(text, "}}");
  }
  sbfi_text_char(text, '}');
}

/* Emission above 1 uses an extension with a factor. */
static void write_glow(sbfi_glb *g, sbfi_text *text, sbf_vec3 glow) {
  float max = glow.x > glow.y ? glow.x : glow.y;
  max = glow.z > max ? glow.z : max;
  if (!(max > 0)) return;
  float colour[3] = {glow.x, glow.y, glow.z};
  for (int k = 0; k < 3 && max > 1; k++) colour[k] /= max;
  sbfi_text_string(text, ",\"emissiveFactor\":");
  sbfi_glb_write_numbers(text, colour, 3);
  if (max <= 1) return;
  g->emissive_strength = true;
  sbfi_text_string(text, ",\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":");
  sbfi_text_f32(text, max);
  sbfi_text_string(text, "}}");
}

static void write_material(sbfi_glb *g, const sbf_material *m) {
  static const char *const modes[] = {"OPAQUE", "MASK", "BLEND"};
  sbfi_text *text = sbfi_glb_item(g, SBFI_GLB_MATERIALS, NULL);
  const float colour[4] = {m->base_color.x, m->base_color.y, m->base_color.z, m->base_color.w};
  sbfi_text_string(text, "{\"name\":");
  sbfi_glb_write_string(text, *m->name ? m->name : m->id);
  sbfi_text_string(text, ",\"pbrMetallicRoughness\":{\"baseColorFactor\":");
  sbfi_glb_write_numbers(text, colour, 4);
  sbfi_text_string(text, ",\"metallicFactor\":");
  sbfi_text_f32(text, m->metallic);
  sbfi_text_string(text, ",\"roughnessFactor\":");
  sbfi_text_f32(text, m->roughness);
  write_texture(g, text, "baseColorTexture", m->base_color_texture, m->base_color_uv);
  write_texture(g, text, "metallicRoughnessTexture", m->metallic_roughness_texture, m->metallic_roughness_uv);
  sbfi_text_char(text, '}');
  write_texture(g, text, "normalTexture", m->normal_texture, m->normal_uv);
  write_glow(g, text, m->emissive);
  sbfi_export_print(text, ",\"alphaMode\":\"%s\"", modes[m->alpha_mode]);
  if (m->alpha_mode == SBF_ALPHA_MODE_MASK) {
    sbfi_text_string(text, ",\"alphaCutoff\":");
    sbfi_text_f32(text, m->alpha_cutoff);
  }
  sbfi_text_string(text, m->double_sided ? ",\"doubleSided\":true}" : "}");
}

void sbfi_glb_write_materials(sbfi_glb *g) {
  write_images(g);
  for (uint32_t i = 0; i < g->e->asset->materials.count; i++)
    write_material(g, &g->e->asset->materials.at[i]);
}
