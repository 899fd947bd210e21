/* sbfmt chart: error against time of every scheme, on known cases and on a character's own motion. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fault.h"
#include "chart/bundle_case.h"
#include "chart/drawing.h"
#include "chart/rounds.h"
#include "chart/sweep.h"
#include "chart/table.h"
#include "chart/table_reader.h"
#include "chart_maps.h"
#include "cli.h"
#include "sbfmt/io.h"

/* Options of the call. */
typedef struct request {
  const char *path;
  sbf_asset *asset; /* of the file, if any */
  chart_bundle bundle;
  chart_case bundle_cases[CHART_BUNDLE_CASES];
  const chart_case *all; /* available cases */
  uint32_t all_count;
  const chart_case **cases;
  uint32_t case_count;
  chart_effort effort;
  chart_machine machine;
  bool drawn, on_one_core;
  chart_sheet *sheets; /* (case_count) */
  const chart_case *now;
} request;

static void show_progress(void *user, const char *what, double fraction) {
  const request *r = user;
  char text[96];
  snprintf(text, sizeof text, "%s: %s", r->now->name, what);
  cli_progress(text, fraction);
}

static const chart_case *case_named(const request *r, const char *name) {
  for (uint32_t i = 0; i < r->all_count; i++)
    if (strcmp(r->all[i].name, name) == 0) return &r->all[i];
  return NULL;
}

/* The cases in --case, or all: of the file, if any. */
static bool choose_cases(cli_call *call, request *r) {
  int at = 0;
  const char *name;
  r->cases = calloc((size_t)r->all_count + 1, sizeof *r->cases);
  if (!r->cases) return cli_wrong(call, "memory ran out"), false;
  while ((name = cli_next_value(call, "--case", &at)) != NULL) {
    const chart_case *found = case_named(r, name);
    bool known = false;
    for (uint32_t i = 0; i < r->case_count; i++) known = known || r->cases[i] == found;
    if (found && !known) r->cases[r->case_count++] = found;
    if (found) continue;
    fprintf(stderr, "sbfmt chart: error: --case takes one of");
    for (uint32_t i = 0; i < r->all_count; i++) fprintf(stderr, "%s %s", i ? "," : "", r->all[i].name);
    fprintf(stderr, "%s, not '%s'\n", r->asset ? " where a file is given" : "", name);
    return false;
  }
  for (uint32_t i = 0; !cli_value(call, "--case") && i < r->all_count; i++)
    r->cases[r->case_count++] = &r->all[i];
  return true;
}

/* Finds the available cases: SBF_OK, or the exit status, with a message printed. */
static int gather_cases(cli_call *call, request *r) {
  sbf_diagnostic error;
  r->all = chart_cases, r->all_count = chart_case_count;
  if (!call->input_count) return SBF_OK;
  sbf_status status = sbf_load_file(
      call->inputs[0], &(sbf_load_options){.report = cli_report, .user = call}, &r->asset, &error);
  if (status == SBF_OK) status = chart_bundle_cases(r->asset, NULL, &r->bundle, r->bundle_cases, &error);
  if (status != SBF_OK) cli_print_diagnostic(call, &error);
  r->all = r->bundle_cases, r->all_count = CHART_BUNDLE_CASES;
  return (int)status;
}

static bool parse(cli_call *call, request *r) {
  long rounds = 15, max = 128, core = 0;
  r->effort.distance_m = 5;
  r->path = cli_value(call, "-o");
  if (!choose_cases(call, r) || !cli_integer(call, "--runs", 1, 10000, &rounds) ||
      !cli_integer(call, "--most-substeps", 1, 1024, &max) || !cli_integer(call, "--core", 0, 1023, &core) ||
      !cli_number(call, "--distance", 0.01, 1e6, &r->effort.distance_m))
    return false;
  if (!r->path && !cli_switch(call, "--jobs"))
    return cli_wrong(call, "state the output folder: -o DIR"), false;
  r->effort = (chart_effort){.rounds = (uint32_t)rounds,
      .distance_m = r->effort.distance_m,
      .max_substeps = (uint32_t)max,
      .progress = show_progress,
      .user = r};
  r->drawn = !cli_switch(call, "--no-svg");
  if (cli_switch(call, "--jobs")) return true;
  r->on_one_core = chart_stay_on_core((uint32_t)core);
  if (!r->on_one_core && cli_value(call, "--core"))
    return cli_wrong(call, "this process cannot run on core %ld: use a lower number", core), false;
  return true;
}

