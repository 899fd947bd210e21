#include "build/weights/heat_preconditioner.h"

#include <string.h>

enum { LANES = SBFI_HEAT_LANES };

/* Fraction of the dropped fill-in that is added to the diagonal; all of it may leave the diagonal too
 * small. */
static const double KEPT = 0.98;

bool sbfi_heat_preconditioner_make(sbfi_heat_preconditioner *p, const sbfi_surface_laplacian *l,
    const double *heat, uint32_t count, sbfi_arena *arena) {
  *p = (sbfi_heat_preconditioner){.laplacian = l, .count = count};
  double *diagonal = sbfi_arena_allocate(arena, count, sizeof *diagonal);
  double *behind = sbfi_arena_allocate(arena, count, sizeof *behind); /* sum of each row of U */
  p->inverse = sbfi_arena_allocate(arena, count, sizeof *p->inverse);
  p->middle = sbfi_arena_allocate(arena, count, sizeof *p->middle);
  if (!diagonal || !behind || !p->inverse || !p->middle) return false;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t at = l->begins[i];
    double d = l->diagonal[i] + heat[i];
    for (; at < l->begins[i + 1] && l->columns[at] < i; at++) {
      uint32_t j = l->columns[at];
      double value = l->values[at];
      d -= value * (KEPT * behind[j] + (1 - KEPT) * value) / diagonal[j];
    }
    p->middle[i] = at;
    for (; at < l->begins[i + 1]; at++) behind[i] += l->values[at];
    diagonal[i] = d;
    p->inverse[i] = (float)(1 / d);
  }
  return true;
}

void sbfi_heat_precondition(const sbfi_heat_preconditioner *p, sbfi_heat_lanes *r, sbfi_heat_lanes *z) {
  const sbfi_surface_laplacian *l = p->laplacian;
  for (uint32_t i = 0; i < p->count; i++) {
    sbfi_heat_lanes sum;
    memcpy(sum, r[i], sizeof sum);
    for (uint32_t at = l->begins[i]; at < p->middle[i]; at++) {
      const float *other = z[l->columns[at]], value = (float)l->values[at];
      for (int k = 0; k < LANES; k++) sum[k] += value * other[k];
    }
    for (int k = 0; k < LANES; k++) z[i][k] = p->inverse[i] * sum[k];
  }
  for (uint32_t i = p->count; i-- > 0;) {
    sbfi_heat_lanes sum = {0};
    for (uint32_t at = p->middle[i]; at < l->begins[i + 1]; at++) {
      const float *other = z[l->columns[at]], value = (float)l->values[at];
      for (int k = 0; k < LANES; k++) sum[k] += value * other[k];
    }
    for (int k = 0; k < LANES; k++) z[i][k] += p->inverse[i] * sum[k];
  }
}
