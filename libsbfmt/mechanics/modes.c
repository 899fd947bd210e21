/* Lanczos iteration with full reorthogonalisation on M^-1/2 K M^-1/2, then bisection by Sturm counts on the
 * tridiagonal matrix (Golub and Van Loan, Matrix Computations, chapters 8 and 10). The six rigid motions of a
 * body that nothing holds are left in: their Ritz values come out as 0 to rounding, like those of mechanisms,
 * and are passed over. */
#include "mechanics/modes.h"

#include <math.h>
#include <string.h>

enum { MOST_STEPS = 120 };

/* Below this share of the greatest eigenvalue a Ritz value is 0 but for rounding. */
static const double zero_share = 1e-8;

/* One spring's second derivative: along * n n^T + across * (I - n n^T), weighted by both ends' masses. */
typedef struct stiff_pair {
  uint32_t a, b; /* places among the free points, or UINT32_MAX */
  double n[3], along, across, root_a, root_b;
} stiff_pair;

typedef struct workspace {
  double *vectors;           /* (steps + 1) x size */
  double *diagonal, *beside; /* (steps) */
  stiff_pair *pairs;
  uint32_t *place_of;
  uint32_t free_count, pair_count, steps;
} workspace;

static void multiply(const workspace *w, const double *from, double *to) {
  memset(to, 0, 3 * (size_t)w->free_count * sizeof *to);
  for (uint32_t i = 0; i < w->pair_count; i++) {
    const stiff_pair *p = &w->pairs[i];
    double d[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
      if (p->a != UINT32_MAX) d[k] += p->root_a * from[3 * p->a + (uint32_t)k];
      if (p->b != UINT32_MAX) d[k] -= p->root_b * from[3 * p->b + (uint32_t)k];
    }
    double dot = (p->along - p->across) * (d[0] * p->n[0] + d[1] * p->n[1] + d[2] * p->n[2]);
    for (int k = 0; k < 3; k++) {
      double f = dot * p->n[k] + p->across * d[k];
      if (p->a != UINT32_MAX) to[3 * p->a + (uint32_t)k] += p->root_a * f;
      if (p->b != UINT32_MAX) to[3 * p->b + (uint32_t)k] -= p->root_b * f;
    }
  }
}

static double dot_product(const double *a, const double *b, size_t count) {
  double sum = 0;
  for (size_t i = 0; i < count; i++) sum += a[i] * b[i];
  return sum;
}

static void add_scaled(double *to, const double *from, double s, size_t count) {
  for (size_t i = 0; i < count; i++) to[i] += s * from[i];
}

/* Fills the tridiagonal matrix; returns its size. */
static uint32_t iterate(workspace *w) {
  size_t size = 3 * (size_t)w->free_count;
  double *v = w->vectors;
  uint32_t random = 12345;
  for (size_t i = 0; i < size; i++) {
    random = random * 1664525u + 1013904223u;
    v[i] = (double)(int32_t)random;
  }
  double length = sqrt(dot_product(v, v, size));
  for (size_t i = 0; i < size; i++) v[i] /= length;
  double largest = 0;
  for (uint32_t j = 0; j < w->steps; j++) {
    double *current = v + j * size, *next = current + size;
    multiply(w, current, next);
    w->diagonal[j] = dot_product(current, next, size);
    for (int twice = 0; twice < 2; twice++)
      for (uint32_t i = 0; i <= j; i++)
        add_scaled(next, v + i * size, -dot_product(v + i * size, next, size), size);
    length = sqrt(dot_product(next, next, size));
    if (w->diagonal[j] > largest) largest = w->diagonal[j];
    if (length <= 1e-13 * largest) return j + 1;
    w->beside[j] = length;
    for (size_t i = 0; i < size; i++) next[i] /= length;
  }
  return w->steps;
}

/* How many eigenvalues of the tridiagonal matrix lie below x. */
static uint32_t count_below(const workspace *w, uint32_t size, double x) {
  uint32_t below = 0;
  double pivot = 1;
  for (uint32_t i = 0; i < size; i++) {
    double off = i ? w->beside[i - 1] : 0;
    pivot = w->diagonal[i] - x - (off == 0 ? 0 : off * off / pivot);
    if (pivot == 0) pivot = 1e-300;
    below += pivot < 0;
  }
  return below;
}

/* The eigenvalue below which `rank` others lie. */
static double eigenvalue(const workspace *w, uint32_t size, uint32_t rank, double high) {
  double low = -1e-9 * high;
  for (int i = 0; i < 60; i++) {
    double middle = 0.5 * (low + high);
    if (count_below(w, size, middle) > rank)
      high = middle;
    else
      low = middle;
  }
  return high;
}

