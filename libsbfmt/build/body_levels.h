/* The levels of every soft body of a build: those of authored ones get their pins, the rest are made. */
#ifndef SBFI_BODY_LEVELS_H
#define SBFI_BODY_LEVELS_H

#include "build/build_state.h"

sbf_status sbfi_body_levels_make(sbfi_build *build);

/* Takes out tetrahedra of levels of springs: embeddings went by them, and they move nothing. */
sbf_status sbfi_body_lattices_clear(sbfi_build *build);

#endif
