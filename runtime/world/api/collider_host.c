/* Public calls for colliders: sbrun/collision.h. */
#include "base/diagnostic.h"
#include "math/usable.h"
#include "math/vec3.h"
#include "world/api/api.h"

enum { COLLIDER_COOKIE = 0x5b72636f, INDEX_BITS = 16 };

static const float OWN = -1; /* that of the body in contact */

bool sbri_collider_set_make(sbri_collider_set *set, uint32_t capacity, const sbf_allocator *allocator) {
  *set = (sbri_collider_set){.capacity = capacity};
  set->at = sbfi_allocate(allocator, capacity * sizeof *set->at);
  set->bounds = sbfi_allocate(allocator, capacity * sizeof *set->bounds);
  set->listed = sbfi_allocate(allocator, capacity * sizeof *set->listed);
  set->tree.items = sbfi_allocate(allocator, capacity * sizeof *set->tree.items);
  set->tree.nodes = sbfi_allocate(allocator, sbri_bounds_tree_nodes(capacity) * sizeof *set->tree.nodes);
  if (!set->at || !set->bounds || !set->listed || !set->tree.items || !set->tree.nodes) {
    sbri_collider_set_free(set, allocator);
    return false;
  }
  for (uint32_t i = 0; i < capacity; i++) set->at[i] = (sbri_collider){.shape = NULL};
  return true;
}

void sbri_collider_set_free(sbri_collider_set *set, const sbf_allocator *allocator) {
  size_t capacity = set->capacity;
  sbfi_free(allocator, set->at, capacity * sizeof *set->at);
  sbfi_free(allocator, set->bounds, capacity * sizeof *set->bounds);
  sbfi_free(allocator, set->listed, capacity * sizeof *set->listed);
  sbfi_free(allocator, set->tree.items, capacity * sizeof *set->tree.items);
  sbfi_free(allocator, set->tree.nodes, sbri_bounds_tree_nodes(set->capacity) * sizeof *set->tree.nodes);
}

sbr_collider_definition sbr_default_collider_definition(void) {
  return (sbr_collider_definition){.cookie = COLLIDER_COOKIE,
      .rotation = {0, 0, 0, 1},
      .inertia_axes = {0, 0, 0, 1},
      .friction = OWN,
      .restitution = OWN,
      .layer = 1,
      .mask = UINT32_MAX};
}

static sbri_collider *collider_of(const sbr_world *world, sbr_collider_id id) {
  uint32_t index = (id.value & 0xffff) - 1;
  if (!world || id.value == 0 || index >= world->colliders.capacity) return NULL;
  sbri_collider *c = &world->colliders.at[index];
  return c->shape && c->generation == id.value >> INDEX_BITS ? c : NULL;
}

static bool is_position(sbr_double3 position, sbf_quat rotation) {
  const double numbers[7] = {position.x, position.y, position.z, (double)rotation.x, (double)rotation.y,
      (double)rotation.z, (double)rotation.w};
  return sbri_usable(numbers, 7);
}

/* Checks a definition; SBF_OK if it has no error. */
static sbf_status check_body(
    const sbr_world *world, const sbr_collider_definition *d, sbf_diagnostic *error) {
  const double numbers[11] = {(double)d->mass, (double)d->inertia.x, (double)d->inertia.y,
      (double)d->inertia.z, (double)d->centre.x, (double)d->centre.y, (double)d->centre.z,
      (double)d->inertia_axes.x, (double)d->inertia_axes.y, (double)d->inertia_axes.z,
      (double)d->inertia_axes.w};
  if (!sbri_usable(numbers, 11) || numbers[0] < 0 || numbers[1] < 0 || numbers[2] < 0 || numbers[3] < 0)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_collider_create: mass %g kg, inertia %g %g %g kg m^2, its axes or its centre are invalid: use "
        "finite numbers up to 1e15, with a mass and inertia of at least 0",
        numbers[0], numbers[1], numbers[2], numbers[3]);
  const sbri_collider *leader = collider_of((sbr_world *)world, d->part_of);
  if (d->part_of.value && (!leader || !(leader->body.inverse_mass > 0)))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_collider_create: part_of is not a collider with a mass: create that one first, and create its "
        "parts without a mass");
  return SBF_OK;
}

