/* Times the stages of a tick by the host's clock. */
#ifndef SBRI_STAGE_CLOCK_H
#define SBRI_STAGE_CLOCK_H

#include "state/world.h"

/* Call before the first stage of a tick. */
void sbri_stages_begin(sbr_world *world);
/* Ends the stage and begins the next one. */
void sbri_stage_end(sbr_world *world, sbr_stage stage);

#endif
