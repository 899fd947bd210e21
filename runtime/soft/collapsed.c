/* Detects bodies that have collapsed permanently: it encloses almost no volume, or it rests in a false
 * equilibrium.
 *
 * In a false equilibrium little moves, yet elastic plus potential energy exceed those of the rest shape at
 * the pins. A body that comes to rest from its rest shape always has less. This test holds for pinned bodies
 * without ground contact or other loads. For loose bodies and bodies in contact only the elastic energy is
 * compared, with another bound, and only after motion so violent that they may have collapsed. */
#include <math.h>

#include "math/vec3.h"
#include "mechanics/neo_hookean.h"
#include "skin/skin.h"
#include "soft/soft.h"
#include "soft/solvers/rigid_motion.h"
#include "soft/solvers/scheme.h"

/* Fraction of its volume below which a body does not recover by itself. */
static const double COLLAPSED_FRACTION = 0.1;

/* A body whose kinetic energy is below this fraction of its excess energy counts as at rest, if it stays so
 * for as long as the caller waits. */
static const double MOVING_FRACTION = 0.2;

/* A body that loses a fifth of its energy between two checks is still recovering, at any speed. */
static const double STUCK_FRACTION = 0.8;

/* Bounds of the elastic energy, as fractions of that at a strain of 10 % in all elements. A collapsed body
 * has at least the first one if its loads are known, else the second. Above the third one, a strain of 14 %,
 * an island is unstable. */
static const double KNOT_FRACTION = 0.02, LOOSE_KNOT_FRACTION = 0.1, UNSTABLE_FRACTION = 2;

/* Penetration of the rest shape from which on pins press the body against the ground, as a fraction of its
 * size. */
static const float PRESSED_FRACTION = 0.01f;

/* Stiffness relative to rest from which on tetrahedra are checked. */
static const float STIFFENED = 2;

/* Whether the body has less than a fraction of its volume. For a body of tetrahedra, uses their volume: a
 * bent surface with few vertices encloses less than its lattice. That volume is computed only if the minimum
 * J allows it. */
static bool is_below(
    const sbri_character *c, const sbri_island *island, const sbri_body *body, float min, double fraction) {
  if (body->elements.tetrahedron_count && !island->tetrahedra.flow)
    return (double)min <= fraction && sbri_lattice_fraction(c, body) < fraction;
  return body->surface.rest_volume_m3 > 0 &&
         sbri_surface_volume(c, body, sbri_positions(c)) < fraction * body->surface.rest_volume_m3;
}

static bool is_any_below(const sbri_character *c, const sbri_island *island, float min, double fraction) {
  for (uint32_t b = 0; b < island->body_count; b++)
    if (is_below(c, island, &c->model->bodies[island->bodies[b]], min, fraction)) return true;
  return false;
}

/* ---- Energies, J ---- */

/* Kinetic energy relative to the drivers, or to the rigid motion of a body without pins. */
static double kinetic_of(const sbri_character *c, const sbri_island *island) {
  const float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const float *drivers = sbri_driver_velocities(c) + 3 * (size_t)island->first_slot;
  const sbri_point *positions = sbri_positions(c) + island->first_slot;
  double energy = 0;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    sbri_rigid_motion rigid = {0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0}};
    if (!body->is_pinned) rigid = sbri_rigid_motion_find(island, body, positions, velocities);
    for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) {
      uint32_t at = 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
      const sbri_point *p = &positions[slot];
      sbf_vec3 v = {velocities[at], velocities[at + SBRI_BLOCK], velocities[at + 2 * SBRI_BLOCK]};
      sbf_vec3 reference = {drivers[at], drivers[at + SBRI_BLOCK], drivers[at + 2 * SBRI_BLOCK]};
      if (!body->is_pinned)
        reference = sbri_add(rigid.velocity,
            sbri_cross(rigid.angular_velocity, sbri_sub(sbri_vec3(p->x, p->y, p->z), rigid.center)));
      sbf_vec3 relative = sbri_sub(v, reference);
      energy += 0.5 * (double)island->masses[slot] * (double)sbri_dot(relative, relative);
    }
  }
  return energy;
}

