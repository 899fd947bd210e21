/* A touch of a soft body with a host's shape, however it was found. */
#include "collide/external_body.h"
#include "contact/shape_touch.h"

void sbri_shape_touch_add(const sbri_shape_meeting *m, const sbri_sample *s, sbf_vec3 on_shape, sbf_vec3 n) {
  const sbri_island_tick *t = m->tick;
  uint32_t *count = &m->tables->touch_counts[m->body - t->model->bodies];
  if (*count >= m->body->touch_capacity) return;
  sbf_vec3 normal = sbri_rotate(m->frame.collider->turn_from, n);
  sbf_vec3 place = sbri_out_of_shape(&m->frame, on_shape);
  sbf_vec3 velocity = sbri_scale(sbri_shape_way(&m->frame, on_shape), 1 / t->tick_s);
  float friction = m->body->friction;
  sbri_touch *made = &m->tables->touches[m->body->first_touch + (*count)++];
  *made = (sbri_touch){.sample = *s,
      .normal = normal,
      .offset = sbri_dot(normal, place) + m->body->margin_m,
      .velocity = velocity,
      .friction_share = friction > 0 ? sbri_friction_with(m->frame.collider, friction) / friction : 1,
      .restitution = sbri_restitution_with(m->frame.collider, m->body->restitution),
      .collider = m->number};
  sbri_external_body_maker maker = {
      t->colliders, t->origin, t->scale, t->tick_s, m->tables->touched->now, m->tables->touched->count};
  made->external_body = sbri_external_body_of(m->tables->external_bodies, &maker, &m->frame, m->number);
  if (made->external_body)
    made->arm = sbri_sub(place, m->tables->external_bodies->at[made->external_body - 1].centre);
}
