/* What a scheme costs and what it is good for: time for each spring in each substep, and the error that so
 * many substeps leave, on one thread.
 *
 * Bodies of springs: `cloth`, 200 by 200 points held at two corners; `beam`, 10 x 10 x 50 cells with a
 * diagonal across each face; `swing`, 10 x 2 x 2 such cells, 1 m long. Beams are held at one end and let go
 * level. The cloth and the beam have as many points and edges as those that docs and issues give other
 * engines' figures for. Of the swing, `error_mm` is the greatest distance of its tip from where it is with
 * 2048 symplectic substeps, over half a second; empty where a scheme did not hold it. Every round begins at
 * rest and does the very same; times are the least of the rounds. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "measuring.h"
#include "sbfmt/asset.h"
#include "sbrun/sbrun.h"

enum { SWING_TICKS = 30 };

typedef struct builder {
  sbf_asset *asset;
  sbf_vec3 *points;
  uint32_t point_count;
  sbf_uint2 *ends;
  uint32_t spring_count, held_count;
  uint32_t *held;
} builder;

static builder begin(uint32_t points) {
  builder b = {.asset = sbf_asset_create(NULL)};
  if (!b.asset) bench_fail("no memory");
  b.points = sbf_asset_allocate(b.asset, points, sizeof *b.points);
  b.ends = sbf_asset_allocate(b.asset, 7 * (size_t)points, sizeof *b.ends);
  b.held = sbf_asset_allocate(b.asset, points, sizeof *b.held);
  if (!b.points || !b.ends || !b.held) bench_fail("no memory");
  return b;
}

static void join(builder *b, uint32_t from, uint32_t to) {
  b->ends[b->spring_count++] = (sbf_uint2){{from, to}};
}

static float *fill(builder *b, float value) {
  float *one = sbf_asset_allocate(b->asset, 1, sizeof *one);
  if (!one) bench_fail("no memory");
  *one = value;
  return one;
}

/* The body of all that was put into `b`, `mass` kg in all, springs of one stiffness. */
static sbf_asset *finish(builder *b, float mass, float stiffness) {
  sbf_soft_body *body = sbf_asset_allocate(b->asset, 1, sizeof *body);
  sbf_level *level = sbf_asset_allocate(b->asset, 1, sizeof *level);
  sbf_spring_set *set = sbf_asset_allocate(b->asset, 1, sizeof *set);
  sbf_pin_set *pins = sbf_asset_allocate(b->asset, 1, sizeof *pins);
  if (!body || !level || !set || !pins) bench_fail("no memory");
  sbf_soft_body_init(body), sbf_level_init(level), sbf_spring_set_init(set), sbf_pin_set_init(pins);
  body->id = "body";
  body->attributes.mass = mass;
  body->attributes.damping_ratio = 0.02f;
  level->positions = (sbf_vec3_list){b->points, b->point_count};
  set->ends = (sbf_uint2_list){b->ends, b->spring_count};
  set->stiffness = (sbf_f32_list){fill(b, stiffness), 1};
  pins->points = (sbf_u32_list){b->held, b->held_count};
  level->springs = (sbf_spring_set_list){set, 1};
  level->pins = (sbf_pin_set_list){pins, 1};
  body->levels = (sbf_level_list){level, 1};
  b->asset->soft_bodies = (sbf_soft_body_list){body, 1};
  return b->asset;
}

static sbf_asset *make_cloth(uint32_t side) {
  builder b = begin(side * side);
  for (uint32_t i = 0; i < side; i++)
    for (uint32_t k = 0; k < side; k++) {
      uint32_t at = i * side + k;
      b.points[b.point_count++] = (sbf_vec3){0.01f * (float)k, 0, 0.01f * (float)i};
      if (k > 0) join(&b, at - 1, at);
      if (i > 0) join(&b, at - side, at);
      if (i > 0 && k > 0) join(&b, at - side - 1, at);
    }
  b.held[0] = 0, b.held[1] = side - 1, b.held_count = 2;
  return finish(&b, 0.2f * 4, 200);
}

