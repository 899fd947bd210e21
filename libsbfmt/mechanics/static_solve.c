#include "mechanics/static_solve.h"

#include <string.h>

#include "mechanics/coarse_space.h"
#include "mechanics/network.h"
#include "mechanics/network_matrix.h"

enum { MAX_STEPS = 100, MIN_PRODUCTS = 200, MAX_BACKTRACKS = 40, REPORT_INTERVAL = 32 };
static const double TOLERANCE = 1e-8, SUFFICIENT_DECREASE = 1e-4;

typedef struct statics {
  const sbfi_static_problem *problem;
  const sbf_spring_network *network;
  sbfi_arena arena;
  sbfi_network_matrix derivatives;
  bool coarse; /* `space` is in use */
  sbfi_coarse_space space;
  double *load;                                              /* (3 x points) N, 0 at pinned points */
  double *forces, *direction, *residual, *z, *p, *q, *trial; /* (3 x points) */
  double rounding_j;                                         /* rounding error of the energy's sum */
  uint32_t products, steps, max_steps;
  bool ended;
} statics;

static sbfi_d3 at(const double *positions, uint32_t point) {
  const double *p = positions + 3 * (size_t)point;
  return (sbfi_d3){p[0], p[1], p[2]};
}
static void add(double *to, uint32_t point, sbfi_d3 v) {
  double *p = to + 3 * (size_t)point;
  p[0] += v.x, p[1] += v.y, p[2] += v.z;
}
static bool is_free(const statics *s, uint32_t point) {
  return s->network->masses[point] > 0;
}
static void corners(const statics *s, uint32_t t, const double *positions, sbfi_d3 x[4]) {
  for (int k = 0; k < 4; k++) x[k] = at(positions, s->network->tetrahedra[t].at[k]);
}

/* ---- Setting up ---- */

static void *reserve(statics *s, size_t count, size_t size) {
  return sbfi_arena_allocate(&s->arena, count ? count : 1, size);
}

static bool make_load(statics *s) {
  const sbf_spring_network *n = s->network;
  s->load = reserve(s, 3 * (size_t)n->point_count, sizeof *s->load);
  if (!s->load) return false;
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    const sbfi_tetrahedron *e = &s->derivatives.elements[t];
    s->rounding_j += 1e-15 * e->volume * (e->lame.mu + e->lame.lambda);
  }
  sbfi_d3 g = sbfi_d3_of(s->problem->gravity);
  for (uint32_t i = 0; i < n->point_count; i++) {
    if (!is_free(s, i)) continue;
    add(s->load, i, sbfi_d3_scale(g, n->masses[i]));
    if (s->problem->forces) add(s->load, i, at(s->problem->forces, i));
  }
  return true;
}

static bool make_vectors(statics *s) {
  double **vectors[] = {&s->forces, &s->direction, &s->residual, &s->z, &s->p, &s->q, &s->trial};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
    *vectors[i] = reserve(s, 3 * (size_t)s->network->point_count, sizeof(double));
    if (!*vectors[i]) return false;
  }
  return true;
}

/* ---- Energy and its derivatives ---- */

static double energy_of(const statics *s, const double *positions) {
  const sbf_spring_network *n = s->network;
  double energy = 0;
  sbfi_d3 x[4];
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    if (!(s->derivatives.elements[t].volume > 0)) continue;
    corners(s, t, positions, x);
    energy += sbfi_tetrahedron_energy(&s->derivatives.elements[t], x);
  }
  for (uint32_t i = 0; i < n->spring_count; i++) {
    sbfi_d3 displacement = sbfi_d3_sub(at(positions, n->ends[i].at[1]), at(positions, n->ends[i].at[0]));
    double stretch = sbfi_d3_length(displacement) - s->derivatives.rest_lengths[i];
    energy += 0.5 * n->stiffness[i] * stretch * stretch;
  }
  for (uint32_t i = 0; i < n->point_count; i++) {
    sbfi_d3 moved = sbfi_d3_sub(at(positions, i), sbfi_d3_of(n->positions[i]));
    if (n->anchors && is_free(s, i)) energy += 0.5 * n->anchors[i] * sbfi_d3_dot(moved, moved);
    energy -= sbfi_d3_dot(at(s->load, i), moved);
  }
  return energy;
}