/* One line per case, so that a batch can run them in parallel. */
static int print_jobs(const cli_call *call, const request *r) {
  const char *path = r->path ? r->path : "charts";
  for (uint32_t i = 0; i < r->case_count; i++)
    printf("sbfmt chart%s%s%s --case %s --runs %u --most-substeps %u --distance %g%s -o '%s'\n",
        call->input_count ? " '" : "", call->input_count ? call->inputs[0] : "", call->input_count ? "'" : "",
        r->cases[i]->name, (unsigned)r->effort.rounds, (unsigned)r->effort.max_substeps, r->effort.distance_m,
        r->drawn ? "" : " --no-svg", path);
  return SBF_OK;
}

/* Tables first: they stay if gnuplot is missing. */
static int write_all(cli_call *call, const request *r) {
  chart_folder folder;
  sbf_diagnostic error, undrawn;
  sbf_status status = chart_folder_begin(&folder, r->path, &error), drawn = SBF_OK;
  for (uint32_t i = 0; status == SBF_OK && i < r->case_count; i++)
    status = chart_table_write(&r->sheets[i], &r->machine, &folder, &error);
  for (uint32_t i = 0; status == SBF_OK && r->drawn && drawn == SBF_OK && i < r->case_count; i++)
    drawn = chart_draw(&r->sheets[i], &r->machine, &folder, &undrawn);
  if (status == SBF_OK) status = chart_folder_commit(&folder, &error);
  chart_folder_abandon(&folder);
  if (status != SBF_OK) cli_print_diagnostic(call, &error);
  if (drawn != SBF_OK) cli_print_diagnostic(call, &undrawn);
  return status != SBF_OK ? (int)status : (int)drawn;
}

/* ---- Reports ---- */

static json_t *number(double value) {
  return isfinite(value) ? json_real(value) : json_null();
}

static json_t *errors_json(unsigned axes, const double *errors) {
  json_t *object = json_object();
  for (int i = 0; i < CHART_AXIS_COUNT; i++)
    if (axes & 1u << i) json_object_set_new(object, chart_axis_names[i], number(errors[i]));
  return object;
}

static json_t *sheet_json(const chart_sheet *s) {
  json_t *rows = json_array(), *references = json_array();
  for (uint32_t i = 0; i < s->row_count; i++) {
    const chart_row *row = &s->rows[i];
    json_t *one = json_pack("{s:s, s:s, s:i, s:f, s:i, s:s, s:s}", "model", row->model, "scheme", row->scheme,
        "substeps", (int)row->setting.substeps, "step_error_m", (double)row->setting.step_error_m, "elements",
        (int)row->elements, "outcome",
        row->refused ? "refused"
        : row->sound ? "sound"
                     : "failed",
        "why", row->why);
    json_object_set_new(one, "visits_per_frame", number(row->visits));
    json_object_set_new(one, "us_per_frame", row->refused ? json_null() : number(row->us.median));
    json_object_set_new(one, "errors", errors_json(s->axes, row->errors));
    json_array_append_new(rows, one);
  }
  for (uint32_t i = 0; i < s->reference_count; i++)
    json_array_append_new(
        references, json_pack("{s:s, s:s, s:o}", "model", s->references[i].model, "what",
                        s->references[i].what, "errors", errors_json(s->axes, s->references[i].errors)));
  return json_pack(
      "{s:s, s:s, s:o, s:o}", "name", s->name, "title", s->title, "references", references, "rows", rows);
}

