/* Broad phase: pairs of bodies with overlapping swept bounds, and the groups of characters that follow. */
#include <string.h>

#include "base/assert.h"
#include "coupling/body_contact/body_contacts.h"
#include "math/vec3.h"
#include "model/reach.h"
#include "soft/solvers/scheme.h"

/* Bounds of motion in a tick: twice the present displacement and this fraction of the size. */
static const float MOTION_FRACTION = 0.05f;

/* ---- Bodies ---- */

static sbri_box soft_box(const sbr_world *world, const sbri_character *c, const sbri_body *body) {
  const sbri_island *island = &c->model->islands[body->island];
  const sbri_point *points = sbri_positions(c) + island->first_slot;
  const float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  uint32_t first = body->slots.begin < body->slots.real_end ? body->slots.begin : island->free_count;
  sbri_box box = sbri_box_of_point(sbri_vec3(points[first].x, points[first].y, points[first].z));
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++)
    box = sbri_box_with(box, sbri_vec3(points[slot].x, points[slot].y, points[slot].z));
  for (uint32_t slot = island->free_count; body->is_pinned && slot < island->slot_count; slot++)
    box = sbri_box_with(box, sbri_vec3(points[slot].x, points[slot].y, points[slot].z));
  sbf_vec3 size = sbri_sub(box.high, box.low);
  float margin = 2 * sbri_fastest_of(body, velocities) * (float)world->time.tick_s * c->time_scale +
                 MOTION_FRACTION * body->rest_size_m + body->source->collision.outer_thickness +
                 body->contact.margin_m + body->contact.max_extrapolation * (size.x + size.y + size.z);
  return sbri_box_in_world(sbri_box_grown(box, margin), sbri_header(c)->origin, c->scale);
}

static sbri_box rigid_box(const sbr_world *world, const sbri_character *c, uint32_t b) {
  const sbri_rigid_body *body = &c->model->rigid.bodies[b];
  const sbri_rigid_body_state *s = &sbri_rigid_bodies(c)[b];
  bool simulated = sbri_rigid_is_simulated(c, b);
  sbr_transform now = simulated ? s->pose : sbri_rigid_target(c, sbri_pose(c), b),
                before = sbri_rigid_target(c, sbri_previous_pose(c), b);
  float tick_s = (float)world->time.tick_s * c->time_scale;
  float displacement =
      simulated ? sbri_length(s->velocity) * tick_s : sbri_length(sbri_sub(now.position, before.position));
  float margin = body->radius * (1 + MOTION_FRACTION) + 2 * displacement;
  return sbri_box_in_world(
      sbri_box_grown(sbri_box_of_point(now.position), margin), sbri_header(c)->origin, c->scale);
}

static void add(sbri_body_contacts *all, sbri_contact_body body, sbri_box box) {
  all->broad_phase.boxes[all->broad_phase.body_count] = box;
  all->broad_phase.bodies[all->broad_phase.body_count++] = body;
}

static void list_character(sbr_world *world, uint32_t index) {
  const sbri_character *c = &world->characters[index];
  const sbr_model *model = c->model;
  if (model->detail.base->detail.definitions[sbri_header(c)->detail_level].kind == SBR_DETAIL_OFFSCREEN)
    return; /* no other character is near */
  for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++) {
    const sbri_body *body = &model->bodies[b];
    const sbf_collision *rule = &body->source->collision;
    if (!body->level || model->islands[body->island].scheme->forceless) continue;
    add(world->body_contacts,
        (sbri_contact_body){.character = index,
            .body_index = b,
            .is_dynamic = true,
            .self_contact = rule->self && !body->self.faces,
            .layer = rule->layer,
            .mask = rule->mask},
        soft_box(world, c, body));
  }
  for (uint32_t b = 0; b < model->rigid.body_count; b++) {
    const sbf_rigid_body *source = model->rigid.bodies[b].source;
    if (!model->rigid.bodies[b].hull.face_count) continue;
    add(world->body_contacts,
        (sbri_contact_body){.character = index,
            .body_index = b,
            .rigid = true,
            .is_dynamic = sbri_rigid_is_simulated(c, b),
            .layer = source->layer,
            .mask = source->mask},
        rigid_box(world, c, b));
  }
}

/* ---- Pairs ---- */

static bool are_jointed(const sbri_rigid_model *model, uint32_t a, uint32_t b) {
  for (uint32_t k = model->bodies[a].joint_begin; k < model->bodies[a].joint_end; k++) {
    const int32_t *bodies = model->joints[model->joints_of[k]].bodies;
    if (bodies[0] == (int32_t)b || bodies[1] == (int32_t)b) return true;
  }
  return false;
}

