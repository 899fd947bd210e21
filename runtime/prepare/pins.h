/* Reads the pin sets of a level. */
#ifndef SBRI_PINS_H
#define SBRI_PINS_H

#include "model/runtime_model.h"

/* Weight of the set's pin i, within the set's minimum and maximum. */
float sbri_pin_weight(const sbf_pin_set *set, uint32_t i);
/* Frame of the set, and the pin's position in the rest pose, asset space. */
uint32_t sbri_pin_frame(const sbr_model *model, const sbf_pin_set *set);
sbf_vec3 sbri_pin_position(
    const sbr_model *model, const sbf_level *level, const sbf_pin_set *set, uint32_t i);

/* Frame of each point of the level, SBRI_FREE if it is not fully pinned, and its position in the rest pose;
 * both (level->positions.count). */
#define SBRI_FREE UINT32_MAX
void sbri_pins_read(const sbr_model *model, const sbf_level *level, uint32_t *frames, sbf_vec3 *positions);

#endif