static int print_json(const request *r, int status) {
  json_t *cases = json_array();
  for (uint32_t i = 0; i < r->case_count; i++) json_array_append_new(cases, sheet_json(&r->sheets[i]));
  return cli_print_json(json_pack("{s:s, s:s, s:s, s:i, s:s, s:s, s:b, s:i, s:o}", "folder", r->path,
                            "commit", r->machine.commit, "compiler", r->machine.compiler, "lanes",
                            (int)r->machine.lanes, "processor", r->machine.processor, "date", r->machine.date,
                            "one_core", (int)r->on_one_core, "runs", (int)r->effort.rounds, "cases", cases),
      status);
}

static void print_text(const request *r) {
  for (uint32_t i = 0; i < r->case_count; i++) {
    const chart_sheet *s = &r->sheets[i];
    uint32_t failed = 0, refused = 0;
    for (uint32_t k = 0; k < s->row_count; k++)
      failed += !s->rows[k].sound && !s->rows[k].refused, refused += s->rows[k].refused;
    printf("%s: %u settings, %u failed, %u refused\n", s->name, (unsigned)s->row_count, (unsigned)failed,
        (unsigned)refused);
    for (uint32_t k = 0; k < s->reference_count; k++) {
      printf("  reference of %s: %s; off by itself:", s->references[k].model, s->references[k].what);
      for (int axis = 0; axis < CHART_AXIS_COUNT; axis++)
        if (s->axes & 1u << axis && isfinite(s->references[k].errors[axis]))
          printf(" %s %.1e", chart_axis_names[axis], s->references[k].errors[axis]);
      printf("\n");
    }
  }
  if (!r->on_one_core) printf("times are not of one core: this system does not keep a process on one\n");
  printf("in %s\n", r->path);
}

static int measure(cli_call *call, request *r) {
  sbf_diagnostic error;
  sbf_status status = chart_folder_check(r->path, &error);
  r->sheets = calloc((size_t)r->case_count + 1, sizeof *r->sheets);
  if (!r->sheets) return cli_wrong(call, "memory ran out");
  for (uint32_t i = 0; status == SBF_OK && i < r->case_count; i++) {
    r->now = r->cases[i];
    status = chart_sweep(r->cases[i], &r->effort, &r->sheets[i], &error);
  }
  cli_progress_end();
  if (status != SBF_OK) {
    cli_print_diagnostic(call, &error);
    return (int)status;
  }
  int written = write_all(call, r);
  if (call->json) return print_json(r, written);
  if (written == SBF_OK) print_text(r);
  return written;
}

/* ---- Drawings of tables that are there ---- */

static sbf_status draw_again(
    const request *r, const char *table, const chart_folder *folder, sbf_diagnostic *error) {
  char name[64];
  chart_sheet sheet;
  chart_machine machine;
  sbf_status status = chart_table_read(table, &sheet, &machine, name, sizeof name, error);
  const chart_case *c = status == SBF_OK ? case_named(r, name) : NULL;
  if (status == SBF_OK && !c)
    status =
        fault_set_file(error, SBF_CODE_IO_UNKNOWN_FORMAT, table, "it is of the case %s, which there is not%s",
            name, r->asset ? " of a character" : ": of a character's motion, give the character's FILE too");
  if (c) sheet.title = c->title, sheet.axes = c->axes;
  if (c) status = chart_draw(&sheet, &machine, folder, error);
  chart_sheet_free(&sheet);
  return status;
}

static int redraw(cli_call *call, request *r) {
  chart_folder folder;
  sbf_diagnostic error;
  const char *table;
  int at = 0;
  r->path = cli_value(call, "-o");
  if (!r->path) return cli_wrong(call, "state the output folder: -o DIR");
  if (call->json || cli_switch(call, "--no-svg") || cli_switch(call, "--jobs") || cli_value(call, "--case"))
    return cli_wrong(
        call, "--redraw draws all of each table and measures nothing: it goes with FILE and -o alone");
  sbf_status status = chart_folder_begin(&folder, r->path, &error);
  while (status == SBF_OK && (table = cli_next_value(call, "--redraw", &at)) != NULL)
    status = draw_again(r, table, &folder, &error);
  if (status == SBF_OK) status = chart_folder_commit(&folder, &error);
  chart_folder_abandon(&folder);
  if (status == SBF_OK)
    printf("in %s\n", r->path);
  else
    cli_print_diagnostic(call, &error);
  return (int)status;
}

