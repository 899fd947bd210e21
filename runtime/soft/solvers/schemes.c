/* Table of schemes. */
#include "soft/solvers/scheme.h"

static const sbri_scheme *const schemes[] = {&sbri_symplectic, &sbri_position_based, &sbri_relaxation,
    &sbri_explicit_euler, &sbri_heun, &sbri_block_descent};

const sbri_scheme *sbri_scheme_of(sbf_scheme kind) {
  for (size_t i = 0; i < sizeof schemes / sizeof *schemes; i++)
    if (schemes[i]->kind == kind) return schemes[i];
  return NULL;
}

const char *sbri_scheme_names(void) {
  return "symplectic, position_based, relaxation, explicit_euler, heun, block_descent";
}
