#include "mechanics/static_solve.h"

#include <string.h>

#include "mechanics/block_matrix.h"
#include "mechanics/network.h"

enum { MOST_STEPS = 100, LEAST_PRODUCTS = 200, MOST_BACKTRACKS = 40 };
static const double TOLERANCE = 1e-8, SUFFICIENT_FALL = 1e-4;

typedef struct statics {
  const sbfi_static_problem *problem;
  const sbf_spring_network *network;
  sbfi_arena arena;
  sbfi_tetrahedron *elements; /* (tetrahedron_count) */
  double *rest_lengths;       /* (spring_count) */
  double *load;               /* (3 x points) N, 0 at held points */
  uint32_t *places_of;        /* (tetrahedron_count x 16 + spring_count x 4) blocks in the matrix */
  sbfi_block_matrix matrix;
  double *forces, *way, *residual, *z, *p, *q, *trial; /* (3 x points) */
  double rounding_j;                                   /* what the energy's sum may be wrong by */
  uint32_t products;
} statics;

static sbfi_d3 at(const double *places, uint32_t point) {
  const double *p = places + 3 * (size_t)point;
  return (sbfi_d3){p[0], p[1], p[2]};
}
static void add(double *to, uint32_t point, sbfi_d3 v) {
  double *p = to + 3 * (size_t)point;
  p[0] += v.x, p[1] += v.y, p[2] += v.z;
}
static bool is_free(const statics *s, uint32_t point) {
  return s->network->masses[point] > 0;
}
static void corners(const statics *s, uint32_t t, const double *places, sbfi_d3 x[4]) {
  for (int k = 0; k < 4; k++) x[k] = at(places, s->network->tetrahedra[t].at[k]);
}

/* ---- Setting up ---- */

static void *reserve(statics *s, size_t count, size_t size) {
  return sbfi_arena_allocate(&s->arena, count ? count : 1, size);
}

static bool make_elements(statics *s) {
  const sbf_spring_network *n = s->network;
  s->elements = reserve(s, n->tetrahedron_count, sizeof *s->elements);
  s->rest_lengths = reserve(s, n->spring_count, sizeof *s->rest_lengths);
  s->load = reserve(s, 3 * (size_t)n->point_count, sizeof *s->load);
  if (!s->elements || !s->rest_lengths || !s->load) return false;
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    sbfi_tetrahedron *e = &s->elements[t];
    if (!sbfi_network_tetrahedron(n, t, e)) *e = (sbfi_tetrahedron){.volume = 0};
    s->rounding_j += 1e-15 * e->volume * (e->lame.mu + e->lame.lambda);
  }
  for (uint32_t i = 0; i < n->spring_count; i++) {
    sbfi_d3 a = sbfi_d3_of(n->positions[n->ends[i].at[0]]), b = sbfi_d3_of(n->positions[n->ends[i].at[1]]);
    const float *stated = s->problem->rest_lengths;
    s->rest_lengths[i] = stated ? (double)stated[i] : sbfi_d3_length(sbfi_d3_sub(b, a));
  }
  sbfi_d3 g = sbfi_d3_of(s->problem->gravity);
  for (uint32_t i = 0; i < n->point_count; i++) {
    if (!is_free(s, i)) continue;
    add(s->load, i, sbfi_d3_scale(g, n->masses[i]));
    if (s->problem->forces) add(s->load, i, at(s->problem->forces, i));
  }
  return true;
}

