#include "build/levels/stiffness_descent.h"

#include <math.h>
#include <string.h>

#include "mechanics/network.h"
#include "mechanics/vector.h"

static const double adjoint_fraction = 10; /* relative to the accuracy of displacements */
/* Step sizes of the logarithm of a factor: initial, minimum, maximum; their growth and reduction. */
static const double first_step = 0.2, min_step = 1e-3, max_step = 1.5, longer = 1.2, shorter = 0.5;
static const double smoothing = 0.1; /* blend per round */
/* Limit of matrix blocks processed before a new round, so that no body takes many seconds, even with badly
 * conditioned equations. */
static const double max_visits = 3e8;
enum { FEWEST_ROUNDS = 8, POINTS_FOR_ALL = 1000, MAX_TARGETS = SBFI_MAX_LOADS + SBFI_PUSHES };

typedef struct work {
  sbfi_level_statics *statics;
  sbfi_linear_statics *linear;
  const sbfi_target_displacements *targets;
  const sbfi_factor_bounds *bounds;
  const float *stated; /* (elements) */
  float *values;       /* (elements) of the network */
  uint32_t element_count;
  bool springs;
  double *forces;                                    /* (3 x level points) */
  double *off;                                       /* (3 x surface points) m */
  double *moved[MAX_TARGETS], *adjoint[MAX_TARGETS]; /* (3 x level points) */
  double *factors, *gradient, *before, *steps;       /* (elements) */
  float *best;                                       /* (elements) */
  double *pinned_by;                                 /* (level points) N/m, sum over its springs */
  double max_pinned;                                 /* N/m per kg */
  double *sums, *counts;                             /* (level points) for smoothing */
  double visits;                                     /* matrix blocks processed so far */
  sbfi_progress progress;                            /* of the current round */
} work;

static work begin(
    sbfi_level_statics *statics, sbfi_linear_statics *linear, const sbfi_target_displacements *targets) {
  bool springs = statics->network.tetrahedron_count == 0;
  return (work){.statics = statics,
      .linear = linear,
      .targets = targets,
      .springs = springs,
      .values = springs ? statics->stiffness : statics->moduli,
      .element_count = springs ? statics->network.spring_count : statics->network.tetrahedron_count};
}

static uint32_t load_count(const work *w) {
  return w->statics->load_count + (w->targets->pushes ? SBFI_PUSHES : 0);
}

static const double *target_of(const work *w, uint32_t load) {
  uint32_t gravities = w->statics->load_count;
  return load < gravities ? w->targets->displacements[load] : w->targets->pushed[load - gravities];
}

static void set_forces(const work *w, uint32_t load) {
  uint32_t gravities = w->statics->load_count;
  if (load < gravities)
    sbfi_level_compute_forces(w->statics, load, 1, w->forces);
  else
    sbfi_level_push(w->statics, w->targets->pushes, load - gravities, w->forces);
}

/* Zeros; each round starts from the previous solutions. */
static bool reserve_points(work *w, bool adjoint, sbfi_arena *arena) {
  size_t points = (size_t)w->statics->network.point_count + 1;
  size_t surface = (size_t)w->statics->body->surface.positions.count + 1;
  w->forces = sbfi_arena_allocate(arena, points, 3 * sizeof(double));
  w->off = sbfi_arena_allocate(arena, surface, 3 * sizeof(double));
  if (!w->forces || !w->off) return false;
  for (uint32_t l = 0; l < load_count(w); l++) {
    if (!(w->moved[l] = sbfi_arena_allocate(arena, points, 3 * sizeof(double)))) return false;
    if (adjoint && !(w->adjoint[l] = sbfi_arena_allocate(arena, points, 3 * sizeof(double)))) return false;
  }
  return true;
}

static bool reserve(work *w, sbfi_arena *arena) {
  size_t points = (size_t)w->statics->network.point_count + 1, elements = (size_t)w->element_count + 1;
  double **of_elements[] = {&w->factors, &w->gradient, &w->before, &w->steps};
  if (!reserve_points(w, true, arena)) return false;
  for (int i = 0; i < 4; i++)
    if (!(*of_elements[i] = sbfi_arena_allocate(arena, elements, sizeof(double)))) return false;
  w->best = sbfi_arena_allocate(arena, elements, sizeof *w->best);
  w->pinned_by = sbfi_arena_allocate(arena, points, sizeof *w->pinned_by);
  w->sums = sbfi_arena_allocate(arena, points, sizeof *w->sums);
  w->counts = sbfi_arena_allocate(arena, points, sizeof *w->counts);
  return w->best && w->pinned_by;
}

static void solve(work *w, double fraction, double *displacements) {
  const sbfi_block_matrix *matrix = &w->linear->stiffness.matrix;
  uint32_t steps = sbfi_linear_statics_solve(w->linear, w->forces, fraction, displacements);
  w->visits += (steps + 1.0) * matrix->begins[matrix->row_count];
}

