/* Contacts of soft bodies with the ground and colliders, which no contact impulse moves, eight at a time
 * (contact/contact_block.h).
 *
 * An impulse at a sample x = sum w_i x_i changes the velocity of point i by w_i / m_i per unit, and the
 * velocity of the sample by the sum of w_i^2 / m_i. Samples share points, so impulses interact. The impulses
 * of a substep are found by projected Gauss-Seidel over accumulated impulses (E. Catto, Iterative Dynamics
 * with Temporal Coherence, 2005), warm started with those of the previous substep.
 *
 * The step length of an impulse is the sum of its row of responses over the active contacts, 1 / sum_k |w_k|
 * W_k / m_k with W_k the sum of |w| of the active contacts at point k, instead of the diagonal. By
 * Gershgorin's theorem no iteration overshoots, whatever points eight contacts share, and uniform pressure is
 * exact in one iteration. Friction and restitution follow contact/contact.h.
 *
 * A block is idle while the fastest point of the body, at twice its speed, could not have moved one of its
 * contacts to within SBRI_CONTACT_NEAR_M_S of its plane in a substep. The factor of two is for position
 * corrections at the end of a substep, which reach the velocity only in the next one.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_CONTACT_LANES_H
#define SBRI_CONTACT_LANES_H

#include "contact/contact.h"
#include "contact/contact_block.h"
#include "soft/solvers/spring_forces.h"

/* Iterations of a substep end when no velocity changes by more than this in one, m/s, and at the maximum. */
#define SBRI_CONTACT_TOLERANCE_M_S 1e-3f
enum { SBRI_MAX_CONTACT_ITERATIONS = 16 };
/* A contact is skipped in a substep if it would not reach its plane even if it were this much faster, m/s. */
#define SBRI_CONTACT_NEAR_M_S 1.0f

enum { SBRI_CONTACT_GROUPS = SBRI_BLOCK / SBRI_LANES };

static inline sbri_wide3 sbri_load_rows(float rows[3][SBRI_BLOCK], uint32_t lane) {
  return (sbri_wide3){
      sbri_wide_load(rows[0] + lane), sbri_wide_load(rows[1] + lane), sbri_wide_load(rows[2] + lane)};
}
static inline void sbri_store_rows(float rows[3][SBRI_BLOCK], uint32_t lane, sbri_wide3 v) {
  sbri_wide_store(rows[0] + lane, v.x), sbri_wide_store(rows[1] + lane, v.y),
      sbri_wide_store(rows[2] + lane, v.z);
}
static inline sbri_wide sbri_wide3_along(sbri_wide3 a, sbri_wide3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Weighted sum of the points of a group of lanes. */
SBRI_INLINE sbri_wide3 sbri_contact_blend(
    const sbri_point *points, const sbri_contact_block *block, uint32_t lane) {
  sbri_wide zero = sbri_wide_all(0);
  sbri_wide3 sum = {zero, zero, zero};
  for (int k = 0; k < 4; k++) {
    sbri_wide3 p = sbri_wide_gather(points, block->sample.slots[k] + lane);
    sbri_wide w = sbri_wide_load(block->sample.weights[k] + lane);
    sum.x = sum.x + w * p.x, sum.y = sum.y + w * p.y, sum.z = sum.z + w * p.z;
  }
  return sum;
}

/* Adds the responses to velocity changes of the samples to the points. The order of sums does not depend on
 * the SIMD width. */
SBRI_INLINE void sbri_contact_scatter(
    sbri_point *points, const sbri_contact_block *block, const sbri_wide3 changes[SBRI_CONTACT_GROUPS]) {
  for (int k = 0; k < 4; k++)
    for (uint32_t group = 0; group < SBRI_CONTACT_GROUPS; group++) {
      uint32_t lane = group * SBRI_LANES;
      sbri_wide r = sbri_wide_load(block->sample.responses[k] + lane);
      sbri_wide3 c = changes[group];
      sbri_wide_scatter_add(points, block->sample.slots[k] + lane, (sbri_wide3){r * c.x, r * c.y, r * c.z});
    }
}

/* Copies the velocities of the points in contact to velocity_points, which is scratch here. Returns the speed
 * of the fastest point of the body, m/s. */
static inline float sbri_contact_load_velocities(
    const sbri_island_tick *t, const sbri_body *body, const float *velocities) {
  sbri_wide square = sbri_wide_all(0);
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    sbri_wide3 v = sbri_load3(sbri_const_triple(velocities, slot));
    square = sbri_wide_max(square, sbri_wide3_along(v, v));
    if (t->contacts.slots[slot / SBRI_BLOCK]) sbri_wide_store_points(t->scratch.velocity_points + slot, v);
  }
  float squares[SBRI_LANES], max = 0;
  sbri_wide_store(squares, square);
  for (uint32_t lane = 0; lane < SBRI_LANES; lane++) max = squares[lane] > max ? squares[lane] : max;
  for (uint32_t slot = t->island->free_count; body->is_pinned && slot < t->island->slot_count; slot++) {
    if (!t->contacts.slots[slot / SBRI_BLOCK]) continue;
    sbf_vec3 v = sbri_slot_velocity(t, velocities, slot);
    t->scratch.velocity_points[slot] = (sbri_point){v.x, v.y, v.z, 0};
    float pinned_square = v.x * v.x + v.y * v.y + v.z * v.z;
    max = pinned_square > max ? pinned_square : max;
  }
  return sqrtf(max);
}

