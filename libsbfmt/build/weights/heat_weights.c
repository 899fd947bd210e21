#include "build/weights/heat_weights.h"

#include <string.h>

#include "build/weights/surface_laplacian.h"

enum { LANES = 8, MOST_ITERATIONS = 1000 };
/* How fast heat flows from the bone; the least distance that counts; the residual at which it is solved,
 * against that of the right side; what is too little to keep. */
static const double HEAT = 2, LEAST_DISTANCE = 0.02, TOLERANCE = 1e-4, LEAST_WEIGHT = 1e-3;

typedef double lanes[LANES];

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

/* q = A v for all lanes. */
static void multiply(const heat_system *s, lanes *v, lanes *q) {
  const sbfi_surface_laplacian *l = &s->laplacian;
  for (uint32_t i = 0; i < s->count; i++) {
    double sum[LANES];
    for (int k = 0; k < LANES; k++) sum[k] = (l->diagonal[i] + s->heat[i]) * v[i][k];
    for (uint32_t at = l->begins[i]; at < l->begins[i + 1]; at++) {
      const double *other = v[l->columns[at]], value = l->values[at];
      for (int k = 0; k < LANES; k++) sum[k] -= value * other[k];
    }
    memcpy(q[i], sum, sizeof sum);
  }
}

/* Starts at x = p, of the bones `first` on. `limits` receives the squared residuals at which lanes are
 * solved. */
static void begin(
    heat_system *s, const sbfi_nearest_bone *nearest, const uint32_t bones[LANES], lanes rz, lanes limits) {
  memset(rz, 0, sizeof(lanes));
  memset(limits, 0, sizeof(lanes));
  for (uint32_t i = 0; i < s->count; i++)
    for (int k = 0; k < LANES; k++) s->x[i][k] = nearest[i].bone == bones[k];
  multiply(s, s->x, s->q);
  for (uint32_t i = 0; i < s->count; i++)
    for (int k = 0; k < LANES; k++) {
      double b = s->heat[i] * s->x[i][k];
      s->r[i][k] = b - s->q[i][k];
      s->p[i][k] = s->inverse[i] * s->r[i][k];
      rz[k] += s->r[i][k] * s->p[i][k];
      limits[k] += b * s->inverse[i] * b;
    }
  for (int k = 0; k < LANES; k++) limits[k] *= TOLERANCE * TOLERANCE;
}

static void add_scaled(const heat_system *s, const lanes alpha, lanes rz_next) {
  memset(rz_next, 0, sizeof(lanes));
  for (uint32_t i = 0; i < s->count; i++)
    for (int k = 0; k < LANES; k++) {
      s->x[i][k] += alpha[k] * s->p[i][k];
      s->r[i][k] -= alpha[k] * s->q[i][k];
      rz_next[k] += s->r[i][k] * s->inverse[i] * s->r[i][k];
    }
}

/* Preconditioned by the diagonal, each lane with coefficients of its own (Shewchuk 1994, B3). */
static uint32_t solve(heat_system *s, const sbfi_nearest_bone *nearest, const uint32_t bones[LANES]) {
  lanes rz, limits, pq, alpha, rz_next;
  begin(s, nearest, bones, rz, limits);
  for (uint32_t iteration = 0; iteration < MOST_ITERATIONS; iteration++) {
    bool is_solved = true;
    for (int k = 0; k < LANES; k++) is_solved &= rz[k] <= limits[k];
    if (is_solved) return iteration;
    multiply(s, s->p, s->q);
    memset(pq, 0, sizeof pq);
    for (uint32_t i = 0; i < s->count; i++)
      for (int k = 0; k < LANES; k++) pq[k] += s->p[i][k] * s->q[i][k];
    for (int k = 0; k < LANES; k++) alpha[k] = rz[k] > limits[k] && pq[k] > 0 ? rz[k] / pq[k] : 0;
    add_scaled(s, alpha, rz_next);
    for (int k = 0; k < LANES; k++) {
      double beta = alpha[k] > 0 ? rz_next[k] / rz[k] : 0;
      pq[k] = beta;
      rz[k] = rz_next[k];
    }
    for (uint32_t i = 0; i < s->count; i++)
      for (int k = 0; k < LANES; k++) s->p[i][k] = s->inverse[i] * s->r[i][k] + pq[k] * s->p[i][k];
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
        if (s.x[i][k] > LEAST_WEIGHT) insert(&weights[i], group[k], (float)s.x[i][k]);
  }
  return true;
}