/* Solves for a load and returns the squared relative residual; `forces` receives its derivatives by the
 * displacements. Negative: the load is ignored. */
static double mismatch(work *w, uint32_t load) {
  const sbfi_level_statics *s = w->statics;
  const double *targets = target_of(w, load);
  size_t numbers = 3 * (size_t)s->network.point_count, surface = s->body->surface.positions.count;
  double size = 0, left = 0;
  for (size_t i = 0; targets && i < 3 * surface; i++) size += s->areas[i / 3] * targets[i] * targets[i];
  if (!(size > 0)) return -1;
  set_forces(w, load);
  solve(w, w->bounds->fraction, w->moved[load]);
  sbfi_level_get_surface_displacements(s, w->moved[load], w->off);
  memset(w->forces, 0, numbers * sizeof *w->forces);
  for (size_t i = 0; i < surface; i++) {
    const sbf_vec4 by = s->embedded[i].weights;
    const double weights[4] = {by.x, by.y, by.z, by.w};
    for (size_t k = 0; k < 3; k++) {
      double off = w->off[3 * i + k] - targets[3 * i + k];
      left += s->areas[i] / size * off * off;
      for (int c = 0; c < 4; c++)
        w->forces[3 * (size_t)s->embedded[i].points.at[c] + k] += 2 * weights[c] * s->areas[i] / size * off;
    }
  }
  return left;
}

static sbfi_d3 at(const double *field, uint32_t point) {
  const double *of = field + 3 * (size_t)point;
  return (sbfi_d3){of[0], of[1], of[2]};
}

static void add_gradient_of_springs(const work *w, uint32_t load) {
  const double *moved = w->moved[load], *adjoint = w->adjoint[load];
  const sbf_spring_network *n = &w->statics->network;
  for (uint32_t i = 0; i < n->spring_count; i++) {
    uint32_t a = n->ends[i].at[0], b = n->ends[i].at[1];
    sbfi_d3 along = sbfi_d3_sub(sbfi_d3_of(n->positions[b]), sbfi_d3_of(n->positions[a]));
    double squared = sbfi_d3_dot(along, along);
    if (!(squared > 0)) continue;
    w->gradient[i] -= n->stiffness[i] * sbfi_d3_dot(along, sbfi_d3_sub(at(moved, b), at(moved, a))) *
                      sbfi_d3_dot(along, sbfi_d3_sub(at(adjoint, b), at(adjoint, a))) / squared;
  }
}

static void add_gradient_of_tetrahedra(const work *w, uint32_t load) {
  const sbf_spring_network *n = &w->statics->network;
  sbfi_d3 u[4], v[4];
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    const sbfi_tetrahedron *element = &w->linear->stiffness.elements[t];
    const uint32_t *corners = n->tetrahedra[t].at;
    if (!(element->volume > 0)) continue;
    for (int k = 0; k < 4; k++) {
      u[k] = at(w->moved[load], corners[k]);
      v[k] = at(w->adjoint[load], corners[k]);
    }
    w->gradient[t] -= sbfi_tetrahedron_rest_work(element, u, v);
  }
}

/* Negative if the build is cancelled. */
static double evaluate(work *w, bool gradient) {
  double sum = 0;
  int loads = 0;
  if (gradient) memset(w->gradient, 0, w->element_count * sizeof *w->gradient);
  for (uint32_t load = 0; load < load_count(w); load++) {
    /* With few points a round is short. */
    bool is_long = load == 0 || w->statics->network.point_count > POINTS_FOR_ALL;
    if (is_long && !sbfi_progress_report(w->progress, (double)load / load_count(w))) return -1;
    double left = mismatch(w, load);
    if (left < 0) continue;
    sum += left;
    loads++;
    if (!gradient) continue;
    solve(w, adjoint_fraction * w->bounds->fraction, w->adjoint[load]);
    if (w->springs)
      add_gradient_of_springs(w, load);
    else
      add_gradient_of_tetrahedra(w, load);
  }
  return loads ? sqrt(sum / loads) : 0;
}

static void add_pinned(const work *w, const float *stiffness) {
  const sbf_spring_network *n = &w->statics->network;
  memset(w->pinned_by, 0, n->point_count * sizeof *w->pinned_by);
  for (uint32_t i = 0; i < n->spring_count; i++)
    for (int end = 0; end < 2; end++) w->pinned_by[n->ends[i].at[end]] += (double)stiffness[i];
}

/* Limits factors of springs that would make a point too stiff. */
static void slacken(const work *w) {
  const sbf_spring_network *n = &w->statics->network;
  add_pinned(w, w->values);
  for (uint32_t i = 0; i < n->spring_count; i++) {
    double excess = 1;
    for (int end = 0; end < 2; end++) {
      uint32_t point = n->ends[i].at[end];
      if (n->masses[point] > 0)
        excess = fmax(excess, w->pinned_by[point] / (n->masses[point] * w->max_pinned));
    }
    if (!(excess > 1)) continue;
    w->factors[i] = fmax(w->factors[i] / excess, w->bounds->min);
    w->values[i] = (float)((double)w->stated[i] * w->factors[i]);
  }
}

