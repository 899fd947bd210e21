/* Measures the cost of contacts: the frame time of a body in contact over that of the same body without.
 *
 * The bodies are an armadillo of one metre and a slab of 1 x 0.2 x 1 m, about 2,700 tetrahedra of 0.1 MPa
 * each. A frame is one control tick of 1/60 s, awake, on one thread; the reference is their flight.
 * `rest`: lying on the floor. `landing`: the frames from the first contact on, dropped from 10 cm. Two
 * characters walk side by side; the reference is a world in which bodies do not collide (`pair_alone`).
 * `pair_apart`: bodies may collide and are 4 m apart. `pair_touching`: close enough to collide. Values are
 * medians of the frames' processor time; the time of a frame is the minimum of several runs.
 *
 * `threads`: bodies of about 100,000 tetrahedra, the armadillo in flight and the slab on the floor. Two
 * threads divide the work within the body; the ratio is one thread's time over theirs. The time of two
 * threads is the processor time of the busier one: that of two free cores without the delay of waking each
 * other. */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include "measured_assets.h"
#include "measured_bodies.h"
#include "measuring.h"
#include "sbfmt/asset.h"
#include "sbrun/collision.h"
#include "sbrun/sbrun.h"
#include "thread_pool.h"

typedef struct scene {
  const char *name;
  double height_m;     /* of the origin when let go */
  uint32_t first, end; /* frames that count */
} scene;

enum { RUNS = 5, MAX_FRAMES = 300, PAIR_FRAMES = 60 };

typedef struct fall {
  double min[MAX_FRAMES];
  float depth_m, speed_m_s;
} fall;

static float lowest_of(const sbf_asset *asset) {
  const sbf_vec3_list *at = &asset->soft_bodies.at[0].surface.positions;
  float low = at->at[0].y;
  for (uint32_t i = 1; i < at->count; i++) low = fminf(low, at->at[i].y);
  return low;
}

static void run(const sbr_model *model, const scene *s, uint32_t number, fall *f) {
  sbf_diagnostic error;
  sbr_world *world;
  sbr_character_id character;
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  definition.sleep_after_s = 0;
  standing.position.y = s->height_m;
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  bench_require(sbr_character_create(world, model, &standing, &character, &error), &error);
  for (uint32_t i = 0; i < s->end; i++) {
    double begin = bench_now_s();
    sbr_world_tick(world);
    double taken = bench_now_s() - begin;
    if (number == 0 || taken < f->min[i]) f->min[i] = taken;
  }
  sbr_world_destroy(world);
}

static double median(fall *f, const scene *s) {
  return bench_spread_of(f->min + s->first, s->end - s->first).median;
}

/* So that it comes to rest. */
static void damp(sbf_asset *asset) {
  sbf_soft_body *body = (sbf_soft_body *)(uintptr_t)asset->soft_bodies.at;
  body->attributes.damping_ratio = 0.2f;
}

static void measure(const char *body, sbf_asset *asset, bool quick) {
  if (!asset) return;
  double low = -(double)lowest_of(asset);
  damp(asset);
  const scene scenes[] = {
      {"flight", 100, 30, 90}, {"rest", low + 0.01, 240, 300}, {"landing", low + 0.1, 8, 20}};
  fall falls[3];
  sbr_model *model;
  sbf_diagnostic error;
  bench_require(sbr_model_create(asset, NULL, &model, &error), &error);
  for (uint32_t r = 0; r < (quick ? 1 : RUNS); r++)
    for (int i = 0; i < 3; i++) run(model, &scenes[i], r, &falls[i]);
  double flight = median(&falls[0], &scenes[0]);
  for (int i = 0; i < 3; i++) {
    double frame = median(&falls[i], &scenes[i]);
    bench_print_row("%s,%s,%.1f,%.2f", body, scenes[i].name, 1e6 * frame, frame / flight);
  }
  sbr_model_destroy(model);
  sbf_asset_free(asset);
}

typedef struct pair_scene {
  const char *name;
  bool contacts; /* between bodies */
  double separation_m;
} pair_scene;

static void run_pair(const sbr_model *model, const pair_scene *s, uint32_t number, fall *f) {
  sbf_diagnostic error;
  sbr_world *world;
  sbr_world_definition definition = sbr_default_world_definition();
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  if (s->contacts) bench_require(sbr_world_enable_body_contacts(world, 0, &error), &error);
  for (int k = 0; k < 2; k++) {
    sbr_character_definition standing = sbr_default_character_definition();
    sbr_character_id character;
    standing.position.x = s->separation_m * k;
    bench_require(sbr_character_create(world, model, &standing, &character, &error), &error);
    sbr_character_set_drive(world, character, 0.3f, 0, 0);
  }
  for (uint32_t i = 0; i < PAIR_FRAMES; i++) {
    double begin = bench_now_s();
    sbr_world_tick(world);
    double taken = bench_now_s() - begin;
    if (number == 0 || taken < f->min[i]) f->min[i] = taken;
  }
  sbr_world_destroy(world);
}

