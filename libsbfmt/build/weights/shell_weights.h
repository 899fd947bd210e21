/* Repairs weights by shells and sides: small shells are rigid, a left limb moves nothing on the right. */
#ifndef SBFI_SHELL_WEIGHTS_H
#define SBFI_SHELL_WEIGHTS_H

#include "build/weights/heat_weights.h"

/* Afterwards each site has at most SBFI_WEIGHTS_PER_POINT bones with normalized weights. Fills shells of
 * `figures`. False if memory runs out. */
bool sbfi_shell_weights_repair(const sbfi_weight_mesh *mesh, const sbfi_bone_segment *segments,
    uint32_t bone_count, const sbfi_bone_reach *reach, sbfi_site_weights *weights,
    sbfi_weights_figures *figures, sbfi_arena *arena);

#endif
