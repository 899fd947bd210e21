/* Bone with the greatest weight at each point of a skin. */
#ifndef SBFI_MAIN_BONES_H
#define SBFI_MAIN_BONES_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* (positions) Bone with the greatest weight, the first if equal; SBFI_NO_INDEX if the point has no
 * weights. Allocates from `scratch`; NULL if memory runs out. */
uint32_t *sbfi_main_bones(const sbf_render_mesh *skinned, sbfi_arena *scratch);

#endif
