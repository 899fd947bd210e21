/* Crowds: many characters of one asset in one world, on one thread and on two.
 *
 * Armadillos of one metre, tetrahedra of 0.1 MPa, fly (the cost of free oscillation), or fall to the floor
 * from 10 cm or from a metre and oscillate there awake. Lizards walk. A frame is one control tick of 1/60
 * s. `busy_ms` is the processor time of the busier thread: that of free cores without the delay of waking
 * each other. `wall_ms` is the elapsed time on this machine. Both are medians of the second half of the
 * frames. `times_one` is the busy time of one thread over the row's. All runs must end in the same state.
 *
 * Rows of one armadillo with fixed substeps measure a substep with each set of instructions:
 * `ns_per_element`, in flight, from the difference to twice as many substeps, and `gb_s`, the bandwidth if
 * each byte of its tables and state is read once per substep. `triad` is the bandwidth of caches and
 * memory for a sum of lists. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "measured_assets.h"
#include "measured_bodies.h"
#include "measuring.h"
#include "sbrun/sbrun.h"
#include "thread_pool.h"

static double wall_s(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Its origin is in its middle; its feet are so far below, and a hand's breadth more. From a metre higher it
 * strikes the floor before half of 60 frames are over, at 4.4 m/s: its tips are crushed to the wall before J
 * = 0. */
static const double STANDS_M = 0.36 + 0.1, STRIKES_M = 0.36 + 1, FLIES_M = 100;

static uint32_t elements_of(const sbf_asset *asset) {
  return asset->soft_bodies.at[0].levels.at[0].lattice.tetrahedra.count;
}

/* ---- Crowds ---- */

typedef struct crowd {
  sbr_model *model;
  double raise_m;
  uint32_t count, threads, frames;
  thread_pool *pool;
  sbr_tasks workers;
  sbr_world *world;
  double helper_s; /* of the other thread in this frame */
  pthread_t caller;
  sbr_task *task;
  void *context;
} crowd;

static void run_task(void *context, uint32_t index) {
  crowd *c = context;
  bool helps = !pthread_equal(pthread_self(), c->caller);
  double begin = helps ? bench_now_s() : 0;
  c->task(c->context, index);
  if (helps) c->helper_s += bench_now_s() - begin;
}

static void run_tasks(void *user, sbr_task *task, void *context, uint32_t count) {
  crowd *c = user;
  c->task = task, c->context = context;
  if (c->workers.run)
    c->workers.run(c->workers.user, run_task, c, count);
  else
    for (uint32_t i = 0; i < count; i++) task(context, i);
}

static void open_crowd(crowd *c) {
  sbf_diagnostic error;
  sbr_world_definition definition = sbr_default_world_definition();
  definition.tasks = (sbr_tasks){run_tasks, c};
  definition.character_capacity = c->count;
  definition.sleep_after_s = 0;
  c->pool = thread_pool_create(c->threads);
  if (!c->pool) bench_fail("no threads");
  c->workers = thread_pool_tasks(c->pool);
  c->caller = pthread_self();
  bench_require(sbr_world_create(&definition, &c->world, &error), &error);
  for (uint32_t i = 0; i < c->count; i++) {
    sbr_character_definition standing = sbr_default_character_definition();
    sbr_character_id id;
    standing.position = (sbr_double3){2.0 * (i % 10), c->raise_m, 2.0 * (i / 10)};
    standing.heading = 0.1f * (float)i;
    bench_require(sbr_character_create(c->world, c->model, &standing, &id, &error), &error);
    sbr_character_set_drive(c->world, id, 0.4f, 0, 0.1f);
  }
}

typedef struct crowd_times {
  double busy_s, wall_s;
  uint64_t hash;
} crowd_times;

static crowd_times run_crowd(
    sbr_model *model, double raise_m, uint32_t count, uint32_t threads, uint32_t frames) {
  crowd c = {.model = model, .raise_m = raise_m, .count = count, .threads = threads, .frames = frames};
  uint32_t first = frames / 2, measured = 0;
  double *busy = bench_allocate(frames, sizeof *busy), *wall = bench_allocate(frames, sizeof *wall);
  open_crowd(&c);
  for (uint32_t f = 0; f < frames; f++) {
    c.helper_s = 0;
    double begin = bench_now_s(), wall_begin = wall_s();
    sbr_world_tick(c.world);
    double own = bench_now_s() - begin;
    if (f < first) continue;
    wall[measured] = wall_s() - wall_begin;
    busy[measured++] = own > c.helper_s ? own : c.helper_s;
  }
  crowd_times t = {bench_spread_of(busy, measured).median, bench_spread_of(wall, measured).median,
      sbr_world_get_state_hash(c.world)};
  sbr_world_destroy(c.world);
  thread_pool_destroy(c.pool);
  free(busy);
  free(wall);
  return t;
}

