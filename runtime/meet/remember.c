/* What touches keep from one tick to the next.
 *
 * A heap that rests needs the same pushes in every tick: those of the tick before are where the search for
 * them begins. They are state, beside the characters' own: snapshots and the hash hold them. */
#include <string.h>

#include "math/vec3.h"
#include "meet/meetings.h"

/* A place of a hull that has gone no further over it than this share of its radius is the same place. */
static const float SAME_SHARE = 0.1f;

/* ---- Finding ---- */

static uint32_t bucket_of(const sbri_meetings *all, const uint64_t names[2]) {
  uint64_t mixed = (names[0] ^ names[1] * 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
  return (uint32_t)(mixed >> 32) & (all->found_capacity - 1);
}

static bool are_named(const sbri_meet_memory *m, const uint64_t names[2]) {
  return m->names[0] == names[0] && m->names[1] == names[1];
}

static const sbri_meet_memory *memory_at(const sbri_meetings *all, uint32_t number) {
  return number == UINT32_MAX ? NULL : &all->memories[number];
}

/* Where it is told which memory of the two is the first; or where that would be. */
static uint32_t *place_of(const sbri_meetings *all, const uint64_t names[2]) {
  for (uint32_t at = bucket_of(all, names);; at = (at + 1) & (all->found_capacity - 1)) {
    const sbri_meet_memory *first = memory_at(all, all->found_memories[at]);
    if (!first || are_named(first, names)) return &all->found_memories[at];
  }
}

/* Those of two bodies follow each other however they lie: what their faces keep and what their rims keep have
 * that of the one's faces on the other's between them. */
static void index_memories(sbri_meetings *all) {
  memset(all->found_memories, 0xff, all->found_capacity * sizeof *all->found_memories);
  for (uint32_t i = all->memory_count; i-- > 0;) { /* so that they do so in their order */
    uint32_t *first = place_of(all, all->memories[i].names);
    all->memories[i].next = *first;
    *first = i;
  }
}

const sbri_meet_memory *sbri_meet_first_memory(const sbri_meetings *all, const uint64_t names[2]) {
  return memory_at(all, *place_of(all, names));
}

const sbri_meet_memory *sbri_meet_next_memory(const sbri_meetings *all, const sbri_meet_memory *m) {
  return memory_at(all, m->next);
}

/* ---- Recalling ---- */

static float same_within(const sbri_meet_member *members, const sbri_meet_touch *t) {
  if (t->a.rigid_body < 0) return 0;
  const sbri_rigid_model *rigid = &members[t->a.member].character->model->rigid;
  return SAME_SHARE * rigid->bodies[t->a.rigid_body].radius;
}

static const sbri_meet_memory *memory_of(
    const sbri_meetings *all, const sbri_meet_member *members, const sbri_meet_touch *t) {
  float least = same_within(members, t);
  least *= least;
  const sbri_meet_memory *best = NULL;
  const sbri_meet_memory *m = sbri_meet_first_memory(all, t->names);
  for (; m; m = sbri_meet_next_memory(all, m)) {
    sbf_vec3 off = sbri_sub(m->at, t->a.at);
    float square = sbri_dot(off, off);
    if (m->feature != t->feature || square > least) continue;
    least = square;
    best = m;
  }
  return best;
}

void sbri_meet_recall(const sbri_meetings *all, const sbri_meet_group *group, float step_s) {
  for (uint32_t i = 0; i < group->touch_count; i++) {
    sbri_meet_touch *t = &all->touches[group->first_touch + i];
    const sbri_meet_memory *m = memory_of(all, all->members + group->first_member, t);
    if (m && t->goes_through != (sbri_dot(m->through, m->through) > 0)) m = NULL; /* another way */
    t->is_new = t->pushed = m == NULL;
    if (!m) {
      t->pushed = false;
      continue;
    }
    t->pushed = true;
    t->gain = m->force * step_s;
    t->pull = m->pull * step_s;
    t->rub = sbri_scale(sbri_add_scaled(m->rub, t->normal, -sbri_dot(m->rub, t->normal)), step_s);
    t->slid = sbri_add_scaled(m->slid, t->normal, -sbri_dot(m->slid, t->normal));
  }
}

/* ---- Remembering ---- */

void sbri_meet_go_on(const sbri_meetings *all, sbri_meet_group *group, float step_s) {
  float share = step_s / group->step_s;
  for (uint32_t i = 0; i < group->touch_count; i++) {
    sbri_meet_touch *t = &all->touches[group->first_touch + i];
    t->gain *= share, t->pull *= share, t->rub = sbri_scale(t->rub, share);
  }
  group->step_s = step_s;
}

static sbri_meet_memory memory_from(const sbri_meet_touch *t, float step_s) {
  return (sbri_meet_memory){.names = {t->names[0], t->names[1]},
      .feature = t->feature,
      .at = t->a.at,
      .force = t->gain / step_s,
      .rub = sbri_scale(t->rub, 1 / step_s),
      .slid = t->slid,
      .pull = t->pull / step_s,
      .through = t->goes_through ? t->normal : (sbf_vec3){0, 0, 0}};
}

/* What sleeps keeps its own. */
static bool sleeps_on(const sbr_world *world, const sbri_meet_memory *m) {
  uint32_t character = (uint32_t)(m->names[0] >> 32);
  return world->characters[character].model && world->meetings->group_of[character] == UINT32_MAX &&
         sbri_head(&world->characters[character])->asleep;
}

void sbri_meet_remember(sbr_world *world) {
  sbri_meetings *all = world->meetings;
  uint32_t count = 0;
  for (uint32_t i = 0; i < all->memory_count; i++)
    if (sleeps_on(world, &all->memories[i])) all->next_memories[count++] = all->memories[i];
  for (uint32_t g = 0; g < all->group_count; g++)
    for (uint32_t i = 0; i < all->groups[g].touch_count; i++) {
      const sbri_meet_touch *t = &all->touches[all->groups[g].first_touch + i];
      if ((t->pushed || t->goes_through) && count < all->touch_capacity)
        all->next_memories[count++] = memory_from(t, all->groups[g].step_s);
    }
  sbri_meet_memory *before = all->memories;
  all->memories = all->next_memories;
  all->next_memories = before;
  all->memory_count = count;
  index_memories(all);
}

/* ---- Snapshots ---- */

size_t sbri_meet_memory_size(const sbr_world *world) {
  const sbri_meetings *all = world->meetings;
  return all ? sizeof(uint64_t) + all->touch_capacity * sizeof *all->memories : 0;
}

void sbri_meet_memory_save(const sbr_world *world, unsigned char *to) {
  const sbri_meetings *all = world->meetings;
  if (!all) return;
  uint64_t count = all->memory_count;
  memcpy(to, &count, sizeof count);
  memcpy(to + sizeof count, all->memories, count * sizeof *all->memories);
  memset(to + sizeof count + count * sizeof *all->memories, 0,
      (all->touch_capacity - count) * sizeof *all->memories);
}

void sbri_meet_memory_restore(sbr_world *world, const unsigned char *from) {
  sbri_meetings *all = world->meetings;
  if (!all) return;
  uint64_t count;
  memcpy(&count, from, sizeof count);
  all->memory_count = (uint32_t)count;
  memcpy(all->memories, from + sizeof count, count * sizeof *all->memories);
  index_memories(all);
}
