/* Sets positions of soft bodies at once: to their rest shape, or along with their frames. */
#include <string.h>

#include "math/quat.h"
#include "mechanics/shape_region.h"
#include "shapes/ground.h"
#include "soft/soft.h"
#include "soft/solvers/scheme.h"
#include "soft/tear/tear.h"

/* Zero velocity; the relaxation scheme stores previous positions instead. */
static void stop(sbri_character *c, uint32_t island_index) {
  sbri_island_wake(c, island_index);
  const sbri_island *island = &c->model->islands[island_index];
  sbri_drivers_stop(c, island);
  const sbri_point *positions = sbri_positions(c) + island->first_slot;
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  memset(velocities, 0, 3 * (size_t)island->free_count * sizeof *velocities);
  if (!island->scheme->forceless) return;
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    float *previous = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    previous[0] = positions[slot].x, previous[SBRI_BLOCK] = positions[slot].y;
    previous[2 * SBRI_BLOCK] = positions[slot].z;
  }
}

/* Frame for the rotation of a body: its pin frame, else the root. */
static uint32_t rotation_frame(const sbri_character *c, const sbri_body *body) {
  return body->is_pinned && !body->drivers ? body->driver_frame : sbri_root_frame(c->model);
}

/* Sets the rotations of the body's regions to `first`, or multiplies them by `rotation` if `first` is NULL.
 */
static void rotate_regions(
    sbri_character *c, const sbri_body *body, const sbf_quat *first, sbf_quat rotation) {
  const sbri_island *island = &c->model->islands[body->island];
  for (uint32_t b = body->elements.first_region_block; b < body->elements.region_block_end; b++) {
    float *q = sbri_rotations(c) + 4 * SBRI_BLOCK * (size_t)(island->regions.first_rotation + b);
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
      sbf_quat previous = {q[lane], q[SBRI_BLOCK + lane], q[2 * SBRI_BLOCK + lane], q[3 * SBRI_BLOCK + lane]};
      sbf_quat now = first ? *first : sbri_quat_normalize(sbri_quat_multiply(rotation, previous));
      q[lane] = now.x, q[SBRI_BLOCK + lane] = now.y;
      q[2 * SBRI_BLOCK + lane] = now.z, q[3 * SBRI_BLOCK + lane] = now.w;
    }
  }
}

void sbri_island_reset_to_rest(sbri_character *c, uint32_t island_index) {
  const sbri_island *island = &c->model->islands[island_index];
  sbri_point *positions = sbri_positions(c) + island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    sbri_compute_driver_positions(c->model, body, sbri_deltas(c), positions + body->slots.begin);
    rotate_regions(c, body, &sbri_deltas(c)[rotation_frame(c, body)].rotation, sbri_quat_identity());
    sbri_follow_origins(c, body, positions + body->slots.begin);
  }
  sbri_compute_pin_targets(island, sbri_deltas(c), positions);
  stop(c, island_index);
  sbri_island_states(c)[island_index].stretch = island->springs.rest_stretch;
  sbri_island_states(c)[island_index].stiffening = 1;
  sbri_island_states(c)[island_index].min_ratio = 1;
  sbri_island_states(c)[island_index].collapsed_ticks = 0;
  sbri_island_states(c)[island_index].unstable = 0;
  sbri_island_states(c)[island_index].excess_j = 0;
  sbri_island_states(c)[island_index].damping_ticks = 0;
}

static void reset_yielded_solids(sbri_character *c, const sbri_island *island) {
  const uint32_t *torn = sbri_torn(c) + island->tetrahedra.first_state;
  sbri_tetrahedron_block *blocks = sbri_solids(c) + island->tetrahedra.first_state_block;
  for (uint32_t t = 0; t < island->tetrahedra.count; t++)
    for (int n = 0; n < 2 && !torn[t]; n++) {
      uint32_t at = island->tetrahedra.lanes[2 * t + (uint32_t)n], lane = at % SBRI_BLOCK;
      for (int i = 0; i < 6; i++)
        blocks[at / SBRI_BLOCK].stiffness[i][lane] =
            island->tetrahedra.blocks[at / SBRI_BLOCK].stiffness[i][lane];
    }
}

/* Mean position of the body's points; returns false if it is not usable. */
static bool center_of(const sbri_body *body, const sbri_point *positions, sbf_vec3 *center) {
  sbf_vec3 sum = {0, 0, 0};
  uint32_t count = body->slots.real_end - body->slots.begin;
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
    sum = sbri_add(sum, sbri_vec3(positions[slot].x, positions[slot].y, positions[slot].z));
  *center = sbri_scale(sum, count ? 1 / (float)count : 0);
  return count > 0 && sbri_dot(*center, *center) < 1e12f;
}

