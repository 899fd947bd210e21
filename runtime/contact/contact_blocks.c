#include "contact/contact_block.h"

#include <math.h>
#include <string.h>

#include "contact/contact.h"
#include "contact/sample_motion.h"

/* Fraction of the body's size. A contact with a smaller gap at the end of the tick probably touches. */
static const float NEAR_FRACTION = 1e-3f;

/* m; farther than anything moves */
static const float FAR_M = 1e30f;

/* Whether contact impulses act on points of the body only, as row sums require. */
static bool have_only_plane_contacts(const sbri_soft_contact *contacts, uint32_t count) {
  for (uint32_t i = 0; i < count; i++)
    if (contacts[i].external_body || contacts[i].collider == SBRI_ITSELF) return false;
  return true;
}

float sbri_contact_friction_at(
    const sbri_island_tick *t, const sbri_body *body, const sbri_soft_contact *contact) {
  const sbri_sample *s = &contact->sample;
  if (contact->is_crossed) return 0;
  if (!body->contact.frictions) return body->contact.friction * contact->friction_scale;
  float sum = 0;
  if (contact->collider == SBRI_ITSELF) /* that of the point only */
    return s->slots[0] < t->island->free_count ? body->contact.frictions[s->slots[0]]
                                               : body->contact.friction;
  for (int k = 0; k < 4; k++) {
    bool free = s->slots[k] < t->island->free_count;
    sum += s->weights[k] * (free ? body->contact.frictions[s->slots[k]] : body->contact.friction);
  }
  return sum > 0 ? sum * contact->friction_scale : 0;
}

static void set3(float lanes[3][SBRI_BLOCK], uint32_t lane, sbf_vec3 v) {
  lanes[0][lane] = v.x, lanes[1][lane] = v.y, lanes[2][lane] = v.z;
}

static sbf_vec3 get3(float lanes[3][SBRI_BLOCK], uint32_t lane) {
  return sbri_vec3(lanes[0][lane], lanes[1][lane], lanes[2][lane]);
}

static void fill_lane(const sbri_island_tick *t, const sbri_body *body, const sbri_soft_contact *contact,
    sbri_contact_block *block, uint32_t lane) {
  const sbri_island *island = t->island;
  const sbri_sample *s = &contact->sample;
  for (int k = 0; k < 4; k++) {
    uint32_t slot = s->slots[k];
    bool free = slot < island->free_count;
    block->sample.slots[k][lane] = slot, block->sample.weights[k][lane] = s->weights[k];
    block->sample.responses[k][lane] = free ? s->weights[k] * island->inverse_masses[slot] * s->mass_kg : 0;
    t->contacts.slots[slot / SBRI_BLOCK] = 1;
  }
  float weight_sum =
      fabsf(s->weights[0]) + fabsf(s->weights[1]) + fabsf(s->weights[2]) + fabsf(s->weights[3]);
  block->max_weight_sum = fmaxf(block->max_weight_sum, weight_sum);
  set3(block->normal, lane, contact->normal);
  set3(block->velocity, lane, contact->velocity);
  block->offset[lane] = contact->offset, block->sample.mass_kg[lane] = s->mass_kg;
  block->friction[lane] = sbri_contact_friction_at(t, body, contact);
  block->restitution[lane] = contact->restitution;
  sbf_vec3 v = contact->velocity;
  block->is_moving = block->is_moving || v.x != 0 || v.y != 0 || v.z != 0;
}

static void fill_unused(sbri_contact_block *block, uint32_t lane) {
  for (int k = 0; k < 4; k++) block->sample.slots[k][lane] = block->sample.slots[k][0];
  block->offset[lane] = -FAR_M, block->contacts[lane] = UINT32_MAX;
}

void sbri_contact_blocks_fill(const sbri_island_tick *t, const sbri_body *body) {
  uint32_t count = sbri_soft_contact_count(t, body), filled = 0;
  const sbri_soft_contact *contacts = t->contacts.at + body->contact.first;
  sbri_contact_block *blocks = sbri_contact_blocks_of(t, body);
  float near = NEAR_FRACTION * body->rest_size_m;
  t->contacts.block_counts[body - t->model->bodies] = 0;
  if (count > body->contact.max_blocks * SBRI_BLOCK || !have_only_plane_contacts(contacts, count)) return;
  /* Contacts that probably touch share blocks, so that other blocks are idle as a whole. */
  for (int pass = 0; pass < 2; pass++)
    for (uint32_t i = 0; i < count; i++) {
      sbri_contact_block *block = &blocks[filled / SBRI_BLOCK];
      uint32_t lane = filled % SBRI_BLOCK;
      bool is_far = contacts[i].gap > near;
      if (is_far != pass) continue;
      if (lane == 0) memset(block, 0, sizeof *block);
      block->contacts[lane] = i;
      fill_lane(t, body, &contacts[i], block, lane);
      filled++;
    }
  for (; filled % SBRI_BLOCK; filled++) fill_unused(&blocks[filled / SBRI_BLOCK], filled % SBRI_BLOCK);
  t->contacts.block_counts[body - t->model->bodies] = filled / SBRI_BLOCK;
}

void sbri_contact_blocks_unpack(const sbri_island_tick *t, const sbri_body *body) {
  uint32_t count = sbri_contact_block_count(t, body);
  for (uint32_t i = 0; i < count * SBRI_BLOCK; i++) {
    sbri_contact_block *block = sbri_contact_blocks_of(t, body) + i / SBRI_BLOCK;
    uint32_t lane = i % SBRI_BLOCK;
    if (block->contacts[lane] == UINT32_MAX) continue;
    sbri_soft_contact *contact = &t->contacts.at[body->contact.first + block->contacts[lane]];
    contact->offset = block->offset[lane];
    contact->velocity_change = block->velocity_change[lane];
    contact->friction_impulse = get3(block->friction_impulse, lane);
    contact->max_velocity_change = block->of_tick.max_velocity_change[lane],
    contact->closing_speed = block->of_tick.closing_speed[lane];
    contact->total_velocity_change =
        sbri_add(contact->total_velocity_change, get3(block->of_tick.velocity_change, lane));
    set3(block->of_tick.velocity_change, lane, sbri_vec3(0, 0, 0));
  }
}

static void advance_lane(sbri_contact_block *block, uint32_t lane, float step_s) {
  sbri_pressing before = {
      block->pressing.velocity_change[lane], block->pressing.time_s[lane], block->pressing.deficit[lane]};
  sbri_pressing now =
      sbri_pressing_add(before, block->velocity_change[lane], block->of_tick.closing_speed[lane], step_s);
  block->pressing.velocity_change[lane] = now.velocity_change, block->pressing.time_s[lane] = now.time_s;
  block->pressing.deficit[lane] = now.deficit;
}

void sbri_contact_blocks_advance(const sbri_island_tick *t, const sbri_body *body, float step_s) {
  uint32_t count = sbri_contact_block_count(t, body);
  for (uint32_t b = 0; b < count; b++) {
    sbri_contact_block *block = sbri_contact_blocks_of(t, body) + b;
    for (uint32_t lane = 0; block->is_near && block->has_impulses && lane < SBRI_BLOCK; lane++)
      advance_lane(block, lane, step_s);
    for (uint32_t lane = 0; block->is_moving && lane < SBRI_BLOCK; lane++)
      block->offset[lane] += step_s * sbri_dot(get3(block->normal, lane), get3(block->velocity, lane));
  }
}
