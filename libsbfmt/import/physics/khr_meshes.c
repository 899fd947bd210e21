/* Points of collision meshes. A mesh of the scene has the importer's points; nodes outside the scene, which
 * the importer leaves out, are read from the buffer. */
#include <math.h>
#include <string.h>

#include "import/physics/physics.h"

static bool no_memory(const sbfi_physics *p) {
  sbfi_diagnose(p->file.error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while reading the collision meshes");
  return false;
}

/* Whether `node` is `above` or below it; `*between` is the transform from it to there. */
static bool is_below(const sbfi_scene *scene, int32_t node, int32_t above, sbfi_matrix *between) {
  *between = sbfi_matrix_identity();
  for (; node != SBF_NONE && node != above; node = scene->nodes[node].parent)
    *between = sbfi_matrix_multiply(&scene->nodes[node].local, between);
  return node == above;
}

static bool add_scene_meshes(const sbfi_physics *p, int32_t node, sbfi_array *points, bool *found) {
  const sbfi_scene *scene = p->scene;
  for (uint32_t m = 0; m < scene->mesh_count; m++) {
    const sbfi_scene_mesh *mesh = &scene->meshes[m];
    sbfi_matrix between;
    if (!is_below(scene, mesh->node, node, &between)) continue;
    *found = true;
    for (uint32_t i = 0; i < mesh->point_count; i++) {
      sbf_vec3 point = sbfi_transform_point(&between, mesh->points[i]);
      if (!sbfi_array_append(points, &point, 1)) return no_memory(p);
    }
  }
  return true;
}

/* The accessor of positions in place; false if it is none of plain floats. */
static bool open_positions(const sbfi_physics *p, const sbfi_json *primitive, sbfi_glb_items *items) {
  sbfi_glb_file file = p->file;
  sbf_diagnostic unseen; /* a mesh that cannot be read is a loss, not a fault */
  file.error = &unseen;
  const sbfi_json *positions = sbfi_json_get(sbfi_json_get(primitive, "attributes"), "POSITION");
  return positions && sbfi_glb_file_accessor(&file, positions, "VEC3", items) &&
         sbfi_glb_is_float(&file, items);
}

static bool add_stored_mesh(
    const sbfi_physics *p, uint32_t node, const sbfi_matrix *between, sbfi_array *points, bool *found) {
  int32_t number;
  const sbfi_json *meshes = sbfi_json_get(p->file.root, "meshes");
  if (!sbfi_physics_index(p, p->nodes[node].json, "mesh", meshes ? meshes->count : 0, &number)) return false;
  if (number == SBF_NONE) return true;
  const sbfi_json *primitives = sbfi_json_get(sbfi_json_at(meshes, (uint32_t)number), "primitives");
  for (uint32_t k = 0; primitives && primitives->type == SBFI_JSON_ARRAY && k < primitives->count; k++) {
    sbfi_glb_items items;
    if (!open_positions(p, sbfi_json_at(primitives, k), &items)) continue;
    *found = true;
    for (uint32_t i = 0; i < items.count; i++) {
      const sbf_vec3 at = {
          sbfi_glb_float(&items, i, 0), sbfi_glb_float(&items, i, 1), sbfi_glb_float(&items, i, 2)};
      if (!isfinite(at.x) || !isfinite(at.y) || !isfinite(at.z))
        return sbfi_physics_fault(p, "point %u of mesh %d is not finite", i, (int)number);
      sbf_vec3 point = sbfi_transform_point(between, at);
      if (!sbfi_array_append(points, &point, 1)) return no_memory(p);
    }
  }
  return true;
}

static bool add_stored_meshes(sbfi_physics *p, uint32_t node, sbfi_array *points, bool *found) {
  for (uint32_t i = 0; i < p->node_count; i++) {
    sbfi_matrix between = sbfi_matrix_identity(), local;
    int32_t up = (int32_t)i;
    for (; up != SBF_NONE && up != (int32_t)node; up = p->nodes[up].parent) {
      if (!sbfi_physics_local(p, (uint32_t)up, &local)) return false;
      between = sbfi_matrix_multiply(&local, &between);
    }
    if (up == (int32_t)node && !add_stored_mesh(p, i, &between, points, found)) return false;
  }
  return true;
}

bool sbfi_physics_mesh_points(sbfi_physics *p, uint32_t node, sbfi_array *points, bool *found) {
  *found = false;
  if (p->nodes[node].scene_node != SBF_NONE && !add_scene_meshes(p, p->nodes[node].scene_node, points, found))
    return false;
  return *found || add_stored_meshes(p, node, points, found);
}
