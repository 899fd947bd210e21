/* Compares falling bodies with Bullet: a ragdoll on the ground, and a cloth on a ball.
 *
 * `ragdoll`: twenty boxes and ball joints (measured_ragdoll.h), pushed over, for five seconds. Parts
 * collide only with the ground. `fall_us` and `lie_us` are the processor time of a tick (1/60 s), averaged
 * over the first two seconds and over the last second; the minimum of the rounds. Nothing sleeps.
 * `apart_mm`: largest separation of a joint's two ends. `beyond_deg`: largest violation of a joint limit.
 * `deep_mm`: largest penetration of a box corner. `rest_mm_s`: largest speed of a part's centre in the
 * last second. `coarse` uses rigid_coarse. `undamped` has joints without damping and friction, like
 * Bullet's.
 *
 * `cloth`: 100 x 100 points 1 cm apart, 0.8 kg, springs of 200 N/m, dropped on a ball of 0.3 m, for two
 * seconds. `fall_us` and `lie_us` are as above for the first and the last half second. `deep_mm`: largest
 * penetration of a point after a tick. `inside`: number of points deeper than 1 mm at the end.
 * `stretch_pct`: mean stretch of the springs at the end. Bullet's links have the stiffness factor 1, their
 * default. The voxels of Bullet's distance field of the ball are 2 cm.
 *
 * Fails if our ragdoll separates or our bodies pass through each other. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measured_bodies.h"
#include "measured_ragdoll.h"
#include "measuring.h"
#include "peer_bullet_falls.h"
#include "sbfmt/mechanics.h"
#include "sbrun/collision.h"
#include "sbrun/rigid.h"

static const float DEGREES = 57.29578f;
#ifdef BENCH_BULLET
static const float TICK_S = 1 / 60.0f;

/* With --once other engines are left out. */
static bool measures_bullet(bool quick) {
  return quick || !bench_runs_once();
}
#endif

typedef struct fall {
  double fall_us, lie_us;
  float separation_m, beyond, deep_m, rest_m_s, stretch;
  uint32_t inside;
} fall;

static float max(float a, float b) {
  return a > b ? a : b;
}

