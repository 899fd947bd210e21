/* Checks render meshes: visible content, normals and texture coordinates for every corner. */
#include <math.h>

#include "validate/rules/mesh_use.h"
#include "validate/validation.h"

typedef struct seen {
  sbfi_validation *v;
  const sbf_render_mesh *mesh;
  sbfi_path path;
} seen;

static void check_normals(const seen *s) {
  const sbf_render_mesh *mesh = s->mesh;
  sbfi_path path = sbfi_path_of("%s/normals", s->path.text);
  if (mesh->normals.count && mesh->normal_corners.count == 0 &&
      mesh->normals.count != mesh->mesh.positions.count)
    sbfi_found(s->v, SBF_CODE_NORMALS_LENGTH, path.text, -1, "'%s' has %u normals, but %u points",
        sbfi_label(mesh->name, mesh->id), mesh->normals.count, mesh->mesh.positions.count);
  for (uint32_t i = 0; i < mesh->normals.count; i++) {
    sbf_vec3 n = mesh->normals.at[i];
    double squared = (double)n.x * n.x + (double)n.y * n.y + (double)n.z * n.z;
    if (fabs(squared - 1) > 0.02)
      sbfi_found(s->v, SBF_CODE_NORMAL_NOT_UNIT, path.text, i, "normal %u of '%s' has the length %.4g", i,
          sbfi_label(mesh->name, mesh->id), sqrt(squared));
  }
}

static void check_colors(const seen *s) {
  const sbf_render_mesh *mesh = s->mesh;
  if (mesh->colors.count && mesh->color_corners.count == 0 &&
      mesh->colors.count != mesh->mesh.positions.count)
    sbfi_found(s->v, SBF_CODE_COLORS_LENGTH, sbfi_path_of("%s/colors", s->path.text).text, -1,
        "'%s' has %u colours, but %u points", sbfi_label(mesh->name, mesh->id), mesh->colors.count,
        mesh->mesh.positions.count);
}

static void check_uv_sets(const seen *s) {
  for (uint32_t u = 0; u < s->mesh->uv_sets.count; u++) {
    const sbf_uv_set *set = &s->mesh->uv_sets.at[u];
    if (set->corners.count == 0 && set->coordinates.count != s->mesh->mesh.positions.count)
      sbfi_found(s->v, SBF_CODE_UV_LENGTH, sbfi_path_of("%s/uv_set[%u]", s->path.text, u + 1).text, -1,
          "uv set '%s' of '%s' has %u coordinates, but the mesh has %u points", set->name,
          sbfi_label(s->mesh->name, s->mesh->id), set->coordinates.count, s->mesh->mesh.positions.count);
  }
}

static void check_materials(const seen *s) {
  if (s->mesh->uv_sets.count) return;
  for (uint32_t i = 0; i < s->mesh->material_slots.count; i++) {
    int32_t number = s->mesh->material_slots.at[i].material;
    const sbf_material *material = number >= 0 ? &s->v->asset->materials.at[number] : NULL;
    if (!material || (material->base_color_texture < 0 && material->metallic_roughness_texture < 0 &&
                         material->normal_texture < 0))
      continue;
    sbfi_found(s->v, SBF_CODE_MATERIAL_NO_UVS, sbfi_path_of("%s/material_slot[%u]", s->path.text, i + 1).text,
        -1, "'%s' has the material '%s' with an image, but no texture coordinates",
        sbfi_label(s->mesh->name, s->mesh->id), sbfi_label(material->name, material->id));
  }
}

static void check_points(const seen *s) {
  const sbf_polygon_mesh *mesh = &s->mesh->mesh;
  uint32_t unused = 0, first = 0;
  uint8_t *used = sbfi_scratch(s->v, mesh->positions.count, 1);
  if (!used) return;
  if (mesh->polygon_sizes.count == 0) {
    sbfi_found(s->v, SBF_CODE_MESH_EMPTY, s->path.text, -1, "'%s' has no polygons",
        sbfi_label(s->mesh->name, s->mesh->id));
    return;
  }
  sbfi_mesh_use_of(s->mesh, used);
  for (uint32_t i = 0; i < mesh->positions.count; i++)
    if (!used[i] && unused++ == 0) first = i;
  if (unused)
    sbfi_found(s->v, SBF_CODE_MESH_POINT_UNUSED, sbfi_path_of("%s/polygon_mesh/positions", s->path.text).text,
        first, "%u point%s of '%s' %s in no polygon", unused, sbfi_plural(unused),
        sbfi_label(s->mesh->name, s->mesh->id), unused == 1 ? "is" : "are");
}

static void check_shape_keys(const seen *s) {
  /* number from 1 of the key */
  uint32_t *last = sbfi_scratch(s->v, s->mesh->mesh.positions.count, sizeof *last);
  for (uint32_t k = 0; last && k < s->mesh->shape_keys.count; k++) {
    const sbf_shape_key *key = &s->mesh->shape_keys.at[k];
    for (uint32_t i = 0; i < key->points.count; i++) {
      if (last[key->points.at[i]] == k + 1)
        sbfi_found(s->v, SBF_CODE_SHAPE_KEY_REPEATED,
            sbfi_path_of("%s/shape_key[%u]/points", s->path.text, k + 1).text, i,
            "shape key '%s' of '%s' moves point %u twice", key->name, sbfi_label(s->mesh->name, s->mesh->id),
            key->points.at[i]);
      last[key->points.at[i]] = k + 1;
    }
  }
}

void sbfi_check_meshes(sbfi_validation *v) {
  for (uint32_t m = 0; m < v->asset->render_meshes.count && !v->out_of_memory; m++) {
    seen s = {v, &v->asset->render_meshes.at[m], sbfi_path_of("/sbf/render_mesh[%u]", m + 1)};
    check_points(&s);
    check_normals(&s);
    check_colors(&s);
    check_uv_sets(&s);
    check_materials(&s);
    check_shape_keys(&s);
  }
}