/* The pairs of points that act on each other, held ones left out. */
static bool make_matrix(statics *s) {
  const sbf_spring_network *n = s->network;
  size_t most = 12 * (size_t)n->tetrahedron_count + 2 * (size_t)n->spring_count, count = 0;
  uint64_t *pairs = reserve(s, most, sizeof *pairs);
  if (!pairs) return false;
  for (uint32_t t = 0; t < n->tetrahedron_count; t++)
    for (int i = 0; i < 4; i++)
      for (int j = 0; j < 4; j++) {
        uint32_t a = n->tetrahedra[t].at[i], b = n->tetrahedra[t].at[j];
        if (i != j && is_free(s, a) && is_free(s, b)) pairs[count++] = (uint64_t)a << 32 | b;
      }
  for (uint32_t i = 0; i < n->spring_count; i++) {
    uint32_t a = n->ends[i].at[0], b = n->ends[i].at[1];
    if (!is_free(s, a) || !is_free(s, b)) continue;
    pairs[count++] = (uint64_t)a << 32 | b;
    pairs[count++] = (uint64_t)b << 32 | a;
  }
  if (!sbfi_block_matrix_make(&s->matrix, n->point_count, pairs, count, &s->arena)) return false;
  s->places_of =
      reserve(s, 16 * (size_t)n->tetrahedron_count + 4 * (size_t)n->spring_count, sizeof *s->places_of);
  if (!s->places_of) return false;
  uint32_t *to = s->places_of;
  for (uint32_t t = 0; t < n->tetrahedron_count; t++)
    for (int k = 0; k < 16; k++)
      *to++ = sbfi_block_matrix_find(&s->matrix, n->tetrahedra[t].at[k / 4], n->tetrahedra[t].at[k % 4]);
  for (uint32_t i = 0; i < n->spring_count; i++)
    for (int k = 0; k < 4; k++)
      *to++ = sbfi_block_matrix_find(&s->matrix, n->ends[i].at[k / 2], n->ends[i].at[k % 2]);
  return true;
}

static bool make_vectors(statics *s) {
  double **vectors[] = {&s->forces, &s->way, &s->residual, &s->z, &s->p, &s->q, &s->trial};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
    *vectors[i] = reserve(s, 3 * (size_t)s->network->point_count, sizeof(double));
    if (!*vectors[i]) return false;
  }
  return true;
}

/* ---- Energy and its derivatives ---- */

static double energy_of(const statics *s, const double *places) {
  const sbf_spring_network *n = s->network;
  double energy = 0;
  sbfi_d3 x[4];
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    if (!(s->elements[t].volume > 0)) continue;
    corners(s, t, places, x);
    energy += sbfi_tetrahedron_energy(&s->elements[t], x);
  }
  for (uint32_t i = 0; i < n->spring_count; i++) {
    sbfi_d3 way = sbfi_d3_sub(at(places, n->ends[i].at[1]), at(places, n->ends[i].at[0]));
    double stretch = sbfi_d3_length(way) - s->rest_lengths[i];
    energy += 0.5 * n->stiffness[i] * stretch * stretch;
  }
  for (uint32_t i = 0; i < n->point_count; i++) {
    sbfi_d3 moved = sbfi_d3_sub(at(places, i), sbfi_d3_of(n->positions[i]));
    if (n->anchors && is_free(s, i)) energy += 0.5 * n->anchors[i] * sbfi_d3_dot(moved, moved);
    energy -= sbfi_d3_dot(at(s->load, i), moved);
  }
  return energy;
}

/* Forces on free points, the load's included; 0 on held ones. Returns their length. */
static double find_forces(const statics *s, const double *places, double *forces) {
  const sbf_spring_network *n = s->network;
  size_t size = 3 * (size_t)n->point_count;
  sbfi_d3 x[4], f[4];
  memcpy(forces, s->load, size * sizeof *forces);
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    if (!(s->elements[t].volume > 0)) continue;
    corners(s, t, places, x);
    sbfi_tetrahedron_forces(&s->elements[t], x, f);
    for (int k = 0; k < 4; k++) add(forces, n->tetrahedra[t].at[k], f[k]);
  }
  for (uint32_t i = 0; i < n->spring_count; i++) {
    uint32_t a = n->ends[i].at[0], b = n->ends[i].at[1];
    sbfi_d3 way = sbfi_d3_sub(at(places, b), at(places, a));
    double length = sbfi_d3_length(way);
    if (!(length > 0)) continue;
    sbfi_d3 pull = sbfi_d3_scale(way, n->stiffness[i] * (length - s->rest_lengths[i]) / length);
    add(forces, a, pull);
    add(forces, b, sbfi_d3_scale(pull, -1));
  }
  for (uint32_t i = 0; i < n->point_count; i++) {
    double *f_i = forces + 3 * (size_t)i;
    if (!is_free(s, i))
      f_i[0] = f_i[1] = f_i[2] = 0;
    else if (n->anchors)
      add(forces, i, sbfi_d3_scale(sbfi_d3_sub(sbfi_d3_of(n->positions[i]), at(places, i)), n->anchors[i]));
  }
  return sqrt(sbfi_dot(forces, forces, size));
}

