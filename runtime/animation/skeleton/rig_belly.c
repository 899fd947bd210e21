/* The belly: the lowest points between the legs, which the body keeps above the ground. */
#include "animation/skeleton/rig_belly.h"

static const float RISES =
    0.35f; /* height per metre of distance from the middle at which a point counts equally */
static const float DRAGS = 0.08f; /* fraction of the reach: points lower than this at rest may drag */

typedef struct belly_points {
  sbf_vec3 at[SBRI_BELLY];
  bool any[SBRI_BELLY];
  float middle; /* z */
} belly_points;

/* Whether the bone moves with the body: no legs and no chains. */
static bool is_trunk(const sbri_rig *rig, int32_t bone) {
  for (int32_t b = bone; b >= 0; b = rig->bones.parents[b]) {
    if (rig->bones.roles[b] == SBRI_ROLE_TAIL) return false;
    for (uint32_t i = 0; i < rig->leg_count; i++)
      if (rig->legs[i].upper == b) return false;
  }
  return bone >= 0;
}

static void take(belly_points *f, sbf_vec3 p) {
  uint32_t k = (p.z > f->middle ? 2u : 0u) + (p.x > 0 ? 1u : 0u);
  float low = p.y - RISES * fabsf(p.z - f->middle);
  if (f->any[k] && low >= f->at[k].y - RISES * fabsf(f->at[k].z - f->middle)) return;
  f->any[k] = true;
  f->at[k] = p;
}

static bool visit_bodies(const sbri_rig *rig, belly_points *f) {
  bool bodies = false;
  for (uint32_t b = 0; b < rig->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &rig->asset->soft_bodies.at[b];
    bodies = bodies || body->bone >= 0;
    if (!is_trunk(rig, body->bone)) continue;
    for (uint32_t i = 0; i < body->surface.positions.count; i++) take(f, body->surface.positions.at[i]);
  }
  return bodies;
}

static void visit_skins(const sbri_rig *rig, belly_points *f) {
  for (uint32_t m = 0; m < rig->asset->render_meshes.count; m++) {
    const sbf_render_mesh *mesh = &rig->asset->render_meshes.at[m];
    uint32_t at = 0;
    for (uint32_t i = 0; mesh->skin && i < mesh->skin->influence_counts.count; i++) {
      float limited = 0;
      for (uint32_t k = 0; k < mesh->skin->influence_counts.at[i]; k++, at++)
        if (is_trunk(rig, (int32_t)mesh->skin->bones.at[at])) limited += mesh->skin->weights.at[at];
      if (limited > 0.5f) take(f, mesh->mesh.positions.at[i]);
    }
  }
}

void sbri_rig_find_belly(sbri_rig *rig) {
  belly_points f = {.middle = 0.5f * (rig->stand.hind_z + rig->stand.fore_z)};
  if (rig->leg_count == 0 || rig->chains.count) return; /* chains follow the ground by themselves */
  if (!visit_bodies(rig, &f)) visit_skins(rig, &f);
  for (uint32_t k = 0; k < SBRI_BELLY; k++)
    if (f.any[k] && f.at[k].y > DRAGS * rig->stand.reach)
      rig->stand.belly[rig->stand.belly_count++] = f.at[k];
}
