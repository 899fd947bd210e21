/* Yield and tear. A spring beyond its yield strain changes its rest length at its flow rate; a spring beyond
 * its tear strain is removed. Both are state.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_FLOW_H
#define SBRI_FLOW_H

#include "math/trig.h"
#include "math/vec3.h"
#include "soft/solvers/scheme.h"

static inline void sbri_flow_link(
    const sbri_island_tick *t, uint32_t block, uint32_t lane, float length, float h) {
  const sbri_link_flows *is = &t->island->links.flows[block];
  uint32_t at = block * SBRI_BLOCK + lane;
  float *rest = &t->springs.rests[at], strain = *rest > 0 ? (length - *rest) / *rest : length;
  if (!(t->springs.strengths[at] > 0)) return;
  if (is->tear[lane] > 0 && strain > is->tear[lane]) {
    const sbri_link_block *link = &t->island->links.blocks[block];
    const sbri_point *p = &t->positions[link->a[lane]], *q = &t->positions[link->b[lane]];
    sbri_tears *tears = t->tears;
    if (tears->count < SBRI_TEARS)
      tears->at[tears->count] =
          (sbri_tear){at, false, sbri_vec3(0.5f * (p->x + q->x), 0.5f * (p->y + q->y), 0.5f * (p->z + q->z))};
    tears->count++;
    t->springs.strengths[at] = 0;
  } else if (is->rate[lane] > 0) {
    float towards = sbfi_spring_yielded(*rest, length, is->yield[lane]);
    *rest = towards + (*rest - towards) * sbri_exp(-is->rate[lane] * h);
  }
}

/* Applies yield and tear over h seconds at the present positions. */
static inline void sbri_yield_and_tear(const sbri_island_tick *t, float h) {
  const sbri_island *island = t->island;
  for (uint32_t block = 0; block < island->links.block_count; block++) {
    const sbri_link_block *link = &island->links.blocks[block];
    const sbri_link_flows *is = &island->links.flows[block];
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide3 p = sbri_wide_gather(t->positions, link->a + lane);
      sbri_wide3 q = sbri_wide_gather(t->positions, link->b + lane);
      sbri_wide x = q.x - p.x, y = q.y - p.y, z = q.z - p.z, zero = sbri_wide_all(0), one = sbri_wide_all(1);
      sbri_wide length = sbri_wide_sqrt(x * x + y * y + z * z);
      sbri_wide rest = sbri_wide_load(t->springs.rests + block * SBRI_BLOCK + lane);
      sbri_wide unit = sbri_wide_select(rest > zero, rest, one), beyond = length - rest;
      sbri_wide yield = sbri_wide_load(is->yield + lane) * unit,
                tear = sbri_wide_load(is->tear + lane) * unit;
      sbri_mask yields =
          (sbri_wide_load(is->rate + lane) > zero) & ((beyond > yield) | (zero - beyond > yield));
      sbri_mask tears = (tear > zero) & (beyond > tear);
      if (!sbri_mask_any(yields | tears)) continue;
      float lengths[SBRI_LANES];
      sbri_wide_store(lengths, length);
      for (uint32_t i = 0; i < SBRI_LANES; i++) sbri_flow_link(t, block, lane + i, lengths[i], h);
    }
  }
}

#endif