/* Forces on free points, including the load; 0 on pinned ones. Returns their length. */
static double find_forces(const statics *s, const double *positions, double *forces) {
  const sbf_spring_network *n = s->network;
  size_t size = 3 * (size_t)n->point_count;
  sbfi_d3 x[4], f[4];
  memcpy(forces, s->load, size * sizeof *forces);
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    if (!(s->derivatives.elements[t].volume > 0)) continue;
    corners(s, t, positions, x);
    sbfi_tetrahedron_compute_forces(&s->derivatives.elements[t], x, f);
    for (int k = 0; k < 4; k++) add(forces, n->tetrahedra[t].at[k], f[k]);
  }
  for (uint32_t i = 0; i < n->spring_count; i++) {
    uint32_t a = n->ends[i].at[0], b = n->ends[i].at[1];
    sbfi_d3 displacement = sbfi_d3_sub(at(positions, b), at(positions, a));
    double length = sbfi_d3_length(displacement);
    if (!(length > 0)) continue;
    sbfi_d3 pull =
        sbfi_d3_scale(displacement, n->stiffness[i] * (length - s->derivatives.rest_lengths[i]) / length);
    add(forces, a, pull);
    add(forces, b, sbfi_d3_scale(pull, -1));
  }
  for (uint32_t i = 0; i < n->point_count; i++) {
    double *f_i = forces + 3 * (size_t)i;
    if (!is_free(s, i))
      f_i[0] = f_i[1] = f_i[2] = 0;
    else if (n->anchors)
      add(forces, i,
          sbfi_d3_scale(sbfi_d3_sub(sbfi_d3_of(n->positions[i]), at(positions, i)), n->anchors[i]));
  }
  return sqrt(sbfi_dot(forces, forces, size));
}

/* ---- Newton ---- */

static bool continues(statics *s) {
  if (!s->ended) s->ended = !sbfi_progress_report(s->problem->progress, (double)s->steps / s->max_steps);
  return !s->ended && (s->problem->max_products == 0 || s->products < s->problem->max_products);
}

static void precondition(const statics *s) {
  sbfi_block_matrix_sweep(&s->derivatives.matrix, s->residual, s->z);
  if (s->coarse) sbfi_coarse_space_add(&s->space, s->residual, s->z);
}

/* Solves matrix * direction = forces until the residual is `fraction` of it, or the curvature is negative. */
static void find_direction(statics *s, double fraction) {
  size_t size = 3 * (size_t)s->network->point_count;
  memset(s->direction, 0, size * sizeof *s->direction);
  memcpy(s->residual, s->forces, size * sizeof *s->residual);
  precondition(s);
  memcpy(s->p, s->z, size * sizeof *s->p);
  double left = sbfi_dot(s->residual, s->z, size);
  double enough = fraction * fraction * sbfi_dot(s->residual, s->residual, size);
  for (size_t n = 0; n < MIN_PRODUCTS + size && left > 0; n++) {
    if (s->products % REPORT_INTERVAL == 0 && !continues(s)) return;
    sbfi_block_matrix_multiply(&s->derivatives.matrix, s->p, s->q);
    s->products++;
    double curvature = sbfi_dot(s->p, s->q, size);
    if (!(curvature > 0)) {
      if (n == 0) memcpy(s->direction, s->p, size * sizeof *s->direction);
      return;
    }
    double step = left / curvature, before = left;
    for (size_t i = 0; i < size; i++) {
      s->direction[i] += step * s->p[i];
      s->residual[i] -= step * s->q[i];
    }
    if (sbfi_dot(s->residual, s->residual, size) <= enough) return;
    precondition(s);
    left = sbfi_dot(s->residual, s->z, size);
    for (size_t i = 0; i < size; i++) s->p[i] = s->z[i] + left / before * s->p[i];
  }
}

/* Line search along the direction until the energy has decreased enough. False if it does not decrease any
 * more. */
