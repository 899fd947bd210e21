#include "gltf/renumbered.h"

#include "base/diagnostic.h"

/* Meshes that are compared with stated ones in a load. */
enum { MAX_COMPARISONS = 1 << 16 };

/* Reports that a part has another number now, or refuses it. */
static bool take(sbfi_gltf_reader *r, const char *list, uint32_t was, uint32_t is, const char *by) {
  if (!r->options.repairable)
    return sbfi_glb_fault(&r->file, SBF_CODE_GLTF_CHANGED,
        "item %u of the glTF file's %s is now number %u, because another program renumbered them: `sbfmt "
        "validate --fix` writes the new numbers",
        was, list, is);
  if (!r->options.report) return true;
  sbf_diagnostic found;
  sbfi_diagnose(&found, SBF_CODE_GLTF_RENUMBERED,
      "item %u of the glTF file's %s is now number %u, found by its %s", was, list, is, by);
  r->options.report(r->options.user, &found);
  return true;
}

/* ---- Meshes ---- */

/* Vertices of all primitives, without reading them. */
static uint64_t count_vertices(const sbfi_glb_file *file, const sbfi_json *mesh) {
  const sbfi_json *primitives = sbfi_json_get(mesh, "primitives");
  const sbfi_json *accessors = sbfi_json_get(file->root, "accessors");
  uint64_t sum = 0;
  for (uint32_t i = 0; primitives && primitives->type == SBFI_JSON_ARRAY && i < primitives->count; i++) {
    const sbfi_json *attributes = sbfi_json_get(sbfi_json_at(primitives, i), "attributes");
    uint32_t number, count;
    if (sbfi_json_u32(sbfi_json_get(attributes, "POSITION"), &number) &&
        sbfi_json_u32(sbfi_json_get(sbfi_json_at(accessors, number), "count"), &count))
      sum += count;
  }
  return sum;
}

static bool has_checksum(const sbfi_glb_file *file, const sbfi_json *mesh, const sbfi_stated_mesh *stated,
    sbfi_mesh_vertices *vertices) {
  uint32_t crc32;
  return sbfi_mesh_vertices_find(file, mesh, stated->sizes, stated->materials, vertices) &&
         sbfi_mesh_checksum(file, vertices, &crc32) && crc32 == stated->crc32;
}

bool sbfi_find_stated_mesh(
    sbfi_gltf_reader *r, const sbfi_stated_mesh *stated, sbfi_mesh_vertices *vertices) {
  const sbfi_json *meshes = sbfi_json_get(r->file.root, "meshes");
  const sbfi_json *own = sbfi_json_at(meshes, stated->number);
  if (own && sbfi_mesh_vertices_find(&r->file, own, stated->sizes, stated->materials, vertices)) {
    uint32_t crc32;
    if (!sbfi_mesh_checksum(&r->file, vertices, &crc32)) return false;
    if (crc32 == stated->crc32) return true;
    sbfi_glb_fault(&r->file, SBF_CODE_GLTF_CHANGED,
        "another program changed the points or triangles of mesh %u: its soft bodies belong to the old ones, "
        "so use the file as it was before, or convert this one anew",
        stated->number);
  } else if (!own) {
    sbfi_glb_file_item(&r->file, "meshes", stated->number); /* states the error */
  }
  sbfi_glb_file unreported = r->file;
  unreported.error = NULL;
  for (uint32_t i = 0; meshes && i < meshes->count; i++) {
    const sbfi_json *mesh = sbfi_json_at(meshes, i);
    if (i == stated->number || count_vertices(&unreported, mesh) != stated->vertex_count) continue;
    if (r->mesh_comparisons++ == MAX_COMPARISONS) return false;
    if (has_checksum(&unreported, mesh, stated, vertices))
      return take(r, "meshes", stated->number, i, "checksum");
  }
  return false;
}

/* ---- Clips and images ---- */

const sbfi_json *sbfi_find_named_item(
    sbfi_gltf_reader *r, const char *list, uint32_t number, const char *name) {
  const sbfi_json *items = sbfi_json_get(r->file.root, list), *own = sbfi_json_at(items, number);
  uint32_t found = 0, index = 0;
  if (sbfi_json_is_string(sbfi_json_get(own, "name"), name)) return own;
  for (uint32_t i = 0; items && items->type == SBFI_JSON_ARRAY && i < items->count; i++)
    if (sbfi_json_is_string(sbfi_json_get(sbfi_json_at(items, i), "name"), name)) found++, index = i;
  if (found != 1) return sbfi_glb_file_item(&r->file, list, number);
  return take(r, list, number, index, "name") ? sbfi_json_at(items, index) : NULL;
}