/* Elastic energy at present and at a strain of 10 % in all elements; volume times bulk modulus. */
typedef struct elastic {
  double now_j, tenth_j, bulk_j;
} elastic;

static void add_tetrahedra(const sbri_body *body, const sbri_point *positions, elastic *sum) {
  for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
    sbfi_tetrahedron element;
    sbfi_d3 x[4];
    if (!sbri_body_tetrahedron(body, t, &element)) continue;
    for (int k = 0; k < 4; k++) {
      const sbri_point *p = &positions[body->slots.from_point[body->level->lattice.tetrahedra.at[t].at[k]]];
      x[k] = (sbfi_d3){p->x, p->y, p->z};
    }
    sum->now_j += sbfi_tetrahedron_energy(&element, x);
    sum->tenth_j += 0.01 * element.volume * element.lame.mu;
    sum->bulk_j += element.volume * (element.lame.lambda - element.lame.mu / 3);
  }
}

static void add_regions(
    const sbri_island *island, const sbri_body *body, const sbri_point *positions, elastic *sum) {
  for (uint32_t b = body->elements.first_region_block; b < body->elements.region_block_end; b++) {
    const sbri_region_block *block = &island->regions.blocks[b];
    const sbri_region_member *members = island->regions.members + block->first_member;
    for (uint32_t lane = 0; lane < SBRI_BLOCK && block->inverse_sums[lane] > 0; lane++) {
      sbri_region_measure(block, members, lane, positions, &sum->now_j);
      for (uint32_t i = 0; i < block->member_count; i++) {
        const float *r[3] = {members[i].offsets[0], members[i].offsets[1], members[i].offsets[2]};
        double square = (double)(r[0][lane] * r[0][lane] + r[1][lane] * r[1][lane] + r[2][lane] * r[2][lane]);
        sum->tenth_j += 0.005 * (double)members[i].stiffness[lane] * square;
      }
    }
  }
}

static elastic elastic_of(const sbri_character *c, const sbri_island *island, const sbri_point *positions) {
  elastic sum = {sbfi_springs_energy(island->springs.at, island->springs.count, &positions->x, 4), 0, 0};
  for (uint32_t i = 0; i < island->springs.count; i++) {
    double tenth = 0.1 * island->springs.at[i].rest_length_m;
    sum.tenth_j += 0.5 * island->springs.at[i].stiffness_n_m * tenth * tenth;
  }
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    add_tetrahedra(body, positions, &sum);
    add_regions(island, body, positions, &sum);
  }
  return sum;
}

static double weight_of(const sbri_island *island, const sbri_point *positions, sbf_vec3 g) {
  double energy = 0;
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    const sbri_point *p = &positions[slot];
    double weight = (double)island->masses[slot] * (double)island->gravity_scales[slot];
    energy -= weight * ((double)g.x * p->x + (double)g.y * p->y + (double)g.z * p->z);
  }
  return energy;
}

/* ---- False equilibria ---- */

static bool is_on_ground(const sbri_character *c, const sbri_island *island) {
  for (uint32_t b = 0; b < island->body_count; b++)
    if (c->model->bodies[island->bodies[b]].contact.samples && sbri_contact_counts(c)[island->bodies[b]])
      return true;
  const uint8_t *near_ground = sbri_near_ground(c) + island->first_slot / SBRI_BLOCK;
  for (uint32_t block = 0; block < island->free_count / SBRI_BLOCK; block++)
    if (near_ground[block]) return true;
  return false;
}

/* Whether contacts push the body from opposite sides, as between walls that close. Then the contacts explain
 * the strain, and the rest shape would penetrate the walls. */
