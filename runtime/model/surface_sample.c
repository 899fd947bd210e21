/* Contact sample of a surface vertex: its four points with the largest weights. */
#include <math.h>

#include "model/runtime_model.h"

enum { POINTS = 4 };

/* 1 / sum of w^2 / m; 0 if no point is free. */
static float mass_of(const sbri_island *island, const sbri_sample *s) {
  float sum = 0;
  for (int k = 0; k < POINTS; k++)
    if (s->slots[k] < island->free_count)
      sum += s->weights[k] * s->weights[k] * island->inverse_masses[s->slots[k]];
  return sum > 0 ? 1 / sum : 0;
}

sbri_sample sbri_sample_of(const sbri_island *island, const sbri_skin *skin, uint32_t vertex) {
  uint32_t block = vertex / SBRI_BLOCK, lane = vertex % SBRI_BLOCK;
  sbri_sample s = {.vertex = vertex};
  for (uint32_t c = skin->cell_begins[block]; c < skin->cell_begins[block + 1]; c++) {
    float weight = skin->cells[c].weights[lane];
    uint32_t slot = skin->cells[c].slots[lane] - island->first_slot;
    for (int k = 0; k < POINTS && weight != 0; k++) {
      float own = s.weights[k];
      uint32_t at = s.slots[k];
      if (!(fabsf(weight) > fabsf(own))) continue;
      s.weights[k] = weight, s.slots[k] = slot;
      weight = own, slot = at;
    }
  }
  float sum = s.weights[0] + s.weights[1] + s.weights[2] + s.weights[3];
  for (int k = 0; k < POINTS; k++) {
    s.weights[k] = fabsf(sum) > 1e-6f ? s.weights[k] / sum : s.weights[k];
    if (s.weights[k] == 0) s.slots[k] = s.slots[0];
  }
  s.mass_kg = mass_of(island, &s);
  return s;
}
