#include "build/levels/calibrate.h"

#include <float.h>
#include <math.h>

#include "build/levels/spring_fit.h"
#include "build/levels/stiffness_descent.h"
#include "mechanics/bearing_modulus.h"

/* Relative accuracy of displacements under small loads; maximum unbalanced fraction of the load under
 * gravity. */
static const double displacement_tolerance = 2e-3, gravity_tolerance = 1e-4;
/* Bounds of the common factor from means over the surface. Outside them a loose fragment may distort the
 * mean, as in a lattice of a surface with holes, because its displacement is unbounded. A median point is
 * robust to a fragment of the level; with one in the reference nothing can be fitted. */
static const double min_common = 0.0625, max_common = 4;
/* Bounds of the factor from the median point; number of bisections; minimum mean square of the reference's
 * displacements for a point to count. */
static const double min_median = 1.0 / 64, max_median = 64, still_fraction = 1e-4;
enum { MEDIAN_STEPS = 24 };

/* Bounds for the modulus of each tetrahedron: more than twice would shorten the time step for little gain. */
static const sbfi_factor_bounds lattice_bounds = {.min = 0.125, .max = 2, .fraction = 1e-3, .rounds = 25};
enum { ROUGH_ROUNDS = 12 };

/* For a rough reference. */
static const double rough_tolerance = 0.3;

static double gravity_of(const sbf_asset *asset, const sbf_soft_body *body) {
  sbf_vec3 g = asset->environment.gravity;
  double size = sqrt((double)g.x * g.x + (double)g.y * g.y + (double)g.z * g.z);
  size *= fabs((double)body->attributes.gravity_scale);
  return size > 0 ? size : 9.81;
}

/* ---- The reference ---- */

bool sbfi_surface_is_sparse(const sbf_soft_body *body) {
  return body->surface.positions.count < 3 * SBFI_PUSHED_PATCHES;
}

static sbfi_lattice_outcome measure(sbfi_reference *r, const sbfi_reference_use *use, sbfi_arena *scratch) {
  sbfi_linear_statics linear;
  uint32_t loads = r->statics.load_count;
  size_t numbers = 3 * (size_t)r->statics.body->surface.positions.count + 1;
  if (r->statics.can_rotate) return SBFI_LATTICE_MADE;
  if (!sbfi_linear_statics_make_direct(&linear, &r->statics.network, scratch)) return SBFI_LATTICE_NO_MEMORY;
  for (uint32_t l = 0; l < loads; l++) {
    if (!sbfi_progress_report(use->progress, 0.5 + 0.2 * l / loads)) return SBFI_LATTICE_CANCELLED;
    r->displacements[l] = sbfi_arena_allocate(&r->arena, numbers, sizeof(double));
    if (!r->displacements[l] || !sbfi_level_solve_linear(&r->statics, &linear, l, displacement_tolerance,
                                    r->displacements[l], &r->frequencies[l], scratch))
      return SBFI_LATTICE_NO_MEMORY;
    r->mean_displacements[l] = sbfi_level_mean_displacement(&r->statics, l, r->displacements[l]);
    r->is_valid |= r->mean_displacements[l] > 0 && r->frequencies[l] > 0;
  }
  for (uint32_t k = 0; k < SBFI_TWISTS && r->is_valid && use->twists; k++)
    if (!sbfi_level_twist_frequency(
            &r->statics, &linear, k, displacement_tolerance, &r->twist_frequencies[k], scratch))
      return SBFI_LATTICE_NO_MEMORY;
  r->has_twists = r->is_valid && use->twists;
  if (r->is_valid && use->pushes) {
    r->has_works = true;
    if (!sbfi_push_works_make(
            &r->works, &r->statics, &linear, sbfi_progress_part(use->progress, 0.7, 0.8), &r->arena))
      return SBFI_LATTICE_NO_MEMORY;
  }
  for (uint32_t l = 0; l < loads && r->is_valid && use->gravity_displacements; l++) {
    bool converged;
    r->gravity_displacements[l] = sbfi_arena_allocate(&r->arena, numbers, sizeof(double));
    if (!r->gravity_displacements[l] ||
        !sbfi_level_solve_nonlinear(&r->statics, l, r->gravity, gravity_tolerance,
            r->gravity_displacements[l], &converged,
            sbfi_progress_part(use->progress, 0.8 + 0.2 * l / loads, 0.8 + 0.2 * (l + 1) / loads), scratch))
      return SBFI_LATTICE_NO_MEMORY;
    if (!converged) r->gravity_displacements[l] = NULL;
  }
  return SBFI_LATTICE_MADE;
}

