/* Invariants of a world's state between two steps: sbrun/debug.h. */
#include <stdio.h>

#include "base/diagnostic.h"
#include "coupling/body_contact/body_contacts.h"
#include "coupling/ragdoll/ragdoll.h"
#include "math/usable.h"

/* What is checked, for messages. */
typedef struct checking {
  const sbr_world *world;
  const sbri_character *c; /* NULL: the world's own */
  char position[48];
  const char *fault; /* NULL: none yet */
} checking;

/* Stores the first violated invariant; returns whether this one holds. */
static bool expect(checking *k, bool holds, const char *rule) {
  if (!holds && !k->fault) k->fault = rule;
  return holds;
}

static void enter(checking *k, const char *what, uint32_t index) {
  if (!k->fault) snprintf(k->position, sizeof k->position, "%s %u", what, (unsigned)index);
}

static bool is_finite(sbf_vec3 v) {
  return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static bool is_rotation(sbf_quat q) {
  float square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  return square > 0.99f && square < 1.01f;
}

static void check_pose(checking *k, const sbr_transform *pose, const char *what, uint32_t index) {
  enter(k, what, index);
  expect(k, is_finite(pose->position), "its position is not finite");
  expect(k, is_rotation(pose->rotation), "its rotation is not a unit quaternion");
}

/* ---- Soft bodies ---- */

static void check_points(checking *k, uint32_t number) {
  const sbri_island *island = &k->c->model->islands[number];
  const sbri_point *positions = sbri_positions(k->c) + island->first_slot;
  const float *velocities = sbri_velocities(k->c) + 3 * (size_t)island->first_slot;
  enter(k, "island", number);
  bool finite = true;
  for (uint32_t i = 0; i < island->slot_count; i++)
    finite = finite && isfinite(positions[i].x) && isfinite(positions[i].y) && isfinite(positions[i].z);
  expect(k, finite, "a position of its points is not finite");
  finite = true;
  for (size_t i = 0; i < 3 * (size_t)island->free_count; i++) finite = finite && isfinite(velocities[i]);
  expect(k, finite, "a velocity of its points is not finite");
  const sbri_island_state *state = &sbri_island_states(k->c)[number];
  expect(k, state->asleep <= 1 && state->reported_asleep <= 1, "its sleep flag is neither 0 nor 1");
  expect(k, isfinite(state->stretch) && isfinite(state->min_ratio), "its measured strain is not finite");
}

/* Contacts of the last tick; scratch, which only stepped bodies have. */
static void check_contacts(checking *k, uint32_t number) {
  const sbri_body *body = &k->c->model->bodies[number];
  if (!body->level || sbri_header(k->c)->asleep || sbri_island_states(k->c)[body->island].asleep) return;
  uint32_t count = sbri_contact_counts(k->c)[number];
  enter(k, "soft body", number);
  if (!expect(k, count <= body->contact.max_count, "it has more contacts than its capacity")) return;
  for (uint32_t i = 0; i < count; i++) {
    const sbri_soft_contact *contact = &sbri_contacts(k->c)[body->contact.first + i];
    uint32_t slots = k->c->model->islands[body->island].slot_count;
    for (int p = 0; p < 4; p++)
      expect(k, contact->sample.slots[p] < slots, "a contact is on a point that is not in its island");
    float square = sbri_dot(contact->normal, contact->normal);
    expect(k, square > 0.99f && square < 1.01f, "a contact's normal is not of unit length");
    expect(k,
        contact->collider == SBRI_NO_COLLIDER || contact->collider == SBRI_ITSELF ||
            contact->collider < k->world->colliders.capacity,
        "a contact is with a collider that does not exist");
  }
}

/* ---- Rigid bodies ---- */

static void check_rigid_bodies(checking *k) {
  const sbri_rigid_model *model = &k->c->model->rigid;
  const sbri_rigid_drive_state *drive = sbri_rigid_drive(k->c);
  for (uint32_t b = 0; drive->any_dynamic && b < model->body_count; b++) {
    const sbri_rigid_body_state *body = &sbri_rigid_bodies(k->c)[b];
    check_pose(k, &body->pose, "rigid body", b);
    expect(k, is_finite(body->velocity) && is_finite(body->angular_momentum), "its velocity is not finite");
    expect(k, body->mode <= SBR_RIGID_DRIVEN, "its mode is not one of sbr_rigid_mode");
  }
  if (model->body_count == 0) return;
  enter(k, "rigid contacts of the character", 0);
  if (!expect(k, drive->stored_contacts <= sbri_rigid_contact_capacity(model),
          "there are more than the capacity"))
    return;
  for (uint32_t i = 0; i < drive->stored_contacts; i++)
    expect(k, sbri_rigid_kept(k->c)[i].body < model->body_count, "one belongs to a body that does not exist");
}

static void check_character(checking *k) {
  const sbri_character *c = k->c;
  const sbri_character_state *head = sbri_header(c);
  const double numbers[] = {head->origin.x, head->origin.y, head->origin.z};
  enter(k, "state", 0);
  expect(k, sbri_usable(numbers, 3), "its origin is not finite");
  expect(k, c->scale > 0 && isfinite(c->scale), "its scale is not positive");
  expect(k,
      head->detail_level < c->model->detail.base->detail.level_count ||
          c->model->detail.base->detail.level_count == 0,
      "its level of detail does not exist");
  expect(k, head->paused <= 1 && head->asleep <= 1, "its sleep flag is neither 0 nor 1");
  for (uint32_t f = 0; f < c->model->frame_count; f++) check_pose(k, &sbri_pose(c)[f], "frame", f);
  for (uint32_t i = 0; i < c->model->island_count; i++) check_points(k, i);
  for (uint32_t b = 0; b < c->model->asset->soft_bodies.count; b++) check_contacts(k, b);
  check_rigid_bodies(k);
}

/* ---- World ---- */

static void check_colliders(checking *k) {
  const sbri_collider_set *set = &k->world->colliders;
  for (uint32_t i = 0; i < set->capacity; i++) {
    const sbri_collider *collider = &set->at[i];
    if (!collider->shape) continue;
    const double numbers[] = {collider->to.x, collider->to.y, collider->to.z};
    enter(k, "collider", i);
    expect(k, i < set->end, "it is beyond the end of the list");
    expect(k, sbri_usable(numbers, 3) && is_rotation(collider->rotation_to), "its pose is not finite");
    expect(k, collider->leader < set->capacity, "the body that it is part of does not exist");
  }
}

static bool is_before(const uint64_t a[2], const uint64_t b[2]) {
  return a[0] != b[0] ? a[0] < b[0] : a[1] < b[1];
}

static void check_body_contacts(checking *k) {
  const sbri_body_contacts *all = k->world->body_contacts;
  if (!all) return;
  enter(k, "contacts of bodies", 0);
  expect(k, all->cache.count <= all->contact_capacity, "more impulses are stored than the capacity");
  expect(k, all->pair_reports.count <= all->contact_capacity, "more pairs touch than the capacity");
  for (uint32_t i = 1; i < all->pair_reports.count; i++)
    expect(k, is_before(all->pair_reports.at[i - 1].body_ids, all->pair_reports.at[i].body_ids),
        "pairs are not in ascending order");
  for (uint32_t i = 0; i < all->cache.count; i++) {
    const sbri_cached_contact *cached = &all->cache.at[i];
    expect(k, cached->next == UINT32_MAX || (cached->next > i && cached->next < all->cache.count),
        "the list of stored impulses of two bodies does not end");
    expect(k, isfinite(cached->normal_force) && is_finite(cached->friction_force),
        "a stored impulse is not finite");
  }
}

sbf_status sbr_world_validate(const sbr_world *world, sbf_diagnostic *error) {
  if (!world) return SBF_OK;
  checking k = {.world = world};
  for (uint32_t i = 0; i < SBRI_EVENT_KINDS; i++) {
    enter(&k, "events", i);
    expect(&k, world->events.counts[i] <= world->events.capacity, "there are more than the capacity");
  }
  check_colliders(&k);
  check_body_contacts(&k);
  if (k.fault) return sbfi_diagnose(error, SBF_CODE_WORLD_INVALID, "world, %s: %s", k.position, k.fault);
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    k.c = &world->characters[i];
    if (!k.c->model) continue;
    check_character(&k);
    if (k.fault)
      return sbfi_diagnose(
          error, SBF_CODE_WORLD_INVALID, "character %u, %s: %s", (unsigned)i, k.position, k.fault);
  }
  return SBF_OK;
}
