/* Small assets and worlds that the runtime's tests share. Everything made here is freed with scene_free. */
#ifndef TEST_SCENES_H
#define TEST_SCENES_H

#include "lattice_box.h"
#include "sbfmt/asset.h"
#include "sbrun/debug.h"

typedef struct scene {
  sbf_asset *asset;
  sbr_model *model;
  sbr_world *world;
  sbr_character_id character;
  sbr_model_options model_options;
  sbr_world_definition world_definition;
  sbr_character_definition character_definition;
} scene;

/* Definitions at their defaults, but nothing sleeps and the ground is a kilometre down; a new asset with room
 * for one soft body. */
scene scene_begin(void);
sbf_soft_body *scene_body(scene *s, uint32_t index);
void scene_bodies(scene *s, uint32_t count);
/* Model, world and character from the asset and the definitions. */
void scene_start(scene *s);
/* The same for bodies without pins on a slope of `angle` rad that falls along +x: gravity of
 * SCENE_GRAVITY_M_S2 is tilted instead of the ground. */
#define SCENE_GRAVITY_M_S2 9.81
void scene_start_on_slope(scene *s, double angle);
void scene_free(scene *s);

/* A level of bare points: positions, masses in kg and springs, without pins and damping. */
sbf_level *scene_points(
    scene *s, uint32_t body, const sbf_vec3 *positions, const float *masses, uint32_t count);
void scene_springs(scene *s, sbf_level *level, const sbf_uint2 *ends, const float *stiffness, uint32_t count);
/* Points 0 to `links` in a row, each `step` from the one before, with springs at their rest between them; the
 * last weighs `end_kg`. */
sbf_level *scene_chain(
    scene *s, uint32_t body, sbf_vec3 step, uint32_t links, float stiffness, float link_kg, float end_kg);
/* The corners of a cube of 1 m, of 1 to 2.75 kg, each on a spring of 200 N/m to each other one, whose rest
 * lengths are first_rest_m and each rest_step_m more than the last; it does not weigh. */
void scene_net_of_eight(scene *s, float first_rest_m, float rest_step_m);
/* Holds points by a bone, or by the world where `bone` is negative. Call once a level. */
void scene_pin(scene *s, sbf_level *level, int32_t bone, const uint32_t *points, uint32_t count);
/* One bone along +Z from `head`. */
void scene_bone(scene *s, sbf_vec3 head);

/* A closed box of `size` about `center` as a section of bone 0 (which scene_bone made): `cells` quads along
 * each edge, springs over and inside it by the thesis's method, stiffness as sbfmt/mechanics.h gives it. The
 * interior is pinned to the bone. */
void scene_section(scene *s, uint32_t body, sbf_vec3 center, sbf_vec3 size, uint32_t cells);
/* A render mesh over the section's surface, carried by it, without normals. */
void scene_skin(scene *s, uint32_t body);

/* A level of tetrahedra, the box's points, masses and modulus; Poisson's ratio is the body's. Points without
 * mass are pinned to the world. */
sbf_level *scene_lattice(scene *s, uint32_t body, const lattice_box *box);

/* A level of points on a grid of so many along each axis, `step` m apart from `low` on, that matches shapes:
 * a region around each point, of all within `reach` steps along each axis, of the angular frequency w. */
sbf_level *scene_regions(scene *s, uint32_t body, sbf_vec3 low, float step, const uint32_t counts[3],
    uint32_t reach, float w, float point_kg);

/* Carries the surface of the level's body by it: each vertex by the element of which it lies the least
 * outside. */
void scene_embed(scene *s, sbf_level *level, const lattice_box *box);

/* Models of the asset with memory that runs out at each call in turn: none leaves anything behind. */
void scene_models_survive_want(const scene *s);

/* Runs `ticks` control ticks; the world's state must be valid after each. */
void scene_ticks(scene *s, uint32_t ticks);
/* Places of the points of a body relative to the origin. */
uint32_t scene_read(const scene *s, uint32_t body, sbf_vec3 *positions, uint32_t capacity);
/* Mean x of a body's points in the world, m. */
double scene_middle_x(const scene *s, uint32_t body);
sbf_vec3 scene_point(const scene *s, uint32_t body, uint32_t point);

#endif
