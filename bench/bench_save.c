/* Measures saving to memory in each form, `validate` (load with all checks, then apply the rules), and
 * building the derived parts of a character. MB are 10^6 bytes of the form that is written or read. */
#include <stdio.h>

#include "measured_assets.h"
#include "measuring.h"
#include "sbfmt/build.h"
#include "sbfmt/io.h"
#include "sbfmt/validate.h"

typedef struct job {
  const sbf_asset *asset;
  sbf_save_options options;
  sbf_buffer input, saved; /* the input of what reads */
  bool is_packed;
  size_t size; /* of what was read or saved */
} job;

static void save_xml(void *context) {
  job *j = context;
  sbf_diagnostic error;
  bench_require(sbf_xml_save_memory(j->asset, NULL, NULL, &j->saved, &error), &error);
}
static void save_packed(void *context) {
  job *j = context;
  sbf_diagnostic error;
  bench_require(sbf_packed_save_memory(j->asset, &j->options, NULL, &j->saved, &error), &error);
}
static void drop(void *context) {
  job *j = context;
  j->size = j->saved.size;
  sbf_buffer_free(&j->saved);
}

static void validate(void *context) {
  job *j = context;
  sbf_diagnostic error;
  sbf_asset *loaded;
  sbf_validate_result result;
  const sbf_load_options options = {.check_crc = true};
  bench_require((j->is_packed ? sbf_packed_load_memory : sbf_xml_load_memory)(
                    j->input.at, j->input.size, &options, &loaded, &error),
      &error);
  bench_require(sbf_validate(loaded, NULL, &result, &error), &error);
  if (result.errors) bench_fail("the asset is not valid");
  sbf_asset_free(loaded);
}

static void build(void *context) {
  job *j = context;
  sbf_diagnostic error;
  sbf_asset *built;
  bench_require(sbf_build(j->asset, NULL, &built, NULL, &error), &error);
  sbf_asset_free(built);
}

typedef struct action {
  const char *name, *form;
  bool store;
  int level;
  void (*run)(void *context), (*after)(void *context);
} action;

static const action actions[] = {
    {"save", "xml", false, 0, save_xml, drop},
    {"save", "stored", true, 0, save_packed, drop},
    {"save", "zlib 1", false, 1, save_packed, drop},
    {"save", "zlib 6", false, 6, save_packed, drop},
    {"save", "zlib 9", false, 9, save_packed, drop},
    {"validate", "xml", false, 0, validate, NULL},
    {"validate", "stored", true, 0, validate, NULL},
    {"validate", "zlib 6", false, 6, validate, NULL},
    {"build", "", false, 0, build, NULL},
};
enum { ACTION_COUNT = sizeof actions / sizeof *actions };

/* Gives a job that reads its file. */
static void prepare(job *j, const action *a) {
  sbf_diagnostic error;
  if (a->run != validate) return;
  j->is_packed = a->store || a->level;
  if (j->is_packed)
    bench_require(sbf_packed_save_memory(j->asset, &j->options, NULL, &j->input, &error), &error);
  else
    bench_require(sbf_xml_save_memory(j->asset, NULL, NULL, &j->input, &error), &error);
  j->size = j->input.size;
}

static void measure(const char *name, sbf_asset *asset, uint32_t rounds) {
  job jobs[ACTION_COUNT];
  bench_case cases[ACTION_COUNT];
  for (int i = 0; i < ACTION_COUNT; i++) {
    jobs[i] = (job){.asset = asset, .options = {.store = actions[i].store, .level = actions[i].level}};
    cases[i] = (bench_case){.run = actions[i].run, .after = actions[i].after, .context = &jobs[i]};
    prepare(&jobs[i], &actions[i]);
  }
  bench_rounds(cases, ACTION_COUNT, rounds);
  for (int i = 0; i < ACTION_COUNT; i++) {
    const bench_spread *s = &cases[i].s;
    char speed[32] = "";
    if (jobs[i].size) snprintf(speed, sizeof speed, "%.1f", (double)jobs[i].size / s->median / 1e6);
    bench_print_row("%s,%s,%s,%zu,%u,%.3f,%.3f,%.3f,%s", name, actions[i].name, actions[i].form, jobs[i].size,
        rounds, s->min * 1e3, s->median * 1e3, s->max * 1e3, speed);
    sbf_buffer_free(&jobs[i].input);
  }
  sbf_asset_free(asset);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
  uint32_t rounds = quick ? 1 : 15;
  bench_print_columns("asset,action,form,bytes,rounds,least_ms,median_ms,most_ms,MB/s");
  measure("surface", surface_asset(quick ? 20 : SURFACE_CELLS), rounds);
  measure("lizard", our_lizard(true), rounds);
  return 0;
}
