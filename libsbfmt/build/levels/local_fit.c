#include "build/levels/local_fit.h"

#include <math.h>
#include <string.h>

#include "mechanics/network.h"
#include "mechanics/vector.h"

enum { ROUNDS = 4, SMOOTHINGS = 3 };
static const double min_factor = 0.125, max_factor = 2, max_change = 2;
/* Relative accuracy of displacements under pushes; minimum work that counts, as fractions of the total and
 * of the mean point's. */
static const double push_fraction = 5e-3, no_work = 1e-6;

/* Adds each element's work for the displacements, times `scale`, to its corners. */
static void add_works(
    const sbfi_linear_statics *linear, const double *moved, double scale, double *at_points) {
  const sbf_spring_network *n = linear->stiffness.network;
  sbfi_d3 u[4];
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    const uint32_t *at = n->tetrahedra[t].at;
    if (!(linear->stiffness.elements[t].volume > 0)) continue;
    for (int k = 0; k < 4; k++) {
      const double *by = moved + 3 * (size_t)at[k];
      u[k] = (sbfi_d3){by[0], by[1], by[2]};
    }
    double work = sbfi_tetrahedron_rest_work(&linear->stiffness.elements[t], u, u);
    for (int k = 0; k < 4; k++) at_points[at[k]] += scale * work / 4;
  }
}

bool sbfi_push_works_make(sbfi_push_works *works, const sbfi_level_statics *s, sbfi_linear_statics *linear,
    sbfi_progress progress, sbfi_arena *arena) {
  size_t numbers = 3 * (size_t)s->network.point_count;
  double *forces = sbfi_arena_allocate(arena, numbers + 1, sizeof *forces);
  double *moved = sbfi_arena_allocate(arena, numbers + 1, sizeof *moved);
  *works = (sbfi_push_works){0};
  works->fractions = sbfi_arena_allocate(arena, (size_t)s->network.point_count + 1, sizeof *works->fractions);
  if (!forces || !moved || !works->fractions || !sbfi_level_pushes_make(&works->pushes, s, arena))
    return false;
  for (uint32_t push = 0; push < SBFI_PUSHES; push++) {
    if (!sbfi_progress_report(progress, (double)push / SBFI_PUSHES)) return false;
    memset(moved, 0, numbers * sizeof *moved);
    sbfi_level_push(s, &works->pushes, push, forces);
    sbfi_linear_statics_solve(linear, forces, push_fraction, moved);
    works->totals[push] = sbfi_dot(forces, moved, numbers);
    works->displacements[push] =
        sbfi_arena_allocate(arena, (size_t)s->body->surface.positions.count + 1, 3 * sizeof(double));
    if (!works->displacements[push]) return false;
    sbfi_level_get_surface_displacements(s, moved, works->displacements[push]);
    if (works->totals[push] > 0) add_works(linear, moved, 1 / works->totals[push], works->fractions);
  }
  return true;
}

typedef struct work {
  sbfi_level_statics *statics;
  sbfi_linear_statics *linear;
  const sbfi_push_works *works;
  double *target, *own;       /* (points) */
  double *sums, *counts;      /* (points) for smoothing */
  double *forces;             /* (3 x points) */
  double *moved[SBFI_PUSHES]; /* (3 x points) */
  float *stated;              /* (tetrahedra) Pa, original moduli */
} work;

/* Smooths: each point receives the mean of its elements' means. */
static void smooth(const work *w, double *values) {
  const sbf_spring_network *n = &w->statics->network;
  for (int times = 0; times < SMOOTHINGS; times++) {
    memset(w->sums, 0, n->point_count * sizeof *w->sums);
    memset(w->counts, 0, n->point_count * sizeof *w->counts);
    for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
      const uint32_t *at = n->tetrahedra[t].at;
      double mean = (values[at[0]] + values[at[1]] + values[at[2]] + values[at[3]]) / 4;
      for (int k = 0; k < 4; k++) {
        w->sums[at[k]] += mean;
        w->counts[at[k]] += 1;
      }
    }
    for (uint32_t i = 0; i < n->point_count; i++)
      values[i] = w->counts[i] > 0 ? w->sums[i] / w->counts[i] : 0;
  }
}

