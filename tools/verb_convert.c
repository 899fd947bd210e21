/* sbfmt convert: converts files of other programs to bundles. */
#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/system.h"
#include "building.h"
#include "chart/out_folder.h"
#include "conversion_report.h"
#include "convert_batch.h"
#include "material_options.h"
#include "output_name.h"
#include "pin_options.h"
#include "saving.h"
#include "sbfmt/convert.h"
#include "sbfmt/gltf.h"
#include "sbfmt/mechanics.h"

enum { MAX_PATH = 4096 };
static const double MIN_BUDGET_US = 1, MAX_BUDGET_US = 1e6, USUAL_BUDGET_US = 100;

/* Name of a file without its folder and ending. */
typedef struct stem {
  const char *at;
  int length;
} stem;

static stem stem_of(const char *path) {
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
  return (stem){name, dot && dot != name ? (int)(dot - name) : (int)strlen(name)};
}

/* Name of the folder of a file; empty if the path does not include it. */
static stem folder_of(const char *path) {
  const char *end = strrchr(path, '/'), *at = end;
  while (at && at > path && at[-1] != '/') at--;
  return (stem){at ? at : path, at ? (int)(end - at) : 0};
}

/* Writes the output path OUT-DIR/NAME.sbf of an input NAME.ending; OUT-DIR/FOLDER-NAME.sbf if another input
 * has that name too. */
static bool path_in(const cli_call *call, const char *folder, const char *input, char *path, size_t size) {
  stem name = stem_of(input), parent = {"", 0};
  for (int i = 0; i < call->input_count; i++) {
    stem other = stem_of(call->inputs[i]);
    bool same = other.length == name.length && strncmp(other.at, name.at, (size_t)name.length) == 0;
    if (same && strcmp(call->inputs[i], input) != 0) parent = folder_of(input);
  }
  int needed = snprintf(path, size, "%s/%.*s%s%.*s.sbf", folder, parent.length, parent.at,
      parent.length ? "-" : "", name.length, name.at);
  return needed > 0 && (size_t)needed < size;
}

static void report(void *user, const sbf_diagnostic *diagnostic) {
  cli_print_diagnostic(user, diagnostic);
}

static bool is_bundle(const char *path) {
  const char *dot = strrchr(path, '.');
  if (dot && (strcasecmp(dot, ".glb") == 0 || strcasecmp(dot, ".vrm") == 0))
    return sbf_gltf_has_soft_bodies(path);
  return dot && (strcmp(dot, ".sbf") == 0 || strcmp(dot, ".sbfz") == 0);
}

/* Reads an input as source parts. A bundle is loaded unchanged, to add motion to it. */
static sbf_status read_input(cli_call *call, const char *input, const sbf_convert_options *options,
    sbf_asset **asset, sbf_diagnostic *error) {
  const sbf_load_options loading = {.report = options->report, .user = options->user};
  sbf_status status = is_bundle(input) ? sbf_load_file(input, &loading, asset, error)
                                       : sbf_convert(input, options, asset, error);
  int at = 0;
  for (const char *motion; status == SBF_OK && (motion = cli_next_value(call, "--motion", &at)) != NULL;) {
    status = sbf_convert_motion(*asset, motion, options, error);
    if (status != SBF_OK) sbf_asset_free(*asset);
  }
  return status;
}

/* Writes the report of a successful conversion; an error here fails the call. */
static sbf_status write_report(cli_call *call, const char *input, const char *out,
    const sbf_convert_options *options, const sbf_asset *asset, sbf_diagnostic *error) {
  const conversion_report of = {.input = input,
      .rig = options->rig,
      .output = out,
      .options = options,
      .summary = options->summary,
      .asset = asset,
      .messages = call->messages};
  json_t *report = conversion_report_make(&of);
  if (!report) return (sbf_status)cli_wrong(call, "memory ran out for the report");
  sbf_status status = conversion_report_write(report, cli_value(call, "--report"), error);
  json_decref(report);
  return status;
}

/* Stores summary values in the asset, as a build does, so that a large file can be described without reading
 * its geometry. */
static void state_figures(sbf_asset *asset) {
  sbf_asset_measures measures;
  sbf_asset_measure(asset, &measures);
  if (!(measures.mass <= FLT_MAX)) return;
  asset->info.mass = (float)measures.mass;
  asset->info.low = measures.low;
  asset->info.high = measures.high;
}

/* Reads the budget in microseconds; 0: none. False, with a message, if it is not a number or conflicts with
 * other options. The sections of a bundle stay as they are unless a budget is stated. */
static bool read_budget(const cli_call *call, const char *input, double *budget_us) {
  static const char *const chosen[] = {
      "--elements", "--cell", "--error", "--levels", "--springs", "--sections"};
  const char *value = cli_value(call, "--budget");
  *budget_us = value || is_bundle(input) ? 0 : USUAL_BUDGET_US;
  if (!value || strcmp(value, "none") == 0) return true;
  for (size_t i = 0; i < sizeof chosen / sizeof *chosen; i++)
    if (cli_value(call, chosen[i]))
      return cli_wrong(
                 call, "--budget chooses the elements of the sections: leave out %s or --budget", chosen[i]),
             false;
  return cli_number(call, "--budget", MIN_BUDGET_US, MAX_BUDGET_US, budget_us);
}

