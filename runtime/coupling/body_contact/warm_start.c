/* Contact impulses kept from tick to tick.
 *
 * A resting stack needs the same impulses in every tick, so those of the previous tick start the solver. They
 * are state: snapshots and the state hash hold them. */
#include <string.h>

#include "coupling/body_contact/body_contacts.h"
#include "math/vec3.h"

/* Contact points of a hull nearer than this fraction of its radius are the same point. */
static const float SAME_POINT_FRACTION = 0.1f;

/* ---- Finding ---- */

static uint32_t bucket_of(const sbri_body_contacts *all, const uint64_t body_ids[2]) {
  uint64_t hash = (body_ids[0] ^ body_ids[1] * 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
  return (uint32_t)(hash >> 32) & (all->cache.table_capacity - 1);
}

static bool has_body_ids(const sbri_cached_contact *m, const uint64_t body_ids[2]) {
  return m->body_ids[0] == body_ids[0] && m->body_ids[1] == body_ids[1];
}

static const sbri_cached_contact *cached_at(const sbri_body_contacts *all, uint32_t number) {
  return number == UINT32_MAX ? NULL : &all->cache.at[number];
}

/* Table entry of the first cached contact of two bodies, or the free entry for it. */
static uint32_t *table_entry(const sbri_body_contacts *all, const uint64_t body_ids[2]) {
  for (uint32_t at = bucket_of(all, body_ids);; at = (at + 1) & (all->cache.table_capacity - 1)) {
    const sbri_cached_contact *first = cached_at(all, all->cache.table[at]);
    if (!first || has_body_ids(first, body_ids)) return &all->cache.table[at];
  }
}

/* Links the cached contacts of each two bodies, which need not be adjacent: face contacts in one order of the
 * bodies can lie between others. */
static void build_cache_table(sbri_body_contacts *all) {
  memset(all->cache.table, 0xff, all->cache.table_capacity * sizeof *all->cache.table);
  for (uint32_t i = all->cache.count; i-- > 0;) { /* keeps their order */
    uint32_t *first = table_entry(all, all->cache.at[i].body_ids);
    all->cache.at[i].next = *first;
    *first = i;
  }
}

const sbri_cached_contact *sbri_first_cached_contact(
    const sbri_body_contacts *all, const uint64_t body_ids[2]) {
  return cached_at(all, *table_entry(all, body_ids));
}

const sbri_cached_contact *sbri_next_cached_contact(
    const sbri_body_contacts *all, const sbri_cached_contact *m) {
  return cached_at(all, m->next);
}

/* ---- Recalling ---- */

static float same_point_distance(const sbri_group_member *members, const sbri_contact *t) {
  if (t->a.rigid_body < 0) return 0;
  const sbri_rigid_model *rigid = &members[t->a.member].character->model->rigid;
  return SAME_POINT_FRACTION * rigid->bodies[t->a.rigid_body].radius;
}

static const sbri_cached_contact *find_cached(
    const sbri_body_contacts *all, const sbri_group_member *members, const sbri_contact *t) {
  float min_square = same_point_distance(members, t);
  min_square *= min_square;
  const sbri_cached_contact *best = NULL;
  const sbri_cached_contact *m = sbri_first_cached_contact(all, t->body_ids);
  for (; m; m = sbri_next_cached_contact(all, m)) {
    sbf_vec3 offset = sbri_sub(m->local_point, t->a.point);
    float square = sbri_dot(offset, offset);
    if (m->feature != t->feature || square > min_square) continue;
    min_square = square;
    best = m;
  }
  return best;
}

void sbri_contacts_load_cached(const sbri_body_contacts *all, const sbri_contact_group *group, float step_s) {
  for (uint32_t i = 0; i < group->contact_count; i++) {
    sbri_contact *t = &all->contacts[group->first_contact + i];
    const sbri_cached_contact *m = find_cached(all, all->members + group->first_member, t);
    if (m && t->exits_common != (sbri_dot(m->common_exit, m->common_exit) > 0)) m = NULL; /* different exit */
    t->is_new = t->is_loaded = m == NULL;
    if (!m) {
      t->is_loaded = false;
      continue;
    }
    t->is_loaded = true;
    t->normal_impulse = m->normal_force * step_s;
    t->external_bias = m->external_acceleration * step_s;
    t->friction_impulse = sbri_scale(
        sbri_add_scaled(m->friction_force, t->normal, -sbri_dot(m->friction_force, t->normal)), step_s);
    t->sticking.slip = sbri_add_scaled(m->tangent_slip, t->normal, -sbri_dot(m->tangent_slip, t->normal));
  }
}

/* ---- Remembering ---- */

void sbri_contacts_scale_impulses(const sbri_body_contacts *all, sbri_contact_group *group, float step_s) {
  float ratio = step_s / group->step_s;
  for (uint32_t i = 0; i < group->contact_count; i++) {
    sbri_contact *t = &all->contacts[group->first_contact + i];
    t->normal_impulse *= ratio, t->external_bias *= ratio,
        t->friction_impulse = sbri_scale(t->friction_impulse, ratio);
  }
  group->step_s = step_s;
}

static sbri_cached_contact cached_from(const sbri_contact *t, float step_s) {
  return (sbri_cached_contact){.body_ids = {t->body_ids[0], t->body_ids[1]},
      .feature = t->feature,
      .local_point = t->a.point,
      .normal_force = t->normal_impulse / step_s,
      .friction_force = sbri_scale(t->friction_impulse, 1 / step_s),
      .tangent_slip = t->sticking.slip,
      .external_acceleration = t->external_bias / step_s,
      .common_exit = t->exits_common ? t->normal : (sbf_vec3){0, 0, 0}};
}

/* Sleeping bodies keep their cached contacts. */
static bool stays_asleep(const sbr_world *world, const sbri_cached_contact *m) {
  uint32_t character = (uint32_t)(m->body_ids[0] >> 32);
  return world->characters[character].model && world->body_contacts->group_of[character] == UINT32_MAX &&
         sbri_header(&world->characters[character])->asleep;
}

void sbri_contacts_store(sbr_world *world) {
  sbri_body_contacts *all = world->body_contacts;
  uint32_t count = 0;
  for (uint32_t i = 0; i < all->cache.count; i++)
    if (stays_asleep(world, &all->cache.at[i])) all->cache.next[count++] = all->cache.at[i];
  for (uint32_t g = 0; g < all->group_count; g++)
    for (uint32_t i = 0; i < all->groups[g].contact_count; i++) {
      const sbri_contact *t = &all->contacts[all->groups[g].first_contact + i];
      if ((t->is_loaded || t->exits_common) && count < all->contact_capacity)
        all->cache.next[count++] = cached_from(t, all->groups[g].step_s);
    }
  sbri_cached_contact *before = all->cache.at;
  all->cache.at = all->cache.next;
  all->cache.next = before;
  all->cache.count = count;
  build_cache_table(all);
}

/* ---- Snapshots ---- */

size_t sbri_contact_cache_size(const sbr_world *world) {
  const sbri_body_contacts *all = world->body_contacts;
  return all ? sizeof(uint64_t) + all->contact_capacity * sizeof *all->cache.at : 0;
}

void sbri_contact_cache_save(const sbr_world *world, unsigned char *to) {
  const sbri_body_contacts *all = world->body_contacts;
  if (!all) return;
  uint64_t count = all->cache.count;
  memcpy(to, &count, sizeof count);
  memcpy(to + sizeof count, all->cache.at, count * sizeof *all->cache.at);
  memset(to + sizeof count + count * sizeof *all->cache.at, 0,
      (all->contact_capacity - count) * sizeof *all->cache.at);
}

void sbri_contact_cache_restore(sbr_world *world, const unsigned char *from) {
  sbri_body_contacts *all = world->body_contacts;
  if (!all) return;
  uint64_t count;
  memcpy(&count, from, sizeof count);
  all->cache.count = (uint32_t)count;
  memcpy(all->cache.at, from + sizeof count, count * sizeof *all->cache.at);
  build_cache_table(all);
}
