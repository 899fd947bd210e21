#include "tuning_report.h"

#include <math.h>

static const tune_trial *on_front(const tuning *t, uint32_t index) {
  return &t->trials.at[t->trials.front[index]];
}

static void describe_method(const tuning *t, const tune_trial *trial, char *text, size_t size) {
  char steps[24] = "";
  if (trial->setting.substeps)
    snprintf(steps, sizeof steps, ", %u substeps", (unsigned)trial->setting.substeps);
  snprintf(
      text, size, "%s, %s%s", t->meshes.at[trial->mesh].name, sbf_scheme_name(trial->setting.scheme), steps);
}

/* As "0.0151 m (1 % of the size)". */
static void format_length(const tuning *t, double length_m, char *text, size_t size) {
  snprintf(text, size, "%.3g m (%.2g %% of its size)", length_m, 100 * length_m / t->size_m);
}

void tuning_describe_unmet(const tuning *t, char text[TUNING_TEXT]) {
  const tune_trial *near = on_front(t, t->chosen);
  char how[128], asked[48], is[48];
  describe_method(t, near, how, sizeof how);
  double error = tune_distance_by(&near->promised, t->by);
  format_length(t, t->goal.error_m, asked, sizeof asked);
  format_length(t, error, is, sizeof is);
  if (t->verdict == TUNE_TOO_FINE)
    snprintf(text, TUNING_TEXT,
        "nothing that was tried has an error within %s: the most accurate has %s (%s), of which %.2g m is "
        "the error of the reference: allow %.3g m or more, or try finer lattices with --elements and "
        "--reference",
        asked, is, how, tune_distance_by(&t->comparison.own, t->by), error * 1.01);
  else if (t->verdict == TUNE_TOO_CHEAP)
    snprintf(text, TUNING_TEXT,
        "nothing that was tried takes less than %.4g us a tick on this machine: the cheapest takes %.4g us "
        "(%s; error %s): allow more, or try coarser lattices with --elements",
        t->goal.budget_us, near->us.median, how, is);
  else
    snprintf(text, TUNING_TEXT,
        "the cheapest with an error within %s takes %.4g us a tick on this machine (%s), more than %.4g: "
        "allow a larger error or more time",
        asked, near->us.median, how, t->goal.budget_us);
}

/* ---- Text ---- */

static void print_level(const tuning *t, uint32_t number) {
  const tune_trial *trial = t->levels[number].trial;
  char how[128];
  describe_method(t, trial, how, sizeof how);
  const tune_distances *of = &trial->promised;
  printf("  level %u: %s: error %.2e m (RMS), %.2e m (99 of 100 vertices), %.2e m at most; %.0f visits, %.4g "
         "us a tick\n",
      (unsigned)number, how, of->rms_m, of->p99_m, of->max_m, trial->visits, trial->us.median);
}

static void print_harsher(const tuning *t) {
  const tune_error *v = &t->levels[0].trial->other;
  printf("with harsher commands, its first level has an error of %.2e m (RMS), %.2e m (99 of 100 vertices), "
         "%.2e m at most (%s)\n",
      v->off.rms_m, v->off.p99_m, v->off.max_m, v->worst ? v->worst : "nothing measured");
}

static void print_unmeasured(const tune_comparison *comparison, const char *when) {
  for (int i = 0; i < CHART_BUNDLE_CASES; i++)
    if (comparison->unmeasured[i][0])
      printf(
          "not measured%s: its %s, where %s\n", when, comparison->cases[i].name, comparison->unmeasured[i]);
}

void tuning_print(const tuning *t) {
  uint32_t failed = 0, refused = 0, costlier = 0;
  for (uint32_t i = 0; i < t->trials.count; i++) {
    const tune_trial *trial = &t->trials.at[i];
    failed += !trial->refused && !trial->costlier && !trial->error.sound;
    refused += trial->refused, costlier += trial->costlier;
  }
  if (t->meshes.nothing_is_soft) {
    printf("nothing is soft: the skin follows its bones exactly\nwrote %s unchanged\n", t->out);
    return;
  }
  printf("tried %u settings, of which %u failed and %u were refused; %u are on the front of cost and error",
      (unsigned)(t->trials.count - costlier), (unsigned)failed, (unsigned)refused,
      (unsigned)t->trials.front_count);
  if (costlier) printf("; %u that cost more were not tried", (unsigned)costlier);
  printf("\nmeasured against %s of %u elements; by its steps that is off by %.1e m (RMS), %.1e m at most\n",
      t->meshes.reference.name, (unsigned)t->meshes.reference.elements, t->comparison.own.rms_m,
      t->comparison.own.max_m);
  print_unmeasured(&t->comparison, "");
  if (t->meshes.note[0]) printf("no lattices were tried: %s\n", t->meshes.note);
  for (uint32_t i = 0; i < t->level_count; i++) print_level(t, i);
  print_harsher(t);
  print_unmeasured(&t->other, " driven harder");
  printf("wrote %s\n", t->out);
}