static bool is_squeezed(const sbri_character *c, const sbri_island *island) {
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_soft_contact *contacts = sbri_contacts(c) + c->model->bodies[island->bodies[b]].contact.first;
    uint32_t count = sbri_contact_counts(c)[island->bodies[b]];
    sbf_vec3 low = {0, 0, 0}, high = {0, 0, 0};
    for (uint32_t i = 0; i < count; i++) {
      sbf_vec3 n = contacts[i].normal;
      if (!(contacts[i].max_velocity_change > 0) || contacts[i].collider == SBRI_ITSELF) continue;
      low = (sbf_vec3){fminf(low.x, n.x), fminf(low.y, n.y), fminf(low.z, n.z)};
      high = (sbf_vec3){fmaxf(high.x, n.x), fmaxf(high.y, n.y), fmaxf(high.z, n.z)};
    }
    if ((low.x < -0.5f && high.x > 0.5f) || (low.y < -0.5f && high.y > 0.5f) ||
        (low.z < -0.5f && high.z > 0.5f))
      return true;
  }
  return false;
}

/* Whether pins press the body against something that its rest shape would penetrate. */
static bool is_pressed_by_pins(const sbri_character *c, const sbri_island *island) {
  sbri_point *rest = sbri_begins(c) + island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    if (!body->is_pinned) continue;
    float max = PRESSED_FRACTION * body->rest_size_m;
    sbri_compute_driver_positions(c->model, body, sbri_deltas(c), rest + body->slots.begin);
    sbri_compute_pin_targets(island, sbri_deltas(c), rest);
    const sbri_soft_contact *contacts = sbri_contacts(c) + body->contact.first;
    for (uint32_t i = 0; i < sbri_contact_counts(c)[island->bodies[b]]; i++) {
      sbf_vec3 at = {0, 0, 0};
      for (int k = 0; k < 4; k++) {
        const sbri_point *p = &rest[contacts[i].sample.slots[k]];
        at = sbri_add_scaled(at, sbri_vec3(p->x, p->y, p->z), contacts[i].sample.weights[k]);
      }
      if (contacts[i].collider != SBRI_ITSELF && contacts[i].offset - sbri_dot(contacts[i].normal, at) > max)
        return true;
    }
    const float *planes = sbri_planes(c) + 4 * (size_t)island->first_slot;
    const uint8_t *near_ground = sbri_near_ground(c) + island->first_slot / SBRI_BLOCK;
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
      if (!near_ground[slot / SBRI_BLOCK]) continue;
      const float *plane = planes + 4 * (size_t)(slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
      sbf_vec3 n = {plane[0], plane[SBRI_BLOCK], plane[2 * SBRI_BLOCK]};
      const sbri_point *p = &rest[slot];
      if (plane[3 * SBRI_BLOCK] - sbri_dot(n, sbri_vec3(p->x, p->y, p->z)) > max) return true;
    }
  }
  return false;
}

static bool is_fully_pinned(const sbri_character *c, const sbri_island *island) {
  for (uint32_t b = 0; b < island->body_count; b++)
    if (!c->model->bodies[island->bodies[b]].is_pinned) return false;
  return true;
}

/* Energy of the rest shape at the present pins. It is above 0 for springs that cannot all have their rest
 * lengths. */
static double rest_energy(const sbri_character *c, const sbri_island *island, sbf_vec3 g) {
  sbri_point *rest = sbri_begins(c) + island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    sbri_compute_driver_positions(c->model, body, sbri_deltas(c), rest + body->slots.begin);
  }
  sbri_compute_pin_targets(island, sbri_deltas(c), rest);
  return elastic_of(c, island, rest).now_j + weight_of(island, rest, g);
}

/* Force of an acceleration (or the weight) of the island, times the size of its largest body, J. */
static double load_of(
    const sbri_character *c, const sbri_island *island, float acceleration, bool is_weight) {
  double mass = 0, size = 0;
  for (uint32_t slot = 0; slot < island->free_count; slot++)
    mass += (double)(island->masses[slot] * (is_weight ? fabsf(island->gravity_scales[slot]) : 1));
  for (uint32_t b = 0; b < island->body_count; b++)
    size = fmax(size, (double)c->model->bodies[island->bodies[b]].rest_size_m);
  return mass * (double)acceleration * size;
}

/* Bound of the elastic energy under the load. A column strained by e has m g l e / 4, and 100 e^2 times its
 * energy at a strain of 10 %. The bound is four times that, since no body is a column. */
