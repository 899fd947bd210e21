/* The lowest mode of a body of regions, for its damping.
 *
 * Linearised at rest, the force on a point is k (u - d - t x r), with d and t the region's displacement and
 * rotation that fit those of its points best. No mode is faster than the maximum w, so power iteration on w^2
 * - H finds the slowest; rigid motion of a body without pins is removed in each step. The Rayleigh quotient
 * of the result is an upper bound of the frequency. */
#include <string.h>

#include "mechanics/shape_region.h"
#include "prepare/island_maker.h"

enum { STEPS = 150 };

/* Solves the symmetric 3 x 3 system g x = b by Cramer's rule; 0 if it has no solution. */
static sbfi_d3 solve(const double g[6], sbfi_d3 b) {
  sbfi_d3 u = {g[0], g[3], g[5]}, v = {g[3], g[1], g[4]}, w = {g[5], g[4], g[2]};
  sbfi_d3 vw = sbfi_d3_cross(v, w), wu = sbfi_d3_cross(w, u), uv = sbfi_d3_cross(u, v);
  double det = sbfi_d3_dot(u, vw), trace = g[0] + g[1] + g[2];
  if (!(det > 1e-12 * trace * trace * trace)) return (sbfi_d3){0, 0, 0};
  return sbfi_d3_scale((sbfi_d3){sbfi_d3_dot(vw, b), sbfi_d3_dot(wu, b), sbfi_d3_dot(uv, b)}, 1 / det);
}

/* Fit of a rigid motion to displacements: sums over weighted points. */
typedef struct rigid_fit {
  double weight, g[6];
  sbfi_d3 center, drift, rotation;
} rigid_fit;

static void add_rotation(rigid_fit *fit, double k, sbfi_d3 r, sbfi_d3 u) {
  fit->rotation = sbfi_d3_add(fit->rotation, sbfi_d3_scale(sbfi_d3_cross(r, u), k));
  fit->g[0] += k * (r.y * r.y + r.z * r.z), fit->g[1] += k * (r.z * r.z + r.x * r.x);
  fit->g[2] += k * (r.x * r.x + r.y * r.y), fit->g[3] -= k * r.x * r.y;
  fit->g[4] -= k * r.y * r.z, fit->g[5] -= k * r.z * r.x;
}

static sbfi_d3 rigid_part(const rigid_fit *fit, sbfi_d3 r) {
  return sbfi_d3_add(fit->drift, sbfi_d3_cross(fit->rotation, r));
}

/* Adds the forces of one region on its slots to `forces`. */
static void add_region(const sbri_island *island, const sbri_region_block *block, uint32_t lane,
    const sbfi_d3 *moves, sbfi_d3 *forces) {
  const sbri_region_member *members = island->regions.members + block->first_member;
  rigid_fit fit = {0};
  for (uint32_t i = 0; i < block->member_count; i++) {
    double k = members[i].stiffness[lane];
    const float(*at)[SBRI_BLOCK] = members[i].offsets;
    sbfi_d3 r = {at[0][lane], at[1][lane], at[2][lane]}, u = moves[members[i].slots[lane]];
    fit.weight += k;
    fit.drift = sbfi_d3_add(fit.drift, sbfi_d3_scale(u, k));
    add_rotation(&fit, k, r, u);
  }
  if (!(fit.weight > 0)) return;
  fit.drift = sbfi_d3_scale(fit.drift, 1 / fit.weight);
  fit.rotation = solve(fit.g, fit.rotation);
  for (uint32_t i = 0; i < block->member_count; i++) {
    uint32_t slot = members[i].slots[lane];
    const float(*at)[SBRI_BLOCK] = members[i].offsets;
    sbfi_d3 off =
        sbfi_d3_sub(moves[slot], rigid_part(&fit, (sbfi_d3){at[0][lane], at[1][lane], at[2][lane]}));
    forces[slot] = sbfi_d3_sub(forces[slot], sbfi_d3_scale(off, members[i].stiffness[lane]));
  }
}

static sbfi_d3 rest_of(const sbri_island *island, uint32_t slot) {
  const sbri_point *p = &island->rest[slot];
  return (sbfi_d3){p->x, p->y, p->z};
}

/* Removes the body's rigid motion from its points' displacements. */
static void remove_rigid_motion(const sbri_island *island, const sbri_body *body, sbfi_d3 *moves) {
  rigid_fit fit = {0};
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    double m = island->masses[slot];
    fit.weight += m;
    fit.center = sbfi_d3_add(fit.center, sbfi_d3_scale(rest_of(island, slot), m));
    fit.drift = sbfi_d3_add(fit.drift, sbfi_d3_scale(moves[slot], m));
  }
  if (!(fit.weight > 0)) return;
  fit.center = sbfi_d3_scale(fit.center, 1 / fit.weight);
  fit.drift = sbfi_d3_scale(fit.drift, 1 / fit.weight);
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
    add_rotation(&fit, island->masses[slot], sbfi_d3_sub(rest_of(island, slot), fit.center), moves[slot]);
  fit.rotation = solve(fit.g, fit.rotation);
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
    moves[slot] = sbfi_d3_sub(moves[slot], rigid_part(&fit, sbfi_d3_sub(rest_of(island, slot), fit.center)));
}

/* Arbitrary deformation without rigid motion. */
static sbfi_d3 first_guess(sbfi_d3 r, uint32_t slot) {
  double jitter = 0.01 * (double)(slot * 2654435761u >> 16) / 65536;
  return (sbfi_d3){r.z * r.z - r.y * r.y + jitter, r.x * r.x + r.z * r.y - jitter, r.x * r.y - r.z + jitter};
}

static bool is_point_pinned(const sbri_island *island, const sbri_body *body) {
  for (uint32_t b = body->elements.first_region_block; b < body->elements.region_block_end; b++) {
    const sbri_region_block *block = &island->regions.blocks[b];
    for (uint32_t i = 0; i < block->member_count; i++)
      for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++)
        if (island->regions.members[block->first_member + i].slots[lane] >= island->free_count) return true;
  }
  return false;
}

double sbri_regions_lowest(const sbri_island *island, const sbri_body *body, double *scratch) {
  if (body->elements.first_region_block == body->elements.region_block_end) return 0;
  sbfi_d3 *moves = (sbfi_d3 *)(void *)scratch, *forces = moves + island->slot_count;
  double top = island->regions.max_rad_s * island->regions.max_rad_s, low = top;
  bool pinned = is_point_pinned(island, body);
  memset(moves, 0, island->slot_count * sizeof *moves);
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
    moves[slot] = first_guess(rest_of(island, slot), slot);
  for (int step = 0; step < STEPS; step++) {
    if (!pinned) remove_rigid_motion(island, body, moves);
    memset(forces, 0, island->slot_count * sizeof *forces);
    for (uint32_t b = body->elements.first_region_block; b < body->elements.region_block_end; b++)
      for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++)
        add_region(island, &island->regions.blocks[b], lane, moves, forces);
    double stiff = 0, heavy = 0;
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
      stiff -= sbfi_d3_dot(moves[slot], forces[slot]);
      heavy += (double)island->masses[slot] * sbfi_d3_dot(moves[slot], moves[slot]);
    }
    if (!(heavy > 0)) return 0;
    low = stiff / heavy;
    double scale = 1 / (top * sqrt(heavy));
    for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
      sbfi_d3 a = sbfi_d3_scale(forces[slot], island->inverse_masses[slot]);
      moves[slot] = sbfi_d3_scale(sbfi_d3_add(sbfi_d3_scale(moves[slot], top), a), scale);
    }
  }
  return low > 0 ? sqrt(low) : 0;
}
