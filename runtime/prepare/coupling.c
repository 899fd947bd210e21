/* Coupling of soft and rigid bodies: the rigid bodies that each island is pinned to, the springs that reach
 * pinned points, and the maximum frequency of a rigid body on its soft bodies.
 *
 * The frequency is an upper bound: the soft points are fixed and the rigid body moves. Springs and regions
 * count with their stiffness in the worst direction, a tetrahedron with its P-wave modulus M = mu + lambda
 * (mechanics/neo_hookean.h) times V |G|^2, where G is its strain by a unit motion of the pinned corners.
 * Rotations about the principal axes count in the same way over the moments of inertia. The square of the
 * frequency is at most the sum of both. */
#include "mechanics/neo_hookean.h"
#include "prepare/prepare.h"

/* ---- Rigid bodies of islands ---- */

/* A bone belongs to the body of the nearest bone above it, or itself, that has one. */
bool sbri_attachments_list(sbr_model *model) {
  const sbri_rigid_model *rigid = &model->rigid;
  int32_t *attachments = sbfi_arena_allocate(&model->arena, model->frame_count, sizeof *attachments);
  if (!attachments) return false;
  for (uint32_t f = 0; f < model->frame_count; f++) attachments[f] = -1;
  for (uint32_t i = 0; i < model->rig.bones.count; i++) {
    uint32_t bone = model->rig.bones.subtree[i];
    int32_t parent = model->rig.bones.parents[bone];
    attachments[bone] = rigid->body_of_bone[bone] >= 0 ? rigid->body_of_bone[bone]
                        : parent >= 0                  ? attachments[parent]
                                                       : -1;
  }
  for (uint32_t b = 0; b < rigid->body_count; b++)
    if (rigid->own_frames[b] != UINT32_MAX) attachments[sbri_body_frame(model, b)] = (int32_t)b;
  model->rigid_body_of_frame = attachments;
  return true;
}

static bool list_pinned(sbr_model *model, sbri_island *island) {
  uint32_t pinned_count = island->slot_count - island->free_count, body_count = model->rigid.body_count;
  int32_t *of_pinned = sbfi_arena_allocate(&model->arena, (size_t)pinned_count + 1, sizeof *of_pinned);
  uint32_t *springs = sbfi_arena_allocate(&model->arena, (size_t)island->springs.count + 1, sizeof *springs);
  uint32_t *attachments = sbfi_arena_allocate(&model->arena, (size_t)body_count + 1, sizeof *attachments);
  if (!of_pinned || !springs || !attachments) return false;
  for (uint32_t i = 0; i < pinned_count; i++)
    of_pinned[i] = model->rigid_body_of_frame[island->pins.frames[i]];
  island->pins.rigid_bodies = of_pinned, island->pins.attachments = attachments,
  island->springs.pinned = springs;
  for (uint32_t b = 0; b < body_count; b++) {
    bool carries = false;
    for (uint32_t i = 0; i < pinned_count && !carries; i++) carries = of_pinned[i] == (int32_t)b;
    if (carries) attachments[island->pins.attachment_count++] = b;
  }
  for (uint32_t i = 0; i < island->springs.count; i++) {
    const sbfi_spring *s = &island->springs.at[i];
    if ((s->a >= island->free_count) != (s->b >= island->free_count))
      springs[island->springs.pinned_count++] = i;
  }
  return true;
}

/* ---- Stiffness ---- */

/* N/m, and N m/rad about each axis of the body. */
typedef struct stiffness {
  double along, about[3];
} stiffness;

static int32_t rigid_body_of_bone(const sbri_island *island, uint32_t slot) {
  return slot >= island->free_count ? island->pins.rigid_bodies[slot - island->free_count] : -1;
}

static sbf_vec3 local_arm(const sbri_rigid_body *body, const sbri_point *at) {
  sbf_vec3 arm = sbri_sub(sbri_vec3(at->x, at->y, at->z), body->center);
  return sbri_rotate(sbri_quat_conjugate(body->axes), arm);
}

