#include "chart/bundle_case.h"

#include <math.h>

#include "render/fault.h"
#include "sbfmt/mechanics.h"

/* Its own heights a second, and how many heights a hop is high. */
static const double SPEED = 0.5, HOP = 0.1;
enum { TICKS = 120, HOP_TICKS = 30, TURN_TICKS = 15 };
static const float TURN_RAD_S = 2.5f;

static void walk(void *user, sbr_world *world, sbr_character_id character, uint32_t tick) {
  const chart_bundle *b = user;
  if (tick == 0) sbr_character_drive(world, character, (float)b->speed_m_s, 0, 0);
}

/* What it stands on goes up and down along parabolas, two a second. */
static void hop(void *user, sbr_world *world, sbr_character_id character, uint32_t tick) {
  chart_bundle *b = user;
  double share = tick % HOP_TICKS / (double)HOP_TICKS;
  b->ground_m = 4 * b->hop_m * share * (1 - share);
  if (tick == 0) sbr_character_wake(world, character);
}

/* From side to side, a quarter of a second each. */
static void shake(void *user, sbr_world *world, sbr_character_id character, uint32_t tick) {
  (void)user;
  if (tick % TURN_TICKS == 0)
    sbr_character_drive(world, character, 0, 0, tick / TURN_TICKS % 2 ? -TURN_RAD_S : TURN_RAD_S);
}

static double ground_height(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  const chart_bundle *b = ground->user;
  (void)x, (void)z;
  *normal = (sbf_vec3){0, 1, 0};
  return b->ground_m;
}

sbf_status chart_bundle_cases(
    const sbf_asset *asset, chart_bundle *bundle, chart_case *cases, sbf_diagnostic *error) {
  static const chart_case kinds[CHART_BUNDLE_CASES] = {
      {.name = "walk", .title = "half its height a second forwards: two seconds", .guide = walk},
      {.name = "hop",
          .title = "the ground throws it up by a tenth of its height, twice a second: two seconds",
          .guide = hop},
      {.name = "shake",
          .title = "turned by 2.5 rad/s to and fro, a quarter of a second each: two seconds",
          .guide = shake}};
  sbf_asset_measures measures;
  bool soft = asset->soft_bodies.count > 0;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    soft = soft && asset->soft_bodies.at[i].levels.count;
  if (!soft)
    return fault_set(error, SBF_CODE_REQUIRED_MISSING,
        "there is no soft body with a level to chart, or one without: sbfmt build makes them");
  sbf_asset_measure(asset, &measures);
  double tall = fmax((double)measures.high.y - (double)measures.low.y, 0.01);
  *bundle = (chart_bundle){.asset = asset, .speed_m_s = SPEED * tall, .hop_m = HOP * tall};
  bundle->ground = (sbr_ground){.height = ground_height, .user = bundle};
  for (int i = 0; i < CHART_BUNDLE_CASES; i++) {
    cases[i] = kinds[i];
    cases[i].given = asset;
    cases[i].user = bundle;
    cases[i].ground = &bundle->ground;
    cases[i].ticks = TICKS;
    cases[i].grounded = true;
    cases[i].watch = asset->render_meshes.count ? CHART_WATCH_SKIN : CHART_WATCH_SURFACE;
    cases[i].axes = 1u << CHART_PATH | 1u << CHART_FARTHEST | 1u << CHART_PIXELS | 1u << CHART_MOST_PIXELS |
                    1u << CHART_VOLUME;
  }
  return SBF_OK;
}