static sbfi_lattice_outcome measure_level(sbfi_reference *r, const sbf_soft_body *body,
    const sbf_level *level, const sbfi_interior_map *interior, const sbfi_reference_use *use,
    sbfi_arena *scratch) {
  return sbfi_level_statics_make(&r->statics, body, level, interior, &r->arena) ? measure(r, use, scratch)
                                                                                : SBFI_LATTICE_NO_MEMORY;
}

sbfi_lattice_outcome sbfi_reference_from_level(sbfi_reference *reference, const sbf_soft_body *body,
    const sbf_level *level, const sbfi_interior_map *interior, const sbf_asset *asset,
    const sbfi_reference_use *use, const sbf_allocator *allocator) {
  sbfi_arena scratch;
  *reference = (sbfi_reference){
      .gravity = gravity_of(asset, body), .has_gravity_displacements = use->gravity_displacements};
  sbfi_arena_init(&reference->arena, allocator, 0);
  sbfi_arena_init(&scratch, allocator, 0);
  sbfi_lattice_outcome outcome = measure_level(reference, body, level, interior, use, &scratch);
  sbfi_arena_free(&scratch);
  return outcome;
}

sbfi_lattice_outcome sbfi_reference_make(sbfi_reference *reference, const sbf_soft_body *body,
    uint32_t elements, bool is_rough, const sbf_asset *asset, const sbfi_reference_use *use,
    const sbf_allocator *allocator) {
  sbfi_arena scratch;
  *reference = (sbfi_reference){.gravity = gravity_of(asset, body),
      .has_gravity_displacements = use->gravity_displacements,
      .is_rough = is_rough};
  sbfi_arena_init(&reference->arena, allocator, 0);
  reference->memory = sbf_asset_create(allocator);
  if (!reference->memory) return SBFI_LATTICE_NO_MEMORY;
  reference->memory->bones = asset->bones;
  reference->memory->rigid_bodies = asset->rigid_bodies;
  sbfi_arena_init(&scratch, allocator, 0);
  sbfi_lattice_counts counts;
  const sbfi_lattice_recipe recipe = {
      .elements = elements, .tolerance = is_rough ? rough_tolerance : 0, .derivation = SBF_NONE};
  sbfi_lattice_outcome outcome = sbfi_lattice_level_make(
      &reference->made, body, &recipe, reference->memory, &counts, use->progress, &scratch);
  if (outcome == SBFI_LATTICE_MADE && counts.tetrahedra > 0)
    outcome = measure_level(reference, body, &reference->made, NULL, use, &scratch);
  sbfi_arena_free(&scratch);
  return outcome;
}

void sbfi_reference_free(sbfi_reference *reference) {
  sbf_asset_free(reference->memory);
  sbfi_arena_free(&reference->arena);
}

/* The load with the largest displacement; SBFI_MAX_LOADS: none. */
static uint32_t softest(const sbfi_reference *r) {
  uint32_t max = SBFI_MAX_LOADS;
  for (uint32_t l = 0; l < r->statics.load_count; l++)
    if (r->mean_displacements[l] > 0 &&
        (max == SBFI_MAX_LOADS || r->mean_displacements[l] > r->mean_displacements[max]))
      max = l;
  return max;
}

double sbfi_reference_frequency(const sbfi_reference *reference) {
  uint32_t load = softest(reference);
  return load < SBFI_MAX_LOADS ? reference->frequencies[load] : 0;
}