/* Smooths the factors of tetrahedra a little, because the loads overfit single ones. */
static void smooth(const work *w) {
  const sbf_spring_network *n = &w->statics->network;
  memset(w->sums, 0, n->point_count * sizeof *w->sums);
  memset(w->counts, 0, n->point_count * sizeof *w->counts);
  for (uint32_t t = 0; t < n->tetrahedron_count; t++)
    for (int k = 0; k < 4; k++) {
      w->sums[n->tetrahedra[t].at[k]] += w->factors[t];
      w->counts[n->tetrahedra[t].at[k]] += 1;
    }
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    double mean = 0;
    for (int k = 0; k < 4; k++)
      mean += w->sums[n->tetrahedra[t].at[k]] / w->counts[n->tetrahedra[t].at[k]] / 4;
    w->factors[t] += smoothing * (mean - w->factors[t]);
  }
}

/* Clamps factors to their bounds and writes the stiffnesses. */
static void set_values(const work *w) {
  if (!w->springs) smooth(w);
  for (uint32_t i = 0; i < w->element_count; i++) {
    w->factors[i] = fmin(fmax(w->factors[i], w->bounds->min), w->bounds->max);
    w->values[i] = (float)((double)w->stated[i] * w->factors[i]);
  }
  if (w->springs) slacken(w);
  sbfi_linear_statics_refresh(w->linear);
}

static void step(const work *w) {
  for (uint32_t i = 0; i < w->element_count; i++) {
    double turn = w->gradient[i] * w->before[i];
    if (turn > 0) w->steps[i] = fmin(longer * w->steps[i], max_step);
    if (turn < 0) {
      w->steps[i] = fmax(shorter * w->steps[i], min_step);
      w->gradient[i] = 0;
    }
    if (w->gradient[i] < 0) w->factors[i] *= 1 + w->steps[i];
    if (w->gradient[i] > 0) w->factors[i] /= 1 + w->steps[i];
    w->before[i] = w->gradient[i];
  }
}

static void find_factors(const work *w) {
  for (uint32_t i = 0; i < w->element_count; i++) {
    w->factors[i] = w->stated[i] > 0 ? (double)(w->values[i] / w->stated[i]) : 1;
    w->steps[i] = first_step;
  }
}

bool sbfi_stiffness_mismatch(const sbfi_level_statics *statics, sbfi_linear_statics *linear,
    const sbfi_target_displacements *targets, double *left, sbfi_arena *scratch) {
  /* Does not write to the level. */
  static const sbfi_factor_bounds exact = {.fraction = 1e-3};
  work w = begin((sbfi_level_statics *)(uintptr_t)statics, linear, targets);
  w.bounds = &exact;
  if (!reserve_points(&w, false, scratch)) return false;
  *left = evaluate(&w, false);
  return true;
}

static uint32_t rounds_of(const work *w) {
  uint64_t rounds = (uint64_t)w->bounds->rounds * POINTS_FOR_ALL / (w->statics->network.point_count + 1);
  if (rounds > w->bounds->rounds) return w->bounds->rounds;
  return rounds < FEWEST_ROUNDS ? FEWEST_ROUNDS : (uint32_t)rounds;
}

bool sbfi_stiffness_descent(sbfi_level_statics *statics, sbfi_linear_statics *linear, const float *stated,
    const sbfi_target_displacements *targets, const sbfi_factor_bounds *bounds, double *left,
    sbfi_progress progress, sbfi_arena *scratch) {
  work w = begin(statics, linear, targets);
  const sbf_spring_network *n = &statics->network;
  w.stated = stated;
  w.bounds = bounds;
  if (!reserve(&w, scratch)) return false;
  if (w.springs) add_pinned(&w, stated);
  for (uint32_t i = 0; i < n->point_count; i++)
    if (n->masses[i] > 0)
      w.max_pinned = fmax(w.max_pinned, bounds->max_raise * w.pinned_by[i] / n->masses[i]);
  find_factors(&w);
  uint32_t rounds = rounds_of(&w);
  *left = INFINITY;
  for (uint32_t round = 0; round < rounds && w.visits < max_visits; round++) {
    w.progress = sbfi_progress_part(progress, (double)round / rounds, (round + 1.0) / rounds);
    set_values(&w);
    double now = evaluate(&w, true);
    if (now < 0) return false;
    if (now < *left) {
      *left = now;
      memcpy(w.best, w.values, w.element_count * sizeof *w.best);
    }
    step(&w);
  }
  memcpy(w.values, w.best, w.element_count * sizeof *w.best);
  sbfi_linear_statics_refresh(linear);
  return true;
}
