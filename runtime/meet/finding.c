/* What all that find touches need: the sides of one, its margin, and room for it. */
#include "meet/finding.h"

/* How far beyond its margin what lies there is looked for: of the size of what it lies on. */
static const float LET_GO_SHARE = 0.01f;

sbri_meet_side sbri_soft_side(
    const sbri_party *p, const uint32_t *vertices, const float *weights, int count) {
  sbri_meet_side side = {.member = p->member, .rigid_body = -1, .island = p->soft->island};
  for (int i = 0; i < count; i++) {
    const sbri_sample *s = &p->surface->samples[vertices[i]];
    for (int k = 0; k < 4; k++) {
      if (s->weights[k] == 0 || weights[i] == 0) continue;
      uint32_t at = 0;
      while (at < side.count && side.slots[at] != s->slots[k]) at++;
      if (at == side.count) side.slots[side.count++] = s->slots[k];
      side.weights[at] += weights[i] * s->weights[k];
    }
  }
  return side;
}

sbr_transform sbri_party_frame(const sbri_party *p, bool end) {
  const sbri_character *c = p->of->character;
  uint32_t b = p->is->number;
  sbr_transform at;
  if (p->is->gives_way && p->of->parts.steps) {
    const sbri_rigid_body_state *s = &sbri_rigid_bodies(c)[b];
    at = s->pose;
    if (end) {
      at.position = sbri_add_scaled(at.position, s->velocity, p->of->tick_s);
      (void)sbri_free_turn(p->rigid, s->pose.rotation, s->spin, p->of->tick_s, &at.rotation);
    }
  } else {
    at = sbri_rigid_target(c, end ? sbri_pose(c) : sbri_previous_pose(c), b);
  }
  at.position = sbri_add_scaled(p->of->offset, at.position, p->of->scale);
  return at;
}

sbri_meet_side sbri_party_side(
    const sbri_party *p, const uint32_t *vertices, const float *weights, int count) {
  if (p->soft) return sbri_soft_side(p, vertices, weights, count);
  sbr_transform at = sbri_party_frame(p, false);
  sbf_vec3 x = {0, 0, 0};
  for (int i = 0; i < count; i++) x = sbri_add_scaled(x, p->surface->places[vertices[i]], weights[i]);
  return sbri_rigid_side(p, sbri_into_frame(&at, x, p->of->scale));
}

float sbri_party_distance(const sbri_party *p, const sbri_surface_finding *found, sbf_vec3 x) {
  const uint32_t *c = p->surface->triangles + 3 * (size_t)found->face;
  const sbf_vec3 *at = p->surface->places;
  return sbri_length(sbri_sub(sbri_triangle_place(found->weights, at[c[0]], at[c[1]], at[c[2]]), x));
}

float sbri_party_size(const sbri_party *p) {
  return p->of->scale * (p->soft ? p->soft->rest_size_m : 2 * p->rigid->radius);
}

void sbri_finding_add(
    const sbri_finding *f, const sbri_party *a, const sbri_party *b, const sbri_meet_touch *touch) {
  if (f->group->touch_count >= f->group->touch_capacity) return;
  sbri_meet_touch *t = &f->world->meetings->touches[f->group->first_touch + f->group->touch_count++];
  *t = *touch;
  t->friction = t->goes_out ? 0 : sqrtf(a->friction * b->friction);
  t->restitution = a->restitution > b->restitution ? a->restitution : b->restitution;
  float sizes[2] = {a->soft ? a->soft->rest_size_m * a->of->scale : INFINITY,
      b->soft ? b->soft->rest_size_m * b->of->scale : INFINITY};
  t->soft_m = sizes[0] < sizes[1] ? sizes[0] : sizes[1];
  if (t->soft_m == INFINITY) t->soft_m = 0;
  t->names[0] = sbri_meet_name(a->is), t->names[1] = sbri_meet_name(b->is);
}

sbf_vec3 sbri_party_rest(const sbri_party *p, uint32_t vertex) {
  const sbri_sample *s = &p->surface->samples[vertex];
  return sbri_scale(sbri_meet_rest(p->of->character->model, p->is->number, s), p->of->scale);
}

float sbri_party_thickness(const sbri_party *p) {
  return p->surface->thick_m * p->of->scale;
}

float sbri_party_margin(const sbri_party *a, const sbri_party *b) {
  float own = a->soft ? a->soft->margin_m * a->of->scale : 0;
  float other = b->surface->two_sided ? b->soft->source->collision.outer_thickness * b->of->scale : 0;
  return own > other ? own : other;
}

float sbri_party_beyond(float margin, const sbri_party *b) {
  return margin + LET_GO_SHARE * b->soft->rest_size_m * b->of->scale;
}
