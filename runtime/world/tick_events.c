/* Events of a tick: feet, contacts, tears, sleep, detail levels; and impulses on colliders. */
#include "math/vec3.h"
#include "world/step.h"

/* World position of a point in metres from the character's origin. */
static sbr_double3 in_world(const sbri_character *c, sbf_vec3 position) {
  sbr_double3 origin = sbri_header(c)->origin;
  return (sbr_double3){
      origin.x + (double)position.x, origin.y + (double)position.y, origin.z + (double)position.z};
}

static void add_soft_body_event(
    sbr_world *world, const sbri_character *c, sbri_event_kind kind, uint32_t soft_body, sbf_vec3 position) {
  sbr_soft_body_event event = {.tick = world->time.ticks,
      .character = sbri_id_of(world, c),
      .soft_body = soft_body,
      .position = in_world(c, sbri_scale(position, c->scale))};
  sbri_event_add(world, kind, &event);
}

/* The body that has the element; for a spring between bodies, the first. */
static uint32_t body_of_tear(const sbr_model *model, const sbri_island *island, const sbri_tear *tear) {
  uint32_t spring = 0, link = tear->link;
  for (uint32_t b = 0; tear->solid && b < island->body_count; b++) {
    const sbri_body *body = &model->bodies[island->bodies[b]];
    if (link - body->elements.first_tetrahedron < body->elements.tetrahedron_count) return island->bodies[b];
  }
  while (spring < island->springs.count && island->links.of_spring[spring] != link) spring++;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &model->bodies[island->bodies[b]];
    if (spring >= body->elements.first_spring && spring < body->elements.spring_end) return island->bodies[b];
  }
  return island->bodies[0];
}

/* Whether no earlier contact in the list is with the same rigid body. */
static bool is_first_of(const sbri_collider_set *set, const sbri_contact_reports *touching, uint32_t i) {
  uint32_t leader = set->at[touching->now[i].collider].leader;
  for (uint32_t k = 0; k < i; k++)
    if (touching->now[k].collider < set->end && set->at[touching->now[k].collider].leader == leader)
      return false;
  return true;
}

/* Adds the impulse of one contact to the totals of a collider with a mass. */
static void add_collider_impulse(sbri_collider *leader, const double impulse[3], const double moment[3],
    sbr_double3 about, bool is_first) {
  sbri_host_body *body = &leader->body;
  sbr_double3 centre = sbri_collider_centre(leader);
  const double arm[3] = {about.x - centre.x, about.y - centre.y, about.z - centre.z};
  body->next_contributor_count += is_first ? 1 : 0;
  for (int k = 0; k < 3; k++) {
    int a = (k + 1) % 3, b = (k + 2) % 3;
    body->next_impulse[k] += impulse[k];
    body->next_moment[k] += arm[a] * impulse[b] - arm[b] * impulse[a] + moment[k];
  }
}

/* Applies the reaction of contact impulses to colliders. A sleeping body applies those of its last tick. */
static void apply_reactions(
    sbr_world *world, const sbri_character *c, sbri_contact_reports *touching, bool asleep) {
  bool acts = touching->is_current || asleep;
  touching->is_current = false;
  double mass = (double)(c->scale * c->scale * c->scale) / (double)c->time_scale, scale = (double)c->scale;
  for (uint32_t i = 0; acts && i < touching->count; i++) {
    const sbri_contact_report *one = &touching->now[i];
    if (one->collider >= world->colliders.end || !world->colliders.at[one->collider].shape) continue;
    sbri_collider *collider = &world->colliders.at[one->collider];
    sbr_double3 origin = sbri_header(c)->origin;
    const sbr_double3 *position = collider->body.is_moving ? &collider->from : &collider->to;
    const double arm[3] = {origin.x + scale * (double)one->position.x - position->x,
        origin.y + scale * (double)one->position.y - position->y,
        origin.z + scale * (double)one->position.z - position->z};
    const double impulse[3] = {-mass * (double)one->total_impulse.x, -mass * (double)one->total_impulse.y,
        -mass * (double)one->total_impulse.z};
    const double moment[3] = {-mass * scale * (double)one->total_moment.x,
        -mass * scale * (double)one->total_moment.y, -mass * scale * (double)one->total_moment.z};
    for (int k = 0; k < 3; k++) {
      int a = (k + 1) % 3, b = (k + 2) % 3;
      collider->impulse[k] += impulse[k];
      collider->moment[k] += arm[a] * impulse[b] - arm[b] * impulse[a] + moment[k];
    }
    sbri_collider *leader = sbri_collider_leader(&world->colliders, one->collider);
    if (!leader) continue;
    sbr_double3 about = {position->x + arm[0], position->y + arm[1], position->z + arm[2]};
    add_collider_impulse(leader, impulse, moment, about, is_first_of(&world->colliders, touching, i));
  }
}

/* `is_over`: the contact ended in this tick; the impulse and speed of the previous tick are not reported
 * again. */
static void add_contact(sbr_world *world, const sbri_character *c, const sbr_object *body,
    const sbri_contact_report *one, sbri_event_kind kind) {
  bool is_over = kind == SBRI_EVENT_CONTACT_END;
  sbr_contact_event event = {.tick = world->time.ticks,
      .a = *body,
      .b = {.soft_body = -1, .rigid_body = -1},
      .position = in_world(c, sbri_scale(one->position, c->scale)),
      .normal = one->normal,
      .impulse = is_over ? 0 : one->impulse * c->scale * c->scale * c->scale / c->time_scale,
      .speed = is_over ? 0 : one->speed / c->time_scale};
  if (one->collider < world->colliders.capacity) {
    if (is_over && !world->colliders.at[one->collider].shape) return; /* destroyed */
    event.b.collider = sbri_collider_name(&world->colliders, one->collider);
  }
  sbri_event_add(world, kind, &event);
}