static float inverse(float number) {
  return number > 0 ? 1 / number : 0;
}

static void mark_changed(sbr_world *world) {
  world->colliders.has_changed = true;
}

sbf_status sbr_collider_create(sbr_world *world, const sbr_collider_definition *definition,
    sbr_collider_id *collider, sbf_diagnostic *error) {
  if (!world || !definition || !collider)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_collider_create: NULL argument");
  *collider = (sbr_collider_id){0};
  if (definition->cookie != COLLIDER_COOKIE || !definition->shape)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_collider_create: begin the definition with sbr_default_collider_definition and set its shape");
  const double how[2] = {(double)definition->friction, (double)definition->restitution};
  if (!is_position(definition->position, definition->rotation) || !sbri_usable(how, 2))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_collider_create: position %g %g %g m, its rotation, friction %g or restitution %g is invalid: "
        "use finite numbers up to 1e15",
        definition->position.x, definition->position.y, definition->position.z, how[0], how[1]);
  if (check_body(world, definition, error) != SBF_OK) return SBF_FAILED;
  sbri_collider_set *set = &world->colliders;
  uint32_t index = 0;
  while (index < set->capacity && set->at[index].shape) index++;
  if (index == set->capacity)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_collider_create: the world already has its maximum of %u colliders: raise collider_capacity",
        (unsigned)set->capacity);
  sbf_quat rotation = sbri_quat_normalize(definition->rotation);
  sbri_collider *c = &set->at[index];
  if (set->end <= index) set->end = index + 1;
  *c = (sbri_collider){.shape = definition->shape,
      .generation = (c->generation + 1) & 0xffff,
      .from = definition->position,
      .to = definition->position,
      .next = definition->position,
      .rotation_from = rotation,
      .rotation_to = rotation,
      .rotation_next = rotation,
      .friction = definition->friction,
      .restitution = definition->restitution,
      .layer = definition->layer,
      .mask = definition->mask,
      .user_data = definition->user_data,
      .leader = index};
  if (definition->part_of.value)
    c->leader = (definition->part_of.value & 0xffff) - 1;
  else if (definition->mass > 0)
    c->body = (sbri_host_body){.inverse_mass = 1 / definition->mass,
        .inverse_inertias = {inverse(definition->inertia.x), inverse(definition->inertia.y),
            inverse(definition->inertia.z)},
        .axes = sbri_quat_normalize(definition->inertia_axes),
        .centre = definition->centre};
  mark_changed(world);
  *collider = sbri_collider_name(set, index);
  return SBF_OK;
}

bool sbr_collider_is_valid(const sbr_world *world, sbr_collider_id collider) {
  return collider_of(world, collider) != NULL;
}

void sbr_collider_set_user_data(sbr_world *world, sbr_collider_id collider, void *user_data) {
  sbri_collider *c = collider_of(world, collider);
  if (c) c->user_data = user_data;
}

void *sbr_collider_get_user_data(const sbr_world *world, sbr_collider_id collider) {
  const sbri_collider *c = collider_of(world, collider);
  return c ? c->user_data : NULL;
}

void sbr_collider_destroy(sbr_world *world, sbr_collider_id collider) {
  sbri_collider *c = collider_of(world, collider);
  if (!c) return;
  uint32_t index = (uint32_t)(c - world->colliders.at);
  for (uint32_t i = 0; i < world->colliders.end; i++) /* its other colliders lose their mass */
    if (world->colliders.at[i].leader == index) world->colliders.at[i].leader = i;
  *c = (sbri_collider){.generation = c->generation};
  mark_changed(world);
}

