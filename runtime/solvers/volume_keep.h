/* Keeping the volume within a body's surface, for pressure mode `volume`. Written for the lanes of the file
 * that includes it; see kernels/kernels.h.
 *
 * The constraint V(x) = V0, by one Newton step a substep: dx_i = s w_i g_i with g the gradient of the volume,
 * w the inverse masses and s = (V0 - V) / sum w_i |g_i|^2 (Hong, Jung, Choi and Welch, Fast Volume
 * Preservation for a Mass-Spring System, 2006, use the same multiplier). It holds whatever pressure that
 * takes, and needs no more substeps, as a bulk modulus would. What a step leaves is of second order in the
 * step.
 *
 * Bias against the energy: none in the volume; the multiplier acts along the gradient at the end of the
 * substep instead of its beginning, which is of first order in h. */
#ifndef SBRI_VOLUME_KEEP_H
#define SBRI_VOLUME_KEEP_H

#include "skin/skin_lanes.h"
#include "solvers/island_tick.h"

/* No more than this share of the volume is regained in a substep: a body turned inside out comes back slowly.
 */
#define SBRI_MOST_VOLUME_SHARE 0.1f

/* Gradients of the volume at the body's slots, and the sum of w |g|^2. */
static inline float sbri_volume_gradients(
    const sbri_island_tick *t, const sbri_body *body, const sbri_point *faces) {
  float lanes[SBRI_BLOCK] = {0};
  for (uint32_t slot = body->slot_begin; slot < body->slot_end; slot += SBRI_LANES) {
    uint32_t lane = slot % SBRI_BLOCK, block = (slot - body->slot_begin) / SBRI_BLOCK;
    sbri_wide3 g = {sbri_wide_all(0), sbri_wide_all(0), sbri_wide_all(0)};
    for (uint32_t c = body->volume_begins[block]; c < body->volume_begins[block + 1]; c++) {
      const sbri_carry_cell *cell = &body->volume_cells[c];
      sbri_wide3 n = sbri_wide_gather(faces, cell->slots + lane);
      sbri_wide w = sbri_wide_load(cell->weights + lane);
      g.x = g.x + w * n.x;
      g.y = g.y + w * n.y;
      g.z = g.z + w * n.z;
    }
    sbri_wide_store_points(t->velocity_points + slot, g);
    sbri_wide w = sbri_wide_load(t->island->inverse_masses + slot);
    sbri_wide_store(lanes + lane, sbri_wide_load(lanes + lane) + w * (g.x * g.x + g.y * g.y + g.z * g.z));
  }
  return sbri_tree_sum(lanes);
}

/* At the end of a substep of `h` seconds: moves the body's free points along the gradient of the volume, by
 * their inverse masses, until the rest volume is enclosed again, and changes their velocities by as much per
 * second. Momentum is kept. */
static inline void sbri_volume_keep(const sbri_island_tick *t, const sbri_body *body, float h) {
  const sbri_skin *skin = &body->surface;
  sbri_point *vertices = t->positions, *faces = t->surface_faces + body->first_face;
  const sbri_face_block *named = body->volume_faces;
  if (!named) {
    vertices = t->surface_vertices + body->first_vertex;
    named = skin->faces;
    sbri_lanes_vertices(skin, t->positions - t->island->first_slot, vertices);
  }
  float rest = (float)body->rest_volume_m3, most = SBRI_MOST_VOLUME_SHARE * rest;
  float missing = rest - sbri_lanes_volume(named, skin->face_block_count, vertices, faces);
  float sum = sbri_volume_gradients(t, body, faces);
  if (!(sum > 0) || !(missing - missing == 0)) return;
  float s = (missing > most ? most : missing < -most ? -most : missing) / sum, rate = 1 / h;
  for (uint32_t slot = body->slot_begin; slot < body->slot_end; slot += SBRI_LANES) {
    float *velocity = t->velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    sbri_wide3 g = sbri_wide_load_points(t->velocity_points + slot),
               x = sbri_wide_load_points(t->positions + slot);
    sbri_wide k = sbri_wide_all(s) * sbri_wide_load(t->island->inverse_masses + slot),
              r = sbri_wide_all(rate);
    g.x = k * g.x, g.y = k * g.y, g.z = k * g.z;
    sbri_wide_store_points(t->positions + slot, (sbri_wide3){x.x + g.x, x.y + g.y, x.z + g.z});
    sbri_wide_store(velocity, sbri_wide_load(velocity) + r * g.x);
    sbri_wide_store(velocity + SBRI_BLOCK, sbri_wide_load(velocity + SBRI_BLOCK) + r * g.y);
    sbri_wide_store(velocity + 2 * SBRI_BLOCK, sbri_wide_load(velocity + 2 * SBRI_BLOCK) + r * g.z);
  }
}

#endif
