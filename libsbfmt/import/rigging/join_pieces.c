#include "import/rigging/join_pieces.h"

#include "base/union_find.h"
#include "import/rigging/join_meshes.h"
#include "import/rigging/mesh_borders.h"

static void *allocate(const sbfi_rigging *r, size_t count, size_t size) {
  return sbfi_arena_allocate(&r->c->scratch, count + 1, size);
}

/* Whether the mesh is attached like a mesh of the rig, and its format has no vertices of its own. */
static bool is_piece(const sbfi_rigging *r, uint32_t mesh) {
  if (r->parent_nodes[mesh] == SBF_NONE || r->input.scene->meshes[mesh].corner_vertices) return false;
  for (uint32_t m = 0; m < r->rig.scene->mesh_count; m++)
    if (r->rig.scene->meshes[m].node == r->parent_nodes[mesh]) return true;
  return false;
}

static bool join_along_borders(const sbfi_rigging *r, uint32_t *sets) {
  const sbfi_scene *scene = r->input.scene;
  sbfi_borders borders;
  bool *is_included = allocate(r, scene->mesh_count, sizeof *is_included);
  if (!is_included) return false;
  for (uint32_t m = 0; m < scene->mesh_count; m++) is_included[m] = is_piece(r, m);
  if (!sbfi_borders_find(&borders, scene->meshes, scene->mesh_count, is_included, &r->c->scratch))
    return false;
  for (size_t i = 1; i < borders.count; i++) {
    const sbfi_border_edge *a = &borders.at[i - 1], *b = &borders.at[i];
    if (sbfi_borders_coincide(a, b) && r->parent_nodes[a->mesh] == r->parent_nodes[b->mesh])
      sbfi_sets_join(sets, a->mesh, b->mesh);
  }
  return true;
}

static void join_those_by_position(const sbfi_rigging *r, uint32_t *sets) {
  for (uint32_t m = 0; m < r->input.scene->mesh_count; m++)
    for (uint32_t k = 0; is_piece(r, m) && r->matched_nodes[m] == r->parent_nodes[m] && k < m; k++)
      if (is_piece(r, k) && r->matched_nodes[k] == r->matched_nodes[m]) sbfi_sets_join(sets, k, m);
}

bool sbfi_join_pieces(
    const sbfi_rigging *r, sbfi_scene_node *nodes, sbfi_scene_mesh *meshes, uint32_t *count) {
  uint32_t mesh_count = *count, kept = 0;
  uint32_t *sets = allocate(r, mesh_count, sizeof *sets), *sizes = allocate(r, mesh_count, sizeof *sizes);
  sbfi_scene_mesh *before = sbfi_arena_copy(&r->c->scratch, meshes, mesh_count, sizeof *before);
  if (!sets || !sizes || !before) return false;
  sbfi_sets_begin(sets, mesh_count);
  if (!join_along_borders(r, sets)) return false;
  join_those_by_position(r, sets);
  for (uint32_t m = 0; m < mesh_count; m++) sizes[sets[m] = sbfi_set_root(sets, m)]++;
  for (uint32_t m = 0; m < mesh_count; m++) {
    if (sets[m] != m) continue;
    meshes[kept] = before[m];
    if (sizes[m] > 1 && !sbfi_join_meshes(&r->c->scratch, sets, m, before, mesh_count, &meshes[kept]))
      return false;
    if (sizes[m] > 1) nodes[before[m].node].name = r->rig.scene->nodes[r->parent_nodes[m]].name;
    kept++;
  }
  *count = kept;
  return true;
}
