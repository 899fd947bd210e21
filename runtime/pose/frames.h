/* From the pose to what hangs on it: how its frames have moved, where they carry points, what the gait is
 * told. */
#ifndef SBRI_FRAMES_H
#define SBRI_FRAMES_H

#include "world/world.h"

/* ---- pose/frames.c ---- */

/* The frames' motion since the rest pose: of a pose, squashed as at a `share` of the tick between the last
 * `settle` and now; or all of it at that share. What it fills takes sbri_deltas_size bytes. */
void sbri_deltas_make(const sbri_character *c, const sbr_transform *pose, float share, sbri_delta *deltas);
void sbri_deltas_between(const sbri_character *c, float share, sbri_delta *deltas);
/* One frame of it, not squashed. */
sbr_transform sbri_delta_of(const sbri_character *c, const sbr_transform *pose, uint32_t frame);

/* ---- pose/guides.c ---- */

/* Where guides put the free points of a body (slot_end - slot_begin of them). */
void sbri_guide_places(
    const sbr_model *model, const sbri_body *body, const sbri_delta *deltas, sbri_point *places);
/* Where frames put the held points of an island, at their slots in `places`. */
void sbri_held_places(const sbri_island *island, const sbri_delta *deltas, sbri_point *places);
/* As if what holds it had stood in the last tick; whether it did. */
void sbri_guides_stop(sbri_character *c, const sbri_island *island);
bool sbri_guides_rest(const sbri_character *c, const sbri_island *island);

/* ---- pose/gait_input.c ---- */

/* `around` receives what is around the body, and must live as long as the input; NULL: it sees no colliders.
 */
sbri_gait_input sbri_gait_input_of(
    const sbr_world *world, const sbri_character *c, sbri_surroundings *around);
/* The root frame of the present state; `ground` is that of the gait's input. */
sbr_transform sbri_root_place(const sbri_character *c, const sbr_ground *ground);

#endif
