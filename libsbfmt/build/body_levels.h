/* Levels of all soft bodies of a build: authored ones get their pins, the others are built. */
#ifndef SBFI_BODY_LEVELS_H
#define SBFI_BODY_LEVELS_H

#include "build/build_state.h"

sbf_status sbfi_body_levels_make(sbfi_build *build);

/* Removes tetrahedra from levels of springs: embeddings used them, and they have no forces. */
sbf_status sbfi_body_lattices_clear(sbfi_build *build);

#endif
