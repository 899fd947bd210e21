/* Warnings about schemes that a call or a file selects, or that remain as the only choice, if their energy
 * error is known to be above a tenth: by the numbers of docs/solvers.md, which
 * tests/runtime/test_scheme_bias.c checks. */
#include "base/diagnostic.h"
#include "prepare/prepare.h"
#include "soft/solvers/scheme.h"

static const double WARNED_BIAS = 0.1;

/* Relative error of bending in position-based networks, by the ratio of substeps to `stable`, the number that
 * symplectic steps need. */
static double network_softness(uint32_t stable, uint32_t taken) {
  double ratio = (double)stable / taken;
  return 0.34 * ratio * ratio;
}

/* Returns false if there is no reason for a warning. */
static bool warn(const sbr_model *model, const sbri_island *island, sbf_diagnostic *found) {
  double tick_s = (double)model->asset->environment.control_tick;
  sbri_island open = *island;
  open.stepping.substeps = 0; /* the automatic number */
  uint32_t stable = sbri_stable_substeps(&open, tick_s, island->springs.rest_stretch),
           taken = sbri_scheme_substeps(island, tick_s, island->springs.rest_stretch);
  const char *id = model->bodies[island->bodies[0]].source->id;
  bool solid = island->tetrahedra.count > 0;
  double softness = network_softness(stable, taken);
  if ((double)island->stability.softened_shear < 1 - WARNED_BIAS ||
      (double)island->stability.softened_bulk < 1 - WARNED_BIAS)
    sbfi_diagnose(found, SBF_CODE_SCHEME_BIASED,
        "body \"%s\" is too stiff for %d substeps a tick and is softened: at the softest place to %.2g of "
        "its bulk modulus and %.2g of its shear modulus; use larger or fewer elements",
        id, (int)SBRI_MAX_SUBSTEPS, (double)island->stability.softened_bulk,
        (double)island->stability.softened_shear);
  /* The required number includes a margin of a tenth. */
  else if (island->scheme == &sbri_symplectic && taken + taken / 8 < stable)
    sbfi_diagnose(found, SBF_CODE_SCHEME_BIASED,
        "body \"%s\" is stepped by symplectic with %u substeps a tick but needs %u, so it may become "
        "unstable: do not set the number of substeps",
        id, (unsigned)taken, (unsigned)stable);
  else if (island->scheme == &sbri_position_based && solid && taken < stable)
    sbfi_diagnose(found, SBF_CODE_SCHEME_BIASED,
        "body \"%s\" is stepped by position_based with %u substeps a tick: it deforms %s too much; with %u "
        "substeps the error is below 2 %%",
        id, (unsigned)taken, 2 * taken < stable ? "several times" : "by a tenth or more",
        (unsigned)(2 * stable));
  else if (island->scheme == &sbri_position_based && !solid && island->springs.count &&
           softness > WARNED_BIAS)
    sbfi_diagnose(found, SBF_CODE_SCHEME_BIASED,
        "body \"%s\" is stepped by position_based with %u substeps a tick: it bends about %.2g times as far "
        "as its springs should; with %u substeps the error is below 3 %%",
        id, (unsigned)taken, 1 + softness, (unsigned)(4 * stable));
  else if (island->scheme == &sbri_block_descent && solid)
    sbfi_diagnose(found, SBF_CODE_SCHEME_BIASED,
        "body \"%s\" is stepped by block_descent: its rest shape is right, but its motion is strongly "
        "damped, on a bar the lowest mode is 79 %% slower; for right oscillations use symplectic or heun",
        id);
  else if (island->scheme == &sbri_block_descent)
    sbfi_diagnose(found, SBF_CODE_SCHEME_BIASED,
        "body \"%s\" is stepped by block_descent: its rest shape is right, but its motion is damped, on a "
        "bar by a damping ratio of 0.14 more than its own; for right oscillations use symplectic or heun",
        id);
  else
    return false;
  return true;
}

uint32_t sbr_model_report_scheme_bias(
    const sbr_model *model, void (*report)(void *user, const sbf_diagnostic *diagnostic), void *user) {
  uint32_t count = 0;
  for (uint32_t i = 0; model && i < model->island_count; i++) {
    sbf_diagnostic found;
    if (!warn(model, &model->islands[i], &found)) continue;
    count++;
    if (report) report(user, &found);
  }
  return count;
}
