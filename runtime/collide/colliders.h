/* The host's shapes in a world, as they are in a tick: where each begins and ends it, and a tree over the
 * ways between. */
#ifndef SBRI_COLLIDERS_H
#define SBRI_COLLIDERS_H

#include "collide/host_body.h"
#include "collide/shape.h"
#include "math/quat.h"

typedef struct sbri_collider {
  const sbr_shape *shape; /* NULL: the place is free */
  uint32_t generation;
  sbr_double3 from, to, next; /* m, world: over the present tick, and where it shall be after the next */
  sbf_quat turn_from, turn_to, turn_next;
  float friction, restitution; /* negative: of what touches it */
  uint32_t layer, mask;
  double impulse[3], moment[3]; /* N s and N m s about `to`, that it was pushed with; output, not state */
  uint32_t leader;              /* number of the collider whose body it is of; its own */
  sbri_host_body body;          /* of the leader's */
} sbri_collider;

typedef struct sbri_collider_set {
  sbri_collider *at; /* (capacity) */
  sbri_box *bounds;  /* (capacity) of the ways, of `listed` */
  uint32_t *listed;  /* (capacity) those that are there: items of the tree */
  sbri_bounds_tree tree;
  uint32_t capacity;
  uint32_t end; /* none is at this place or behind it */
  bool stirred; /* some was made, moved or taken away since the last tick */
  bool moving;  /* in this tick some is on its way, or has just come or gone */
} sbri_collider_set;

/* All go where they were to go; the tree over the ways. Who sleeps looks around when some moves. */
void sbri_colliders_begin_tick(sbri_collider_set *set, double tick_s);

/* The collider whose mass counts; NULL: nothing moves it. */
static inline sbri_collider *sbri_collider_leader(const sbri_collider_set *set, uint32_t number) {
  sbri_collider *leader = &set->at[set->at[number].leader];
  return leader->shape && leader->body.ease > 0 ? leader : NULL;
}

/* Where the centre of mass of a leader's body is at the tick's beginning, m of the world. */
static inline sbr_double3 sbri_collider_centre(const sbri_collider *leader) {
  sbf_vec3 arm = sbri_rotate(leader->turn_from, leader->body.centre);
  const sbr_double3 *at = &leader->from;
  return (sbr_double3){at->x + (double)arm.x, at->y + (double)arm.y, at->z + (double)arm.z};
}

/* The part of a change of its velocity that what holds it from elsewhere lets be. */
static inline sbf_vec3 sbri_host_body_free(const sbri_host_body *body, sbf_vec3 change) {
  return sbri_add_scaled(change, body->held_along, -sbri_dot(body->held_along, change));
}

/* Bounds of its way in the tick, world metres. */
sbri_box sbri_collider_bounds(const sbri_collider *collider);

/* A collider in a space that has its origin at `origin` and lengths of `scale` metres. */
typedef struct sbri_collider_frame {
  const sbri_collider *collider;
  sbf_vec3 from, to; /* of the shape's origin, m from `origin` */
  float scale;
} sbri_collider_frame;
sbri_collider_frame sbri_collider_frame_of(const sbri_collider *collider, sbr_double3 origin, float scale);

/* From that space into the shape's frame, at the tick's beginning and its end; in metres. */
static inline sbf_vec3 sbri_into_shape(const sbri_collider_frame *f, sbf_vec3 x, bool end) {
  sbf_vec3 off = sbri_sub(sbri_scale(x, f->scale), end ? f->to : f->from);
  return sbri_rotate(sbri_quat_conjugate(end ? f->collider->turn_to : f->collider->turn_from), off);
}
/* And back, as at the beginning. */
static inline sbf_vec3 sbri_out_of_shape(const sbri_collider_frame *f, sbf_vec3 x) {
  sbf_vec3 off = sbri_add(sbri_rotate(f->collider->turn_from, x), f->from);
  return sbri_scale(off, 1 / f->scale);
}
/* How far that place of the shape goes in the tick, in the space's lengths. */
static inline sbf_vec3 sbri_shape_way(const sbri_collider_frame *f, sbf_vec3 x) {
  const sbri_collider *c = f->collider;
  sbf_vec3 a = sbri_add(sbri_rotate(c->turn_from, x), f->from),
           b = sbri_add(sbri_rotate(c->turn_to, x), f->to);
  return sbri_scale(sbri_sub(b, a), 1 / f->scale);
}

/* Of what touches, and the collider's own. */
static inline float sbri_friction_with(const sbri_collider *c, float own) {
  return c->friction < 0 ? own : sqrtf(c->friction * own);
}
static inline float sbri_restitution_with(const sbri_collider *c, float own) {
  return c->restitution > own ? c->restitution : own;
}
static inline bool sbri_layers_meet(uint32_t layer_a, uint32_t mask_a, uint32_t layer_b, uint32_t mask_b) {
  return (layer_a & mask_b) != 0 && (layer_b & mask_a) != 0;
}

/* Box in world metres of one in such a space, a little larger than it needs to be. */
sbri_box sbri_box_in_world(sbri_box box, sbr_double3 origin, float scale);

#endif
