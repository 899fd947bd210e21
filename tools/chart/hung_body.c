#include "chart/hung_body.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/fault.h"
#include "chart/made_bodies.h"
#include "chart/subject.h"
#include "chart/watched_motion.h"
#include "sbfmt/mechanics.h"

const char *const chart_elastic_names[] = {"springs", "tetrahedra", "regions"};

/* Sag: single precision resolves a ten-thousandth of it, and ten times its energy causes less strain than
 * the runtime's damping threshold (docs/solvers.md). */
static const double SAG_M = 0.0015;
/* Step size that counts as exact: a small fraction of the lowest mode's period. */
static const double FINE_TURN = 0.1;
/* Phase of the lowest mode between samples, number of samples, and maximum number of ticks. */
static const double VIEW_TURN = 0.3;
enum { SAMPLES = 32, MAX_TICKS = 8000 };

static sbf_status no_memory(sbf_diagnostic *error) {
  return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a body to chart");
}

/* ---- Bodies ---- */

enum { LINKS = 5, BAR_ELEMENTS = 60 };
static const double LINK_N_M = 1000, LINK_KG = 1, DENSITY = 1000, YOUNG_PA = 2e4, WIDE_M = 0.2;

static sbf_level *level_of(const sbf_asset *asset) {
  return (sbf_level *)(uintptr_t)asset->soft_bodies.at[0].levels.at;
}

/* Multiplies the masses at the free end; returns the added mass, kg, negative if memory runs out. */
static double load_end(sbf_asset *asset, double mass_ratio) {
  sbf_level *level = level_of(asset);
  uint32_t count = level->positions.count;
  float *masses = sbf_asset_allocate(asset, count, sizeof *masses);
  uint8_t *pinned = calloc(count, 1);
  double more = 0, end = -INFINITY;
  if (masses && pinned) {
    sbf_level_pinned_points(level, pinned);
    sbf_level_masses(&asset->soft_bodies.at[0], level, pinned, masses);
    for (uint32_t i = 0; i < count; i++) end = fmax(end, (double)level->positions.at[i].x);
    for (uint32_t i = 0; i < count; i++) {
      if (pinned[i] || (double)level->positions.at[i].x < end - 1e-3) continue;
      more += (mass_ratio - 1) * (double)masses[i];
      masses[i] *= (float)mass_ratio;
    }
    level->masses = (sbf_f32_list){masses, count};
  }
  free(pinned);
  return masses && pinned ? more : -1;
}

/* Sag per m/s^2 of a bar by Euler-Bernoulli theory, with the additional mass at its end. */
static double bar_sag(double more_kg) {
  double bends = YOUNG_PA * pow(WIDE_M, 4) / 12;
  return DENSITY * WIDE_M * WIDE_M / (8 * bends) + more_kg / (3 * bends);
}

/* `stiffer`: factor on its modulus; the sag is then unknown. */
static sbf_status fill(chart_elastic elastic, double mass_ratio, double poisson_ratio, double stiffer,
    sbf_asset **asset, double *sag, sbf_diagnostic *error) {
  if (elastic == CHART_OF_SPRINGS) {
    *asset = chart_hung_chain(LINKS, 0.2f, (float)LINK_KG, (float)(LINK_KG * mass_ratio), (float)LINK_N_M);
    *sag = LINK_KG * (LINKS * (LINKS - 1) / 2.0 + LINKS * mass_ratio) / LINK_N_M;
    return *asset ? SBF_OK : no_memory(error);
  }
  const chart_matter matter = {(float)DENSITY, (float)(YOUNG_PA * stiffer), (float)poisson_ratio, 0};
  const chart_filling filling = {.interior = elastic == CHART_OF_TETRAHEDRA
                                                 ? SBF_BUILD_INTERIOR_TETRAHEDRA
                                                 : SBF_BUILD_INTERIOR_SHAPE_MATCHING,
      .elements = BAR_ELEMENTS};
  sbf_status status = chart_fill(chart_bar(&matter), &filling, asset, error);
  double more = status == SBF_OK ? load_end(*asset, mass_ratio) : 0;
  if (status == SBF_OK && more < 0) status = no_memory(error);
  *sag = bar_sag(more);
  return status;
}

/* ---- The stiffest mode ---- */

