/* The host's shapes in a world: sbrun/collision.h. */
#include "api/api.h"
#include "base/diagnostic.h"
#include "math/usable.h"

enum { COLLIDER_COOKIE = 0x5b72636f, INDEX_BITS = 16 };

static const float OWN = -1; /* of what touches */

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
      .friction = OWN,
      .restitution = OWN,
      .layer = 1,
      .mask = UINT32_MAX};
}

static sbri_collider *collider_of(sbr_world *world, sbr_collider_id id) {
  uint32_t index = (id.value & 0xffff) - 1;
  if (!world || id.value == 0 || index >= world->colliders.capacity) return NULL;
  sbri_collider *c = &world->colliders.at[index];
  return c->shape && c->generation == id.value >> INDEX_BITS ? c : NULL;
}

static bool is_place(sbr_double3 position, sbf_quat turn) {
  const double numbers[7] = {
      position.x, position.y, position.z, (double)turn.x, (double)turn.y, (double)turn.z, (double)turn.w};
  return sbri_usable(numbers, 7);
}

static void stir(sbr_world *world) {
  world->colliders.stirred = true;
}

sbf_status sbr_collider_create(sbr_world *world, const sbr_collider_definition *definition,
    sbr_collider_id *collider, sbf_diagnostic *error) {
  if (!world || !definition || !collider)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_collider_create: NULL argument");
  *collider = (sbr_collider_id){0};
  if (definition->cookie != COLLIDER_COOKIE || !definition->shape)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_collider_create: begin the definition with sbr_default_collider_definition, and give it a "
        "shape");
  const double how[2] = {(double)definition->friction, (double)definition->restitution};
  if (!is_place(definition->position, definition->rotation) || !sbri_usable(how, 2))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_collider_create: position %g %g %g m, its rotation, friction %g or restitution %g: give finite "
        "numbers, to 1e15",
        definition->position.x, definition->position.y, definition->position.z, how[0], how[1]);
  sbri_collider_set *set = &world->colliders;
  uint32_t index = 0;
  while (index < set->capacity && set->at[index].shape) index++;
  if (index == set->capacity)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_collider_create: the world holds its %u colliders already: raise collider_capacity",
        (unsigned)set->capacity);
  sbf_quat turn = sbri_quat_normalize(definition->rotation);
  sbri_collider *c = &set->at[index];
  if (set->end <= index) set->end = index + 1;
  *c = (sbri_collider){.shape = definition->shape,
      .generation = (c->generation + 1) & 0xffff,
      .from = definition->position,
      .to = definition->position,
      .next = definition->position,
      .turn_from = turn,
      .turn_to = turn,
      .turn_next = turn,
      .friction = definition->friction,
      .restitution = definition->restitution,
      .layer = definition->layer,
      .mask = definition->mask};
  stir(world);
  *collider = sbri_collider_name(set, index);
  return SBF_OK;
}

void sbr_collider_destroy(sbr_world *world, sbr_collider_id collider) {
  sbri_collider *c = collider_of(world, collider);
  if (!c) return;
  *c = (sbri_collider){.generation = c->generation};
  stir(world);
}

void sbr_collider_move(sbr_world *world, sbr_collider_id collider, sbr_double3 position, sbf_quat rotation) {
  sbri_collider *c = collider_of(world, collider);
  if (!c || !is_place(position, rotation)) return;
  c->next = position;
  c->turn_next = sbri_quat_normalize(rotation);
  stir(world);
}

void sbr_collider_place(sbr_world *world, sbr_collider_id collider, sbr_double3 position, sbf_quat rotation) {
  sbri_collider *c = collider_of(world, collider);
  if (!c || !is_place(position, rotation)) return;
  c->from = c->to = c->next = position;
  c->turn_from = c->turn_to = c->turn_next = sbri_quat_normalize(rotation);
  stir(world);
}

static sbf_vec3 taken(double sum[3]) {
  sbf_vec3 all = {(float)sum[0], (float)sum[1], (float)sum[2]};
  sum[0] = sum[1] = sum[2] = 0;
  return all;
}

sbr_collider_push sbr_collider_take_push(sbr_world *world, sbr_collider_id collider) {
  sbri_collider *c = collider_of(world, collider);
  if (!c) return (sbr_collider_push){{0, 0, 0}, {0, 0, 0}};
  sbf_vec3 impulse = taken(c->impulse);
  return (sbr_collider_push){impulse, taken(c->moment)};
}