static bool line_search(statics *s, double *positions, double *energy) {
  size_t size = 3 * (size_t)s->network->point_count;
  double slope = sbfi_dot(s->forces, s->direction, size), step = 1;
  double before = sqrt(sbfi_dot(s->forces, s->forces, size));
  if (!(slope > 0)) return false;
  for (int n = 0; n < MAX_BACKTRACKS; n++, step *= 0.5) {
    for (size_t i = 0; i < size; i++) s->trial[i] = positions[i] + step * s->direction[i];
    double reached = energy_of(s, s->trial), rounding = s->rounding_j + 1e-14 * fabs(reached);
    bool decreases = reached <= *energy - SUFFICIENT_DECREASE * step * slope;
    /* Near the end the decrease is below rounding; then smaller forces decide. */
    if (!decreases && fabs(reached - *energy) <= rounding)
      decreases = find_forces(s, s->trial, s->q) < before;
    if (!decreases) continue;
    memcpy(positions, s->trial, size * sizeof *positions);
    *energy = reached;
    return true;
  }
  return false;
}

static double min_ratio(const statics *s, const double *positions) {
  double min = 1;
  sbfi_d3 x[4];
  for (uint32_t t = 0; t < s->network->tetrahedron_count; t++) {
    if (!(s->derivatives.elements[t].volume > 0)) continue;
    corners(s, t, positions, x);
    double ratio = sbfi_tetrahedron_volume_ratio(&s->derivatives.elements[t], x);
    min = ratio < min ? ratio : min;
  }
  return min;
}

/* Uses the matrix at rest for its patches. */
static bool make_space(statics *s) {
  s->coarse = sbfi_coarse_space_helps(s->network);
  if (!s->coarse) return true;
  sbfi_static_start(s->network, s->trial);
  sbfi_network_matrix_fill(&s->derivatives, s->trial);
  return sbfi_coarse_space_make(&s->space, &s->derivatives.matrix, s->network->positions, &s->arena);
}

static void iterate(statics *s, double *positions, sbfi_static_outcome *outcome) {
  double tolerance = s->problem->tolerance > 0 ? s->problem->tolerance : TOLERANCE;
  s->max_steps = s->problem->max_steps ? s->problem->max_steps : MAX_STEPS;
  size_t size = 3 * (size_t)s->network->point_count;
  double load = sqrt(sbfi_dot(s->load, s->load, size)), energy = energy_of(s, positions);
  double length = find_forces(s, positions, s->forces), reference = load > 0 ? load : length;
  for (;;) {
    outcome->residual = reference > 0 ? length / reference : 0;
    outcome->converged = outcome->residual <= tolerance;
    if (outcome->converged || s->steps == s->max_steps || !continues(s)) break;
    /* Accuracy proportional to the residual: superlinear convergence without wasted work far from the
     * solution. */
    double fraction = 0.1 * sqrt(outcome->residual < 1 ? outcome->residual : 1);
    sbfi_network_matrix_fill(&s->derivatives, positions);
    if (s->coarse) sbfi_coarse_space_fill(&s->space, &s->derivatives.matrix);
    find_direction(s, fraction > 1e-3 ? fraction : 1e-3);
    if (!line_search(s, positions, &energy)) break;
    s->steps++;
    length = find_forces(s, positions, s->forces);
  }
  outcome->energy_j = energy;
  outcome->min_ratio = min_ratio(s, positions);
  outcome->steps = s->steps;
  outcome->products = s->products;
  outcome->ended = s->ended;
}

bool sbfi_static_solve(const sbfi_static_problem *problem, double *positions, sbfi_static_outcome *outcome,
    const sbf_allocator *allocator) {
  statics s = {.problem = problem, .network = problem->network};
  *outcome = (sbfi_static_outcome){.min_ratio = 1};
  sbf_allocator chosen = sbfi_allocator_or_default(allocator);
  sbfi_arena_init(&s.arena, &chosen, 0);
  bool good = sbfi_network_matrix_make(&s.derivatives, s.network, problem->rest_lengths, &s.arena) &&
              make_load(&s) && make_vectors(&s) && make_space(&s);
  if (good) iterate(&s, positions, outcome);
  sbfi_arena_free(&s.arena);
  return good;
}

void sbfi_static_start(const sbf_spring_network *network, double *positions) {
  for (uint32_t i = 0; i < network->point_count; i++) {
    positions[3 * (size_t)i] = network->positions[i].x;
    positions[3 * (size_t)i + 1] = network->positions[i].y;
    positions[3 * (size_t)i + 2] = network->positions[i].z;
  }
}
