/* Contacts of soft bodies with host shapes. Each sample that may reach a shape within the tick gets a plane
 * that touches the shape there and moves with it, in addition to those of the ground (contact/contact.h). */
#ifndef SBRI_SOFT_SHAPE_CONTACTS_H
#define SBRI_SOFT_SHAPE_CONTACTS_H

#include "contact/contact.h"
#include "shapes/colliders.h"

/* A body and a shape that it may reach within the tick. */
typedef struct sbri_shape_pair {
  const sbri_island_tick *tick;
  const sbri_body *body;
  const sbri_contact_tables *tables;
  sbri_collider_frame frame;
  uint32_t number; /* index of the collider */
  sbri_box
      near; /* bounds of the collider's motion in the tick, in the body's space, enlarged in the same way */
  sbri_box bounds; /* of the shape, enlarged by the contacts' possible displacements */
  float fastest_m; /* displacement of the body's fastest point in the tick, m, world */
} sbri_shape_pair;

/* Adds a contact of the sample with a position on the shape, in the shape's frame, up to the capacity. */
void sbri_shape_contact_add(
    const sbri_shape_pair *shape_pair, const sbri_sample *sample, sbf_vec3 position, sbf_vec3 normal);

/* Adds to the body's contacts; call after those of the ground. */
void sbri_soft_shape_contacts_add(
    const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_tables *tables);

#endif
