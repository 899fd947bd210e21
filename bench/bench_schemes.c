/* Measures cost and accuracy of the integration schemes: time for each spring in each substep, and the
 * error for a number of substeps, on one thread.
 *
 * Bodies of springs: `cloth`, 200 by 200 points pinned at two corners; `beam`, 10 x 10 x 50 cells with a
 * diagonal across each face; `swing`, 10 x 2 x 2 such cells, 1 m long. Beams are pinned at one end and
 * released from the horizontal. The cloth and the beam have the numbers of points and edges for which
 * other engines publish figures. `error_mm` is the largest distance of the swing's tip from its position
 * with 2048 symplectic substeps, over half a second; empty if a scheme is unstable. All rounds are
 * identical and start at rest; times are the minimum of the rounds. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "measured_bodies.h"
#include "measuring.h"
#include "sbfmt/asset.h"
#include "sbrun/sbrun.h"

enum { SWING_TICKS = 30 };

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
  sbr_model_options options = sbr_default_model_options();
  options.scheme = scheme;
  options.substeps = substeps;
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
  double min = INFINITY;
  for (uint32_t round = 0; round < rounds; round++) {
    sbr_character_reset(r.world, r.character);
    double before = bench_now_s();
    for (uint32_t i = 0; i < ticks; i++) sbr_world_tick(r.world);
    double took = (bench_now_s() - before) / ticks;
    min = took < min ? took : min;
  }
  stop(&r);
  return min;
}

static void track(const sbf_asset *asset, sbf_scheme scheme, uint32_t substeps, sbf_vec3 *tips) {
  running r = start(asset, scheme, substeps);
  uint32_t count = asset->soft_bodies.at[0].levels.at[0].positions.count;
  sbf_vec3 *points = bench_allocate(count, sizeof *points);
  for (int i = 0; i < SWING_TICKS; i++) {
    sbr_world_tick(r.world);
    sbr_character_get_points(r.world, r.character, 0, points, count);
    tips[i] = points[count - 1];
  }
  if (sbr_character_get_body_health(r.world, r.character, 0).recoveries) tips[0].x = NAN;
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
    uint32_t substeps = 16, ticks = quick ? 1 : 10, rounds = bench_round_count(7);
    double s = time_of(asset, schemes[i], substeps, ticks, rounds);
    bench_print_row("%s,%u,%u,%s,%u,%.1f,%.2f,", name, level->positions.count, springs,
        sbf_scheme_name(schemes[i]), substeps, s * 1e6, s * 1e9 / springs / substeps);
  }
  sbf_asset_free(asset);
}

static void measure_errors(void) {
  static const struct {
    sbf_scheme scheme;
    uint32_t substeps;
  } cases[] = {{SBF_SCHEME_SYMPLECTIC, 8}, {SBF_SCHEME_SYMPLECTIC, 12}, {SBF_SCHEME_SYMPLECTIC, 16},
      {SBF_SCHEME_SYMPLECTIC, 32}, {SBF_SCHEME_SYMPLECTIC, 64}, {SBF_SCHEME_POSITION_BASED, 1},
      {SBF_SCHEME_POSITION_BASED, 4}, {SBF_SCHEME_POSITION_BASED, 8}, {SBF_SCHEME_POSITION_BASED, 16},
      {SBF_SCHEME_POSITION_BASED, 32}, {SBF_SCHEME_POSITION_BASED, 64}, {SBF_SCHEME_POSITION_BASED, 256},
      {SBF_SCHEME_HEUN, 16}, {SBF_SCHEME_HEUN, 32}, {SBF_SCHEME_HEUN, 64}, {SBF_SCHEME_EXPLICIT_EULER, 64},
      {SBF_SCHEME_EXPLICIT_EULER, 256}, {SBF_SCHEME_EXPLICIT_EULER, 1024}};
  sbf_asset *asset = beam_of_springs(2, 10, 0.1f, 20000);
  const sbf_level *level = &asset->soft_bodies.at[0].levels.at[0];
  uint32_t springs = level->springs.at[0].ends.count;
  sbf_vec3 exact[SWING_TICKS], tips[SWING_TICKS];
  track(asset, SBF_SCHEME_SYMPLECTIC, 1024, exact);
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    track(asset, cases[i].scheme, cases[i].substeps, tips);
    double error = error_of(tips, exact),
           s = time_of(asset, cases[i].scheme, cases[i].substeps, SWING_TICKS, bench_round_count(9));
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
  measure_cost("cloth", cloth_of_springs(quick ? 20 : 200), quick);
  measure_cost("beam", beam_of_springs(quick ? 2 : 10, quick ? 5 : 50, 0.02f, 3000), quick);
  measure_errors();
  return 0;
}
