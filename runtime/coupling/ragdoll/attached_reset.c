/* Conserves momentum when a soft body on simulated bones is reset to its rest shape.
 *
 * After the reset the body moves with its bones. The difference in linear momentum, and in angular momentum
 * about the common centre of mass, is given to bones and soft body as one rigid body: the change of velocity
 * with the least energy. */
#include <string.h>

#include "coupling/ragdoll/ragdoll.h"
#include "rigid/sym6.h"
#include "soft/soft.h"
#include "soft/solvers/scheme.h"

/* Velocity of a point fixed to a frame; false where the frame belongs to no simulated body. */
static bool add_velocity(const sbri_character *c, uint32_t frame, float weight, sbf_vec3 at, sbf_vec3 *sum) {
  int32_t attachment = c->model->rigid_body_of_frame[frame];
  if (attachment < 0 || !sbri_rigid_is_simulated(c, (uint32_t)attachment)) return false;
  const sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[attachment];
  sbf_vec3 turn = sbri_angular_velocity_from_momentum(
      &c->model->rigid.bodies[attachment], body->pose.rotation, body->angular_momentum);
  sbf_vec3 v = sbri_add(body->velocity, sbri_cross(turn, sbri_sub(at, body->pose.position)));
  *sum = sbri_add_scaled(*sum, v, weight);
  return true;
}

static bool find_velocity(
    const sbri_character *c, const sbri_body *body, uint32_t index, sbf_vec3 at, sbf_vec3 *v) {
  *v = sbri_vec3(0, 0, 0);
  if (!body->drivers) return add_velocity(c, body->driver_frame, 1, at, v);
  const sbri_driver *driver = &body->drivers[index];
  for (int k = 0; k < SBRI_DRIVERS; k++)
    if (driver->weights[k] > 0 && !add_velocity(c, driver->frames[k], driver->weights[k], at, v))
      return false;
  return true;
}

/* Returns false if the island is pinned to anything except simulated bodies, which then takes the difference.
 */
static bool set_bone_velocities(sbri_character *c, const sbri_island *island) {
  const sbri_point *points = sbri_positions(c) + island->first_slot;
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    if (!body->is_pinned) return false;
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
      float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
      sbf_vec3 at = {points[slot].x, points[slot].y, points[slot].z}, with;
      if (!find_velocity(c, body, slot - body->slots.begin, at, &with)) return false;
      v[0] = with.x, v[SBRI_BLOCK] = with.y, v[2 * SBRI_BLOCK] = with.z;
    }
  }
  return true;
}

static void add_bones(const sbri_character *c, const sbri_island *island, sbri_whole_momentum *to) {
  for (uint32_t k = 0; k < island->pins.attachment_count; k++) {
    uint32_t b = island->pins.attachments[k];
    const sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[b];
    if (!sbri_rigid_is_simulated(c, b)) continue;
    const float angular_velocity[3] = {
        body->angular_momentum.x, body->angular_momentum.y, body->angular_momentum.z};
    sbri_momentum_add(to, (double)c->model->rigid.bodies[b].mass, body->pose.position, body->velocity);
    for (int i = 0; i < 3; i++) to->angular[i] += (double)angular_velocity[i];
  }
}

/* Angular momentum about its own centre of mass. */
static void find_angular_momentum(const sbri_whole_momentum *m, double to[3]) {
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    to[k] = m->angular[k] - (m->first[i] * m->linear[j] - m->first[j] * m->linear[i]) / m->mass;
  }
}

static void add_moments(double d[6][6], double mass, const double center[3], sbf_vec3 at) {
  const double r[3] = {(double)at.x - center[0], (double)at.y - center[1], (double)at.z - center[2]};
  double square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j <= i; j++) d[3 + i][3 + j] += mass * ((i == j ? square : 0) - r[i] * r[j]);
}

/* Mass matrix of bones and soft body, about the common centre. */
static void find_mass_matrix(
    const sbri_character *c, const sbri_island *island, const double center[3], double d[6][6]) {
  const sbri_point *points = sbri_positions(c) + island->first_slot;
  for (uint32_t slot = 0; slot < island->free_count; slot++)
    add_moments(
        d, (double)island->masses[slot], center, sbri_vec3(points[slot].x, points[slot].y, points[slot].z));
  for (uint32_t k = 0; k < island->pins.attachment_count; k++) {
    uint32_t b = island->pins.attachments[k];
    const sbr_transform *pose = &sbri_rigid_bodies(c)[b].pose;
    float moments[3][3];
    if (!sbri_rigid_is_simulated(c, b)) continue;
    add_moments(d, (double)c->model->rigid.bodies[b].mass, center, pose->position);
    sbri_rigid_compute_moments(c->model->rigid.bodies[b].inertia, pose->rotation, moments);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j <= i; j++) d[3 + i][3 + j] += (double)moments[i][j];
  }
}

static void apply_change(
    sbri_character *c, const sbri_island *island, sbf_vec3 center, sbf_vec3 change, sbf_vec3 turn) {
  const sbri_point *points = sbri_positions(c) + island->first_slot;
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbf_vec3 arm = sbri_sub(sbri_vec3(points[slot].x, points[slot].y, points[slot].z), center);
    sbf_vec3 more = sbri_add(change, sbri_cross(turn, arm));
    if (!(island->masses[slot] > 0)) continue;
    v[0] += more.x, v[SBRI_BLOCK] += more.y, v[2 * SBRI_BLOCK] += more.z;
  }
  for (uint32_t k = 0; k < island->pins.attachment_count; k++) {
    uint32_t b = island->pins.attachments[k];
    sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[b];
    if (!sbri_rigid_is_simulated(c, b)) continue;
    sbf_vec3 more = sbri_add(change, sbri_cross(turn, sbri_sub(body->pose.position, center)));
    body->velocity = sbri_add(body->velocity, more);
    body->angular_momentum = sbri_add(body->angular_momentum,
        sbri_angular_momentum_from_velocity(&c->model->rigid.bodies[b], body->pose.rotation, turn));
  }
}

void sbri_attached_body_set_momentum(sbri_character *c, uint32_t index, const sbri_whole_momentum *had) {
  const sbri_island *island = &c->model->islands[index];
  if (island->scheme->forceless || !set_bone_velocities(c, island) || !(had->mass > 0)) return;
  sbri_whole_momentum old_momentum = *had, now = sbri_island_momentum(c, index);
  double rotated[3], turns[3], center[3], d[6][6] = {{0}}, x[6];
  add_bones(c, island, &old_momentum);
  add_bones(c, island, &now);
  find_angular_momentum(&old_momentum, rotated);
  find_angular_momentum(&now, turns);
  for (int k = 0; k < 3; k++) {
    center[k] = now.first[k] / now.mass, d[k][k] = now.mass;
    x[k] = old_momentum.linear[k] - now.linear[k], x[3 + k] = rotated[k] - turns[k];
  }
  find_mass_matrix(c, island, center, d);
  sbri_sym6_factor(d);
  sbri_sym6_solve_forward(d, x);
  sbri_sym6_solve_back(d, x);
  apply_change(c, island, sbri_vec3((float)center[0], (float)center[1], (float)center[2]),
      sbri_vec3((float)x[0], (float)x[1], (float)x[2]), sbri_vec3((float)x[3], (float)x[4], (float)x[5]));
}
