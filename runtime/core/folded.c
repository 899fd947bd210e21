/* Whether a body has lost its shape for good: it encloses next to nothing, or it rests in a knot.
 *
 * A knot: little moves, and yet the springs and the weight hold more energy than they would in the rest
 * shape where the body is held. Whatever comes to rest from its rest shape holds less. Looked for where that
 * can be told: in bodies of springs that something holds, that touch no ground, and on which nothing else
 * acts. */
#include "core/world.h"
#include "skin/skin.h"
#include "solvers/scheme.h"

/* A surface that holds less than this share of its volume will not come back by itself. */
static const double FOLDED_SHARE = 0.1;

/* With less of its energy than this in its motion, for as long as the caller waits, a body rests in what it
 * is. */
static const double MOVING_SHARE = 0.1;

/* A knot holds so much of what all springs strained by a tenth would. */
static const double KNOT_SHARE = 0.02;

static bool encloses_nothing(const sbri_character *c, const sbri_island *island) {
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    if (!(body->rest_volume_m3 > 0)) continue;
    if (sbri_surface_volume(c, body, sbri_positions(c)) < FOLDED_SHARE * body->rest_volume_m3) return true;
  }
  return false;
}

/* Against what holds it, J. */
static double kinetic_of(const sbri_character *c, const sbri_island *island) {
  const float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const float *guides = sbri_guide_velocities(c) + 3 * (size_t)island->first_slot;
  double energy = 0;
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    uint32_t at = 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    double square = 0;
    for (uint32_t k = 0; k < 3; k++, at += SBRI_BLOCK) {
      double off = (double)velocities[at] - (double)guides[at];
      square += off * off;
    }
    energy += 0.5 * (double)island->masses[slot] * square;
  }
  return energy;
}

static bool may_be_told(const sbri_character *c, const sbri_island *island) {
  if (island->scheme->forceless || island->link_flows || island->has_outer ||
      island->tetrahedron_block_count > 0)
    return false;
  for (uint32_t b = 0; b < island->body_count; b++)
    if (!c->model->bodies[island->bodies[b]].held) return false;
  for (uint32_t b = 0; b < island->body_count; b++)
    if (c->model->bodies[island->bodies[b]].samples && sbri_touch_counts(c)[island->bodies[b]]) return false;
  const uint8_t *near_ground = sbri_near_ground(c) + island->first_slot / SBRI_BLOCK;
  for (uint32_t block = 0; block < island->free_count / SBRI_BLOCK; block++)
    if (near_ground[block]) return false;
  return true;
}

/* Of springs and weight, J. */
static double energy_of(const sbri_island *island, const sbri_point *positions, sbf_vec3 g) {
  double energy = sbfi_springs_energy(island->springs, island->spring_count, &positions->x, 4);
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    const sbri_point *p = &positions[slot];
    double weight = (double)island->masses[slot] * (double)island->gravity_scales[slot];
    energy -= weight * ((double)g.x * p->x + (double)g.y * p->y + (double)g.z * p->z);
  }
  return energy;
}

static bool is_knotted(const sbr_world *world, const sbri_character *c, const sbri_island *island) {
  sbf_vec3 g = world->has_gravity ? world->gravity : c->model->asset->environment.gravity;
  sbri_point *rest = sbri_begins(c) + island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    sbri_guide_places(c->model, body, sbri_deltas(c), rest + body->slot_begin);
  }
  sbri_held_places(island, sbri_deltas(c), rest);
  double scale = 0;
  for (uint32_t i = 0; i < island->spring_count; i++) {
    double tenth = 0.1 * island->springs[i].rest_length_m;
    scale += 0.5 * island->springs[i].stiffness_n_m * tenth * tenth;
  }
  double more = energy_of(island, sbri_positions(c) + island->first_slot, g) - energy_of(island, rest, g);
  return more > KNOT_SHARE * scale && kinetic_of(c, island) < MOVING_SHARE * more;
}

bool sbri_is_folded(const sbr_world *world, const sbri_character *c, uint32_t index) {
  const sbri_island *island = &c->model->islands[index];
  if (!(sbri_island_states(c)[index].least_ratio > 0) || encloses_nothing(c, island)) return true;
  return may_be_told(c, island) && is_knotted(world, c, island);
}