/* ---- The fit ---- */

/* State of the calibration of one level. */
typedef struct work {
  sbf_level *level;
  const sbf_soft_body *body;
  const sbfi_reference *r;
  sbf_asset *asset;
  sbfi_arena *scratch;
  sbfi_level_statics statics;
  sbfi_linear_statics linear;
  /* Displacements under the small loads. */
  double *displacements[SBFI_MAX_LOADS]; /* (3 x surface points) m */
  double mean_displacements[SBFI_MAX_LOADS], frequencies[SBFI_MAX_LOADS];
  sbfi_calibration *c;
  sbfi_progress progress;
} work;

static bool find_displacements(work *w) {
  size_t numbers = 3 * (size_t)w->body->surface.positions.count + 1;
  for (uint32_t l = 0; l < w->statics.load_count; l++) {
    w->displacements[l] = sbfi_arena_allocate(w->scratch, numbers, sizeof(double));
    if (!w->displacements[l] || !sbfi_level_solve_linear(&w->statics, &w->linear, l, displacement_tolerance,
                                    w->displacements[l], &w->frequencies[l], w->scratch))
      return false;
    w->mean_displacements[l] = sbfi_level_mean_displacement(&w->statics, l, w->displacements[l]);
  }
  return true;
}

static bool is_sparse(const work *w) {
  return sbfi_surface_is_sparse(w->body);
}

static double compliance(
    const work *w, const double *mean_displacements, const double *frequencies, uint32_t load) {
  if (!is_sparse(w)) return mean_displacements[load];
  return frequencies[load] > 0 ? 1 / (frequencies[load] * frequencies[load]) : 0;
}
static double own_compliance(const work *w, uint32_t load) {
  return compliance(w, w->mean_displacements, w->frequencies, load);
}
static double target_compliance(const work *w, uint32_t load) {
  return compliance(w, w->r->mean_displacements, w->r->frequencies, load);
}

/* Lower bound of the common factor. Otherwise the slowest mode of a thin fin could select a factor with which
 * the thicker rest sags. If few points provide no information about parts, a body without pins stays stiff
 * enough to carry its weight. */
static double min_to_bear(const work *w) {
  sbf_attributes matter = w->body->attributes;
  double stated = (double)matter.young_modulus;
  if (w->statics.is_pinned || !is_sparse(w) || !(stated > 0)) return 0;
  matter.young_modulus = 0;
  return fmin(sbfi_bearing_modulus(&matter, &w->body->surface.positions) / stated, 1);
}

/* Relative excess of a point's displacement over the reference's, projected on the reference's and summed
 * over all loads; negative: the reference's point is almost still. */
static double excess_of(const work *w, uint32_t point, double still_square) {
  double along = 0, square = 0;
  for (uint32_t l = 0; l < w->statics.load_count; l++)
    for (size_t k = 3 * (size_t)point; k < 3 * (size_t)point + 3; k++) {
      along += w->displacements[l][k] * w->r->displacements[l][k];
      square += w->r->displacements[l][k] * w->r->displacements[l][k];
    }
  return square > still_square ? fmax(along, 0) / square : -1;
}

/* Mean over the surface, summed over the loads, of the reference's squared displacements, m^2. */
static double mean_square(const work *w) {
  double sum = 0, area = 0;
  for (uint32_t i = 0; i < w->body->surface.positions.count; i++) {
    area += (double)w->r->statics.areas[i];
    for (uint32_t l = 0; l < w->statics.load_count; l++)
      for (size_t k = 3 * (size_t)i; k < 3 * (size_t)i + 3; k++)
        sum += (double)w->r->statics.areas[i] * w->r->displacements[l][k] * w->r->displacements[l][k];
  }
  return area > 0 ? sum / area : 0;
}

/* The common factor at which half of the surface by area moves more than the reference and half less: robust
 * to loose fragments. 1 if the surface provides no information. Bisects the factor's logarithm. */