/* Parts of a character that do not collide: bodies at a joint, a soft body and its bones, sections that touch
 * at rest. */
static bool are_connected(const sbr_world *world, const sbri_contact_body *a, const sbri_contact_body *b) {
  const sbr_model *model = world->characters[a->character].model;
  if (a->rigid && b->rigid) return are_jointed(&model->rigid, a->body_index, b->body_index);
  if (!a->rigid && !b->rigid)
    return world->body_contacts->shapes
               .rest_relations[a->character][(size_t)a->body_index * model->asset->soft_bodies.count +
                                             b->body_index] == SBRI_REST_ADJACENT;
  const sbri_contact_body *soft = a->rigid ? b : a, *rigid = a->rigid ? a : b;
  const sbri_island *island = &model->islands[model->bodies[soft->body_index].island];
  for (uint32_t i = 0; i < island->pins.attachment_count; i++)
    if (island->pins.attachments[i] == rigid->body_index) return true;
  return !rigid->is_dynamic && model->bodies[soft->body_index].is_pinned; /* its own bones are inside of it */
}

static bool may_collide(const sbr_world *world, const sbri_contact_body *a, const sbri_contact_body *b) {
  if ((!a->is_dynamic && !b->is_dynamic) || !sbri_layers_collide(a->layer, a->mask, b->layer, b->mask))
    return false;
  return a->character != b->character || !are_connected(world, a, b);
}

static void find_pairs(sbr_world *world) {
  sbri_body_contacts *all = world->body_contacts;
  sbri_bounds_tree_make(&all->broad_phase.tree, all->broad_phase.boxes, all->broad_phase.body_count);
  for (uint32_t a = 0; a < all->broad_phase.body_count; a++) {
    sbri_bounds_walk walk;
    uint32_t b;
    sbri_bounds_walk_begin(&walk, &all->broad_phase.tree, all->broad_phase.boxes[a]);
    while (sbri_bounds_walk_next(&walk, &b)) {
      if (b < a || !sbri_boxes_overlap(&all->broad_phase.boxes[a], &all->broad_phase.boxes[b]) ||
          !(a == b ? all->broad_phase.bodies[a].self_contact
                   : may_collide(world, &all->broad_phase.bodies[a], &all->broad_phase.bodies[b])))
        continue;
      if (all->pair_count < all->contact_capacity)
        all->found_pairs[all->pair_count++] = (sbri_contact_pair){a, b};
    }
  }
}

/* ---- Groups ---- */

static uint32_t root_of(uint32_t *group_of, uint32_t i) {
  while (group_of[i] != i) i = group_of[i] = group_of[group_of[i]];
  return i;
}

bool sbri_character_is_awake(const sbri_character *c) {
  if (sbri_header(c)->asleep) return false;
  bool simulated = c->model->rigid.body_count && sbri_rigid_drive(c)->any_dynamic;
  for (uint32_t i = 0; i < c->model->island_count; i++)
    if (!sbri_island_states(c)[i].asleep) return true;
  return simulated ? !sbri_rigid_drive(c)->asleep : c->model->island_count == 0;
}

/* Wakes a character for this tick. Its rest time continues, so that stacked bodies fall asleep together. */
static void wake_for_tick(sbri_character *c) {
  sbri_character_wake(c);
  for (uint32_t i = 0; i < c->model->island_count; i++) sbri_island_states(c)[i].asleep = 0;
  if (c->model->rigid.body_count) sbri_rigid_drive(c)->asleep = 0;
}

static uint32_t group_of_pair(const sbri_body_contacts *all, const sbri_contact_pair *pair) {
  return all->group_of[all->broad_phase.bodies[pair->a].character];
}

/* Counting sort of the pairs by group; stable within a group. */
static void sort_pairs(sbri_body_contacts *all) {
  uint32_t *ends = all->member_of, first = 0; /* scratch: no character has an index yet */
  for (uint32_t i = 0; i < all->character_capacity; i++) ends[i] = 0;
  for (uint32_t i = 0; i < all->pair_count; i++) ends[group_of_pair(all, &all->found_pairs[i])]++;
  for (uint32_t i = 0; i < all->character_capacity; i++) {
    uint32_t count = ends[i];
    ends[i] = first, first += count;
  }
  for (uint32_t i = 0; i < all->pair_count; i++)
    all->pairs[ends[group_of_pair(all, &all->found_pairs[i])]++] = all->found_pairs[i];
}

