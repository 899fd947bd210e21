/* The state of a scene's first character, whose first island has slots from 0 on. */
#ifndef TEST_SCENE_STATE_H
#define TEST_SCENE_STATE_H

#include "scenes.h"
#include "state/world.h"

/* x of a slot's velocity, m/s; y and z are SBRI_BLOCK and 2 x SBRI_BLOCK further on. */
float *scene_velocity(const scene *s, uint32_t slot);

/* Starts that no motion leads to, for a body that begins in [0, 1] x [0, 0.2] x [0, 0.2] or so. */
typedef enum bad_start { START_FLAT, START_MIRRORED, START_HEAP, START_ONE_PLACE } bad_start;
void scene_spoil(const scene *s, bad_start how);
/* Within a second it is finite at every tick, and then sound and strained by less than a tenth. */
void scene_comes_back(const scene *s);

#endif
