/* Walking: microseconds of each part of a frame of 1/60 s, on one thread and on two.
 *
 * A character walks for some seconds in several runs, which must end in the same state. The time of a
 * frame is the minimum of the runs, its cost on an idle machine. `least_us` is the mean of these over the
 * walk, `worst_us` the largest, `median_us` the median run's mean. With two threads, the time of a round
 * of tasks is the processor time of the busier thread: that of two free cores without the delay of waking
 * each other.
 *
 * Parts: `frame` is the total cost for a game. It consists of `pose` (gait, inverse kinematics, tail,
 * head), `bodies`, `skin` (positions and normals of all render meshes) and the work between them.
 * `substep` is one substep of all bodies, measured by two more runs with once and twice as many substeps
 * as the stiffest body needs. The automatic number, `substeps` at most, gives softer bodies fewer.
 * `health` (volumes, strains, energies) is for diagnosis and not part of a frame. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measured_assets.h"
#include "measuring.h"
#include "sbrun/sbrun.h"
#include "thread_pool.h"

typedef enum part { FRAME, POSE, BODIES, SKIN, HEALTH, PART_COUNT } part;
static const char *const part_names[PART_COUNT] = {"frame", "pose", "bodies", "skin", "health"};

/* One way of walking, and its times. */
typedef struct walk {
  const sbf_asset *asset;
  sbr_model *model;
  thread_pool *pool;
  uint32_t thread_count, frame_count, run_count, run;
  uint64_t hash;
  double *min[PART_COUNT];   /* of each frame, over the runs so far, in s */
  double *means[PART_COUNT]; /* of each run */
  sbr_tasks workers;
  uint32_t
      task_run; /* how many rounds of tasks were run in this tick: the poses come first, then the bodies */
  double now[PART_COUNT];
} walk;

/* A round of tasks on two threads, and what the other one spends on it. */
typedef struct round {
  sbr_task *task;
  void *context;
  pthread_t caller;
  double helper_s;
} round;

static void run_task(void *context, uint32_t index) {
  round *r = context;
  bool helps = !pthread_equal(pthread_self(), r->caller);
  double begin = helps ? bench_now_s() : 0;
  r->task(r->context, index);
  if (helps) r->helper_s += bench_now_s() - begin;
}

/* The world's rounds of tasks come through here, and so their times: the busier thread's. */
static void run_tasks(void *user, sbr_task *task, void *context, uint32_t count) {
  walk *w = user;
  round r = {task, context, pthread_self(), 0};
  double begin = bench_now_s();
  if (w->workers.run)
    w->workers.run(w->workers.user, run_task, &r, count);
  else
    for (uint32_t i = 0; i < count; i++) task(context, i);
  double own = bench_now_s() - begin, longer = r.helper_s > own ? r.helper_s : own;
  w->now[w->task_run++ % 2 ? BODIES : POSE] += longer;
  w->now[FRAME] += longer - own;
}

static sbr_world *make_world(walk *w, sbr_character_id *character) {
  sbf_diagnostic error;
  sbr_world *world;
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  definition.tasks = (sbr_tasks){run_tasks, w};
  definition.ground = sbr_ground_flat(0);
  definition.character_capacity = 1;
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  bench_require(sbr_character_create(world, w->model, &standing, character, &error), &error);
  sbr_character_set_drive(world, *character, 0.5f, 0, 0.2f);
  return world;
}

static void read_skin(const walk *w, const sbr_world *world, sbr_character_id character, sbf_vec3 *buffer) {
  uint32_t count = vertex_count_of(w->asset), at = 0;
  for (uint32_t i = 0; i < w->asset->render_meshes.count; i++)
    at += sbr_character_get_skin(world, character, i, buffer + at, buffer + count + at, NULL, count - at);
}

static void read_health(const walk *w, const sbr_world *world, sbr_character_id character) {
  for (uint32_t i = 0; i < w->asset->soft_bodies.count; i++) {
    sbr_body_health health = sbr_character_get_body_health(world, character, i);
    if (!health.finite || health.inverted) bench_fail("a body lost its shape");
  }
}

static void walk_once(walk *w) {
  sbr_character_id character;
  sbr_world *world = make_world(w, &character);
  sbf_vec3 *skin = bench_allocate(2 * (size_t)vertex_count_of(w->asset), sizeof *skin);
  double sums[PART_COUNT] = {0};
  for (uint32_t f = 0; f < w->frame_count; f++) {
    memset(w->now, 0, sizeof w->now);
    w->task_run = 0;
    double begin = bench_now_s();
    sbr_world_step(world, 1 / 60.0);
    double stepped = bench_now_s();
    read_skin(w, world, character, skin);
    double skinned = bench_now_s();
    read_health(w, world, character);
    w->now[FRAME] += skinned - begin;
    w->now[SKIN] = skinned - stepped;
    w->now[HEALTH] = bench_now_s() - skinned;
    for (int p = 0; p < PART_COUNT; p++) {
      if (w->run == 0 || w->now[p] < w->min[p][f]) w->min[p][f] = w->now[p];
      sums[p] += w->now[p];
    }
  }
  for (int p = 0; p < PART_COUNT; p++) w->means[p][w->run] = sums[p] / w->frame_count;
  uint64_t hash = sbr_world_get_state_hash(world);
  if (w->run++ && hash != w->hash) bench_fail("two runs of the same walk ended in different states");
  w->hash = hash;
  free(skin);
  sbr_world_destroy(world);
}

