/* Forces of a body's elements on its pins. */
#include <string.h>

#include "soft/soft.h"
#include "soft/solvers/external_forces.h"
#include "soft/solvers/reaction.h"

/* The search for a region's rotation begins at the previous rotation, which is state; this uses a copy. */
static void add_regions(const sbri_island_tick *t) {
  if (t->island->tetrahedra.block_count == 0)
    memset(t->scratch.element_forces, 0, t->island->slot_count * sizeof *t->scratch.element_forces);
  for (uint32_t b = 0; b < t->island->regions.block_count; b++) {
    float rotations[4 * SBRI_BLOCK];
    memcpy(rotations, t->solids.rotations + 4 * SBRI_BLOCK * (size_t)b, sizeof rotations);
    sbri_compute_region_block_forces(t, &t->island->regions.blocks[b], rotations);
  }
}

static void add(sbri_point *to, sbf_vec3 force) {
  to->x += force.x, to->y += force.y, to->z += force.z;
}

void sbri_pin_forces_find(const sbr_world *world, sbri_character *c, uint32_t index) {
  sbri_island now = sbri_island_now(c, &c->model->islands[index]);
  sbri_island_tick t = sbri_island_tick_of(world, c, index, &now);
  t.surfaces.external_rad_s = &now.stability.external_rad_s;
  t.scratch.begins = sbri_previous_positions(c) + now.first_slot, t.targets = t.positions;
  if (sbri_has_damping(&now)) sbri_copy_velocities_to_points(&t, 1 / t.tick_s);
  if (now.tetrahedra.block_count > 0) sbri_compute_tetrahedron_forces(&t, NULL);
  add_regions(&t);
  for (uint32_t i = 0; i < now.springs.pinned_count; i++) {
    sbf_vec3 force;
    uint32_t pinned = sbri_pinned_spring_force(&t, now.springs.pinned[i], &force);
    add(&t.scratch.element_forces[pinned], force);
  }
  if (!t.scratch.external_forces) return;
  sbri_compute_external_forces(&t, t.tick_s);
  for (uint32_t slot = now.free_count; slot < now.slot_count; slot++)
    add(&t.scratch.element_forces[slot],
        (sbf_vec3){t.scratch.external_forces[slot].x, t.scratch.external_forces[slot].y,
            t.scratch.external_forces[slot].z});
}
