#include "soft/solvers/loads.h"

#include "math/vec3.h"
#include "soft/solvers/pinned_impulse.h"

static float *velocity_of(float *velocities, uint32_t slot) {
  return velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
}

static void add(float *v, sbf_vec3 change) {
  v[0] += change.x, v[SBRI_BLOCK] += change.y, v[2 * SBRI_BLOCK] += change.z;
}

/* Distributes an impulse over the points. Parts on pinned points go to their simulated rigid bodies. */
static void apply_impulse(
    const sbri_island_tick *t, const sbri_vertex_weights *at, float *velocities, sbf_vec3 impulse) {
  for (uint32_t k = 0; k < at->count; k++) {
    sbf_vec3 part = sbri_scale(impulse, at->weights[k]);
    uint32_t slot = at->slots[k];
    if (slot < t->island->free_count)
      add(velocity_of(velocities, slot), sbri_scale(part, t->island->inverse_masses[slot]));
    else
      sbri_pinned_apply_impulse(t, slot, part);
  }
}

/* All points get the same velocity change. */
static void change_body_velocity(
    const sbri_island_tick *t, const sbri_body *body, float *velocities, sbf_vec3 velocity_change) {
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++)
    if (t->island->masses[slot] > 0) add(velocity_of(velocities, slot), velocity_change);
}

static sbf_vec3 drag_impulse(
    const sbri_island_tick *t, const sbri_load_now *load, const float *velocities, float h) {
  sbf_vec3 error = sbri_scale(load->target, -1), v = {0, 0, 0};
  for (uint32_t k = 0; k < load->at.count; k++) {
    const sbri_point *x = &t->positions[load->at.slots[k]];
    error = sbri_add_scaled(error, sbri_vec3(x->x, x->y, x->z), load->at.weights[k]);
    v = sbri_add_scaled(v, sbri_slot_velocity(t, velocities, load->at.slots[k]), load->at.weights[k]);
  }
  float k = load->stiffness, kc = h * k + load->damping, max = load->max_force * h;
  sbf_vec3 impulse =
      sbri_scale(sbri_add_scaled(sbri_scale(error, k), v, kc), -h / (1 + h * kc * load->inverse_mass));
  float size = sbri_length(impulse);
  return size > max ? sbri_scale(impulse, max / size) : impulse;
}

void sbri_loads_apply(const sbri_island_tick *t, const sbri_body *body, float *velocities, float h) {
  for (uint32_t i = 0; i < t->environment.load_count; i++) {
    const sbri_load_now *load = &t->environment.loads[i];
    if (&t->model->bodies[load->body] != body) continue;
    sbf_vec3 impulse = load->is_grab ? drag_impulse(t, load, velocities, h) : sbri_scale(load->force, h);
    if (load->at.count > 0)
      apply_impulse(t, &load->at, velocities, impulse);
    else
      change_body_velocity(t, body, velocities, sbri_scale(impulse, load->inverse_mass));
    load->impulse[0] += impulse.x, load->impulse[1] += impulse.y, load->impulse[2] += impulse.z;
  }
}
