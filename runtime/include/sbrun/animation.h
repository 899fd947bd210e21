/* The animation layer beyond driving: targets for limbs, and what a pose is judged by.
 *
 * The same rules as in sbrun.h: handles that name nothing are ignored, getters then return zeros; nothing
 * allocates; everything set here is state, which snapshots hold. */
#ifndef SBRUN_ANIMATION_H
#define SBRUN_ANIMATION_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Judging a pose ----------------------------------------------------------------------------------- */

/* By how much the worst bone breaks its joint's limits, rad, as of the last tick; 0: none does. */
SBF_API float sbr_character_limit_excess(const sbr_world *world, sbr_character_id character);
/* The centre of mass as of the last tick, relative to the origin: bones weigh as much as the soft bodies on
 * them, or as the skin that follows them. False where nothing hangs on the bones. */
SBF_API bool sbr_character_center(const sbr_world *world, sbr_character_id character, sbf_vec3 *center);

#ifdef __cplusplus
}
#endif
#endif