static double median_excess(const work *w) {
  uint32_t points = w->body->surface.positions.count;
  double low = min_median, high = max_median, still_square = still_fraction * mean_square(w);
  for (int step = 0; step < MEDIAN_STEPS; step++) {
    double middle = sqrt(low * high), below = 0, above = 0;
    for (uint32_t i = 0; i < points; i++) {
      double excess = excess_of(w, i, still_square);
      if (excess >= 0) *(excess < middle ? &below : &above) += (double)w->r->statics.areas[i];
    }
    if (!(below + above > 0)) return 1;
    *(above > below ? &low : &high) = middle;
  }
  return sqrt(low * high);
}

static double fit(const work *w) {
  double own = 0, target = 0;
  for (uint32_t l = 0; l < w->statics.load_count; l++) {
    if (!(own_compliance(w, l) > 0) || !(target_compliance(w, l) > 0)) continue;
    own += own_compliance(w, l);
    target += target_compliance(w, l);
  }
  double factor = own > 0 && target > 0 ? own / target : 1;
  if (factor > max_common && !is_sparse(w))
    factor = median_excess(w);
  else if (factor < min_common || factor > max_common)
    factor = 1;
  return fmax(factor, min_to_bear(w));
}

static double residual_of(const work *w, double factor) {
  double max = 0;
  for (uint32_t l = 0; l < w->statics.load_count; l++)
    if (own_compliance(w, l) > 0 && target_compliance(w, l) > 0)
      max = fmax(max, fabs(own_compliance(w, l) / factor / target_compliance(w, l) - 1));
  return max;
}

/* Relative excess of the level's displacement along the reference's under twists. */
static bool find_twists(work *w, double factor) {
  size_t points = w->body->surface.positions.count, numbers = 3 * (size_t)w->statics.network.point_count;
  double *forces = sbfi_arena_allocate(w->scratch, numbers + 1, sizeof *forces);
  double *moved = sbfi_arena_allocate(w->scratch, numbers + 1, sizeof *moved);
  double *displacements = sbfi_arena_allocate(w->scratch, 3 * points + 1, sizeof *displacements);
  if (!forces || !moved || !displacements) return false;
  for (uint32_t k = 0; k < SBFI_TWISTS; k++) {
    uint32_t push = SBFI_PUSHES - SBFI_TWISTS + k;
    const double *target = w->r->works.displacements[push];
    double along = 0, square = 0;
    sbfi_level_push(&w->statics, &w->r->works.pushes, push, forces);
    sbfi_linear_statics_solve(&w->linear, forces, displacement_tolerance, moved);
    sbfi_level_get_surface_displacements(&w->statics, moved, displacements);
    for (size_t i = 0; i < 3 * points; i++) {
      along += (double)w->r->statics.areas[i / 3] * displacements[i] * target[i];
      square += (double)w->r->statics.areas[i / 3] * target[i] * target[i];
    }
    if (square > 0) w->c->twist_errors[k] = along / square / factor - 1;
  }
  return true;
}

/* The same if the surface has too few points: from the frequency of the whole body under that load. */
static bool find_slow_twists(work *w, double factor) {
  for (uint32_t k = 0; k < SBFI_TWISTS; k++) {
    double own, target = w->r->twist_frequencies[k];
    if (!sbfi_level_twist_frequency(&w->statics, &w->linear, k, displacement_tolerance, &own, w->scratch))
      return false;
    if (own > 0 && target > 0) w->c->twist_errors[k] = target * target / (own * own) / factor - 1;
  }
  return true;
}

static bool find_errors(work *w, double factor) {
  for (uint32_t l = 0; l < w->statics.load_count; l++)
    if (own_compliance(w, l) > 0 && target_compliance(w, l) > 0)
      w->c->load_errors[l] = own_compliance(w, l) / factor / target_compliance(w, l) - 1;
  if (is_sparse(w)) return !w->r->has_twists || find_slow_twists(w, factor);
  return !w->r->has_works || find_twists(w, factor);
}

