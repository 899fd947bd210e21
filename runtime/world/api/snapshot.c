/* Saves, restores and hashes all mutable state. A snapshot is valid in its process only: it is no file
 * format. */
#include <string.h>

#include "base/diagnostic.h"
#include "base/hash64.h"
#include "coupling/body_contact/body_contacts.h"
#include "state/pose/frames.h"

typedef struct snapshot_header {
  uint64_t magic, size, ticks, characters;
  int64_t ahead_units;
} snapshot_header;

/* One before each character's state block. */
typedef struct snapshot_part {
  uint32_t index, generation;
  uint64_t size;
} snapshot_part;

static const uint64_t MAGIC = 0x31706e7372627321; /* "!sbrsnp1" */

size_t sbr_world_get_snapshot_size(const sbr_world *world) {
  size_t size = sizeof(snapshot_header);
  if (world) size += sbri_contact_cache_size(world);
  for (uint32_t i = 0; world && i < world->character_capacity; i++)
    if (world->characters[i].model)
      size += sizeof(snapshot_part) + world->characters[i].model->detail.base->detail.max_state_size;
  return world ? size : 0;
}

static uint64_t count_characters(const sbr_world *world) {
  uint64_t count = 0;
  for (uint32_t i = 0; i < world->character_capacity; i++) count += world->characters[i].model != NULL;
  return count;
}

sbf_status sbr_world_save_snapshot(const sbr_world *world, void *bytes, size_t size) {
  if (!world || !bytes || size != sbr_world_get_snapshot_size(world)) return SBF_FAILED;
  snapshot_header head = {MAGIC, size, world->time.ticks, count_characters(world), world->time.ahead_units};
  unsigned char *to = bytes;
  memcpy(to, &head, sizeof head);
  to += sizeof head;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    const sbri_character *c = &world->characters[i];
    if (!c->model) continue;
    snapshot_part part = {i, c->generation, c->model->layout.state_size};
    memcpy(to, &part, sizeof part);
    memcpy(to + sizeof part, c->state, part.size);
    to += sizeof part + part.size;
  }
  sbri_contact_cache_save(world, to);
  to += sbri_contact_cache_size(world);
  memset(to, 0, size - (size_t)(to - (unsigned char *)bytes)); /* space for other detail levels */
  return SBF_OK;
}

/* The model of the detail level of a state; NULL: it is invalid for the character or the snapshot. */
static const sbr_model *model_of(
    const sbri_character *c, const snapshot_part *part, const unsigned char *state, size_t left) {
  sbri_character_state head;
  if (part->size < sizeof head || part->size > left) return NULL;
  memcpy(&head, state, sizeof head);
  const sbr_model *base = c->model->detail.base;
  const sbr_model *model =
      head.detail_level < base->detail.level_count ? base->detail.levels[head.detail_level] : NULL;
  return model && part->size == model->layout.state_size ? model : NULL;
}

/* Whether the snapshot belongs to this world and its characters, and storage exists for their detail levels;
 * checked before anything changes. */
static bool fits(sbr_world *world, const unsigned char *bytes, size_t size) {
  const unsigned char *end = bytes + size;
  snapshot_header head;
  if (size != sbr_world_get_snapshot_size(world)) return false;
  memcpy(&head, bytes, sizeof head);
  if (head.magic != MAGIC || head.size != size || head.characters != count_characters(world)) return false;
  bytes += sizeof head;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    sbri_character *c = &world->characters[i];
    snapshot_part part;
    if (!c->model) continue;
    if ((size_t)(end - bytes) < sizeof part) return false;
    memcpy(&part, bytes, sizeof part);
    bytes += sizeof part;
    const sbr_model *model = model_of(c, &part, bytes, (size_t)(end - bytes));
    if (part.index != i || part.generation != c->generation || !model) return false;
    bytes += part.size;
    if (model == c->model || model == c->spare.model) continue;
    sbri_character_storage_free(&world->allocator, &c->spare);
    if (!sbri_character_storage_create(&world->allocator, model, &c->spare)) return false;
  }
  return sbri_contact_cache_size(world) <= (size_t)(end - bytes);
}

