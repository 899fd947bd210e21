/* Colliders of a world in a tick: begin and end position, and a bounding volume tree over the swept boxes. */
#ifndef SBRI_COLLIDERS_H
#define SBRI_COLLIDERS_H

#include "math/quat.h"
#include "shapes/host_body.h"
#include "shapes/shape.h"

typedef struct sbri_collider {
  const sbr_shape *shape; /* NULL: free entry */
  uint32_t generation;
  sbr_double3 from, to,
      next; /* positions at the beginning and end of the present tick, and at the end of the next, m, world */
  sbf_quat rotation_from, rotation_to, rotation_next;
  float friction, restitution; /* negative: use the other body's value */
  uint32_t layer, mask;
  double impulse[3], moment[3]; /* impulse and angular impulse received, about `to`; output, not state */
  void *user_data;              /* the host's */
  uint32_t leader;              /* index of the collider that leads its body; its own index if it leads */
  sbri_host_body body;          /* only the leader's */
} sbri_collider;

typedef struct sbri_collider_set {
  sbri_collider *at; /* (capacity) */
  sbri_box *bounds;  /* (capacity) swept boxes of `listed` */
  uint32_t *listed;  /* (capacity) used entries: items of the tree */
  sbri_bounds_tree tree;
  uint32_t capacity;
  uint32_t end;     /* end of the used entries */
  bool has_changed; /* some collider was created, moved or destroyed since the last tick */
  bool is_moving;   /* some collider moves, appears or disappears in this tick */
} sbri_collider_set;

/* Moves colliders to their targets and rebuilds the tree. Sleeping bodies check for contacts if any collider
 * moves. */
void sbri_colliders_begin_tick(sbri_collider_set *set, double tick_s);

/* Collider that has the body's mass; NULL: immovable. */
static inline sbri_collider *sbri_collider_leader(const sbri_collider_set *set, uint32_t number) {
  sbri_collider *leader = &set->at[set->at[number].leader];
  return leader->shape && leader->body.inverse_mass > 0 ? leader : NULL;
}

/* Centre of mass of a leader's body at the beginning of the tick, world, m. */
static inline sbr_double3 sbri_collider_centre(const sbri_collider *leader) {
  sbf_vec3 arm = sbri_rotate(leader->rotation_from, leader->body.centre);
  const sbr_double3 *at = &leader->from;
  return (sbr_double3){at->x + (double)arm.x, at->y + (double)arm.y, at->z + (double)arm.z};
}

/* Part of a velocity change that external constraints of the host's body allow. */
static inline sbf_vec3 sbri_host_body_free(const sbri_host_body *body, sbf_vec3 change) {
  return sbri_add_scaled(change, body->blocked_normal, -sbri_dot(body->blocked_normal, change));
}

/* Swept bounding box in the tick, world metres. */
sbri_box sbri_collider_bounds(const sbri_collider *collider);

/* A collider in a space with its origin at `origin` and lengths in units of `scale` metres. */
typedef struct sbri_collider_frame {
  const sbri_collider *collider;
  sbf_vec3 from, to; /* of the shape's origin, m from `origin` */
  float scale;
} sbri_collider_frame;
sbri_collider_frame sbri_collider_frame_of(const sbri_collider *collider, sbr_double3 origin, float scale);

/* Transforms a point from that space to the shape's frame at the beginning and at the end of the tick,
 * metres. */
static inline sbf_vec3 sbri_into_shape(const sbri_collider_frame *f, sbf_vec3 x, bool end) {
  sbf_vec3 off = sbri_sub(sbri_scale(x, f->scale), end ? f->to : f->from);
  return sbri_rotate(sbri_quat_conjugate(end ? f->collider->rotation_to : f->collider->rotation_from), off);
}
/* Inverse transform, at the beginning of the tick. */
static inline sbf_vec3 sbri_out_of_shape(const sbri_collider_frame *f, sbf_vec3 x) {
  sbf_vec3 off = sbri_add(sbri_rotate(f->collider->rotation_from, x), f->from);
  return sbri_scale(off, 1 / f->scale);
}
/* Displacement of a point of the shape in the tick, in the space's units. */
static inline sbf_vec3 sbri_shape_displacement(const sbri_collider_frame *f, sbf_vec3 x) {
  const sbri_collider *c = f->collider;
  sbf_vec3 a = sbri_add(sbri_rotate(c->rotation_from, x), f->from),
           b = sbri_add(sbri_rotate(c->rotation_to, x), f->to);
  return sbri_scale(sbri_sub(b, a), 1 / f->scale);
}

/* Friction coefficient of a contact, from the body's and the collider's. */
static inline float sbri_friction_with(const sbri_collider *c, float own) {
  return c->friction < 0 ? own : sqrtf(c->friction * own);
}
static inline float sbri_restitution_with(const sbri_collider *c, float own) {
  return c->restitution > own ? c->restitution : own;
}
static inline bool sbri_layers_collide(uint32_t layer_a, uint32_t mask_a, uint32_t layer_b, uint32_t mask_b) {
  return (layer_a & mask_b) != 0 && (layer_b & mask_a) != 0;
}

/* World box, slightly enlarged, of a box in such a space. */
sbri_box sbri_box_in_world(sbri_box box, sbr_double3 origin, float scale);

#endif
