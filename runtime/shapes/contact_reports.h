/* Objects in contact with a body, for events: a limited number, each reported when contact begins. Output,
 * not state: the simulation does not read it. */
#ifndef SBRI_CONTACT_REPORTS_H
#define SBRI_CONTACT_REPORTS_H

#include "math/vec3.h"

/* Capacity; external bodies beyond it receive no impulse. */
enum { SBRI_MAX_CONTACT_REPORTS = 12 };

typedef struct sbri_contact_report {
  uint32_t collider; /* index of the collider; UINT32_MAX: the ground */
  bool is_new;       /* not in contact in the previous tick */
  sbf_vec3 position, normal;
  float speed;                          /* maximum closing speed in the tick, m/s */
  float impulse;                        /* sum over contact points of the maximum impulse of a substep, N s */
  sbf_vec3 total_impulse, total_moment; /* impulse and angular impulse about `position` that the body received
                            in the tick, N s and N m s */
} sbri_contact_report;

typedef struct sbri_contact_reports {
  sbri_contact_report now[SBRI_MAX_CONTACT_REPORTS], before[SBRI_MAX_CONTACT_REPORTS];
  uint32_t count, before_count;
  /* The fastest of the body's points that reach the ground in this tick by their velocity and gravity, for
   * bodies whose points have planes (contact/contact.h): closing speed in m/s, 0 for none. */
  float ground_speed;
  sbf_vec3 ground_position, ground_normal;
  bool is_current;     /* the impulses are of this tick */
  bool has_unreported; /* events have not been created yet */
} sbri_contact_reports;

static inline void sbri_contact_reports_begin(sbri_contact_reports *t) {
  for (uint32_t i = 0; i < t->count; i++) t->before[i] = t->now[i];
  t->before_count = t->count;
  t->count = 0;
  t->is_current = t->has_unreported = true;
}

static inline bool sbri_contact_reports_has(
    const sbri_contact_report *list, uint32_t count, uint32_t collider) {
  bool has = false;
  for (uint32_t i = 0; i < count; i++) has = has || list[i].collider == collider;
  return has;
}

/* Returns the entry of the object, a new one if necessary; NULL if all are used. */
static inline sbri_contact_report *sbri_contact_reports_add(sbri_contact_reports *t, uint32_t collider,
    sbf_vec3 position, sbf_vec3 normal, float impulse, float speed) {
  for (uint32_t i = 0; i < t->count; i++) {
    if (t->now[i].collider != collider) continue;
    t->now[i].impulse += impulse;
    t->now[i].speed = speed > t->now[i].speed ? speed : t->now[i].speed;
    return &t->now[i];
  }
  if (t->count == SBRI_MAX_CONTACT_REPORTS) return NULL;
  t->now[t->count] = (sbri_contact_report){.collider = collider,
      .is_new = !sbri_contact_reports_has(t->before, t->before_count, collider),
      .position = position,
      .normal = normal,
      .speed = speed,
      .impulse = impulse};
  return &t->now[t->count++];
}

/* Adds an impulse on the body at a point. */
static inline void sbri_contact_report_add_impulse(
    sbri_contact_report *one, sbf_vec3 position, sbf_vec3 impulse) {
  one->total_impulse = sbri_add(one->total_impulse, impulse);
  one->total_moment = sbri_add(one->total_moment, sbri_cross(sbri_sub(position, one->position), impulse));
}

#endif
