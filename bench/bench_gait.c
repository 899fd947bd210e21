/* Measures the animation layer alone: microseconds of a control tick of 1/60 s of characters without soft
 * bodies.
 *
 * Each character is converted from its model in examples/ and not built, so nothing is simulated. The time
 * includes gait, inverse kinematics, chains, tails, head, and the world's overhead. A character is driven
 * for some seconds in several runs, which must end in the same state. Times are taken over half seconds.
 * `least_us` is the mean over them of the minimum over the runs, `worst_us` the largest minimum,
 * `median_us` the median run's mean. `bench_gait NAME...` measures only these characters. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measured_assets.h"
#include "measuring.h"
#include "sbrun/sbrun.h"

enum { TICKS = 30 }; /* of a piece */

typedef struct source {
  const char *name, *mesh, *rig;
} source;
static const source sources[] = {{"lizard", "lizard.obj", "lizard.glb"}, {"pup", "pup.glb", NULL},
    {"yeti", "yeti.glb", NULL}, {"spider", "spider.glb", NULL}, {"caterpillar", "caterpillar.glb", NULL},
    {"dragon", "dragon.glb", NULL}, {"snake", "snake.glb", NULL}, {"koi", "koi.glb", NULL}};
enum { SOURCES = sizeof sources / sizeof *sources };

typedef struct drive {
  const char *name;
  float forward, turn; /* legs (or decimetres, of what has none) a second, rad/s */
} drive;
static const drive drives[] = {{"stands", 0, 0}, {"walks", 0.3f, 0}, {"trots a curve", 1.5f, 0.3f}};
enum { DRIVES = sizeof drives / sizeof *drives };

typedef struct walk {
  sbr_model *model;
  const drive *drive;
  sbr_ground ground;
  float leg_m;
  uint32_t piece_count, run_count, run;
  uint64_t hash;
  double *min;   /* of each piece, over the runs so far, in s */
  double *means; /* of each run, in s a tick */
} walk;

static void walk_once(walk *w) {
  sbf_diagnostic error;
  sbr_world *world;
  sbr_character_id character;
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  definition.ground = w->ground;
  definition.character_capacity = 1;
  definition.sleep_after_s = 0; /* what stands is awake, too */
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  bench_require(sbr_character_create(world, w->model, &standing, &character, &error), &error);
  sbr_character_set_drive(world, character, w->drive->forward * w->leg_m, 0, w->drive->turn);
  double sum = 0;
  for (uint32_t piece = 0; piece < w->piece_count; piece++) {
    double begin = bench_now_s();
    for (int i = 0; i < TICKS; i++) sbr_world_tick(world);
    double took = bench_now_s() - begin;
    if (w->run == 0 || took < w->min[piece]) w->min[piece] = took;
    sum += took;
  }
  w->means[w->run] = sum / (TICKS * w->piece_count);
  uint64_t hash = sbr_world_get_state_hash(world);
  if (w->run && hash != w->hash) bench_fail("two runs end in different states");
  w->hash = hash;
  w->run++;
  sbr_world_destroy(world);
}

static float leg_of(const sbf_asset *asset) {
  float sum = 0;
  const sbf_gait *gait = asset->gaits.count ? &asset->gaits.at[0] : NULL;
  for (uint32_t i = 0; gait && i < gait->legs.count; i++) {
    const sbf_ik_chain *chain = &asset->ik_chains.at[gait->legs.at[i].ik];
    for (int32_t b = asset->bones.at[chain->end].parent; b >= 0; b = asset->bones.at[b].parent) {
      sum += asset->bones.at[b].length / (float)gait->legs.count;
      if (b == chain->root) break;
    }
  }
  return sum > 0 ? sum : 0.1f;
}

static void print(const char *name, const sbf_asset *asset, const char *ground, const walk *w) {
  double min = 0, worst = 0;
  for (uint32_t i = 0; i < w->piece_count; i++) {
    double us = 1e6 * w->min[i] / TICKS;
    min += us / w->piece_count;
    worst = us > worst ? us : worst;
  }
  bench_spread spread = bench_spread_of(w->means, w->run_count);
  bench_print_row("%s,%u,%u,%s,%s,%.3f,%.3f,%.3f", name,
      asset->gaits.count ? asset->gaits.at[0].legs.count : 0, asset->bones.count, ground, w->drive->name, min,
      1e6 * spread.median, worst);
}

static bool is_asked_for(const char *name, int argument_count, char **arguments) {
  bool any = false;
  for (int i = 1; i < argument_count; i++) {
    if (arguments[i][0] == '-') continue;
    any = true;
    if (strcmp(arguments[i], name) == 0) return true;
  }
  return !any;
}

static void measure(const source *from, bool quick) {
  static const char *const ground_names[] = {"flat", "noise"};
  enum { WALKS = 2 * DRIVES };
  const uint32_t run_count = quick ? 2 : 25, piece_count = quick ? 2 : 16;
  char folder[1024];
  snprintf(folder, sizeof folder, "%s/examples/%s", BENCH_SOURCE_FOLDER, from->name);
  sbf_asset *asset = character_asset(folder, from->mesh, from->rig, false);
  if (!asset) bench_fail("%s/%s is not there", folder, from->mesh);
  float leg = leg_of(asset);
  sbf_diagnostic error;
  sbr_model *model;
  bench_require(sbr_model_create(asset, NULL, &model, &error), &error);
  walk walks[WALKS];
  for (uint32_t i = 0; i < WALKS; i++)
    walks[i] = (walk){.model = model,
        .drive = &drives[i % DRIVES],
        .ground = i < DRIVES ? sbr_ground_flat(0) : sbr_ground_noise(0.2 * (double)leg, 7),
        .leg_m = leg,
        .piece_count = piece_count,
        .run_count = run_count,
        .min = bench_allocate(piece_count, sizeof(double)),
        .means = bench_allocate(run_count, sizeof(double))};
  for (uint32_t run = 0; run < run_count; run++)
    for (uint32_t i = 0; i < WALKS; i++) walk_once(&walks[run % 2 ? WALKS - 1 - i : i]);
  for (uint32_t i = 0; i < WALKS; i++) {
    print(from->name, asset, ground_names[i / DRIVES], &walks[i]);
    free(walks[i].min);
    free(walks[i].means);
  }
  sbr_model_destroy(model);
  sbf_asset_free(asset);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
  bench_print_columns("character,legs,bones,ground,drive,least_us,median_us,worst_us");
  for (uint32_t i = 0; i < SOURCES; i++)
    if (is_asked_for(sources[i].name, argument_count, arguments)) measure(&sources[i], quick);
  return 0;
}
