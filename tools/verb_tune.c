/* sbfmt tune: finds the cheapest levels within an error, or the most accurate within a budget. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "chart/out_folder.h"
#include "chart/rounds.h"
#include "output_name.h"
#include "saving.h"
#include "sbfmt/io.h"
#include "tune/fitted_mesh.h"
#include "tune/forecast.h"
#include "tuning_report.h"

static void show(void *user, const char *what, double fraction) {
  (void)user;
  cli_progress(what, fraction);
}
/* `user` names the drive. */
static void show_reference(void *user, const char *motion, uint32_t substeps, double fraction) {
  char what[96];
  snprintf(what, sizeof what, "%s: %s by %u substeps", (const char *)user, motion, (unsigned)substeps);
  cli_progress(what, fraction);
}

typedef struct request {
  tune_grid grid;
  tune_effort effort;
  bool on_one_core;
  bool nearest; /* written even if nothing meets the goal */
} request;

/* Default goal relative to the size. */
static const double USUAL_PERCENT = 1;

/* Metres, or a percentage of the size, which is known later; both 0: the most accurate. */
static bool read_error(const cli_call *call, tuning *t) {
  const char *text = cli_value(call, "--error");
  if (!text) {
    if (!cli_value(call, "--budget")) t->error_percent = USUAL_PERCENT;
    return true;
  }
  char *end;
  double value = strtod(text, &end);
  bool percent = end != text && strcmp(end, "%") == 0;
  if (end == text || (*end && !percent) || !(value >= 0 && value <= (percent ? 100 : 1e6)))
    return cli_wrong(call,
               "--error takes metres or a percentage of the size, for example 0.01 or 1%%, not '%s'; 0 "
               "selects the most accurate",
               text),
           false;
  *(percent ? &t->error_percent : &t->goal.error_m) = value;
  return true;
}

static bool read_sizes(const cli_call *call, tune_grid *grid) {
  int at = 0;
  const char *text;
  while ((text = cli_next_value(call, "--elements", &at)) != NULL) {
    char *end;
    long size = strtol(text, &end, 10);
    if (end == text || *end || size < 1 || size > 100000)
      return cli_wrong(call, "--elements takes a whole number from 1 to 100000, not '%s'", text), false;
    if (grid->size_count == TUNE_MAX_SIZES)
      return cli_wrong(call, "--elements may be repeated at most %d times", (int)TUNE_MAX_SIZES), false;
    grid->sizes[grid->size_count++] = (uint32_t)size;
  }
  return true;
}

static bool parse(cli_call *call, tuning *t, request *r) {
  long rounds = 7, reference = 0, core = 0;
  int measure = 0;
  bool quick = cli_switch(call, "--quick");
  t->path = call->inputs[0];
  t->out = cli_value(call, "-o");
  if (!t->out) return cli_wrong(call, "state the output: -o FILE"), false;
  if (!output_name_of_bundle(call, "-o") || !read_error(call, t) ||
      !cli_number(call, "--budget", 1e-3, 1e9, &t->goal.budget_us) ||
      !cli_word(call, "--measure", tune_by_names, TUNE_BY_COUNT, &measure) ||
      !cli_integer(call, "--runs", 1, 10000, &rounds) ||
      !cli_integer(call, "--reference", 12, 100000, &reference) ||
      !cli_integer(call, "--core", 0, 1023, &core) || !read_sizes(call, &r->grid))
    return false;
  /* A bound in metres applies to every vertex; one in percent of the size to the 99th percentile. */
  t->by = cli_value(call, "--measure") ? (tune_by)measure : t->error_percent > 0 ? TUNE_BY_P99 : TUNE_BY_MAX;
  r->nearest = cli_switch(call, "--nearest");
  r->grid.reference = (uint32_t)reference;
  r->grid.coarse = r->grid.calibrated_alone = quick;
  r->grid.progress = show;
  r->effort =
      (tune_effort){.own_scheme_alone = quick, .by = t->by, .rounds = (uint32_t)rounds, .progress = show};
  r->on_one_core = chart_stay_on_core((uint32_t)core);
  if (!r->on_one_core && cli_value(call, "--core"))
    return cli_wrong(call, "this process cannot run on core %ld: use a lower number", core), false;
  return true;
}