static void add_block(statics *s, uint32_t place, const double *block, double factor) {
  double *to = s->matrix.blocks + 9 * (size_t)place;
  for (int k = 0; k < 9; k++) to[k] += factor * block[k];
}

/* A spring's block k n n^T + k (1 - l0 / l) (1 - n n^T); what resists sideways only, and negatively where it
 * is pressed, is left out there. */
static void spring_block(const statics *s, uint32_t spring, const double *places, double block[9]) {
  const sbf_spring_network *n = s->network;
  sbfi_d3 way = sbfi_d3_sub(at(places, n->ends[spring].at[1]), at(places, n->ends[spring].at[0]));
  double length = sbfi_d3_length(way), k = n->stiffness[spring];
  double across = length > 0 ? k * (1 - s->rest_lengths[spring] / length) : k;
  if (across < 0) across = 0;
  const double v[3] = {way.x, way.y, way.z};
  double along = length > 0 ? (k - across) / (length * length) : 0;
  for (int row = 0; row < 3; row++)
    for (int column = 0; column < 3; column++)
      block[3 * row + column] = along * v[row] * v[column] + (row == column ? across : 0);
}

static void find_matrix(statics *s, const double *places) {
  const sbf_spring_network *n = s->network;
  double blocks[4][4][9], block[9];
  sbfi_d3 x[4];
  memset(s->matrix.blocks, 0, 9 * (size_t)s->matrix.begins[n->point_count] * sizeof *s->matrix.blocks);
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    if (!(s->elements[t].volume > 0)) continue;
    const uint32_t *places_of = s->places_of + 16 * (size_t)t, *points = n->tetrahedra[t].at;
    corners(s, t, places, x);
    sbfi_tetrahedron_hessian(&s->elements[t], x, blocks);
    for (int i = 0; i < 4; i++)
      for (int j = 0; j < 4 && is_free(s, points[i]); j++)
        if (is_free(s, points[j])) add_block(s, places_of[4 * i + j], blocks[i][j], 1);
  }
  for (uint32_t i = 0; i < n->spring_count; i++) {
    const uint32_t *places_of = s->places_of + 16 * (size_t)n->tetrahedron_count + 4 * (size_t)i;
    const uint32_t *ends = n->ends[i].at;
    spring_block(s, i, places, block);
    for (int k = 0; k < 4; k++)
      if (is_free(s, ends[k / 2]) && is_free(s, ends[k % 2]))
        add_block(s, places_of[k], block, k / 2 == k % 2 ? 1 : -1);
  }
  for (uint32_t i = 0; n->anchors && i < n->point_count; i++)
    for (int k = 0; k < 3 && is_free(s, i); k++)
      s->matrix.blocks[9 * (size_t)s->matrix.diagonals[i] + 4 * (size_t)k] += n->anchors[i];
  sbfi_block_matrix_prepare(&s->matrix);
}

/* ---- Newton ---- */

/* Solves matrix way = forces until what remains is `share` of it, or curvature turns negative. */
static void find_way(statics *s, double share) {
  size_t size = 3 * (size_t)s->network->point_count;
  memset(s->way, 0, size * sizeof *s->way);
  memcpy(s->residual, s->forces, size * sizeof *s->residual);
  sbfi_block_matrix_sweep(&s->matrix, s->residual, s->z);
  memcpy(s->p, s->z, size * sizeof *s->p);
  double left = sbfi_dot(s->residual, s->z, size);
  double enough = share * share * sbfi_dot(s->residual, s->residual, size);
  for (size_t n = 0; n < LEAST_PRODUCTS + size && left > 0; n++) {
    sbfi_block_matrix_times(&s->matrix, s->p, s->q);
    s->products++;
    double curvature = sbfi_dot(s->p, s->q, size);
    if (!(curvature > 0)) {
      if (n == 0) memcpy(s->way, s->p, size * sizeof *s->way);
      return;
    }
    double step = left / curvature, before = left;
    for (size_t i = 0; i < size; i++) {
      s->way[i] += step * s->p[i];
      s->residual[i] -= step * s->q[i];
    }
    if (sbfi_dot(s->residual, s->residual, size) <= enough) return;
    sbfi_block_matrix_sweep(&s->matrix, s->residual, s->z);
    left = sbfi_dot(s->residual, s->z, size);
    for (size_t i = 0; i < size; i++) s->p[i] = s->z[i] + left / before * s->p[i];
  }
}

