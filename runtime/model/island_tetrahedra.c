/* The tetrahedra of an island: moduli, then blocks of eight. */
#include <string.h>

#include "mechanics/neo_hookean.h"
#include "model/island_maker.h"

/* Tetrahedra that share a point wait for each other's sums, so that blocks are made of ones that do not where
 * there are. So many are chosen from: enough to spread those around a point, few enough that neighbours in
 * the list stay close in memory. */
enum { WAITING = 96 };

static bool acts(const sbri_body *body) {
  return body->level->model == SBF_ELASTIC_MODEL_TETRAHEDRA;
}

bool sbri_tetrahedra_list(sbri_island_maker *m) {
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    sbri_body *body = sbri_maker_body(m, b);
    body->first_tetrahedron = m->island->tetrahedron_count;
    if (!acts(body)) continue;
    uint32_t count = body->level->lattice.tetrahedra.count;
    float *moduli = sbri_keep(m, count, sizeof *moduli);
    float *factors = sbri_scratch(m, body->level->positions.count, sizeof *factors);
    if (!moduli || !factors) return false;
    sbf_level_moduli(body->source, body->level, factors, moduli);
    body->moduli = moduli;
    body->tetrahedron_count = count;
    m->island->tetrahedron_count += count;
  }
  return true;
}

bool sbri_body_tetrahedron(const sbri_body *body, uint32_t tetrahedron, sbfi_tetrahedron *made) {
  sbfi_d3 rest[4];
  const uint32_t *points = body->level->lattice.tetrahedra.at[tetrahedron].at;
  for (int k = 0; k < 4; k++) rest[k] = sbfi_d3_of(body->level->positions.at[points[k]]);
  return sbfi_tetrahedron_make(
      made, rest, sbfi_lame_of(body->moduli[tetrahedron], body->source->attributes.poisson_ratio));
}

bool sbri_tetrahedra_network(sbri_island_maker *m, sbf_spring_network *network) {
  uint32_t count = m->island->tetrahedron_count;
  sbf_uint4 *corners = sbri_scratch(m, count, sizeof *corners);
  float *moduli = sbri_scratch(m, count, sizeof *moduli), *ratios = sbri_scratch(m, count, sizeof *ratios);
  if (!corners || !moduli || !ratios) return false;
  network->tetrahedron_count = count;
  network->tetrahedra = corners, network->young_modulus = moduli, network->poisson_ratios = ratios;
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    for (uint32_t t = 0; t < body->tetrahedron_count; t++) {
      for (int k = 0; k < 4; k++)
        corners->at[k] = body->slot_from_point[body->level->lattice.tetrahedra.at[t].at[k]];
      corners++;
      *moduli++ = body->moduli[t];
      *ratios++ = body->source->attributes.poisson_ratio;
    }
  }
  return true;
}

/* ---- Blocks ---- */

typedef struct packing {
  const sbf_uint4 *corners; /* (count) slots */
  uint32_t *places;         /* (count) block * 8 + lane of each */
  uint32_t *taken;          /* (slot_count) number of the block that has the slot, from 1 */
  uint32_t count, next;     /* of the tetrahedra; the first that does not wait yet */
  uint32_t waiting[WAITING], waiting_count;
} packing;

static bool fits(const packing *p, uint32_t t, uint32_t block) {
  for (int k = 0; k < 4; k++)
    if (p->taken[p->corners[t].at[k]] == block + 1) return false;
  return true;
}

/* The first of those that wait that shares no point with the block, or the first of all. */
static uint32_t take(packing *p, uint32_t block) {
  while (p->waiting_count < WAITING && p->next < p->count) p->waiting[p->waiting_count++] = p->next++;
  uint32_t i = 0;
  while (i < p->waiting_count && !fits(p, p->waiting[i], block)) i++;
  if (i == p->waiting_count) i = 0;
  uint32_t taken = p->waiting[i];
  memmove(p->waiting + i, p->waiting + i + 1, (--p->waiting_count - i) * sizeof *p->waiting);
  return taken;
}

static void pack(packing *p) {
  for (uint32_t n = 0; n < p->count; n++) {
    uint32_t block = n / SBRI_BLOCK, t = take(p, block);
    p->places[t] = n;
    for (int k = 0; k < 4; k++) p->taken[p->corners[t].at[k]] = block + 1;
  }
}

static void fill_lane(sbri_tetrahedron_block *block, uint32_t lane, const sbfi_tetrahedron *t) {
  const sbfi_d3 *g = t->gradients;
  double s = t->volume * t->lame.mu;
  static const int pairs[6][2] = {{1, 1}, {2, 2}, {3, 3}, {1, 2}, {2, 3}, {3, 1}};
  for (int i = 0; i < 6; i++)
    block->stiffness[i][lane] = (float)(s * sbfi_d3_dot(g[pairs[i][0]], g[pairs[i][1]]));
  block->inverse_volume[lane] = (float)(1 / (6 * t->volume));
  block->bulk[lane] = (float)(t->lame.lambda / 6);
  block->shear[lane] = (float)(t->lame.mu / 6);
}

static void fill(sbri_island_maker *m, const packing *p, sbri_tetrahedron_block *blocks, float *damping) {
  uint32_t next = 0;
  sbfi_tetrahedron element;
  /* Empty lanes name a point of their block, and give it nothing. */
  for (uint32_t t = 0; t < m->island->tetrahedron_count; t++)
    if (p->places[t] % SBRI_BLOCK == 0)
      for (int lane = 0; lane < SBRI_BLOCK; lane++)
        for (int k = 0; k < 4; k++) blocks[p->places[t] / SBRI_BLOCK].corners[k][lane] = p->corners[t].at[k];
  for (uint32_t b = 0; b < m->island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    for (uint32_t t = 0; t < body->tetrahedron_count; t++, next++) {
      uint32_t at = p->places[next], lane = at % SBRI_BLOCK;
      sbri_tetrahedron_block *block = &blocks[at / SBRI_BLOCK];
      for (int k = 0; k < 4; k++) block->corners[k][lane] = p->corners[next].at[k];
      if (sbri_body_tetrahedron(body, t, &element)) fill_lane(block, lane, &element);
      if (damping) damping[at] = body->source->attributes.stiffness_damping;
    }
  }
}

bool sbri_tetrahedra_make(sbri_island_maker *m, const sbf_spring_network *network) {
  sbri_island *island = m->island;
  if (island->tetrahedron_count == 0) return true;
  bool damped = false;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = sbri_maker_body(m, b);
    double beta = body->source->attributes.stiffness_damping;
    if (body->tetrahedron_count == 0 || !(beta > 0)) continue;
    damped = true;
    if (beta > island->stiffness_damping_s) island->stiffness_damping_s = beta;
  }
  packing p = {.corners = network->tetrahedra, .count = island->tetrahedron_count};
  p.places = sbri_scratch(m, island->tetrahedron_count, sizeof *p.places);
  p.taken = sbri_scratch(m, island->slot_count, sizeof *p.taken);
  if (!p.places || !p.taken) return false;
  pack(&p);
  uint32_t block_count = (p.count + SBRI_BLOCK - 1) / SBRI_BLOCK;
  sbri_tetrahedron_block *blocks = sbri_keep(m, block_count, sizeof *blocks);
  float *damping = damped ? sbri_keep(m, (size_t)block_count * SBRI_BLOCK, sizeof *damping) : NULL;
  if (!blocks || (damped && !damping)) return false;
  fill(m, &p, blocks, damping);
  island->tetrahedron_blocks = blocks;
  island->tetrahedron_block_count = block_count;
  island->tetrahedron_damping = damping;
  return true;
}
