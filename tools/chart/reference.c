#include "chart/reference.h"

#include <math.h>
#include <stdio.h>

#include "chart/network_motion.h"
#include "render/fault.h"

enum { LEAST_SUBSTEPS = 32 };
static const double TICK_S = 1.0 / 60;
static const char ALLOW_MORE[] = "allow more with --most-substeps";
static const char MEND[] = "its matter folds up or its lattice is unsound";
static const double RICHARDSON = 15; /* 2^4 - 1: the fine one of two of fourth order is so much nearer */

static sbf_status no_memory(sbf_diagnostic *error) {
  return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a reference");
}

static sbf_status find_in_double(chart_truth *truth, const chart_case *charted, const chart_scene *scene,
    const sbf_vec3 *rest, uint32_t steps, sbf_diagnostic *error) {
  chart_track coarse = {.ticks = 0};
  bool good =
      chart_network_move(scene->asset, scene->gravity, TICK_S, steps, scene->ticks, &coarse) &&
      chart_network_move(scene->asset, scene->gravity, TICK_S, 2 * steps, scene->ticks, &truth->track) &&
      chart_errors_of(
          &coarse, &truth->track, rest, TICK_S, &charted->signal, charted->axes, truth->stated->errors);
  chart_track_free(&coarse);
  if (!good) return no_memory(error);
  for (int i = 0; i < CHART_AXIS_COUNT; i++) truth->stated->errors[i] /= RICHARDSON;
  snprintf(truth->stated->what, sizeof truth->stated->what,
      "Runge-Kutta of fourth order, double precision, %u steps a frame", 2 * (unsigned)steps);
  return SBF_OK;
}

/* `hint`: what to do where it fails. */
static sbf_status look(chart_track *track, const chart_scene *scene, sbf_scheme scheme, uint32_t substeps,
    const char *hint, sbf_diagnostic *error) {
  chart_motion motion;
  const chart_setting setting = {.scheme = scheme, .substeps = substeps};
  sbf_status status = chart_motion_open(&motion, scene, &setting, error);
  if (status == SBF_OK && !chart_motion_look(&motion, track)) status = no_memory(error);
  if (status == SBF_OK && !track->sound)
    status = fault_set(error, SBF_CODE_BAD_CALL, "the reference itself fails with %u substeps of %s, %s: %s",
        (unsigned)substeps, sbf_scheme_name(scheme), track->why, hint);
  chart_motion_close(&motion);
  return status;
}

static sbf_status find_by_runtime(chart_truth *truth, const chart_case *charted, const chart_scene *scene,
    const sbf_vec3 *rest, uint32_t substeps, sbf_diagnostic *error) {
  sbf_status status = look(&truth->track, scene, SBF_SCHEME_HEUN, substeps, ALLOW_MORE, error);
  if (status == SBF_OK)
    status = look(&truth->other, scene, SBF_SCHEME_SYMPLECTIC, substeps, ALLOW_MORE, error);
  if (status == SBF_OK && !chart_errors_of(&truth->other, &truth->track, rest, TICK_S, &charted->signal,
                              charted->axes, truth->stated->errors))
    status = no_memory(error);
  snprintf(truth->stated->what, sizeof truth->stated->what,
      "heun, and symplectic for heun's own rows, %u substeps a frame", (unsigned)substeps);
  return status;
}

sbf_status chart_truth_find(chart_truth *truth, const chart_case *charted, const chart_scene *scene,
    const sbf_vec3 *rest, uint32_t most_substeps, chart_reference *stated, sbf_diagnostic *error) {
  *truth = (chart_truth){.stated = stated};
  if (most_substeps < LEAST_SUBSTEPS) most_substeps = LEAST_SUBSTEPS;
  bool lattice = scene->asset->soft_bodies.at[0].levels.at[0].model != SBF_ELASTIC_MODEL_SHAPE_MATCHING;
  return charted->in_double && lattice
             ? find_in_double(truth, charted, scene, rest, most_substeps, error)
             : find_by_runtime(truth, charted, scene, rest, 4 * most_substeps, error);
}

static sbf_status needed_substeps(const chart_scene *scene, uint32_t *substeps, sbf_diagnostic *error) {
  chart_motion motion;
  const chart_setting own = {.scheme = SBF_SCHEME_SYMPLECTIC};
  sbf_status status = chart_motion_open(&motion, scene, &own, error);
  if (status == SBF_OK) *substeps = sbr_model_substeps(motion.model);
  chart_motion_close(&motion);
  return status;
}

sbf_status chart_truth_find_mesh(chart_truth *truth, const chart_case *charted, const chart_scene *scene,
    const sbf_vec3 *rest, chart_reference *stated, sbf_diagnostic *error) {
  chart_track coarse = {.ticks = 0};
  uint32_t substeps = 0;
  *truth = (chart_truth){.stated = stated};
  sbf_status status = needed_substeps(scene, &substeps, error);
  if (status == SBF_OK) status = look(&coarse, scene, SBF_SCHEME_SYMPLECTIC, 2 * substeps, MEND, error);
  if (status == SBF_OK) status = look(&truth->track, scene, SBF_SCHEME_SYMPLECTIC, 4 * substeps, MEND, error);
  if (status == SBF_OK &&
      !chart_errors_of(&coarse, &truth->track, rest, TICK_S, &charted->signal, charted->axes, stated->errors))
    status = no_memory(error);
  chart_track_free(&coarse);
  snprintf(stated->what, sizeof stated->what, "%u tetrahedra as they are, symplectic, %u substeps a frame",
      (unsigned)chart_all_elements_of(scene->asset), 4 * (unsigned)substeps);
  return status;
}

void chart_truth_free(chart_truth *truth) {
  chart_track_free(&truth->track);
  chart_track_free(&truth->other);
}
