/* Pinning of a level's points. */
#ifndef SBFI_HOLDING_H
#define SBFI_HOLDING_H

#include "sbfmt/model.h"

typedef enum sbfi_hold { SBFI_FREE = 0, SBFI_GOAL_PINNED = 1, SBFI_PINNED = 2 } sbfi_hold;

/* Weight of a pin: the set's own, clamped to its minimum and maximum. */
float sbfi_pin_weight(const sbf_pin_set *set, uint32_t pin);

/* How pins hold each point (level->positions.count). */
void sbfi_holds_of(const sbf_level *level, uint8_t *holds);

#endif