static double load_energy_bound(double load_j, double tenth_j) {
  return tenth_j > 0 ? load_j * load_j / (400 * tenth_j) : 0;
}

/* Whether an element is crushed and weight cannot be the cause. Its pressure compresses by load / bulk, or
 * four times that if a corner supports it. */
static bool is_crushed(const sbri_island_state *state, double load_j, double bulk_j) {
  return state->min_ratio < SBRI_CRUSHED_RATIO && 4 * load_j < (1 - (double)SBRI_CRUSHED_RATIO) * bulk_j;
}

/* Springs are checked every time. Other elements cost as much to check as a substep, so they are checked only
 * while they are unstable or their steps indicate it. A body may be crushed with little energy, for example
 * after a pin has jumped over its neighbours. */
static bool is_checked(const sbri_island *island, const sbri_island_state *state) {
  if (island->scheme->forceless || island->links.flows || island->tetrahedra.flow) return false;
  return state->unstable || island->tetrahedra.block_count == 0 || state->stiffening > STIFFENED ||
         state->min_ratio < SBRI_CRUSHED_RATIO;
}

/* Whether loads, known or unknown, may explain any strain. */
static bool is_forced(const sbri_character *c, uint32_t index) {
  const sbri_island *island = &c->model->islands[index];
  return is_squeezed(c, island) || is_pressed_by_pins(c, island) || sbri_island_is_loaded(c, index);
}

bool sbri_is_inside_out(const sbri_character *c, uint32_t index) {
  const sbri_island *island = &c->model->islands[index];
  return !island->scheme->forceless && is_any_below(c, island, sbri_island_states(c)[index].min_ratio, 0) &&
         is_forced(c, index);
}

sbri_shape sbri_shape_of(const sbr_world *world, const sbri_character *c, uint32_t index) {
  const sbri_island *island = &c->model->islands[index];
  const sbri_point *positions = sbri_positions(c) + island->first_slot;
  const sbri_island_state *state = &sbri_island_states(c)[index];
  bool unstable = state->unstable;
  if (is_forced(c, index))
    return (sbri_shape){.unstable = unstable, .inside_out = sbri_is_inside_out(c, index)};
  if (!(state->min_ratio > 0) || is_any_below(c, island, state->min_ratio, COLLAPSED_FRACTION))
    return (sbri_shape){.collapsed = true, .heaped = true, .unstable = true};
  if (!is_checked(island, state)) return (sbri_shape){.collapsed = false};
  elastic elements = elastic_of(c, island, positions);
  double excess = elements.now_j, min = KNOT_FRACTION * elements.tenth_j;
  bool is_reported =
      !island->stability.has_external_forces && is_fully_pinned(c, island) && !is_on_ground(c, island);
  sbf_vec3 g = world->has_gravity ? world->gravity : c->model->asset->environment.gravity;
  if (is_reported)
    excess += weight_of(island, positions, g) - rest_energy(c, island, g);
  else
    excess -= rest_energy(c, island, (sbf_vec3){0, 0, 0}), min = LOOSE_KNOT_FRACTION * elements.tenth_j;
  double inertial = load_of(c, island, state->recovery.acceleration_m_s2, false);
  double accelerated = load_energy_bound(inertial, elements.tenth_j);
  double load = is_reported ? 0 : load_of(c, island, sbri_length(g), true);
  if (!is_reported && !is_crushed(state, load, elements.bulk_j))
    min += load_energy_bound(load, elements.tenth_j);
  bool strained = excess > min, is_knotted = excess > min + accelerated;
  bool stuck = excess > STUCK_FRACTION * (double)state->excess_j;
  sbri_shape shape = {.is_reported = is_reported,
      .excess_j = (float)excess,
      .heaped = excess > UNSTABLE_FRACTION * elements.tenth_j};
  shape.crushed = is_reported && state->min_ratio < SBRI_CRUSHED_RATIO;
  shape.unstable = shape.heaped || (unstable && strained);
  shape.collapsed = is_knotted && stuck &&
                    (is_reported || (unstable && !island->stability.has_external_forces)) &&
                    kinetic_of(c, island) < MOVING_FRACTION * excess;
  return shape;
}
