/* One control tick of everything: characters' poses first, each a task; then their islands, each a task. A
 * task touches nothing that another one does, so neither the number of threads nor their order shows. */
#include <string.h>

#include "core/world.h"
#include "detail/choose.h"
#include "math/vec3.h"
#include "meet/meetings.h"
#include "solvers/scheme.h"

/* The origin follows when the character is this far from it, in m. */
static const float REBASE_AT_M = 4;

sbri_gait_input sbri_gait_input_of(const sbr_world *world, const sbri_character *c) {
  const sbri_character_state *head = sbri_head(c);
  bool up = !c->model->rigid.body_count || sbri_rigid_drive(c)->posture == SBR_RIGID_UP;
  return (sbri_gait_input){.forward = up ? head->forward : 0,
      .sideways = up ? head->sideways : 0,
      .turn = up ? head->turn : 0,
      .tick_s = (float)world->tick_s,
      .scale = c->scale,
      .hold = c->hold,
      .origin = head->origin,
      .ground = &world->ground};
}

/* ---- The character ---- */

static float whole(float metres) {
  return (float)(int32_t)(metres < 0 ? metres - 0.5f : metres + 0.5f);
}

static void shift_frames(sbr_transform *pose, uint32_t count, sbf_vec3 shift) {
  for (uint32_t f = 0; f < count; f++) pose[f].position = sbri_sub(pose[f].position, shift);
}

static void shift_points(sbri_point *points, uint32_t count, sbf_vec3 shift) {
  for (uint32_t i = 0; i < count; i++)
    points[i] = (sbri_point){points[i].x - shift.x, points[i].y - shift.y, points[i].z - shift.z, 0};
}

/* Moves the origin by whole metres to where the character is, and everything the other way. */
static void rebase(sbri_character *c) {
  const sbr_model *model = c->model;
  sbf_vec3 at = sbri_pose(c)[sbri_root_frame(model)].position;
  if (fabsf(at.x) < REBASE_AT_M && fabsf(at.y) < REBASE_AT_M && fabsf(at.z) < REBASE_AT_M) return;
  if (!(fabsf(at.x) < 1e9f && fabsf(at.y) < 1e9f && fabsf(at.z) < 1e9f)) return;
  sbf_vec3 shift = {whole(at.x), whole(at.y), whole(at.z)}, own = sbri_scale(shift, 1 / c->scale);
  sbri_character_state *head = sbri_head(c);
  head->origin.x += (double)shift.x, head->origin.y += (double)shift.y, head->origin.z += (double)shift.z;
  sbri_gait_rebase(&model->rig, sbri_gait(c), shift);
  shift_frames(sbri_pose(c), model->frame_count, shift);
  shift_frames(sbri_previous_pose(c), model->frame_count, shift);
  sbri_rigid_rebase(c, own);
  sbri_jiggles_rebase(c, own);
  shift_points(sbri_positions(c), model->slot_count, own);
  shift_points(sbri_previous_positions(c), model->slot_count, own);
  for (uint32_t i = 0; i < model->island_count; i++) {
    const sbri_island *island = &model->islands[i];
    float *before = sbri_velocities(c) + 3 * (size_t)island->first_slot;
    if (!island->scheme->forceless) continue;
    for (uint32_t k = 0; k < 3 * island->free_count; k++) {
      uint32_t axis = k / SBRI_BLOCK % 3;
      before[k] -= axis == 0 ? own.x : axis == 1 ? own.y : own.z;
    }
  }
}

/* It steps along with others whom it meets: core/group_run.c. */
static bool is_grouped(const sbr_world *world, const sbri_character *c) {
  return world->meetings && world->meetings->group_of[c - world->characters] != UINT32_MAX;
}