static void add_point(
    const sbri_island *island, const sbri_rigid_body *body, uint32_t slot, double k, stiffness *sum) {
  sbf_vec3 r = local_arm(body, &island->rest[slot]);
  double x = (double)r.x, y = (double)r.y, z = (double)r.z;
  sum->along += k;
  sum->about[0] += k * (y * y + z * z), sum->about[1] += k * (z * z + x * x);
  sum->about[2] += k * (x * x + y * y);
}

static double square_of_strain(const sbfi_tetrahedron *t, const sbfi_d3 moves[4]) {
  double sum = 0;
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++)
      sum += sbfi_d3_dot(moves[i], moves[j]) * sbfi_d3_dot(t->gradients[i], t->gradients[j]);
  return sum;
}

static void add_tetrahedron(const sbri_island *island, const sbri_rigid_body *body, int32_t attachment,
    const sbfi_tetrahedron *t, const uint32_t slots[4], stiffness *sum) {
  double modulus = t->volume * (t->lame.mu + t->lame.lambda);
  sbfi_d3 moves[4];
  for (int i = 0; i < 4; i++)
    moves[i] = (sbfi_d3){rigid_body_of_bone(island, slots[i]) == attachment ? 1 : 0, 0, 0};
  sum->along += modulus * square_of_strain(t, moves);
  for (int axis = 0; axis < 3; axis++) {
    for (int i = 0; i < 4; i++) {
      sbfi_d3 r = sbfi_d3_of(local_arm(body, &island->rest[slots[i]]));
      sbfi_d3 rotated = axis == 0   ? (sbfi_d3){0, -r.z, r.y}
                        : axis == 1 ? (sbfi_d3){r.z, 0, -r.x}
                                    : (sbfi_d3){-r.y, r.x, 0};
      moves[i] = rigid_body_of_bone(island, slots[i]) == attachment ? rotated : (sbfi_d3){0, 0, 0};
    }
    /* In the body's axes on one side only: the norm does not depend on the other. */
    sum->about[axis] += modulus * square_of_strain(t, moves);
  }
}

static void add_tetrahedra(
    const sbr_model *model, const sbri_island *island, uint32_t attachment, stiffness *sum) {
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &model->bodies[island->bodies[b]];
    for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
      const uint32_t *points = body->level->lattice.tetrahedra.at[t].at;
      uint32_t slots[4], count = 0;
      for (int k = 0; k < 4; k++) {
        slots[k] = body->slots.from_point[points[k]];
        count += rigid_body_of_bone(island, slots[k]) == (int32_t)attachment;
      }
      sbfi_tetrahedron made;
      if (count % 4 == 0 || !sbri_body_tetrahedron(body, t, &made)) continue;
      add_tetrahedron(island, &model->rigid.bodies[attachment], (int32_t)attachment, &made, slots, sum);
    }
  }
}

static void add_regions(
    const sbri_island *island, const sbri_rigid_body *body, uint32_t attachment, stiffness *sum) {
  for (uint32_t b = 0; b < island->regions.block_count; b++) {
    const sbri_region_block *block = &island->regions.blocks[b];
    for (uint32_t i = 0; i < block->member_count * SBRI_BLOCK; i++) {
      const sbri_region_member *m = &island->regions.members[block->first_member + i / SBRI_BLOCK];
      uint32_t slot = m->slots[i % SBRI_BLOCK];
      if (rigid_body_of_bone(island, slot) == (int32_t)attachment)
        add_point(island, body, slot, (double)m->stiffness[i % SBRI_BLOCK], sum);
    }
  }
}

static void add_island(
    const sbr_model *model, const sbri_island *island, uint32_t attachment, stiffness *sum) {
  const sbri_rigid_body *body = &model->rigid.bodies[attachment];
  for (uint32_t i = 0; i < island->springs.pinned_count; i++) {
    const sbfi_spring *s = &island->springs.at[island->springs.pinned[i]];
    uint32_t pinned = s->a >= island->free_count ? s->a : s->b;
    if (rigid_body_of_bone(island, pinned) == (int32_t)attachment)
      add_point(island, body, pinned, (double)s->stiffness_n_m, sum);
  }
  add_tetrahedra(model, island, attachment, sum);
  add_regions(island, body, attachment, sum);
}

