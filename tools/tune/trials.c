#include "tune/trials.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/fault.h"
#include "chart/rounds.h"
#include "sbrun/detail.h"

/* Timed ticks of the walk. */
enum { TIMED_TICKS = 30 };

typedef struct sweep {
  const tune_meshes *meshes;
  const tune_comparison *comparison, *other;
  const tune_effort *effort;
  tune_trials *to;
  sbf_diagnostic *error;
} sweep;

static sbf_status no_memory(const sweep *s) {
  return fault_set(s->error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a sweep");
}

static void report(const sweep *s, const char *what, double fraction) {
  if (s->effort->progress) s->effort->progress(s->effort->user, what, fraction);
}

static tune_trial *add(sweep *s, uint32_t mesh, const chart_setting *setting) {
  tune_trials *t = s->to;
  if (t->count == t->capacity) {
    uint32_t capacity = t->capacity ? 2 * t->capacity : 32;
    tune_trial *more = realloc(t->at, capacity * sizeof *more);
    if (!more) return NULL;
    t->at = more, t->capacity = capacity;
  }
  t->at[t->count] = (tune_trial){.mesh = mesh, .setting = *setting};
  return &t->at[t->count++];
}

static void store_finding(void *user, const sbf_diagnostic *diagnostic) {
  tune_trial *trial = user;
  snprintf(trial->error.why, sizeof trial->error.why, "%.120s", diagnostic->message);
}

/* Cost of a tick without a clock; false, with the reason, if the runtime does not support it. Also rejects
 * what it would report as biased, though more substeps may help. */
static bool count_visits(const sweep *s, tune_trial *trial) {
  const sbf_asset *asset = s->meshes->at[trial->mesh].asset;
  sbr_model_options options = sbr_default_model_options();
  options.scheme = trial->setting.scheme;
  options.substeps = trial->setting.substeps;
  sbr_model *model = NULL;
  sbf_diagnostic why;
  if (sbr_model_create(asset, &options, &model, &why) != SBF_OK) {
    trial->refused = true;
    snprintf(trial->error.why, sizeof trial->error.why, "%.120s", why.message);
    return false;
  }
  sbr_detail_level detail_level;
  sbr_model_get_detail_levels(model, &detail_level, 1);
  trial->visits = (double)detail_level.visits;
  trial->element_visits = chart_visits_of(model, asset, &trial->setting);
  trial->refused = sbr_model_report_scheme_bias(model, store_finding, trial) > 0;
  sbr_model_destroy(model);
  return true;
}

/* The runtime's default first: a setting with as many visits follows the same energy no better, and is
 * skipped. */
static sbf_status plan_mesh(sweep *s, uint32_t mesh) {
  static const sbf_scheme others[] = {
      SBF_SCHEME_POSITION_BASED, SBF_SCHEME_BLOCK_DESCENT, SBF_SCHEME_SYMPLECTIC};
  enum { MAX_SUBSTEPS = 64 };
  tune_trial *own = add(s, mesh, &(chart_setting){.scheme = SBF_SCHEME_AUTOMATIC});
  if (!own) return no_memory(s);
  if (!count_visits(s, own)) return SBF_OK;
  double max = own->visits;
  for (int i = 0; !s->effort->own_scheme_alone && i < 3; i++)
    for (uint32_t n = 1; n <= MAX_SUBSTEPS; n *= 2) {
      tune_trial *one = add(s, mesh, &(chart_setting){.scheme = others[i], .substeps = n});
      if (!one) return no_memory(s);
      if (!count_visits(s, one)) break;
      if (one->visits >= max) {
        s->to->count--;
        break;
      }
    }
  return SBF_OK;
}

static double order_of(const tune_trial *trial) {
  return trial->refused ? INFINITY : trial->visits;
}

/* For equal visits in order of planning. */
static void sort(tune_trials *t) {
  for (uint32_t i = 1; i < t->count; i++) {
    tune_trial one = t->at[i];
    uint32_t at = i;
    for (; at > 0 && order_of(&t->at[at - 1]) > order_of(&one); at--) t->at[at] = t->at[at - 1];
    t->at[at] = one;
  }
}

sbf_status tune_trials_plan(
    const tune_meshes *meshes, const tune_effort *effort, tune_trials *trials, sbf_diagnostic *error) {
  sweep s = {.meshes = meshes, .effort = effort, .to = trials, .error = error};
  sbf_status status = SBF_OK;
  *trials = (tune_trials){.at = NULL};
  for (uint32_t i = 0; status == SBF_OK && i < meshes->count; i++) status = plan_mesh(&s, i);
  sort(trials);
  return status;
}

/* Cases outside both drives had up to 17 % more. */
static const double PROMISED = 1.25;

static double promise_of(double usual, double usual_own, double harsher, double harsher_own) {
  return PROMISED * fmax(usual + usual_own, harsher + harsher_own);
}

static sbf_status drive_harder(sweep *s, bool far, tune_trial *trial) {
  const tune_bar bar = {.error_m = INFINITY, .by = s->effort->by, .far = far};
  const tune_distances *a = &trial->error.off, *b = &trial->other.off, *c = &s->comparison->own,
                       *d = &s->other->own;
  sbf_status status = tune_comparison_measure(
      s->other, s->meshes->at[trial->mesh].asset, &trial->setting, &bar, &trial->other, s->error);
  trial->driven_harder = true;
  trial->promised = (tune_distances){promise_of(a->rms_m, c->rms_m, b->rms_m, d->rms_m),
      promise_of(a->p99_m, c->p99_m, b->p99_m, d->p99_m), promise_of(a->max_m, c->max_m, b->max_m, d->max_m)};
  return status;
}

/* Reason why nothing is stable: that of the file's unchanged mesh. */
static const char *why_not(const sweep *s) {
  uint32_t i = 0;
  while (s->to->at[i].mesh != 0 || s->to->at[i].setting.scheme != SBF_SCHEME_AUTOMATIC) i++;
  return s->to->at[i].driven_harder ? s->to->at[i].other.why : s->to->at[i].error.why;
}

/* Runs one trial with both drives, and adds it to the front if it belongs there: `best` is the smallest
 * promised error on the front. */
static sbf_status hold(sweep *s, uint32_t number, tune_bar *bar, double *best) {
  tune_trial *trial = &s->to->at[number];
  tune_error *is = &trial->error;
  sbf_status status = tune_comparison_measure(
      s->comparison, s->meshes->at[trial->mesh].asset, &trial->setting, bar, is, s->error);
  if (status != SBF_OK || !is->sound) return status;
  bar->first = is->worst_number;
  if (is->beaten) return SBF_OK;
  status = drive_harder(s, bar->far, trial);
  if (status != SBF_OK || !trial->other.sound) return status;
  double promised = tune_distance_by(&trial->promised, s->effort->by);
  bar->error_m = fmin(bar->error_m, tune_distance_by(&is->off, s->effort->by));
  if (!(promised < *best)) return SBF_OK;
  *best = promised;
  trial->on_front = true;
  s->to->front[s->to->front_count++] = number;
  return SBF_OK;
}

/* In order of visits, so promised errors on the front decrease. */
static sbf_status test_each(sweep *s, bool far) {
  tune_trials *t = s->to;
  tune_bar bar = {.error_m = INFINITY, .by = s->effort->by, .far = far};
  double all = 0, done = 0, best = INFINITY;
  sbf_status status = SBF_OK;
  for (uint32_t i = 0; i < t->count; i++) all += t->at[i].refused ? 0 : t->at[i].visits;
  for (uint32_t i = 0; status == SBF_OK && i < t->count && !t->at[i].refused; i++) {
    report(s, "errors", done / all);
    done += t->at[i].visits;
    if (best <= s->effort->enough_m)
      t->at[i].costlier = true;
    else
      status = hold(s, i, &bar, &best);
  }
  return status;
}

/* If all have large errors, the closest is better than none. */
static sbf_status test_all(sweep *s) {
  tune_trials *t = s->to;
  t->front = calloc((size_t)t->count + 1, sizeof *t->front);
  if (!t->front) return no_memory(s);
  sbf_status status = test_each(s, false);
  if (status == SBF_OK && !t->front_count) status = test_each(s, true);
  if (status != SBF_OK || t->front_count) return status;
  fault_set(s->error, SBF_CODE_BAD_CALL,
      "nothing that was tried stays valid in its walk, hop and shake, and neither do its present levels "
      "(%s): make it stiffer or finer; sbfmt chart shows which settings are valid",
      why_not(s));
  return SBF_BAD_INPUT;
}

static void report_times(void *user, double fraction) {
  report(user, "times", fraction);
}

static sbf_status time_front(sweep *s) {
  tune_trials *t = s->to;
  chart_motion *motions = calloc(t->front_count, sizeof *motions);
  chart_timed *timed = calloc(t->front_count, sizeof *timed);
  sbf_status status = motions && timed ? SBF_OK : no_memory(s);
  for (uint32_t i = 0; status == SBF_OK && i < t->front_count; i++) {
    const tune_trial *trial = &t->at[t->front[i]];
    chart_scene scene = chart_scene_of(&s->comparison->cases[0], s->meshes->at[trial->mesh].asset);
    scene.timed_ticks = TIMED_TICKS;
    timed[i] = (chart_timed){.run = chart_motion_run, .context = &motions[i]};
    status = chart_motion_open(&motions[i], &scene, &trial->setting, s->error);
  }
  if (status == SBF_OK && !chart_time_in_turns(timed, t->front_count, s->effort->rounds, report_times, s))
    status = no_memory(s);
  for (uint32_t i = 0; status == SBF_OK && i < t->front_count; i++) {
    const double us = 1e6 / TIMED_TICKS;
    const chart_spread *of = &timed[i].s;
    t->at[t->front[i]].us = (chart_spread){
        us * of->min, us * of->low, us * of->median, us * of->high, us * of->max, of->outliers};
  }
  for (uint32_t i = 0; motions && i < t->front_count; i++) chart_motion_close(&motions[i]);
  free(motions), free(timed);
  return status;
}

sbf_status tune_trials_run(const tune_meshes *meshes, const tune_comparison *comparison,
    const tune_comparison *other, const tune_effort *effort, tune_trials *trials, sbf_diagnostic *error) {
  sweep s = {.meshes = meshes,
      .comparison = comparison,
      .other = other,
      .effort = effort,
      .to = trials,
      .error = error};
  sbf_status status = test_all(&s);
  if (status == SBF_OK) status = time_front(&s);
  return status;
}

void tune_trials_free(tune_trials *trials) {
  free(trials->at);
  free(trials->front);
  *trials = (tune_trials){.at = NULL};
}