static void tick_character(void *context, uint32_t index) {
  sbr_world *world = context;
  sbri_character *c = &world->characters[index];
  c->event_count = 0;
  if (!c->model || sbri_character_sleeps(world, c)) return;
  if (!sbri_head(c)->paused && !world->meetings) sbri_rung_change(world, c);
  for (uint32_t i = 0; i < c->model->island_count; i++)
    sbri_tears_of(c)[i].count = sbri_tears_of(c)[i].unsplit = 0;
  rebase(c);
  sbri_settle(c);
  if (sbri_head(c)->paused) return;
  sbri_fade_tick(c);
  if (sbri_is_away(c)) {
    sbri_away_tick(world, c);
    return;
  }
  sbri_reflex_tick(world, c);
  sbri_gait_input input = sbri_gait_input_of(world, c);
  sbr_transform *pose = sbri_pose(c);
  bool has_bodies = c->model->island_count > 0; /* which alone ask where frames carry them */
  if (has_bodies) sbri_deltas_make(c, pose, 1, sbri_previous_deltas(c));
  bool may_sleep = sbri_character_may_sleep(world, c);
  if (may_sleep) sbri_character_keep_gait(c);
  c->event_count = sbri_gait_tick(&c->model->rig, sbri_gait(c), &input, pose, c->events, SBRI_TICK_EVENTS);
  pose[sbri_root_frame(c->model)] = sbri_root_place(c, &world->ground);
  if (is_grouped(world, c)) return;
  sbri_rigid_tick_parts(world, c);
  sbri_jiggles_tick(c, (float)world->tick_s * c->time_scale);
  if (has_bodies) sbri_deltas_make(c, pose, 1, sbri_deltas(c));
  sbri_head(c)->asleep = may_sleep && !world->colliders.moving && sbri_character_is_still(c);
}

static void tick_island(void *context, uint32_t index) {
  sbr_world *world = context;
  sbri_work work = world->work[index];
  sbri_character *c = &world->characters[work.character];
  if (!is_grouped(world, c) && !sbri_island_is_coupled(c, work.island))
    sbri_island_run(world, c, work.island);
}

static void tick_group(void *context, uint32_t index) {
  sbr_world *world = context;
  sbri_group_run(world, &world->meetings->groups[index]);
}

/* ---- The world ---- */

static void run(sbr_world *world, sbr_task *task, size_t count) {
  if (world->tasks.run)
    world->tasks.run(world->tasks.user, task, world, (uint32_t)count);
  else
    for (uint32_t i = 0; i < count; i++) task(world, i);
}

void sbri_event_add(sbr_world *world, sbr_event event) {
  event.tick = world->ticks;
  if (!event.other.value) event.other_rigid_body = -1;
  world->events[world->event_head++ % SBRI_EVENTS] = event;
}

static void add_event(sbr_world *world, const sbri_character *c, sbr_event event, sbf_vec3 place) {
  sbr_double3 origin = sbri_head(c)->origin;
  event.character = sbri_id_of(world, c);
  event.position =
      (sbr_double3){origin.x + (double)place.x, origin.y + (double)place.y, origin.z + (double)place.z};
  sbri_event_add(world, event);
}

/* The body that lists the element: of a spring between bodies, the first. */
static uint32_t body_of_tear(const sbr_model *model, const sbri_island *island, const sbri_tear *tear) {
  uint32_t spring = 0, link = tear->link;
  for (uint32_t b = 0; tear->solid && b < island->body_count; b++) {
    const sbri_body *body = &model->bodies[island->bodies[b]];
    if (link - body->first_tetrahedron < body->tetrahedron_count) return island->bodies[b];
  }
  while (spring < island->spring_count && island->link_of_spring[spring] != link) spring++;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &model->bodies[island->bodies[b]];
    if (spring >= body->first_spring && spring < body->spring_end) return island->bodies[b];
  }
  return island->bodies[0];
}

static void follow_tears(sbr_world *world) {
  for (uint32_t i = 0; i < world->work_count; i++) {
    sbri_character *c = &world->characters[world->work[i].character];
    uint32_t island = world->work[i].island;
    if (c->model->islands[island].splits && sbri_tears_of(c)[island].count > 0) sbri_skins_follow(c, island);
  }
}

