/* Compares soft bodies with Bullet's: equal points, masses and elements, released from rest for half a second
 * (the cloth and the beam of tetrahedra for a sixth), with equal counts of steps and with equal error.
 *
 * Bodies: `cloth` (200 x 200 points pinned at two corners), `beam` (10 x 10 x 50 cells pinned at one end) and
 * `armadillo` (a lattice pinned above nine tenths of its height); beam and armadillo once as springs along
 * the edges and once as tetrahedra. `lizard` is our example, `liz` the reference lizard if its file exists:
 * the springs of all sections with their pins, in one body for Bullet. There are no contacts and no damping.
 *
 * `steps` divide a tick of 1/60 s; each step makes `iterations` over all elements. `us` is the processor time
 * of a tick: the mean over the run, minimum of the rounds. `ns` is the same per element, step and iteration.
 * `error_mm` is the root mean square distance, over points and ticks, from symplectic steps with four times
 * the stable number; empty if the body left its bounds. `ours_us` is our cheapest row on that body with at
 * most that error; `times` is the time of this row over it.
 *
 * Bullet corrects a fraction of the error of a link, a number without a unit. `fitted` uses one fraction for
 * all links, found by a search for the minimum error. `implicit` gives each link the fraction that makes the
 * step implicit for its own spring, as in our scheme; no choice is better. Bullet's deformable body has
 * the same energy for small strains only: see docs/benchmarks.md. */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measured_assets.h"
#include "measured_bodies.h"
#include "measuring.h"
#include "peer_bullet.h"
#include "sbfmt/mechanics.h"
#include "sbrun/sbrun.h"

enum { HALF_A_SECOND = 30, SHORT = 10 }; /* ticks */
#ifdef BENCH_BULLET
static const float TICK_S = 1 / 60.0f;
#endif

/* ---- Scenes ---- */

typedef struct scene {
  const char *name;
  sbf_asset *asset;
  bullet_shape shape;
  uint32_t element_count, ticks;
  float size_m;
  sbf_vec3 *exact; /* (ticks x points) */
} scene;

static float *masses_of(const sbf_soft_body *body, float *masses) {
  const sbf_level *level = &body->levels.at[0];
  uint8_t *pinned = bench_allocate(level->positions.count, 1);
  for (uint32_t s = 0; s < level->pins.count; s++) {
    const sbf_pin_set *set = &level->pins.at[s];
    for (uint32_t i = 0; i < set->points.count; i++) {
      uint32_t at = set->weights.count > 1 ? i : 0;
      if (set->weights.count == 0 || set->weights.at[at] >= 1) pinned[set->points.at[i]] = 1;
    }
  }
  sbf_level_masses(body, level, pinned, masses);
  free(pinned);
  return masses + level->positions.count;
}

/* The springs of a body that have an end which is free, points counted from `first` on. */
static void add_links(scene *s, const sbf_soft_body *body, uint32_t first) {
  const sbf_level *level = &body->levels.at[0];
  uint32_t count = level->positions.count, total = 0, at = 0;
  for (uint32_t k = 0; k < level->springs.count; k++) total += level->springs.at[k].ends.count;
  float *all = bench_allocate(total, sizeof *all), *volumes = bench_allocate(count, sizeof *volumes);
  double *scratch = bench_allocate(2 * (size_t)count, sizeof *scratch);
  sbf_level_stiffness(body, level, volumes, scratch, all);
  for (uint32_t k = 0; k < level->springs.count; k++)
    for (uint32_t i = 0; i < level->springs.at[k].ends.count; i++, at++) {
      const uint32_t *ends = level->springs.at[k].ends.at[i].at;
      if (!(s->shape.masses[first + ends[0]] > 0) && !(s->shape.masses[first + ends[1]] > 0)) continue;
      uint32_t to = s->shape.link_count++;
      ((sbf_uint2 *)(uintptr_t)s->shape.links)[to] = (sbf_uint2){{first + ends[0], first + ends[1]}};
      ((float *)(uintptr_t)s->shape.stiffness)[to] = all[at];
    }
  free(all);
  free(volumes);
  free(scratch);
}

static void find_size(scene *s) {
  const sbf_vec3 *p = s->shape.points;
  for (uint32_t i = 0; i < s->shape.point_count; i++) {
    float x = p[i].x - p[0].x, y = p[i].y - p[0].y, z = p[i].z - p[0].z, r = sqrtf(x * x + y * y + z * z);
    s->size_m = r > s->size_m ? r : s->size_m;
  }
}

