#include "contact/contact_block.h"

#include <string.h>

#include "base/assert.h"
#include "math/vec3.h"

/* Of a body's size: a contact with a predicted gap of no more probably touches. */
static const float NEAR_FRACTION = 1e-3f;

/* m: farther than anything moves. */
static const float FAR_M = 1e30f;

/* Whether impulses of a contact end in nothing but points of the body, which row sums cover. */
static bool are_lanes(const sbri_soft_contact *contacts, uint32_t count) {
  for (uint32_t i = 0; i < count; i++)
    if (contacts[i].external_body || contacts[i].collider == SBRI_ITSELF) return false;
  return true;
}

float sbri_contact_friction_at(
    const sbri_island_tick *t, const sbri_body *body, const sbri_soft_contact *contact) {
  const sbri_sample *s = &contact->sample;
  if (contact->crosses) return 0;
  if (!body->frictions) return body->friction * contact->friction_scale;
  float sum = 0;
  if (contact->collider == SBRI_ITSELF) /* of the point alone */
    return s->slots[0] < t->island->free_count ? body->frictions[s->slots[0]] : body->friction;
  for (int k = 0; k < 4; k++) {
    bool free = s->slots[k] < t->island->free_count;
    sum += s->weights[k] * (free ? body->frictions[s->slots[k]] : body->friction);
  }
  return sum > 0 ? sum * contact->friction_scale : 0;
}

static void set3(float lanes[3][SBRI_BLOCK], uint32_t lane, sbf_vec3 v) {
  lanes[0][lane] = v.x, lanes[1][lane] = v.y, lanes[2][lane] = v.z;
}

static sbf_vec3 get3(const float lanes[3][SBRI_BLOCK], uint32_t lane) {
  return sbri_vec3(lanes[0][lane], lanes[1][lane], lanes[2][lane]);
}

static void fill_lane(const sbri_island_tick *t, const sbri_body *body, const sbri_soft_contact *contact,
    sbri_contact_block *block, uint32_t lane) {
  const sbri_island *island = t->island;
  const sbri_sample *s = &contact->sample;
  for (int k = 0; k < 4; k++) {
    uint32_t slot = s->slots[k];
    bool free = slot < island->free_count;
    block->slots[k][lane] = slot, block->weights[k][lane] = s->weights[k];
    block->responses[k][lane] = free ? s->weights[k] * island->inverse_masses[slot] * s->mass_kg : 0;
    t->contact_slots[slot / SBRI_BLOCK] = 1;
  }
  set3(block->normal, lane, contact->normal);
  set3(block->velocity, lane, contact->velocity);
  block->offset[lane] = contact->offset, block->mass_kg[lane] = s->mass_kg;
  block->friction[lane] = sbri_contact_friction_at(t, body, contact);
  block->restitution[lane] = contact->restitution;
  sbf_vec3 v = contact->velocity;
  block->moves = block->moves || v.x != 0 || v.y != 0 || v.z != 0;
  if (lane == 0 || contact->fast_m_s == 0) block->fast_m_s = contact->fast_m_s;
  if (block->fast_m_s > 0 && contact->fast_m_s > block->fast_m_s) block->fast_m_s = contact->fast_m_s;
}

static void fill_unused(sbri_contact_block *block, uint32_t lane) {
  for (int k = 0; k < 4; k++) block->slots[k][lane] = block->slots[k][0];
  block->offset[lane] = -FAR_M, block->contacts[lane] = UINT32_MAX;
}

void sbri_contact_blocks_fill(const sbri_island_tick *t, const sbri_body *body) {
  uint32_t count = sbri_soft_contact_count(t, body),
           *blocks = &t->contact_block_counts[body - t->model->bodies];
  const sbri_soft_contact *contacts = t->contacts + body->first_soft_contact;
  *blocks = 0;
  if (count == 0 || !are_lanes(contacts, count)) return;
  /* Contacts that probably touch are put into the same blocks, so that whole blocks of the others can be
   * skipped. */
  float near = NEAR_FRACTION * body->rest_size_m;
  uint32_t filled = 0;
  for (int far = 0; far < 2; far++)
    for (uint32_t i = 0; i < count; i++) {
      if ((contacts[i].gap > near) != far) continue;
      sbri_contact_block *block = sbri_contact_blocks_of(t, body) + filled / SBRI_BLOCK;
      if (filled % SBRI_BLOCK == 0) memset(block, 0, sizeof *block);
      block->contacts[filled % SBRI_BLOCK] = i;
      fill_lane(t, body, &contacts[i], block, filled++ % SBRI_BLOCK);
    }
  *blocks = (filled + SBRI_BLOCK - 1) / SBRI_BLOCK;
  for (; filled % SBRI_BLOCK; filled++)
    fill_unused(sbri_contact_blocks_of(t, body) + filled / SBRI_BLOCK, filled % SBRI_BLOCK);
}

void sbri_contact_blocks_unpack(const sbri_island_tick *t, const sbri_body *body) {
  uint32_t count = sbri_contact_block_count(t, body);
  for (uint32_t i = 0; i < count * SBRI_BLOCK; i++) {
    sbri_contact_block *block = sbri_contact_blocks_of(t, body) + i / SBRI_BLOCK;
    uint32_t lane = i % SBRI_BLOCK;
    if (block->contacts[lane] == UINT32_MAX) continue;
    sbri_soft_contact *contact = &t->contacts[body->first_soft_contact + block->contacts[lane]];
    contact->offset = block->offset[lane];
    contact->velocity_change = block->velocity_change[lane];
    contact->friction_impulse = get3((const float(*)[SBRI_BLOCK])block->friction_impulse, lane);
    contact->pushed = block->pushed[lane];
    contact->given = sbri_add(contact->given, get3((const float(*)[SBRI_BLOCK])block->given, lane));
    set3(block->given, lane, sbri_vec3(0, 0, 0));
  }
}

void sbri_contact_blocks_advance(const sbri_island_tick *t, const sbri_body *body, float step_s) {
  uint32_t count = sbri_contact_block_count(t, body);
  for (uint32_t b = 0; b < count; b++) {
    sbri_contact_block *block = sbri_contact_blocks_of(t, body) + b;
    for (uint32_t lane = 0; block->moves && lane < SBRI_BLOCK; lane++)
      block->offset[lane] += step_s * (block->normal[0][lane] * block->velocity[0][lane] +
                                          block->normal[1][lane] * block->velocity[1][lane] +
                                          block->normal[2][lane] * block->velocity[2][lane]);
  }
}
