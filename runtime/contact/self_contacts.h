/* A soft body against itself. */
#ifndef SBRI_SELF_CONTACTS_H
#define SBRI_SELF_CONTACTS_H

#include "collide/bounds_tree.h"
#include "contact/contact.h"

/* Adds to the body's touches; `tree` has room for its self_face_count triangles. */
void sbri_self_contacts_add(const sbri_island_tick *tick, const sbri_body *body,
    const sbri_contact_tables *tables, sbri_bounds_tree *tree);

/* ---- self_follow.c ---- */

/* Where the two touch, and along which normal, as they are now: before a substep. */
void sbri_self_contact_update(const sbri_island_tick *tick, sbri_soft_contact *contact);

#endif