static inline void sbri_contact_store_velocities(
    const sbri_island_tick *t, const sbri_body *body, float *velocities) {
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES)
    if (t->contacts.slots[slot / SBRI_BLOCK])
      sbri_store3(sbri_triple(velocities, slot), sbri_wide_load_points(t->scratch.velocity_points + slot));
}

/* The bound of friction in this substep is `bound + bound_slope * normal velocity change`, the linear form of
 * sbri_pressing_add and sbri_pressing_bound. */
SBRI_INLINE void sbri_contact_bound_friction(sbri_contact_block *block, uint32_t lane, float step_s) {
  const float owed_fraction = SBRI_PRESSING_DEFICIT_FRACTION, kept_fraction = 1 - 1 / SBRI_PRESSING_SUBSTEPS;
  sbri_wide zero = sbri_wide_all(0), h = sbri_wide_all(step_s), old_fraction = sbri_wide_all(kept_fraction);
  sbri_wide owing = sbri_wide_all(owed_fraction), paid = sbri_wide_all(1 - owed_fraction);
  sbri_wide time = sbri_wide_load(block->pressing.time_s + lane);
  sbri_wide mean = h / sbri_wide_max(old_fraction * time + h, h);
  sbri_wide before = old_fraction * sbri_wide_load(block->pressing.velocity_change + lane);
  sbri_mask pressed =
      (time > zero) & (sbri_wide_load(block->of_tick.closing_speed + lane) <= sbri_wide_all(SBRI_STRIKE_M_S));
  sbri_wide bound = paid * (mean * before + owing * sbri_wide_load(block->pressing.deficit + lane)),
            slope = paid * mean + owing;
  sbri_wide_store(block->friction_bound.constant + lane, sbri_wide_select(pressed, bound, zero));
  sbri_wide_store(block->friction_bound.slope + lane, sbri_wide_select(pressed, slope, sbri_wide_all(1)));
}

/* Finds gaps, target velocities and bounds of friction of a group of lanes. Returns whether the set of active
 * lanes differs from the previous substep. */
