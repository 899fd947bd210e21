#include "build/levels/spring_descent.h"

#include <math.h>
#include <string.h>

#include "mechanics/vector.h"

static const double move_share = 1e-3, adjoint_share = 1e-2;
static const double least_factor = 0.125, most_factor = 16, most_raise = 4;
/* By so much more than itself a factor grows in a round, or shrinks. */
static const double first_step = 0.2, least_step = 1e-3, most_step = 1.5, longer = 1.2, shorter = 0.5;
/* Beyond some thousand points rounds become fewer, so that no section takes many seconds. */
enum { FEWEST_ROUNDS = 8, MOST_ROUNDS = 25, POINTS_FOR_ALL = 1000 };

typedef struct work {
  sbfi_level_statics *statics;
  sbfi_linear_statics *linear;
  const float *stated;
  const double *const *gives;
  double *forces;                                            /* (3 x level points) */
  double *moved[SBFI_MOST_LOADS], *adjoint[SBFI_MOST_LOADS]; /* (3 x level points) */
  double *factors, *gradient, *before, *steps;               /* (springs) */
  float *best;                                               /* (springs) N/m */
  double *held_by;                                           /* (level points) N/m, its springs added up */
  double most_held;                                          /* N/m per kg */
} work;

/* Zeros: each round starts from the answers of the one before. */
static bool reserve_points(work *w, bool adjoint, sbfi_arena *arena) {
  size_t points = (size_t)w->statics->network.point_count + 1;
  if (!(w->forces = sbfi_arena_allocate(arena, points, 3 * sizeof(double)))) return false;
  for (uint32_t l = 0; l < w->statics->load_count; l++) {
    if (!(w->moved[l] = sbfi_arena_allocate(arena, points, 3 * sizeof(double)))) return false;
    if (adjoint && !(w->adjoint[l] = sbfi_arena_allocate(arena, points, 3 * sizeof(double)))) return false;
  }
  return true;
}

static bool reserve(work *w, sbfi_arena *arena) {
  size_t points = (size_t)w->statics->network.point_count + 1, springs = w->statics->network.spring_count;
  double **of_springs[] = {&w->factors, &w->gradient, &w->before, &w->steps};
  if (!reserve_points(w, true, arena)) return false;
  for (int i = 0; i < 4; i++)
    if (!(*of_springs[i] = sbfi_arena_allocate(arena, springs + 1, sizeof(double)))) return false;
  w->best = sbfi_arena_allocate(arena, springs + 1, sizeof *w->best);
  w->held_by = sbfi_arena_allocate(arena, points, sizeof *w->held_by);
  return w->best && w->held_by;
}

/* Solves for a load and returns the square of what is left, as a share; `forces` become its derivatives by
 * the displacements. Negative: the load does not count. */
static double mismatch(const work *w, uint32_t load) {
  const sbfi_level_statics *s = w->statics;
  const double *wanted = w->gives[load];
  size_t numbers = 3 * (size_t)s->network.point_count, surface = s->body->surface.positions.count;
  double size = 0, left = 0;
  for (size_t i = 0; wanted && i < 3 * surface; i++) size += s->areas[i / 3] * wanted[i] * wanted[i];
  if (!(size > 0)) return -1;
  sbfi_level_forces(s, load, 1, w->forces);
  sbfi_linear_statics_solve(w->linear, w->forces, move_share, w->moved[load]);
  memset(w->forces, 0, numbers * sizeof *w->forces);
  for (size_t i = 0; i < surface; i++) {
    const sbf_vec4 by = s->carried[i].weights;
    const double weights[4] = {by.x, by.y, by.z, by.w};
    for (size_t k = 0; k < 3; k++) {
      double off = -wanted[3 * i + k];
      for (int c = 0; c < 4; c++)
        off += weights[c] * w->moved[load][3 * (size_t)s->carried[i].points.at[c] + k];
      left += s->areas[i] / size * off * off;
      for (int c = 0; c < 4; c++)
        w->forces[3 * (size_t)s->carried[i].points.at[c] + k] += 2 * weights[c] * s->areas[i] / size * off;
    }
  }
  return left;
}

static sbfi_d3 at(const double *field, uint32_t point) {
  const double *of = field + 3 * (size_t)point;
  return (sbfi_d3){of[0], of[1], of[2]};
}