static sbf_status highest_of_network(const sbf_asset *asset, double *highest, sbf_diagnostic *error) {
  enum { ITERATIONS = 1000 };
  const sbf_soft_body *is = &asset->soft_bodies.at[0];
  const sbf_level *level = level_of(asset);
  uint32_t count = level->positions.count, tetrahedra = level->lattice.tetrahedra.count;
  uint32_t springs = level->springs.count ? level->springs.at[0].ends.count : 0;
  float *masses = calloc(count, sizeof *masses), *factors = calloc(count, sizeof *factors);
  float *stiffness = calloc(springs + 1, sizeof *stiffness), *moduli = calloc(tetrahedra + 1, sizeof *moduli);
  float *ratios = calloc(tetrahedra + 1, sizeof *ratios);
  uint8_t *pinned = calloc(count, 1);
  double *scratch = calloc(6 * (size_t)count, sizeof *scratch);
  bool good = masses && factors && stiffness && moduli && ratios && pinned && scratch;
  if (good) {
    sbf_level_pinned_points(level, pinned);
    sbf_level_masses(is, level, pinned, masses);
    for (uint32_t i = 0; i < count; i++) masses[i] = pinned[i] ? 0 : masses[i];
    for (uint32_t i = 0; i < springs; i++) stiffness[i] = level->springs.at[0].stiffness.at[0];
    if (tetrahedra) sbf_level_moduli(is, level, factors, moduli);
    for (uint32_t i = 0; i < tetrahedra; i++) ratios[i] = is->attributes.poisson_ratio;
    const sbf_spring_network network = {.point_count = count,
        .spring_count = springs,
        .positions = level->positions.at,
        .masses = masses,
        .ends = springs ? level->springs.at[0].ends.at : NULL,
        .stiffness = stiffness,
        .tetrahedron_count = tetrahedra,
        .tetrahedra = level->lattice.tetrahedra.at,
        .young_modulus = moduli,
        .poisson_ratios = ratios};
    *highest = sbf_network_highest(&network, ITERATIONS, scratch);
  }
  free(masses), free(factors), free(stiffness), free(moduli), free(ratios), free(pinned), free(scratch);
  return good ? SBF_OK : no_memory(error);
}

/* For regions: number of substeps of a 1/60 s tick that the runtime chooses for the same undamped body at
 * a million times the stiffness; docs/solvers.md has its margin. */
static sbf_status highest_of_regions(
    double mass_ratio, double poisson_ratio, double *highest, sbf_diagnostic *error) {
  static const double MARGIN = 1.02, STIFFER = 1e6;
  sbf_asset *asset = NULL;
  sbr_model *model = NULL;
  sbr_model_options options = sbr_default_model_options();
  options.scheme = SBF_SCHEME_SYMPLECTIC;
  double sag;
  sbf_status status = fill(CHART_OF_REGIONS, mass_ratio, poisson_ratio, STIFFER, &asset, &sag, error);
  if (status == SBF_OK) {
    ((sbf_soft_body *)(uintptr_t)asset->soft_bodies.at)->attributes.damping_ratio = 0;
    status = sbr_model_create(asset, &options, &model, error);
  }
  if (status == SBF_OK) *highest = 2 * 60 * sbr_model_get_substeps(model) / MARGIN / sqrt(STIFFER);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
  return status;
}

/* ---- What is seen ---- */

/* Least squares fit of x[n+1] = a x[n] + b x[n-1] + c. */
typedef struct fit {
  double complex rate; /* 1/s: of the slowest decaying root */
  double rests_at;
} fit;

static double determinant(double m[3][3]) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

static bool fit_to(const double *x, uint32_t count, double every_s, fit *f) {
  double m[3][3] = {{0}}, right[3] = {0}, solved[3];
  for (uint32_t n = 1; n + 1 < count; n++) {
    const double row[3] = {x[n], x[n - 1], 1};
    for (int i = 0; i < 3; i++) {
      for (int k = 0; k < 3; k++) m[i][k] += row[i] * row[k];
      right[i] += row[i] * x[n + 1];
    }
  }
  double all = determinant(m);
  if (!(fabs(all) > 1e-12 * m[0][0] * m[1][1] * m[2][2])) return false;
  for (int k = 0; k < 3; k++) {
    double with[3][3];
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) with[i][j] = j == k ? right[i] : m[i][j];
    solved[k] = determinant(with) / all;
  }
  double a = solved[0], b = solved[1];
  double complex half = csqrt((double complex)(a * a / 4 + b)), root = a / 2 + half, other = a / 2 - half;
  if (cabs(other) > cabs(root)) root = other;
  f->rate = clog(root) / every_s;
  f->rests_at = solved[2] / (1 - a - b);
  return isfinite(creal(f->rate)) && isfinite(f->rests_at);
}

/* A run: projected displacements of the points, one per sample. */
typedef struct run {
  chart_motion motion;
  double every_s;
  uint32_t ticks_per_sample;
  sbf_vec3 *positions, *rest; /* (points) */
} run;

