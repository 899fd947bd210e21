/* Mass, momentum and rigid motion of whole bodies, and how a body without pins keeps its motion when the
 * detail level changes. */
#include "soft/soft.h"
#include "soft/solvers/rigid_motion.h"
#include "soft/solvers/scheme.h"

/* Keeps the angular velocity, not the angular momentum: a coarse lattice has more mass far out, and a visible
 * change of rotation would be worse (docs/detail.md). */
void sbri_body_copy_momentum(sbri_character *c, const sbri_character *from, uint32_t index) {
  const sbri_body *body = &c->model->bodies[index], *old_body = &from->model->bodies[index];
  const sbri_island *island = &c->model->islands[body->island],
                    *old = &from->model->islands[old_body->island];
  const sbri_point *positions = sbri_positions(c) + island->first_slot,
                   *old_positions = sbri_positions(from) + old->first_slot;
  const float *old_velocities = sbri_velocities(from) + 3 * (size_t)old->first_slot;
  if (island->scheme->forceless || old->scheme->forceless) return;
  sbri_rigid_motion old_motion = sbri_rigid_motion_find(old, old_body, old_positions, old_velocities);
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  sbri_rigid_motion motion = sbri_rigid_motion_find(island, body, positions, velocities);
  sbf_vec3 linear_change = sbri_sub(old_motion.velocity, motion.velocity),
           angular_change = sbri_sub(old_motion.angular_velocity, motion.angular_velocity);
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    const sbri_point *p = &positions[slot];
    sbf_vec3 arm = sbri_sub(sbri_vec3(p->x, p->y, p->z), motion.center);
    sbf_vec3 change = sbri_add(linear_change, sbri_cross(angular_change, arm));
    float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    v[0] += change.x, v[SBRI_BLOCK] += change.y, v[2 * SBRI_BLOCK] += change.z;
  }
}

sbr_soft_motion sbri_body_motion(const sbri_character *c, const sbri_body *body) {
  const sbri_island now = sbri_island_now(c, &c->model->islands[body->island]);
  sbri_rigid_motion is = sbri_rigid_motion_find(
      &now, body, sbri_positions(c) + now.first_slot, sbri_velocities(c) + 3 * (size_t)now.first_slot);
  return (sbr_soft_motion){.mass = is.mass_kg,
      .center = is.center,
      .velocity = is.velocity,
      .angular_velocity = is.angular_velocity};
}

void sbri_momentum_add(sbri_whole_momentum *to, double mass, sbf_vec3 at, sbf_vec3 velocity) {
  const double x[3] = {(double)at.x, (double)at.y, (double)at.z};
  const double p[3] = {mass * (double)velocity.x, mass * (double)velocity.y, mass * (double)velocity.z};
  to->mass += mass;
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    to->first[k] += mass * x[k], to->linear[k] += p[k];
    to->angular[k] += x[i] * p[j] - x[j] * p[i];
  }
}

sbri_whole_momentum sbri_island_momentum(const sbri_character *c, uint32_t index) {
  const sbri_island *island = &c->model->islands[index];
  const sbri_point *points = sbri_positions(c) + island->first_slot;
  const float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  sbri_whole_momentum sum = {0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    const sbri_point *x = &points[slot];
    const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbri_momentum_add(&sum, (double)island->masses[slot], sbri_vec3(x->x, x->y, x->z),
        sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]));
  }
  return sum;
}
