#include "chart/reference.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fault.h"
#include "chart/network_motion.h"

enum { MIN_SUBSTEPS = 32, MAX_SUBSTEPS = 1024 }; /* relative to the sweep; limit of the runtime */
static const double TICK_S = 1.0 / 60;
static const char BODY_ADVICE[] = "its matter folds up or its lattice is unsound";
/* Maximum distance of the two tracks of a reference, relative to the displacement, that needs no
 * refinement. */
static const double CONVERGED = 0.001;
/* 2^4 - 1: ratio of errors for half the step of a fourth order method, minus 1 */
static const double RICHARDSON = 15;

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

/* `hint`: advice if it fails. */
static sbf_status check(chart_track *track, const chart_scene *scene, sbf_scheme scheme, uint32_t substeps,
    const char *hint, sbf_diagnostic *error) {
  chart_motion motion;
  const chart_setting setting = {.scheme = scheme, .substeps = substeps};
  sbf_status status = chart_motion_open(&motion, scene, &setting, error);
  motion.scene.stop_broken = true;
  if (status == SBF_OK && !chart_motion_sample(&motion, track)) status = no_memory(error);
  if (status == SBF_OK && !track->sound)
    status = fault_set(error, SBF_CODE_BAD_CALL, "the reference itself fails with %u substeps of %s, %s: %s",
        (unsigned)substeps, sbf_scheme_name(scheme), track->why, hint);
  chart_motion_close(&motion);
  return status;
}

/* Two tracks of one motion; the second is at least as good. */
typedef struct reference_pair {
  const chart_case *charted;
  const chart_scene *scene;
  const sbf_vec3 *rest;
  sbf_scheme schemes[2];
  uint32_t substeps[2];
} reference_pair;

/* Distance of the two relative to the displacement. */
static double separation(const reference_pair *p, const chart_track *track, const double *errors) {
  if (!(p->charted->axes & 1u << CHART_PATH)) return errors[CHART_SHAPE];
  double extent = chart_extent_of(track, p->rest);
  return extent > 0 ? errors[CHART_PATH] / extent : 0;
}

/* `first` is the first of them if it exists; NULL otherwise. */
static sbf_status sample_both(const reference_pair *p, const chart_track *first, chart_track tracks[2],
    double *errors, const char *hint, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  for (int i = 0; i < 2; i++) chart_track_free(&tracks[i]);
  if (first && !chart_track_copy(&tracks[0], first)) status = no_memory(error);
  for (int i = first ? 1 : 0; status == SBF_OK && i < 2; i++)
    status = check(&tracks[i], p->scene, p->schemes[i], p->substeps[i], hint, error);
  if (status == SBF_OK && !chart_errors_of(&tracks[0], &tracks[1], p->rest, TICK_S, &p->charted->signal,
                              p->charted->axes, errors))
    status = no_memory(error);
  return status;
}

/* Doubles the substeps until both are sound and have converged, the limit is reached, or the distance
 * stops decreasing: then keeps the best. `tracks` and `errors` are of `substeps`. */
static sbf_status refine(
    reference_pair *p, chart_track tracks[2], double *errors, const char *hint, sbf_diagnostic *error) {
  sbf_status status = sample_both(p, NULL, tracks, errors, hint, error);
  while (
      (status == SBF_OK ? separation(p, &tracks[1], errors) > CONVERGED : error->code == SBF_CODE_BAD_CALL) &&
      2 * p->substeps[1] <= MAX_SUBSTEPS) {
    reference_pair finer = *p;
    chart_track more[2] = {{.ticks = 0}, {.ticks = 0}};
    double finer_errors[CHART_AXIS_COUNT];
    bool pinned = status == SBF_OK;
    bool known = pinned && p->schemes[0] == p->schemes[1] && p->substeps[1] == 2 * p->substeps[0];
    for (int i = 0; i < 2; i++) finer.substeps[i] *= 2;
    status = sample_both(&finer, known ? &tracks[1] : NULL, more, finer_errors, hint, error);
    bool nearer = status == SBF_OK &&
                  (!pinned || separation(&finer, &more[1], finer_errors) < separation(p, &tracks[1], errors));
    for (int i = 0; i < 2; i++) chart_track_free(nearer || !pinned ? &tracks[i] : &more[i]);
    if (pinned && !nearer) return status == SBF_OK || error->code == SBF_CODE_BAD_CALL ? SBF_OK : status;
    for (int i = 0; i < 2; i++) tracks[i] = more[i];
    memcpy(errors, finer_errors, sizeof finer_errors);
    *p = finer;
  }
  return status;
}

