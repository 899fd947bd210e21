/* Diffuses each site's bone over the surface like heat. */
#ifndef SBFI_HEAT_WEIGHTS_H
#define SBFI_HEAT_WEIGHTS_H

#include "build/weights/nearest_bones.h"

enum { SBFI_SITE_BONES = 8 }; /* bones per site before the smallest weights are dropped */

/* Descending weights; bone UINT32_MAX and weight 0 after the last. */
typedef struct sbfi_site_weights {
  uint32_t bones[SBFI_SITE_BONES];
  float weights[SBFI_SITE_BONES];
} sbfi_site_weights;

/* Solves (L + c M / d^2) w = (c M / d^2) p for groups of bones by conjugate gradients. `weights`
 * (mesh->site_count) are not normalized. `iterations` receives the maximum over all groups. False if
 * memory runs out. */
bool sbfi_heat_weights_solve(const sbfi_weight_mesh *mesh, const sbfi_nearest_bone *nearest,
    uint32_t bone_count, sbfi_site_weights *weights, uint32_t *iterations, sbfi_arena *arena);

#endif