/* Along +Z, held at its low end. */
static sbf_asset *make_beam(uint32_t across, uint32_t along, float cell, float stiffness) {
  uint32_t n = across + 1, slab = n * n;
  builder b = begin(slab * (along + 1));
  for (uint32_t z = 0; z <= along; z++)
    for (uint32_t y = 0; y < n; y++)
      for (uint32_t x = 0; x < n; x++) {
        uint32_t at = z * slab + y * n + x;
        b.points[b.point_count++] = (sbf_vec3){cell * (float)x, cell * (float)y, cell * (float)z};
        if (z == 0) b.held[b.held_count++] = at;
        if (x > 0) join(&b, at - 1, at);
        if (y > 0) join(&b, at - n, at);
        if (z > 0) join(&b, at - slab, at);
        bool odd = (x + y + z) % 2; /* which way the diagonals of the three faces before this point go */
        if (x > 0 && y > 0) odd ? join(&b, at - n - 1, at) : join(&b, at - n, at - 1);
        if (x > 0 && z > 0) odd ? join(&b, at - slab - 1, at) : join(&b, at - slab, at - 1);
        if (y > 0 && z > 0) odd ? join(&b, at - slab - n, at) : join(&b, at - slab, at - n);
      }
  float volume = (float)(across * across * along) * cell * cell * cell;
  return finish(&b, 1000 * volume, stiffness);
}

/* ---- Running ---- */

typedef struct running {
  const sbf_asset *asset;
  sbr_model *model;
  sbr_world *world;
  sbr_character_id character;
} running;

static running start(const sbf_asset *asset, sbf_scheme scheme, uint32_t substeps) {
  running r = {.asset = asset};
  sbf_diagnostic error;
  sbr_model_options options = {.scheme = scheme, .substeps = substeps};
  sbr_world_definition world = sbr_default_world_definition();
  sbr_character_definition character = sbr_default_character_definition();
  world.ground = sbr_ground_flat(-1000);
  world.character_capacity = 1;
  character.position.y = 1000;
  bench_require(sbr_model_create(asset, &options, &r.model, &error), &error);
  bench_require(sbr_world_create(&world, &r.world, &error), &error);
  bench_require(sbr_character_create(r.world, r.model, &character, &r.character, &error), &error);
  return r;
}

static void stop(running *r) {
  sbr_world_destroy(r->world);
  sbr_model_destroy(r->model);
}

/* Least time of a tick over the rounds, s. */
static double time_of(
    const sbf_asset *asset, sbf_scheme scheme, uint32_t substeps, uint32_t ticks, uint32_t rounds) {
  running r = start(asset, scheme, substeps);
  double least = INFINITY;
  for (uint32_t round = 0; round < rounds; round++) {
    sbr_character_reset(r.world, r.character);
    double before = bench_now_s();
    for (uint32_t i = 0; i < ticks; i++) sbr_world_tick(r.world);
    double took = (bench_now_s() - before) / ticks;
    least = took < least ? took : least;
  }
  stop(&r);
  return least;
}

static void track(const sbf_asset *asset, sbf_scheme scheme, uint32_t substeps, sbf_vec3 *tips) {
  running r = start(asset, scheme, substeps);
  uint32_t count = asset->soft_bodies.at[0].levels.at[0].positions.count;
  sbf_vec3 *points = bench_allocate(count, sizeof *points);
  for (int i = 0; i < SWING_TICKS; i++) {
    sbr_world_tick(r.world);
    sbr_character_points(r.world, r.character, 0, points, count);
    tips[i] = points[count - 1];
  }
  if (sbr_character_health(r.world, r.character, 0).recoveries) tips[0].x = NAN;
  free(points);
  stop(&r);
}

