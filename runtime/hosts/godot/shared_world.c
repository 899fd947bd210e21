/* Worlds of the runtime: one for each node, or one for all nodes of a physics space with contacts between
 * them. Characters of one world share gravity and control tick. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "clip_player.h"
#include "contact_list.h"
#include "physics_kinds.h"
#include "physics_parts.h"
#include "pose_driver.h"
#include "sbrun/detail.h"
#include "soft_character.h"

enum {
  MAX = 64, /* characters with contacts between them */
  COLLIDERS = 256
};

struct shared_world {
  shared_world *next;
  uint64_t space; /* RID; 0: belongs to one node */
  bool has_gravity, threads, selects, has_budget;
  sbf_vec3 gravity;
  double tick_s;
  sbr_world *world;
  physics_bodies *bodies;
  contact_list contacts;
  soft_character *members[MAX];
  uint32_t count, holders; /* nodes; nodes and users */
  int64_t frame;           /* last stepped */
};

/* All worlds. Main thread only. */
static shared_world *worlds;

static uint64_t space_of(const soft_character *one) {
  gd_variant world = GD_CALL(&one->node, "get_world_3d");
  gd_variant space = gd_as_object(&world) ? GD_CALL(&world, "get_space") : gd_nil();
  uint64_t found = gd_type(&space) == GDEXTENSION_VARIANT_TYPE_RID ? gd_as_rid(&space) : 0;
  gd_free(&space);
  gd_free(&world);
  return found;
}

static void release(shared_world *shared) {
  if (!shared || --shared->holders) return;
  for (shared_world **link = &worlds; *link; link = &(*link)->next)
    if (*link == shared) {
      *link = shared->next;
      break;
    }
  physics_bodies_free(shared->bodies, shared->world);
  sbr_world_destroy(shared->world);
  free(shared);
}

static shared_world *make(const sbr_world_definition *given, uint64_t space) {
  sbr_world_definition definition = *given;
  sbf_diagnostic error = {0};
  shared_world *made = calloc(1, sizeof *made);
  if (!made) {
    gd_error("no memory for a world");
    return NULL;
  }
  definition.character_capacity = space ? MAX : 1;
  definition.collider_capacity = COLLIDERS;
  *made = (shared_world){.space = space,
      .has_gravity = given->has_gravity,
      .threads = given->tasks.run != NULL,
      .gravity = given->gravity,
      .tick_s = given->control_tick_s,
      .holders = 1,
      .frame = -1};
  made->bodies = physics_bodies_make();
  bool good = sbr_world_create(&definition, &made->world, &error) == SBF_OK &&
              (!space || sbr_world_enable_body_contacts(made->world, 0, &error) == SBF_OK);
  if (!good || !made->bodies) {
    gd_error(good ? "no memory for a world's bodies" : error.message);
    release(made);
    return NULL;
  }
  made->next = worlds;
  worlds = made;
  return made;
}

static shared_world *find(const sbr_world_definition *definition, uint64_t space) {
  for (shared_world *one = space ? worlds : NULL; one; one = one->next)
    if (one->space == space && one->count < MAX && one->has_gravity == definition->has_gravity &&
        one->threads == (definition->tasks.run != NULL) && one->tick_s == definition->control_tick_s &&
        (!one->has_gravity || !memcmp(&one->gravity, &definition->gravity, sizeof one->gravity)))
      return one->holders++, one;
  return make(definition, space);
}

bool shared_world_join(soft_character *one, const sbr_world_definition *definition) {
  shared_world *shared =
      find(definition, one->settings.collision.collide_with_others && !one->is_in_editor ? space_of(one) : 0);
  if (!shared) return false;
  if (one->model->options.detail_levels && !shared->selects)
    shared->selects = level_of_detail_select(shared->world, 0);
  shared->members[shared->count++] = one;
  one->shared = shared;
  one->world = shared->world;
  one->physics.bodies = shared->bodies;
  return true;
}

void shared_world_leave(soft_character *one) {
  shared_world *shared = one->shared;
  if (!shared) return;
  sbr_character_destroy(shared->world, one->id);
  uint32_t at = 0;
  while (shared->members[at] != one) at++;
  shared->count--;
  memmove(&shared->members[at], &shared->members[at + 1], (shared->count - at) * sizeof shared->members[0]);
  one->shared = NULL;
  one->world = NULL;
  one->physics.bodies = NULL;
  one->id = (sbr_character_id){0};
  release(shared);
}

