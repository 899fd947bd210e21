/* The tetrahedra of an island: moduli, then blocks of eight. */
#include <string.h>

#include "mechanics/neo_hookean.h"
#include "prepare/island_maker.h"

static bool acts(const sbri_body *body) {
  return body->level->model == SBF_ELASTIC_MODEL_TETRAHEDRA;
}

bool sbri_tetrahedra_list(sbri_island_maker *m) {
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    sbri_body *body = sbri_maker_body(m, b);
    body->elements.first_tetrahedron = m->island->tetrahedra.count;
    if (!acts(body)) continue;
    uint32_t count = body->level->lattice.tetrahedra.count;
    float *moduli = sbri_model_allocate(m, count, sizeof *moduli),
          *ratios = sbri_model_allocate(m, count, sizeof *ratios);
    float *factors = sbri_scratch(m, body->level->positions.count, sizeof *factors);
    if (!moduli || !ratios || !factors) return false;
    sbf_level_moduli(body->source, body->level, factors, moduli);
    for (uint32_t t = 0; t < count; t++) ratios[t] = body->source->attributes.poisson_ratio;
    body->elements.moduli = moduli, body->elements.poisson_ratios = ratios;
    body->elements.tetrahedron_count = count;
    m->island->tetrahedra.count += count;
  }
  return true;
}

bool sbri_tetrahedra_network(sbri_island_maker *m, sbf_spring_network *network) {
  uint32_t count = m->island->tetrahedra.count;
  sbf_uint4 *corners = sbri_scratch(m, count, sizeof *corners);
  float *moduli = sbri_scratch(m, count, sizeof *moduli), *ratios = sbri_scratch(m, count, sizeof *ratios);
  if (!corners || !moduli || !ratios) return false;
  network->tetrahedron_count = count;
  network->tetrahedra = corners, network->young_modulus = moduli, network->poisson_ratios = ratios;
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
      for (int k = 0; k < 4; k++)
        corners->at[k] = body->slots.from_point[body->level->lattice.tetrahedra.at[t].at[k]];
      corners++;
      *moduli++ = body->elements.moduli[t];
      *ratios++ = body->elements.poisson_ratios[t];
    }
  }
  return true;
}

/* ---- Blocks ---- */

/* Number of open blocks. A tetrahedron goes into the first one with none of its free points. It is above the
 * usual number of tetrahedra at a point, and small enough that a block's elements stay close in memory. */
enum { OPEN_BLOCKS = 64 };
#define NO_ELEMENT UINT32_MAX

typedef struct packing {
  const sbri_island *island;
  const sbf_uint4 *corners; /* slots */
  uint32_t *elements;       /* (count x 8) of each lane, NO_ELEMENT if unused; block after block */
  uint64_t *users;          /* (free_count) bits of open blocks with the slot */
  uint64_t open;
  uint32_t at[OPEN_BLOCKS], filled[OPEN_BLOCKS]; /* number and lanes of each open block */
  uint32_t block_count;
  uint32_t part_ends[SBRI_MAX_PARTS]; /* end of each part's blocks */
  sbri_element_parts parts;
} packing;

static void close_block(packing *p, uint32_t index) {
  const uint32_t *lanes = p->elements + (size_t)p->at[index] * SBRI_BLOCK;
  p->open &= ~(UINT64_C(1) << index);
  for (uint32_t lane = 0; lane < p->filled[index]; lane++)
    for (int k = 0; k < 4; k++) {
      uint32_t slot = p->corners[lanes[lane]].at[k];
      if (slot < p->island->free_count) p->users[slot] &= ~(UINT64_C(1) << index);
    }
}

static uint32_t min_bit(uint64_t mask) {
  uint32_t bit = 0;
  while (!(mask >> bit & 1)) bit++;
  return bit;
}

/* Position for the next block; replaces the oldest one if all are in use. */
static uint32_t open_block(packing *p) {
  uint32_t index = 0;
  if (p->open == UINT64_MAX) {
    for (uint32_t i = 1; i < OPEN_BLOCKS; i++)
      if (p->at[i] < p->at[index]) index = i;
    close_block(p, index);
  } else {
    index = min_bit(~p->open);
  }
  p->open |= UINT64_C(1) << index;
  p->at[index] = p->block_count++, p->filled[index] = 0;
  for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++)
    p->elements[(size_t)p->at[index] * SBRI_BLOCK + lane] = NO_ELEMENT;
  return index;
}

