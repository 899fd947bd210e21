/* Stress and energy of elements: sbrun/soft_body.h.
 *
 * The Cauchy stress of a linear element is the virial of its forces, s = -(1 / v) sum_i f_i x_i^T over its
 * corners, with v the present volume. It equals P F^T / J without forming F, so yielded elements need no rest
 * shape. With edges d_k and the forces of soft/solvers/tetrahedron_forces.h, -f_k = sum_j K_kj d_j + p n_k.
 */
#include "mechanics/spring.h"
#include "mechanics/vector.h"
#include "soft/soft.h"

/* Indices of the edge pairs in the order of sbri_tetrahedron_block.stiffness. */
static const int stiffness_at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

static const sbri_body *body_of(const sbri_character *c, uint32_t soft_body) {
  if (!c || soft_body >= c->model->asset->soft_bodies.count) return NULL;
  return c->model->bodies[soft_body].level ? &c->model->bodies[soft_body] : NULL;
}

static sbfi_d3 position_of(const sbri_point *p) {
  return (sbfi_d3){p->x, p->y, p->z};
}

/* In the character's own units. */
static sbr_tetrahedron_state state_of(
    const sbri_tetrahedron_block *block, uint32_t lane, const sbri_point *positions) {
  sbr_tetrahedron_state s = {.volume_ratio = 0};
  double shear = block->shear[lane], bulk = block->bulk[lane], inverse = block->inverse_volume[lane];
  if (!(shear > 0) || !(inverse > 0)) return (sbr_tetrahedron_state){.torn = true};
  sbfi_d3 d[3], n[3], forces[3];
  for (int k = 0; k < 3; k++)
    d[k] = sbfi_d3_sub(position_of(&positions[block->corners[k + 1][lane]]),
        position_of(&positions[block->corners[0][lane]]));
  for (int k = 0; k < 3; k++) n[k] = sbfi_d3_cross(d[(k + 1) % 3], d[(k + 2) % 3]);
  double ratio = sbfi_d3_dot(d[0], n[0]) * inverse, p = bulk * (ratio - 1) - shear, squares = 0;
  for (int i = 0; i < 3; i++) {
    forces[i] = sbfi_d3_scale(n[i], p);
    for (int j = 0; j < 3; j++) {
      double k = block->stiffness[stiffness_at[i][j]][lane];
      forces[i] = sbfi_d3_add(forces[i], sbfi_d3_scale(d[j], k));
      squares += k * sbfi_d3_dot(d[i], d[j]);
    }
  }
  double volume = 1 / (6 * inverse), mu = 6 * shear, lambda = 6 * bulk, off = ratio - 1 - mu / lambda;
  double now = ratio * volume, sum[6] = {0};
  for (int k = 0; k < 3; k++) {
    sum[0] += forces[k].x * d[k].x, sum[1] += forces[k].y * d[k].y, sum[2] += forces[k].z * d[k].z;
    sum[3] += forces[k].x * d[k].y, sum[4] += forces[k].y * d[k].z, sum[5] += forces[k].z * d[k].x;
  }
  for (int i = 0; i < 6; i++) s.stress[i] = now != 0 ? (float)(sum[i] / now) : 0;
  s.volume_ratio = (float)ratio, s.rest_volume = (float)volume;
  s.energy_density =
      (float)(0.5 * squares / volume - 1.5 * mu + 0.5 * lambda * off * off - 0.5 * mu * mu / lambda);
  return s;
}

uint32_t sbr_character_get_tetrahedra(const sbr_world *world, sbr_character_id character, uint32_t soft_body,
    sbr_tetrahedron_state *tetrahedra, uint32_t capacity) {
  const sbri_character *c = sbri_character_of(world, character);
  const sbri_body *body = body_of(c, soft_body);
  if (!body) return 0;
  const sbri_island *island = &c->model->islands[body->island];
  const sbri_tetrahedron_block *blocks = island->tetrahedra.flow
                                             ? sbri_solids(c) + island->tetrahedra.first_state_block
                                             : island->tetrahedra.blocks;
  const sbri_point *positions = sbri_positions(c) + island->first_slot;
  for (uint32_t t = 0; tetrahedra && t < body->elements.tetrahedron_count && t < capacity; t++) {
    uint32_t at = island->tetrahedra.lanes[2 * (body->elements.first_tetrahedron + t)];
    tetrahedra[t] = state_of(&blocks[at / SBRI_BLOCK], at % SBRI_BLOCK, positions);
    /* Moduli scale so that bodies of all sizes move equally: forces with the cube, areas with the square. */
    float s = c->scale;
    for (int i = 0; i < 6; i++) tetrahedra[t].stress[i] *= s;
    tetrahedra[t].energy_density *= s, tetrahedra[t].rest_volume *= s * s * s;
    for (int k = 0; k < 4; k++) tetrahedra[t].corners[k] = body->level->lattice.tetrahedra.at[t].at[k];
  }
  return body->elements.tetrahedron_count;
}

/* ---- Springs ---- */

static sbr_spring_state spring_state_of(
    const sbri_character *c, const sbri_island *island, uint32_t number, const uint32_t ends[2]) {
  sbfi_spring s = sbri_spring_now(c, island, number);
  const sbri_point *positions = sbri_positions(c) + island->first_slot;
  sbfi_d3 d = sbfi_d3_sub(position_of(&positions[s.b]), position_of(&positions[s.a]));
  double length = sqrt(sbfi_d3_dot(d, d)), scale = c->scale;
  sbr_spring_state is = {.ends = {ends[0], ends[1]}};
  is.torn = s.stiffness_n_m < island->springs.at[number].stiffness_n_m;
  if (is.torn) return is;
  is.tension = (float)(scale * scale * scale * (double)sbfi_spring_force_factor(&s, (float)length) * length);
  is.energy = (float)(scale * scale * scale * scale * sbfi_spring_energy(&s, length));
  return is;
}

/* Springs between pinned points are not among the island's; the others are there in the same order. */
uint32_t sbr_character_get_springs(const sbr_world *world, sbr_character_id character, uint32_t soft_body,
    sbr_spring_state *springs, uint32_t capacity) {
  const sbri_character *c = sbri_character_of(world, character);
  const sbri_body *body = body_of(c, soft_body);
  if (!body) return 0;
  const sbri_island *island = &c->model->islands[body->island];
  const sbf_level *level = body->level;
  uint32_t next = body->elements.first_spring, count = 0;
  for (uint32_t s = 0; s < level->springs.count; s++) {
    const sbf_spring_set *set = &level->springs.at[s];
    for (uint32_t i = 0; i < set->ends.count && next < body->elements.spring_end; i++) {
      const uint32_t *ends = set->ends.at[i].at;
      const sbfi_spring *is = &island->springs.at[next];
      if (is->a != body->slots.from_point[ends[0]] || is->b != body->slots.from_point[ends[1]]) continue;
      if (springs && count < capacity) springs[count] = spring_state_of(c, island, next, ends);
      next++, count++;
    }
  }
  return count;
}