static void open_walk(
    walk *w, const sbf_asset *asset, uint32_t threads, uint32_t substeps, uint32_t frames, uint32_t runs) {
  sbf_diagnostic error;
  *w = (walk){.asset = asset, .thread_count = threads, .frame_count = frames, .run_count = runs};
  sbr_model_options options = sbr_default_model_options();
  options.substeps = substeps;
  bench_require(sbr_model_create(asset, &options, &w->model, &error), &error);
  w->pool = thread_pool_create(threads);
  if (!w->pool) bench_fail("no threads");
  w->workers = thread_pool_tasks(w->pool);
  for (int p = 0; p < PART_COUNT; p++) {
    w->min[p] = bench_allocate(frames, sizeof(double));
    w->means[p] = bench_allocate(runs, sizeof(double));
  }
}

static void close_walk(walk *w) {
  sbr_model_destroy(w->model);
  thread_pool_destroy(w->pool);
  for (int p = 0; p < PART_COUNT; p++) {
    free(w->min[p]);
    free(w->means[p]);
  }
}

static double min_mean(const walk *w, part p) {
  double sum = 0;
  for (uint32_t f = 0; f < w->frame_count; f++) sum += w->min[p][f];
  return sum / w->frame_count;
}

typedef struct about {
  const char *name;
  uint32_t points, springs, substeps;
} about;

static void print_walk(walk *w, const about *a) {
  for (int p = 0; p < PART_COUNT; p++) {
    bench_spread min = bench_spread_of(w->min[p], w->frame_count);
    double mean = min_mean(w, (part)p);
    bench_print_row("%s,%u,%u,%u,%u,%s,%u,%u,%.2f,%.2f,%.2f", a->name, a->points, a->springs, a->substeps,
        w->thread_count, part_names[p], w->frame_count, w->run_count, mean * 1e6,
        bench_spread_of(w->means[p], w->run_count).median * 1e6, min.max * 1e6);
  }
}

/* `once` and `twice` differ by as many substeps as the stiffest body needs. */
static void print_substep(const walk *once, const walk *twice, const about *a) {
  double one = (min_mean(twice, BODIES) - min_mean(once, BODIES)) / a->substeps;
  bench_print_row("%s,%u,%u,%u,1,substep,%u,%u,%.2f,,", a->name, a->points, a->springs, a->substeps,
      once->frame_count, once->run_count, one * 1e6);
}

enum { ONE_THREAD, TWO_THREADS, ONCE, TWICE, WALK_COUNT };

static void measure(const char *name, sbf_asset *asset, uint32_t frames, uint32_t runs) {
  walk walks[WALK_COUNT];
  about a = {.name = name};
  count_elements(asset, &a.points, &a.springs);
  open_walk(&walks[ONE_THREAD], asset, 1, 0, frames, runs);
  a.substeps = sbr_model_get_substeps(walks[ONE_THREAD].model);
  open_walk(&walks[TWO_THREADS], asset, 2, 0, frames, runs);
  open_walk(&walks[ONCE], asset, 1, a.substeps, frames, runs);
  open_walk(&walks[TWICE], asset, 1, 2 * a.substeps, frames, runs);
  for (uint32_t r = 0; r < runs; r++)
    for (int i = 0; i < WALK_COUNT; i++) walk_once(&walks[r % 2 ? WALK_COUNT - 1 - i : i]);
  if (walks[ONE_THREAD].hash != walks[TWO_THREADS].hash) bench_fail("two threads give other bits than one");
  print_walk(&walks[ONE_THREAD], &a);
  print_substep(&walks[ONCE], &walks[TWICE], &a);
  print_walk(&walks[TWO_THREADS], &a);
  for (int i = 0; i < WALK_COUNT; i++) close_walk(&walks[i]);
  sbf_asset_free(asset);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
  uint32_t frames = quick ? 20 : 300, runs = quick ? 2 : 9;
  bench_print_columns(
      "character,points,springs,substeps,threads,part,frames,runs,least_us,median_us,worst_us");
  measure("lizard", our_lizard(true), frames, runs);
  sbf_asset *reference = character_asset(SHARED_FOLDER "/lizard", "liz.obj", "liz.fbx", true);
  if (reference)
    measure("liz", reference, frames, runs);
  else
    fprintf(stderr, "bench_run: ../shared/data is not there: the reference character is left out\n");
  return 0;
}
