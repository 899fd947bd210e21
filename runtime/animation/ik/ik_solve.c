/* Calls the solver that a chain names. */
#include "animation/ik/ik.h"

sbri_ik_result sbri_ik_solve(sbf_ik_solver solver, sbri_ik_chain *chain) {
  switch (solver) {
  case SBF_IK_SOLVER_TWO_BONE:
    return chain->count == 3 ? sbri_ik_two_bone(chain) : sbri_fabrik(chain);
  case SBF_IK_SOLVER_FABRIK:
    return sbri_fabrik(chain);
  case SBF_IK_SOLVER_DAMPED_LEAST_SQUARES:
    return sbri_damped_least_squares(chain);
  case SBF_IK_SOLVER_SPLINE:
    return sbri_ik_spline(chain);
  default:
    return sbri_ccd(chain);
  }
}