static float square_of(const sbri_rigid_body *body, const stiffness *s) {
  const float inverse_mass[3] = {body->inverse_inertia.x, body->inverse_inertia.y, body->inverse_inertia.z};
  double rotational = 0;
  for (int axis = 0; axis < 3; axis++) {
    double square = s->about[axis] * (double)inverse_mass[axis];
    rotational = square > rotational ? square : rotational;
  }
  return (float)(s->along * (double)body->inverse_mass + rotational);
}

/* ---- Attached mass ---- */

static void add_attached_mass(const sbr_model *model, uint32_t frame, const sbri_point *at, float mass) {
  int32_t attachment = model->rigid_body_of_frame[frame];
  if (attachment < 0) return;
  const sbri_rigid_body *body = &model->rigid.bodies[attachment];
  sbf_vec3 r = local_arm(body, at), inverse_mass = body->inverse_inertia;
  float rotational = inverse_mass.x > inverse_mass.y ? inverse_mass.x : inverse_mass.y;
  rotational = rotational > inverse_mass.z ? rotational : inverse_mass.z;
  model->rigid.attached_masses[attachment] += mass;
  model->rigid.pinned_weights[attachment] += mass * (body->inverse_mass + sbri_dot(r, r) * rotational);
}

static void add_attached_masses(const sbr_model *model, const sbri_island *island, const sbri_body *body) {
  for (uint32_t slot = body->slots.begin; body->is_pinned && slot < body->slots.real_end; slot++) {
    if (!body->drivers)
      add_attached_mass(model, body->driver_frame, &island->rest[slot], island->masses[slot]);
    for (int k = 0; body->drivers && k < SBRI_DRIVERS; k++) {
      const sbri_driver *driver = &body->drivers[slot - body->slots.begin];
      add_attached_mass(
          model, driver->frames[k], &island->rest[slot], driver->weights[k] * island->masses[slot]);
    }
  }
}

bool sbri_coupling_make(sbr_model *model) {
  sbri_rigid_model *rigid = &model->rigid; /* each detail level has its own */
  rigid->pinned_weights = sbfi_arena_allocate(&model->arena, (size_t)rigid->body_count + 1, sizeof(float));
  rigid->pinned_squares = sbfi_arena_allocate(&model->arena, (size_t)rigid->body_count + 1, sizeof(float));
  rigid->attached_masses = sbfi_arena_allocate(&model->arena, (size_t)rigid->body_count + 1, sizeof(float));
  rigid->attached =
      sbfi_arena_allocate(&model->arena, (size_t)rigid->body_count + 1, sizeof *rigid->attached);
  if (!rigid->pinned_weights || !rigid->pinned_squares || !rigid->attached_masses || !rigid->attached)
    return false;
  for (uint32_t i = 0; i < model->island_count; i++)
    if (!list_pinned(model, &model->islands[i])) return false;
  for (uint32_t i = 0; i < model->island_count; i++)
    for (uint32_t b = 0; b < model->islands[i].body_count; b++)
      add_attached_masses(model, &model->islands[i], &model->bodies[model->islands[i].bodies[b]]);
  for (uint32_t b = 0; b < model->rigid.body_count; b++) {
    stiffness sum = {0, {0, 0, 0}};
    for (uint32_t i = 0; i < model->island_count; i++)
      for (uint32_t k = 0; k < model->islands[i].pins.attachment_count; k++)
        if (model->islands[i].pins.attachments[k] == b) add_island(model, &model->islands[i], b, &sum);
    model->rigid.pinned_squares[b] = square_of(&model->rigid.bodies[b], &sum);
  }
  return true;
}