/* What has begun to be touched; `soft` and `rigid` name the body. */
static void add_contacts(
    sbr_world *world, const sbri_character *c, sbri_touching *touching, uint32_t soft, int32_t rigid) {
  for (uint32_t i = 0; i < touching->count; i++) {
    sbri_touching_one *one = &touching->now[i];
    if (!one->fresh) continue;
    one->fresh = false;
    sbr_event event = {.kind = SBR_EVENT_CONTACT, .soft_body = soft, .rigid_body = rigid};
    if (one->thing < world->colliders.capacity)
      event.collider = sbri_collider_name(&world->colliders, one->thing);
    event.normal = one->normal;
    event.impulse = one->impulse * c->scale * c->scale * c->scale / c->time_scale;
    add_event(world, c, event, sbri_scale(one->place, c->scale));
  }
}

static void gather_events(sbr_world *world) {
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    const sbri_character *c = &world->characters[i];
    if (!c->model) continue;
    for (uint32_t e = 0; e < c->event_count; e++) {
      const sbri_gait_event *from = &c->events[e];
      add_event(
          world, c, (sbr_event){.kind = from->kind, .leg = from->leg, .rigid_body = -1}, from->position);
    }
    uint32_t soft_count = c->model->island_count ? c->model->asset->soft_bodies.count : 0;
    for (uint32_t b = 0; b < soft_count; b++) add_contacts(world, c, &sbri_soft_touching(c)[b], b, -1);
    for (uint32_t b = 0; b < c->model->rigid.body_count; b++)
      add_contacts(world, c, &sbri_rigid_touching(c)[b], 0, (int32_t)b);
    for (uint32_t k = 0; !sbri_head(c)->asleep && k < c->model->island_count; k++) {
      const sbri_tears *tears = &sbri_tears_of(c)[k];
      for (uint32_t e = 0; e < tears->count && e < SBRI_TEARS; e++) {
        uint32_t body = body_of_tear(c->model, &c->model->islands[k], &tears->at[e]);
        add_event(world, c, (sbr_event){.kind = SBR_EVENT_TEAR, .soft_body = body, .rigid_body = -1},
            sbri_scale(tears->at[e].place, c->scale));
      }
      if (tears->unsplit)
        add_event(world, c,
            (sbr_event){
                .kind = SBR_EVENT_UNSPLIT, .soft_body = c->model->islands[k].bodies[0], .rigid_body = -1},
            sbri_scale(tears->at[0].place, c->scale));
    }
  }
}

/* Counts who was stepped, and tells who has fallen asleep or woken. */
static void note_sleep(sbr_world *world) {
  world->awake_count = 0;
  for (size_t i = 0; i < world->work_count; i++) {
    const sbri_character *c = &world->characters[world->work[i].character];
    const sbri_island *island = &c->model->islands[world->work[i].island];
    sbri_island_state *state = &sbri_island_states(c)[world->work[i].island];
    if (!state->asleep) world->awake_count += island->body_count;
    if (state->asleep == state->told_asleep) continue;
    state->told_asleep = state->asleep;
    const sbri_point *p = sbri_positions(c) + island->first_slot;
    add_event(world, c,
        (sbr_event){.kind = state->asleep ? SBR_EVENT_ASLEEP : SBR_EVENT_AWAKE,
            .soft_body = island->bodies[0],
            .rigid_body = -1},
        sbri_scale(sbri_vec3(p->x, p->y, p->z), c->scale));
  }
}

void sbri_step_tick(sbr_world *world) {
  world->ticks++;
  sbri_colliders_begin_tick(&world->colliders);
  if (world->meetings) sbri_meet_pairs_find(world);
  if (world->detail && !world->meetings) sbri_detail_choose(world);
  run(world, tick_character, world->character_capacity);
  if (world->meetings) {
    run(world, tick_group, world->meetings->group_count);
    sbri_meet_remember(world);
  }
  sbri_work_list(world);
  run(world, tick_island, world->work_count);
  follow_tears(world);
  gather_events(world);
  if (world->meetings) sbri_meet_tell(world);
  note_sleep(world);
}
