#include "chart/sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/fault.h"
#include "chart/reference.h"
#include "chart/rounds.h"

static const double TICK_S = 1.0 / 60;
/* Larger path errors, relative to the reference's displacement, count as failures. */
static const double LOST = 3;

typedef struct sweep {
  const chart_case *charted;
  const chart_effort *effort;
  chart_sheet *sheet;
  chart_motion *motions; /* (rows) */
  uint32_t motion_capacity;
} sweep;

static sbf_status no_memory(sbf_diagnostic *error) {
  return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a chart");
}

static void report(const sweep *s, const char *what, double fraction) {
  if (s->effort->progress) s->effort->progress(s->effort->user, what, fraction);
}

static void to_pixels(const sweep *s, double errors[CHART_AXIS_COUNT]) {
  double pixels = chart_pixels_a_metre(s->effort->distance_m);
  if (!(s->charted->axes & 1u << CHART_PIXELS)) return;
  errors[CHART_PIXELS] = pixels * errors[CHART_PATH];
  errors[CHART_MAX_PIXELS] = pixels * errors[CHART_FARTHEST];
}

static bool check(
    const sweep *s, chart_row *row, chart_motion *motion, const chart_truth *truth, const sbf_vec3 *rest) {
  chart_track track;
  const chart_track *reference = chart_truth_for(truth, row->setting.scheme);
  if (!chart_motion_sample(motion, &track)) return false;
  unsigned asked = s->charted->axes;
  bool good = chart_errors_of(
      &track, reference, rest, TICK_S, &s->charted->signal, asked | 1u << CHART_PATH, row->errors);
  row->sound = track.sound;
  snprintf(row->why, sizeof row->why, "%s", track.why);
  if (row->sound && !(row->errors[CHART_PATH] < LOST * chart_extent_of(reference, rest))) {
    row->sound = false;
    snprintf(row->why, sizeof row->why, "farther off than anything moves");
  }
  to_pixels(s, row->errors);
  if (!(asked & 1u << CHART_PATH)) row->errors[CHART_PATH] = NAN;
  chart_track_free(&track);
  return good;
}

static sbf_status add_row(sweep *s, const chart_subject *subject, const chart_scene *scene,
    const chart_setting *setting, const chart_truth *truth, const sbf_vec3 *rest, sbf_diagnostic *error) {
  chart_row *row = chart_sheet_add_row(s->sheet);
  if (!row) return no_memory(error);
  if (s->sheet->row_space > s->motion_capacity) {
    chart_motion *more = realloc(s->motions, s->sheet->row_space * sizeof *more);
    if (!more) return no_memory(error);
    s->motions = more, s->motion_capacity = s->sheet->row_space;
  }
  chart_motion *motion = &s->motions[s->sheet->row_count - 1];
  sbf_diagnostic why;
  *motion = (chart_motion){.begin = NULL};
  snprintf(row->model, sizeof row->model, "%s", subject->model);
  snprintf(row->scheme, sizeof row->scheme, "%s",
      s->charted->of_space ? subject->line : sbf_scheme_name(setting->scheme));
  row->setting = *setting;
  row->elements = chart_all_elements_of(subject->asset);
  row->runs_us = calloc(s->effort->rounds, sizeof *row->runs_us);
  sbf_status status = chart_motion_open(motion, scene, setting, &why);
  row->refused = status != SBF_OK;
  if (row->refused) {
    snprintf(row->why, sizeof row->why, "%.120s", why.message);
    chart_motion_close(motion);
    return row->runs_us ? SBF_OK : no_memory(error);
  }
  bool checked = row->runs_us && check(s, row, motion, truth, rest);
  row->visits = motion->visits;
  return checked ? SBF_OK : no_memory(error);
}

/* Runs all settings of all schemes; `springs` support one more scheme. */
static sbf_status sweep_schemes(sweep *s, const chart_subject *subject, const chart_scene *scene,
    const chart_truth *truth, const sbf_vec3 *rest, sbf_diagnostic *error) {
  static const sbf_scheme by_substeps[] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_HEUN,
      SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_BLOCK_DESCENT};
  static const float tolerances_m[] = {1e-2f, 1e-3f, 1e-4f, 1e-5f, 1e-6f};
  sbf_status status = SBF_OK;
  for (int i = 0; i < 5; i++)
    for (uint32_t n = 1; status == SBF_OK && n <= s->effort->max_substeps; n *= 2) {
      const chart_setting setting = {.scheme = by_substeps[i], .substeps = n};
      status = add_row(s, subject, scene, &setting, truth, rest, error);
      /* A scheme unsupported at one number of substeps is unsupported at all. */
      if (status == SBF_OK && s->sheet->rows[s->sheet->row_count - 1].refused) break;
    }
  for (int i = 0; status == SBF_OK && i < 5; i++) {
    const chart_setting setting = {.scheme = SBF_SCHEME_HEUN, .step_error_m = tolerances_m[i]};
    status = add_row(s, subject, scene, &setting, truth, rest, error);
  }
  const chart_setting relaxation = {.scheme = SBF_SCHEME_RELAXATION, .substeps = 1};
  const chart_setting automatic = {.scheme = SBF_SCHEME_AUTOMATIC};
  if (status == SBF_OK) status = add_row(s, subject, scene, &relaxation, truth, rest, error);
  if (status == SBF_OK) status = add_row(s, subject, scene, &automatic, truth, rest, error);
  return status;
}

