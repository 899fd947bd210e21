/* The contacts of a world that have begun and not ended. */
#ifndef SBFMT_GODOT_CONTACT_LIST_H
#define SBFMT_GODOT_CONTACT_LIST_H

#include "sbrun/events.h"

enum { CONTACT_CAPACITY = 256 /* later ones are not listed */ };

typedef struct contact_list {
  sbr_contact_event each[CONTACT_CAPACITY]; /* the last report of each */
  uint32_t count;
} contact_list;

/* After a step of the world. */
void contact_list_update(contact_list *list, const sbr_world *world);

#endif
