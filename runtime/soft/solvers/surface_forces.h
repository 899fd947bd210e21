/* Shapes and gradients of surface forces: hinges between triangles, and the volume within faces. */
#ifndef SBRI_SURFACE_FORCES_H
#define SBRI_SURFACE_FORCES_H

#include "math/trig.h"
#include "math/vec3.h"
#include "model/runtime_model.h"

/* Triangles (0, 1, 2) and (1, 0, 3) on both sides of the edge from 0 to 1. */
typedef struct sbri_hinge_shape {
  sbf_vec3 normals[2]; /* twice the vector areas */
  float length;        /* of the edge */
  float angle;         /* angle between the normals, rad; positive for a convex fold, seen from outside */
} sbri_hinge_shape;

static inline sbri_hinge_shape sbri_hinge_shape_of(const sbf_vec3 x[4]) {
  sbf_vec3 side = sbri_sub(x[1], x[0]);
  sbri_hinge_shape shape = {
      {sbri_cross(side, sbri_sub(x[2], x[0])), sbri_cross(sbri_sub(x[3], x[0]), side)}, sbri_length(side), 0};
  float across = sbri_dot(sbri_cross(shape.normals[0], shape.normals[1]), side);
  shape.angle =
      sbri_atan2(shape.length > 0 ? across / shape.length : 0, sbri_dot(shape.normals[0], shape.normals[1]));
  return shape;
}

/* Gradients of the angle at the four points; zeros where a triangle has no area. */
static inline void sbri_compute_hinge_gradients(
    const sbri_hinge_shape *shape, const sbf_vec3 x[4], sbf_vec3 gradients[4]) {
  float a = sbri_dot(shape->normals[0], shape->normals[0]),
        b = sbri_dot(shape->normals[1], shape->normals[1]);
  for (int k = 0; k < 4; k++) gradients[k] = sbri_vec3(0, 0, 0);
  if (!(a > 0) || !(b > 0) || !(shape->length > 0)) return;
  sbf_vec3 side = sbri_sub(x[1], x[0]);
  float square = shape->length * shape->length;
  float s = sbri_dot(sbri_sub(x[2], x[0]), side) / square, t = sbri_dot(sbri_sub(x[3], x[0]), side) / square;
  gradients[2] = sbri_scale(shape->normals[0], -shape->length / a);
  gradients[3] = sbri_scale(shape->normals[1], -shape->length / b);
  gradients[0] = sbri_sub(sbri_scale(gradients[2], s - 1), sbri_scale(gradients[3], 1 - t));
  gradients[1] = sbri_sub(sbri_scale(gradients[2], -s), sbri_scale(gradients[3], t));
}

/* A face as a fan of triangles about the mean of its corners. */
typedef struct sbri_face_shape {
  sbf_vec3 mean, area;   /* of the corners; vector area */
  sbf_vec3 gradients[4]; /* of this face's contribution to the volume, at its corners */
} sbri_face_shape;

static inline sbri_face_shape sbri_face_shape_of(const sbf_vec3 c[4]) {
  sbri_face_shape f;
  sbf_vec3 a = sbri_sub(c[2], c[0]), b = sbri_sub(c[3], c[1]), twice = sbri_cross(a, b);
  sbf_vec3 even = sbri_scale(sbri_add(c[0], c[2]), 0.5f), odd = sbri_scale(sbri_add(c[1], c[3]), 0.5f);
  sbf_vec3 separation = sbri_sub(even, odd), evened = sbri_scale(twice, 0.125f);
  sbf_vec3 p = sbri_scale(sbri_cross(separation, b), 1.0f / 12),
           q = sbri_scale(sbri_cross(separation, a), 1.0f / 12);
  f.mean = sbri_scale(sbri_add(even, odd), 0.5f);
  f.area = sbri_scale(twice, 0.5f);
  f.gradients[0] = sbri_sub(evened, p);
  f.gradients[2] = sbri_add(evened, p);
  f.gradients[1] = sbri_sub(evened, q);
  f.gradients[3] = sbri_add(evened, q);
  return f;
}

/* Six times a face's contribution to the volume about `from`. */
static inline double sbri_face_volume(const sbri_face_shape *f, sbf_vec3 from) {
  return 2 * (double)sbri_dot(sbri_sub(f->mean, from), f->area);
}

/* Volume within the body's surface at rest. */
double sbri_surface_rest_volume(const sbri_body *body);

#endif