/* Goes along the way until the energy has fallen enough. False: it does not fall any more. */
static bool go(statics *s, double *places, double *energy) {
  size_t size = 3 * (size_t)s->network->point_count;
  double slope = sbfi_dot(s->forces, s->way, size), step = 1;
  double before = sqrt(sbfi_dot(s->forces, s->forces, size));
  if (!(slope > 0)) return false;
  for (int n = 0; n < MOST_BACKTRACKS; n++, step *= 0.5) {
    for (size_t i = 0; i < size; i++) s->trial[i] = places[i] + step * s->way[i];
    double reached = energy_of(s, s->trial), rounding = s->rounding_j + 1e-14 * fabs(reached);
    bool falls = reached <= *energy - SUFFICIENT_FALL * step * slope;
    /* Near the end the fall drowns in rounding; there smaller forces decide. */
    if (!falls && fabs(reached - *energy) <= rounding) falls = find_forces(s, s->trial, s->q) < before;
    if (!falls) continue;
    memcpy(places, s->trial, size * sizeof *places);
    *energy = reached;
    return true;
  }
  return false;
}

static double least_ratio(const statics *s, const double *places) {
  double least = 1;
  sbfi_d3 x[4];
  for (uint32_t t = 0; t < s->network->tetrahedron_count; t++) {
    if (!(s->elements[t].volume > 0)) continue;
    corners(s, t, places, x);
    double ratio = sbfi_tetrahedron_volume_ratio(&s->elements[t], x);
    least = ratio < least ? ratio : least;
  }
  return least;
}

static void iterate(statics *s, double *places, sbfi_static_outcome *outcome) {
  double tolerance = s->problem->tolerance > 0 ? s->problem->tolerance : TOLERANCE;
  uint32_t most = s->problem->most_steps ? s->problem->most_steps : MOST_STEPS;
  size_t size = 3 * (size_t)s->network->point_count;
  double load = sqrt(sbfi_dot(s->load, s->load, size)), energy = energy_of(s, places);
  double length = find_forces(s, places, s->forces), reference = load > 0 ? load : length;
  for (;;) {
    outcome->residual = reference > 0 ? length / reference : 0;
    outcome->converged = outcome->residual <= tolerance;
    if (outcome->converged || outcome->steps == most) break;
    /* As exact as the residual is small: superlinear, and no work is lost far away. */
    double share = 0.1 * sqrt(outcome->residual < 1 ? outcome->residual : 1);
    find_matrix(s, places);
    find_way(s, share > 1e-3 ? share : 1e-3);
    if (!go(s, places, &energy)) break;
    outcome->steps++;
    length = find_forces(s, places, s->forces);
  }
  outcome->energy_j = energy;
  outcome->least_ratio = least_ratio(s, places);
  outcome->products = s->products;
}

bool sbfi_static_solve(const sbfi_static_problem *problem, double *places, sbfi_static_outcome *outcome,
    const sbf_allocator *allocator) {
  statics s = {.problem = problem, .network = problem->network};
  *outcome = (sbfi_static_outcome){.least_ratio = 1};
  sbf_allocator chosen = sbfi_allocator_or_default(allocator);
  sbfi_arena_init(&s.arena, &chosen, 0);
  bool good = make_elements(&s) && make_matrix(&s) && make_vectors(&s);
  if (good) iterate(&s, places, outcome);
  sbfi_arena_free(&s.arena);
  return good;
}

void sbfi_static_start(const sbf_spring_network *network, double *places) {
  for (uint32_t i = 0; i < network->point_count; i++) {
    places[3 * (size_t)i] = network->positions[i].x;
    places[3 * (size_t)i + 1] = network->positions[i].y;
    places[3 * (size_t)i + 2] = network->positions[i].z;
  }
}