void sbr_collider_move(sbr_world *world, sbr_collider_id collider, sbr_double3 position, sbf_quat rotation) {
  sbri_collider *c = collider_of(world, collider);
  if (!c || !is_position(position, rotation)) return;
  c->next = position;
  c->rotation_next = sbri_quat_normalize(rotation);
  c->body.is_moving = false;
  mark_changed(world);
}

void sbr_collider_set_transform(
    sbr_world *world, sbr_collider_id collider, sbr_double3 position, sbf_quat rotation) {
  sbri_collider *c = collider_of(world, collider);
  if (!c || !is_position(position, rotation)) return;
  c->from = c->to = c->next = position;
  c->rotation_from = c->rotation_to = c->rotation_next = sbri_quat_normalize(rotation);
  c->body.is_moving = false;
  mark_changed(world);
}

/* Changes of velocity below this fraction of gravity's, and below this speed in m/s, are ignored: hosts damp
 * their bodies. */
static const float MIN_GRAVITY_FRACTION = 0.2f, MIN_CHANGE_M_S = 0.01f;

/* Impulse of the host's other bodies since the motion was last set, from the velocity change. */
static void find_external_impulse(sbri_host_body *b, const sbr_collider_motion *m, sbf_vec3 velocity) {
  b->blocked_normal = sbri_vec3(0, 0, 0);
  if (!b->is_moving || !(m->since_s > 0)) {
    b->contributor_count = b->next_contributor_count = 0;
    return;
  }
  sbf_vec3 expected =
      sbri_add_scaled(sbri_scale(b->acceleration, m->since_s), b->reported_impulse, b->inverse_mass);
  sbf_vec3 other = sbri_sub(sbri_sub(velocity, b->reported_velocity), expected);
  float size = sbri_length(other), weight = sbri_length(b->acceleration) * m->since_s;
  if (size > MIN_GRAVITY_FRACTION * weight + MIN_CHANGE_M_S) b->blocked_normal = sbri_scale(other, 1 / size);
}

void sbr_collider_set_motion(sbr_world *world, sbr_collider_id collider, const sbr_collider_motion *motion) {
  sbri_collider *c = collider_of(world, collider);
  if (!c || !motion || !is_position(motion->position, motion->rotation)) return;
  const sbf_vec3 v = motion->velocity, w = motion->angular_velocity, a = motion->acceleration;
  const double numbers[10] = {(double)v.x, (double)v.y, (double)v.z, (double)w.x, (double)w.y, (double)w.z,
      (double)a.x, (double)a.y, (double)a.z, (double)motion->since_s};
  if (!sbri_usable(numbers, 10)) return;
  c->to = c->next = motion->position;
  c->rotation_to = c->rotation_next = sbri_quat_normalize(motion->rotation);
  sbf_vec3 of_mass = sbri_add(v, sbri_cross(w, sbri_rotate(c->rotation_to, c->body.centre)));
  find_external_impulse(&c->body, motion, of_mass);
  c->body.is_moving = c->body.is_reported = true;
  c->body.velocity = v, c->body.reported_velocity = of_mass, c->body.angular_velocity = w,
  c->body.acceleration = a;
  c->body.reported_impulse = sbri_vec3(0, 0, 0);
  mark_changed(world);
}

static sbf_vec3 round_sum(double sum[3]) {
  sbf_vec3 all = {(float)sum[0], (float)sum[1], (float)sum[2]};
  sum[0] = sum[1] = sum[2] = 0;
  return all;
}

sbr_collider_impulse sbr_collider_take_impulse(sbr_world *world, sbr_collider_id collider) {
  sbri_collider *c = collider_of(world, collider);
  if (!c) return (sbr_collider_impulse){{0, 0, 0}, {0, 0, 0}};
  sbf_vec3 impulse = round_sum(c->impulse);
  sbri_host_body *body = &world->colliders.at[c->leader].body;
  body->reported_impulse = sbri_add(body->reported_impulse, impulse);
  return (sbr_collider_impulse){impulse, round_sum(c->moment)};
}
