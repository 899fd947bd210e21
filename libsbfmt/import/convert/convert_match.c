/* Which bone carries which mesh, and what the section is called: a mesh hangs on the nearest bone above it in
 * the node tree, which for objects of another file the rigging pass (import/rigging) has made. */
#include "import/convert/conversion.h"

static void match_own_tree(sbfi_conversion *c) {
  for (uint32_t i = 0; i < c->scene->mesh_count; i++) {
    const sbfi_scene_mesh *mesh = &c->scene->meshes[i];
    c->bone_of_mesh[i] = mesh->joint_count ? SBF_NONE : c->bone_of_node[mesh->node];
    c->name_of_mesh[i] = c->scene->nodes[mesh->node].name;
  }
}

sbf_status sbfi_match_sections(sbfi_conversion *c) {
  if (c->scene->mesh_count == 0) return SBF_OK;
  c->bone_of_mesh = sbfi_arena_allocate(&c->scratch, c->scene->mesh_count, sizeof *c->bone_of_mesh);
  c->name_of_mesh = sbfi_arena_allocate(&c->scratch, c->scene->mesh_count, sizeof *c->name_of_mesh);
  if (!c->bone_of_mesh || !c->name_of_mesh) return sbfi_convert_no_memory(c);
  if (c->asset->bones.count) {
    match_own_tree(c);
    return SBF_OK;
  }
  for (uint32_t i = 0; i < c->scene->mesh_count; i++) {
    c->bone_of_mesh[i] = SBF_NONE;
    c->name_of_mesh[i] = c->scene->nodes[c->scene->meshes[i].node].name;
  }
  return SBF_OK;
}
