/* Sides, frames and margins of the bodies of a pair. */
#include "coupling/body_contact/narrow_phase.h"

/* Search distance beyond the margin, as a fraction of the body's size. */
static const float SEARCH_FRACTION = 0.01f;

sbri_contact_side sbri_soft_contact_side(
    const sbri_pair_body *p, const uint32_t *vertices, const float *weights, int count) {
  sbri_contact_side side = {.member = p->member, .rigid_body = -1, .island = p->soft->island};
  for (int i = 0; i < count; i++) {
    const sbri_sample *s = &p->surface->samples[vertices[i]];
    for (int k = 0; k < 4; k++) {
      if (s->weights[k] == 0 || weights[i] == 0) continue;
      uint32_t frame = 0;
      while (frame < side.count && side.slots[frame] != s->slots[k]) frame++;
      if (frame == side.count) side.slots[side.count++] = s->slots[k];
      side.weights[frame] += weights[i] * s->weights[k];
    }
  }
  return side;
}

sbr_transform sbri_pair_body_frame(const sbri_pair_body *p, bool end) {
  const sbri_character *c = p->owner->character;
  uint32_t b = p->body->body_index;
  sbr_transform frame;
  if (p->body->is_dynamic && p->owner->parts.steps) {
    const sbri_rigid_body_state *s = &sbri_rigid_bodies(c)[b];
    frame = s->pose;
    if (end) {
      frame.position = sbri_add_scaled(frame.position, s->velocity, p->owner->tick_s);
      (void)sbri_torque_free_rotation(
          p->rigid, s->pose.rotation, s->angular_momentum, p->owner->tick_s, &frame.rotation);
    }
  } else {
    frame = sbri_rigid_target(c, end ? sbri_pose(c) : sbri_previous_pose(c), b);
  }
  frame.position = sbri_add_scaled(p->owner->offset, frame.position, p->owner->scale);
  return frame;
}

static sbri_box hull_box_at(const sbri_pair_body *p, const sbr_transform *frame) {
  sbri_box box = p->rigid->hull.box, at = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (int corner = 0; corner < 8; corner++) {
    sbf_vec3 x = {corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
        corner & 4 ? box.high.z : box.low.z};
    at =
        sbri_box_with(at, sbri_add_scaled(frame->position, sbri_rotate(frame->rotation, x), p->owner->scale));
  }
  return at;
}

sbri_box sbri_pair_body_hull_box(const sbri_pair_body *p) {
  sbr_transform from = sbri_pair_body_frame(p, false), to = sbri_pair_body_frame(p, true);
  return sbri_box_join(hull_box_at(p, &from), hull_box_at(p, &to));
}

sbri_contact_side sbri_pair_body_side(
    const sbri_pair_body *p, const uint32_t *vertices, const float *weights, int count) {
  if (p->soft) return sbri_soft_contact_side(p, vertices, weights, count);
  sbr_transform frame = sbri_pair_body_frame(p, false);
  sbf_vec3 x = {0, 0, 0};
  for (int i = 0; i < count; i++) x = sbri_add_scaled(x, p->surface->positions[vertices[i]], weights[i]);
  return sbri_rigid_contact_side(p, sbri_to_local(&frame, x, p->owner->scale));
}

float sbri_pair_body_distance(const sbri_pair_body *p, const sbri_surface_hit *found, sbf_vec3 x) {
  const uint32_t *c = p->surface->triangles + 3 * (size_t)found->face;
  const sbf_vec3 *frame = p->surface->positions;
  return sbri_length(sbri_sub(sbri_triangle_point(found->weights, frame[c[0]], frame[c[1]], frame[c[2]]), x));
}

float sbri_pair_body_size(const sbri_pair_body *p) {
  return p->owner->scale * (p->soft ? p->soft->rest_size_m : 2 * p->rigid->radius);
}

void sbri_narrow_phase_add(const sbri_narrow_phase *f, const sbri_pair_body *a, const sbri_pair_body *b,
    const sbri_contact *contact) {
  if (f->group->contact_count >= f->group->contact_capacity) return;
  sbri_contact *t = &f->world->body_contacts->contacts[f->group->first_contact + f->group->contact_count++];
  *t = *contact;
  t->friction = t->exits_nearest ? 0 : sqrtf(a->friction * b->friction);
  t->restitution = a->restitution > b->restitution ? a->restitution : b->restitution;
  float sizes[2] = {a->soft ? a->soft->rest_size_m * a->owner->scale : INFINITY,
      b->soft ? b->soft->rest_size_m * b->owner->scale : INFINITY};
  t->soft_size_m = sizes[0] < sizes[1] ? sizes[0] : sizes[1];
  if (t->soft_size_m == INFINITY) t->soft_size_m = 0;
  t->body_ids[0] = sbri_contact_body_id(a->body), t->body_ids[1] = sbri_contact_body_id(b->body);
}

sbf_vec3 sbri_pair_body_rest_position(const sbri_pair_body *p, uint32_t vertex) {
  const sbri_sample *s = &p->surface->samples[vertex];
  return sbri_scale(
      sbri_sample_rest_position(p->owner->character->model, p->body->body_index, s), p->owner->scale);
}

float sbri_pair_body_thickness(const sbri_pair_body *p) {
  return p->surface->thickness_m * p->owner->scale;
}

float sbri_pair_margin(const sbri_pair_body *a, const sbri_pair_body *b) {
  float own = a->soft ? a->soft->contact.margin_m * a->owner->scale : 0;
  float other = b->surface->two_sided ? b->soft->source->collision.outer_thickness * b->owner->scale : 0;
  return own > other ? own : other;
}

float sbri_pair_search_distance(float margin, const sbri_pair_body *b) {
  return margin + SEARCH_FRACTION * b->soft->rest_size_m * b->owner->scale;
}
