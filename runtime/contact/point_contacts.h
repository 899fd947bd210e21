/* Limits the number of contacts of surface samples per point of the body. */
#ifndef SBRI_POINT_CONTACTS_H
#define SBRI_POINT_CONTACTS_H

#include "contact/contact.h"

/* Removes contacts of samples from the body's list until no point has more than SBRI_CONTACTS_PER_POINT of
 * them with similar normals and the same collider. Contacts of an impact all stay: soft bodies would dip in
 * between fewer of them. The order of those that stay does not change. */
void sbri_point_contacts_limit(
    const sbri_island_tick *tick, const sbri_body *body, const sbri_contact_tables *tables);

#endif
