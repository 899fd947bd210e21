/* Scenes by chance: springs or tetrahedra of any size, mass and stiffness, held or not, with all that may act
 * on them, stepped by any scheme in frames of any length, thrown about and put elsewhere. A seed means the
 * same scene, bit for bit, on every machine. */
#ifndef TEST_CHANCE_SCENE_H
#define TEST_CHANCE_SCENE_H

#include <stdint.h>

enum { CHANCE_FRAMES = 100 };

/* Steps the scene of that seed and fails, telling the seed, where a number is none. State hash of its end; 0
 * where the model could not be made, which a stiff one may not. */
uint64_t chance_scene_run(uint32_t seed);

#endif
