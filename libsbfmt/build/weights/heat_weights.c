#include "build/weights/heat_weights.h"

#include <string.h>

#include "build/weights/heat_preconditioner.h"
#include "build/weights/laplacian_order.h"

enum { LANES = SBFI_HEAT_LANES, MAX_ITERATIONS = 1000 };
/* Rate of heat flow from the bone; minimum distance; relative residual of a solution; minimum weight to
 * keep. */
static const double HEAT = 3, MIN_DISTANCE = 0.02, TOLERANCE = 5e-4, MIN_WEIGHT = 5e-4;

/* Single precision is enough for an accuracy of some thousandths, and memory bandwidth limits the speed.
 * Sums are double. */
typedef sbfi_heat_lanes lanes;
typedef double sums[LANES];

typedef struct heat_system {
  sbfi_surface_laplacian laplacian; /* its rows are reordered */
  uint32_t count;
  uint32_t *sites; /* (count) of each row */
  double *heat;    /* (count) c M / d^2 */
  sbfi_heat_preconditioner preconditioner;
  lanes *x, *r, *p, *q, *z;
} heat_system;

static bool make_system(
    heat_system *s, const sbfi_weight_mesh *mesh, const sbfi_nearest_bone *nearest, sbfi_arena *arena) {
  size_t count = s->count = mesh->site_count;
  s->sites = sbfi_arena_allocate(arena, count, sizeof *s->sites);
  if (!s->sites || !sbfi_surface_laplacian_make(&s->laplacian, mesh, arena) ||
      !sbfi_laplacian_reorder(&s->laplacian, s->count, s->sites, arena))
    return false;
  s->heat = sbfi_arena_allocate(arena, count, sizeof *s->heat);
  s->x = sbfi_arena_allocate(arena, count, sizeof *s->x);
  s->r = sbfi_arena_allocate(arena, count, sizeof *s->r);
  s->p = sbfi_arena_allocate(arena, count, sizeof *s->p);
  s->q = sbfi_arena_allocate(arena, count, sizeof *s->q);
  s->z = sbfi_arena_allocate(arena, count, sizeof *s->z);
  if (!s->heat || !s->x || !s->r || !s->p || !s->q || !s->z) return false;
  for (uint32_t i = 0; i < count; i++) {
    double distance = fmax((double)nearest[s->sites[i]].distance, MIN_DISTANCE);
    s->heat[i] = HEAT * fmax(mesh->areas[s->sites[i]], 1e-12) / (distance * distance);
  }
  return sbfi_heat_preconditioner_make(&s->preconditioner, &s->laplacian, s->heat, s->count, arena);
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

static void products(const heat_system *s, lanes *a, lanes *b, sums ab) {
  memset(ab, 0, sizeof(sums));
  for (uint32_t i = 0; i < s->count; i++)
    for (int k = 0; k < LANES; k++) ab[k] += (double)a[i][k] * (double)b[i][k];
}

/* Starts at x = p. `limits` receives the residuals at which lanes are solved. */
static void begin(
    heat_system *s, const sbfi_nearest_bone *nearest, const uint32_t bones[LANES], sums rz, sums limits) {
  sums unused;
  for (uint32_t i = 0; i < s->count; i++)
    for (int k = 0; k < LANES; k++) {
      s->x[i][k] = nearest[s->sites[i]].bone == bones[k];
      s->r[i][k] = (float)s->heat[i] * s->x[i][k];
    }
  sbfi_heat_precondition(&s->preconditioner, s->r, s->z);
  products(s, s->r, s->z, limits);
  for (int k = 0; k < LANES; k++) limits[k] *= TOLERANCE * TOLERANCE;
  multiply(s, s->x, s->q, unused);
  for (uint32_t i = 0; i < s->count; i++)
    for (int k = 0; k < LANES; k++) s->r[i][k] -= s->q[i][k];
  sbfi_heat_precondition(&s->preconditioner, s->r, s->z);
  products(s, s->r, s->z, rz);
  memcpy(s->p, s->z, s->count * sizeof *s->p);
}

static void add_scaled(const heat_system *s, const sums alpha) {
  lanes factor;
  for (int k = 0; k < LANES; k++) factor[k] = (float)alpha[k];
  for (uint32_t i = 0; i < s->count; i++)
    for (int k = 0; k < LANES; k++) {
      s->x[i][k] += factor[k] * s->p[i][k];
      s->r[i][k] -= factor[k] * s->q[i][k];
    }
}

static void update_search(const heat_system *s, const sums beta) {
  lanes factor;
  for (int k = 0; k < LANES; k++) factor[k] = (float)beta[k];
  for (uint32_t i = 0; i < s->count; i++)
    for (int k = 0; k < LANES; k++) s->p[i][k] = s->z[i][k] + factor[k] * s->p[i][k];
}

/* Each lane has its own coefficients (Shewchuk 1994, B3). */
static uint32_t solve(heat_system *s, const sbfi_nearest_bone *nearest, const uint32_t bones[LANES]) {
  sums rz, limits, pq, alpha, beta, rz_next;
  begin(s, nearest, bones, rz, limits);
  for (uint32_t iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
    bool is_solved = true;
    for (int k = 0; k < LANES; k++) is_solved &= rz[k] <= limits[k];
    if (is_solved) return iteration;
    multiply(s, s->p, s->q, pq);
    for (int k = 0; k < LANES; k++) alpha[k] = rz[k] > limits[k] && pq[k] > 0 ? rz[k] / pq[k] : 0;
    add_scaled(s, alpha);
    sbfi_heat_precondition(&s->preconditioner, s->r, s->z);
    products(s, s->r, s->z, rz_next);
    for (int k = 0; k < LANES; k++) {
      beta[k] = alpha[k] > 0 ? rz_next[k] / rz[k] : 0;
      rz[k] = rz_next[k];
    }
    update_search(s, beta);
  }
  return MAX_ITERATIONS;
}

/* Inserts a weight among the greatest of a site; the first comes first if equal. */
static void insert(sbfi_site_weights *to, uint32_t bone, float weight) {
  int index = SBFI_SITE_BONES;
  while (index > 0 && weight > to->weights[index - 1]) index--;
  if (index == SBFI_SITE_BONES) return;
  for (int k = SBFI_SITE_BONES - 1; k > index; k--) {
    to->bones[k] = to->bones[k - 1];
    to->weights[k] = to->weights[k - 1];
  }
  to->bones[index] = bone;
  to->weights[index] = weight;
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
        if ((double)s.x[i][k] > MIN_WEIGHT) insert(&weights[s.sites[i]], group[k], s.x[i][k]);
  }
  return true;
}