static int convert(cli_call *call, const char *input, const char *out, sbf_convert_options *options) {
  bool builds = !cli_switch(call, "--no-build");
  sbf_asset *asset, *misfit = NULL;
  sbf_build_report made;
  sbf_diagnostic error;
  sbf_convert_summary summary = {.source_count = 0};
  options->summary = &summary;
  options->rigging.misfit = &misfit;
  sbf_status status = read_input(call, input, options, &asset, &error);
  if (status == SBF_OK && !materials_apply(call, asset)) {
    sbf_asset_free(asset);
    return SBF_FAILED;
  }
  if (status == SBF_OK) {
    double budget_us;
    bool exact = cli_value(call, "--firmness") || cli_value(call, "--material") || is_bundle(input);
    read_budget(call, input, &budget_us);
    status = building_choose(call, asset, budget_us, !exact, &error);
    if (status != SBF_OK) sbf_asset_free(asset);
  }
  if (status == SBF_OK && !builds) state_figures(asset);
  if (status == SBF_OK && builds) status = building_run(call, &asset, &made, &error);
  if (status == SBF_OK) {
    int saved = saving_run(call, input, out, asset, NULL);
    if (saved == SBF_OK && builds) building_print(asset, &made);
    if (saved == SBF_OK && call->messages) status = write_report(call, input, out, options, asset, &error);
    sbf_asset_free(asset);
    if (saved != SBF_OK) return saved;
  }
  if (status != SBF_OK) cli_print_diagnostic(call, &error);
  if (misfit && call->messages && write_report(call, input, out, options, misfit, &error) != SBF_OK)
    cli_print_diagnostic(call, &error);
  sbf_asset_free(misfit);
  return (int)status;
}

/* Checks that every input has its own output path and creates the folder. */
static bool prepare_folder(const cli_call *call, const char *folder) {
  char path[MAX_PATH], other[MAX_PATH];
  for (int i = 0; i < call->input_count; i++) {
    if (!path_in(call, folder, call->inputs[i], path, sizeof path))
      return cli_wrong(call, "the path of %s in %s is too long", call->inputs[i], folder), false;
    for (int k = 0; k < i; k++)
      if (path_in(call, folder, call->inputs[k], other, sizeof other) && strcmp(path, other) == 0)
        return cli_wrong(call, "%s and %s would both become %s: convert them one by one with -o",
                   call->inputs[k], call->inputs[i], path),
               false;
  }
  sbf_diagnostic error;
  if (chart_folder_check(folder, &error) != SBF_OK) {
    cli_print_diagnostic(call, &error);
    return false;
  }
  if (!system_make_folder(folder))
    return cli_wrong(call, "the folder %s cannot be made: %s", folder, strerror(errno)), false;
  return true;
}

static int convert_all(cli_call *call, sbf_convert_options *options) {
  const char *out = cli_value(call, "-o"), *folder = cli_value(call, "--out-dir");
  long jobs = 0;
  if (!cli_integer(call, "--jobs", 1, 64, &jobs)) return SBF_FAILED;
  if (folder) {
    if (!prepare_folder(call, folder)) return SBF_FAILED;
    return convert_batch(call, folder, jobs, path_in);
  }
  int status = convert(call, call->inputs[0], out, options);
  cli_print_counted(call);
  return status;
}

/* Inputs are read several times: to find their format, to convert, and to store their hash. Opening a pipe
 * again would wait for a writer forever. False, with a message, if the input is one. */
static bool is_no_pipe(const cli_call *call, const char *path) {
  struct stat facts;
  if (!path || stat(path, &facts) != 0 || S_ISREG(facts.st_mode) || S_ISDIR(facts.st_mode)) return true;
  cli_wrong(call, "%s: this is a pipe or a device: save its content to a file and name that file", path);
  return false;
}

static bool are_no_pipes(const cli_call *call) {
  bool good = is_no_pipe(call, cli_value(call, "--rig"));
  for (int i = 0; good && i < call->input_count; i++) good = is_no_pipe(call, call->inputs[i]);
  const char *motion;
  for (int at = 0; good && (motion = cli_next_value(call, "--motion", &at)) != NULL;)
    good = is_no_pipe(call, motion);
  return good;
}

/* A bundle is converted already: it takes motions and builds only. False, with a message, otherwise. */
static bool fits_bundles(const cli_call *call) {
  static const char *const of_sources[] = {"--rig", "--weights", "--unit", "--up", "--forward", "--gait",
      "--limits", "--pin", "--hold", "--attach", "--shell", "--soft", "--rigid", "--firmness", "--goal",
      "--goal-stiffness"};
  for (int i = 0; i < call->input_count; i++)
    for (size_t k = 0; is_bundle(call->inputs[i]) && k < sizeof of_sources / sizeof *of_sources; k++)
      if (cli_value(call, of_sources[k]))
        return cli_wrong(call,
                   "%s is a bundle, which %s does not change: use it when converting the source, or leave it "
                   "out",
                   call->inputs[i], of_sources[k]),
               false;
  return true;
}

