#include "chart/network_motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sbfmt/mechanics.h"

typedef struct bar {
  uint32_t ends[2];
  double rest_m, stiffness;
} bar;

typedef struct cell {
  uint32_t points[4];
  double gradients[4][3]; /* 1/m, of the shape functions at rest */
  double volume, mu, lambda, gamma;
} cell;

/* State: positions and velocities, three numbers per point. */
typedef struct network {
  uint32_t point_count, bar_count, cell_count;
  double *masses; /* 0: pinned */
  bar *bars;
  cell *cells;
  double gravity[3];
  /* moments: accelerations; begin and sum: positions and velocities */
  double *positions, *velocities, *moments, *begin, *sum;
} network;

static void cross(const double a[3], const double b[3], double to[3]) {
  to[0] = a[1] * b[2] - a[2] * b[1];
  to[1] = a[2] * b[0] - a[0] * b[2];
  to[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Adds forces to `force` (NULL: not needed); returns the energy. */
static double pull_bar(const bar *b, const double *x, double *force) {
  const double *p = x + 3 * (size_t)b->ends[0], *q = x + 3 * (size_t)b->ends[1];
  const double d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  double length = sqrt(dot(d, d)), off = length - b->rest_m;
  for (int k = 0; force && length > 0 && k < 3; k++) {
    double f = b->stiffness * off * d[k] / length;
    force[3 * (size_t)b->ends[0] + (size_t)k] += f;
    force[3 * (size_t)b->ends[1] + (size_t)k] -= f;
  }
  return b->stiffness * off * off / 2;
}

/* f[k] is the k-th column of F. */
static double pull_cell(const cell *c, const double *x, double *force) {
  double f[3][3] = {{0}}, cofactor[3][3], squares = 0;
  for (int i = 0; i < 4; i++)
    for (int k = 0; k < 3; k++)
      for (int r = 0; r < 3; r++) f[k][r] += x[3 * (size_t)c->points[i] + (size_t)r] * c->gradients[i][k];
  cross(f[1], f[2], cofactor[0]), cross(f[2], f[0], cofactor[1]), cross(f[0], f[1], cofactor[2]);
  double j = dot(f[0], cofactor[0]), press = c->lambda * (j - c->gamma);
  for (int k = 0; k < 3; k++) squares += dot(f[k], f[k]);
  for (int i = 0; force && i < 4; i++)
    for (int k = 0; k < 3; k++)
      for (int r = 0; r < 3; r++)
        force[3 * (size_t)c->points[i] + (size_t)r] -=
            c->volume * (c->mu * f[k][r] + press * cofactor[k][r]) * c->gradients[i][k];
  return c->volume * (c->mu / 2 * (squares - 3) + c->lambda / 2 * (j - c->gamma) * (j - c->gamma) -
                         c->mu * c->mu / (2 * c->lambda));
}

static double pull_all(const network *n, const double *x, double *force) {
  double energy = 0;
  if (force) memset(force, 0, 3 * (size_t)n->point_count * sizeof *force);
  for (uint32_t i = 0; i < n->bar_count; i++) energy += pull_bar(&n->bars[i], x, force);
  for (uint32_t i = 0; i < n->cell_count; i++) energy += pull_cell(&n->cells[i], x, force);
  return energy;
}

static void accelerate(network *n) {
  pull_all(n, n->positions, n->moments);
  for (size_t i = 0; i < n->point_count; i++)
    for (size_t k = 0; k < 3; k++) {
      double m = n->masses[i];
      n->moments[3 * i + k] = m > 0 ? n->moments[3 * i + k] / m + n->gravity[k] : 0;
    }
}

static void step(network *n, double h) {
  static const double fraction[4] = {0.5, 0.5, 1, 0}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  size_t count = 3 * (size_t)n->point_count;
  memcpy(n->begin, n->positions, count * sizeof(double));
  memcpy(n->begin + count, n->velocities, count * sizeof(double));
  memcpy(n->sum, n->begin, 2 * count * sizeof(double));
  for (int stage = 0; stage < 4; stage++) {
    accelerate(n);
    for (size_t i = 0; i < count; i++) {
      double v = n->velocities[i], a = n->moments[i];
      n->sum[i] += h * weight[stage] * v;
      n->sum[count + i] += h * weight[stage] * a;
      n->positions[i] = n->begin[i] + h * fraction[stage] * v;
      n->velocities[i] = n->begin[count + i] + h * fraction[stage] * a;
    }
  }
  memcpy(n->positions, n->sum, count * sizeof(double));
  memcpy(n->velocities, n->sum + count, count * sizeof(double));
}

static void check(const network *n, chart_track *track, uint32_t tick) {
  double kinetic = 0, weight = 0;
  for (size_t i = 0; i < n->point_count; i++) {
    const double *x = n->positions + 3 * i, *v = n->velocities + 3 * i;
    track->positions[(size_t)tick * n->point_count + i] = (sbf_vec3){(float)x[0], (float)x[1], (float)x[2]};
    kinetic += n->masses[i] * dot(v, v) / 2;
    weight -= n->masses[i] * dot(x, n->gravity);
  }
  track->kinetic_j[tick] = kinetic;
  track->energy_j[tick] = kinetic + weight + pull_all(n, n->positions, NULL);
  track->volume[tick] = 1;
  if (isfinite(kinetic)) return;
  track->sound = false;
  memcpy(track->why, "the reference diverged", sizeof "the reference diverged");
}

/* ---- From the asset ---- */

static bool make_cell(cell *c, const sbf_level *level, uint32_t number, double young, double poisson) {
  const sbf_uint4 *corners = &level->lattice.tetrahedra.at[number];
  double e[3][3], n[3][3];
  for (int i = 0; i < 4; i++) c->points[i] = corners->at[i];
  for (int i = 0; i < 3; i++) {
    sbf_vec3 p = level->positions.at[corners->at[0]], q = level->positions.at[corners->at[i + 1]];
    e[i][0] = (double)q.x - (double)p.x, e[i][1] = (double)q.y - (double)p.y;
    e[i][2] = (double)q.z - (double)p.z;
  }
  cross(e[1], e[2], n[0]), cross(e[2], e[0], n[1]), cross(e[0], e[1], n[2]);
  double six = dot(e[0], n[0]);
  if (!(six > 0)) return false;
  c->volume = six / 6;
  for (int k = 0; k < 3; k++) {
    c->gradients[0][k] = 0;
    for (int i = 0; i < 3; i++) {
      c->gradients[i + 1][k] = n[i][k] / six;
      c->gradients[0][k] -= c->gradients[i + 1][k];
    }
  }
  c->mu = young / (2 * (1 + poisson));
  c->lambda = c->mu / (1 - 2 * poisson);
  c->gamma = 1 + c->mu / c->lambda;
  return true;
}

static bool add_bars(network *n, const sbf_soft_body *body, const sbf_level *level) {
  uint32_t count = level->positions.count, next = 0;
  float *volumes = calloc(count, sizeof *volumes), *stiffness = calloc(n->bar_count + 1, sizeof *stiffness);
  double *scratch = calloc(2 * (size_t)count, sizeof *scratch);
  bool good = volumes && stiffness && scratch;
  if (good) sbf_level_stiffness(body, level, volumes, scratch, stiffness);
  for (uint32_t s = 0; good && s < level->springs.count; s++) {
    const sbf_spring_set *set = &level->springs.at[s];
    for (uint32_t i = 0; i < set->ends.count; i++, next++) {
      const uint32_t *ends = set->ends.at[i].at;
      sbf_vec3 p = level->positions.at[ends[0]], q = level->positions.at[ends[1]];
      const double d[3] = {(double)q.x - (double)p.x, (double)q.y - (double)p.y, (double)q.z - (double)p.z};
      double rest = set->rest_lengths.count ? (double)set->rest_lengths.at[i] : sqrt(dot(d, d));
      n->bars[next] = (bar){{ends[0], ends[1]}, rest, (double)stiffness[next]};
    }
  }
  free(volumes), free(stiffness), free(scratch);
  return good;
}

static bool add_cells(network *n, const sbf_soft_body *body, const sbf_level *level) {
  float *factors = calloc(level->positions.count, sizeof *factors);
  float *moduli = calloc(n->cell_count + 1, sizeof *moduli);
  uint32_t made = 0;
  bool good = factors && moduli;
  if (good && n->cell_count) sbf_level_moduli(body, level, factors, moduli);
  for (uint32_t i = 0; good && i < n->cell_count; i++)
    made += make_cell(&n->cells[made], level, i, (double)moduli[i], (double)body->attributes.poisson_ratio);
  n->cell_count = made;
  free(factors), free(moduli);
  return good;
}

static bool make_network(network *n, const sbf_asset *asset, sbf_vec3 gravity) {
  const sbf_soft_body *body = &asset->soft_bodies.at[0];
  const sbf_level *level = &body->levels.at[0];
  uint32_t count = level->positions.count;
  *n = (network){.point_count = count, .gravity = {(double)gravity.x, (double)gravity.y, (double)gravity.z}};
  if (level->model == SBF_ELASTIC_MODEL_SPRINGS)
    for (uint32_t i = 0; i < level->springs.count; i++) n->bar_count += level->springs.at[i].ends.count;
  else
    n->cell_count = level->lattice.tetrahedra.count;
  size_t numbers = 3 * (size_t)count;
  uint8_t *pinned = calloc(count, 1);
  float *masses = calloc(count, sizeof *masses);
  n->masses = calloc(count, sizeof(double));
  n->bars = calloc(n->bar_count + 1, sizeof(bar));
  n->cells = calloc(n->cell_count + 1, sizeof(cell));
  n->positions = calloc(numbers, sizeof(double)), n->velocities = calloc(numbers, sizeof(double));
  n->moments = calloc(numbers, sizeof(double));
  n->begin = calloc(2 * numbers, sizeof(double)), n->sum = calloc(2 * numbers, sizeof(double));
  bool good = pinned && masses && n->masses && n->bars && n->cells && n->positions && n->velocities &&
              n->moments && n->begin && n->sum;
  if (good) {
    sbf_level_pinned_points(level, pinned);
    sbf_level_masses(body, level, pinned, masses);
    for (uint32_t i = 0; i < count; i++) {
      sbf_vec3 p = level->positions.at[i];
      n->masses[i] = pinned[i] ? 0 : (double)masses[i];
      n->positions[3 * (size_t)i] = (double)p.x, n->positions[3 * (size_t)i + 1] = (double)p.y;
      n->positions[3 * (size_t)i + 2] = (double)p.z;
    }
    good = (!n->bar_count || add_bars(n, body, level)) && add_cells(n, body, level);
  }
  free(pinned), free(masses);
  return good;
}

static void free_network(network *n) {
  free(n->masses), free(n->bars), free(n->cells);
  free(n->positions), free(n->velocities), free(n->moments), free(n->begin), free(n->sum);
}

bool chart_network_move(const sbf_asset *asset, sbf_vec3 gravity, double tick_s, uint32_t steps,
    uint32_t ticks, chart_track *track) {
  network n;
  bool good = make_network(&n, asset, gravity) && chart_track_make(track, ticks, n.point_count);
  for (uint32_t t = 0; good && t < ticks; t++) {
    for (uint32_t i = 0; i < steps; i++) step(&n, tick_s / steps);
    check(&n, track, t);
  }
  free_network(&n);
  return good;
}
