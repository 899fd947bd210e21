/* Golub and Van Loan, Matrix Computations, section 11.5.8 (symmetric successive over-relaxation as a
 * preconditioner, with factor 1). */
#include "mechanics/block_matrix.h"

#include <stdint.h>
#include <string.h>

/* Sorts by row with a counting sort, then each row, which is short, by insertion. Removes duplicates and
 * diagonal pairs. Returns the remaining count, or SIZE_MAX if memory runs out. */
static size_t sort_pairs(uint32_t row_count, uint64_t *pairs, size_t count, sbfi_arena *arena) {
  size_t *ends = sbfi_arena_allocate(arena, (size_t)row_count + 1, sizeof *ends), unique = 0, begin = 0;
  uint64_t *by_row = sbfi_arena_allocate(arena, count + 1, sizeof *by_row);
  if (!ends || !by_row) return SIZE_MAX;
  for (size_t i = 0; i < count; i++) ends[(pairs[i] >> 32) + 1]++;
  for (uint32_t row = 0; row < row_count; row++) ends[row + 1] += ends[row];
  for (size_t i = 0; i < count; i++) by_row[ends[pairs[i] >> 32]++] = pairs[i];
  for (uint32_t row = 0; row < row_count; begin = ends[row++]) {
    size_t first = unique;
    for (size_t i = begin; i < ends[row]; i++) {
      size_t at = unique;
      if ((by_row[i] & UINT32_MAX) == row) continue;
      while (at > first && pairs[at - 1] > by_row[i]) at--;
      if (at > first && pairs[at - 1] == by_row[i]) continue;
      memmove(pairs + at + 1, pairs + at, (unique - at) * sizeof *pairs);
      pairs[at] = by_row[i];
      unique++;
    }
  }
  return unique;
}

bool sbfi_block_matrix_make(
    sbfi_block_matrix *matrix, uint32_t row_count, uint64_t *pairs, size_t pair_count, sbfi_arena *arena) {
  *matrix = (sbfi_block_matrix){.row_count = row_count};
  size_t unique = sort_pairs(row_count, pairs, pair_count, arena);
  if (unique == SIZE_MAX) return false;
  size_t total = unique + row_count;
  uint32_t *begins = sbfi_arena_allocate(arena, (size_t)row_count + 1, sizeof *begins);
  uint32_t *diagonals = sbfi_arena_allocate(arena, (size_t)row_count + 1, sizeof *diagonals);
  uint32_t *columns = sbfi_arena_allocate(arena, total + 1, sizeof *columns);
  matrix->blocks = sbfi_arena_allocate(arena, 9 * total + 1, sizeof *matrix->blocks);
  matrix->inverses = sbfi_arena_allocate(arena, 9 * (size_t)row_count + 1, sizeof *matrix->inverses);
  if (total > UINT32_MAX || !begins || !diagonals || !columns || !matrix->blocks || !matrix->inverses)
    return false;
  size_t from = 0;
  uint32_t at = 0;
  for (uint32_t row = 0; row < row_count; row++) {
    bool placed = false;
    begins[row] = at;
    while (!placed || (from < unique && pairs[from] >> 32 == row)) {
      bool more = from < unique && pairs[from] >> 32 == row;
      if (!placed && (!more || (pairs[from] & UINT32_MAX) > row)) {
        placed = true;
        diagonals[row] = at;
        columns[at++] = row;
      } else {
        columns[at++] = (uint32_t)(pairs[from++] & UINT32_MAX);
      }
    }
  }
  begins[row_count] = at;
  matrix->begins = begins, matrix->columns = columns, matrix->diagonals = diagonals;
  return true;
}

uint32_t sbfi_block_matrix_find(const sbfi_block_matrix *matrix, uint32_t row, uint32_t column) {
  uint32_t low = matrix->begins[row], high = matrix->begins[row + 1];
  while (high - low > 1) {
    uint32_t middle = low + (high - low) / 2;
    *(matrix->columns[middle] <= column ? &low : &high) = middle;
  }
  return low;
}

static sbfi_d3 times(const double *block, const double *v) {
  return (sbfi_d3){block[0] * v[0] + block[1] * v[1] + block[2] * v[2],
      block[3] * v[0] + block[4] * v[1] + block[5] * v[2],
      block[6] * v[0] + block[7] * v[1] + block[8] * v[2]};
}

static sbfi_d3 row_times(const sbfi_block_matrix *m, uint32_t begin, uint32_t end, const double *x) {
  sbfi_d3 sum = {0, 0, 0};
  for (uint32_t i = begin; i < end; i++)
    sum = sbfi_d3_add(sum, times(m->blocks + 9 * (size_t)i, x + 3 * (size_t)m->columns[i]));
  return sum;
}

static void put(double *to, sbfi_d3 v) {
  to[0] = v.x, to[1] = v.y, to[2] = v.z;
}

void sbfi_block_matrix_multiply(const sbfi_block_matrix *m, const double *x, double *y) {
  for (uint32_t row = 0; row < m->row_count; row++)
    put(y + 3 * (size_t)row, row_times(m, m->begins[row], m->begins[row + 1], x));
}

void sbfi_block_matrix_prepare(sbfi_block_matrix *m) {
  for (uint32_t row = 0; row < m->row_count; row++) {
    const double *a = m->blocks + 9 * (size_t)m->diagonals[row];
    double *inverse = m->inverses + 9 * (size_t)row;
    sbfi_d3 x = {a[0], a[3], a[6]}, y = {a[1], a[4], a[7]}, z = {a[2], a[5], a[8]};
    sbfi_d3 yz = sbfi_d3_cross(y, z), zx = sbfi_d3_cross(z, x), xy = sbfi_d3_cross(x, y);
    double determinant = sbfi_d3_dot(x, yz), minor = a[0] * a[4] - a[1] * a[3];
    double s = a[0] > 0 && minor > 0 && determinant > 0 ? 1 / determinant : 0;
    put(inverse, sbfi_d3_scale(yz, s));
    put(inverse + 3, sbfi_d3_scale(zx, s));
    put(inverse + 6, sbfi_d3_scale(xy, s));
  }
}

void sbfi_block_matrix_sweep(const sbfi_block_matrix *m, const double *r, double *z) {
  double rest[3];
  /* (D + L) D^-1 (D + U) z = r: y = (D + L)^-1 r, then z = y - D^-1 U z. */
  for (uint32_t row = 0; row < m->row_count; row++) {
    sbfi_d3 below = row_times(m, m->begins[row], m->diagonals[row], z);
    const double *from = r + 3 * (size_t)row;
    put(rest, (sbfi_d3){from[0] - below.x, from[1] - below.y, from[2] - below.z});
    put(z + 3 * (size_t)row, times(m->inverses + 9 * (size_t)row, rest));
  }
  for (uint32_t row = m->row_count; row-- > 0;) {
    put(rest, row_times(m, m->diagonals[row] + 1, m->begins[row + 1], z));
    sbfi_d3 change = times(m->inverses + 9 * (size_t)row, rest);
    double *to = z + 3 * (size_t)row;
    to[0] -= change.x, to[1] -= change.y, to[2] -= change.z;
  }
}