static void run_close(run *r) {
  chart_motion_close(&r->motion);
  free(r->positions), free(r->rest);
}

static sbf_status run_open(
    const chart_hung_body *body, sbf_scheme scheme, double turn, run *r, sbf_diagnostic *error) {
  const double tick_s = turn / body->highest_rad_s;
  const sbf_level *level = level_of(body->asset);
  body->asset->environment.control_tick = (float)tick_s;
  double separation = VIEW_TURN / (body->swings_rad_s * tick_s);
  *r = (run){.ticks_per_sample = separation < 1                     ? 1
                                 : separation > MAX_TICKS / SAMPLES ? MAX_TICKS / SAMPLES
                                                                    : (uint32_t)separation};
  r->every_s = r->ticks_per_sample * tick_s;
  r->positions = calloc(body->points, sizeof *r->positions);
  r->rest = calloc(body->points, sizeof *r->rest);
  if (!r->positions || !r->rest) return no_memory(error);
  for (uint32_t i = 0; i < body->points; i++) r->rest[i] = level->positions.at[i];
  const chart_scene scene = {.asset = body->asset,
      .has_gravity = true,
      .gravity = {0, (float)-body->weight_m_s2, 0},
      .ticks = MAX_TICKS,
      .watch = CHART_WATCH_POINTS};
  const chart_setting setting = {.scheme = scheme, .substeps = 1};
  return chart_motion_open(&r->motion, &scene, &setting, error);
}

/* Advances to the next sample; returns the largest distance of a point from rest, m. NAN: invalid numbers,
 * or the body was reset to its rest shape; *why has the reason. */
static double run_on(run *r, uint32_t points, const char **why) {
  chart_motion *m = &r->motion;
  double max = 0;
  for (uint32_t t = 0; t < r->ticks_per_sample; t++) sbr_world_tick(m->world);
  sbr_body_health health = sbr_character_get_body_health(m->world, m->character, 0);
  sbr_character_get_points(m->world, m->character, 0, r->positions, points);
  for (uint32_t i = 0; i < points; i++) {
    double x = (double)r->positions[i].x - (double)r->rest[i].x,
           y = (double)r->positions[i].y - (double)r->rest[i].y;
    double z = (double)r->positions[i].z - (double)r->rest[i].z;
    max = fmax(max, sqrt(x * x + y * y + z * z));
  }
  if (health.recoveries) *why = "lost its shape and was put back into it";
  if (!health.finite || !isfinite(max)) *why = "numbers that are none";
  return *why ? NAN : max;
}

static double measured(const chart_hung_body *body, const run *r) {
  double x = 0;
  for (uint32_t i = 0; i < body->points; i++) {
    const double *s = &body->shape[3 * (size_t)i];
    x += s[0] * ((double)r->positions[i].x - (double)r->rest[i].x) +
         s[1] * ((double)r->positions[i].y - (double)r->rest[i].y) +
         s[2] * ((double)r->positions[i].z - (double)r->rest[i].z);
  }
  return x;
}

/* ---- The row's own ---- */

/* Lowest mode: the displacement at maximum sag, with steps that are accurate for all modes. */
static sbf_status store_shape(chart_hung_body *body, sbf_diagnostic *error) {
  run r;
  const char *why = NULL;
  float *masses = calloc(body->points, sizeof *masses);
  uint8_t *pinned = calloc(body->points, 1);
  sbf_status status = masses && pinned ? SBF_OK : no_memory(error);
  if (status == SBF_OK) status = run_open(body, SBF_SCHEME_SYMPLECTIC, FINE_TURN, &r, error);
  if (status == SBF_OK) {
    sbf_level_pinned_points(level_of(body->asset), pinned);
    sbf_level_masses(&body->asset->soft_bodies.at[0], level_of(body->asset), pinned, masses);
    for (uint32_t n = 0; n < SAMPLES; n++) {
      double max = run_on(&r, body->points, &why);
      if (!(max > body->farthest_m)) continue;
      body->farthest_m = max;
      for (uint32_t i = 0; i < body->points; i++) {
        double kg = pinned[i] ? 0 : (double)masses[i];
        body->shape[3 * (size_t)i] = kg * ((double)r.positions[i].x - (double)r.rest[i].x);
        body->shape[3 * (size_t)i + 1] = kg * ((double)r.positions[i].y - (double)r.rest[i].y);
        body->shape[3 * (size_t)i + 2] = kg * ((double)r.positions[i].z - (double)r.rest[i].z);
      }
    }
    run_close(&r);
  }
  free(masses), free(pinned);
  return status;
}

