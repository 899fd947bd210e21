#include "validate/rules/pin_states.h"

float sbfi_pin_weight(const sbf_pin_set *set, uint32_t pin) {
  float weight = set->weights.count == 0 ? 1 : set->weights.at[set->weights.count == 1 ? 0 : pin];
  if (weight < set->minimum) weight = set->minimum;
  if (weight > set->maximum) weight = set->maximum;
  return weight;
}

void sbfi_find_pin_states(const sbf_level *level, uint8_t *pin_states) {
  for (uint32_t i = 0; i < level->positions.count; i++) pin_states[i] = SBFI_FREE;
  for (uint32_t s = 0; s < level->pins.count; s++) {
    const sbf_pin_set *set = &level->pins.at[s];
    for (uint32_t i = 0; i < set->points.count; i++) {
      float weight = sbfi_pin_weight(set, i);
      uint8_t pin_state = weight >= 1 ? SBFI_PINNED : weight > 0 ? SBFI_GOAL_PINNED : SBFI_FREE;
      if (pin_state > pin_states[set->points.at[i]]) pin_states[set->points.at[i]] = pin_state;
    }
  }
}
