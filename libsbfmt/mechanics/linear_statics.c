#include "mechanics/linear_statics.h"

#include <string.h>

#include "mechanics/network.h"
#include "mechanics/static_solve.h"

enum { MAX_STEPS = 200 };
static const double singular = 1e-9, limited = 0.1;

static void stiffen_loose(double *block) {
  sbfi_d3 x = {block[0], block[1], block[2]}, y = {block[3], block[4], block[5]},
          z = {block[6], block[7], block[8]};
  double trace = x.x + y.y + z.z;
  if (sbfi_d3_dot(x, sbfi_d3_cross(y, z)) > singular * trace * trace * trace) return;
  for (int k = 0; k < 3; k++) block[4 * k] += limited * trace;
}

static void fill(sbfi_linear_statics *s) {
  sbfi_block_matrix *matrix = &s->stiffness.matrix;
  sbfi_static_start(s->stiffness.network, s->p);
  sbfi_network_matrix_fill(&s->stiffness, s->p);
  for (uint32_t i = 0; i < matrix->row_count; i++)
    stiffen_loose(matrix->blocks + 9 * (size_t)matrix->diagonals[i]);
  sbfi_block_matrix_prepare(matrix);
}

static bool make(sbfi_linear_statics *made, const sbf_spring_network *network, sbfi_arena *arena) {
  size_t size = 3 * (size_t)network->point_count + 1;
  double **vectors[] = {&made->r, &made->z, &made->p, &made->q};
  made->coarse = !made->is_direct && sbfi_coarse_space_helps(network);
  for (int i = 0; i < 4; i++) {
    *vectors[i] = sbfi_arena_allocate(arena, size, sizeof(double));
    if (!*vectors[i]) return false;
  }
  if (!sbfi_network_matrix_make(&made->stiffness, network, NULL, arena)) return false;
  fill(made);
  const sbfi_block_matrix *matrix = &made->stiffness.matrix;
  if (made->is_direct && !sbfi_direct_solver_make(&made->direct, matrix, arena)) return false;
  return !made->coarse || sbfi_coarse_space_make(&made->space, matrix, network->positions, arena);
}

bool sbfi_linear_statics_make(
    sbfi_linear_statics *made, const sbf_spring_network *network, sbfi_arena *arena) {
  *made = (sbfi_linear_statics){.is_direct = false};
  return make(made, network, arena);
}

bool sbfi_linear_statics_make_direct(
    sbfi_linear_statics *made, const sbf_spring_network *network, sbfi_arena *arena) {
  *made = (sbfi_linear_statics){.is_direct = sbfi_direct_solver_helps(network->point_count)};
  return make(made, network, arena);
}

void sbfi_linear_statics_refresh(sbfi_linear_statics *s) {
  sbfi_network_matrix_refresh(&s->stiffness);
  fill(s);
  if (s->is_direct) sbfi_direct_solver_refresh(&s->direct, &s->stiffness.matrix);
  if (s->coarse) sbfi_coarse_space_fill(&s->space, &s->stiffness.matrix);
}

static void precondition(const sbfi_linear_statics *s) {
  sbfi_block_matrix_sweep(&s->stiffness.matrix, s->r, s->z);
  if (s->coarse) sbfi_coarse_space_add(&s->space, s->r, s->z);
}

uint32_t sbfi_linear_statics_solve(
    sbfi_linear_statics *s, const double *forces, double fraction, double *displacements) {
  const sbf_spring_network *n = s->stiffness.network;
  const sbfi_block_matrix *matrix = &s->stiffness.matrix;
  size_t size = 3 * (size_t)n->point_count;
  if (s->is_direct && s->direct.null_count == 0) {
    sbfi_direct_solver_solve(&s->direct, forces, displacements);
    return 1;
  }
  sbfi_block_matrix_multiply(matrix, displacements, s->q);
  for (size_t i = 0; i < size; i++) s->r[i] = n->masses[i / 3] > 0 ? forces[i] - s->q[i] : 0;
  precondition(s);
  memcpy(s->p, s->z, size * sizeof *s->p);
  double left = sbfi_dot(s->r, s->z, size);
  uint32_t steps = 0;
  for (; steps < MAX_STEPS && left > 0; steps++) {
    double work = 0;
    for (size_t i = 0; i < size; i++) work += n->masses[i / 3] > 0 ? forces[i] * displacements[i] : 0;
    if (left <= fraction * fraction * work) break;
    sbfi_block_matrix_multiply(matrix, s->p, s->q);
    double curvature = sbfi_dot(s->p, s->q, size), before = left;
    if (!(curvature > 0)) break;
    double step = left / curvature;
    for (size_t i = 0; i < size; i++) {
      displacements[i] += step * s->p[i];
      s->r[i] -= step * s->q[i];
    }
    precondition(s);
    left = sbfi_dot(s->r, s->z, size);
    for (size_t i = 0; i < size; i++) s->p[i] = s->z[i] + left / before * s->p[i];
  }
  return steps;
}
