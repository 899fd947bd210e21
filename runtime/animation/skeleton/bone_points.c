#include "animation/skeleton/bone_points.h"

static void each_body_point(const sbri_rig *rig, sbri_point_visitor *take, void *user) {
  for (uint32_t b = 0; b < rig->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &rig->asset->soft_bodies.at[b];
    for (uint32_t i = 0; body->bone >= 0 && i < body->surface.positions.count; i++)
      take(user, rig, body->bone, body->surface.positions.at[i]);
  }
}

static void each_skin_point(
    const sbri_rig *rig, const sbf_render_mesh *mesh, sbri_point_visitor *take, void *user) {
  uint32_t at = 0;
  for (uint32_t i = 0; i < mesh->mesh.positions.count; i++) {
    int32_t bone = -1;
    float largest = 0;
    for (uint32_t k = 0; k < mesh->skin->influence_counts.at[i]; k++, at++)
      if (mesh->skin->weights.at[at] > largest)
        largest = mesh->skin->weights.at[at], bone = (int32_t)mesh->skin->bones.at[at];
    if (bone >= 0) take(user, rig, bone, mesh->mesh.positions.at[i]);
  }
}

void sbri_rig_visit_points(const sbri_rig *rig, sbri_point_visitor *take, void *user) {
  bool skins = false;
  for (uint32_t m = 0; m < rig->asset->render_meshes.count; m++) {
    const sbf_render_mesh *mesh = &rig->asset->render_meshes.at[m];
    if (!mesh->skin) continue;
    skins = true;
    each_skin_point(rig, mesh, take, user);
  }
  if (!skins) each_body_point(rig, take, user);
}