static scene make_scene(const char *name, sbf_asset *asset, uint32_t ticks) {
  scene s = {.name = name, .asset = asset, .ticks = ticks};
  uint32_t points = 0, springs = 0;
  count_elements(asset, &points, &springs);
  sbf_vec3 *positions = bench_allocate(points, sizeof *positions);
  float *masses = bench_allocate(points, sizeof *masses), *next = masses;
  s.shape = (bullet_shape){.points = positions,
      .masses = masses,
      .point_count = points,
      .links = bench_allocate(springs, sizeof(sbf_uint2)),
      .stiffness = bench_allocate(springs, sizeof(float))};
  uint32_t first = 0;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    sbf_soft_body *body = (sbf_soft_body *)(uintptr_t)&asset->soft_bodies.at[b];
    const sbf_level *level = body->levels.count ? &body->levels.at[0] : NULL;
    body->attributes.damping_ratio = body->attributes.mass_damping = body->attributes.stiffness_damping = 0;
    body->attributes.media_friction = 0;
    body->attributes.sag_free = false;
    if (!level) continue;
    memcpy(positions + first, level->positions.at, level->positions.count * sizeof *positions);
    next = masses_of(body, next);
    if (level->model == SBF_ELASTIC_MODEL_TETRAHEDRA) {
      s.shape.tetrahedra = level->lattice.tetrahedra.at;
      s.shape.tetrahedron_count = level->lattice.tetrahedra.count;
      s.shape.young_modulus = body->attributes.young_modulus;
      s.shape.poisson_ratio = body->attributes.poisson_ratio;
    } else {
      add_links(&s, body, first);
    }
    first += level->positions.count;
  }
  s.element_count = s.shape.tetrahedron_count ? s.shape.tetrahedron_count : s.shape.link_count;
  find_size(&s);
  return s;
}

static void free_scene(scene *s) {
  free((void *)(uintptr_t)s->shape.points);
  free((void *)(uintptr_t)s->shape.masses);
  free((void *)(uintptr_t)s->shape.links);
  free((void *)(uintptr_t)s->shape.stiffness);
  free(s->exact);
  sbf_asset_free(s->asset);
}

/* ---- Ways to step them ---- */

typedef struct method {
  const char *engine, *method;
  sbf_scheme scheme;          /* of ours */
  uint32_t steps, iterations; /* steps 0: ours, as many as are stable */
  float fraction;             /* of Bullet's links; 0: implicit */
  double us, error_mm;        /* error below 0: it did not hold the body */
} method;

/* Places of all points after each tick into `track`, unless NULL. Returns the
 * mean time of a tick, s. */
static double run_ours(const scene *s, method *w, sbf_vec3 *track) {
  sbf_diagnostic error;
  sbr_model *model;
  sbr_world *world;
  sbr_character_id id;
  sbr_model_options options = sbr_default_model_options();
  options.scheme = w->scheme;
  options.substeps = w->steps;
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  definition.ground = sbr_ground_flat(-1000);
  definition.sleep_after_s = 0;
  standing.position.y = 1000, standing.hold_pose = true;
  bench_require(sbr_model_create(s->asset, &options, &model, &error), &error);
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  bench_require(sbr_character_create(world, model, &standing, &id, &error), &error);
  double taken = 0;
  for (uint32_t i = 0; i < s->ticks; i++) {
    double begin = bench_now_s();
    sbr_world_tick(world);
    taken += bench_now_s() - begin;
    uint32_t left = track ? s->shape.point_count : 0;
    for (uint32_t b = 0; left > 0 && b < s->asset->soft_bodies.count; b++) {
      uint32_t read = sbr_character_get_points(world, id, b, track, left);
      track += read, left -= read;
    }
  }
  w->iterations = 1;
  if (!w->steps) w->steps = sbr_model_get_substeps(model);
  sbr_world_destroy(world);
  sbr_model_destroy(model);
  return taken / s->ticks;
}

#ifdef BENCH_BULLET
static double run_bullet(const scene *s, const method *w, sbf_vec3 *track) {
  float step_s = TICK_S / (float)w->steps;
  bullet_body *body = s->shape.tetrahedron_count
                          ? bullet_make_solid(&s->shape)
                          : bullet_make_links(&s->shape, w->iterations, w->fraction, step_s);
  double taken = 0;
  for (uint32_t i = 0; i < s->ticks; i++) {
    double begin = bench_now_s();
    for (uint32_t k = 0; k < w->steps; k++) bullet_step(body, step_s);
    taken += bench_now_s() - begin;
    if (track) bullet_read(body, track + (size_t)i * s->shape.point_count);
  }
  bullet_free(body);
  return taken / s->ticks;
}
#endif

