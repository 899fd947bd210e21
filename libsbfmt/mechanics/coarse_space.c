#include "mechanics/coarse_space.h"

#include <math.h>
#include <string.h>

#include "mechanics/vector_sums.h"

enum { MANY_POINTS = 200, PATCHES = 48, MODES = 6, MIN_PATCH = 12 };
/* Minimum fraction of its diagonal for a mode that is independent of the others. */
static const double min_pivot = 1e-9;

static bool is_there(const sbfi_block_matrix *m, uint32_t row) {
  return m->blocks[9 * (size_t)m->diagonals[row]] > 0;
}

/* Grows patches breadth first until they are large enough; each starts next to the last one if points are
 * left there. */
static bool make_patches(sbfi_coarse_space *c, const sbfi_block_matrix *m, sbfi_arena *arena) {
  uint32_t *queue = sbfi_arena_allocate(arena, (size_t)c->point_count + 1, sizeof *queue);
  uint32_t there = 0, first = 0, beside = UINT32_MAX;
  if (!queue) return false;
  for (uint32_t i = 0; i < c->point_count; i++) {
    c->patches[i] = UINT32_MAX;
    there += is_there(m, i);
  }
  uint32_t max = there / PATCHES > MIN_PATCH ? there / PATCHES : MIN_PATCH;
  for (uint32_t left = there; left > 0; c->patch_count++) {
    while (beside == UINT32_MAX && (!is_there(m, first) || c->patches[first] != UINT32_MAX)) first++;
    uint32_t size = 0;
    queue[size++] = beside != UINT32_MAX ? beside : first;
    c->patches[queue[0]] = c->patch_count;
    beside = UINT32_MAX;
    for (uint32_t next = 0; next < size; next++)
      for (uint32_t k = m->begins[queue[next]]; k < m->begins[queue[next] + 1]; k++) {
        uint32_t column = m->columns[k];
        if (!is_there(m, column) || c->patches[column] != UINT32_MAX) continue;
        if (size == max) {
          if (beside == UINT32_MAX) beside = column;
          continue;
        }
        c->patches[column] = c->patch_count;
        queue[size++] = column;
      }
    left -= size;
  }
  return true;
}

static bool index_modes(sbfi_coarse_space *c, const sbf_vec3 *positions, sbfi_arena *arena) {
  sbfi_d3 *middles = sbfi_arena_allocate(arena, (size_t)c->patch_count + 1, sizeof *middles);
  double *counts = sbfi_arena_allocate(arena, (size_t)c->patch_count + 1, sizeof *counts);
  double *reaches = sbfi_arena_allocate(arena, (size_t)c->patch_count + 1, sizeof *reaches);
  if (!middles || !counts || !reaches) return false;
  for (uint32_t i = 0; i < c->point_count; i++) {
    if (c->patches[i] == UINT32_MAX) continue;
    middles[c->patches[i]] = sbfi_d3_add(middles[c->patches[i]], sbfi_d3_of(positions[i]));
    counts[c->patches[i]] += 1;
  }
  for (uint32_t p = 0; p < c->patch_count; p++) middles[p] = sbfi_d3_scale(middles[p], 1 / counts[p]);
  for (uint32_t i = 0; i < c->point_count; i++) {
    if (c->patches[i] == UINT32_MAX) continue;
    c->arms[i] = sbfi_d3_sub(sbfi_d3_of(positions[i]), middles[c->patches[i]]);
    reaches[c->patches[i]] = fmax(reaches[c->patches[i]], sbfi_d3_length(c->arms[i]));
  }
  for (uint32_t i = 0; i < c->point_count; i++)
    if (c->patches[i] != UINT32_MAX && reaches[c->patches[i]] > 0)
      c->arms[i] = sbfi_d3_scale(c->arms[i], 1 / reaches[c->patches[i]]);
  return true;
}

/* Displacement of a point in each mode by columns: three translations, three rotations. */
static void modes_of(sbfi_d3 arm, double columns[MODES][3]) {
  const double values[MODES][3] = {
      {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -arm.z, arm.y}, {arm.z, 0, -arm.x}, {-arm.y, arm.x, 0}};
  memcpy(columns, values, sizeof values);
}