static double error_of(const sbf_vec3 *tips, const sbf_vec3 *exact) {
  double worst = 0;
  for (int i = 0; i < SWING_TICKS; i++) {
    double x = (double)tips[i].x - exact[i].x, y = (double)tips[i].y - exact[i].y,
           z = (double)tips[i].z - exact[i].z;
    double off = sqrt(x * x + y * y + z * z);
    if (!(off <= worst)) worst = off;
  }
  return worst;
}

static void measure_cost(const char *name, sbf_asset *asset, bool quick) {
  static const sbf_scheme schemes[] = {
      SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_EXPLICIT_EULER, SBF_SCHEME_HEUN};
  const sbf_level *level = &asset->soft_bodies.at[0].levels.at[0];
  uint32_t springs = level->springs.at[0].ends.count;
  for (int i = 0; i < 4; i++) {
    uint32_t substeps = 16, ticks = quick ? 1 : 10, rounds = quick ? 1 : 7;
    double s = time_of(asset, schemes[i], substeps, ticks, rounds);
    bench_print_row("%s,%u,%u,%s,%u,%.1f,%.2f,", name, level->positions.count, springs,
        sbf_scheme_name(schemes[i]), substeps, s * 1e6, s * 1e9 / springs / substeps);
  }
  sbf_asset_free(asset);
}

static void measure_errors(bool quick) {
  static const struct {
    sbf_scheme scheme;
    uint32_t substeps;
  } cases[] = {{SBF_SCHEME_SYMPLECTIC, 8}, {SBF_SCHEME_SYMPLECTIC, 12}, {SBF_SCHEME_SYMPLECTIC, 16},
      {SBF_SCHEME_SYMPLECTIC, 32}, {SBF_SCHEME_SYMPLECTIC, 64}, {SBF_SCHEME_POSITION_BASED, 1},
      {SBF_SCHEME_POSITION_BASED, 4}, {SBF_SCHEME_POSITION_BASED, 8}, {SBF_SCHEME_POSITION_BASED, 16},
      {SBF_SCHEME_POSITION_BASED, 32}, {SBF_SCHEME_POSITION_BASED, 64}, {SBF_SCHEME_POSITION_BASED, 256},
      {SBF_SCHEME_HEUN, 16}, {SBF_SCHEME_HEUN, 32}, {SBF_SCHEME_HEUN, 64}, {SBF_SCHEME_EXPLICIT_EULER, 64},
      {SBF_SCHEME_EXPLICIT_EULER, 256}, {SBF_SCHEME_EXPLICIT_EULER, 1024}};
  sbf_asset *asset = make_beam(2, 10, 0.1f, 20000);
  const sbf_level *level = &asset->soft_bodies.at[0].levels.at[0];
  uint32_t springs = level->springs.at[0].ends.count;
  sbf_vec3 exact[SWING_TICKS], tips[SWING_TICKS];
  track(asset, SBF_SCHEME_SYMPLECTIC, 1024, exact);
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    track(asset, cases[i].scheme, cases[i].substeps, tips);
    double error = error_of(tips, exact),
           s = time_of(asset, cases[i].scheme, cases[i].substeps, SWING_TICKS, quick ? 1 : 9);
    char text[32] = "";
    if (error < 1) snprintf(text, sizeof text, "%.4f", error * 1e3);
    bench_print_row("swing,%u,%u,%s,%u,%.1f,%.2f,%s", level->positions.count, springs,
        sbf_scheme_name(cases[i].scheme), cases[i].substeps, s * 1e6, s * 1e9 / springs / cases[i].substeps,
        text);
  }
  sbf_asset_free(asset);
}

int main(int argument_count, char **arguments) {
  bool quick = bench_is_quick(argument_count, arguments);
  bench_print_columns("body,points,springs,scheme,substeps,us_per_tick,ns_per_spring,error_mm");
  measure_cost("cloth", make_cloth(quick ? 20 : 200), quick);
  measure_cost("beam", make_beam(quick ? 2 : 10, quick ? 5 : 50, 0.02f, 3000), quick);
  measure_errors(quick);
  return 0;
}
