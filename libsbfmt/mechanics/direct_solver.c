#include "mechanics/direct_solver.h"

#include <string.h>

#include "mechanics/vector_sums.h"

enum { MAX_POINTS = 700 };
/* Minimum fraction of its diagonal for a row that is independent of the others. */
static const double min_pivot = 1e-12;

bool sbfi_direct_solver_helps(uint32_t point_count) {
  return point_count <= MAX_POINTS;
}

static bool is_included(const sbfi_block_matrix *m, uint32_t point) {
  return m->blocks[9 * (size_t)m->diagonals[point]] > 0;
}

static uint32_t count_neighbours(const sbfi_block_matrix *m, uint32_t point) {
  return m->begins[point + 1] - m->begins[point];
}

/* ---- The order ---- */

/* Appends the points connected to `start`, breadth first, those with few neighbours first. Returns the
 * last point, which is far from the start. */
static uint32_t visit(sbfi_direct_solver *s, const sbfi_block_matrix *m, uint32_t start, uint32_t from) {
  uint32_t end = from;
  s->points[end++] = start;
  s->order[start] = from;
  for (uint32_t next = from; next < end; next++) {
    uint32_t first = end;
    for (uint32_t k = m->begins[s->points[next]]; k < m->begins[s->points[next] + 1]; k++) {
      uint32_t point = m->columns[k], at = end;
      if (!is_included(m, point) || s->order[point] != UINT32_MAX) continue;
      s->order[point] = end++;
      for (; at > first && count_neighbours(m, s->points[at - 1]) > count_neighbours(m, point); at--)
        s->points[at] = s->points[at - 1];
      s->points[at] = point;
    }
  }
  s->point_count = end;
  return s->points[end - 1];
}

static void forget(sbfi_direct_solver *s, uint32_t from) {
  for (uint32_t i = from; i < s->point_count; i++) s->order[s->points[i]] = UINT32_MAX;
}

static void order_points(sbfi_direct_solver *s, const sbfi_block_matrix *m) {
  for (uint32_t i = 0; i < m->row_count; i++) s->order[i] = UINT32_MAX;
  for (uint32_t i = 0; i < m->row_count; i++) {
    if (!is_included(m, i) || s->order[i] != UINT32_MAX) continue;
    uint32_t from = s->point_count, start = i;
    /* Two searches from the far end: a shortened version of George and Liu's search for a peripheral
     * point. */
    for (int times = 0; times < 2; times++) {
      start = visit(s, m, start, from);
      forget(s, from);
    }
    visit(s, m, start, from);
  }
  for (uint32_t i = 0, j = s->point_count; i + 1 < j; i++) {
    uint32_t point = s->points[i];
    s->points[i] = s->points[--j];
    s->points[j] = point;
  }
  for (uint32_t i = 0; i < s->point_count; i++) s->order[s->points[i]] = i;
}

/* ---- The factor ---- */

static void copy_blocks(const sbfi_direct_solver *s, const sbfi_block_matrix *m) {
  for (uint32_t i = 0; i < s->point_count; i++)
    for (uint32_t k = m->begins[s->points[i]]; k < m->begins[s->points[i] + 1]; k++) {
      uint32_t j = s->order[m->columns[k]];
      if (j == UINT32_MAX || j > i) continue;
      for (uint32_t row = 0; row < 3; row++) {
        uint32_t at = 3 * i + row, count = i == j ? row + 1 : 3;
        memcpy(s->factor + s->begins[at] + (3 * j - s->firsts[at]),
            m->blocks + 9 * (size_t)k + 3 * (size_t)row, count * sizeof(double));
      }
    }
}

static double *row_of(const sbfi_direct_solver *s, uint32_t row) {
  return s->factor + s->begins[row];
}
static double diagonal_of(const sbfi_direct_solver *s, uint32_t row) {
  return s->factor[s->begins[row] + (row - s->firsts[row])];
}

/* Dot products of three rows with a fourth. */
static void sums_of_products(const double *const rows[3], const double *other, size_t count, double sums[3]) {
  double parts[3][2] = {{0}};
  size_t i = 0;
  for (; i + 2 <= count; i += 2)
    for (int row = 0; row < 3; row++)
      for (size_t k = 0; k < 2; k++) parts[row][k] += rows[row][i + k] * other[i + k];
  for (; i < count; i++)
    for (int row = 0; row < 3; row++) parts[row][0] += rows[row][i] * other[i];
  for (int row = 0; row < 3; row++) sums[row] = parts[row][0] + parts[row][1];
}

