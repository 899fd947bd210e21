/* Shared parts of building an island. */
#include "prepare/island_maker.h"

#include "mechanics/level_points.h"

float sbri_natural_stiffness(const sbf_soft_body *body, float mass) {
  float volume = mass / body->attributes.density, low = 0, high = 1;
  while (high * high * high < volume) high *= 2;
  for (int i = 0; i < 30; i++) { /* cube root without a library function */
    float middle = 0.5f * (low + high);
    *(middle * middle * middle < volume ? &low : &high) = middle;
  }
  return body->attributes.young_modulus * high;
}

bool sbri_factors_find(
    sbri_island_maker *m, const sbri_body *body, sbf_weight_property property, const float **factors) {
  bool weighed = false;
  *factors = NULL;
  for (uint32_t i = 0; i < body->source->weight_maps.count; i++)
    weighed = weighed || body->source->weight_maps.at[i].property == property;
  if (!weighed) return true;
  float *values = sbri_scratch(m, body->level->positions.count, sizeof *values);
  if (!values) return false;
  for (uint32_t i = 0; i < body->level->positions.count; i++) values[i] = 1;
  sbfi_level_weigh(body->source, body->level, property, values);
  *factors = values;
  return true;
}