uint32_t shared_world_count(const shared_world *shared) {
  return shared->count;
}

soft_character *shared_world_at(const shared_world *shared, uint32_t index) {
  return shared->members[index];
}

sbr_world *shared_world_get(const shared_world *shared) {
  return shared->world;
}

const physics_bodies *shared_world_bodies(const shared_world *shared) {
  return shared->bodies;
}

bool shared_world_has(const shared_world *shared, const gd_variant *object) {
  for (uint32_t i = 0; i < shared->count; i++)
    if (body_is_passed(&shared->members[i]->node, object)) return true;
  return false;
}

const contact_list *shared_world_contacts(const shared_world *shared) {
  return &shared->contacts;
}

soft_character *shared_world_member(const shared_world *shared, sbr_character_id id) {
  for (uint32_t i = 0; id.value && i < shared->count; i++)
    if (shared->members[i]->id.value == id.value) return shared->members[i];
  return NULL;
}

void shared_world_except(const shared_world *shared, const gd_variant *body) {
  for (uint32_t i = 0; i < shared->count; i++)
    physics_parts_except(shared->members[i]->physics.parts, body, true);
}

/* ---- A frame ---- */

/* The world's part of the project's budget: its need and a part of the rest; or in proportion, if all need
 * too much. */
static double budget_of(const shared_world *shared, double budget_us) {
  double needed = 0, count = 0, us_per_visit = 1e-3 * (double)sbr_default_detail_definition().ns_per_visit;
  for (const shared_world *one = worlds; one; one = one->next)
    needed += us_per_visit * sbr_world_get_element_visits(one->world), count++;
  double mine = us_per_visit * sbr_world_get_element_visits(shared->world);
  return needed > budget_us ? mine * budget_us / needed : mine + (budget_us - needed) / count;
}

static void update_detail(shared_world *shared) {
  if (!shared->selects) return;
  double budget_us = level_of_detail_budget_us();
  if (budget_us > 0 || shared->has_budget)
    level_of_detail_select(shared->world, budget_us > 0 ? fmax(budget_of(shared, budget_us), 1) : 0);
  shared->has_budget = budget_us > 0;
  level_of_detail_update(shared->members, shared->count);
}

/* Recreates characters whose nodes were scaled; they are then the last of the world, or in another one. */
static void rescale(shared_world *shared) {
  shared->holders++;
  for (uint32_t i = 0; i < shared->count;)
    if (!soft_character_rescale(shared->members[i])) i++;
  release(shared);
}

void shared_world_step(soft_character *one) {
  rescale(one->shared);
  shared_world *shared = one->shared;
  if (!shared) return;
  if (shared->count > 1) {
    gd_variant engine = gd_singleton("Engine");
    int64_t frame = gd_take_int(GD_CALL(&engine, "get_physics_frames"));
    gd_free(&engine);
    if (shared->frame == frame) return;
    shared->frame = frame;
  }
  float frame_s = (float)gd_take_float(GD_CALL(&one->node, "get_physics_process_delta_time"));
  bool moves[MAX], any = false;
  for (uint32_t i = 0; i < shared->count; i++)
    any = (moves[i] = soft_character_prepare(shared->members[i])) || any;
  if (!any) return;
  update_detail(shared);
  for (uint32_t i = 0; i < shared->count; i++) {
    clip_player_prepare(shared->members[i], frame_s);
    pose_driver_prepare(shared->members[i], frame_s);
  }
  physics_bodies_move(shared->bodies, shared->world, frame_s, one->settings.collision.push_bodies);
  sbr_world_step(shared->world, (double)frame_s);
  physics_bodies_push(shared->bodies, shared->world, &one->settings);
  for (uint32_t i = 0; i < shared->count; i++) clip_player_advance(shared->members[i]);
  for (uint32_t i = 0; i < shared->count; i++)
    if (moves[i]) {
      soft_character_show(shared->members[i]);
      soft_character_measure_velocity(shared->members[i], frame_s);
    }
  contact_list_update(&shared->contacts, shared->world);
  shared->holders++;
  world_events_report(shared);
  release(shared);
}