/* Rotation of the body at `positions` relative to its rest shape. */
static sbf_quat rotation_of(const sbri_island *island, const sbri_body *body, const sbri_point *positions) {
  sbfi_region_sums sums = {0};
  sbfi_d3 moment = {0, 0, 0};
  double weight = 0;
  for (int pass = 0; pass < 2; pass++)
    for (uint32_t slot = body->slots.begin; slot < body->slots.first_spare; slot++) {
      const sbri_point *r = &island->rest[slot], *x = &positions[slot];
      sbfi_d3 rest = {r->x, r->y, r->z}, at = {x->x, x->y, x->z};
      double m = (double)island->masses[slot];
      if (pass == 0)
        moment = sbfi_d3_add(moment, sbfi_d3_scale(rest, m)), weight += m;
      else if (m > 0)
        sbfi_region_add(&sums, m, sbfi_d3_sub(rest, sbfi_d3_scale(moment, 1 / weight)), at);
    }
  if (!(weight > 0)) return sbri_quat_identity();
  sbfi_region_fit fit = sbfi_region_fit_of(&sums);
  return sbri_quat_from_axes(
      sbfi_d3_rounded(fit.columns[0]), sbfi_d3_rounded(fit.columns[1]), sbfi_d3_rounded(fit.columns[2]));
}

static void rotate_body(
    sbri_character *c, const sbri_body *body, sbri_point *positions, sbf_vec3 about, sbf_quat rotation) {
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) {
    sbri_point *p = &positions[slot];
    sbf_vec3 at = sbri_add(about, sbri_rotate(rotation, sbri_sub(sbri_vec3(p->x, p->y, p->z), about)));
    *p = (sbri_point){at.x, at.y, at.z, 0};
  }
  rotate_regions(c, body, NULL, rotation);
}

static void shift(const sbri_body *body, sbri_point *positions, sbf_vec3 offset) {
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) {
    sbri_point *p = &positions[slot];
    *p = (sbri_point){p->x + offset.x, p->y + offset.y, p->z + offset.z, 0};
  }
}

/* Penetration of the body into the ground, asset metres. */
static float depth_of(
    const sbri_character *c, const sbri_body *body, const sbri_point *positions, const sbr_ground *ground) {
  sbr_double3 origin = sbri_header(c)->origin;
  double deepest = 0, scale = c->scale;
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    const sbri_point *p = &positions[slot];
    double height = sbri_ground_height(ground, origin.x + scale * p->x, origin.z + scale * p->z, NULL);
    double depth = (height - origin.y) / scale - (double)p->y;
    deepest = depth > deepest ? depth : deepest;
  }
  return (float)deepest;
}

void sbri_island_reset_in_place(sbri_character *c, uint32_t island_index, const sbr_ground *ground) {
  const sbri_island *island = &c->model->islands[island_index];
  sbri_point *positions = sbri_positions(c) + island->first_slot;
  const sbri_point *previous =
      sbri_previous_positions(c) + island->first_slot;       /* present positions may be invalid */
  sbri_point *centers = sbri_begins(c) + island->first_slot; /* a body has at least one block of slots */
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    sbf_vec3 center = {0, 0, 0};
    bool is_valid = !body->is_pinned && center_of(body, previous, &center);
    if (body->slots.end == body->slots.begin) continue;
    centers[body->slots.begin] = (sbri_point){center.x, center.y, center.z, is_valid ? 1 : 0};
    if (!is_valid) continue;
    sbf_quat old_rotation = rotation_of(island, body, previous);
    centers[body->slots.begin + 1] =
        (sbri_point){old_rotation.x, old_rotation.y, old_rotation.z, old_rotation.w};
  }
  sbri_island_reset_to_rest(c, island_index);
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    sbf_vec3 now;
    if (body->slots.end == body->slots.begin || !(centers[body->slots.begin].w > 0)) continue;
    const sbri_point *old_center = &centers[body->slots.begin];
    if (!center_of(body, positions, &now)) continue;
    const sbri_point *old_rotation = old_center + 1;
    sbf_quat frame = sbri_deltas(c)[rotation_frame(c, body)].rotation;
    rotate_body(c, body, positions, now,
        sbri_quat_normalize(
            sbri_quat_multiply((sbf_quat){old_rotation->x, old_rotation->y, old_rotation->z, old_rotation->w},
                sbri_quat_conjugate(frame))));
    shift(body, positions, sbri_sub(sbri_vec3(old_center->x, old_center->y, old_center->z), now));
    shift(body, positions, sbri_vec3(0, depth_of(c, body, positions, ground), 0));
  }
}

