#include "mechanics/level_points.h"

#include <math.h>

static void weigh(const sbf_weight_map *map, const sbf_level *level, float *values) {
  double sum = 0;
  /* Negates the mapped values to mark them, so that the others are found without extra memory. */
  for (uint32_t i = 0; i < map->values.count; i++) {
    uint32_t point = sbfi_level_point(level, i);
    sum += map->values.at[i];
    if (point != UINT32_MAX) values[point] = -(fabsf(values[point]) * map->values.at[i]);
  }
  float mean = map->values.count ? (float)(sum / map->values.count) : 1;
  for (uint32_t i = 0; i < level->positions.count; i++)
    values[i] = signbit(values[i]) ? -values[i] : values[i] * mean;
}

void sbfi_level_weigh(
    const sbf_soft_body *body, const sbf_level *level, sbf_weight_property property, float *values) {
  for (uint32_t m = 0; m < body->weight_maps.count; m++)
    if (body->weight_maps.at[m].property == property) weigh(&body->weight_maps.at[m], level, values);
}
