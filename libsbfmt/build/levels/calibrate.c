#include "build/levels/calibrate.h"

#include <float.h>
#include <math.h>

/* Of the body's size: so little it may give under the loads for the fit, that all stays linear. */
static const double small_share = 1e-3;

/* Of the load, that may stay unbalanced. */
static const double small_tolerance = 1e-4, fall_tolerance = 1e-4;

static double fall_of(const sbf_asset *asset, const sbf_soft_body *body) {
  sbf_vec3 g = asset->environment.gravity;
  double size = sqrt((double)g.x * g.x + (double)g.y * g.y + (double)g.z * g.z);
  size *= fabs((double)body->attributes.gravity_scale);
  return size > 0 ? size : 9.81;
}

static sbfi_lattice_outcome measure(
    sbfi_reference *r, bool falls, sbfi_progress progress, sbfi_arena *scratch) {
  size_t numbers = 3 * (size_t)r->statics.body->surface.positions.count;
  double lowest = sbfi_level_lowest(&r->statics, scratch);
  if (!(lowest > 0)) return SBFI_LATTICE_MADE;
  r->small = small_share * r->statics.size * lowest * lowest;
  r->sound = true;
  for (uint32_t l = 0; l < r->statics.load_count; l++) {
    double **to[] = {&r->gives[l], &r->falls[l]};
    for (int k = 0; k < (falls ? 2 : 1); k++) {
      sbfi_rest rest;
      if (!sbfi_progress_say(progress, 0.5 + (l + 0.5 * k) / r->statics.load_count / 2))
        return SBFI_LATTICE_CANCELLED;
      *to[k] = sbfi_arena_allocate(&r->arena, numbers, sizeof(double));
      if (!*to[k] || !sbfi_level_give(&r->statics, l, k ? r->fall : r->small,
                         k ? fall_tolerance : small_tolerance, *to[k], &rest, scratch))
        return SBFI_LATTICE_NO_MEMORY;
      if (!rest.converged) *to[k] = NULL;
      if (k == 0 && rest.converged) {
        r->rests[l] = rest;
        r->yieldings[l] = sbfi_level_yielding(&r->statics, l, r->gives[l]);
      }
    }
  }
  return SBFI_LATTICE_MADE;
}

static sbfi_lattice_outcome take(sbfi_reference *r, const sbf_soft_body *body, const sbf_level *level,
    const sbfi_interior_map *interior, bool falls, sbfi_progress progress, sbfi_arena *scratch) {
  return sbfi_level_statics_make(&r->statics, body, level, interior, &r->arena)
             ? measure(r, falls, progress, scratch)
             : SBFI_LATTICE_NO_MEMORY;
}

sbfi_lattice_outcome sbfi_reference_take(sbfi_reference *reference, const sbf_soft_body *body,
    const sbf_level *level, const sbfi_interior_map *interior, const sbf_asset *asset, bool falls,
    sbfi_progress progress, const sbf_allocator *allocator) {
  sbfi_arena scratch;
  *reference = (sbfi_reference){.fall = fall_of(asset, body)};
  sbfi_arena_init(&reference->arena, allocator, 0);
  sbfi_arena_init(&scratch, allocator, 0);
  sbfi_lattice_outcome outcome = take(reference, body, level, interior, falls, progress, &scratch);
  sbfi_arena_free(&scratch);
  return outcome;
}

sbfi_lattice_outcome sbfi_reference_make(sbfi_reference *reference, const sbf_soft_body *body,
    const sbf_asset *asset, bool falls, sbfi_progress progress, const sbf_allocator *allocator) {
  sbfi_arena scratch;
  *reference = (sbfi_reference){.fall = fall_of(asset, body)};
  sbfi_arena_init(&reference->arena, allocator, 0);
  reference->memory = sbf_asset_create(allocator);
  if (!reference->memory) return SBFI_LATTICE_NO_MEMORY;
  reference->memory->bones = asset->bones;
  reference->memory->rigid_bodies = asset->rigid_bodies;
  sbfi_arena_init(&scratch, allocator, 0);
  sbfi_lattice_counts counts;
  const sbfi_lattice_recipe recipe = {.elements = SBFI_REFERENCE_ELEMENTS, .derivation = SBF_NONE};
  sbfi_lattice_outcome outcome = sbfi_lattice_level_make(
      &reference->made, body, &recipe, reference->memory, &counts, progress, &scratch);
  if (outcome == SBFI_LATTICE_MADE && counts.tetrahedra > 0)
    outcome = take(reference, body, &reference->made, NULL, falls, progress, &scratch);
  sbfi_arena_free(&scratch);
  return outcome;
}

void sbfi_reference_free(sbfi_reference *reference) {
  sbf_asset_free(reference->memory);
  sbfi_arena_free(&reference->arena);
}

/* The load to which it yields most; SBFI_MOST_LOADS: to none. */
static uint32_t softest(const sbfi_reference *r) {
  uint32_t most = SBFI_MOST_LOADS;
  for (uint32_t l = 0; l < r->statics.load_count; l++)
    if (r->yieldings[l] > 0 && (most == SBFI_MOST_LOADS || r->yieldings[l] > r->yieldings[most])) most = l;
  return most;
}

double sbfi_reference_frequency(const sbfi_reference *reference) {
  uint32_t load = softest(reference);
  return load < SBFI_MOST_LOADS ? reference->rests[load].frequency : 0;
}

/* ---- The fit ---- */

