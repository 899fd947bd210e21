/* Forces of a body's elements on its pins. */
#include <string.h>

#include "soft/soft.h"
#include "solvers/external_forces.h"
#include "solvers/reaction.h"

/* The search for a region's rotation begins at the previous rotation, which is state; this uses a copy. */
static void add_regions(const sbri_island_tick *t) {
  if (t->island->tetrahedron_block_count == 0)
    memset(t->element_forces, 0, t->island->slot_count * sizeof *t->element_forces);
  for (uint32_t b = 0; b < t->island->region_block_count; b++) {
    float rotations[4 * SBRI_BLOCK];
    memcpy(rotations, t->rotations + 4 * SBRI_BLOCK * (size_t)b, sizeof rotations);
    sbri_compute_region_block_forces(t, &t->island->region_blocks[b], rotations);
  }
}

static void add(sbri_point *to, sbf_vec3 force) {
  to->x += force.x, to->y += force.y, to->z += force.z;
}

void sbri_pin_forces_find(const sbr_world *world, sbri_character *c, uint32_t index) {
  sbri_island now = sbri_island_now(c, &c->model->islands[index]);
  sbri_island_tick t = sbri_island_tick_of(world, c, index, &now);
  t.external_rad_s = &now.external_rad_s;
  t.begins = sbri_previous_positions(c) + now.first_slot, t.targets = t.positions;
  if (sbri_has_damping(&now)) sbri_copy_velocities_to_points(&t, 1 / t.tick_s);
  if (now.tetrahedron_block_count > 0) sbri_compute_tetrahedron_forces(&t, NULL);
  add_regions(&t);
  for (uint32_t i = 0; i < now.pinned_spring_count; i++) {
    sbf_vec3 force;
    uint32_t pinned = sbri_pinned_spring_force(&t, now.pinned_springs[i], &force);
    add(&t.element_forces[pinned], force);
  }
  if (!t.external_forces) return;
  sbri_compute_external_forces(&t, t.tick_s);
  for (uint32_t slot = now.free_count; slot < now.slot_count; slot++)
    add(&t.element_forces[slot],
        (sbf_vec3){t.external_forces[slot].x, t.external_forces[slot].y, t.external_forces[slot].z});
}
