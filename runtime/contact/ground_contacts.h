/* Ground contacts of soft bodies within a tick. */
#ifndef SBRI_GROUND_CONTACTS_H
#define SBRI_GROUND_CONTACTS_H

#include "contact/contact.h"

/* For a body whose points are its contact points: fills tables->planes and tables->near_ground. */
void sbri_ground_planes_find(
    const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_tables *tables);

/* For a body with samples: starts its contact list with those that may reach the ground. */
void sbri_ground_contacts_add(
    const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_tables *tables);

#endif
