/* Of what a query of the physics space finds: what its engine moves, and what is the character's own. */
#ifndef SBFMT_GODOT_PHYSICS_KINDS_H
#define SBFMT_GODOT_PHYSICS_KINDS_H

#include "variants.h"

/* Whether Godot's engine moves it by its mass; what is frozen it does not. `body`: its RID. */
bool body_is_rigid(const gd_variant *server, const gd_variant *body);
/* Whether nothing is to move it; it may be put elsewhere. */
bool body_is_static(const gd_variant *server, const gd_variant *body);
/* Whether it hangs in the tree below the node, as a hit box does, which it goes with. */
bool body_is_below(const gd_variant *node, const gd_variant *object);

#endif
