#include "build/levels/spring_fit.h"

#include <math.h>
#include <string.h>

static const double solve_share = 2e-3;
/* Both factors stay between these: what springs lack of a matter's stiffness beyond is a shape that they
 * cannot hold at all, and more of it would shorten the time step for nothing. */
static const double least_factor = 0.125, most_factor = 16;
/* The ratio of the surface's factor to the inner one is looked for up to a fourth and four, by these steps.
 */
static const double steps[] = {2, 1.25}, most_ratio = 4;

typedef struct work {
  sbfi_level_statics *statics;
  sbfi_linear_statics *linear;
  const double *const *gives;
  float *stated; /* (springs) N/m, before */
  double *moved; /* (3 x surface points) */
  sbfi_arena *scratch;
} work;

/* What two factors come to, the second found by least squares for their ratio. */
typedef struct trial {
  double ratio, inner; /* of the surface's factor to the inner one; that */
  double left;         /* sum of squares */
  double as_is;        /* the same with an inner factor of 1 */
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
    if (!w->gives[load]) continue;
    if (!sbfi_level_lean(s, w->linear, load, solve_share, w->moved, &frequency, w->scratch)) return false;
    for (size_t i = 0; i < 3 * (size_t)s->body->surface.positions.count; i++) {
      double area = s->areas[i / 3];
      sums[0] += area * w->moved[i] * w->moved[i];
      sums[1] += area * w->moved[i] * w->gives[load][i];
      sums[2] += area * w->gives[load][i] * w->gives[load][i];
    }
    if (!(sums[2] > 0)) continue;
    own += sums[0] / sums[2];
    both += sums[1] / sums[2];
    wanted += 1;
  }
  /* Displacements go with one over the factor c: least is own / c^2 - 2 both / c + wanted. */
  double inner = both > 0 && own > 0 ? own / both : 1;
  inner = fmin(fmax(inner, least_factor / fmin(ratio, 1)), most_factor / fmax(ratio, 1));
  *made = (trial){ratio, inner, wanted > 0 ? (own / inner - 2 * both) / inner + wanted : 0,
      wanted > 0 ? own - 2 * both + wanted : 0};
  if (wanted > 0) {
    made->left = sqrt(fmax(made->left, 0) / wanted);
    made->as_is = sqrt(fmax(made->as_is, 0) / wanted);
  }
  return true;
}

bool sbfi_spring_fit(sbfi_level_statics *statics, sbfi_linear_statics *linear, const double *const *gives,
    sbfi_spring_factors *factors, sbfi_arena *scratch) {
  work w = {.statics = statics, .linear = linear, .gives = gives, .scratch = scratch};
  trial best, tried;
  w.stated = sbfi_arena_copy(scratch, statics->stiffness, statics->network.spring_count, sizeof *w.stated);
  w.moved =
      sbfi_arena_allocate(scratch, (size_t)statics->body->surface.positions.count + 1, 3 * sizeof *w.moved);
  *factors = (sbfi_spring_factors){1, 1, 0, 0};
  if (!w.stated || !w.moved || !try_ratio(&w, 1, &best)) return false;
  factors->before = best.as_is;
  for (size_t step = 0; step < sizeof steps / sizeof *steps; step++)
    for (int way = 0; way < 2; way++)
      for (;;) {
        double ratio = way ? best.ratio / steps[step] : best.ratio * steps[step];
        if (ratio > most_ratio || ratio < 1 / most_ratio) break;
        if (!try_ratio(&w, ratio, &tried)) return false;
        if (tried.left >= best.left) break;
        best = tried;
      }
  factors->inner = best.inner;
  factors->surface = best.inner * best.ratio;
  factors->after = best.left;
  set_stiffness(&w, factors->surface, factors->inner);
  return true;
}