/* Prints the plan and its estimated duration. */
static sbf_status announce(const cli_call *call, const tuning *t, sbf_diagnostic *error) {
  tune_forecast forecast;
  char time[48];
  sbf_status status = tune_forecast_make(&t->meshes, &t->trials, &forecast, error);
  if (status != SBF_OK || call->json) return status;
  tune_forecast_say(&forecast, time, sizeof time);
  cli_progress_end();
  fprintf(stderr,
      "sbfmt tune: info: %u ways to step %u meshes, against %u elements: %s on a core of its own\n",
      (unsigned)t->trials.count, (unsigned)t->meshes.count, (unsigned)t->meshes.reference.elements, time);
  return SBF_OK;
}

/* The finest lattice to try, if it has at least half of the reference's elements; NULL: there is none. */
static const sbf_asset *half_reference(const tune_meshes *meshes) {
  const tune_mesh *finest = NULL;
  for (uint32_t i = 0; i < meshes->count; i++) {
    const tune_mesh *mesh = &meshes->at[i];
    if (mesh->calibrated && 2 * mesh->asked >= meshes->reference.asked &&
        (!finest || mesh->asked > finest->asked))
      finest = mesh;
  }
  return finest && meshes->reference.asked ? finest->asset : NULL;
}

static sbf_status create_comparisons(tuning *t, sbf_diagnostic *error) {
  static char of_this[] = "reference", of_other[] = "harsher drive";
  const tune_measure measure = {.by = t->by, .progress = show_reference, .user = of_this};
  const tune_measure harsher = {.drive = &tune_harsher_drive,
      .by = t->by,
      .may_be_empty = true,
      .progress = show_reference,
      .user = of_other};
  sbf_status status = tune_comparison_create(&t->comparison, t->meshes.reference.asset, &measure, error);
  if (status != SBF_OK && error->code == SBF_CODE_BAD_CALL && tune_meshes_trust_own(&t->meshes)) {
    tune_comparison_free(&t->comparison);
    status = tune_comparison_create(&t->comparison, t->meshes.reference.asset, &measure, error);
  }
  if (status == SBF_OK)
    status = tune_comparison_create(&t->other, t->meshes.reference.asset, &harsher, error);
  const sbf_asset *half = half_reference(&t->meshes);
  if (status == SBF_OK && half) status = tune_comparison_check_resolution(&t->other, half, error);
  return status;
}

/* Adds the file's own levels with a stiffness fitted to the reference, and plans again. */
static sbf_status add_fitted(tuning *t, const request *r, sbf_diagnostic *error) {
  const tune_fit fit = {.drives = {&t->comparison, &t->other}, .drive_count = 2};
  sbf_status status = SBF_OK;
  for (uint32_t i = 0, count = t->meshes.count; status == SBF_OK && i < count; i++) {
    if (t->meshes.count == TUNE_MAX_MESHES) break;
    if (t->meshes.at[i].asked) continue;
    status = tune_fit_mesh(&t->meshes.at[i], &fit, &t->meshes.at[t->meshes.count], error);
    t->meshes.count += t->meshes.at[t->meshes.count].asset != NULL;
  }
  if (status != SBF_OK) return status;
  tune_trials_free(&t->trials);
  return tune_trials_plan(&t->meshes, &r->effort, &t->trials, error);
}

