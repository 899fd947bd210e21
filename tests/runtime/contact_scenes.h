/* Scenes whose bodies meet each other: boxes that are thrown, other characters. */
#ifndef TEST_CONTACT_SCENES_H
#define TEST_CONTACT_SCENES_H

#include "rigid_scenes.h"

/* As rigid_begin, with that gravity, m/s^2. Add bodies, then contact_scene_start: as scene_start, and they
 * meet. */
scene contact_scene_begin(sbf_vec3 gravity);
void contact_scene_start(scene *s);

/* A push at the middle of a rigid body, N s. */
void contact_scene_throw(scene *s, sbr_character_id who, uint32_t body, sbf_vec3 impulse);
/* One more of the scene's character. */
sbr_character_id contact_scene_another(scene *s, sbr_double3 position);

/* Gives a body that lattice, which it frees, and a skin that it carries; damping and friction 0.5. */
void contact_scene_soft_box(scene *s, uint32_t body, lattice_box *box, const sbf_polygon_mesh *skin);
/* Makes a rigid body's hull a ball: rings of points about the y axis between two poles. */
void contact_scene_ball(scene *s, uint32_t body, float radius);
/* How deep the deepest point of the first soft body is in its first rigid one, m. */
double contact_scene_deepest(const scene *s);
/* m/s of the fastest point of its soft bodies. */
double contact_scene_fastest(const scene *s, sbr_character_id who);

#endif
