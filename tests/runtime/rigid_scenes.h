/* Scenes of rigid bodies and joints, for the tests of rigid/. */
#ifndef TEST_RIGID_SCENES_H
#define TEST_RIGID_SCENES_H

#include "sbrun/rigid.h"
#include "scenes.h"

enum { RIGID_MAX = 64 };

/* As scene_begin, without soft bodies; the character stands at the height 0, far above the ground, and its
 * anchor frame is the world's. Add bodies and joints, then scene_start. */
scene rigid_begin(void);

/* A dynamic box of that size and mass about `center`; returns its number. */
uint32_t rigid_box(scene *s, sbf_vec3 center, sbf_vec3 size, float mass);
sbf_rigid_body *rigid_body(scene *s, uint32_t number);
/* A joint whose frames meet at `position` (asset space), their axes turned by `axes`; `a` -1: the world. */
sbf_joint *rigid_joint(
    scene *s, sbf_joint_kind kind, int32_t a, uint32_t b, sbf_vec3 position, sbf_quat axes);
void rigid_limit(scene *s, sbf_joint *joint, sbf_limit limit);
void rigid_drive(scene *s, sbf_joint *joint, sbf_drive drive);

/* The level's points that the body holds; sets are numbered as they are added. */
void rigid_pin(
    scene *s, sbf_level *level, uint32_t set_number, int32_t body, const uint32_t *points, uint32_t count);
/* N s, at that place from the body's centre. */
void rigid_push(const scene *s, uint32_t body, sbf_vec3 offset, sbf_vec3 impulse);

sbr_rigid_state rigid_state(const scene *s, uint32_t body);
sbr_joint_state rigid_joint_state(const scene *s, uint32_t joint);
/* Of all bodies, J. */
double rigid_energy(const scene *s, uint32_t body_count);

/* +X of a frame along the world's +X, +Y or +Z. */
extern const sbf_quat rigid_along_x, rigid_along_y, rigid_along_z;

#endif