/* Maps values of the fine level's points to those of this level that embed them. */
static void map_works(const work *w, const sbfi_level_statics *of) {
  const sbf_spring_network *n = &of->network;
  for (uint32_t i = 0; i < n->point_count; i++) {
    if (!(w->works->fractions[i] > 0)) continue;
    sbfi_embedded_vertex by = sbfi_embedder_embed(&w->statics->embedder, n->positions[i], UINT32_MAX);
    double weights[4] = {by.weights.x, by.weights.y, by.weights.z, by.weights.w}, sum = 0;
    for (int k = 0; k < 4; k++) sum += weights[k] = fmax(weights[k], 0);
    for (int k = 0; k < 4 && sum > 0; k++)
      w->target[by.points.at[k]] += w->works->fractions[i] * weights[k] / sum;
  }
}

static void change(const work *w, double none) {
  const sbf_spring_network *n = &w->statics->network;
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    double own = none, target = none;
    for (int k = 0; k < 4; k++) {
      own += w->own[n->tetrahedra[t].at[k]];
      target += w->target[n->tetrahedra[t].at[k]];
    }
    double ratio = fmin(fmax(own / target, 1 / max_change), max_change), root = sqrt(ratio);
    double stated = w->stated[t], factor = w->statics->moduli[t] / stated * root * sqrt(root);
    w->statics->moduli[t] = (float)(stated * fmin(fmax(factor, min_factor), max_factor));
  }
}

static bool reserve(work *w, sbfi_arena *arena) {
  const sbf_spring_network *n = &w->statics->network;
  size_t points = (size_t)n->point_count + 1;
  double **lists[] = {&w->target, &w->own, &w->sums, &w->counts};
  for (int i = 0; i < 4; i++)
    if (!(*lists[i] = sbfi_arena_allocate(arena, points, sizeof(double)))) return false;
  for (int i = 0; i < SBFI_PUSHES; i++)
    if (!(w->moved[i] = sbfi_arena_allocate(arena, points, 3 * sizeof(double)))) return false;
  w->forces = sbfi_arena_allocate(arena, points, 3 * sizeof *w->forces);
  w->stated = sbfi_arena_copy(arena, w->statics->moduli, n->tetrahedron_count, sizeof *w->stated);
  return w->forces && w->stated;
}

bool sbfi_local_fit(sbfi_level_statics *statics, sbfi_linear_statics *linear, const sbfi_level_statics *of,
    const sbfi_push_works *works, sbfi_progress progress, sbfi_arena *scratch) {
  work w = {.statics = statics, .linear = linear, .works = works};
  const sbf_spring_network *n = &statics->network;
  if (!reserve(&w, scratch)) return false;
  map_works(&w, of);
  smooth(&w, w.target);
  double sum = 0;
  for (uint32_t i = 0; i < n->point_count; i++) sum += w.target[i];
  if (!(sum > 0)) return true;
  for (int round = 0; round < ROUNDS; round++) {
    memset(w.own, 0, n->point_count * sizeof *w.own);
    for (uint32_t push = 0; push < SBFI_PUSHES; push++) {
      if (!sbfi_progress_report(progress, (round + (double)push / SBFI_PUSHES) / ROUNDS)) return false;
      if (!(works->totals[push] > 0)) continue;
      sbfi_level_push(statics, &works->pushes, push, w.forces);
      sbfi_linear_statics_solve(linear, w.forces, push_fraction, w.moved[push]);
      add_works(linear, w.moved[push], 1 / works->totals[push], w.own);
    }
    smooth(&w, w.own);
    change(&w, no_work * sum / n->point_count);
    sbfi_linear_statics_refresh(linear);
  }
  return true;
}