/* What the level yields under the small loads. */
static bool find_yieldings(const sbfi_level_statics *s, const sbfi_reference *r,
    double yieldings[SBFI_MOST_LOADS], sbfi_rest rests[SBFI_MOST_LOADS], sbfi_arena *scratch) {
  size_t numbers = 3 * (size_t)s->body->surface.positions.count;
  double *give = sbfi_arena_allocate(scratch, numbers, sizeof *give);
  if (!give) return false;
  for (uint32_t l = 0; l < s->load_count; l++) {
    if (!sbfi_level_give(s, l, r->small, small_tolerance, give, &rests[l], scratch)) return false;
    yieldings[l] = rests[l].converged ? sbfi_level_yielding(s, l, give) : 0;
  }
  return true;
}

static double fit(const sbfi_level_statics *s, const sbfi_reference *r, const double *yieldings) {
  double own = 0, wanted = 0;
  for (uint32_t l = 0; l < s->load_count; l++) {
    if (!(yieldings[l] > 0) || !(r->yieldings[l] > 0)) continue;
    own += yieldings[l];
    wanted += r->yieldings[l];
  }
  return own > 0 && wanted > 0 ? own / wanted : 1;
}

static double residual_of(
    const sbfi_level_statics *s, const sbfi_reference *r, const double *yieldings, double factor) {
  double most = 0;
  for (uint32_t l = 0; l < s->load_count; l++)
    if (yieldings[l] > 0 && r->yieldings[l] > 0)
      most = fmax(most, fabs(yieldings[l] / factor / r->yieldings[l] - 1));
  return most;
}

static bool scale(sbf_level *level, const sbf_soft_body *body, double factor, sbf_asset *asset) {
  sbf_tetrahedron_mesh *lattice = &level->lattice;
  uint32_t count = lattice->young_modulus.count ? lattice->young_modulus.count : 1;
  float *effective = sbf_asset_allocate(asset, count, sizeof *effective);
  float *stated = sbf_asset_allocate(asset, count, sizeof *stated);
  if (!effective || !stated) return false;
  for (uint32_t i = 0; i < count; i++) {
    stated[i] = lattice->young_modulus.count ? lattice->young_modulus.at[i] : body->attributes.young_modulus;
    effective[i] = (float)fmax(stated[i] * factor, FLT_MIN);
  }
  lattice->young_modulus = (sbf_f32_list){effective, count};
  lattice->reference_modulus = (sbf_f32_list){stated, count};
  return true;
}

/* ---- The comparison ---- */

static bool compare(
    const sbfi_level_statics *s, const sbfi_reference *r, bool gives, double *error, sbfi_arena *scratch) {
  uint32_t points = s->body->surface.positions.count;
  double *give = sbfi_arena_allocate(scratch, points, 3 * sizeof *give);
  if (!give) return false;
  *error = 0;
  for (uint32_t l = 0; l < r->statics.load_count; l++) {
    sbfi_rest rest = {.converged = !gives};
    const double *wanted = r->falls[l];
    if (!wanted) continue;
    if (gives && !sbfi_level_give(s, l, r->fall, fall_tolerance, give, &rest, scratch)) return false;
    for (uint32_t i = 0; i < points && rest.converged; i++) {
      double off = 0;
      for (uint32_t k = 3 * i; k < 3 * i + 3; k++) off += (give[k] - wanted[k]) * (give[k] - wanted[k]);
      *error = fmax(*error, sqrt(off));
    }
  }
  return true;
}

static bool calibrate(sbf_level *level, const sbf_soft_body *body, const sbfi_interior_map *interior,
    const sbfi_reference *r, double tick, sbf_asset *asset, sbfi_calibration *c, sbfi_arena *scratch) {
  sbfi_level_statics s;
  sbfi_rest rests[SBFI_MOST_LOADS];
  double yieldings[SBFI_MOST_LOADS];
  *c = (sbfi_calibration){.factor = 1, .period_error = NAN};
  if (!sbfi_level_statics_make(&s, body, level, interior, scratch)) return false;
  bool gives = level->model != SBF_ELASTIC_MODEL_JIGGLE && s.held == r->statics.held;
  if (gives) {
    if (!find_yieldings(&s, r, yieldings, rests, scratch)) return false;
    uint32_t load = softest(r);
    if (level->model == SBF_ELASTIC_MODEL_TETRAHEDRA) {
      c->factor = fit(&s, r, yieldings);
      if (!scale(level, body, c->factor, asset) ||
          !sbfi_level_statics_make(&s, body, level, interior, scratch))
        return false;
    }
    c->residual = residual_of(&s, r, yieldings, c->factor);
    if (load < SBFI_MOST_LOADS && rests[load].frequency > 0)
      c->period_error = r->rests[load].frequency / (rests[load].frequency * sqrt(c->factor)) - 1;
  }
  if (!compare(&s, r, gives, &c->error, scratch)) return false;
  level->simulation.error = (float)fmin(c->error, FLT_MAX);
  level->simulation.cost =
      level->model == SBF_ELASTIC_MODEL_JIGGLE ? 1 : (float)fmin(sbfi_level_cost(&s, tick, scratch), FLT_MAX);
  return true;
}

bool sbfi_level_calibrate(sbf_level *level, const sbf_soft_body *body, const sbfi_interior_map *interior,
    const sbfi_reference *reference, double tick, sbf_asset *asset, sbfi_calibration *calibration,
    const sbf_allocator *allocator) {
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, allocator, 0);
  bool good = calibrate(level, body, interior, reference, tick, asset, calibration, &scratch);
  sbfi_arena_free(&scratch);
  return good;
}
