/* The loops are in soft/solvers/symplectic.h. */
#include "model/kernels.h"
#include "soft/solvers/scheme.h"

static void tick_symplectic(const sbri_island_tick *tick) {
  tick->model->kernels->symplectic_tick(tick);
}

const sbri_scheme sbri_symplectic = {
    .kind = SBF_SCHEME_SYMPLECTIC, .substeps = sbri_stable_substeps, .tick = tick_symplectic};
