/* Self-contacts of a soft body. */
#ifndef SBRI_SELF_CONTACTS_H
#define SBRI_SELF_CONTACTS_H

#include "contact/contact.h"
#include "shapes/bounds_tree.h"

/* Adds to the body's contacts; `tree` has capacity for its self_face_count triangles. */
void sbri_self_contacts_add(const sbri_island_tick *tick, const sbri_body *body,
    const sbri_contact_tables *tables, sbri_bounds_tree *tree);

/* ---- self_follow.c ---- */

/* Updates the contact points and the normal to the present positions, before a substep. */
void sbri_self_contact_update(const sbri_island_tick *tick, sbri_soft_contact *contact);

#endif