static double run_method(const scene *s, method *w, sbf_vec3 *track) {
#ifdef BENCH_BULLET
  if (strcmp(w->engine, "sbrun") != 0) return run_bullet(s, w, track);
#endif
  return run_ours(s, w, track);
}

static double error_of(const scene *s, const sbf_vec3 *track) {
  size_t count = (size_t)s->ticks * s->shape.point_count;
  double sum = 0;
  for (size_t i = 0; i < count; i++) {
    double x = (double)track[i].x - s->exact[i].x, y = (double)track[i].y - s->exact[i].y,
           z = (double)track[i].z - s->exact[i].z, square = x * x + y * y + z * z;
    if (!(square < s->size_m * s->size_m)) return -1;
    sum += square;
  }
  return 1e3 * sqrt(sum / (double)count);
}

static void find_exact(scene *s) {
  method stable = {"sbrun", "", SBF_SCHEME_SYMPLECTIC, 0, 1, 0, 0, 0};
  s->exact = bench_allocate((size_t)s->ticks * s->shape.point_count, sizeof *s->exact);
  uint32_t ticks = s->ticks;
  s->ticks = 1;
  run_ours(s, &stable, NULL); /* finds how many are stable */
  s->ticks = ticks;
  stable.steps *= 4;
  run_ours(s, &stable, s->exact);
}

#ifdef BENCH_BULLET
static double error_with(const scene *s, method *w, float fraction, sbf_vec3 *track) {
  w->fraction = fraction;
  run_method(s, w, track);
  double error = error_of(s, track);
  return error < 0 ? INFINITY : error;
}

/* The share of links with the least error: by powers of four, then by golden section around the best. */
static void fit(const scene *s, method *w, sbf_vec3 *track) {
  double best = INFINITY, at = 1, golden = 0.6180339887;
  for (double fraction = 1; fraction > 1e-4; fraction /= 4) {
    double error = error_with(s, w, (float)fraction, track);
    if (error < best) best = error, at = fraction;
  }
  double low = log(at / 4), high = at < 1 ? log(at * 4) : 0;
  for (int i = 0; i < 4; i++) {
    double a = high - golden * (high - low), b = low + golden * (high - low);
    bool left = error_with(s, w, (float)exp(a), track) < error_with(s, w, (float)exp(b), track);
    *(left ? &high : &low) = left ? b : a;
  }
  w->fraction = (float)exp(0.5 * (low + high));
  if (error_with(s, w, w->fraction, track) > best) w->fraction = (float)at;
}
#endif

/* ---- Two threads ---- */

typedef struct twin {
  const scene *scene;
  method method;
  double s;
} twin;

static void *run_again(void *context) {
  twin *t = context;
  t->s = run_method(t->scene, &t->method, NULL);
  return NULL;
}

/* Two bodies, each on a thread: the busier one's time for a tick, us. */
static double time_two(const scene *s, const method *w) {
  twin twins[2] = {{s, *w, 0}, {s, *w, 0}};
  pthread_t other;
  if (pthread_create(&other, NULL, run_again, &twins[1]) != 0) bench_fail("no thread");
  run_again(&twins[0]);
  pthread_join(other, NULL);
  return 1e6 * (twins[0].s > twins[1].s ? twins[0].s : twins[1].s);
}

/* ---- Tables ---- */

static const method *cheapest_ours(const method *methods, uint32_t count, double error_mm) {
  const method *best = NULL;
  for (uint32_t i = 0; i < count; i++)
    if (strcmp(methods[i].engine, "sbrun") == 0 && methods[i].error_mm >= 0 &&
        methods[i].error_mm <= error_mm && (!best || methods[i].us < best->us))
      best = &methods[i];
  return best;
}

static void print_method(const scene *s, const method *w, uint32_t threads, double us, const method *ours) {
  char error[32] = "", against[64] = ",";
  if (w->error_mm >= 0) snprintf(error, sizeof error, "%.4f", w->error_mm);
  if (ours) snprintf(against, sizeof against, "%.1f,%.2f", ours->us, us / ours->us);
  bench_print_row("%s,%u,%u,%s,%s,%u,%u,%u,%.1f,%.2f,%s,%s", s->name, s->shape.point_count, s->element_count,
      w->engine, w->method, w->steps, w->iterations, threads, us,
      1e3 * us / s->element_count / w->steps / w->iterations, error, against);
}