static void add_element(packing *p, uint32_t t) {
  uint64_t fitting = p->open;
  uint32_t index = OPEN_BLOCKS;
  for (int k = 0; k < 4; k++) {
    uint32_t slot = p->corners[t].at[k];
    if (slot < p->island->free_count) fitting &= ~p->users[slot];
  }
  for (; fitting; fitting &= fitting - 1) {
    uint32_t other = min_bit(fitting);
    if (index == OPEN_BLOCKS || p->at[other] < p->at[index]) index = other;
  }
  if (index == OPEN_BLOCKS) index = open_block(p);
  p->elements[(size_t)p->at[index] * SBRI_BLOCK + p->filled[index]++] = t;
  for (int k = 0; k < 4; k++) {
    uint32_t slot = p->corners[t].at[k];
    if (slot < p->island->free_count) p->users[slot] |= UINT64_C(1) << index;
  }
  if (p->filled[index] == SBRI_BLOCK) close_block(p, index);
}
static bool is_corner(const packing *p, const uint32_t *lanes, uint32_t slot) {
  for (uint32_t lane = 0; lane < SBRI_BLOCK && lanes[lane] != NO_ELEMENT; lane++)
    for (int k = 0; k < 4; k++)
      if (p->corners[lanes[lane]].at[k] == slot) return true;
  return false;
}

/* A slot that no lane of the block moves: a pinned one, or a free one that is not among its corners;
 * slot_count: none. */
static uint32_t find_spare(const packing *p, const uint32_t *lanes) {
  for (uint32_t slot = p->island->slot_count; slot-- > 0;)
    if (slot >= p->island->free_count || !is_corner(p, lanes, slot)) return slot;
  return p->island->slot_count;
}

static uint32_t lanes_filled(const packing *p, uint32_t block) {
  uint32_t count = 0;
  while (count < SBRI_BLOCK && p->elements[(size_t)block * SBRI_BLOCK + count] != NO_ELEMENT) count++;
  return count;
}

/* Moves the last lanes of a block to blocks of their own until it has a spare slot. */
static void ensure_spare(packing *p, uint32_t block) {
  uint32_t *lanes = p->elements + (size_t)block * SBRI_BLOCK, count = lanes_filled(p, block);
  while (count < SBRI_BLOCK && find_spare(p, lanes) == p->island->slot_count) {
    uint32_t *own = p->elements + (size_t)p->block_count++ * SBRI_BLOCK;
    for (uint32_t lane = 1; lane < SBRI_BLOCK; lane++) own[lane] = NO_ELEMENT;
    own[0] = lanes[--count];
    lanes[count] = NO_ELEMENT;
  }
}

/* Full blocks first, then the others without unused lanes, then the others as they are. `begins`: where the
 * blocks of each part begin; the others without unused lanes belong to the last one. */
static void arrange(const packing *p, uint32_t *ordered, sbri_island *island, uint32_t *begins) {
  uint32_t full = 0, loose = 0, part = 0, next;
  for (uint32_t block = 0; block < p->block_count; block++) {
    uint32_t count = lanes_filled(p, block);
    for (; part < p->parts.count && block >= p->part_ends[part]; part++) begins[part + 1] = full;
    if (count == SBRI_BLOCK)
      memcpy(ordered + (size_t)SBRI_BLOCK * full++, p->elements + (size_t)block * SBRI_BLOCK,
          SBRI_BLOCK * sizeof *ordered);
    else
      loose += count;
  }
  island->tetrahedra.full_count = full;
  island->tetrahedra.dense_count = full + (loose + SBRI_BLOCK - 1) / SBRI_BLOCK;
  island->tetrahedra.block_count = island->tetrahedra.dense_count;
  for (; part < p->parts.count; part++) begins[part + 1] = island->tetrahedra.dense_count;
  begins[p->parts.count] = island->tetrahedra.dense_count;
  next = full * SBRI_BLOCK;
  for (uint32_t block = 0; block < p->block_count; block++) {
    const uint32_t *lanes = p->elements + (size_t)block * SBRI_BLOCK;
    uint32_t count = lanes_filled(p, block);
    if (count == SBRI_BLOCK) continue;
    memcpy(ordered + next, lanes, count * sizeof *ordered);
    memcpy(
        ordered + (size_t)SBRI_BLOCK * island->tetrahedra.block_count++, lanes, SBRI_BLOCK * sizeof *ordered);
    next += count;
  }
  for (; next < island->tetrahedra.dense_count * SBRI_BLOCK; next++) ordered[next] = NO_ELEMENT;
}

static bool pack(sbri_island_maker *m, packing *p) {
  sbri_island *island = m->island;
  uint32_t count = island->tetrahedra.count;
  p->elements = sbri_scratch(m, (size_t)count * SBRI_BLOCK, sizeof *p->elements);
  p->users = sbri_scratch(m, island->free_count, sizeof *p->users);
  uint32_t *ordered = sbri_scratch(m, 2 * (size_t)count * SBRI_BLOCK, sizeof *ordered);
  if (!p->elements || !p->users || !ordered) return false;
  if (!sbri_element_parts_find(m, p->corners, ordered, &p->parts)) return false;
  uint32_t *begins = sbri_model_allocate(m, (size_t)p->parts.count + 1, sizeof *begins);
  if (!begins) return false;
  for (uint32_t part = 0; part < p->parts.count; part++) {
    for (uint32_t i = p->parts.begins[part]; i < p->parts.begins[part + 1]; i++) add_element(p, ordered[i]);
    for (uint32_t index = 0; index < OPEN_BLOCKS; index++)
      if (p->open >> index & 1) close_block(p, index);
    p->part_ends[part] = p->block_count;
  }
  for (uint32_t block = 0; block < p->block_count; block++) ensure_spare(p, block);
  arrange(p, ordered, island, begins);
  island->tetrahedra.part_count = p->parts.count, island->tetrahedra.part_begins = begins;
  p->elements = ordered;
  return true;
}