static sbf_status needed_substeps(const chart_scene *scene, uint32_t *substeps, sbf_diagnostic *error) {
  chart_motion motion;
  const chart_setting own = {.scheme = SBF_SCHEME_SYMPLECTIC};
  sbf_status status = chart_motion_open(&motion, scene, &own, error);
  if (status == SBF_OK) *substeps = sbr_model_get_substeps(motion.model);
  chart_motion_close(&motion);
  return status;
}

static sbf_status find_by_runtime(chart_truth *truth, const chart_case *charted, const chart_scene *scene,
    const sbf_vec3 *rest, uint32_t substeps, sbf_diagnostic *error) {
  chart_track tracks[2] = {{.ticks = 0}, {.ticks = 0}};
  uint32_t needed = 1;
  sbf_status status = needed_substeps(scene, &needed, error);
  while (substeps < 2 * needed && substeps < MAX_SUBSTEPS) substeps *= 2;
  if (substeps > MAX_SUBSTEPS) substeps = MAX_SUBSTEPS;
  reference_pair pair = {
      charted, scene, rest, {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_HEUN}, {substeps, substeps}};
  if (status == SBF_OK) status = refine(&pair, tracks, truth->stated->errors, BODY_ADVICE, error);
  truth->other = tracks[0], truth->track = tracks[1];
  snprintf(truth->stated->what, sizeof truth->stated->what,
      "heun, and symplectic for heun's own rows, %u substeps a frame", (unsigned)pair.substeps[1]);
  return status;
}

sbf_status chart_truth_find(chart_truth *truth, const chart_case *charted, const chart_scene *scene,
    const sbf_vec3 *rest, uint32_t max_substeps, chart_reference *stated, sbf_diagnostic *error) {
  *truth = (chart_truth){.stated = stated};
  if (max_substeps < MIN_SUBSTEPS) max_substeps = MIN_SUBSTEPS;
  bool lattice = scene->asset->soft_bodies.at[0].levels.at[0].model != SBF_ELASTIC_MODEL_SHAPE_MATCHING;
  return charted->in_double && lattice
             ? find_in_double(truth, charted, scene, rest, max_substeps, error)
             : find_by_runtime(truth, charted, scene, rest, 4 * max_substeps, error);
}

static void name_mesh(chart_reference *stated, const chart_scene *scene, uint32_t substeps) {
  snprintf(stated->what, sizeof stated->what, "%u tetrahedra as they are, symplectic, %u substeps a frame",
      (unsigned)chart_all_elements_of(scene->asset), (unsigned)substeps);
}

sbf_status chart_truth_find_mesh(chart_truth *truth, const chart_case *charted, const chart_scene *scene,
    const sbf_vec3 *rest, chart_reference *stated, sbf_diagnostic *error) {
  chart_track tracks[2] = {{.ticks = 0}, {.ticks = 0}};
  uint32_t needed = 0;
  *truth = (chart_truth){.stated = stated};
  sbf_status status = needed_substeps(scene, &needed, error);
  reference_pair pair = {
      charted, scene, rest, {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_SYMPLECTIC}, {needed, 2 * needed}};
  if (status == SBF_OK) status = refine(&pair, tracks, stated->errors, BODY_ADVICE, error);
  chart_track_free(&tracks[0]);
  truth->track = tracks[1];
  name_mesh(stated, scene, pair.substeps[1]);
  return status;
}

sbf_status chart_truth_take_mesh(
    chart_truth *truth, const chart_scene *scene, chart_reference *stated, sbf_diagnostic *error) {
  uint32_t needed = 0;
  *truth = (chart_truth){.stated = stated};
  sbf_status status = needed_substeps(scene, &needed, error);
  if (status == SBF_OK)
    status = check(&truth->track, scene, SBF_SCHEME_SYMPLECTIC, needed, BODY_ADVICE, error);
  memset(stated->errors, 0, sizeof stated->errors);
  name_mesh(stated, scene, needed);
  return status;
}

void chart_truth_free(chart_truth *truth) {
  chart_track_free(&truth->track);
  chart_track_free(&truth->other);
}
