/* Bodies of characters that meet each other: momentum, rest, and that nothing passes through. */
#include "check.h"
#include "collision_scenes.h"
#include "rigid_scenes.h"
