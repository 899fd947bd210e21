/* The narrow phase: contacts of two bodies within a tick. */
#ifndef SBRI_NARROW_PHASE_H
#define SBRI_NARROW_PHASE_H

#include "coupling/body_contact/body_contacts.h"
#include "math/quat.h"
#include "shapes/surface_query.h"

/* Contacts within a character keep at most this fraction of their rest distance. */
#define SBRI_REST_DISTANCE_FACTOR 0.9f
/* Parts nearer at rest than this fraction of the body's size do not collide. */
#define SBRI_REST_CONTACT_FRACTION 1e-3f

typedef struct sbri_narrow_phase {
  sbr_world *world;
  sbri_contact_group *group;
  const sbri_group_member *members;
} sbri_narrow_phase;

/* One body of a pair. */
typedef struct sbri_pair_body {
  const sbri_contact_body *body;
  uint32_t member; /* index in the group */
  const sbri_group_member *owner;
  const sbri_body *soft;
  sbri_contact_surface *surface; /* rigid body: surface of its hull, updated when needed */
  const sbri_rigid_body *rigid;
  float friction, restitution;
} sbri_pair_body;

static inline bool sbri_are_same_character(const sbri_pair_body *a, const sbri_pair_body *b) {
  return a->member == b->member;
}

static inline sbri_contact_side sbri_rigid_contact_side(const sbri_pair_body *p, sbf_vec3 local) {
  return (sbri_contact_side){.member = p->member, .rigid_body = (int32_t)p->body->body_index, .point = local};
}

/* A point in a frame, in units of a character with that scale. */
static inline sbf_vec3 sbri_to_local(const sbr_transform *frame, sbf_vec3 x, float scale) {
  sbf_vec3 offset = sbri_scale(sbri_sub(x, frame->position), 1 / scale);
  return sbri_rotate(sbri_quat_conjugate(frame->rotation), offset);
}

/* ---- pair_body.c ---- */

/* Adds a contact, if there is capacity. `contact` needs sides, normal, margin and feature; the rest is filled
 * in. */
void sbri_narrow_phase_add(const sbri_narrow_phase *f, const sbri_pair_body *a, const sbri_pair_body *b,
    const sbri_contact *contact);

sbri_contact_side sbri_soft_contact_side(
    const sbri_pair_body *p, const uint32_t *vertices, const float *weights, int count);
/* Frame of a rigid body at the begin or, if nothing acts, the end of the tick; relative to the group. */
sbr_transform sbri_pair_body_frame(const sbri_pair_body *p, bool end);
/* Swept bounds of a rigid body's hull in the tick; relative to the group. */
sbri_box sbri_pair_body_hull_box(const sbri_pair_body *p);
/* Weighted mean of vertices of its surface or hull, at their current positions. */
sbri_contact_side sbri_pair_body_side(
    const sbri_pair_body *p, const uint32_t *vertices, const float *weights, int count);
/* Distance from x to a found point of its surface, m. */
float sbri_pair_body_distance(const sbri_pair_body *p, const sbri_surface_hit *found, sbf_vec3 x);
float sbri_pair_body_size(const sbri_pair_body *p);
/* Thickness of its surface, m. */
float sbri_pair_body_thickness(const sbri_pair_body *p);
/* Rest position of a vertex, at the character's scale. */
sbf_vec3 sbri_pair_body_rest_position(const sbri_pair_body *p, uint32_t vertex);
/* Separation to keep between two bodies, m: 0 between surfaces that both enclose a volume. */
float sbri_pair_margin(const sbri_pair_body *a, const sbri_pair_body *b);
/* Distance within which contacts of `b` are searched, m. */
float sbri_pair_search_distance(float margin, const sbri_pair_body *b);

/* ---- edge_contacts.c ---- */

/* Contacts between boundary edges and folds of sheets. */
void sbri_find_edge_contacts(const sbri_narrow_phase *f, const sbri_pair_body *a, const sbri_pair_body *b);
/* Contacts between ridges of two closed bodies, a soft. `first`: index of the pair's first contact. */
void sbri_find_ridge_contacts(
    const sbri_narrow_phase *f, const sbri_pair_body *a, const sbri_pair_body *b, uint32_t first);

/* ---- nearest_exit.c ---- */

/* Whether x is inside of the closed surface of b, at any depth; `best`: nearest point of the surface. */
bool sbri_find_nearest_exit(const sbri_pair_body *b, sbf_vec3 x, sbri_surface_hit *best);

/* Whether x is inside of a closed surface. */
bool sbri_surface_contains(const sbri_contact_surface *s, sbf_vec3 x);

/* Orthonormal frame of a ray. */
typedef struct sbri_ray_frame {
  sbf_vec3 x, direction, z;
} sbri_ray_frame;
sbri_ray_frame sbri_ray_frame_make(sbf_vec3 direction);
/* Distance along the ray from x to where it leaves the surface, m; INFINITY: not below `max_distance`. */
float sbri_find_exit_along(const sbri_contact_surface *s, const sbri_ray_frame *frame, sbf_vec3 x,
    float max_distance, sbri_surface_hit *best);

/* ---- common_exit.c ---- */

/* Gives parts of two closed bodies that lie crosswise through each other a common exit. a: soft. `first`:
 * index of the pair's first contact. */
void sbri_resolve_crossings(
    const sbri_narrow_phase *f, const sbri_pair_body *a, const sbri_pair_body *b, uint32_t first);

/* ---- hull_contacts.c ---- */

/* Contacts between two hulls. */
void sbri_find_hull_contacts(const sbri_narrow_phase *f, const sbri_pair_body *a, const sbri_pair_body *b);

#endif
