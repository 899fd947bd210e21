#include "validate/rules/holding.h"

float sbfi_pin_weight(const sbf_pin_set *set, uint32_t pin) {
  float weight = set->weights.count == 0 ? 1 : set->weights.at[set->weights.count == 1 ? 0 : pin];
  if (weight < set->minimum) weight = set->minimum;
  if (weight > set->maximum) weight = set->maximum;
  return weight;
}

void sbfi_holds_of(const sbf_level *level, uint8_t *holds) {
  for (uint32_t i = 0; i < level->positions.count; i++) holds[i] = SBFI_FREE;
  for (uint32_t s = 0; s < level->pins.count; s++) {
    const sbf_pin_set *set = &level->pins.at[s];
    for (uint32_t i = 0; i < set->points.count; i++) {
      float weight = sbfi_pin_weight(set, i);
      uint8_t hold = weight >= 1 ? SBFI_PINNED : weight > 0 ? SBFI_GOAL_PINNED : SBFI_FREE;
      if (hold > holds[set->points.at[i]]) holds[set->points.at[i]] = hold;
    }
  }
}
