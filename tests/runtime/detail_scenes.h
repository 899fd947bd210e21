/* A box that a bone holds at its side, on several detail levels: two lattices, jiggle, bones, away. */
#ifndef TEST_DETAIL_SCENES_H
#define TEST_DETAIL_SCENES_H

#include "sbrun/detail.h"
#include "scenes.h"

/* Detail levels of the scene's model. */
enum { DETAIL_FINE, DETAIL_COARSE, DETAIL_JIGGLE, DETAIL_BONES, DETAIL_OFFSCREEN, LEVELS_OF_DETAIL };

/* The asset and the options, before scene_start; of a loose body held by nothing, whose detail levels are the
 * first two. */
scene detail_scene_begin(bool loose);
/* Started, driven at 0.5 m/s and turning, on that detail level, for a second and a half. */
scene detail_scene_walking(uint32_t detail_level);

enum { RUNG_VERTICES = 512 };
/* The skin in world space; returns how many vertices. */
uint32_t detail_scene_skin(const scene *s, sbf_vec3 *positions);
/* The farthest that two are apart, m. */
double detail_scene_farthest(const sbf_vec3 *a, const sbf_vec3 *b, uint32_t count);
/* The same for the skins of two scenes with equal beginnings, after so many ticks of both. */
double detail_scene_apart(const scene *a, const scene *b);
void detail_scene_ticks(scene *a, scene *b, int ticks);
/* J of the body: elastic, kinetic. */
double detail_scene_elastic(const scene *s);
double detail_scene_kinetic(const scene *s);

#endif
