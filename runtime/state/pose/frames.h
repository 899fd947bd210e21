/* Frames of a character's pose: their motion since the rest pose, the positions of pinned and driven points,
 * and the input of the gait. */
#ifndef SBRI_FRAMES_H
#define SBRI_FRAMES_H

#include "state/world.h"

/* ---- state/pose/frames.c ---- */

/* Motion of all frames since the rest pose, for a pose with squash interpolated at `fraction` of the tick.
 * The result takes sbri_deltas_size bytes. */
void sbri_deltas_make(const sbri_character *c, const sbr_transform *pose, float fraction, sbri_delta *deltas);
void sbri_deltas_interpolate(const sbri_character *c, float fraction, sbri_delta *deltas);
/* The same for one frame, without squash. */
sbr_transform sbri_delta_of(const sbri_character *c, const sbr_transform *pose, uint32_t frame);

/* ---- state/pose/drivers.c ---- */

/* Positions of a body's free points as their drivers move them (slot_end - slot_begin values). */
void sbri_compute_driver_positions(
    const sbr_model *model, const sbri_body *body, const sbri_delta *deltas, sbri_point *positions);
/* Target positions of an island's pinned points, at their slots in `positions`. */
void sbri_compute_pin_targets(const sbri_island *island, const sbri_delta *deltas, sbri_point *positions);
/* Sets the drivers of the island at rest in the last tick; returns whether they were already. */
void sbri_drivers_stop(sbri_character *c, const sbri_island *island);
bool sbri_drivers_rest(const sbri_character *c, const sbri_island *island);

/* ---- state/pose/gait_input.c ---- */

/* Input of the gait. `around` receives the colliders near the body and must live as long as the input; NULL:
 * no colliders. */
sbri_gait_input sbri_gait_input_of(
    const sbr_world *world, const sbri_character *c, sbri_surroundings *around);
/* Root frame of the present state; `ground` is the ground of the gait's input. */
sbr_transform sbri_current_root_frame(const sbri_character *c, const sbr_ground *ground);

#endif