/* Two walk side by side: `touching_m` from each other their bodies touch. */
static void measure_pair(const char *name, sbf_asset *asset, double touching_m, bool quick) {
  if (!asset) return;
  const pair_scene scenes[] = {
      {"pair_alone", false, 4}, {"pair_apart", true, 4}, {"pair_touching", true, touching_m}};
  const scene counted = {"pair", 0, 10, PAIR_FRAMES};
  double alone = 0;
  sbr_model *model;
  sbf_diagnostic error;
  bench_require(sbr_model_create(asset, NULL, &model, &error), &error);
  for (int i = 0; i < 3; i++) {
    fall f;
    for (uint32_t r = 0; r < (quick ? 1 : RUNS); r++) run_pair(model, &scenes[i], r, &f);
    double frame = median(&f, &counted);
    if (i == 0) alone = frame;
    bench_print_row("%s,%s,%.1f,%.2f", name, scenes[i].name, 1e6 * frame, frame / alone);
  }
  sbr_model_destroy(model);
  sbf_asset_free(asset);
}

/* ---- Threads within a body ---- */

/* A world whose tasks are timed where another thread runs them. */
typedef struct timed_world {
  sbr_world *world;
  thread_pool *pool;
  sbr_tasks workers;
  pthread_t caller;
  sbr_task *task;
  void *context;
  double helper_s; /* the other thread's time in this frame */
} timed_world;

static void run_timed_task(void *context, uint32_t index) {
  timed_world *w = context;
  bool helps = !pthread_equal(pthread_self(), w->caller);
  double begin = helps ? bench_now_s() : 0;
  w->task(w->context, index);
  if (helps) w->helper_s += bench_now_s() - begin;
}

static void run_timed(void *user, sbr_task *task, void *context, uint32_t count) {
  timed_world *w = user;
  w->task = task, w->context = context;
  w->workers.run(w->workers.user, run_timed_task, w, count);
}

static void open_timed(timed_world *w, const sbr_model *model, double height_m, uint32_t threads) {
  sbf_diagnostic error;
  sbr_character_id character;
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  *w = (timed_world){.pool = thread_pool_create(threads), .caller = pthread_self()};
  if (!w->pool) bench_fail("no threads");
  w->workers = thread_pool_tasks(w->pool);
  if (w->workers.run) definition.tasks = (sbr_tasks){run_timed, w};
  definition.sleep_after_s = 0;
  standing.position.y = height_m;
  bench_require(sbr_world_create(&definition, &w->world, &error), &error);
  bench_require(sbr_character_create(w->world, model, &standing, &character, &error), &error);
}

/* One thread and two take turns frame by frame, so that a busy machine slows down both. */
static void run_threads(const sbr_model *model, const scene *s, uint32_t number, fall falls[2]) {
  timed_world worlds[2];
  for (uint32_t k = 0; k < 2; k++) open_timed(&worlds[k], model, s->height_m, k + 1);
  for (uint32_t i = 0; i < s->end; i++)
    for (uint32_t k = 0; k < 2; k++) {
      timed_world *w = &worlds[k];
      w->helper_s = 0;
      double begin = bench_now_s();
      sbr_world_tick(w->world);
      double taken = fmax(bench_now_s() - begin, w->helper_s);
      if (number == 0 || taken < falls[k].min[i]) falls[k].min[i] = taken;
    }
  if (sbr_world_get_state_hash(worlds[0].world) != sbr_world_get_state_hash(worlds[1].world))
    bench_fail("two threads give other bits than one");
  for (uint32_t k = 0; k < 2; k++) {
    sbr_world_destroy(worlds[k].world);
    thread_pool_destroy(worlds[k].pool);
  }
}

static void measure_threads(const char *body, sbf_asset *asset, double height_m, bool quick) {
  if (!asset) return;
  const scene s = {"threads", height_m - (double)lowest_of(asset), 5, quick ? 8 : 25};
  fall falls[2];
  sbr_model *model;
  sbf_diagnostic error;
  damp(asset);
  bench_require(sbr_model_create(asset, NULL, &model, &error), &error);
  for (uint32_t r = 0; r < (quick ? 1 : RUNS); r++) run_threads(model, &s, r, falls);
  double one = median(&falls[0], &s), two = median(&falls[1], &s);
  bench_print_row("%s,%s,%.1f,%.2f", body, s.name, 1e6 * two, one / two);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
  bench_print_columns("body,scene,frame_us,ratio");
  measure("armadillo", armadillo_of_tetrahedra(2700), quick);
  measure("slab", slab_of_tetrahedra(2700), quick);
  measure_pair(
      "pup", character_asset(BENCH_SOURCE_FOLDER "/examples/pup", "pup.glb", NULL, true), 0.42, quick);
  measure_pair("lizard", our_lizard(true), 0.47, quick);
  const uint32_t many = quick ? 30000 : 100000;
  measure_threads("armadillo", armadillo_of_tetrahedra(many), 100, quick);
  measure_threads("slab", slab_of_tetrahedra(many), 0.01, quick);
  return 0;
}