/* Writes the moduli times `factor`, and the original ones `stated`. */
static bool write_moduli(work *w, const float *stated, double factor) {
  sbf_tetrahedron_mesh *lattice = &w->level->lattice;
  uint32_t count = lattice->tetrahedra.count, states = lattice->young_modulus.count > 1 ? count : 1;
  float *effective = sbf_asset_allocate(w->asset, count, sizeof *effective);
  float *before = sbf_asset_allocate(w->asset, states, sizeof *before);
  if (!effective || !before) return false;
  double volume = 0;
  w->c->factor = w->c->max = 0;
  w->c->min = INFINITY;
  for (uint32_t t = 0; t < count; t++) {
    double of = (double)w->statics.moduli[t] * factor / (double)stated[t];
    double size = w->linear.stiffness.elements[t].volume;
    effective[t] = w->statics.moduli[t] = (float)fmax(w->statics.moduli[t] * factor, FLT_MIN);
    if (t < states) before[t] = stated[t];
    w->c->factor += size * of;
    volume += size;
    w->c->min = fmin(w->c->min, of);
    w->c->max = fmax(w->c->max, of);
  }
  w->c->factor /= volume;
  lattice->young_modulus = (sbf_f32_list){effective, count};
  lattice->reference_modulus = (sbf_f32_list){before, states};
  return true;
}

/* Displacements of the reference under the loads. */
static sbfi_target_displacements targets_of(const work *w) {
  sbfi_target_displacements target = {.displacements = (const double *const *)w->r->displacements};
  if (!w->r->has_works) return target;
  target.pushes = &w->r->works.pushes;
  target.pushed = (const double *const *)w->r->works.displacements;
  return target;
}

static bool fit_lattice(work *w, double *factor) {
  uint32_t count = w->statics.network.tetrahedron_count;
  float *stated = sbfi_arena_copy(w->scratch, w->statics.moduli, count, sizeof *stated);
  if (!stated) return false;
  if (w->r->has_works && !is_sparse(w)) {
    const sbfi_target_displacements target = targets_of(w);
    sbfi_factor_bounds bounds = lattice_bounds;
    double left;
    if (w->r->is_rough) bounds.rounds = ROUGH_ROUNDS;
    if (!sbfi_local_fit(&w->statics, &w->linear, &w->r->statics, &w->r->works,
            sbfi_progress_part(w->progress, 0, 0.2), w->scratch) ||
        !sbfi_stiffness_descent(&w->statics, &w->linear, stated, &target, &bounds, &left,
            sbfi_progress_part(w->progress, 0.2, 0.7), w->scratch))
      return false;
  }
  if (!find_displacements(w)) return false;
  *factor = fit(w);
  return write_moduli(w, stated, *factor);
}

static bool fit_springs(work *w) {
  sbfi_spring_factors factors;
  sbf_spring_set *sets = sbf_asset_allocate(w->asset, w->level->springs.count, sizeof *sets);
  const float *from = w->statics.stiffness;
  const float *before = sbfi_arena_copy(w->scratch, from, w->statics.network.spring_count, sizeof *before);
  const sbfi_target_displacements target = targets_of(w);
  if (!sets || !before ||
      !sbfi_spring_fit(&w->statics, &w->linear, &target, &factors, w->progress, w->scratch))
    return false;
  for (uint32_t s = 0; s < w->level->springs.count; s++) {
    sbf_spring_set *set = &sets[s];
    *set = w->level->springs.at[s];
    float *stiffness = sbf_asset_allocate(w->asset, (size_t)set->ends.count + 1, sizeof *stiffness);
    float *damping = sbf_asset_allocate(w->asset, (size_t)set->damping.count + 1, sizeof *damping);
    if (!stiffness || !damping) return false;
    for (uint32_t i = 0; i < set->ends.count; i++) {
      float stated = *before++;
      stiffness[i] = *from++;
      if (i < set->damping.count) damping[i] = stated > 0 ? set->damping.at[i] * (stiffness[i] / stated) : 0;
    }
    set->stiffness = (sbf_f32_list){set->ends.count ? stiffness : NULL, set->ends.count};
    if (set->damping.count) set->damping.at = damping;
  }
  w->level->springs.at = sets;
  w->c->factor = factors.inner;
  w->c->surface = factors.surface;
  w->c->min = factors.min;
  w->c->max = factors.max;
  w->c->residual_before = factors.before;
  w->c->residual = factors.after;
  return find_displacements(w);
}

