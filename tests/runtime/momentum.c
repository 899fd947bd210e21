#include "momentum.h"

#include "rigid_scenes.h"
#include "state/state.h"

static void add(scene_momentum *to, double mass, sbf_vec3 at, sbf_vec3 v) {
  const double x[3] = {(double)at.x, (double)at.y, (double)at.z},
               p[3] = {mass * (double)v.x, mass * (double)v.y, mass * (double)v.z};
  to->mass += mass;
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    to->linear[k] += p[k];
    to->angular[k] += x[i] * p[j] - x[j] * p[i];
  }
}

sbf_vec3 scene_slot_velocity(const sbri_character *c, const sbri_island *island, uint32_t slot) {
  const float *v = sbri_velocities(c) + 3 * (size_t)island->first_slot +
                   3 * (size_t)(slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
  return (sbf_vec3){v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]};
}

scene_momentum scene_momentum_of(const scene *s) {
  scene_momentum m = {{0}, {0}, 0};
  for (uint32_t i = 0; i < s->world->character_capacity; i++) {
    const sbri_character *c = &s->world->characters[i];
    if (!c->model) continue;
    for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
      const sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[b];
      add(&m, (double)c->model->rigid.bodies[b].mass, body->pose.position, body->velocity);
      m.angular[0] += (double)body->angular_momentum.x, m.angular[1] += (double)body->angular_momentum.y;
      m.angular[2] += (double)body->angular_momentum.z;
    }
    for (uint32_t k = 0; k < c->model->island_count; k++) {
      const sbri_island now = sbri_island_now(c, &c->model->islands[k]), *island = &now;
      const sbri_point *points = sbri_positions(c) + island->first_slot;
      for (uint32_t slot = 0; slot < island->free_count; slot++)
        add(&m, (double)island->masses[slot], (sbf_vec3){points[slot].x, points[slot].y, points[slot].z},
            scene_slot_velocity(c, island, slot));
    }
  }
  return m;
}

double scene_energy_of(const scene *s) {
  double sum = rigid_energy(s, s->asset->rigid_bodies.count);
  for (uint32_t b = 0; b < s->asset->soft_bodies.count; b++) {
    sbr_body_health health = sbr_character_get_body_health(s->world, s->character, b);
    sum += health.kinetic_j + health.elastic_j + health.potential_j;
  }
  return sum;
}