static void add_block(sbfi_coarse_space *c, const double *block, uint32_t row, uint32_t column) {
  double left[MODES][3], right[MODES][3], half[MODES][3];
  size_t size = MODES * (size_t)c->patch_count;
  modes_of(c->arms[row], left);
  modes_of(c->arms[column], right);
  for (int j = 0; j < MODES; j++)
    for (int k = 0; k < 3; k++)
      half[j][k] =
          block[3 * k] * right[j][0] + block[3 * k + 1] * right[j][1] + block[3 * k + 2] * right[j][2];
  for (int i = 0; i < MODES; i++) {
    double *to =
        c->factor + (MODES * (size_t)c->patches[row] + (size_t)i) * size + MODES * (size_t)c->patches[column];
    for (int j = 0; j < MODES; j++)
      to[j] += left[i][0] * half[j][0] + left[i][1] * half[j][1] + left[i][2] * half[j][2];
  }
}

/* L D L^T in place, D on the diagonal; `row` is (size) scratch. */
static void factorise(double *a, size_t size, double *row) {
  for (size_t i = 0; i < size; i++) {
    double *of = a + i * size, before = of[i], pivot = before;
    /* row[j] is L_ij D_j at first. */
    for (size_t j = 0; j < i; j++) {
      const double *other = a + j * size;
      row[j] = other[j] > 0 ? of[j] - sbfi_sum_of_products(row, other, j) : 0;
    }
    for (size_t j = 0; j < i; j++) {
      double diagonal = a[j * size + j];
      of[j] = diagonal > 0 ? row[j] / diagonal : 0;
      pivot -= row[j] * of[j];
    }
    of[i] = pivot > min_pivot * before && before > 0 ? pivot : 0;
  }
}

bool sbfi_coarse_space_helps(const sbf_spring_network *network) {
  return network->point_count >= MANY_POINTS && network->tetrahedron_count > 0;
}

bool sbfi_coarse_space_make(
    sbfi_coarse_space *space, const sbfi_block_matrix *matrix, const sbf_vec3 *positions, sbfi_arena *arena) {
  *space = (sbfi_coarse_space){.point_count = matrix->row_count};
  space->patches = sbfi_arena_allocate(arena, (size_t)matrix->row_count + 1, sizeof *space->patches);
  space->arms = sbfi_arena_allocate(arena, (size_t)matrix->row_count + 1, sizeof *space->arms);
  if (!space->patches || !space->arms || !make_patches(space, matrix, arena) ||
      !index_modes(space, positions, arena))
    return false;
  size_t size = MODES * (size_t)space->patch_count;
  space->factor = sbfi_arena_allocate(arena, size * size + 1, sizeof *space->factor);
  space->values = sbfi_arena_allocate(arena, size + 1, sizeof *space->values);
  if (!space->factor || !space->values) return false;
  sbfi_coarse_space_fill(space, matrix);
  return true;
}

void sbfi_coarse_space_fill(sbfi_coarse_space *space, const sbfi_block_matrix *matrix) {
  size_t size = MODES * (size_t)space->patch_count;
  memset(space->factor, 0, size * size * sizeof *space->factor);
  for (uint32_t row = 0; row < matrix->row_count; row++)
    for (uint32_t k = matrix->begins[row]; k < matrix->begins[row + 1]; k++) {
      uint32_t column = matrix->columns[k];
      if (space->patches[row] != UINT32_MAX && space->patches[column] != UINT32_MAX)
        add_block(space, matrix->blocks + 9 * (size_t)k, row, column);
    }
  factorise(space->factor, size, space->values);
}

void sbfi_coarse_space_add(const sbfi_coarse_space *space, const double *r, double *z) {
  double columns[MODES][3], *v = space->values;
  const double *a = space->factor;
  size_t size = MODES * (size_t)space->patch_count;
  memset(v, 0, size * sizeof *v);
  for (uint32_t i = 0; i < space->point_count; i++) {
    if (space->patches[i] == UINT32_MAX) continue;
    const double *at = r + 3 * (size_t)i;
    modes_of(space->arms[i], columns);
    for (int j = 0; j < MODES; j++)
      v[MODES * (size_t)space->patches[i] + (size_t)j] +=
          columns[j][0] * at[0] + columns[j][1] * at[1] + columns[j][2] * at[2];
  }
  for (size_t i = 0; i < size; i++) v[i] -= sbfi_sum_of_products(a + i * size, v, i);
  for (size_t i = 0; i < size; i++) v[i] = a[i * size + i] > 0 ? v[i] / a[i * size + i] : 0;
  for (size_t i = size; i-- > 0;) sbfi_subtract_scaled(v, a + i * size, v[i], i);
  for (uint32_t i = 0; i < space->point_count; i++) {
    if (space->patches[i] == UINT32_MAX) continue;
    double *at = z + 3 * (size_t)i;
    modes_of(space->arms[i], columns);
    for (int j = 0; j < MODES; j++)
      for (int k = 0; k < 3; k++) at[k] += columns[j][k] * v[MODES * (size_t)space->patches[i] + (size_t)j];
  }
}