static void measure_crowds(
    const char *name, const sbf_asset *asset, double raise_m, uint32_t max, uint32_t frames, bool quick) {
  static const uint32_t counts[] = {1, 10, 100};
  sbf_diagnostic error;
  sbr_model *model;
  bench_require(sbr_model_create(asset, NULL, &model, &error), &error);
  for (uint32_t n = 0; n < (quick ? 1 : 3) && counts[n] <= max; n++) {
    double one = 0;
    uint64_t hash = 0;
    for (uint32_t threads = 1; threads <= 2; threads++) {
      crowd_times t = run_crowd(model, raise_m, counts[n], threads, bench_runs_once() ? 4 : frames);
      if (threads == 1)
        one = t.busy_s, hash = t.hash;
      else if (hash != t.hash)
        bench_fail("two threads give other bits than one");
      bench_print_row("%s,%u,%u,%s,%u,%u,%.3f,%.3f,%.3f,,", name, counts[n], threads,
          sbr_instructions_get_name(sbr_model_get_instructions(model)), elements_of(asset),
          sbr_model_get_substeps(model), t.busy_s * 1e3, t.wall_s * 1e3, one / t.busy_s);
      fflush(stdout);
    }
  }
  sbr_model_destroy(model);
}

/* ---- A substep ---- */

/* Of each tetrahedron its places, stiffnesses and volume; of each point its place and force, read and written
 * twice, its velocity, mass and weight. */
enum { BYTES_OF_ELEMENT = 52, BYTES_OF_POINT = 96 };

static double bytes_of_substep(const sbf_asset *asset) {
  return BYTES_OF_ELEMENT * (double)elements_of(asset) +
         BYTES_OF_POINT * (double)asset->soft_bodies.at[0].levels.at[0].positions.count;
}

static void measure_substep(const sbf_asset *asset, sbr_instructions instructions) {
  sbf_diagnostic error;
  sbr_model *models[2];
  double min[2] = {0, 0};
  enum { SUBSTEPS = 40 };
  for (uint32_t k = 0; k < 2; k++) {
    sbr_model_options options = sbr_default_model_options();
    options.substeps = (k + 1) * SUBSTEPS, options.instructions = instructions;
    bench_require(sbr_model_create(asset, &options, &models[k], &error), &error);
  }
  for (uint32_t round = 0; round < bench_round_count(7); round++)
    for (uint32_t k = 0; k < 2; k++) {
      double taken = run_crowd(models[k], FLIES_M, 1, 1, bench_runs_once() ? 4 : 40).busy_s;
      if (round == 0 || taken < min[k]) min[k] = taken;
    }
  double substep = (min[1] - min[0]) / SUBSTEPS;
  bench_print_row("armadillo,1,1,%s,%u,%d,%.3f,,,%.2f,%.2f", sbr_instructions_get_name(instructions),
      elements_of(asset), (int)SUBSTEPS, min[0] * 1e3, substep * 1e9 / elements_of(asset),
      bytes_of_substep(asset) / substep * 1e-9);
  for (uint32_t k = 0; k < 2; k++) sbr_model_destroy(models[k]);
}

/* a = b + s c, over and over: what a core reads and writes a second where three lists of so many bytes lie.
 */
static void measure_triad(const char *name, size_t size) {
  size_t count = size / sizeof(float), rounds = bench_runs_once() ? 1 : 3 + ((size_t)1 << 27) / size;
  float *lists = bench_allocate(3 * count, sizeof *lists), *a = lists, *b = lists + count, *c = b + count;
  double min = 0;
  for (size_t i = 0; i < count; i++) a[i] = 0, b[i] = (float)i, c[i] = 2;
  for (size_t r = 0; r < rounds; r++) {
    double begin = bench_now_s();
    for (size_t repeat = 0; repeat < 8; repeat++) {
      const float *from = repeat % 2 ? a : b;
      float *to = repeat % 2 ? b : a;
      for (size_t i = 0; i < count; i++) to[i] = from[i] + 0.5f * c[i];
    }
    double taken = (bench_now_s() - begin) / 8;
    if (r == 0 || taken < min) min = taken;
  }
  if (!(a[count / 2] >= 0)) bench_fail("the triad went wrong"); /* and is not left out for being unused */
  bench_print_row("triad in %s,1,1,,,,%.4f,,,,%.2f", name, min * 1e3, 3 * (double)size / min * 1e-9);
  free(lists);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
  bench_print_columns(
      "character,count,threads,instructions,elements,substeps,busy_ms,wall_ms,times_one,ns_per_element,gb_s");
  sbf_asset *asset = armadillo_of_tetrahedra(2750);
  if (asset) {
    for (int i = SBR_INSTRUCTIONS_SCALAR; i <= SBR_INSTRUCTIONS_WASM_SIMD128; i++)
      if (sbr_instructions_are_available((sbr_instructions)i)) measure_substep(asset, (sbr_instructions)i);
    measure_crowds("armadillo in flight", asset, FLIES_M, 100, 40, quick);
    measure_crowds("armadillo on the floor", asset, STANDS_M, 1, 120, quick);
    measure_crowds("armadillo that strikes the floor", asset, STRIKES_M, 1, 60, quick);
    sbf_asset_free(asset);
  } else {
    fprintf(stderr, "bench_crowd: ../shared/data is not there: the armadillos are left out\n");
  }
  measure_triad("L2", (size_t)1 << 18);
  measure_triad("L3", (size_t)1 << 23);
  measure_triad("memory", (size_t)1 << (bench_runs_once() ? 22 : 27));
  asset = our_lizard(true);
  measure_crowds("lizard", asset, 0, 100, 60, quick);
  sbf_asset_free(asset);
  return 0;
}
