/* Measures mass and extent of a whole asset. */
#include "sbfmt/mechanics.h"

static void grow(sbf_asset_measures *m, sbf_vec3_list points) {
  for (uint32_t i = 0; i < points.count; i++) {
    sbf_vec3 p = points.at[i];
    if (!m->bounded) m->low = m->high = p;
    m->bounded = true;
    if (p.x < m->low.x) m->low.x = p.x;
    if (p.y < m->low.y) m->low.y = p.y;
    if (p.z < m->low.z) m->low.z = p.z;
    if (p.x > m->high.x) m->high.x = p.x;
    if (p.y > m->high.y) m->high.y = p.y;
    if (p.z > m->high.z) m->high.z = p.z;
  }
}

void sbf_asset_measure(const sbf_asset *asset, sbf_asset_measures *measures) {
  *measures = (sbf_asset_measures){.mass = 0};
  for (uint32_t i = 0; i < asset->render_meshes.count; i++)
    grow(measures, asset->render_meshes.at[i].mesh.positions);
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) {
    sbf_body_measures body;
    sbf_body_measure(&asset->soft_bodies.at[i], &body);
    measures->mass += body.mass;
    grow(measures, asset->soft_bodies.at[i].surface.positions);
  }
  for (uint32_t i = 0; !measures->bounded && i < asset->soft_bodies.count; i++)
    if (asset->soft_bodies.at[i].levels.count)
      grow(measures, asset->soft_bodies.at[i].levels.at[0].positions);
}