static sbf_status state_reference(
    sweep *s, const chart_subject *subject, chart_reference **stated, sbf_diagnostic *error) {
  *stated = chart_sheet_add_reference(s->sheet);
  if (!*stated) return no_memory(error);
  snprintf((*stated)->model, sizeof(*stated)->model, "%s", subject->model);
  report(s, "reference", 0);
  return SBF_OK;
}

static sbf_status sweep_subject(sweep *s, const chart_subject *subject, sbf_diagnostic *error) {
  const chart_scene scene = chart_scene_of(s->charted, subject->asset);
  chart_truth truth = {.stated = NULL};
  chart_reference *stated;
  sbf_vec3 *rest = chart_motion_begins(&scene);
  sbf_status status = rest ? state_reference(s, subject, &stated, error) : no_memory(error);
  if (status == SBF_OK)
    status = chart_truth_find(&truth, s->charted, &scene, rest, s->effort->max_substeps, stated, error);
  if (status == SBF_OK) to_pixels(s, stated->errors);
  report(s, "errors", 0);
  if (status == SBF_OK) status = sweep_schemes(s, subject, &scene, &truth, rest, error);
  chart_truth_free(&truth);
  free(rest);
  return status;
}

/* Meshes of one body: the first is the reference of the others. */
static sbf_status sweep_meshes(
    sweep *s, const chart_subject *subjects, uint32_t count, sbf_diagnostic *error) {
  const chart_setting own = {.scheme = SBF_SCHEME_AUTOMATIC};
  chart_scene scene = chart_scene_of(s->charted, subjects[0].asset);
  chart_truth truth = {.stated = NULL};
  chart_reference *stated;
  sbf_vec3 *rest = chart_motion_begins(&scene);
  sbf_status status = rest ? state_reference(s, &subjects[0], &stated, error) : no_memory(error);
  if (status == SBF_OK) status = chart_truth_find_mesh(&truth, s->charted, &scene, rest, stated, error);
  report(s, "errors", 0);
  for (uint32_t i = 1; status == SBF_OK && i < count; i++) {
    scene = chart_scene_of(s->charted, subjects[i].asset);
    status = add_row(s, &subjects[i], &scene, &own, &truth, rest, error);
  }
  chart_truth_free(&truth);
  free(rest);
  return status;
}

static void report_fraction(void *user, double fraction) {
  report(user, "times", fraction);
}

static sbf_status time_rows(sweep *s, sbf_diagnostic *error) {
  uint32_t rounds = s->effort->rounds, count = 0;
  chart_timed *timed = calloc(s->sheet->row_count + 1, sizeof *timed);
  if (!timed) return no_memory(error);
  for (uint32_t i = 0; i < s->sheet->row_count; i++)
    if (!s->sheet->rows[i].refused)
      timed[count++] = (chart_timed){
          .run = chart_motion_run, .context = &s->motions[i], .times = s->sheet->rows[i].runs_us};
  bool good = count == 0 || chart_time_in_turns(timed, count, rounds, report_fraction, s);
  uint32_t next = 0;
  double us = 1e6 / (s->charted->timed_ticks ? s->charted->timed_ticks : s->charted->ticks);
  for (uint32_t i = 0; good && i < s->sheet->row_count; i++) {
    chart_row *row = &s->sheet->rows[i];
    if (row->refused) continue;
    chart_spread *t = &timed[next++].s;
    row->us =
        (chart_spread){us * t->min, us * t->low, us * t->median, us * t->high, us * t->max, t->outliers};
    for (uint32_t r = 0; r < rounds; r++) row->runs_us[r] *= us;
  }
  free(timed);
  return good ? SBF_OK : no_memory(error);
}

/* The character from a file is the only body of its case. */
static sbf_status take(
    const chart_case *charted, uint32_t number, chart_subject *subject, sbf_diagnostic *error) {
  if (number) return SBF_OK;
  subject->asset = sbf_asset_clone(charted->given, NULL);
  snprintf(subject->model, sizeof subject->model, "as built");
  return subject->asset ? SBF_OK : no_memory(error);
}

sbf_status chart_sweep(
    const chart_case *charted, const chart_effort *effort, chart_sheet *sheet, sbf_diagnostic *error) {
  enum { MAX_SUBJECTS = 32 };
  sweep s = {.charted = charted, .effort = effort, .sheet = sheet};
  chart_subject subjects[MAX_SUBJECTS] = {{.asset = NULL}};
  sbf_status status = SBF_OK;
  uint32_t count = 0;
  *sheet = (chart_sheet){
      .name = charted->name, .title = charted->title, .axes = charted->axes, .rounds = effort->rounds};
  for (uint32_t i = 0; status == SBF_OK && i < MAX_SUBJECTS; i++) {
    status = charted->given ? take(charted, i, &subjects[i], error) : charted->make(i, &subjects[i], error);
    if (status != SBF_OK || !subjects[i].asset) break;
    count++;
    if (!charted->of_space) status = sweep_subject(&s, &subjects[i], error);
  }
  if (status == SBF_OK && charted->of_space) status = sweep_meshes(&s, subjects, count, error);
  if (status == SBF_OK) status = time_rows(&s, error);
  for (uint32_t i = 0; i < sheet->row_count && i < s.motion_capacity; i++)
    if (!sheet->rows[i].refused) chart_motion_close(&s.motions[i]);
  free(s.motions);
  for (uint32_t i = 0; i < MAX_SUBJECTS; i++) sbf_asset_free(subjects[i].asset);
  return status;
}