static sbf_status sweep(cli_call *call, tuning *t, request *r, sbf_diagnostic *error) {
  sbf_asset *asset;
  sbf_status status = sbf_load_file(
      t->path, &(sbf_load_options){.check_crc = true, .report = cli_report, .user = call}, &asset, error);
  if (status != SBF_OK) return status;
  status = tune_meshes_make(asset, &r->grid, &t->meshes, error);
  sbf_asset_free(asset);
  if (status != SBF_OK || t->meshes.nothing_is_soft) return status;
  t->size_m = tune_size_of(t->meshes.base);
  if (t->error_percent > 0) t->goal.error_m = t->error_percent / 100 * t->size_m;
  r->effort.enough_m = t->goal.budget_us > 0 ? 0 : t->goal.error_m;
  status = tune_trials_plan(&t->meshes, &r->effort, &t->trials, error);
  if (status == SBF_OK) status = announce(call, t, error);
  if (status == SBF_OK) status = create_comparisons(t, error);
  if (status == SBF_OK) status = add_fitted(t, r, error);
  if (status == SBF_OK)
    status = tune_trials_run(&t->meshes, &t->comparison, &t->other, &r->effort, &t->trials, error);
  return status;
}

static bool choose(tuning *t) {
  tune_offer *offers = calloc((size_t)t->trials.front_count + 1, sizeof *offers);
  if (!offers) return false;
  for (uint32_t i = 0; i < t->trials.front_count; i++) {
    const tune_trial *trial = &t->trials.at[t->trials.front[i]];
    offers[i] = (tune_offer){tune_distance_by(&trial->promised, t->by), trial->us.median};
  }
  t->verdict = tune_choose(offers, t->trials.front_count, &t->goal, &t->chosen);
  free(offers);
  return true;
}

/* The chosen one first, and cheaper ones after it. */
static void use_levels(tuning *t) {
  for (uint32_t i = t->chosen + 1; i-- > 0 && t->level_count < TUNE_MAX_MESHES;) {
    const tune_trial *trial = &t->trials.at[t->trials.front[i]];
    t->levels[t->level_count++] = (tune_level){&t->meshes.at[trial->mesh], trial};
  }
}

/* Settings as stored in a derivation, in alphabetical order. */
static void format_settings(const tuning *t, char *text, size_t size) {
  char budget[32] = "", error[32] = "";
  if (t->goal.budget_us > 0) snprintf(budget, sizeof budget, "budget_us=%.9g ", t->goal.budget_us);
  if (t->goal.error_m > 0) snprintf(error, sizeof error, "error_m=%.9g ", t->goal.error_m);
  snprintf(text, size, "%s%smeasure=%s reference=%u", budget, error, tune_by_names[t->by],
      (unsigned)t->meshes.reference.asked);
}

static sbf_status make(tuning *t, sbf_asset **made, sbf_diagnostic *error) {
  char settings[160], machine[224];
  format_settings(t, settings, sizeof settings);
  snprintf(machine, sizeof machine, "%s, %s", t->machine.processor, t->machine.compiler);
  return tune_levels_write(t->meshes.base, t->levels, t->level_count, settings, machine, made, error);
}

/* Returns the exit status; prints why nothing is written. */
static int write_out(const cli_call *call, tuning *t) {
  sbf_asset *made = NULL;
  sbf_diagnostic error;
  sbf_status status = SBF_OK;
  if (t->meshes.nothing_is_soft) {
    made = sbf_asset_clone(t->meshes.base, NULL);
    if (!made) return cli_wrong(call, "memory ran out");
  } else {
    use_levels(t);
    status = make(t, &made, &error);
  }
  cli_progress_end();
  if (status != SBF_OK) cli_print_diagnostic(call, &error);
  int saved = status == SBF_OK ? saving_run(call, t->path, t->out, made, NULL) : (int)status;
  t->written = saved == SBF_OK;
  sbf_asset_free(made);
  return saved;
}

static void print_unmet(const cli_call *call, const tuning *t, const request *r) {
  char text[TUNING_TEXT];
  tuning_describe_unmet(t, text);
  if (r->nearest)
    fprintf(stderr, "sbfmt tune: warning: %s; that is written\n", text);
  else
    cli_wrong(call, "%s; write that with --nearest", text);
}