/* Contacts of a body with the ground and colliders that begin, hit or end in this tick. */
static void add_contacts(
    sbr_world *world, const sbri_character *c, sbri_contact_reports *touching, sbr_object body) {
  if (!touching->has_unreported) return;
  touching->has_unreported = false;
  body.character = sbri_id_of(world, c);
  for (uint32_t i = 0; i < touching->before_count; i++)
    if (!sbri_contact_reports_has(touching->now, touching->count, touching->before[i].collider))
      add_contact(world, c, &body, &touching->before[i], SBRI_EVENT_CONTACT_END);
  for (uint32_t i = 0; i < touching->count; i++) {
    const sbri_contact_report *one = &touching->now[i];
    if (one->is_new) add_contact(world, c, &body, one, SBRI_EVENT_CONTACT_BEGIN);
    if (one->speed / c->time_scale >= world->hit_speed)
      add_contact(world, c, &body, one, SBRI_EVENT_CONTACT_HIT);
  }
}

static void apply_character_reactions(sbr_world *world, const sbri_character *c) {
  if (sbri_header(c)->paused) return;
  for (uint32_t k = 0; k < c->model->island_count; k++) {
    const sbri_island *island = &c->model->islands[k];
    bool asleep = sbri_header(c)->asleep || sbri_island_states(c)[k].asleep;
    for (uint32_t b = 0; b < island->body_count; b++)
      apply_reactions(world, c, &sbri_soft_touching(c)[island->bodies[b]], asleep);
  }
  uint32_t rigid = c->model->rigid.body_count;
  bool asleep = sbri_header(c)->asleep || (rigid && sbri_rigid_drive(c)->asleep);
  for (uint32_t b = 0; b < rigid; b++) apply_reactions(world, c, &sbri_rigid_touching(c)[b], asleep);
}

static void add_feet(sbr_world *world, const sbri_character *c) {
  static const sbri_event_kind kinds[] = {[SBRI_GAIT_FOOT_DOWN] = SBRI_EVENT_FOOT_DOWN,
      [SBRI_GAIT_FOOT_UP] = SBRI_EVENT_FOOT_UP,
      [SBRI_GAIT_LANDED] = SBRI_EVENT_LANDED};
  for (uint32_t e = 0; e < c->event_count; e++) {
    const sbri_gait_event *from = &c->events[e];
    sbr_foot_event event = {.tick = world->time.ticks,
        .character = sbri_id_of(world, c),
        .leg = from->leg,
        .position = in_world(c, from->position)};
    sbri_event_add(world, kinds[from->kind], &event);
  }
}

static void add_tears(sbr_world *world, const sbri_character *c, uint32_t index) {
  const sbri_tears *tears = &sbri_tears_of(c)[index];
  const sbri_island *island = &c->model->islands[index];
  for (uint32_t e = 0; e < tears->count && e < SBRI_TEARS; e++)
    add_soft_body_event(
        world, c, SBRI_EVENT_TORN, body_of_tear(c->model, island, &tears->at[e]), tears->at[e].position);
  if (tears->unsplit)
    add_soft_body_event(world, c, SBRI_EVENT_UNSPLIT, island->bodies[0], tears->at[0].position);
}

static void add_detail_change(sbr_world *world, sbri_character *c) {
  if (!c->left_detail_level_plus_1) return;
  sbr_detail_event event = {.tick = world->time.ticks,
      .character = sbri_id_of(world, c),
      .from = c->left_detail_level_plus_1 - 1,
      .to = sbri_header(c)->detail_level};
  c->left_detail_level_plus_1 = 0;
  sbri_event_add(world, SBRI_EVENT_DETAIL_CHANGED, &event);
}

void sbri_tick_events_gather(sbr_world *world) {
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    sbri_character *c = &world->characters[i];
    if (!c->model) continue;
    if (world->colliders.end) apply_character_reactions(world, c);
    add_detail_change(world, c);
    add_feet(world, c);
    uint32_t soft_count = c->model->island_count ? c->model->asset->soft_bodies.count : 0;
    for (uint32_t b = 0; b < soft_count; b++)
      add_contacts(
          world, c, &sbri_soft_touching(c)[b], (sbr_object){.soft_body = (int32_t)b, .rigid_body = -1});
    for (uint32_t b = 0; b < c->model->rigid.body_count; b++)
      add_contacts(
          world, c, &sbri_rigid_touching(c)[b], (sbr_object){.soft_body = -1, .rigid_body = (int32_t)b});
    for (uint32_t k = 0; !sbri_header(c)->asleep && k < c->model->island_count; k++) add_tears(world, c, k);
  }
}

void sbri_tick_report_sleep(sbr_world *world) {
  world->awake_count = 0;
  for (size_t i = 0; i < world->work.count; i++) {
    const sbri_character *c = &world->characters[world->work.at[i].character];
    const sbri_island *island = &c->model->islands[world->work.at[i].island];
    sbri_island_state *state = &sbri_island_states(c)[world->work.at[i].island];
    if (!state->asleep) world->awake_count += island->body_count;
    if (state->asleep == state->reported_asleep) continue;
    state->reported_asleep = state->asleep;
    const sbri_point *p = sbri_positions(c) + island->first_slot;
    add_soft_body_event(world, c, state->asleep ? SBRI_EVENT_ASLEEP : SBRI_EVENT_AWAKE, island->bodies[0],
        sbri_vec3(p->x, p->y, p->z));
  }
}
