/* Which bone holds most of each point of a skin. */
#ifndef SBFI_MAIN_BONES_H
#define SBFI_MAIN_BONES_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* (positions) The bone with the greatest weight, the first of equals; SBFI_NO_INDEX: none has any. Memory of
 * `scratch`; NULL where it runs out. */
uint32_t *sbfi_main_bones(const sbf_render_mesh *skinned, sbfi_arena *scratch);

#endif