static void add_gradient(const work *w, uint32_t load) {
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

static double evaluate(const work *w, bool gradient) {
  const sbf_spring_network *n = &w->statics->network;
  double sum = 0;
  int loads = 0;
  if (gradient) memset(w->gradient, 0, n->spring_count * sizeof *w->gradient);
  for (uint32_t load = 0; load < w->statics->load_count; load++) {
    double left = mismatch(w, load);
    if (left < 0) continue;
    sum += left;
    loads++;
    if (!gradient) continue;
    sbfi_linear_statics_solve(w->linear, w->forces, adjoint_share, w->adjoint[load]);
    add_gradient(w, load);
  }
  return loads ? sqrt(sum / loads) : 0;
}

static void add_held(const work *w, const float *stiffness) {
  const sbf_spring_network *n = &w->statics->network;
  memset(w->held_by, 0, n->point_count * sizeof *w->held_by);
  for (uint32_t i = 0; i < n->spring_count; i++)
    for (int end = 0; end < 2; end++) w->held_by[n->ends[i].at[end]] += (double)stiffness[i];
}

/* Holds factors within their bounds and writes the stiffnesses. */
static void set_stiffness(const work *w) {
  const sbf_spring_network *n = &w->statics->network;
  float *stiffness = w->statics->stiffness;
  for (uint32_t i = 0; i < n->spring_count; i++) {
    w->factors[i] = fmin(fmax(w->factors[i], least_factor), most_factor);
    stiffness[i] = (float)((double)w->stated[i] * w->factors[i]);
  }
  add_held(w, stiffness);
  for (uint32_t i = 0; i < n->spring_count; i++) {
    double over = 1;
    for (int end = 0; end < 2; end++) {
      uint32_t point = n->ends[i].at[end];
      if (n->masses[point] > 0) over = fmax(over, w->held_by[point] / (n->masses[point] * w->most_held));
    }
    if (!(over > 1)) continue;
    w->factors[i] = fmax(w->factors[i] / over, least_factor);
    stiffness[i] = (float)((double)w->stated[i] * w->factors[i]);
  }
  sbfi_linear_statics_refresh(w->linear);
}

static void step(const work *w) {
  for (uint32_t i = 0; i < w->statics->network.spring_count; i++) {
    double turn = w->gradient[i] * w->before[i];
    if (turn > 0) w->steps[i] = fmin(longer * w->steps[i], most_step);
    if (turn < 0) {
      w->steps[i] = fmax(shorter * w->steps[i], least_step);
      w->gradient[i] = 0;
    }
    if (w->gradient[i] < 0) w->factors[i] *= 1 + w->steps[i];
    if (w->gradient[i] > 0) w->factors[i] /= 1 + w->steps[i];
    w->before[i] = w->gradient[i];
  }
}

bool sbfi_spring_mismatch(const sbfi_level_statics *statics, sbfi_linear_statics *linear,
    const double *const *gives, double *left, sbfi_arena *scratch) {
  /* Nothing of the level is written to here. */
  work w = {.statics = (sbfi_level_statics *)(uintptr_t)statics, .linear = linear, .gives = gives};
  if (!reserve_points(&w, false, scratch)) return false;
  *left = evaluate(&w, false);
  return true;
}

bool sbfi_spring_descent(sbfi_level_statics *statics, sbfi_linear_statics *linear, const float *stated,
    const double *const *gives, double *left, sbfi_progress progress, sbfi_arena *scratch) {
  work w = {.statics = statics, .linear = linear, .stated = stated, .gives = gives};
  const sbf_spring_network *n = &statics->network;
  if (!reserve(&w, scratch)) return false;
  add_held(&w, stated);
  for (uint32_t i = 0; i < n->point_count; i++)
    if (n->masses[i] > 0) w.most_held = fmax(w.most_held, most_raise * w.held_by[i] / n->masses[i]);
  for (uint32_t i = 0; i < n->spring_count; i++) {
    w.factors[i] = stated[i] > 0 ? (double)(statics->stiffness[i] / stated[i]) : 1;
    w.before[i] = 0;
    w.steps[i] = first_step;
  }
  uint32_t rounds = (uint32_t)((uint64_t)MOST_ROUNDS * POINTS_FOR_ALL / (n->point_count + 1));
  rounds = rounds > MOST_ROUNDS ? MOST_ROUNDS : rounds < FEWEST_ROUNDS ? FEWEST_ROUNDS : rounds;
  *left = INFINITY;
  for (uint32_t round = 0; round < rounds; round++) {
    if (!sbfi_progress_say(progress, (double)round / rounds)) return false;
    set_stiffness(&w);
    double now = evaluate(&w, true);
    if (now < *left) {
      *left = now;
      memcpy(w.best, statics->stiffness, n->spring_count * sizeof *w.best);
    }
    step(&w);
  }
  memcpy(statics->stiffness, w.best, n->spring_count * sizeof *w.best);
  sbfi_linear_statics_refresh(linear);
  return true;
}
