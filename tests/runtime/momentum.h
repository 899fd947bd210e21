/* What the bodies of a scene carry, soft and rigid. */
#ifndef TEST_MOMENTUM_H
#define TEST_MOMENTUM_H

#include "scenes.h"
#include "state/world.h"

/* kg m/s, kg m^2/s about the origin, and kg; places and speeds are those that each character keeps. */
typedef struct scene_momentum {
  double linear[3], angular[3], mass;
} scene_momentum;

scene_momentum scene_momentum_of(const scene *s);
/* m/s, of a free slot. */
sbf_vec3 scene_slot_velocity(const sbri_character *c, const sbri_island *island, uint32_t slot);

/* J: of rigid and soft bodies of the scene's character, kinetic, elastic and by weight. */
double scene_energy_of(const scene *s);

#endif