/* Runs all samples, and at least as many ticks as a cell of one mass; false if it breaks. */
static bool check(const chart_hung_body *body, run *r, double x[SAMPLES], chart_verdict *v) {
  const char *why = NULL;
  for (uint32_t n = 0; n < SAMPLES || n * r->ticks_per_sample < CHART_CELL_TICKS; n++) {
    double max = run_on(r, body->points, &why);
    if (n < SAMPLES) x[n] = measured(body, r);
    if (isfinite(max)) v->reached = fmax(v->reached, max / body->farthest_m);
    if (!why && v->reached * v->reached > CHART_GAIN) why = "more than ten times its energy";
    if (!why) continue;
    v->outcome = CHART_DEAD;
    snprintf(v->why, sizeof v->why, "%s", why);
    return false;
  }
  return true;
}

static sbf_status measure_rate(chart_hung_body *body, sbf_diagnostic *error) {
  run r;
  double x[SAMPLES];
  fit f;
  chart_verdict v = {.outcome = CHART_SOUND};
  sbf_status status = run_open(body, SBF_SCHEME_SYMPLECTIC, FINE_TURN, &r, error);
  if (status != SBF_OK) return status;
  bool good = check(body, &r, x, &v) && fit_to(x, SAMPLES, r.every_s, &f);
  run_close(&r);
  if (!good) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "a body to chart does not swing in fine steps");
  body->rate[0] = creal(f.rate), body->rate[1] = fabs(cimag(f.rate));
  body->rests_at = f.rests_at;
  return SBF_OK;
}

sbf_status chart_hung_body_make(chart_elastic elastic, double mass_ratio, double poisson_ratio,
    chart_hung_body *body, sbf_diagnostic *error) {
  double sag = 0;
  *body = (chart_hung_body){.asset = NULL};
  sbf_status status = fill(elastic, mass_ratio, poisson_ratio, 1, &body->asset, &sag, error);
  if (status == SBF_OK)
    status = elastic == CHART_OF_REGIONS
                 ? highest_of_regions(mass_ratio, poisson_ratio, &body->highest_rad_s, error)
                 : highest_of_network(body->asset, &body->highest_rad_s, error);
  if (status == SBF_OK) {
    sbf_soft_body *is = (sbf_soft_body *)(uintptr_t)body->asset->soft_bodies.at;
    is->attributes.damping_ratio = 0;
    is->attributes.stiffness_damping =
        (float)(2 * CHART_SHARED_DAMPING_PERCENT / 100.0 / body->highest_rad_s);
    body->weight_m_s2 = SAG_M / sag;
    body->swings_rad_s = sqrt(1.3 / sag);
    body->points = level_of(body->asset)->positions.count;
    body->shape = calloc(3 * (size_t)body->points, sizeof *body->shape);
    status = body->shape ? store_shape(body, error) : no_memory(error);
  }
  if (status == SBF_OK) status = measure_rate(body, error);
  if (status != SBF_OK) chart_hung_body_free(body);
  return status;
}

void chart_hung_body_free(chart_hung_body *body) {
  sbf_asset_free(body->asset);
  free(body->shape);
  *body = (chart_hung_body){.asset = NULL};
}

sbf_status chart_hung_body_evaluate(const chart_hung_body *body, sbf_scheme scheme, double turn,
    chart_verdict *verdict, sbf_diagnostic *error) {
  run r;
  double x[SAMPLES];
  fit f;
  sbf_diagnostic why;
  *verdict = (chart_verdict){.outcome = CHART_SOUND, .off = NAN};
  sbf_status status = run_open(body, scheme, turn, &r, &why);
  if (status != SBF_OK && !r.rest) {
    *error = why;
    run_close(&r);
    return status;
  }
  if (status != SBF_OK) {
    verdict->outcome = CHART_REFUSED;
    snprintf(verdict->why, sizeof verdict->why, "%.90s", why.message);
  } else if (check(body, &r, x, verdict)) {
    double complex exact = body->rate[0] + I * body->rate[1];
    bool swings = fit_to(x, SAMPLES, r.every_s, &f);
    if (swings) verdict->off = cabs(creal(f.rate) + I * fabs(cimag(f.rate)) - exact) / cabs(exact);
    double hangs = swings ? fabs(f.rests_at / body->rests_at - 1) : 0;
    bool biased = !(verdict->off <= CHART_BIAS) || hangs > CHART_BIAS;
    verdict->outcome = biased ? CHART_BIASED : CHART_SOUND;
    if (biased)
      snprintf(verdict->why, sizeof verdict->why, "%s",
          !swings                      ? "no swing to be seen: it is at rest within two looks"
          : verdict->off <= CHART_BIAS ? "hangs elsewhere"
                                       : "decay or frequency off");
  }
  run_close(&r);
  return SBF_OK;
}
