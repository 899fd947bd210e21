/* Pinning of a level's points. */
#ifndef SBFI_PIN_STATES_H
#define SBFI_PIN_STATES_H

#include "sbfmt/model.h"

typedef enum sbfi_pin_state { SBFI_FREE = 0, SBFI_GOAL_PINNED = 1, SBFI_PINNED = 2 } sbfi_pin_state;

/* Weight of a pin: the set's own, clamped to its minimum and maximum. */
float sbfi_pin_weight(const sbf_pin_set *set, uint32_t pin);

/* Strongest pin state of each point, (level->positions.count). */
void sbfi_find_pin_states(const sbf_level *level, uint8_t *pin_states);

#endif