/* Beta stated by the lattice, else that of the body with its weight maps. */
static float beta_of(const sbri_body *body, const float *factors, uint32_t t) {
  const sbf_f32_list *stated = &body->level->lattice.stiffness_damping;
  if (stated->count) return stated->at[stated->count == 1 ? 0 : t];
  return body->source->attributes.stiffness_damping *
         sbri_factor_of(factors, body->level->lattice.tetrahedra.at[t].at);
}

static void fill(sbri_island_maker *m, const packing *p, sbri_tetrahedron_block *blocks, float *damping,
    const float *const *factors, uint32_t *lanes_of) {
  for (uint32_t n = 0; n < m->island->tetrahedra.block_count; n++) {
    const uint32_t *lanes = p->elements + (size_t)n * SBRI_BLOCK;
    uint32_t spare = lanes[SBRI_BLOCK - 1] == NO_ELEMENT ? find_spare(p, lanes) : 0;
    bool again = n >= m->island->tetrahedra.dense_count;
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
      uint32_t t = lanes[lane], b = 0;
      for (int k = 0; k < 4; k++) blocks[n].corners[k][lane] = t == NO_ELEMENT ? spare : p->corners[t].at[k];
      if (t == NO_ELEMENT) continue;
      while (t >= sbri_maker_body(m, b)->elements.first_tetrahedron +
                      sbri_maker_body(m, b)->elements.tetrahedron_count)
        b++;
      const sbri_body *body = sbri_maker_body(m, b);
      sbfi_tetrahedron element;
      if (sbri_body_tetrahedron(body, t - body->elements.first_tetrahedron, &element))
        sbri_tetrahedron_fill(&blocks[n], lane, &element);
      if (damping)
        damping[(size_t)n * SBRI_BLOCK + lane] =
            beta_of(body, factors[b], t - body->elements.first_tetrahedron);
      lanes_of[2 * t + again] = n * SBRI_BLOCK + lane;
      if (!again) lanes_of[2 * t + 1] = n * SBRI_BLOCK + lane;
    }
  }
}

/* Finds the maximum beta, and whether there is any. */
static bool find_damping(sbri_island_maker *m, const float *const *factors) {
  float max = 0;
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
      float beta = beta_of(body, factors[b], t);
      max = beta > max ? beta : max;
    }
  }
  if ((double)max > m->island->springs.stiffness_damping_s)
    m->island->springs.stiffness_damping_s = (double)max;
  return max > 0;
}

/* Mean length of their edges at rest, m. */
static float mean_edge(const sbri_island *island, const sbf_uint4 *corners) {
  double sum = 0;
  for (uint32_t t = 0; t < island->tetrahedra.count; t++)
    for (int i = 0; i < 4; i++)
      for (int k = 0; k < i; k++) {
        const sbri_point *p = &island->rest[corners[t].at[i]], *q = &island->rest[corners[t].at[k]];
        float x = p->x - q->x, y = p->y - q->y, z = p->z - q->z;
        sum += (double)sqrtf(x * x + y * y + z * z);
      }
  return (float)(sum / (6.0 * island->tetrahedra.count));
}

bool sbri_tetrahedra_make(sbri_island_maker *m, const sbf_spring_network *network) {
  sbri_island *island = m->island;
  if (island->tetrahedra.count == 0) return true;
  packing p = {.island = island, .corners = network->tetrahedra};
  if (!pack(m, &p)) return false;
  size_t count = island->tetrahedra.block_count;
  sbri_tetrahedron_block *blocks = sbri_model_allocate(m, count, sizeof *blocks);
  uint32_t *lanes = sbri_model_allocate(m, 2 * (size_t)island->tetrahedra.count, sizeof *lanes);
  const float **factors = sbri_scratch(m, island->body_count, sizeof *factors);
  if (!blocks || !lanes || !factors) return false;
  for (uint32_t b = 0; b < island->body_count; b++)
    if (!sbri_factors_find(m, sbri_maker_body(m, b), SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING, &factors[b]))
      return false;
  bool damped = find_damping(m, factors);
  float *damping = damped ? sbri_model_allocate(m, count * SBRI_BLOCK, sizeof *damping) : NULL;
  if (damped && !damping) return false;
  fill(m, &p, blocks, damping, factors, lanes);
  float side = mean_edge(island, network->tetrahedra);
  if (!(island->stability.cell_m > 0) || side < island->stability.cell_m) island->stability.cell_m = side;
  island->tetrahedra.blocks = blocks;
  island->tetrahedra.damping = damping;
  island->tetrahedra.lanes = lanes;
  return true;
}
