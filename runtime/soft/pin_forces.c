/* What a body's elements pull with on the places that hold it. */
#include <string.h>

#include "soft/soft.h"
#include "solvers/outer_forces.h"
#include "solvers/reaction.h"

/* Regions look for their rotation from where it was, which is state: here from a copy. */
static void add_regions(const sbri_island_tick *t) {
  if (t->island->tetrahedron_block_count == 0)
    memset(t->element_forces, 0, t->island->slot_count * sizeof *t->element_forces);
  for (uint32_t b = 0; b < t->island->region_block_count; b++) {
    float rotations[4 * SBRI_BLOCK];
    memcpy(rotations, t->rotations + 4 * SBRI_BLOCK * (size_t)b, sizeof rotations);
    sbri_region_block_forces(t, &t->island->region_blocks[b], rotations);
  }
}

static void add(sbri_point *to, sbf_vec3 force) {
  to->x += force.x, to->y += force.y, to->z += force.z;
}

void sbri_pin_forces_find(const sbr_world *world, sbri_character *c, uint32_t index) {
  sbri_island now = sbri_island_now(c, &c->model->islands[index]);
  sbri_island_tick t = sbri_island_tick_of(world, c, index, &now);
  t.outer_rad_s = &now.outer_rad_s;
  t.begins = sbri_previous_positions(c) + now.first_slot, t.targets = t.positions;
  if (sbri_has_damping(&now)) sbri_spread_velocities(&t, 1 / t.tick_s);
  if (now.tetrahedron_block_count > 0) sbri_tetrahedron_forces(&t, NULL);
  add_regions(&t);
  for (uint32_t i = 0; i < now.held_spring_count; i++) {
    sbf_vec3 force;
    uint32_t held = sbri_held_spring_force(&t, now.held_springs[i], &force);
    add(&t.element_forces[held], force);
  }
  if (!t.outer) return;
  sbri_outer_forces(&t, t.tick_s);
  for (uint32_t slot = now.free_count; slot < now.slot_count; slot++)
    add(&t.element_forces[slot], (sbf_vec3){t.outer[slot].x, t.outer[slot].y, t.outer[slot].z});
}