SBRI_INLINE bool sbri_contact_begin_lanes(const sbri_island_tick *t, sbri_contact_block *block, uint32_t lane,
    const sbri_contact_rule *rule, float clear[SBRI_BLOCK], float near[SBRI_BLOCK]) {
  sbri_wide zero = sbri_wide_all(0), one = sbri_wide_all(1), h = sbri_wide_all(rule->step_s);
  sbri_wide3 n = sbri_load_rows(block->normal, lane), plane_velocity = sbri_load_rows(block->velocity, lane);
  sbri_wide3 v = sbri_contact_blend(t->scratch.velocity_points, block, lane);
  v.x = v.x - plane_velocity.x, v.y = v.y - plane_velocity.y, v.z = v.z - plane_velocity.z;
  sbri_wide speed = sbri_wide3_along(n, v), closing = sbri_wide_load(block->of_tick.closing_speed + lane);
  sbri_wide gap = sbri_wide3_along(n, sbri_contact_blend(t->positions, block, lane)) -
                  sbri_wide_load(block->offset + lane);
  sbri_wide old_change = sbri_wide_load(block->velocity_change + lane);
  sbri_mask arrives = gap + h * speed < zero,
            bounces = arrives & (speed < sbri_wide_all(-rule->bounce_from_m_s));
  /* Target: arrive at the plane; stop if it penetrates already; bounce if it is fast. */
  sbri_wide arrival = zero - sbri_wide_max(gap, zero) / h;
  sbri_wide bounce = zero - sbri_wide_load(block->restitution + lane) * speed;
  sbri_wide_store(
      block->target_speed + lane, sbri_wide_select(bounces, sbri_wide_max(bounce, arrival), arrival));
  sbri_wide_store(block->gap + lane, gap);
  /* Only the first impulse of the tick counts: later ones come from the body's own vibration. */
  sbri_mask first = arrives & (sbri_wide_load(block->of_tick.max_velocity_change + lane) <= zero);
  closing = sbri_wide_select(first, sbri_wide_max(closing, zero - speed), closing);
  sbri_wide_store(block->of_tick.closing_speed + lane, closing);
  sbri_wide active = sbri_wide_select(arrives | (old_change > zero), one, zero);
  bool changed = sbri_mask_any(active != sbri_wide_load(block->active + lane));
  sbri_wide_store(block->active + lane, active);
  sbri_wide_store(block->relaxation + lane,
      sbri_wide_select(active > zero, sbri_wide_load(block->relaxation + lane), zero));
  sbri_wide_store(clear + lane, sbri_wide_select(active > zero, zero, gap));
  sbri_wide ahead = h * (sbri_wide_all(SBRI_CONTACT_NEAR_M_S) - speed) - gap;
  sbri_wide_store(near + lane, sbri_wide_select(active > zero, one, ahead));
  sbri_contact_bound_friction(block, lane, rule->step_s);
  return changed;
}

static inline bool sbri_contact_begin(
    const sbri_island_tick *t, sbri_contact_block *block, const sbri_contact_rule *rule) {
  float clear[SBRI_BLOCK], near[SBRI_BLOCK];
  bool changed = false;
  for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES)
    changed = sbri_contact_begin_lanes(t, block, lane, rule, clear, near) || changed;
  block->clearance_m = clear[0], block->is_near = false;
  for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
    block->clearance_m = clear[lane] < block->clearance_m ? clear[lane] : block->clearance_m;
    block->is_near = block->is_near || near[lane] > 0;
  }
  return changed;
}

/* Step lengths by row sums. */
static inline void sbri_contact_sum_rows(
    const sbri_island_tick *t, const sbri_body *body, sbri_contact_block *blocks, uint32_t count) {
  float *sums = t->contacts.weights;
  memset(sums + body->slots.begin, 0, (body->slots.end - body->slots.begin) * sizeof *sums);
  if (body->is_pinned)
    memset(sums + t->island->free_count, 0, (t->island->slot_count - t->island->free_count) * sizeof *sums);
  for (uint32_t b = 0; b < count; b++)
    for (int k = 0; blocks[b].is_near && k < 4; k++)
      for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++)
        sums[blocks[b].sample.slots[k][lane]] +=
            fabsf(blocks[b].sample.weights[k][lane]) * blocks[b].active[lane];
  for (uint32_t b = 0; b < count; b++) {
    sbri_contact_block *block = &blocks[b];
    for (uint32_t lane = 0; block->is_near && lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide zero = sbri_wide_all(0), row = zero;
      for (int k = 0; k < 4; k++) {
        sbri_wide r = sbri_wide_load(block->sample.responses[k] + lane);
        row = row + sbri_wide_max(r, zero - r) * sbri_wide_gather_floats(sums, block->sample.slots[k] + lane);
      }
      sbri_mask is_active = sbri_wide_load(block->active + lane) > zero;
      sbri_wide_store(block->relaxation + lane,
          sbri_wide_select(is_active, sbri_wide_all(1) / sbri_wide_max(row, sbri_wide_all(1e-20f)), zero));
    }
  }
}

