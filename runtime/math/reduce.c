#include "math/reduce.h"

float sbri_sum(const float *values, size_t count) {
  float lanes[SBRI_BLOCK] = {0};
  size_t whole = count / SBRI_BLOCK * SBRI_BLOCK;
  for (size_t i = 0; i < whole; i += SBRI_BLOCK)
    for (int lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES)
      sbri_wide_store(lanes + lane, sbri_wide_load(lanes + lane) + sbri_wide_load(values + i + (size_t)lane));
  for (size_t i = whole; i < count; i++) lanes[i - whole] += values[i];
  return sbri_tree_sum(lanes);
}

float sbri_greatest(const float *values, size_t count, float min) {
  float greatest = min;
  for (size_t i = 0; i < count; i++) greatest = values[i] > greatest ? values[i] : greatest;
  return greatest;
}
