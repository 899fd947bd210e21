#include "build/weights/heat_weights.h"

#include <string.h>

#include "build/weights/surface_laplacian.h"

enum { LANES = 8, MOST_ITERATIONS = 1000 };
/* How fast heat flows from the bone; the least distance that counts; the residual at which it is solved,
 * against that of the right side; what is too little to keep. */
static const double HEAT = 2, LEAST_DISTANCE = 0.02, TOLERANCE = 3e-3, LEAST_WEIGHT = 1e-3;

/* Single precision: a solution to some thousandths needs no more, and memory is what limits the speed. Sums
 * are double. */
typedef float lanes[LANES];
typedef double sums[LANES];

typedef struct heat_system {
  sbfi_surface_laplacian laplacian;
  uint32_t count;
  double *heat;    /* (count) c M / d^2 */
  double *inverse; /* (count) of the diagonal */
  lanes *x, *r, *p, *q;
} heat_system;

static bool make_system(
    heat_system *s, const sbfi_weight_mesh *mesh, const sbfi_nearest_bone *nearest, sbfi_arena *arena) {
  size_t count = s->count = mesh->site_count;
  if (!sbfi_surface_laplacian_make(&s->laplacian, mesh, arena)) return false;
  s->heat = sbfi_arena_allocate(arena, count, sizeof *s->heat);
  s->inverse = sbfi_arena_allocate(arena, count, sizeof *s->inverse);
  s->x = sbfi_arena_allocate(arena, count, sizeof *s->x);
  s->r = sbfi_arena_allocate(arena, count, sizeof *s->r);
  s->p = sbfi_arena_allocate(arena, count, sizeof *s->p);
  s->q = sbfi_arena_allocate(arena, count, sizeof *s->q);
  if (!s->heat || !s->inverse || !s->x || !s->r || !s->p || !s->q) return false;
  for (uint32_t i = 0; i < count; i++) {
    double distance = fmax((double)nearest[i].distance, LEAST_DISTANCE);
    s->heat[i] = HEAT * fmax(mesh->areas[i], 1e-12) / (distance * distance);
    s->inverse[i] = 1 / (s->laplacian.diagonal[i] + s->heat[i]);
  }
  return true;
}

/* q = A v for all lanes; `vq` receives the products of v and q. */
static void multiply(const heat_system *s, lanes *v, lanes *q, sums vq) {
  const sbfi_surface_laplacian *l = &s->laplacian;
  memset(vq, 0, sizeof(sums));
  for (uint32_t i = 0; i < s->count; i++) {
    lanes sum;
    float diagonal = (float)(l->diagonal[i] + s->heat[i]);
    for (int k = 0; k < LANES; k++) sum[k] = diagonal * v[i][k];
    for (uint32_t at = l->begins[i]; at < l->begins[i + 1]; at++) {
      const float *other = v[l->columns[at]], value = (float)l->values[at];
      for (int k = 0; k < LANES; k++) sum[k] -= value * other[k];
    }
    for (int k = 0; k < LANES; k++) vq[k] += (double)v[i][k] * (double)sum[k];
    memcpy(q[i], sum, sizeof sum);
  }
}

/* Starts at x = p, of the bones `first` on. `limits` receives the squared residuals at which lanes are
 * solved. */
static void begin(
    heat_system *s, const sbfi_nearest_bone *nearest, const uint32_t bones[LANES], sums rz, sums limits) {
  sums unused;
  memset(rz, 0, sizeof(sums));
  memset(limits, 0, sizeof(sums));
  for (uint32_t i = 0; i < s->count; i++)
    for (int k = 0; k < LANES; k++) s->x[i][k] = nearest[i].bone == bones[k];
  multiply(s, s->x, s->q, unused);
  for (uint32_t i = 0; i < s->count; i++)
    for (int k = 0; k < LANES; k++) {
      double b = s->heat[i] * (double)s->x[i][k], r = b - (double)s->q[i][k];
      s->r[i][k] = (float)r;
      s->p[i][k] = (float)(s->inverse[i] * r);
      rz[k] += r * s->inverse[i] * r;
      limits[k] += b * s->inverse[i] * b;
    }
  for (int k = 0; k < LANES; k++) limits[k] *= TOLERANCE * TOLERANCE;
}

