/* Measures error and cost of the detail levels of a body: Spot of ../shared/data as lattices, springs and
 * jiggle; without that folder our lizard's springs and jiggle. */
#include <stdio.h>
#include <stdlib.h>

#include "measured_assets.h"
#include "measuring.h"
#include "sbfmt/build.h"
#include "sbrun/sbrun.h"

typedef struct stepped {
  sbr_model *model;
  sbr_world *world;
} stepped;

static void run(void *context) {
  sbr_world_tick(((const stepped *)context)->world);
}

static void open_level(stepped *s, const sbf_asset *asset, uint32_t level) {
  sbf_diagnostic error;
  sbr_character_id character;
  sbr_model_options options = sbr_default_model_options();
  options.level = level;
  sbr_world_definition world = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  bench_require(sbr_model_create(asset, &options, &s->model, &error), &error);
  bench_require(sbr_world_create(&world, &s->world, &error), &error);
  bench_require(sbr_character_create(s->world, s->model, &standing, &character, &error), &error);
}

static uint32_t elements_of(const sbf_level *level) {
  uint32_t count = level->lattice.tetrahedra.count;
  for (uint32_t i = 0; i < level->springs.count; i++) count += level->springs.at[i].ends.count;
  return count ? count : 1;
}

static void measure(const char *name, sbf_asset *source, sbf_build_options options, uint32_t rounds) {
  enum { MAX = 8 };
  sbf_asset *built;
  sbf_diagnostic error;
  stepped levels[MAX];
  bench_case cases[MAX];
  bench_require(sbf_build(source, &options, &built, NULL, &error), &error);
  sbf_asset_free(source);
  const sbf_level_list *made = &built->soft_bodies.at[0].levels;
  for (uint32_t l = 0; l < made->count; l++) {
    open_level(&levels[l], built, l);
    cases[l] = (bench_case){.run = run, .context = &levels[l]};
  }
  bench_rounds(cases, made->count, rounds);
  for (uint32_t l = 0; l < made->count; l++) {
    const sbf_level *level = &made->at[l];
    char time[32] = ""; /* the runtime steps springs or tetrahedra where a jiggle level is asked for */
    if (level->model != SBF_ELASTIC_MODEL_JIGGLE) snprintf(time, sizeof time, "%.1f", cases[l].s.min * 1e6);
    bench_print_row("%s,%s,%u,%.2f,%.0f,%s", name, level->name, elements_of(level),
        1e3 * (double)level->simulation.error, (double)level->simulation.cost, time);
    sbr_world_destroy(levels[l].world);
    sbr_model_destroy(levels[l].model);
  }
  sbf_asset_free(built);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
  sbf_asset *spot = quick ? NULL : character_asset(SHARED_FOLDER "/spot", "spot.obj", NULL, false);
  bench_print_columns("body,level,elements,error_mm,cost,us_per_tick");
  if (spot)
    measure("spot", spot,
        (sbf_build_options){.interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = 4000, .levels = 5},
        bench_round_count(15));
  else
    measure("our lizard's first section", our_lizard(false), (sbf_build_options){.levels = 2}, 3);
  return 0;
}