static void find_extremes(workspace *w, double bound, sbfi_modes *modes) {
  uint32_t size = iterate(w);
  double high = bound * bound * 1.000001;
  double greatest = eigenvalue(w, size, size - 1, high);
  uint32_t zeros = count_below(w, size, zero_share * greatest);
  modes->fastest_rad_s = sqrt(greatest > 0 ? greatest : 0);
  modes->slowest_rad_s = zeros < size && greatest > 0 ? sqrt(eigenvalue(w, size, zeros, high)) : 0;
}

static void weigh_pairs(const sbfi_modes_input *in, workspace *w) {
  for (uint32_t i = 0; i < in->spring_count; i++) {
    const sbfi_spring *s = &in->springs[i];
    stiff_pair *p = &w->pairs[w->pair_count];
    p->a = w->place_of[s->a], p->b = w->place_of[s->b];
    if ((p->a == UINT32_MAX && p->b == UINT32_MAX) || s->a == s->b) continue;
    const float *a = in->positions + in->stride * s->a, *b = in->positions + in->stride * s->b;
    double square = 0;
    for (int k = 0; k < 3; k++) {
      p->n[k] = (double)b[k] - a[k];
      square += p->n[k] * p->n[k];
    }
    double length = sqrt(square), pull = length > 0 ? 1 - s->rest_length_m / length : 0;
    for (int k = 0; k < 3; k++) p->n[k] = length > 0 ? p->n[k] / length : 0;
    p->along = s->stiffness_n_m;
    /* Without length it resists every way alike; under compression it would only ever lower a frequency. */
    p->across = length > 0 ? s->stiffness_n_m * (pull > 0 ? pull : 0) : s->stiffness_n_m;
    p->root_a = sqrt(in->inverse_masses[s->a]), p->root_b = sqrt(in->inverse_masses[s->b]);
    w->pair_count++;
  }
}

static double gershgorin(const sbfi_modes_input *in, double *sums) {
  for (uint32_t i = 0; i < in->point_count; i++) sums[i] = 0;
  for (uint32_t i = 0; i < in->spring_count; i++) {
    const sbfi_spring *s = &in->springs[i];
    double k = s->stiffness_n_m, wa = in->inverse_masses[s->a], wb = in->inverse_masses[s->b];
    double across = k * sqrt(wa * wb);
    sums[s->a] += k * wa + across;
    sums[s->b] += k * wb + across;
  }
  double greatest = 0;
  for (uint32_t i = 0; i < in->point_count; i++)
    if (sums[i] > greatest) greatest = sums[i];
  return sqrt(greatest);
}

bool sbfi_modes_find(const sbfi_modes_input *in, sbfi_modes *modes, const sbf_allocator *allocator) {
  *modes = (sbfi_modes){0};
  if (in->point_count == 0) return true;
  sbfi_arena arena;
  sbfi_arena_init(&arena, allocator, 0);
  workspace w = {0};
  double *sums = sbfi_arena_allocate(&arena, in->point_count, sizeof *sums);
  w.place_of = sbfi_arena_allocate(&arena, in->point_count, sizeof *w.place_of);
  bool good = sums && w.place_of;
  for (uint32_t i = 0; good && i < in->point_count; i++)
    w.place_of[i] = in->inverse_masses[i] > 0 ? w.free_count++ : UINT32_MAX;
  if (good && w.free_count && in->spring_count) {
    w.steps = 3 * (uint64_t)w.free_count < MOST_STEPS ? 3 * w.free_count : MOST_STEPS;
    w.pairs = sbfi_arena_allocate(&arena, in->spring_count, sizeof *w.pairs);
    w.diagonal = sbfi_arena_allocate(&arena, w.steps, sizeof *w.diagonal);
    w.beside = sbfi_arena_allocate(&arena, w.steps, sizeof *w.beside);
    size_t vector_size = 3 * (size_t)w.free_count * sizeof *w.vectors;
    w.vectors = sbfi_arena_allocate(&arena, w.steps + 1, vector_size);
    good = w.pairs && w.diagonal && w.beside && w.vectors;
    if (good) {
      weigh_pairs(in, &w);
      modes->bound_rad_s = gershgorin(in, sums);
      if (w.pair_count && modes->bound_rad_s > 0) find_extremes(&w, modes->bound_rad_s, modes);
    }
  }
  sbfi_arena_free(&arena);
  return good;
}