static uint32_t list_ours(method *methods, bool solid) {
  uint32_t n = 0;
  static const uint32_t steps[] = {1, 5, 10, 20, 40, 80};
  methods[n++] = (method){"sbrun", "symplectic", SBF_SCHEME_SYMPLECTIC, 0, 1, 0, 0, 0};
  for (int i = solid ? 2 : 0; i < 6; i++)
    methods[n++] = (method){"sbrun", "position-based", SBF_SCHEME_POSITION_BASED, steps[i], 1, 0, 0, 0};
  if (solid) methods[n++] = (method){"sbrun", "block descent", SBF_SCHEME_BLOCK_DESCENT, 0, 1, 0, 0, 0};
  return n;
}

static uint32_t list_bullet(method *methods, bool solid) {
  uint32_t n = 0;
#ifdef BENCH_BULLET
  static const uint32_t counts[] = {1, 5, 10, 20, 40}, solid_steps[] = {1, 2, 4};
  for (int i = 0; solid && i < 3; i++)
    methods[n++] = (method){"Bullet", "deformable", SBF_SCHEME_AUTOMATIC, solid_steps[i], 1, 0, 0, 0};
  for (int i = 0; !solid && i < 4; i++)
    methods[n++] = (method){"Bullet", "links fitted", SBF_SCHEME_AUTOMATIC, 1, counts[i], 1, 0, 0};
  for (int i = 1; !solid && i < 5; i++)
    methods[n++] = (method){"Bullet", "links implicit", SBF_SCHEME_AUTOMATIC, counts[i], 1, 0, 0, 0};
#else
  (void)methods, (void)solid;
#endif
  return n;
}

static void measure(const char *name, sbf_asset *asset, uint32_t ticks, bool quick) {
  enum { MAX_METHODS = 24 };
  method methods[MAX_METHODS];
  scene s = make_scene(name, asset, quick ? 2 : ticks);
  bool solid = s.shape.tetrahedron_count > 0;
  uint32_t count = list_ours(methods, solid);
  count += list_bullet(methods + count, solid);
  find_exact(&s);
  sbf_vec3 *track = bench_allocate((size_t)s.ticks * s.shape.point_count, sizeof *track);
#ifdef BENCH_BULLET
  for (uint32_t i = 0; !quick && i < count; i++)
    if (methods[i].fraction > 0) fit(&s, &methods[i], track);
#endif
  for (uint32_t round = 0; round < (quick ? 1u : 2u); round++)
    for (uint32_t k = 0; k < count; k++) {
      method *w = &methods[round % 2 ? count - 1 - k : k];
      double us = 1e6 * run_method(&s, w, round == 0 ? track : NULL);
      if (round == 0) w->error_mm = error_of(&s, track);
      if (round == 0 || us < w->us) w->us = us;
    }
  for (uint32_t i = 0; i < count; i++) {
    bool peer = strcmp(methods[i].engine, "sbrun") != 0;
    const method *ours = peer ? cheapest_ours(methods, count, methods[i].error_mm) : NULL;
    print_method(&s, &methods[i], 1, methods[i].us, ours);
    if (i == 0 || (peer && methods[i].iterations == 10) || (peer && solid && methods[i].steps == 1))
      print_method(&s, &methods[i], 2, time_two(&s, &methods[i]), NULL);
  }
  free(track);
  free_scene(&s);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
#ifndef BENCH_BULLET
  fprintf(stderr, "bench_bullet: built without Bullet (Debian: libbullet-dev): it is left out\n");
#endif
  bench_print_columns(
      "body,points,elements,engine,method,steps,iterations,threads,us,ns,error_mm,ours_us,times");
  measure(
      "beam of springs", beam_of_springs(quick ? 2 : 10, quick ? 5 : 50, 0.02f, 3000), HALF_A_SECOND, quick);
  measure("cloth of springs", cloth_of_springs(quick ? 20 : 200), SHORT, quick);
  measure("our lizard of springs", our_lizard(true), HALF_A_SECOND, quick);
  measure(
      "beam of tetrahedra", beam_of_tetrahedra(quick ? 2 : 10, quick ? 5 : 50, 0.02f, 1e5f), SHORT, quick);
  if (quick) return 0;
  sbf_asset *solid = armadillo_of_tetrahedra(3700);
  sbf_asset *liz = character_asset(SHARED_FOLDER "/lizard", "liz.obj", "liz.fbx", true);
  if (!solid || !liz)
    fprintf(stderr, "bench_bullet: ../shared/data is not there: reference characters are left out\n");
  if (liz) measure("liz of springs", liz, HALF_A_SECOND, quick);
  if (!solid) return 0;
  hold_above(solid, 0.9);
  measure("armadillo of springs", springs_of_edges(solid), HALF_A_SECOND, quick);
  measure("armadillo of tetrahedra", solid, HALF_A_SECOND, quick);
  return 0;
}
