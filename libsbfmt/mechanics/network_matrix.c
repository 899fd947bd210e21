#include "mechanics/network_matrix.h"

#include <string.h>

#include "mechanics/network.h"

static bool is_free(const sbf_spring_network *n, uint32_t point) {
  return n->masses[point] > 0;
}
static sbfi_d3 at(const double *positions, uint32_t point) {
  const double *p = positions + 3 * (size_t)point;
  return (sbfi_d3){p[0], p[1], p[2]};
}

static void *reserve(sbfi_arena *arena, size_t count, size_t size) {
  return sbfi_arena_allocate(arena, count ? count : 1, size);
}

void sbfi_network_matrix_refresh(sbfi_network_matrix *m) {
  const sbf_spring_network *n = m->network;
  for (uint32_t t = 0; t < n->tetrahedron_count; t++)
    if (!sbfi_network_tetrahedron(n, t, &m->elements[t])) m->elements[t] = (sbfi_tetrahedron){.volume = 0};
}

static bool make_elements(sbfi_network_matrix *m, const float *stated, sbfi_arena *arena) {
  const sbf_spring_network *n = m->network;
  m->elements = reserve(arena, n->tetrahedron_count, sizeof *m->elements);
  m->rest_lengths = reserve(arena, n->spring_count, sizeof *m->rest_lengths);
  if (!m->elements || !m->rest_lengths) return false;
  sbfi_network_matrix_refresh(m);
  for (uint32_t i = 0; i < n->spring_count; i++) {
    sbfi_d3 a = sbfi_d3_of(n->positions[n->ends[i].at[0]]), b = sbfi_d3_of(n->positions[n->ends[i].at[1]]);
    m->rest_lengths[i] = stated ? (double)stated[i] : sbfi_d3_length(sbfi_d3_sub(b, a));
  }
  return true;
}

/* Collects pairs of interacting free points. */
static bool make_pattern(sbfi_network_matrix *m, sbfi_arena *arena) {
  const sbf_spring_network *n = m->network;
  size_t max = 12 * (size_t)n->tetrahedron_count + 2 * (size_t)n->spring_count, count = 0;
  uint64_t *pairs = reserve(arena, max, sizeof *pairs);
  if (!pairs) return false;
  for (uint32_t t = 0; t < n->tetrahedron_count; t++)
    for (int i = 0; i < 4; i++)
      for (int j = 0; j < 4; j++) {
        uint32_t a = n->tetrahedra[t].at[i], b = n->tetrahedra[t].at[j];
        if (i != j && is_free(n, a) && is_free(n, b)) pairs[count++] = (uint64_t)a << 32 | b;
      }
  for (uint32_t i = 0; i < n->spring_count; i++) {
    uint32_t a = n->ends[i].at[0], b = n->ends[i].at[1];
    if (!is_free(n, a) || !is_free(n, b)) continue;
    pairs[count++] = (uint64_t)a << 32 | b;
    pairs[count++] = (uint64_t)b << 32 | a;
  }
  if (!sbfi_block_matrix_make(&m->matrix, n->point_count, pairs, count, arena)) return false;
  m->block_indices = reserve(
      arena, 16 * (size_t)n->tetrahedron_count + 4 * (size_t)n->spring_count, sizeof *m->block_indices);
  if (!m->block_indices) return false;
  uint32_t *to = m->block_indices;
  for (uint32_t t = 0; t < n->tetrahedron_count; t++)
    for (int k = 0; k < 16; k++)
      *to++ = sbfi_block_matrix_find(&m->matrix, n->tetrahedra[t].at[k / 4], n->tetrahedra[t].at[k % 4]);
  for (uint32_t i = 0; i < n->spring_count; i++)
    for (int k = 0; k < 4; k++)
      *to++ = sbfi_block_matrix_find(&m->matrix, n->ends[i].at[k / 2], n->ends[i].at[k % 2]);
  return true;
}

bool sbfi_network_matrix_make(sbfi_network_matrix *made, const sbf_spring_network *network,
    const float *rest_lengths, sbfi_arena *arena) {
  *made = (sbfi_network_matrix){.network = network};
  return make_elements(made, rest_lengths, arena) && make_pattern(made, arena);
}

/* ---- The blocks ---- */

static void add_block(sbfi_network_matrix *m, uint32_t index, const double *block, double factor) {
  double *to = m->matrix.blocks + 9 * (size_t)index;
  for (int k = 0; k < 9; k++) to[k] += factor * block[k];
}

/* A spring's block k n n^T + k (1 - l0 / l) (1 - n n^T). Drops the lateral term of a compressed spring,
 * which is negative. */
static void spring_block(
    const sbfi_network_matrix *m, uint32_t spring, const double *positions, double block[9]) {
  const sbf_spring_network *n = m->network;
  sbfi_d3 displacement =
      sbfi_d3_sub(at(positions, n->ends[spring].at[1]), at(positions, n->ends[spring].at[0]));
  double length = sbfi_d3_length(displacement), k = n->stiffness[spring];
  double across = length > 0 ? k * (1 - m->rest_lengths[spring] / length) : k;
  if (across < 0) across = 0;
  const double v[3] = {displacement.x, displacement.y, displacement.z};
  double along = length > 0 ? (k - across) / (length * length) : 0;
  for (int row = 0; row < 3; row++)
    for (int column = 0; column < 3; column++)
      block[3 * row + column] = along * v[row] * v[column] + (row == column ? across : 0);
}

void sbfi_network_matrix_fill(sbfi_network_matrix *m, const double *positions) {
  const sbf_spring_network *n = m->network;
  double blocks[4][4][9], block[9];
  sbfi_d3 x[4];
  memset(m->matrix.blocks, 0, 9 * (size_t)m->matrix.begins[n->point_count] * sizeof *m->matrix.blocks);
  for (uint32_t t = 0; t < n->tetrahedron_count; t++) {
    if (!(m->elements[t].volume > 0)) continue;
    const uint32_t *block_indices = m->block_indices + 16 * (size_t)t, *points = n->tetrahedra[t].at;
    for (int k = 0; k < 4; k++) x[k] = at(positions, points[k]);
    sbfi_tetrahedron_compute_hessian(&m->elements[t], x, blocks);
    for (int i = 0; i < 4; i++)
      for (int j = 0; j < 4 && is_free(n, points[i]); j++)
        if (is_free(n, points[j])) add_block(m, block_indices[4 * i + j], blocks[i][j], 1);
  }
  for (uint32_t i = 0; i < n->spring_count; i++) {
    const uint32_t *block_indices = m->block_indices + 16 * (size_t)n->tetrahedron_count + 4 * (size_t)i;
    const uint32_t *ends = n->ends[i].at;
    spring_block(m, i, positions, block);
    for (int k = 0; k < 4; k++)
      if (is_free(n, ends[k / 2]) && is_free(n, ends[k % 2]))
        add_block(m, block_indices[k], block, k / 2 == k % 2 ? 1 : -1);
  }
  for (uint32_t i = 0; n->anchors && i < n->point_count; i++)
    for (int k = 0; k < 3 && is_free(n, i); k++)
      m->matrix.blocks[9 * (size_t)m->matrix.diagonals[i] + 4 * (size_t)k] += n->anchors[i];
  sbfi_block_matrix_prepare(&m->matrix);
}
