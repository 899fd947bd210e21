/* Measures a falling character of soft sections on bones: the example lizard with 22 sections of springs
 * on 22 rigid bodies. It drops limp from its stand and lies for the rest of three seconds. Nothing sleeps.
 *
 * `steps` is the requested number of rigid substeps per tick (`rigid_substeps`). 0: the runtime chooses,
 * and bones carry the mass of their attached soft bodies. 64: more than the stiffness needs, so bones
 * carry no such mass; this is the reference for `bone_mm` and `flesh_mm`. Both are root mean square
 * distances of rigid bodies and of points from the reference, over the first third of a second, in which
 * it hits the ground. `tick_us` is the mean processor time of a tick, the minimum of the rounds. `walk_us`
 * is the same for the walking character.
 *
 * Fails if the character ends at another position. */
#include <math.h>
#include <stdlib.h>

#include "measured_assets.h"
#include "measuring.h"
#include "sbrun/rigid.h"

enum { TICKS = 180, COMPARED = 20, MAX_POINTS = 16384, MAX_BODIES = 64 };

typedef struct knock {
  double tick_us;
  uint32_t body_count, point_count;
  sbf_vec3 (*bodies)[MAX_BODIES], (*points)[MAX_POINTS]; /* (COMPARED) */
} knock;

static knock knock_of(uint32_t body_count) {
  return (knock){.body_count = body_count,
      .bodies = bench_allocate(COMPARED, sizeof(sbf_vec3[MAX_BODIES])),
      .points = bench_allocate(COMPARED, sizeof(sbf_vec3[MAX_POINTS]))};
}

static void knock_free(knock *k) {
  free(k->bodies);
  free(k->points);
}

static void note(const sbr_world *world, sbr_character_id id, const sbf_asset *asset, knock *k, int tick) {
  k->point_count = 0;
  for (uint32_t b = 0; b < k->body_count; b++)
    k->bodies[tick][b] = sbr_character_get_rigid_state(world, id, b).center;
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++)
    k->point_count +=
        sbr_character_get_points(world, id, b, k->points[tick] + k->point_count, MAX_POINTS - k->point_count);
}

static double run(const sbf_asset *asset, const sbr_model *model, bool falls, int ticks, knock *k) {
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  sbr_world *world;
  sbr_character_id id;
  sbf_diagnostic error;
  double taken = 0;
  definition.ground = sbr_ground_flat(0);
  definition.sleep_after_s = 0;
  bench_require(sbr_world_create(&definition, &world, &error), &error);
  bench_require(sbr_character_create(world, model, &standing, &id, &error), &error);
  if (falls)
    sbr_character_set_rigid_mode(world, id, -1, SBR_RIGID_PASSIVE);
  else
    sbr_character_set_drive(world, id, 0.3f, 0, 0);
  for (int t = 0; t < ticks; t++) {
    double begin = bench_now_s();
    sbr_world_tick(world);
    taken += bench_now_s() - begin;
    if (k && t < COMPARED) note(world, id, asset, k, t);
  }
  sbr_world_destroy(world);
  return 1e6 * taken / ticks;
}

static double off_mm(const sbf_vec3 *a, const sbf_vec3 *b, uint32_t count) {
  double sum = 0;
  for (uint32_t i = 0; i < count; i++) {
    double x = (double)(a[i].x - b[i].x), y = (double)(a[i].y - b[i].y), z = (double)(a[i].z - b[i].z);
    sum += x * x + y * y + z * z;
  }
  return sum / count;
}

int main(int argument_count, char **arguments) {
  static const uint32_t steps[] = {64, 40, 32, 16, 12, 8, 0};
  enum { CASES = sizeof steps / sizeof *steps };
  bool quick = bench_is_quick(argument_count, arguments);
  sbf_asset *asset = our_lizard(true);
  sbr_model *models[CASES];
  sbf_diagnostic error;
  knock knocks[CASES];
  double walk_us = 0;
  int rounds = (int)bench_round_count(5), ticks = quick ? COMPARED : TICKS;
  if (asset->rigid_bodies.count > MAX_BODIES) bench_fail("the lizard has too many bodies");
  for (int i = 0; i < CASES; i++) {
    sbr_model_options options = sbr_default_model_options();
    options.rigid_substeps = steps[i];
    bench_require(sbr_model_create(asset, &options, &models[i], &error), &error);
    knocks[i] = knock_of(asset->rigid_bodies.count);
  }
  for (int r = 0; r < rounds; r++) {
    for (int i = 0; i < CASES; i++) {
      double us = run(asset, models[i], true, ticks, &knocks[i]);
      if (r == 0 || us < knocks[i].tick_us) knocks[i].tick_us = us;
    }
    double us = run(asset, models[CASES - 1], false, ticks, NULL);
    if (r == 0 || us < walk_us) walk_us = us;
  }
  bench_print_columns("scene,sections,steps,tick_us,walk_us,bone_mm,flesh_mm");
  for (int i = 0; i < CASES; i++) {
    double bones = 0, soft = 0;
    for (int t = 0; t < COMPARED; t++) {
      bones += off_mm(knocks[i].bodies[t], knocks[0].bodies[t], knocks[i].body_count) / COMPARED;
      soft += off_mm(knocks[i].points[t], knocks[0].points[t], knocks[i].point_count) / COMPARED;
    }
    bench_print_row("knocked lizard,%u,%u,%.0f,%.0f,%.3f,%.3f", asset->soft_bodies.count, steps[i],
        knocks[i].tick_us, walk_us, 1e3 * sqrt(bones), 1e3 * sqrt(soft));
    if (!(bones < 1e-5) || !(soft < 4e-5)) bench_fail("it goes elsewhere in %u steps", steps[i]);
    sbr_model_destroy(models[i]);
  }
  for (int i = 0; i < CASES; i++) knock_free(&knocks[i]);
  sbf_asset_free(asset);
  return 0;
}
