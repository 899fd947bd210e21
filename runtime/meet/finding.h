/* What find.c and its siblings share: the places of two bodies that may touch within a tick. */
#ifndef SBRI_FINDING_H
#define SBRI_FINDING_H

#include "collide/surface_look.h"
#include "math/quat.h"
#include "meet/meetings.h"

/* Of the distance at rest, where that is less than the margin. */
#define SBRI_REST_SHARE 0.9f
/* Nearer than this share of a body's size at rest, two parts touch there always. */
#define SBRI_TOGETHER_SHARE 1e-3f

typedef struct sbri_finding {
  sbr_world *world;
  sbri_meet_group *group;
  const sbri_meet_member *members;
} sbri_finding;

/* One of the two that may meet. */
typedef struct sbri_party {
  const sbri_meeter *is;
  uint32_t member; /* of the group */
  const sbri_meet_member *of;
  const sbri_body *soft;
  sbri_meet_surface *surface; /* of a rigid one: its hull's, placed where it is needed */
  const sbri_rigid_body *rigid;
  float friction, restitution;
} sbri_party;

static inline bool sbri_are_of_one(const sbri_party *a, const sbri_party *b) {
  return a->member == b->member;
}

static inline sbri_meet_side sbri_rigid_side(const sbri_party *p, sbf_vec3 own) {
  return (sbri_meet_side){.member = p->member, .rigid_body = (int32_t)p->is->number, .at = own};
}

/* A place in that frame, of a body of that scale. */
static inline sbf_vec3 sbri_into_frame(const sbr_transform *frame, sbf_vec3 x, float scale) {
  sbf_vec3 off = sbri_scale(sbri_sub(x, frame->position), 1 / scale);
  return sbri_rotate(sbri_quat_conjugate(frame->rotation), off);
}

/* ---- finding.c ---- */

/* One more touch, if there is room; fills in all but places, normal, margin and feature. */
void sbri_finding_add(
    const sbri_finding *f, const sbri_party *a, const sbri_party *b, const sbri_meet_touch *touch);

sbri_meet_side sbri_soft_side(const sbri_party *p, const uint32_t *vertices, const float *weights, int count);
/* A rigid body's own frame at the tick's beginning or its end, if nothing acts, relative to the group. */
sbr_transform sbri_party_frame(const sbri_party *p, bool end);
/* A place between vertices of its surface or hull, as these are placed. */
sbri_meet_side sbri_party_side(
    const sbri_party *p, const uint32_t *vertices, const float *weights, int count);
/* m from x to a place that was found on it. */
float sbri_party_distance(const sbri_party *p, const sbri_surface_finding *found, sbf_vec3 x);
float sbri_party_size(const sbri_party *p);
/* Of its surface, at the character's scale; m. */
float sbri_party_thickness(const sbri_party *p);
/* Where a vertex is at rest, at the character's scale. */
sbf_vec3 sbri_party_rest(const sbri_party *p, uint32_t vertex);
/* What is kept between them: nothing between surfaces that both enclose matter. */
float sbri_party_margin(const sbri_party *a, const sbri_party *b);
/* How far off what lies at the margin of `b` is looked for. */
float sbri_party_beyond(float margin, const sbri_party *b);

/* ---- find_rims.c ---- */

/* Rims of sheets with rims. */
void sbri_meet_rims(const sbri_finding *f, const sbri_party *a, const sbri_party *b);
/* Ridges of a soft body with those of another body, both closed, whose touches so far are those of the group
 * from `first` on. */
void sbri_meet_ridges(const sbri_finding *f, const sbri_party *a, const sbri_party *b, uint32_t first);

/* ---- find_deep.c ---- */

/* Whether x lies inside of b, whose surface is closed, however deep; and then the nearest place of it. */
bool sbri_meet_way_out(const sbri_party *b, sbf_vec3 x, sbri_surface_finding *best);

/* Whether x lies inside of a closed surface. */
bool sbri_meet_is_inside(const sbri_meet_surface *s, sbf_vec3 x);

/* A direction, and two across it. */
typedef struct sbri_meet_way {
  sbf_vec3 across, along, beside;
} sbri_meet_way;
sbri_meet_way sbri_meet_way_along(sbf_vec3 along);
/* m from x along the way to where it leaves the surface, less than `most`, with that place; or INFINITY. */
float sbri_meet_way_along_out(
    const sbri_meet_surface *s, const sbri_meet_way *way, sbf_vec3 x, float most, sbri_surface_finding *best);

/* ---- find_through.c ---- */

/* Gives what of a soft body and another body, both closed, lies crosswise through the other, of the group's
 * touches from `first` on, a common way out. */
void sbri_meet_through(const sbri_finding *f, const sbri_party *a, const sbri_party *b, uint32_t first);

/* ---- find_hulls.c ---- */

/* Hulls with hulls. */
void sbri_meet_hulls(const sbri_finding *f, const sbri_party *a, const sbri_party *b);

#endif