/* ---- The comparison ---- */

static double farthest(const double *a, double a_scale, const double *b, double b_scale, uint32_t points) {
  double max = 0;
  for (uint32_t i = 0; i < points; i++) {
    double off = 0;
    for (size_t k = 3 * (size_t)i; k < 3 * (size_t)i + 3; k++) {
      double difference = a_scale * a[k] - b_scale * b[k];
      off += difference * difference;
    }
    max = fmax(max, off);
  }
  return sqrt(max);
}

/* Compares under gravity along one of the axes, or under bending: with large strains, or with the small loads
 * if large strains were not requested or one of the two does not converge. */
static bool compare_under(
    work *w, uint32_t l, bool has_linear, double factor, double *displacements, double *error) {
  uint32_t points = w->body->surface.positions.count;
  const double *expected = w->r->gravity_displacements[l];
  bool converged = expected && !has_linear;
  if (expected && has_linear &&
      !sbfi_level_solve_nonlinear(&w->statics, l, w->r->gravity, gravity_tolerance, displacements, &converged,
          sbfi_progress_part(w->progress, 0.7 + 0.3 * l / w->r->statics.load_count,
              0.7 + 0.3 * (l + 1) / w->r->statics.load_count),
          w->scratch))
    return false;
  if (converged)
    *error = farthest(displacements, 1, expected, 1, points);
  else if (has_linear)
    *error =
        farthest(w->displacements[l], w->r->gravity / factor, w->r->displacements[l], w->r->gravity, points);
  else /* does not move at all */
    *error = farthest(displacements, 1, w->r->displacements[l], w->r->gravity, points);
  /* Linear displacements larger than the body's size provide no information about positions. */
  if (converged || !has_linear || *error <= w->r->statics.size) return true;
  *error = INFINITY;
  w->c->unsettled |=
      farthest(w->r->displacements[l], w->r->gravity, displacements, 0, points) <= w->r->statics.size;
  return true;
}

static bool compare(work *w, bool has_linear, double factor) {
  double *displacements = sbfi_arena_allocate(
      w->scratch, (size_t)w->body->surface.positions.count + 1, 3 * sizeof *displacements);
  if (!displacements) return false;
  for (uint32_t l = 0; l < w->r->statics.load_count; l++) {
    double error = 0;
    if (!compare_under(w, l, has_linear, factor, displacements, &error)) return false;
    w->c->error = fmax(w->c->error, error);
  }
  return true;
}

/* Lists the leading known values as floats. */
static bool list_errors(work *w, const double *errors, uint32_t max, sbf_f32_list *list) {
  uint32_t count = 0;
  while (count < max && isfinite(errors[count])) count++;
  float *at = sbf_asset_allocate(w->asset, (size_t)count + 1, sizeof *at);
  if (!at) return false;
  for (uint32_t i = 0; i < count; i++) at[i] = (float)fmin(errors[i], FLT_MAX);
  *list = (sbf_f32_list){count ? at : NULL, count};
  return true;
}

static bool record(work *w) {
  sbf_calibration *made = sbf_asset_allocate(w->asset, 1, sizeof *made);
  if (!made) return false;
  sbf_calibration_init(made);
  made->reference_elements = w->r->statics.network.tetrahedron_count;
  made->factor = (float)w->c->factor;
  made->surface_factor = (float)w->c->surface;
  made->residual = (float)fmin(w->c->residual, FLT_MAX);
  if (isfinite(w->c->period_error)) made->period_error = (float)w->c->period_error;
  w->level->calibration = made;
  return list_errors(w, w->c->load_errors, w->statics.load_count, &made->load_errors) &&
         list_errors(w, w->c->twist_errors, SBFI_TWISTS, &made->twist_errors);
}

