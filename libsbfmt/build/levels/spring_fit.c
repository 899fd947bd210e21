#include "build/levels/spring_fit.h"

#include <math.h>
#include <string.h>

#include "build/levels/stiffness_descent.h"

static const double solve_fraction = 2e-3;
/* Bounds of both factors and of each spring's own. Differences beyond them come from shapes that springs
 * cannot support, and larger factors would only shorten the time step. A four times stiffer point at most
 * doubles the substeps. */
static const double min_factor = 0.125, max_factor = 16, max_raise = 4, move_fraction = 1e-3;
enum { MAX_ROUNDS = 25 };
/* Range and step of the search for the ratio of the surface's factor to the interior one; each spring's
 * own fit does the rest. */
static const double step = 2, max_ratio = 4;
/* Above this number of points both factors are equal at first: each trial takes seconds. */
enum { MAX_TRIED_POINTS = 4000 };

typedef struct work {
  sbfi_level_statics *statics;
  sbfi_linear_statics *linear;
  const double *const *displacements; /* (loads) NULL: ignored */
  float *stated;                      /* (springs) N/m, original stiffness */
  double *moved;                      /* (3 x surface points) */
  sbfi_arena *scratch;
  sbfi_progress progress;
} work;

/* Result of two factors; the second is the least squares solution for their ratio. */
typedef struct trial {
  double ratio, inner; /* ratio of the surface's factor to the interior one; the interior factor */
  double left;         /* sum of squared residuals */
  double as_is;        /* the same with an interior factor of 1 */
} trial;

static bool is_inner(const sbf_level *level, uint32_t *set, uint32_t *left) {
  while (*left == 0) *left = level->springs.at[++*set].ends.count;
  --*left;
  return level->springs.at[*set].kind == SBF_SPRING_KIND_INTERNAL;
}

static void set_stiffness(const work *w, double surface, double inner) {
  uint32_t set = UINT32_MAX, left = 0;
  for (uint32_t i = 0; i < w->statics->network.spring_count; i++) {
    double factor = is_inner(w->statics->level, &set, &left) ? inner : surface;
    w->statics->stiffness[i] = (float)(w->stated[i] * factor);
  }
  sbfi_linear_statics_refresh(w->linear);
}

static bool try_ratio(const work *w, double ratio, trial *made) {
  const sbfi_level_statics *s = w->statics;
  double own = 0, both = 0, wanted = 0;
  set_stiffness(w, ratio, 1);
  for (uint32_t load = 0; load < s->load_count; load++) {
    double sums[3] = {0}, frequency;
    if (!w->displacements[load]) continue;
    bool is_long = load == 0 || s->network.point_count > MAX_TRIED_POINTS;
    if (is_long && !sbfi_progress_report(w->progress, 0)) return false;
    if (!sbfi_level_solve_linear(s, w->linear, load, solve_fraction, w->moved, &frequency, w->scratch))
      return false;
    for (size_t i = 0; i < 3 * (size_t)s->body->surface.positions.count; i++) {
      double area = s->areas[i / 3];
      sums[0] += area * w->moved[i] * w->moved[i];
      sums[1] += area * w->moved[i] * w->displacements[load][i];
      sums[2] += area * w->displacements[load][i] * w->displacements[load][i];
    }
    if (!(sums[2] > 0)) continue;
    own += sums[0] / sums[2];
    both += sums[1] / sums[2];
    wanted += 1;
  }
  /* Displacements are inversely proportional to the factor c: the minimum of own / c^2 - 2 both / c +
   * wanted. */
  double inner = both > 0 && own > 0 ? own / both : 1;
  inner = fmin(fmax(inner, min_factor / fmin(ratio, 1)), max_factor / fmax(ratio, 1));
  *made = (trial){ratio, inner, wanted > 0 ? (own / inner - 2 * both) / inner + wanted : 0,
      wanted > 0 ? own - 2 * both + wanted : 0};
  if (wanted > 0) {
    made->left = sqrt(fmax(made->left, 0) / wanted);
    made->as_is = sqrt(fmax(made->as_is, 0) / wanted);
  }
  return true;
}

static void find_means(const work *w, sbfi_spring_factors *factors) {
  uint32_t set = UINT32_MAX, left = 0, counts[2] = {0};
  double sums[2] = {0};
  factors->min = INFINITY;
  factors->max = 0;
  for (uint32_t i = 0; i < w->statics->network.spring_count; i++) {
    bool inner = is_inner(w->statics->level, &set, &left);
    if (!(w->stated[i] > 0)) continue;
    double factor = (double)w->statics->stiffness[i] / w->stated[i];
    sums[inner] += factor;
    counts[inner]++;
    factors->min = fmin(factors->min, factor);
    factors->max = fmax(factors->max, factor);
  }
  factors->surface = counts[0] ? sums[0] / counts[0] : 1;
  factors->inner = counts[1] ? sums[1] / counts[1] : 1;
  if (counts[0] + counts[1] == 0) factors->min = factors->max = 1;
}

bool sbfi_spring_fit(sbfi_level_statics *statics, sbfi_linear_statics *linear,
    const sbfi_target_displacements *wanted, sbfi_spring_factors *factors, sbfi_progress progress,
    sbfi_arena *scratch) {
  work w = {.statics = statics,
      .linear = linear,
      .displacements = wanted->displacements,
      .scratch = scratch,
      .progress = progress};
  trial best, tried;
  w.stated = sbfi_arena_copy(scratch, statics->stiffness, statics->network.spring_count, sizeof *w.stated);
  w.moved =
      sbfi_arena_allocate(scratch, (size_t)statics->body->surface.positions.count + 1, 3 * sizeof *w.moved);
  if (!w.stated || !w.moved || !try_ratio(&w, 1, &best)) return false;
  *factors = (sbfi_spring_factors){.before = best.as_is};
  int directions = statics->network.point_count > MAX_TRIED_POINTS ? 0 : 2;
  for (int direction = 0; direction < directions; direction++)
    for (;;) {
      double ratio = direction ? best.ratio / step : best.ratio * step;
      if (ratio > max_ratio || ratio < 1 / max_ratio) break;
      if (!try_ratio(&w, ratio, &tried)) return false;
      if (tried.left >= best.left) break;
      best = tried;
    }
  factors->by_kind = best.left;
  set_stiffness(&w, best.inner * best.ratio, best.inner);
  const sbfi_factor_bounds bounds = {min_factor, max_factor, max_raise, move_fraction, MAX_ROUNDS};
  if (!sbfi_stiffness_descent(statics, linear, w.stated, wanted, &bounds, &factors->after,
          sbfi_progress_part(progress, 0.2, 1), scratch))
    return false;
  find_means(&w, factors);
  return true;
}