/* Applies the impulses of the previous substep. */
static inline void sbri_contact_warm_start(
    const sbri_island_tick *t, sbri_contact_block *blocks, uint32_t count) {
  for (uint32_t b = 0; b < count; b++) {
    sbri_contact_block *block = &blocks[b];
    sbri_wide3 changes[SBRI_CONTACT_GROUPS];
    bool has_impulses = false;
    for (uint32_t lane = 0; block->is_near && lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide velocity_change = sbri_wide_load(block->velocity_change + lane);
      sbri_wide3 n = sbri_load_rows(block->normal, lane), f = sbri_load_rows(block->friction_impulse, lane);
      changes[lane / SBRI_LANES] =
          (sbri_wide3){f.x + n.x * velocity_change, f.y + n.y * velocity_change, f.z + n.z * velocity_change};
      has_impulses = has_impulses || sbri_mask_any(velocity_change > sbri_wide_all(0));
    }
    block->has_impulses = has_impulses;
    if (has_impulses) sbri_contact_scatter(t->scratch.velocity_points, block, changes);
  }
}

/* Corrects the impulses of a group of lanes. Returns the velocity change. */
SBRI_INLINE sbri_wide3 sbri_contact_correct(
    const sbri_island_tick *t, sbri_contact_block *block, uint32_t lane) {
  sbri_wide zero = sbri_wide_all(0), fraction = sbri_wide_load(block->relaxation + lane);
  sbri_wide3 n = sbri_load_rows(block->normal, lane), plane_velocity = sbri_load_rows(block->velocity, lane);
  sbri_wide3 v = sbri_contact_blend(t->scratch.velocity_points, block, lane);
  sbri_wide3 f = sbri_load_rows(block->friction_impulse, lane), now;
  v.x = v.x - plane_velocity.x, v.y = v.y - plane_velocity.y, v.z = v.z - plane_velocity.z;
  sbri_wide speed = sbri_wide3_along(n, v), velocity_change = sbri_wide_load(block->velocity_change + lane);
  sbri_wide corrected = velocity_change + fraction * (sbri_wide_load(block->target_speed + lane) - speed);
  corrected = sbri_wide_max(corrected, zero);
  now.x = f.x - fraction * (v.x - n.x * speed), now.y = f.y - fraction * (v.y - n.y * speed),
  now.z = f.z - fraction * (v.z - n.z * speed);
  sbri_wide size = sbri_wide_sqrt(sbri_wide3_along(now, now)),
            pressing = sbri_wide_load(block->friction_bound.constant + lane) +
                       sbri_wide_load(block->friction_bound.slope + lane) * corrected;
  sbri_wide max = sbri_wide_select(
      corrected > zero, sbri_wide_load(block->friction + lane) * sbri_wide_max(pressing, zero), zero);
  sbri_wide clamp = sbri_wide_min(max / sbri_wide_max(size, sbri_wide_all(1e-20f)), sbri_wide_all(1));
  now.x = now.x * clamp, now.y = now.y * clamp, now.z = now.z * clamp;
  sbri_wide_store(block->velocity_change + lane, corrected);
  sbri_store_rows(block->friction_impulse, lane, now);
  sbri_wide more = corrected - velocity_change;
  return (sbri_wide3){now.x - f.x + n.x * more, now.y - f.y + n.y * more, now.z - f.z + n.z * more};
}

/* One iteration; returns the square of the largest velocity change. */
static inline float sbri_contact_iterate(
    const sbri_island_tick *t, sbri_contact_block *blocks, uint32_t count, bool backward) {
  float squares[SBRI_BLOCK] = {0}, max = 0;
  for (uint32_t b = 0; b < count; b++) {
    sbri_contact_block *block = &blocks[backward ? count - 1 - b : b];
    sbri_wide3 changes[SBRI_CONTACT_GROUPS];
    bool any = false;
    for (uint32_t lane = 0; block->is_near && lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide3 c = changes[lane / SBRI_LANES] = sbri_contact_correct(t, block, lane);
      sbri_wide square = sbri_wide3_along(c, c);
      any = any || sbri_mask_any(square > sbri_wide_all(0));
      sbri_wide_store(squares + lane, sbri_wide_max(square, sbri_wide_load(squares + lane)));
    }
    block->has_impulses = block->has_impulses || any;
    if (any) sbri_contact_scatter(t->scratch.velocity_points, block, changes);
  }
  for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) max = squares[lane] > max ? squares[lane] : max;
  return max;
}

/* Penetration correction of samples in contact, at a limited rate. Sequential, because contacts that share
 * points see each other's corrections. */
