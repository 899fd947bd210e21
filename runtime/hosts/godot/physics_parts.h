/* Parts of a character in the physics space: one kinematic body with a shape for each bone or section, so
 * that areas, rays, queries and other bodies meet the character. */
#ifndef SBFMT_GODOT_PHYSICS_PARTS_H
#define SBFMT_GODOT_PHYSICS_PARTS_H

#include "soft_character.h"

/* NULL if memory runs out, the character is on no layer or has no part. Not yet in a space. */
physics_parts *physics_parts_make(const soft_character *one);
void physics_parts_free(physics_parts *parts);
/* Moves the parts to the character's present pose; enters the space of its node. */
void physics_parts_move(physics_parts *parts, const soft_character *one);
/* Applies layers and picking of the settings. */
void physics_parts_apply_settings(physics_parts *parts, const soft_character *one);
/* Godot's own contact solver passes over this body: the runtime moves it. */
void physics_parts_except(physics_parts *parts, const gd_variant *body, bool excepted);

/* What a shape of the body belongs to; each -1: none. */
typedef struct part_owner {
  int32_t bone, soft_body;
} part_owner;
part_owner physics_parts_owner(const physics_parts *parts, int64_t shape);
/* RID of the body; a RID that is none without one. */
gd_variant physics_parts_rid(const physics_parts *parts);

#endif
