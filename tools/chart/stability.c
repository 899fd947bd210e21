#include "chart/stability.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/fault.h"
#include "chart/subject.h"
#include "chart/watched_motion.h"

const char *const chart_outcome_names[] = {"sound", "biased", "dead", "refused"};

static const double TICK_S = 1.0 / 60, MASS_KG = 1;

/* ---- What is predicted ---- */

/* Whether Heun's step of exp(s) grows: |1 + s + s^2/2| > 1. */
static bool heun_grows(double turn, double damping) {
  double complex s = turn * (-damping + I * sqrt(1 - damping * damping));
  return cabs(1 + s + s * s / 2) > 1;
}

double chart_stable_below(sbf_scheme scheme, double damping) {
  if (scheme == SBF_SCHEME_POSITION_BASED || scheme == SBF_SCHEME_BLOCK_DESCENT) return INFINITY;
  /* Jury's criteria on the step's characteristic polynomial. */
  if (scheme == SBF_SCHEME_SYMPLECTIC) return 2 * (sqrt(1 + damping * damping) - damping);
  if (scheme == SBF_SCHEME_EXPLICIT_EULER) return 2 * damping;
  if (scheme != SBF_SCHEME_HEUN) return NAN;
  double low = 0, high = 4;
  if (!(damping > 0)) return 0;
  for (int i = 0; i < 60; i++) {
    double middle = (low + high) / 2;
    if (heun_grows(middle, damping))
      high = middle;
    else
      low = middle;
  }
  return low;
}

/* ---- What is seen ---- */

/* Least squares fit of x[n+1] = a x[n] + b x[n-1] over all triples of consecutive ticks. For a spring
 * along its own line every scheme's step is linear, so it is exact and needs no complete period. */
typedef struct recurrence {
  double xx, xy, yy, xz, yz;
} recurrence;

static void take(recurrence *r, double before, double now, double next) {
  r->xx += now * now, r->xy += now * before, r->yy += before * before;
  r->xz += now * next, r->yz += before * next;
}

/* Error of its slowest decaying root relative to the exact rate, divided by w. */
static double off_of(const recurrence *r, const chart_cell *cell) {
  double determinant = r->xx * r->yy - r->xy * r->xy;
  if (!(fabs(determinant) > 1e-12 * r->xx * r->yy)) return NAN;
  double a = (r->xz * r->yy - r->yz * r->xy) / determinant, b = (r->yz * r->xx - r->xz * r->xy) / determinant;
  double complex half = csqrt((double complex)(a * a / 4 + b)), root = a / 2 + half, other = a / 2 - half;
  if (cabs(other) > cabs(root)) root = other;
  double complex rate = clog(root) / cell->turn;
  double complex exact = -cell->damping + I * sqrt(1 - cell->damping * cell->damping);
  return cabs(creal(rate) + I * fabs(cimag(rate)) - exact);
}

/* Length of the next frame; `state` is that of a uniform random generator. */
static double frame_s(const chart_cell *cell, uint32_t frame, uint32_t *state) {
  *state = *state * 1664525u + 1013904223u;
  double chance = 2.0 * (*state >> 8) / 0x1p24 - 1;
  return TICK_S * (1 + cell->jitter * chance + (frame == 15 ? cell->slow_ticks : 0));
}

/* Height of its mass above equilibrium at the end of the last tick: from its weight's energy, because
 * displayed points are interpolated if frames do not end with a tick. */
static double height_of(const chart_motion *m, const chart_cell *cell, const sbr_body_health *health) {
  double origin = sbr_character_get_origin(m->world, m->character).y;
  return health->potential_j / (-MASS_KG * (double)m->scene.gravity.y) - origin + 1 + cell->stretch;
}

static void watch(chart_motion *m, const chart_cell *cell, chart_verdict *v) {
  recurrence seen = {0, 0, 0, 0, 0};
  double before = NAN, now = cell->stretch;
  uint32_t state = 1, frame = 0;
  uint64_t tick = 0;
  while (tick < CHART_CELL_TICKS && v->outcome != CHART_DEAD) {
    sbf_vec3 points[2] = {{0, 0, 0}, {0, 0, 0}};
    sbr_world_step(m->world, frame_s(cell, frame++, &state));
    uint64_t ran = sbr_world_get_tick_count(m->world) - tick;
    if (!ran) continue;
    tick += ran;
    sbr_character_get_points(m->world, m->character, 0, points, 2);
    sbr_body_health health = sbr_character_get_body_health(m->world, m->character, 0);
    double next = height_of(m, cell, &health);
    double aside = hypot((double)points[1].x, (double)points[1].z);
    if (ran == 1 && isfinite(before)) take(&seen, before, now, next);
    before = ran == 1 ? now : NAN, now = next;
    v->reached = fmax(v->reached, hypot(next, aside) / cell->stretch);
    const char *why = NULL;
    if (v->reached * v->reached > CHART_GAIN) why = "more than ten times its energy";
    if (health.recoveries) why = "lost its shape and was put back into it";
    if (!health.finite || !isfinite(next)) why = "numbers that are none";
    if (!why) continue;
    v->outcome = CHART_DEAD;
    snprintf(v->why, sizeof v->why, "%s", why);
  }
  v->off = off_of(&seen, cell);
  if (v->outcome == CHART_DEAD || v->off <= CHART_BIAS) return;
  v->outcome = CHART_BIASED;
  snprintf(v->why, sizeof v->why, "%s",
      isfinite(v->off) ? "decay or frequency off" : "no swing to be seen: it is at rest within two ticks");
}

sbf_status chart_cell_evaluate(const chart_cell *cell, chart_verdict *verdict, sbf_diagnostic *error) {
  double w = cell->turn / TICK_S;
  sbf_asset *asset = chart_mass_on_spring((float)MASS_KG, (float)(MASS_KG * w * w));
  *verdict = (chart_verdict){.outcome = CHART_SOUND, .off = NAN};
  if (!asset) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a body to chart");
  sbf_soft_body *body = (sbf_soft_body *)(uintptr_t)asset->soft_bodies.at;
  body->attributes.stiffness_damping = (float)(2 * cell->damping / w);
  /* Released unstretched, under a weight for this equilibrium stretch. */
  const chart_scene scene = {.asset = asset,
      .has_gravity = true,
      .gravity = {0, (float)(-w * w * cell->stretch), 0},
      .ticks = CHART_CELL_TICKS,
      .watch = CHART_WATCH_POINTS};
  const chart_setting setting = {.scheme = cell->scheme, .substeps = 1};
  chart_motion motion;
  sbf_diagnostic why;
  if (chart_motion_open(&motion, &scene, &setting, &why) == SBF_OK) {
    watch(&motion, cell, verdict);
  } else {
    verdict->outcome = CHART_REFUSED;
    snprintf(verdict->why, sizeof verdict->why, "%.90s", why.message);
  }
  chart_motion_close(&motion);
  sbf_asset_free(asset);
  return SBF_OK;
}