static inline void sbri_contact_correct_penetration(const sbri_island_tick *t,
    const sbri_contact_block *block, uint32_t lane, const sbri_contact_rule *rule) {
  sbf_vec3 n = {block->normal[0][lane], block->normal[1][lane], block->normal[2][lane]};
  float gap = -block->offset[lane];
  for (int k = 0; k < 4; k++) {
    const sbri_point *x = &t->positions[block->sample.slots[k][lane]];
    gap += block->sample.weights[k][lane] * (n.x * x->x + n.y * x->y + n.z * x->z);
  }
  float depth = -gap - rule->slack_m;
  depth = depth < rule->max_correction_m ? depth : rule->max_correction_m;
  for (int k = 0; depth > 0 && k < 4; k++) {
    sbri_point *x = &t->positions[block->sample.slots[k][lane]];
    float displacement = block->sample.responses[k][lane] * depth;
    x->x += displacement * n.x, x->y += displacement * n.y, x->z += displacement * n.z;
  }
}

/* Adds up the impulses of the block and corrects its penetration. */
static inline void sbri_contact_finish(
    const sbri_island_tick *t, sbri_contact_block *block, const sbri_contact_rule *rule) {
  float corrections[SBRI_BLOCK];
  bool any = false;
  for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
    sbri_wide zero = sbri_wide_all(0), velocity_change = sbri_wide_load(block->velocity_change + lane);
    sbri_wide3 n = sbri_load_rows(block->normal, lane), f = sbri_load_rows(block->friction_impulse, lane),
               total = sbri_load_rows(block->of_tick.velocity_change, lane);
    total.x = total.x + (f.x + n.x * velocity_change), total.y = total.y + (f.y + n.y * velocity_change),
    total.z = total.z + (f.z + n.z * velocity_change);
    sbri_store_rows(block->of_tick.velocity_change, lane, total);
    sbri_wide_store(block->of_tick.max_velocity_change + lane,
        sbri_wide_max(sbri_wide_load(block->of_tick.max_velocity_change + lane), velocity_change));
    sbri_wide depth = zero - sbri_wide_load(block->gap + lane) - sbri_wide_all(rule->slack_m);
    sbri_wide correction = sbri_wide_select(velocity_change > zero, depth, zero);
    sbri_wide_store(corrections + lane, correction);
    any = any || sbri_mask_any(correction > zero);
  }
  for (uint32_t lane = 0; any && lane < SBRI_BLOCK; lane++)
    if (corrections[lane] > 0) sbri_contact_correct_penetration(t, block, lane, rule);
}

/* Solves the contacts of a body for the coming substep: changes `velocities` so that no sample passes its
 * plane, and corrects the penetration of deep samples. */
static inline void sbri_contact_solve(
    const sbri_island_tick *t, const sbri_body *body, float *velocities, const sbri_contact_rule *rule) {
  uint32_t count = sbri_contact_block_count(t, body);
  sbri_contact_block *blocks = sbri_contact_blocks_of(t, body);
  bool changed = false, any = false;
  float fastest = sbri_contact_load_velocities(t, body, velocities),
        near = rule->step_s * SBRI_CONTACT_NEAR_M_S;
  for (uint32_t b = 0; b < count; b++) {
    blocks[b].is_near = false;
    blocks[b].clearance_m -= blocks[b].max_weight_sum * 2 * rule->step_s * fastest + rule->max_correction_m;
    if (blocks[b].clearance_m > near && !blocks[b].is_moving) continue;
    changed = sbri_contact_begin(t, &blocks[b], rule) || changed;
    any = any || blocks[b].is_near;
  }
  if (!any) return;
  if (changed) sbri_contact_sum_rows(t, body, blocks, count);
  sbri_contact_warm_start(t, blocks, count);
  float tolerance = SBRI_CONTACT_TOLERANCE_M_S * SBRI_CONTACT_TOLERANCE_M_S, square = tolerance;
  for (int i = 0; i < SBRI_MAX_CONTACT_ITERATIONS && square >= tolerance; i++)
    square = sbri_contact_iterate(t, blocks, count, i % 2);
  for (uint32_t b = 0; b < count; b++)
    if (blocks[b].is_near && blocks[b].has_impulses) sbri_contact_finish(t, &blocks[b], rule);
  sbri_contact_store_velocities(t, body, velocities);
}

#endif