/* A group's number is the index of its first character; the others follow in order. */
static void link_groups(sbri_body_contacts *all) {
  for (uint32_t i = 0; i < all->character_capacity; i++) all->next_of_group[i] = UINT32_MAX;
  for (uint32_t i = all->character_capacity; i-- > 0;) {
    uint32_t first = all->group_of[i];
    if (first == i) continue;
    all->next_of_group[i] = all->next_of_group[first];
    all->next_of_group[first] = i;
  }
}

/* Flag in `group_of` while groups are built: the group is awake. */
#define STEPS_ALONG 0x80000000u

/* Adds the characters of a group. Returns whether one of them is awake. */
static bool add_members(sbr_world *world, sbri_contact_group *group, uint32_t number) {
  sbri_body_contacts *all = world->body_contacts;
  bool awake = false;
  for (uint32_t i = number; i != UINT32_MAX; i = all->next_of_group[i]) {
    awake = awake || sbri_character_is_awake(&world->characters[i]);
    all->member_of[i] = group->member_count;
    SBF_ASSERT(
        world->characters[i].model && group->first_member + group->member_count < all->character_capacity);
    all->members[group->first_member + group->member_count++].character = &world->characters[i];
  }
  group->origin = sbri_header(all->members[group->first_member].character)->origin;
  for (uint32_t i = 0; i < group->member_count && awake; i++) {
    sbri_character *c = all->members[group->first_member + i].character;
    all->group_of[c - world->characters] |= STEPS_ALONG;
    wake_for_tick(c);
  }
  return awake;
}

/* Divides the contact capacity by the groups' numbers of pairs. */
static void assign_contact_ranges(sbri_body_contacts *all) {
  uint32_t pairs = 0, first = 0;
  for (uint32_t g = 0; g < all->group_count; g++) pairs += all->groups[g].pair_count;
  for (uint32_t g = 0; g < all->group_count; g++) {
    sbri_contact_group *group = &all->groups[g];
    group->first_contact = first;
    group->contact_capacity = (uint32_t)((uint64_t)all->contact_capacity * group->pair_count / pairs);
    first += group->contact_capacity;
  }
}

static void make_groups(sbr_world *world) {
  sbri_body_contacts *all = world->body_contacts;
  uint32_t *group_of = all->group_of, filled = 0, solver_bodies = 0;
  for (uint32_t i = 0; i < all->pair_count;) {
    uint32_t number = group_of[all->broad_phase.bodies[all->pairs[i].a].character] & ~STEPS_ALONG, first = i;
    while (i < all->pair_count && group_of[all->broad_phase.bodies[all->pairs[i].a].character] == number) i++;
    sbri_contact_group *group = &all->groups[all->group_count];
    *group = (sbri_contact_group){.first_pair = first, .pair_count = i - first, .first_member = filled};
    if (!add_members(world, group, number)) continue; /* all are asleep */
    filled += group->member_count;
    group->first_solver_body = solver_bodies;
    for (uint32_t m = 0; m < group->member_count; m++)
      solver_bodies += SBRI_SOLVER_BODIES_PER_BODY *
                       all->members[group->first_member + m].character->model->rigid.body_count;
    all->group_count++;
  }
  for (uint32_t i = 0; i < world->character_capacity; i++)
    group_of[i] = group_of[i] & STEPS_ALONG ? group_of[i] & ~STEPS_ALONG : UINT32_MAX;
}

void sbri_broad_phase_update(sbr_world *world) {
  sbri_body_contacts *all = world->body_contacts;
  uint32_t *group_of = all->group_of;
  all->broad_phase.body_count = all->pair_count = all->group_count = 0;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    group_of[i] = i;
    if (world->characters[i].model)
      memset(sbri_contact_islands(&world->characters[i]), 0, world->characters[i].model->island_count);
    if (world->characters[i].model && !sbri_header(&world->characters[i])->paused) list_character(world, i);
  }
  find_pairs(world);
  for (uint32_t i = 0; i < all->pair_count; i++) {
    uint32_t a = root_of(group_of, all->broad_phase.bodies[all->found_pairs[i].a].character),
             b = root_of(group_of, all->broad_phase.bodies[all->found_pairs[i].b].character);
    group_of[a > b ? a : b] = a > b ? b : a;
  }
  for (uint32_t i = 0; i < world->character_capacity; i++) group_of[i] = root_of(group_of, i);
  sort_pairs(all);
  link_groups(all);
  make_groups(world);
  assign_contact_ranges(all);
}