static int run(cli_call *call) {
  if (cli_switch(call, "--map") && cli_value(call, "--redraw"))
    return cli_wrong(call, "--redraw is of tables of cases; maps are the same each time: leave it out");
  if (cli_switch(call, "--map")) return chart_maps_run(call);
  if (cli_value(call, "--cells")) return cli_wrong(call, "--cells is of maps: ask for them with --map");
  request r = {.machine = chart_this_machine()};
  int status = gather_cases(call, &r);
  if (status == SBF_OK && cli_value(call, "--redraw"))
    status = redraw(call, &r);
  else if (status == SBF_OK && !parse(call, &r))
    status = SBF_FAILED;
  else if (status == SBF_OK)
    status = cli_switch(call, "--jobs") ? print_jobs(call, &r) : measure(call, &r);
  for (uint32_t i = 0; r.sheets && i < r.case_count; i++) chart_sheet_free(&r.sheets[i]);
  free(r.sheets);
  free(r.cases);
  sbf_asset_free(r.asset);
  return status;
}

static const cli_option options[] = {{"--case", "NAME", "one of the cases above; may be repeated (all)"},
    {"-o", "DIR", "folder for tables and drawings; created if missing"},
    {"--runs", "N", "runs per time; the median counts (15)"},
    {"--most-substeps", "N", "substeps are 1, 2, 4 and so on, up to N (128)"},
    {"--core", "N", "processor core to run on, from 0 (0)"},
    {"--distance", "M", "viewing distance for errors in pixels (5)"},
    {"--map", NULL, "draw stability maps: where each scheme is valid, biased or fails"},
    {"--cells", "N", "columns of a map; half as many rows; maps of bodies have half of both (48)"},
    {"--redraw", "TABLE",
        "measure nothing: draw CASE.csv, with CASE-runs.csv beside it, again; several times for several"},
    {"--no-svg", NULL, "write tables only; gnuplot is not needed"},
    {"--jobs", NULL, "print one command per case, to run in parallel, and measure nothing"},
    {"--format", "text|json", "how to report (text)"}, {NULL, NULL, NULL}};

const cli_verb verb_chart = {.name = "chart",
    .synopsis = "[FILE] [--case NAME] -o DIR",
    .summary = "chart speed against accuracy",
    .details = "Runs known cases with every scheme at many numbers of substeps. Measures each error\n"
               "against a converged reference and the cost of a frame on one core. Writes into the\n"
               "folder, for each case, a table (CASE.csv), the time of every run (CASE-runs.csv) and a\n"
               "drawing per measure of error (CASE-ERROR.svg, needs gnuplot). Failed runs are marked at\n"
               "the top of the drawings. If anything fails, nothing is written.\n\n"
               "spring, chain, pendulum, beam, drop and pressure are motions; cantilever and hung come\n"
               "to rest: their errors are those of time steps. cantilever-meshes and beam-meshes compare\n"
               "coarse meshes with a fine one: their errors are those of meshes.\n\n"
               "With a FILE, the walk, hop and shake of its character are charted (--case walk, hop,\n"
               "shake): the error of the skin in metres, and in pixels of a screen with 1080 lines and a\n"
               "field of view of 60 degrees.\n\n"
               "--map draws stability maps over stiffness for every scheme: a mass on a spring by\n"
               "damping, jitter of the frame time, one long frame and initial stretch; a chain, a bar of\n"
               "tetrahedra and one of regions by the mass at the end; the bar by Poisson's ratio (--case\n"
               "damping, jitter, hitch, stretch, mass-springs, mass-tetrahedra, mass-regions, poisson).\n"
               "Files are map-damping.csv and so on.",
    .options = options,
    .min_inputs = 0,
    .max_inputs = 1,
    .run = run};
