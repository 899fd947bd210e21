/* Assigns a bone and a section name to each mesh: a mesh follows the nearest bone above it in the node
 * tree. For objects of another file import/rigging has created that tree. */
#include "import/convert/conversion.h"

static void match_own_tree(sbfi_conversion *c) {
  for (uint32_t i = 0; i < c->scene->mesh_count; i++) {
    const sbfi_scene_mesh *mesh = &c->scene->meshes[i];
    c->bone_of_mesh[i] = mesh->skin.joint_count ? SBF_NONE : c->bone_of_node[mesh->node];
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
