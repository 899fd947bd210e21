#include "contact/soft_shape_contacts.h"

#include "contact/sample_motion.h"
#include "contact/shape_edges.h"
#include "model/reach.h"
#include "shapes/colliders.h"

typedef sbri_shape_pair shape_pair;

/* Contact plane of a position that moves from `begin` to `end` in the shape's frame: where it enters the
 * shape, or the nearest surface. */
static bool find_plane(
    const shape_pair *m, sbf_vec3 begin, sbf_vec3 end, float reach, float depth, sbri_nearest *found) {
  const sbr_shape *shape = m->frame.collider->shape;
  sbf_vec3 displacement = sbri_sub(end, begin);
  float fraction;
  bool near = sbri_shape_nearest(shape, begin, reach, depth, found);
  if (near && found->gap <= 0) return true;
  /* A long displacement may pass the nearest triangle, or cross a distant one. */
  if (sbri_shape_enter(shape, begin, displacement, &fraction, &found->normal)) {
    found->position = sbri_add_scaled(begin, displacement, fraction);
    return true;
  }
  return near && sbri_shape_nearest(shape, begin, reach, depth, found);
}

static void add_sample(const shape_pair *m, const sbri_sample *s) {
  const sbri_island_tick *t = m->tick;
  if (!(s->mass_kg > 0)) return;
  sbf_vec3 x = sbri_sample_position(t, s), v = sbri_sample_velocity(t, s);
  sbf_vec3 to = sbri_add_scaled(x, v, t->tick_s);
  sbri_box rough = sbri_box_with(sbri_box_of_point(x), to);
  if (!sbri_boxes_overlap(&m->near, &rough)) return;
  sbf_vec3 begin = sbri_into_shape(&m->frame, x, false), end = sbri_into_shape(&m->frame, to, true);
  sbri_box swept_box = sbri_box_with(sbri_box_of_point(begin), end);
  if (!sbri_boxes_overlap(&m->bounds, &swept_box)) return;
  const sbf_collision *rule = &m->body->source->collision;
  float reach = sbri_reach_of(m->body, t->environment.scale, sbri_length(sbri_sub(end, begin)), m->fastest_m);
  sbri_nearest found;
  if (!find_plane(m, begin, end, reach, rule->inner_thickness * t->environment.scale, &found)) return;
  sbri_shape_contact_add(m, s, found.position, found.normal);
}

static void add_all(const shape_pair *m) {
  const sbri_island_tick *t = m->tick;
  for (uint32_t i = 0; i < m->body->contact.sample_count; i++) {
    sbri_sample s = sbri_sample_now(t, &m->body->contact.samples[i], m->tables->surface);
    add_sample(m, &s);
  }
  for (uint32_t slot = m->body->slots.begin; !m->body->contact.samples && slot < m->body->slots.real_end;
       slot++) {
    sbri_sample s = sbri_point_sample(t, slot);
    add_sample(m, &s);
  }
}

/* Bounds of the positions that samples may reach in the tick, and their maximum displacement. */
static sbri_box travel_bounds(
    const sbri_island_tick *t, const sbri_body *body, float *fastest, float *longest) {
  sbri_box box = sbri_box_of_point(sbri_vec3(t->positions[body->slots.begin].x,
      t->positions[body->slots.begin].y, t->positions[body->slots.begin].z));
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
    box = sbri_box_with(box, sbri_vec3(t->positions[slot].x, t->positions[slot].y, t->positions[slot].z));
  for (uint32_t slot = t->island->free_count;
       body->contact.samples && body->is_pinned && slot < t->island->slot_count; slot++)
    box = sbri_box_with(box, sbri_vec3(t->positions[slot].x, t->positions[slot].y, t->positions[slot].z));
  sbf_vec3 size = sbri_sub(box.high, box.low);
  *fastest = sbri_fastest_of(body, t->velocities) * t->tick_s;
  *longest = *fastest * (1 + 2 * body->contact.max_extrapolation) + SBRI_REACH_FRACTION * body->rest_size_m +
             body->contact.margin_m;
  return sbri_box_grown(box, *longest + body->contact.max_extrapolation * (size.x + size.y + size.z));
}

/* The same bounds from the samples themselves, one by one. They are far smaller if samples lie outside the
 * points that they use. */
static sbri_box travel_bounds_of_samples(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *tables, float longest) {
  sbri_box box = {{0, 0, 0}, {0, 0, 0}};
  for (uint32_t i = 0; i < body->contact.sample_count; i++) {
    sbri_sample s = sbri_sample_now(t, &body->contact.samples[i], tables->surface);
    sbf_vec3 x = sbri_sample_position(t, &s),
             end = sbri_add_scaled(x, sbri_sample_velocity(t, &s), t->tick_s);
    box = sbri_box_with(i ? sbri_box_with(box, x) : sbri_box_of_point(x), end);
  }
  return sbri_box_grown(box, longest);
}

/* Converts a box in world space to the space of the body. */
static sbri_box from_world(const sbri_island_tick *t, const sbri_box *box, float more) {
  const float low[3] = {box->low.x, box->low.y, box->low.z},
              high[3] = {box->high.x, box->high.y, box->high.z};
  const double origin[3] = {t->environment.origin.x, t->environment.origin.y, t->environment.origin.z};
  float from[3], to[3];
  for (int k = 0; k < 3; k++) {
    from[k] = (float)(((double)low[k] - origin[k]) / (double)t->environment.scale);
    to[k] = (float)(((double)high[k] - origin[k]) / (double)t->environment.scale);
  }
  return sbri_box_grown((sbri_box){{from[0], from[1], from[2]}, {to[0], to[1], to[2]}}, more);
}

void sbri_soft_shape_contacts_add(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_tables *tables) {
  const sbri_collider_set *set = t->environment.colliders;
  const sbf_collision *rule = &body->source->collision;
  if (!set || !set->tree.node_count || body->slots.begin == body->slots.real_end) return;
  float fastest, longest;
  sbri_box swept_box = travel_bounds(t, body, &fastest, &longest),
           world = sbri_box_in_world(swept_box, t->environment.origin, t->environment.scale);
  sbri_bounds_walk walk;
  uint32_t item;
  sbri_bounds_walk_begin(&walk, &set->tree, world);
  if (body->contact.samples && sbri_bounds_walk_next(&walk, &item)) { /* a collider may be near */
    world = sbri_box_in_world(
        travel_bounds_of_samples(t, body, tables, longest), t->environment.origin, t->environment.scale);
    sbri_bounds_walk_begin(&walk, &set->tree, world);
  }
  while (sbri_bounds_walk_next(&walk, &item)) {
    const sbri_collider *c = &set->at[set->listed[item]];
    if (!sbri_boxes_overlap(&set->bounds[item], &world) ||
        !sbri_layers_collide(rule->layer, rule->mask, c->layer, c->mask))
      continue;
    shape_pair m = {t, body, tables, sbri_collider_frame_of(c, t->environment.origin, t->environment.scale),
        set->listed[item], from_world(t, &set->bounds[item], longest),
        sbri_box_grown(c->shape->bounds, longest * t->environment.scale), fastest * t->environment.scale};
    add_all(&m);
    if (body->contact.coarse_edge_count) sbri_shape_edges_add(&m);
  }
}
