/* Adds contacts of soft bodies with host shapes, for both kinds of queries. */
#include "contact/sample_motion.h"
#include "contact/soft_shape_contacts.h"
#include "shapes/external_body.h"

void sbri_shape_contact_add(const sbri_shape_pair *m, const sbri_sample *s, sbf_vec3 on_shape, sbf_vec3 n) {
  const sbri_island_tick *t = m->tick;
  uint32_t *count = &m->tables->contact_counts[m->body - t->model->bodies];
  if (*count >= m->body->contact.max_count) return;
  sbf_vec3 normal = sbri_rotate(m->frame.collider->rotation_from, n);
  sbf_vec3 position = sbri_out_of_shape(&m->frame, on_shape);
  sbf_vec3 velocity = sbri_scale(sbri_shape_displacement(&m->frame, on_shape), 1 / t->tick_s);
  float friction = m->body->contact.friction;
  sbri_soft_contact *contact = &m->tables->contacts[m->body->contact.first + (*count)++];
  *contact = (sbri_soft_contact){.sample = *s,
      .normal = normal,
      .offset = sbri_dot(normal, position) + m->body->contact.margin_m,
      .velocity = velocity,
      .friction_scale = friction > 0 ? sbri_friction_with(m->frame.collider, friction) / friction : 1,
      .restitution = sbri_restitution_with(m->frame.collider, m->body->contact.restitution),
      .collider = m->number};
  sbri_external_body_maker context = {t->environment.colliders, t->environment.origin, t->environment.scale,
      t->tick_s, m->tables->touched->now, m->tables->touched->count};
  contact->external_body = sbri_external_body_of(m->tables->external_bodies, &context, &m->frame, m->number);
  if (contact->external_body)
    contact->arm = sbri_sub(position, m->tables->external_bodies->at[contact->external_body - 1].centre);
  contact->gap = sbri_contact_predicted_gap(t, contact);
}