/* Exact solutions make the fit of many bodies several times as fast. They are not used elsewhere: a beam
 * of 480 elements fitted with them is too soft along its axis by 31 % instead of 16 %. */
static bool make_linear(work *w) {
  return w->r->is_rough ? sbfi_linear_statics_make_direct(&w->linear, &w->statics.network, w->scratch)
                        : sbfi_linear_statics_make(&w->linear, &w->statics.network, w->scratch);
}

static bool calibrate(work *w, const sbfi_interior_map *interior, bool springs, double tick) {
  sbf_level *level = w->level;
  bool lattice = level->model == SBF_ELASTIC_MODEL_TETRAHEDRA;
  const sbf_level before = *level;
  double factor = 1;
  springs &= level->model == SBF_ELASTIC_MODEL_SPRINGS;
  if (!sbfi_level_statics_make(&w->statics, w->body, level, interior, w->scratch)) return false;
  bool has_linear =
      level->model != SBF_ELASTIC_MODEL_JIGGLE && w->statics.is_pinned == w->r->statics.is_pinned;
  w->c->unsettled = w->statics.can_rotate;
  if (has_linear && !w->c->unsettled) {
    uint32_t load = softest(w->r);
    if (!make_linear(w)) return false;
    if (!(lattice ? fit_lattice(w, &factor) : springs ? fit_springs(w) : find_displacements(w))) return false;
    if (!springs) w->c->residual = residual_of(w, factor);
    if (lattice && !find_errors(w, factor)) return false;
    if (load < SBFI_MAX_LOADS && w->frequencies[load] > 0)
      w->c->period_error = w->r->frequencies[load] / (w->frequencies[load] * sqrt(factor)) - 1;
  }
  if (!w->c->unsettled && !compare(w, has_linear, factor)) return false;
  if (w->c->unsettled) {
    w->c->error = INFINITY;
    level->lattice = before.lattice;
    level->springs = before.springs;
    if (!sbfi_level_statics_make(&w->statics, w->body, level, interior, w->scratch)) return false;
  } else if (has_linear && (lattice || springs) && !record(w)) {
    return false;
  }
  level->simulation.error = w->c->error < FLT_MAX ? (float)w->c->error : 0;
  level->simulation.cost = level->model == SBF_ELASTIC_MODEL_JIGGLE
                               ? 1
                               : (float)fmin(sbfi_level_cost(&w->statics, tick, w->scratch), FLT_MAX);
  return true;
}

double sbfi_calibration_max_error(const sbfi_calibration *c) {
  double max = 0; /* fmax ignores unknown values (NaN) */
  for (uint32_t l = 0; l < SBFI_MAX_LOADS; l++) max = fmax(max, fabs(c->load_errors[l]));
  for (uint32_t k = 0; k < SBFI_TWISTS; k++) max = fmax(max, fabs(c->twist_errors[k]));
  return max;
}

bool sbfi_level_calibrate(sbf_level *level, const sbf_soft_body *body, const sbfi_interior_map *interior,
    const sbfi_reference *reference, bool springs, double tick, sbf_asset *asset,
    sbfi_calibration *calibration, sbfi_progress progress, const sbf_allocator *allocator) {
  sbfi_arena scratch;
  work w = {.level = level,
      .body = body,
      .r = reference,
      .asset = asset,
      .scratch = &scratch,
      .c = calibration,
      .progress = progress};
  *calibration = (sbfi_calibration){.factor = 1, .surface = 1, .min = 1, .max = 1, .period_error = NAN};
  for (uint32_t l = 0; l < SBFI_MAX_LOADS; l++) calibration->load_errors[l] = NAN;
  for (uint32_t k = 0; k < SBFI_TWISTS; k++) calibration->twist_errors[k] = NAN;
  sbfi_arena_init(&scratch, allocator, 0);
  bool good = calibrate(&w, interior, springs, tick);
  sbfi_arena_free(&scratch);
  return good;
}
