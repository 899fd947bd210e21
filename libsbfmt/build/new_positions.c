#include "build/new_positions.h"

static const sbfi_id_entry *found_again(const sbfi_ids *ids, int32_t derived, const char *id) {
  return derived != SBF_NONE ? sbfi_ids_find(ids, id) : NULL;
}

static void match_rigid_bodies(const sbf_rigid_body_list *old, const sbf_rigid_body_list *now,
    const sbfi_ids *ids, int32_t *new_from_old) {
  for (uint32_t i = 0; i < old->count; i++) {
    const sbfi_id_entry *same = found_again(ids, old->at[i].derived, old->at[i].id);
    if (same && same->index < now->count && now->at[same->index].id == same->id)
      new_from_old[i] = (int32_t)same->index;
  }
}

static void match_sections(const sbf_soft_body_list *old, const sbf_soft_body_list *now, const sbfi_ids *ids,
    int32_t *new_from_old) {
  for (uint32_t i = 0; i < old->count; i++) {
    const sbfi_id_entry *same = found_again(ids, old->at[i].derived, old->at[i].id);
    if (same && same->index < now->count && now->at[same->index].id == same->id)
      new_from_old[i] = (int32_t)same->index;
  }
}

sbfi_new_positions_outcome sbfi_new_positions_apply(sbf_asset *asset, const sbf_asset *from,
    const sbfi_ids *ids, sbfi_lost_reference *lost, sbfi_arena *scratch) {
  const uint32_t counts[] = {from->rigid_bodies.count, from->soft_bodies.count, from->render_meshes.count};
  int32_t *indices[3];
  for (int i = 0; i < 3; i++) {
    indices[i] = sbfi_arena_allocate(scratch, (size_t)counts[i] + 1, sizeof *indices[i]);
    if (!indices[i]) return SBFI_POSITIONS_NO_MEMORY;
  }
  sbfi_find_source_indices(from->rigid_bodies.at, counts[0], sizeof(sbf_rigid_body),
      offsetof(sbf_rigid_body, derived), indices[0]);
  sbfi_find_source_indices(
      from->soft_bodies.at, counts[1], sizeof(sbf_soft_body), offsetof(sbf_soft_body, derived), indices[1]);
  sbfi_find_source_indices(from->render_meshes.at, counts[2], sizeof(sbf_render_mesh),
      offsetof(sbf_render_mesh, derived), indices[2]);
  match_rigid_bodies(&from->rigid_bodies, &asset->rigid_bodies, ids, indices[0]);
  match_sections(&from->soft_bodies, &asset->soft_bodies, ids, indices[1]);
  const sbfi_renumbering renumberings[] = {{offsetof(sbf_asset, rigid_bodies), indices[0], counts[0]},
      {offsetof(sbf_asset, soft_bodies), indices[1], counts[1]},
      {offsetof(sbf_asset, render_meshes), indices[2], counts[2]}};
  return sbfi_references_renumber(asset, renumberings, 3, lost) ? SBFI_POSITIONS_APPLIED
                                                                : SBFI_POSITIONS_LOST;
}