static int finish(cli_call *call, tuning *t, const request *r) {
  if (!t->meshes.nothing_is_soft && !choose(t)) return cli_wrong(call, "memory ran out");
  bool reached = t->meshes.nothing_is_soft || t->verdict == TUNE_MET, writes = reached || r->nearest;
  int saved = writes ? write_out(call, t) : SBF_OK;
  cli_progress_end();
  if (!reached) print_unmet(call, t, r);
  if (saved != SBF_OK) return saved;
  if (call->json) return cli_print_json(tuning_json(t), writes ? SBF_OK : SBF_BAD_INPUT);
  if (!writes) return SBF_BAD_INPUT;
  tuning_print(t);
  if (!r->on_one_core) printf("times are not of one core: this system does not keep a process on one\n");
  return SBF_OK;
}

static int run(cli_call *call) {
  request r = {.on_one_core = false};
  tuning *t = calloc(1, sizeof *t);
  sbf_diagnostic error;
  if (!t) return cli_wrong(call, "memory ran out");
  t->machine = chart_this_machine();
  int status = SBF_FAILED;
  if (parse(call, t, &r)) {
    status = (int)chart_check_writable(t->out, &error); /* checked before minutes of work */
    if (status == SBF_OK) status = (int)sweep(call, t, &r, &error);
    cli_progress_end();
    if (status == SBF_OK)
      status = finish(call, t, &r);
    else
      cli_print_diagnostic(call, &error);
  }
  tune_trials_free(&t->trials);
  tune_comparison_free(&t->comparison);
  tune_comparison_free(&t->other);
  tune_meshes_free(&t->meshes);
  free(t);
  return status;
}

static const cli_option options[] = {{"-o", "OUT.sbf[z]", "output file; the ending selects XML or packed"},
    {"--error", "METRES|PERCENT%",
        "maximum error of the skin, in metres or of the largest extent: the cheapest within it becomes level "
        "0; 0 selects the most accurate (1%, without a budget)"},
    {"--budget", "MICROSECONDS",
        "maximum time of a tick on one core of this machine: the most accurate within it becomes level 0"},
    {"--nearest", NULL, "write the closest result if nothing reaches the goal"},
    {"--measure", "most|p99|rms",
        "measure of the error: the worst vertex, the 99th percentile of vertices, or the root mean square "
        "(p99 for a percentage, else most)"},
    {"--elements", "N", "tetrahedra per body of a lattice to try; repeatable"},
    {"--reference", "N", "tetrahedra per body of the reference (12000 in all)"},
    {"--quick", NULL,
        "try less: a coarser reference, only calibrated lattices and the runtime's default scheme"},
    {"--runs", "N", "number of runs; the median time counts (7)"},
    {"--core", "N", "processor core to run on, of those allowed, from 0 (0)"},
    {"--format", "text|json", "how to report (text)"}, {NULL, NULL, NULL}};

const cli_verb verb_tune = {"tune", "FILE [--error METRES|PERCENT%] [--budget MICROSECONDS] -o OUT",
    "find the cheapest levels with a small enough error",
    "Tries the file's own levels and lattices of several sizes, calibrated and as they are, by several "
    "schemes "
    "and\n"
    "numbers of substeps; runs each through the character's own walk, hop and shake, and measures how far "
    "its "
    "skin is\n"
    "off a fine lattice's and what a tick costs. What nothing else beats in both is run by harsher commands "
    "as "
    "well\n"
    "(higher hops, turns of 12 rad/s; both drives slower for characters above 2 m), and promises a quarter "
    "more than the larger error of both. OUT has as "
    "level 0 "
    "what the\n"
    "goal asks for, and behind it what is cheaper, each with its measured error and cost, by which the "
    "runtime "
    "changes\n"
    "levels. What costs more than the first that keeps the error is not tried. Errors include what the "
    "reference is off itself by its steps.\n\n"
    "An error or a budget that nothing keeps is told with the closest that can be had, with status 1, and "
    "nothing is written; --nearest writes that, with status 0. A character without anything soft is written "
    "as it is.",
    options, 1, 1, run};