static int run(cli_call *call) {
  const char *out = cli_value(call, "-o"), *folder = cli_value(call, "--out-dir");
  static const char *const axes[] = {"y", "z"};
  static const char *const animals[] = {"none", "human", "quadruped", "reptile"}; /* as sbf_convert_limits */
  static const char *const fronts[] = {"x", "-x", "y", "-y", "z", "-z"};
  static const char *const kinds[] = {"walk", "swim", "fly", "slither", "crawl", "roll", "none"};
  int up = 0, front = 0, limits = 0, kind = 0, status = SBF_FAILED;
  double budget_us;
  pin_options pins;
  sbf_convert_options options = {.rig = cli_value(call, "--rig"), .report = report, .user = call};
  if (!out == !folder)
    return cli_wrong(call, "state the output: -o FILE for one input, --out-dir DIR for several");
  if (out && call->input_count > 1) return cli_wrong(call, "-o takes one input; use --out-dir DIR for many");
  if (!output_name_of_bundle(call, "-o") || !are_no_pipes(call) || !fits_bundles(call) ||
      !cli_number(call, "--unit", 1e-9, 1e9, &options.unit_m) || !cli_word(call, "--up", axes, 2, &up) ||
      !cli_word(call, "--forward", fronts, 6, &front) || !cli_word(call, "--limits", animals, 4, &limits) ||
      !cli_word(call, "--gait", kinds, 7, &kind) || !read_budget(call, call->inputs[0], &budget_us) ||
      !building_check(call) || !materials_check(call))
    return SBF_FAILED;
  options.limits = (sbf_convert_limits)limits;
  options.keep_modulus = materials_of_all(call);
  options.rigging.weights = cli_value(call, "--weights");
  if (cli_value(call, "--gait")) options.gait = kinds[kind];
  if (cli_value(call, "--up")) options.up = axes[up][0];
  if (cli_value(call, "--forward")) options.forward = fronts[front];
  const char *page = cli_value(call, "--report");
  if (page && call->input_count > 1) return cli_wrong(call, "--report takes one input");
  if (page && !conversion_report_supports(page))
    return cli_wrong(call, "--report needs a name that ends in .html or .json, not '%s'", page);
  call->messages = page ? json_array() : NULL;
  if (pin_options_read(call, &pins, &options)) status = convert_all(call, &options);
  pin_options_free(&pins);
  json_decref(call->messages);
  call->messages = NULL;
  return status;
}

static const cli_option options[] = {
    {"-o", "OUT.sbf[z]", "output file; the ending selects XML or packed"},
    {"--out-dir", "DIR",
        "write each input to this folder under its own name, or FOLDER-NAME where inputs share one"},
    {"--jobs", "N", "parallel conversions with --out-dir (one per processor)"},
    {"--rig", "FILE", "take the skeleton from this file"},
    {"--forward", "x|-x|y|-y|z|-z", "axis of the input that the character faces (found by its legs)"},
    {"--gait", "walk|swim|fly|slither|crawl|roll|none",
        "way of moving (derived from its shape, names and clips)"},
    {"--weights", "FILE|named|match|transfer|compute",
        "source of skin weights: a .csv or .json file, objects' names, equal positions, the nearest surface, "
        "or the bones alone (the first that fits)"},
    {"--motion", "FILE", "transfer its clips to the skeleton; repeatable"},
    {"--unit", "METRES", "metres per unit of the input (as the file states, else 1)"},
    {"--up", "y|z", "upward axis of the input (as the file states, else y)"},
    PIN_OPTIONS,
    {"--report", "OUT.html|json",
        "write a report: content of the input, repairs, guesses, quality of the elements"},
    {"--limits", "none|human|quadruped|reptile",
        "propose joint limits from the names and positions of bones (none)"},
    {"--no-build", NULL, "do not build derived parts; `sbfmt build` can do it later"},
    {"--budget", "MICROSECONDS|none",
        "cost limit of a tick with skin, at 6 ns per element visit: the cheapest sections with the skin "
        "within 1 % of the finest, else fewer soft parts; none: 160 elements per section at any cost (100)"},
    BUILDING_OPTIONS,
    MATERIALS_OPTION,
    {NULL, NULL, NULL},
};
const cli_verb verb_convert = {"convert", "INPUT... (-o OUT.sbf[z] | --out-dir DIR) [--rig FILE] ...",
    "make a bundle from a mesh and a rig",
    "Reads OBJ, FBX, glTF, Collada and other formats of assimp; tetrahedra of TetGen, Gmsh, VTK and PhysX; "
    "the\n2012 dialect, .xml; and a bundle, to add motion. Objects become sections of their parent bones in "
    "the node tree\nof the rig. A skinned mesh becomes the skin. A gait is proposed from shape, names and "
    "clips. Then builds the\nderived parts. A result that `sbfmt validate` would refuse is not written: its "
    "findings are listed, and the exit\nstatus is 1.",
    options, 1, -1, run};
