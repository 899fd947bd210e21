#include "import/convert/convert_colors.h"

#include <math.h>
#include <string.h>

static float in_unit_range(float value) {
  return value < 0 ? 0 : value > 1 ? 1 : value;
}

static float linear_of_srgb(float stored) {
  double v = (double)in_unit_range(stored);
  return (float)(v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
}

/* assimp sets an opacity of 0 everywhere when the file has three components per colour. */
static bool has_opacity(const sbfi_scene_mesh *mesh) {
  for (uint32_t i = 0; i < mesh->colors.count; i++)
    if (mesh->colors.at[i].w > 0) return true;
  return false;
}

static bool is_white(const sbf_vec4 *colors, uint32_t count) {
  for (uint32_t i = 0; i < count; i++)
    if (colors[i].x < 1 || colors[i].y < 1 || colors[i].z < 1 || colors[i].w < 1) return false;
  return true;
}

static sbf_status write_colors(sbfi_conversion *c, const sbfi_scene_mesh *mesh, const uint32_t *corner_order,
    bool linear, sbf_render_mesh *render) {
  uint32_t white = mesh->colors.count; /* index used by corners without a colour */
  bool opaque = !has_opacity(mesh), partial = false;
  sbf_vec4 *colors = sbfi_convert_allocate(c, (size_t)white + 1, sizeof *colors);
  uint32_t *corners = sbfi_convert_allocate(c, mesh->corner_count, sizeof *corners);
  if (!colors || !corners) return sbfi_convert_no_memory(c);
  for (uint32_t i = 0; i < white; i++) {
    const sbf_vec4 from = mesh->colors.at[i];
    float (*component)(float) = linear ? in_unit_range : linear_of_srgb;
    colors[i] = (sbf_vec4){
        component(from.x), component(from.y), component(from.z), opaque ? 1 : in_unit_range(from.w)};
  }
  colors[white] = (sbf_vec4){1, 1, 1, 1};
  if (is_white(colors, white)) return SBF_OK;
  for (uint32_t i = 0; i < mesh->corner_count; i++) {
    int32_t from = mesh->colors.corner_index[corner_order[i]];
    corners[i] = from < 0 ? white : (uint32_t)from;
    partial = partial || from < 0;
  }
  render->colors = (sbf_vec4_list){colors, white + partial};
  render->color_corners = (sbf_u32_list){corners, mesh->corner_count};
  return SBF_OK;
}

sbf_status sbfi_convert_colors(
    sbfi_conversion *c, const sbfi_scene_mesh *mesh, const uint32_t *corner_order, sbf_render_mesh *render) {
  const char *format = c->scene->format;
  bool is_gltf = strcmp(format, "glb") == 0 || strcmp(format, "gltf") == 0;
  if (!mesh->colors.count || !mesh->corner_count) return SBF_OK;
  if (is_gltf || strcmp(format, "ply") == 0) return write_colors(c, mesh, corner_order, is_gltf, render);
  sbfi_convert_warn(c, SBF_CODE_IMPORT_IGNORED,
      "object '%s': its vertex colours are left out, because programs that write .%s store masks in them: "
      "export it as glTF if they are colours",
      c->scene->nodes[mesh->node].name, format);
  return SBF_OK;
}

uint32_t sbfi_first_uv_set(sbfi_conversion *c, const sbfi_scene_mesh *mesh) {
  int64_t first = -1;
  bool differ = false;
  for (uint32_t p = 0; p < mesh->polygon_count; p++) {
    if (mesh->polygon_materials[p] < 0) continue;
    const sbfi_scene_material *material = &c->scene->materials[mesh->polygon_materials[p]];
    if (material->base_color_image < 0) continue;
    if (first < 0) first = material->base_color_uv.uv_set;
    differ = differ || first != material->base_color_uv.uv_set;
  }
  if (differ)
    sbfi_convert_warn(c, SBF_CODE_IMPORT_PARTIAL_UVS,
        "object '%s': the base colour images of its materials use different sets of texture coordinates, and "
        "set %u is used for all: use one set for them",
        c->scene->nodes[mesh->node].name, (uint32_t)first);
  return first >= 0 && first < mesh->uv_set_count ? (uint32_t)first : 0;
}