/* Converts L_ij D_j to L_ij, and computes the diagonal D. */
static void finish_row(sbfi_direct_solver *s, uint32_t row) {
  double *of = row_of(s, row);
  uint32_t first = s->firsts[row];
  double before = of[row - first], pivot = before;
  for (uint32_t j = first; j < row; j++) {
    double d = diagonal_of(s, j), l = d > 0 ? of[j - first] / d : 0;
    pivot -= of[j - first] * l;
    of[j - first] = l;
  }
  of[row - first] = pivot > min_pivot * before && before > 0 ? pivot : 0;
  s->null_count += !(of[row - first] > 0);
}

/* Handles the three rows of a point together, because their envelopes begin at one column. */
static void factorise(sbfi_direct_solver *s) {
  s->null_count = 0;
  for (uint32_t i = 0; i < s->size; i += 3) {
    double *of[3] = {row_of(s, i), row_of(s, i + 1), row_of(s, i + 2)};
    uint32_t first = s->firsts[i];
    for (uint32_t j = first; j < i; j++) {
      uint32_t from = s->firsts[j] > first ? s->firsts[j] : first;
      const double *rows[3] = {of[0] + (from - first), of[1] + (from - first), of[2] + (from - first)};
      double sums[3];
      sums_of_products(rows, row_of(s, j) + (from - s->firsts[j]), j - from, sums);
      for (int row = 0; row < 3; row++) of[row][j - first] -= sums[row];
    }
    finish_row(s, i);
    for (uint32_t row = 1; row < 3; row++) {
      for (uint32_t j = i; j < i + row; j++)
        of[row][j - first] -= sbfi_sum_of_products(of[row], of[j - i], j - first);
      finish_row(s, i + row);
    }
  }
}

void sbfi_direct_solver_refresh(sbfi_direct_solver *s, const sbfi_block_matrix *m) {
  if (s->size == 0) return;
  memset(s->factor, 0, (s->begins[s->size - 1] + s->size - s->firsts[s->size - 1]) * sizeof *s->factor);
  copy_blocks(s, m);
  factorise(s);
}

bool sbfi_direct_solver_make(sbfi_direct_solver *s, const sbfi_block_matrix *m, sbfi_arena *arena) {
  *s = (sbfi_direct_solver){0};
  s->points = sbfi_arena_allocate(arena, (size_t)m->row_count + 1, sizeof *s->points);
  s->order = sbfi_arena_allocate(arena, (size_t)m->row_count + 1, sizeof *s->order);
  if (!s->points || !s->order) return false;
  order_points(s, m);
  s->size = 3 * s->point_count;
  s->firsts = sbfi_arena_allocate(arena, (size_t)s->size + 1, sizeof *s->firsts);
  s->begins = sbfi_arena_allocate(arena, (size_t)s->size + 1, sizeof *s->begins);
  s->values = sbfi_arena_allocate(arena, (size_t)s->size + 1, sizeof *s->values);
  if (!s->firsts || !s->begins || !s->values) return false;
  size_t total = 0;
  for (uint32_t i = 0; i < s->point_count; i++) {
    uint32_t first = i;
    for (uint32_t k = m->begins[s->points[i]]; k < m->begins[s->points[i] + 1]; k++)
      if (s->order[m->columns[k]] < first) first = s->order[m->columns[k]];
    for (uint32_t at = 3 * i; at < 3 * i + 3; at++) {
      s->firsts[at] = 3 * first;
      s->begins[at] = total;
      total += at - 3 * first + 1;
    }
  }
  s->factor = sbfi_arena_allocate(arena, total + 1, sizeof *s->factor);
  if (!s->factor) return false;
  sbfi_direct_solver_refresh(s, m);
  return true;
}

void sbfi_direct_solver_solve(const sbfi_direct_solver *s, const double *b, double *x) {
  double *v = s->values;
  for (uint32_t p = 0; p < s->point_count; p++)
    memcpy(v + 3 * (size_t)p, b + 3 * (size_t)s->points[p], 3 * sizeof *v);
  for (uint32_t i = 0; i < s->size; i++)
    v[i] -= sbfi_sum_of_products(row_of(s, i), v + s->firsts[i], i - s->firsts[i]);
  for (uint32_t i = 0; i < s->size; i++) v[i] = diagonal_of(s, i) > 0 ? v[i] / diagonal_of(s, i) : 0;
  for (uint32_t i = s->size; i-- > 0;)
    sbfi_subtract_scaled(v + s->firsts[i], row_of(s, i), v[i], i - s->firsts[i]);
  for (size_t p = 0; p < s->point_count; p++) memcpy(x + 3 * (size_t)s->points[p], v + 3 * p, 3 * sizeof *v);
}