void sbri_island_reset_flow(sbri_character *c, uint32_t island_index) {
  const sbri_island *island = &c->model->islands[island_index];
  sbri_island_states(c)[island_index].max_flow_stretch = 1;
  if (island->tetrahedra.flow) reset_yielded_solids(c, island);
  if (!island->links.flows) return;
  float *rests = sbri_rests(c) + island->links.first_flow;
  for (uint32_t block = 0; block < island->links.block_count; block++)
    memcpy(rests + (size_t)block * SBRI_BLOCK, island->links.blocks[block].rest,
        sizeof island->links.blocks[block].rest);
}

void sbri_restore_elements(sbri_character *c) {
  memset(sbri_torn(c), 0, c->model->counts.state_tetrahedra * sizeof *sbri_torn(c));
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    const sbri_island *island = &c->model->islands[i];
    if (island->tetrahedra.flow)
      memcpy(sbri_solids(c) + island->tetrahedra.first_state_block, island->tetrahedra.blocks,
          island->tetrahedra.block_count * sizeof *island->tetrahedra.blocks);
    sbri_island_reset_flow(c, i);
  }
  sbri_reset_splits(c);
  sbri_restore_skins(c);
  for (uint32_t i = 0; i < c->model->counts.flows; i++) sbri_strengths(c)[i] = 1;
}

void sbri_character_stop(sbri_character *c) {
  memcpy(sbri_previous_pose(c), sbri_pose(c), c->model->frame_count * sizeof(sbr_transform));
  sbri_gait_begin_tick(&c->model->rig, sbri_gait(c));
  memcpy(sbri_previous_positions(c), sbri_positions(c), c->model->slot_count * sizeof(sbri_point));
}

void sbri_character_reset_to_rest(sbri_character *c) {
  sbri_deltas_make(c, sbri_pose(c), 1, sbri_deltas(c));
  for (uint32_t i = 0; i < c->model->island_count; i++) sbri_island_reset_to_rest(c, i);
  sbri_character_stop(c);
}

/* Moves the points of a body with their drivers, and rotates their offsets from them. */
static void move_body_with_frames(sbri_character *c, const sbri_body *body, sbri_point *positions) {
  const sbri_delta *from = sbri_previous_deltas(c), *to = sbri_deltas(c);
  uint32_t frame = rotation_frame(c, body);
  sbf_quat rotation =
      sbri_quat_normalize(sbri_quat_multiply(to[frame].rotation, sbri_quat_conjugate(from[frame].rotation)));
  rotate_regions(c, body, NULL, rotation);
  size_t first = c->model->islands[body->island].first_slot;
  sbri_point *old_drivers = sbri_begins(c) + first, *new_drivers = sbri_velocity_points(c) + first;
  uint32_t count = body->slots.end - body->slots.begin;
  if (body->is_pinned) {
    sbri_compute_driver_positions(c->model, body, from, old_drivers);
    sbri_compute_driver_positions(c->model, body, to, new_drivers);
    sbri_follow_origins(c, body, old_drivers);
    sbri_follow_origins(c, body, new_drivers);
  }
  for (uint32_t i = 0; i < count; i++) {
    sbri_point *p = &positions[body->slots.begin + i];
    sbf_vec3 old_position = from[frame].position, new_position = to[frame].position;
    if (body->is_pinned) {
      old_position = sbri_vec3(old_drivers[i].x, old_drivers[i].y, old_drivers[i].z);
      new_position = sbri_vec3(new_drivers[i].x, new_drivers[i].y, new_drivers[i].z);
    }
    sbf_vec3 offset = sbri_sub(sbri_vec3(p->x, p->y, p->z), old_position);
    sbf_vec3 at = sbri_add(new_position, sbri_rotate(rotation, offset));
    *p = (sbri_point){at.x, at.y, at.z, 0};
  }
}

void sbri_island_move_with_frames(sbri_character *c, uint32_t island_index) {
  const sbri_island *island = &c->model->islands[island_index];
  sbri_point *positions = sbri_positions(c) + island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++)
    move_body_with_frames(c, &c->model->bodies[island->bodies[b]], positions);
  sbri_compute_pin_targets(island, sbri_deltas(c), positions);
  stop(c, island_index);
}
