/* Rotations between the runtime, which has quaternions, and Godot, whose values here are rows of a matrix. */
#ifndef SBFMT_GODOT_TURNS_H
#define SBFMT_GODOT_TURNS_H

#include "variants.h"

/* First b, then a. */
sbf_quat turn_product(sbf_quat a, sbf_quat b);
sbf_quat turn_back(sbf_quat q);
sbf_vec3 turned(sbf_quat q, sbf_vec3 v);
sbf_vec3 turn_cross(sbf_vec3 a, sbf_vec3 b);
/* From a matrix whose columns are orthonormal. */
sbf_quat turn_of(float rows[3][3]);
/* Applies a transform to a vector, and to a point. */
sbf_vec3 placed_vector(const gd_transform *transform, sbf_vec3 v);
gd_transform placed_in(const gd_transform *outer, const gd_transform *inner);
gd_transform placed_at(sbf_quat rotation, sbf_vec3 origin);
/* Takes the scale off the columns of the basis; false if one of them is zero. */
bool transform_unscale(gd_transform *transform);
/* Upright: rotated about +Y only (rad), with that scale. */
gd_transform upright(sbf_vec3 origin, float heading, float scale);

#endif
