/* Classification of bodies in the physics space: dynamic, static, or part of the character. */
#ifndef SBFMT_GODOT_PHYSICS_KINDS_H
#define SBFMT_GODOT_PHYSICS_KINDS_H

#include "variants.h"

/* Whether Godot's engine moves it as a rigid body and it is not frozen. `body`: its RID. */
bool body_is_rigid(const gd_variant *server, const gd_variant *body);
/* Whether it is static; it may still be placed elsewhere. */
bool body_is_static(const gd_variant *server, const gd_variant *body);
/* Whether a character passes through a body of that object: it is below the character's node in the tree, as
 * a hit box is; or it is a CharacterBody3D above it, which carries the character; or it is itself a
 * character. */
bool body_is_passed(const gd_variant *node, const gd_variant *object);

#endif