sbf_status sbr_world_restore_snapshot(sbr_world *world, const void *bytes, size_t size) {
  if (!world || !bytes || !fits(world, bytes, size)) return SBF_FAILED;
  const unsigned char *from = bytes;
  snapshot_header head;
  memcpy(&head, from, sizeof head);
  world->time.ticks = head.ticks;
  world->time.ahead_units = head.ahead_units;
  world->time.stamp++;
  from += sizeof head;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    sbri_character *c = &world->characters[i];
    snapshot_part part;
    if (!c->model) continue;
    memcpy(&part, from, sizeof part);
    from += sizeof part;
    if (model_of(c, &part, from, part.size) != c->model) sbri_character_storage_swap(c);
    memcpy(c->state, from, part.size);
    from += part.size;
    sbri_contact_surfaces_select_level(world, i);
    sbri_deltas_make(c, sbri_pose(c), 1, sbri_deltas(c));
  }
  sbri_contact_cache_restore(world, from);
  return SBF_OK;
}

static void hash_detail_level(sbfi_hash64 *hash, const sbri_character *c) {
  const sbri_character_state *head = sbri_header(c);
  const uint32_t words[10] = {head->detail_level, head->next_detail_level, head->set_detail_level_plus_1,
      head->detail_level_ticks, head->fade_ticks, head->fades_ticks, head->visibility, head->unseen_ticks,
      head->fade_kept, head->swing_ticks};
  const float fractions[2] = {head->fade, head->fade_before};
  const uint32_t *first = c->model->detail.base->detail.first_vertices;
  sbfi_hash64_add_u32(hash, words, 10);
  sbfi_hash64_add_f32(hash, fractions, 2);
  if (head->fade_before > 0 || head->fade_kept)
    sbfi_hash64_add_f32(
        hash, &sbri_faded(c)->position.x, 12 * (size_t)first[c->model->asset->render_meshes.count]);
}

uint64_t sbr_world_get_state_hash(const sbr_world *world) {
  sbfi_hash64 hash;
  sbfi_hash64_init(&hash);
  if (!world) return 0;
  sbfi_hash64_add_u64(&hash, &world->time.ticks, 1);
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    const sbri_character *c = &world->characters[i];
    if (!c->model) continue;
    const sbri_layout *l = &c->model->layout;
    const sbri_character_state *head = sbri_header(c);
    const float wanted[3] = {head->forward, head->sideways, head->turn};
    uint32_t id[3] = {i, head->paused, head->asleep};
    sbfi_hash64_add_u32(&hash, id, 3);
    sbfi_hash64_add_f64(&hash, &head->origin.x, 3);
    sbfi_hash64_add_f32(&hash, wanted, 3);
    sbfi_hash64_add_bytes(&hash, sbri_gait(c), sbri_gait_state_size(&c->model->rig));
    sbfi_hash64_add_f32(&hash, &sbri_pose(c)->position.x, 7 * (size_t)c->model->frame_count);
    sbfi_hash64_add_f32(&hash, &sbri_previous_pose(c)->position.x, 7 * (size_t)c->model->frame_count);
    sbfi_hash64_add_u32(&hash, (const uint32_t *)(const void *)sbri_island_states(c),
        (size_t)c->model->island_count * sizeof(sbri_island_state) / sizeof(uint32_t));
    /* Positions, previous positions and velocities are adjacent. */
    sbfi_hash64_add_f32(&hash, (const float *)(const void *)(c->state + l->points.positions),
        (l->solids.blocks - l->points.positions) / sizeof(float));
    sbfi_hash64_add_u32(&hash, (const uint32_t *)(const void *)(c->state + l->solids.blocks),
        (l->used_size - l->solids.blocks) / sizeof(uint32_t));
    if (c->model->detail.base->detail.level_count > 1) hash_detail_level(&hash, c);
  }
  for (uint32_t i = 0; world->body_contacts && i < world->body_contacts->cache.count; i++) {
    const sbri_cached_contact *m = &world->body_contacts->cache.at[i];
    sbfi_hash64_add_u64(&hash, m->body_ids, 2);
    sbfi_hash64_add_u32(&hash, &m->feature, 1);
    sbfi_hash64_add_f32(&hash, &m->local_point.x, 3);
    sbfi_hash64_add_f32(&hash, &m->normal_force, 1);
    sbfi_hash64_add_f32(&hash, &m->friction_force.x, 3);
    sbfi_hash64_add_f32(&hash, &m->tangent_slip.x, 3);
    sbfi_hash64_add_f32(&hash, &m->external_acceleration, 1);
    if (sbri_dot(m->common_exit, m->common_exit) > 0) sbfi_hash64_add_f32(&hash, &m->common_exit.x, 3);
  }
  return sbfi_hash64_value(&hash);
}