/* ---- JSON ---- */

static json_t *number(double value) {
  return isfinite(value) ? json_real(value) : json_null();
}

static json_t *error_json(const tune_error *e) {
  if (!e->sound) return json_pack("{s:b, s:s}", "sound", 0, "why", e->why);
  return json_pack("{s:b, s:f, s:f, s:f, s:s}", "sound", 1, "rms_m", e->off.rms_m, "p99_m", e->off.p99_m,
      "most_m", e->off.max_m, "worst", e->worst ? e->worst : "");
}

static json_t *trial_json(const tuning *t, const tune_trial *trial) {
  const tune_mesh *mesh = &t->meshes.at[trial->mesh];
  json_t *object = json_pack("{s:s, s:i, s:b, s:s, s:i, s:s, s:b}", "model", mesh->name, "elements",
      (int)mesh->elements, "calibrated", (int)mesh->calibrated, "scheme",
      sbf_scheme_name(trial->setting.scheme), "substeps", (int)trial->setting.substeps, "outcome",
      trial->refused        ? "refused"
      : trial->costlier     ? "dearer"
      : !trial->error.sound ? "failed"
      : trial->error.beaten ? "beaten"
                            : "sound",
      "on_front", (int)trial->on_front);
  json_object_set_new(object, "visits", trial->refused ? json_null() : number(trial->visits));
  json_object_set_new(object, "element_visits", trial->refused ? json_null() : number(trial->element_visits));
  json_object_set_new(object, "us_per_tick", trial->on_front ? number(trial->us.median) : json_null());
  json_object_set_new(object, "error", trial->costlier ? json_null() : error_json(&trial->error));
  json_object_set_new(object, "verified", trial->driven_harder ? error_json(&trial->other) : json_null());
  return object;
}

static json_t *level_json(const tuning *t, uint32_t number_of) {
  json_t *object = trial_json(t, t->levels[number_of].trial);
  json_object_set_new(object, "motion_error_m", number(t->levels[number_of].trial->promised.max_m));
  json_object_set_new(object, "motion_error_rms_m", number(t->levels[number_of].trial->promised.rms_m));
  json_object_set_new(object, "motion_error_p99_m", number(t->levels[number_of].trial->promised.p99_m));
  return object;
}

static json_t *motions_json(const tune_comparison *comparison) {
  json_t *list = json_array();
  for (int i = 0; i < CHART_BUNDLE_CASES && comparison->cases[i].name; i++)
    json_array_append_new(list, json_pack("{s:s, s:b, s:s}", "name", comparison->cases[i].name, "measured",
                                    (int)!comparison->unmeasured[i][0], "why", comparison->unmeasured[i]));
  return list;
}

static json_t *asked(double value) {
  return value > 0 ? json_real(value) : json_null();
}

json_t *tuning_json(const tuning *t) {
  static const char *const verdicts[] = {"met", "error too small", "budget too small", "not both"};
  json_t *trials = json_array(), *levels = json_array();
  for (uint32_t i = 0; i < t->trials.count; i++)
    json_array_append_new(trials, trial_json(t, &t->trials.at[i]));
  for (uint32_t i = 0; t->written && i < t->level_count; i++) json_array_append_new(levels, level_json(t, i));
  json_t *object =
      json_pack("{s:s, s:s, s:b, s:s, s:s, s:s}", "file", t->path, "out", t->out, "written", (int)t->written,
          "verdict", verdicts[t->verdict], "measure", tune_by_names[t->by], "note", t->meshes.note);
  json_object_set_new(object, "error_asked_m", asked(t->goal.error_m));
  json_object_set_new(object, "error_asked_percent", asked(t->error_percent));
  json_object_set_new(object, "size_m", asked(t->size_m));
  json_object_set_new(object, "budget_asked_us", asked(t->goal.budget_us));
  json_object_set_new(object, "reference",
      json_pack("{s:s, s:i, s:f, s:f, s:o}", "model", t->meshes.reference.name, "elements",
          (int)t->meshes.reference.elements, "rms_m", t->comparison.own.rms_m, "most_m",
          t->comparison.own.max_m, "motions", motions_json(&t->comparison)));
  json_object_set_new(
      object, "nearest", t->trials.front_count ? trial_json(t, on_front(t, t->chosen)) : json_null());
  json_object_set_new(object, "trials", trials);
  json_object_set_new(object, "levels", levels);
  json_object_set_new(object, "verified", json_pack("{s:o}", "motions", motions_json(&t->other)));
  json_object_set_new(object, "machine",
      json_pack("{s:s, s:s, s:s, s:i, s:s}", "commit", t->machine.commit, "compiler", t->machine.compiler,
          "processor", t->machine.processor, "lanes", (int)t->machine.lanes, "date", t->machine.date));
  return object;
}
