/* Measures the longest time between two calls of a build's progress callback, which is the longest time
 * that a build takes to react to a cancel. Uses surfaces and characters in ../shared/data if that folder
 * exists, and our lizard. */
#include <stdio.h>
#include <string.h>

#include "measured_assets.h"
#include "measuring.h"
#include "sbfmt/build.h"

typedef struct listener {
  double begin_s, last_s, longest_s;
  uint32_t calls;
  char last[64], longest[64]; /* passes, as of the call before the silence */
} listener;

static bool hear(void *user, const char *pass, double done) {
  listener *l = user;
  double now = bench_now_s();
  (void)done;
  if (now - l->last_s > l->longest_s) {
    l->longest_s = now - l->last_s;
    memcpy(l->longest, l->last, sizeof l->longest);
  }
  l->last_s = now;
  snprintf(l->last, sizeof l->last, "%s", pass);
  l->calls++;
  return true;
}

static void measure(const char *name, const char *what, sbf_asset *source, sbf_build_options options) {
  listener l = {.begin_s = bench_now_s(), .last = "the beginning"};
  sbf_asset *built;
  sbf_diagnostic error;
  if (!source) return;
  l.last_s = l.begin_s;
  options.progress = hear;
  options.user = &l;
  bench_require(sbf_build(source, &options, &built, NULL, &error), &error);
  bench_print_row(
      "%s,%s,%.3f,%u,%.3f,%s", name, what, bench_now_s() - l.begin_s, l.calls, l.longest_s, l.longest);
  sbf_asset_free(built);
  sbf_asset_free(source);
}

int main(int argument_count, char **arguments) {
  bench_print_columns("asset,build,seconds,calls,longest_silence_s,after");
  measure("our lizard", "as it comes", our_lizard(false), (sbf_build_options){0});
  if (bench_is_quick(argument_count, arguments)) return 0;
  static const char folder[] = SHARED_FOLDER "/armadillo", file[] = "armadillo_25k.obj";
  static const struct {
    const char *what;
    sbf_build_options options;
  } builds[] = {
      {"200000 tetrahedra", {.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = 200000}},
      {"4000000 tetrahedra", {.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = 4000000}},
      {"2000 tetrahedra and calibrated", {.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = 2000}},
      {"springs on a grid", {.interior = SBF_BUILD_INTERIOR_LATTICE, .cell_m = 0.2}},
      {"springs by centroid", {.interior = SBF_BUILD_INTERIOR_CENTROID}},
      {"render levels", {.interior = SBF_BUILD_INTERIOR_NONE, .render_levels = 4}},
  };
  for (size_t i = 0; i < sizeof builds / sizeof *builds; i++)
    measure("armadillo", builds[i].what, character_asset(folder, file, NULL, false), builds[i].options);
  measure("walk.dae", "sections of a skin",
      character_asset(SHARED_FOLDER "/walk-dae", "walk.dae", NULL, false), (sbf_build_options){0});
  return 0;
}
