/* Queries of motion and pins of soft bodies: sbrun/soft_body.h. */
#include "math/vec3.h"
#include "soft/soft.h"

static const sbri_body *body_of(const sbri_character *c, uint32_t soft_body) {
  if (!c || soft_body >= c->model->asset->soft_bodies.count) return NULL;
  return sbri_body_accepts_forces(c, &c->model->bodies[soft_body]) ? &c->model->bodies[soft_body] : NULL;
}

sbr_soft_motion sbr_character_get_soft_motion(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body) {
  const sbri_character *c = sbri_character_of(world, character);
  const sbri_body *body = body_of(c, soft_body);
  if (!body) return (sbr_soft_motion){0};
  sbr_soft_motion own = sbri_body_motion(c, body);
  float s = c->scale;
  return (sbr_soft_motion){.mass = own.mass * s * s * s,
      .center = sbri_scale(own.center, s),
      .velocity = sbri_scale(own.velocity, 1 / c->time_scale),
      .angular_velocity = sbri_scale(own.angular_velocity, c->time_scale)};
}

sbf_vec3 sbr_character_get_grab_force(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body, uint32_t vertex) {
  const sbri_character *c = sbri_character_of(world, character);
  for (uint32_t i = 0; c && i < SBR_LOAD_CAPACITY; i++) {
    const sbri_load *load = &sbri_loads(c)[i];
    if (load->kind != SBRI_LOAD_GRAB || load->body != soft_body || load->vertex != vertex) continue;
    float fraction = 1 / (sbri_own_impulse(c) * (float)world->time.tick_s);
    return sbri_scale((sbf_vec3){load->impulse[0], load->impulse[1], load->impulse[2]}, fraction);
  }
  return (sbf_vec3){0, 0, 0};
}

uint32_t sbr_character_find_nearest_vertex(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body, sbr_double3 position) {
  const sbri_character *c = sbri_character_of(world, character);
  uint32_t nearest = SBR_WHOLE_BODY, count = sbr_character_get_surface(world, character, soft_body, NULL, 0);
  if (!c || count == 0 || soft_body >= c->model->asset->soft_bodies.count) return nearest;
  /* computed by that call, in the character's own units */
  const sbri_point *vertices = sbri_surface_vertices(c) + c->model->bodies[soft_body].surface.first_vertex;
  sbr_double3 o = sbri_header(c)->origin;
  double min = 0, s = (double)c->scale;
  for (uint32_t i = 0; i < count; i++) {
    double x = o.x + s * (double)vertices[i].x - position.x, y = o.y + s * (double)vertices[i].y - position.y,
           z = o.z + s * (double)vertices[i].z - position.z, square = x * x + y * y + z * z;
    if (nearest != SBR_WHOLE_BODY && !(square < min)) continue;
    nearest = i, min = square;
  }
  return nearest;
}

/* ---- Pins ---- */

static sbf_vec3 position_of(const sbri_character *c, const sbri_island *island, uint32_t slot) {
  const sbri_point *x = &sbri_positions(c)[island->first_slot + slot];
  return sbri_vec3(x->x, x->y, x->z);
}

/* The mean position of the set and its number of points. */
static sbr_pin_reaction begin_set(const sbri_character *c, uint32_t soft_body, uint32_t number) {
  const sbri_body *body = &c->model->bodies[soft_body];
  const sbri_island *island = &c->model->islands[body->island];
  const sbf_pin_set *set = &body->level->pins.at[number];
  sbr_pin_reaction r = {.pin_set = number, .bone = set->bone, .rigid_body = set->rigid_body};
  for (uint32_t slot = island->free_count; slot < island->slot_count; slot++) {
    const sbri_pin_of *pin = &island->pins.sets[slot - island->free_count];
    if (pin->body != soft_body || pin->set != number) continue;
    r.about = sbri_add(r.about, position_of(c, island, slot));
    r.points++;
  }
  if (r.points > 0) r.about = sbri_scale(r.about, 1 / (float)r.points);
  return r;
}

/* Adds the reactions to `element_forces` on the pinned points. */
static void add_forces(const sbri_character *c, uint32_t soft_body, uint32_t number, sbr_pin_reaction *r) {
  const sbri_island *island = &c->model->islands[c->model->bodies[soft_body].island];
  const sbri_point *forces = sbri_element_forces(c) + island->first_slot;
  for (uint32_t slot = island->free_count; slot < island->slot_count; slot++) {
    const sbri_pin_of *pin = &island->pins.sets[slot - island->free_count];
    if (pin->body != soft_body || pin->set != number) continue;
    sbf_vec3 f = {-forces[slot].x, -forces[slot].y, -forces[slot].z};
    r->force = sbri_add(r->force, f);
    r->torque = sbri_add(r->torque, sbri_cross(sbri_sub(position_of(c, island, slot), r->about), f));
  }
  float s = c->scale;
  r->force = sbri_scale(r->force, s * s * s);
  r->torque = sbri_scale(r->torque, s * s * s * s);
  r->about = sbri_scale(r->about, s);
}

uint32_t sbr_character_get_pin_reactions(const sbr_world *world, sbr_character_id character,
    uint32_t soft_body, sbr_pin_reaction *reactions, uint32_t capacity) {
  sbri_character *c = sbri_character_of(world, character);
  const sbri_body *body = body_of(c, soft_body);
  if (!body) return 0;
  uint32_t count = body->level->pins.count;
  if (reactions && capacity > 0 && count > 0) sbri_pin_forces_find(world, c, body->island);
  for (uint32_t i = 0; reactions && i < count && i < capacity; i++) {
    reactions[i] = begin_set(c, soft_body, i);
    add_forces(c, soft_body, i, &reactions[i]);
  }
  return count;
}
