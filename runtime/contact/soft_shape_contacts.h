/* Soft bodies against the host's shapes: each place that may reach one within the tick gets a plane that
 * touches the shape there, moving with it, beside those of the ground (contact/contact.h). */
#ifndef SBRI_SOFT_SHAPE_CONTACTS_H
#define SBRI_SOFT_SHAPE_CONTACTS_H

#include "collide/colliders.h"
#include "contact/contact.h"

/* A body and a shape that it may reach within the tick. */
typedef struct sbri_shape_pair {
  const sbri_island_tick *tick;
  const sbri_body *body;
  const sbri_contact_tables *tables;
  sbri_collider_frame frame;
  uint32_t number; /* of the collider */
  sbri_box near;   /* of the collider's motion in the tick, in the body's space, enlarged by the same */
  sbri_box bounds; /* of the shape, enlarged by the contacts' possible displacements */
  float fastest_m; /* displacement of the body's fastest point in the tick, m, world */
} sbri_shape_pair;

/* Adds a touch of the sample with a place of the shape, in that one's frame, if there is room. */
void sbri_shape_contact_add(
    const sbri_shape_pair *shape_pair, const sbri_sample *sample, sbf_vec3 position, sbf_vec3 normal);

/* Adds to the body's touches; after those of the ground. */
void sbri_soft_shape_contacts_add(
    const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_tables *tables);

#endif