static sbf_vec3 minus(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static sbf_vec3 plus(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static float length(sbf_vec3 a) {
  return sqrtf(a.x * a.x + a.y * a.y + a.z * a.z);
}

static void keep_min(fall *best, const fall *now, bool first) {
  double fall_us = first || now->fall_us < best->fall_us ? now->fall_us : best->fall_us;
  double lie_us = first || now->lie_us < best->lie_us ? now->lie_us : best->lie_us;
  *best = *now;
  best->fall_us = fall_us, best->lie_us = lie_us;
}

/* ---- Ragdoll ---- */

enum { RAGDOLL_TICKS = 300, RAGDOLL_FALLS = 120, RAGDOLL_LIES = 60 };
enum { PUSHED = 2 }; /* the chest */
static const float RAISE_M = 0.02f, FRICTION = 0.5f;
static const sbf_vec3 PUSH_N_S = {25, 0, 60};

static sbf_vec3 turned(sbf_quat q, sbf_vec3 v) {
  sbf_vec3 u = {q.x, q.y, q.z};
  sbf_vec3 t = {2 * (u.y * v.z - u.z * v.y), 2 * (u.z * v.x - u.x * v.z), 2 * (u.x * v.y - u.y * v.x)};
  return (sbf_vec3){v.x + q.w * t.x + u.y * t.z - u.z * t.y, v.y + q.w * t.y + u.z * t.x - u.x * t.z,
      v.z + q.w * t.z + u.x * t.y - u.y * t.x};
}

/* Violation of the cone limit about x, or of the twist limit, by the rotation from a to b. */
static float beyond_limits(sbf_quat a, sbf_quat b) {
  sbf_quat r = {a.w * b.x - a.x * b.w - a.y * b.z + a.z * b.y, a.w * b.y + a.x * b.z - a.y * b.w - a.z * b.x,
      a.w * b.z - a.x * b.y + a.y * b.x - a.z * b.w, a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z};
  float swing = 2 * atan2f(hypotf(r.y, r.z), hypotf(r.x, r.w)), twist = fabsf(2 * atan2f(r.x, r.w));
  if (twist > 3.14159265f) twist = 6.28318531f - twist;
  return max(max(swing - RAGDOLL_SWING, twist - RAGDOLL_TWIST), 0);
}

static void measure_ragdoll(const part_state parts[RAGDOLL_PARTS], int tick, fall *f) {
  for (int i = 0; i < RAGDOLL_PARTS; i++) {
    const ragdoll_part *p = &ragdoll_parts[i];
    for (int k = 0; k < 8; k++) {
      sbf_vec3 corner = {p->size.x * (k & 1 ? 0.5f : -0.5f), p->size.y * (k & 2 ? 0.5f : -0.5f),
          p->size.z * (k & 4 ? 0.5f : -0.5f)};
      f->deep_m = max(f->deep_m, -plus(parts[i].center, turned(parts[i].rotation, corner)).y);
    }
    if (tick >= RAGDOLL_TICKS - RAGDOLL_LIES) f->rest_m_s = max(f->rest_m_s, length(parts[i].velocity));
    if (p->parent < 0) continue;
    const ragdoll_part *q = &ragdoll_parts[p->parent];
    const part_state *from = &parts[p->parent];
    sbf_vec3 a = plus(from->center, turned(from->rotation, minus(p->joint, q->middle)));
    sbf_vec3 b = plus(parts[i].center, turned(parts[i].rotation, minus(p->joint, p->middle)));
    f->separation_m = max(f->separation_m, length(minus(a, b)));
    f->beyond = max(f->beyond, beyond_limits(from->rotation, parts[i].rotation));
  }
}

static void add_time(fall *f, int tick, double taken_s) {
  if (tick < RAGDOLL_FALLS) f->fall_us += 1e6 * taken_s / RAGDOLL_FALLS;
  if (tick >= RAGDOLL_TICKS - RAGDOLL_LIES) f->lie_us += 1e6 * taken_s / RAGDOLL_LIES;
}

static sbf_vec3 pushed_position(void) {
  sbf_vec3 at = ragdoll_parts[PUSHED].middle;
  return (sbf_vec3){at.x, at.y + RAISE_M + 0.05f, at.z};
}

static fall our_ragdoll(const sbr_model *model, bool undamped, int ticks) {
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  sbr_world *world;
  sbr_character_id id;
  sbf_diagnostic error;
  fall f = {0};
  definition.ground = sbr_ground_flat(0);
  definition.sleep_after_s = 0;
  standing.position.y = (double)RAISE_M;
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  bench_require(sbr_character_create(world, model, &standing, &id, &error), &error);
  sbr_rigid_drive drive = sbr_default_rigid_drive();
  drive.joint_damping_1_s = drive.joint_friction = 0;
  if (undamped) sbr_character_set_rigid_drive(world, id, &drive);
  sbf_vec3 at = pushed_position();
  sbr_character_apply_rigid_impulse(world, id, PUSHED, (sbr_double3){at.x, at.y, at.z}, PUSH_N_S);
  for (int t = 0; t < ticks; t++) {
    part_state parts[RAGDOLL_PARTS];
    double begin = bench_now_s();
    sbr_world_tick(world);
    add_time(&f, t, bench_now_s() - begin);
    sbr_double3 o = sbr_character_get_origin(world, id);
    for (uint32_t i = 0; i < RAGDOLL_PARTS; i++) {
      sbr_rigid_state s = sbr_character_get_rigid_state(world, id, i);
      parts[i] = (part_state){{s.center.x + (float)o.x, s.center.y + (float)o.y, s.center.z + (float)o.z},
          s.velocity, s.frame.rotation};
    }
    measure_ragdoll(parts, t, &f);
  }
  sbr_world_destroy(world);
  return f;
}

#ifdef BENCH_BULLET
static fall bullets_ragdoll(int steps, int iterations, int ticks) {
  fall f = {0};
  bullet_ragdoll *r = bullet_ragdoll_make(RAISE_M, FRICTION, iterations);
  bullet_ragdoll_push(r, PUSHED, pushed_position(), PUSH_N_S);
  for (int t = 0; t < ticks; t++) {
    part_state parts[RAGDOLL_PARTS];
    double begin = bench_now_s();
    for (int k = 0; k < steps; k++) bullet_ragdoll_step(r, TICK_S / (float)steps);
    add_time(&f, t, bench_now_s() - begin);
    bullet_ragdoll_read(r, parts);
    measure_ragdoll(parts, t, &f);
  }
  bullet_ragdoll_free(r);
  return f;
}
#endif

static void print_ragdoll(const char *engine, const char *method, int steps, int iterations, const fall *f) {
  bench_print_row("ragdoll,%d,%s,%s,%d,%d,%.1f,%.1f,%.3f,%.3f,%.2f,,%.2f,", (int)RAGDOLL_PARTS, engine,
      method, steps, iterations, f->fall_us, f->lie_us, (double)(1e3f * f->separation_m),
      (double)(DEGREES * f->beyond), (double)(1e3f * f->deep_m), (double)(1e3f * f->rest_m_s));
}

static void measure_ragdolls(bool quick) {
  static const struct {
    uint32_t steps; /* 0: as many as it takes by itself */
    bool coarse, undamped;
  } ours[] = {{0, false, false}, {2, false, false}, {1, false, false}, {0, true, false}, {0, false, true},
      {0, true, true}};
  static const int peer[][2] = {{1, 10}, {1, 50}, {4, 10}, {8, 10}};
  sbf_asset *asset = ragdoll_asset();
  sbf_diagnostic error;
  int rounds = (int)bench_round_count(5), ticks = quick ? 90 : RAGDOLL_TICKS;
  for (size_t k = 0; k < sizeof ours / sizeof *ours; k++) {
    sbr_model *model;
    sbr_model_options options = sbr_default_model_options();
    options.rigid_substeps = ours[k].steps;
    options.rigid_coarse = ours[k].coarse;
    fall best = {0};
    bench_require(sbr_model_create(asset, &options, &model, &error), &error);
    for (int r = 0; r < rounds; r++) {
      fall f = our_ragdoll(model, ours[k].undamped, ticks);
      keep_min(&best, &f, r == 0);
    }
    static const char *const methods[2][2] = {{"direct", "direct undamped"}, {"coarse", "coarse undamped"}};
    print_ragdoll("sbrun", methods[ours[k].coarse][ours[k].undamped], (int)ours[k].steps, 1, &best);
    if (ours[k].steps == 0 && best.separation_m > 1e-3f)
      bench_fail("our ragdoll comes apart by %g m", (double)best.separation_m);
    if (ours[k].steps == 0 && best.beyond * DEGREES > 1)
      bench_fail("a limit is broken by %g degrees", (double)(best.beyond * DEGREES));
    sbr_model_destroy(model);
  }
#ifdef BENCH_BULLET
  for (size_t k = 0; measures_bullet(quick) && k < sizeof peer / sizeof *peer; k++) {
    fall best = {0};
    for (int r = 0; r < rounds; r++) {
      fall f = bullets_ragdoll(peer[k][0], peer[k][1], ticks);
      keep_min(&best, &f, r == 0);
    }
    print_ragdoll("Bullet", "sequential impulses", peer[k][0], peer[k][1], &best);
  }
#else
  (void)peer;
#endif
  sbf_asset_free(asset);
}

/* ---- Cloth on a ball ---- */

enum { CLOTH_TICKS = 120, CLOTH_ENDS = 30 };
static const float BALL_M = 0.3f, ABOVE_M = 0.02f;

typedef struct cloth {
  sbf_asset *asset;
  bullet_shape shape; /* as Bullet takes it: the ball's middle is the origin */
  uint32_t ticks;
} cloth;

static cloth make_cloth(uint32_t side, uint32_t ticks) {
  cloth c = {.asset = cloth_of_springs(side), .ticks = ticks};
  sbf_soft_body *body = (sbf_soft_body *)(uintptr_t)c.asset->soft_bodies.at;
  sbf_level *level = (sbf_level *)(uintptr_t)body->levels.at;
  sbf_vec3 *at = (sbf_vec3 *)(uintptr_t)level->positions.at;
  float *masses = bench_allocate(level->positions.count, sizeof *masses);
  float *stiffness = bench_allocate(level->springs.at[0].ends.count, sizeof *stiffness);
  level->pins.count = 0;
  body->attributes.friction = FRICTION;
  for (uint32_t i = 0; i < level->positions.count; i++) {
    at[i].x -= 0.005f * (float)(side - 1), at[i].z -= 0.005f * (float)(side - 1);
    at[i].y = BALL_M + ABOVE_M;
  }
  uint8_t *pinned = bench_allocate(level->positions.count, 1);
  sbf_level_masses(body, level, pinned, masses);
  free(pinned);
  for (uint32_t i = 0; i < level->springs.at[0].ends.count; i++)
    stiffness[i] = level->springs.at[0].stiffness.at[0];
  c.shape = (bullet_shape){.points = at,
      .masses = masses,
      .point_count = level->positions.count,
      .links = level->springs.at[0].ends.at,
      .stiffness = stiffness,
      .link_count = level->springs.at[0].ends.count};
  return c;
}

static void free_cloth(cloth *c) {
  free((void *)(uintptr_t)c->shape.masses);
  free((void *)(uintptr_t)c->shape.stiffness);
  sbf_asset_free(c->asset);
}

static float distance(const sbf_vec3 *a, const sbf_vec3 *b) {
  return length(minus(*a, *b));
}

static void measure_cloth(const cloth *c, const sbf_vec3 *points, uint32_t tick, fall *f) {
  f->inside = 0;
  for (uint32_t i = 0; i < c->shape.point_count; i++) {
    float deep = BALL_M - length(points[i]);
    f->deep_m = max(f->deep_m, deep);
    f->inside += deep > 1e-3f;
  }
  if (tick + 1 < c->ticks) return;
  double now = 0, rest = 0;
  for (uint32_t i = 0; i < c->shape.link_count; i++) {
    const uint32_t *ends = c->shape.links[i].at;
    now += (double)distance(&points[ends[0]], &points[ends[1]]);
    rest += (double)distance(&c->shape.points[ends[0]], &c->shape.points[ends[1]]);
  }
  f->stretch = (float)(now / rest - 1);
}

static void add_cloth_time(const cloth *c, fall *f, uint32_t tick, double taken_s) {
  if (tick < CLOTH_ENDS) f->fall_us += 1e6 * taken_s / CLOTH_ENDS;
  if (tick + CLOTH_ENDS >= c->ticks) f->lie_us += 1e6 * taken_s / CLOTH_ENDS;
}

static fall our_cloth(const cloth *c, const sbr_model *model, sbf_vec3 *points) {
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  sbr_shape_definition form = sbr_default_shape_definition();
  sbr_collider_definition ball = sbr_default_collider_definition();
  sbr_world *world;
  sbr_character_id id;
  sbr_collider_id collider;
  sbr_shape *shape;
  sbf_diagnostic error;
  fall f = {0};
  definition.ground = sbr_ground_flat(-1000);
  definition.sleep_after_s = 0;
  standing.position.y = 1000;
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  bench_require(sbr_character_create(world, model, &standing, &id, &error), &error);
  form.radius = BALL_M;
  bench_require(sbr_shape_create(NULL, &form, &shape, &error), &error);
  ball.shape = shape;
  bench_require(sbr_collider_create(world, &ball, &collider, &error), &error);
  for (uint32_t t = 0; t < c->ticks; t++) {
    double begin = bench_now_s();
    sbr_world_tick(world);
    add_cloth_time(c, &f, t, bench_now_s() - begin);
    sbr_double3 o = sbr_character_get_origin(world, id);
    uint32_t count = sbr_character_get_points(world, id, 0, points, c->shape.point_count);
    for (uint32_t i = 0; i < count; i++)
      points[i] = plus(points[i], (sbf_vec3){(float)o.x, (float)o.y, (float)o.z});
    measure_cloth(c, points, t, &f);
  }
  sbr_world_destroy(world);
  sbr_shape_destroy(shape);
  return f;
}

#ifdef BENCH_BULLET
static fall bullets_cloth(const cloth *c, uint32_t steps, uint32_t iterations, sbf_vec3 *points) {
  fall f = {0};
  float step_s = TICK_S / (float)steps;
  bullet_body *body =
      bullet_make_links_over_ball(&c->shape, iterations, 1, step_s, (sbf_vec3){0, 0, 0}, BALL_M, FRICTION);
  for (uint32_t t = 0; t < c->ticks; t++) {
    double begin = bench_now_s();
    for (uint32_t k = 0; k < steps; k++) bullet_step(body, step_s);
    add_cloth_time(c, &f, t, bench_now_s() - begin);
    bullet_read(body, points);
    measure_cloth(c, points, t, &f);
  }
  bullet_free(body);
  return f;
}
#endif

static void print_cloth(const cloth *c, const char *engine, const char *method, uint32_t steps,
    uint32_t iterations, const fall *f) {
  bench_print_row("cloth,%u,%s,%s,%u,%u,%.0f,%.0f,,,%.2f,%u,,%.2f", c->shape.link_count, engine, method,
      steps, iterations, f->fall_us, f->lie_us, (double)(1e3f * f->deep_m), f->inside,
      (double)(100 * f->stretch));
}

static void measure_our_cloth(
    const cloth *c, const char *method, sbf_scheme scheme, uint32_t steps, int rounds, sbf_vec3 *points) {
  sbr_model *model;
  sbr_model_options options = sbr_default_model_options();
  options.scheme = scheme;
  options.substeps = steps;
  sbf_diagnostic error;
  fall best = {0};
  bench_require(sbr_model_create(c->asset, &options, &model, &error), &error);
  for (int r = 0; r < rounds; r++) {
    fall f = our_cloth(c, model, points);
    keep_min(&best, &f, r == 0);
  }
  print_cloth(c, "sbrun", method, steps ? steps : sbr_model_get_substeps(model), 1, &best);
  if (best.inside > 0) bench_fail("%s: %u points of the cloth are in the ball", method, best.inside);
  sbr_model_destroy(model);
}

static void measure_cloths(bool quick) {
  cloth c = make_cloth(quick ? 40 : 100, quick ? 60 : CLOTH_TICKS);
  sbf_vec3 *points = bench_allocate(c.shape.point_count, sizeof *points);
  int rounds = (int)bench_round_count(3);
  measure_our_cloth(&c, "symplectic", SBF_SCHEME_SYMPLECTIC, 0, rounds, points);
  for (uint32_t steps = 20; steps <= (quick ? 20 : 80); steps *= 2)
    measure_our_cloth(&c, "position-based", SBF_SCHEME_POSITION_BASED, steps, rounds, points);
#ifdef BENCH_BULLET
  static const uint32_t peer[][2] = {{1, 10}, {4, 10}, {8, 10}, {16, 10}};
  for (size_t k = 0; measures_bullet(quick) && k < (quick ? 1 : sizeof peer / sizeof *peer); k++) {
    fall best = {0};
    for (int r = 0; r < rounds; r++) {
      fall f = bullets_cloth(&c, peer[k][0], peer[k][1], points);
      keep_min(&best, &f, r == 0);
    }
    print_cloth(&c, "Bullet", "links", peer[k][0], peer[k][1], &best);
  }
#endif
  free(points);
  free_cloth(&c);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
#ifndef BENCH_BULLET
  fprintf(stderr, "bench_falls: built without Bullet (Debian: libbullet-dev): it is left out\n");
#endif
  bench_print_columns(
      "scene,elements,engine,method,steps,iterations,fall_us,lie_us,apart_mm,beyond_deg,deep_mm,"
      "inside,rest_mm_s,stretch_pct");
  measure_ragdolls(quick);
  measure_cloths(quick);
  return 0;
}