static void add_scaled(const heat_system *s, const sums alpha, sums rz_next) {
  lanes factor;
  for (int k = 0; k < LANES; k++) factor[k] = (float)alpha[k];
  memset(rz_next, 0, sizeof(sums));
  for (uint32_t i = 0; i < s->count; i++) {
    for (int k = 0; k < LANES; k++) {
      s->x[i][k] += factor[k] * s->p[i][k];
      s->r[i][k] -= factor[k] * s->q[i][k];
    }
    for (int k = 0; k < LANES; k++) rz_next[k] += (double)s->r[i][k] * s->inverse[i] * (double)s->r[i][k];
  }
}

static void turn_search(const heat_system *s, const sums beta) {
  lanes factor;
  for (int k = 0; k < LANES; k++) factor[k] = (float)beta[k];
  for (uint32_t i = 0; i < s->count; i++) {
    float inverse = (float)s->inverse[i];
    for (int k = 0; k < LANES; k++) s->p[i][k] = inverse * s->r[i][k] + factor[k] * s->p[i][k];
  }
}

/* Preconditioned by the diagonal, each lane with coefficients of its own (Shewchuk 1994, B3). */
static uint32_t solve(heat_system *s, const sbfi_nearest_bone *nearest, const uint32_t bones[LANES]) {
  sums rz, limits, pq, alpha, beta, rz_next;
  begin(s, nearest, bones, rz, limits);
  for (uint32_t iteration = 0; iteration < MOST_ITERATIONS; iteration++) {
    bool is_solved = true;
    for (int k = 0; k < LANES; k++) is_solved &= rz[k] <= limits[k];
    if (is_solved) return iteration;
    multiply(s, s->p, s->q, pq);
    for (int k = 0; k < LANES; k++) alpha[k] = rz[k] > limits[k] && pq[k] > 0 ? rz[k] / pq[k] : 0;
    add_scaled(s, alpha, rz_next);
    for (int k = 0; k < LANES; k++) {
      beta[k] = alpha[k] > 0 ? rz_next[k] / rz[k] : 0;
      rz[k] = rz_next[k];
    }
    turn_search(s, beta);
  }
  return MOST_ITERATIONS;
}

/* Takes a weight in among the greatest of a site; of equals the first stays before. */
static void insert(sbfi_site_weights *to, uint32_t bone, float weight) {
  int place = SBFI_SITE_BONES;
  while (place > 0 && weight > to->weights[place - 1]) place--;
  if (place == SBFI_SITE_BONES) return;
  for (int k = SBFI_SITE_BONES - 1; k > place; k--) {
    to->bones[k] = to->bones[k - 1];
    to->weights[k] = to->weights[k - 1];
  }
  to->bones[place] = bone;
  to->weights[place] = weight;
}

bool sbfi_heat_weights_solve(const sbfi_weight_mesh *mesh, const sbfi_nearest_bone *nearest,
    uint32_t bone_count, sbfi_site_weights *weights, uint32_t *iterations, sbfi_arena *arena) {
  heat_system s = {.count = mesh->site_count};
  bool *is_used = sbfi_arena_allocate(arena, bone_count, sizeof *is_used);
  *iterations = 0;
  if (!is_used || !make_system(&s, mesh, nearest, arena)) return false;
  for (uint32_t i = 0; i < s.count; i++) {
    is_used[nearest[i].bone] = true;
    for (int k = 0; k < SBFI_SITE_BONES; k++) weights[i].bones[k] = UINT32_MAX, weights[i].weights[k] = 0;
  }
  for (uint32_t bone = 0; bone < bone_count;) {
    uint32_t group[LANES], count = 0;
    for (; bone < bone_count && count < LANES; bone++)
      if (is_used[bone]) group[count++] = bone;
    if (!count) break;
    for (uint32_t k = count; k < LANES; k++) group[k] = UINT32_MAX;
    uint32_t taken = solve(&s, nearest, group);
    *iterations = taken > *iterations ? taken : *iterations;
    for (uint32_t i = 0; i < s.count; i++)
      for (uint32_t k = 0; k < count; k++)
        if ((double)s.x[i][k] > LEAST_WEIGHT) insert(&weights[i], group[k], s.x[i][k]);
  }
  return true;
}
