#include "chart/bundle_case.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fault.h"
#include "sbfmt/mechanics.h"

/* Times are taken over its beginning: the first step, hop or turn. */
enum { TICKS = 120, TIMED_TICKS = 30 };
static const double SIMILAR_M = 2; /* maximum size for which the drive is as stated */

const chart_drive chart_usual_drive = {.speed = 0.5,
    .curve_rad_s = 0,
    .hop = 0.02,
    .hop_ticks = {30, 30},
    .turn_rad_s = 2.5f,
    .turn_ticks = {15, 15}};

static void walk(void *user, sbr_world *world, sbr_character_id character, uint32_t tick) {
  const chart_bundle *b = user;
  if (tick == 0) sbr_character_set_drive(world, character, (float)b->speed_m_s, 0, b->drive.curve_rad_s);
}

/* The tick within a hop or turn, and the number of those before it. */
typedef struct beat {
  uint32_t tick, ticks, number;
} beat;

static beat beat_at(const uint32_t ticks[2], uint32_t tick) {
  uint32_t both = ticks[0] + ticks[1], at = tick % both, second = at >= ticks[0];
  return (beat){at - second * ticks[0], ticks[second], 2 * (tick / both) + second};
}

/* The ground rises and falls along parabolas. Planted feet stay in place, so it presses into their soles:
 * a tenth of its height would flatten the hands of a lizard. */
static void hop(void *user, sbr_world *world, sbr_character_id character, uint32_t tick) {
  chart_bundle *b = user;
  beat now = beat_at(b->drive.hop_ticks, tick);
  double fraction = now.tick / (double)now.ticks;
  b->ground_m = 4 * b->hop_m * fraction * (1 - fraction);
  if (tick == 0) sbr_character_wake(world, character);
}

/* Turns from side to side. */
static void shake(void *user, sbr_world *world, sbr_character_id character, uint32_t tick) {
  const chart_drive *d = &((const chart_bundle *)user)->drive;
  beat now = beat_at(d->turn_ticks, tick);
  if (now.tick == 0)
    sbr_character_set_drive(world, character, 0, 0, now.number % 2 ? -d->turn_rad_s : d->turn_rad_s);
}

static void level_ground(void *user) {
  ((chart_bundle *)user)->ground_m = 0;
}

static double ground_height(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  const chart_bundle *b = ground->user;
  (void)x, (void)z;
  *normal = (sbf_vec3){0, 1, 0};
  return b->ground_m;
}

/* Drive of a character of this size (largest extent, m): its times grow with the square root of it. */
static chart_drive similar_drive(chart_drive drive, double size_m) {
  double slower = sqrt(fmax(size_m / SIMILAR_M, 1));
  drive.turn_rad_s = (float)((double)drive.turn_rad_s / slower);
  for (int i = 0; i < 2; i++) {
    drive.hop_ticks[i] = (uint32_t)lround(drive.hop_ticks[i] * slower);
    drive.turn_ticks[i] = (uint32_t)lround(drive.turn_ticks[i] * slower);
  }
  return drive;
}

/* Name of the character, without characters that are special in gnuplot. */
static void entitle(char *title, size_t size, const char *whose, const char *motion) {
  char name[48];
  size_t length = 0;
  for (; whose && *whose && length + 1 < sizeof name; whose++)
    if (!strchr("{}_^@&~\\'\"`$%", *whose) && (unsigned char)*whose > 31) name[length++] = *whose;
  if (whose && (*whose & 0xc0) == 0x80) /* within a multi-byte character */
    while (length && (name[--length] & 0xc0) == 0x80) continue;
  name[length] = 0;
  snprintf(title, size, "%s%s%s", name, length ? ", " : "", motion);
}

/* Title with the usual drive, slowed down for this character. */
static void describe_motion(const chart_bundle *b, uint32_t number, char *text, size_t size) {
  static const double tick_s = 1.0 / 60;
  const chart_drive *d = &b->drive;
  if (number == 0)
    snprintf(text, size, "half its height a second forwards: two seconds");
  else if (number == 1)
    snprintf(text, size, "the ground under it rises by %.3g of its height, each %.2g s: two seconds", d->hop,
        tick_s * d->hop_ticks[0]);
  else
    snprintf(text, size, "turned by %.2g rad/s to and fro, %.2g s each: two seconds", (double)d->turn_rad_s,
        tick_s * d->turn_ticks[0]);
}

sbf_status chart_bundle_cases(const sbf_asset *asset, const chart_drive *drive, chart_bundle *bundle,
    chart_case *cases, sbf_diagnostic *error) {
  static const chart_case kinds[CHART_BUNDLE_CASES] = {{.name = "walk", .before_tick = walk},
      {.name = "hop", .before_tick = hop}, {.name = "shake", .before_tick = shake}};
  char motion[96];
  sbf_asset_measures measures;
  bool soft = asset->soft_bodies.count > 0;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++)
    soft = soft && asset->soft_bodies.at[i].levels.count;
  if (!soft)
    return fault_set(error, SBF_CODE_REQUIRED_MISSING,
        "there is no soft body with a level to chart, or one without: sbfmt build makes them");
  sbf_asset_measure(asset, &measures);
  double wide = (double)measures.high.x - (double)measures.low.x,
         tall = fmax((double)measures.high.y - (double)measures.low.y, 0.01),
         deep = (double)measures.high.z - (double)measures.low.z;
  *bundle = (chart_bundle){.asset = asset,
      .drive = similar_drive(drive ? *drive : chart_usual_drive, fmax(wide, fmax(tall, deep)))};
  bundle->speed_m_s = bundle->drive.speed * tall;
  bundle->hop_m = bundle->drive.hop * tall;
  bundle->ground = (sbr_ground){.height = ground_height, .user = bundle};
  for (int i = 0; i < CHART_BUNDLE_CASES; i++) {
    cases[i] = kinds[i];
    describe_motion(bundle, (uint32_t)i, motion, sizeof motion);
    entitle(bundle->titles[i], sizeof bundle->titles[i], asset->info.title, motion);
    cases[i].title = bundle->titles[i];
    cases[i].given = asset;
    cases[i].begin = level_ground;
    cases[i].user = bundle;
    cases[i].ground = &bundle->ground;
    cases[i].ticks = TICKS;
    cases[i].timed_ticks = TIMED_TICKS;
    cases[i].grounded = true;
    cases[i].watch = asset->render_meshes.count ? CHART_WATCH_SKIN : CHART_WATCH_SURFACE;
    cases[i].axes = 1u << CHART_PATH | 1u << CHART_FARTHEST | 1u << CHART_PIXELS | 1u << CHART_MAX_PIXELS |
                    1u << CHART_VOLUME;
  }
  return SBF_OK;
}
