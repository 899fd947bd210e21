/* Sleep: a soft body that has come to rest is not stepped.
 *
 * A group of bodies falls asleep after sleep_after_s during which all its points were slower than a fraction
 * of its size a second and no pin moved. Its velocities become 0 and its positions stay. It wakes as soon as
 * a pin moves or the ground under it changes. */
#include <string.h>

#include "base/hash64.h"
#include "math/vec3.h"
#include "shapes/ground.h"
#include "soft/soft.h"
#include "soft/solvers/scheme.h"

/* Fraction of its size per second below which a body is at rest. */
static const float IDLE_1_S = 0.01f;

/* Displacement of a pin that does not wake a body, as a fraction of the character's size. */
static const float PIN_TOLERANCE = 1e-5f;

/* Number of ticks between two checks of a ground that the host may change. */
enum { CHECK_INTERVAL = 4 };

static bool is_idle(const sbri_character *c, const sbri_island *island) {
  const float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    float max = IDLE_1_S * body->rest_size_m;
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
      const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
      float square = v[0] * v[0] + v[SBRI_BLOCK] * v[SBRI_BLOCK] + v[2 * SBRI_BLOCK] * v[2 * SBRI_BLOCK];
      if (!(square <= max * max)) return false;
    }
  }
  return true;
}

/* Whether pin targets differ from the pinned positions by more than the tolerance. */
static bool have_pins_moved(sbri_character *c, const sbri_island *island) {
  const sbri_point *pinned = sbri_positions(c) + island->first_slot;
  sbri_point *targets = sbri_targets(c) + island->first_slot;
  float max = PIN_TOLERANCE * c->model->rest_size_m;
  sbri_compute_pin_targets(island, sbri_deltas(c), targets);
  for (uint32_t slot = island->free_count; slot < island->slot_count; slot++) {
    sbf_vec3 offset = {
        targets[slot].x - pinned[slot].x, targets[slot].y - pinned[slot].y, targets[slot].z - pinned[slot].z};
    if (!(sbri_dot(offset, offset) <= max * max)) return true;
  }
  return false;
}

/* Hash of the contact planes found last, of points near the ground and of samples. */
static uint32_t ground_mark(const sbri_character *c, const sbri_island *island) {
  const uint8_t *near_ground = sbri_near_ground(c) + island->first_slot / SBRI_BLOCK;
  const float *planes = sbri_planes(c) + 4 * (size_t)island->first_slot;
  sbfi_hash64 hash;
  sbfi_hash64_init(&hash);
  sbfi_hash64_add_bytes(&hash, near_ground, island->free_count / SBRI_BLOCK);
  for (uint32_t block = 0; block < island->free_count / SBRI_BLOCK; block++)
    if (near_ground[block])
      sbfi_hash64_add_f32(&hash, planes + (size_t)block * 4 * SBRI_BLOCK, 4 * SBRI_BLOCK);
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    uint32_t count = sbri_contact_counts(c)[island->bodies[b]];
    for (uint32_t i = 0; i < count; i++) {
      const sbri_soft_contact *contact = &sbri_contacts(c)[body->contact.first + i];
      sbfi_hash64_add_f32(&hash, &contact->normal.x, 3);
      sbfi_hash64_add_f32(&hash, &contact->offset, 1);
      sbfi_hash64_add_f32(&hash, &contact->velocity.x, 3);
    }
  }
  return (uint32_t)sbfi_hash64_value(&hash);
}

/* Hash of the contact planes at present. */
static uint32_t find_ground_mark(const sbr_world *world, sbri_character *c, uint32_t index) {
  sbri_island_find_contacts(world, c, index);
  return ground_mark(c, &c->model->islands[index]);
}

bool sbri_island_sleeps(const sbr_world *world, sbri_character *c, uint32_t index) {
  const sbri_island *island = &c->model->islands[index];
  sbri_island_state *state = &sbri_island_states(c)[index];
  if (!state->asleep) return false;
  bool checks = world->colliders.is_moving ||
                (!sbri_ground_is_fixed(&c->ground) && (world->time.ticks + index) % CHECK_INTERVAL == 0);
  if (!have_pins_moved(c, island) && !(checks && find_ground_mark(world, c, index) != state->ground_mark))
    return true;
  sbri_island_wake(c, index);
  return false;
}

bool sbri_island_is_idle(const sbri_character *c, uint32_t index) {
  const sbri_island_state *state = &sbri_island_states(c)[index];
  const sbri_island *island = &c->model->islands[index];
  return !state->recovery.ticks && !sbri_island_is_loaded(c, index) && !state->collapsed_ticks &&
         !state->unstable && sbri_drivers_rest(c, island) && sbri_tears_of(c)[index].count == 0 &&
         is_idle(c, island);
}

void sbri_island_put_to_sleep(const sbr_world *world, sbri_character *c, uint32_t index) {
  const sbri_island *island = &c->model->islands[index];
  sbri_island_state *state = &sbri_island_states(c)[index];
  state->asleep = 1;
  memset(
      sbri_velocities(c) + 3 * (size_t)island->first_slot, 0, 3 * (size_t)island->free_count * sizeof(float));
  state->ground_mark = find_ground_mark(world, c, index);
}

void sbri_island_update_sleep(const sbr_world *world, sbri_character *c, uint32_t index) {
  sbri_island_state *state = &sbri_island_states(c)[index];
  if (!world->sleep_ticks || c->model->islands[index].scheme->forceless) return;
  state->idle_ticks = sbri_island_is_idle(c, index) ? state->idle_ticks + 1 : 0;
  if (state->idle_ticks >= world->sleep_ticks) sbri_island_put_to_sleep(world, c, index);
}
