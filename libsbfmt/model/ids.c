#include "model/ids.h"

enum { FIRST_CAPACITY = 64 };

void sbfi_ids_init(sbfi_ids *ids, const sbf_allocator *allocator) {
  *ids = (sbfi_ids){.allocator = sbfi_allocator_or_default(allocator), .key = (uintptr_t)ids};
}

void sbfi_ids_free(sbfi_ids *ids) {
  sbfi_free(&ids->allocator, ids->slots, ids->capacity * sizeof *ids->slots);
  *ids = (sbfi_ids){.allocator = ids->allocator, .key = ids->key};
}

/* The slot of an id is never visible outside the table, so a key that differs between runs is harmless. */
static uint64_t hash_of(const sbfi_ids *ids, const char *id) {
  uint64_t hash = ids->key, word;
  for (size_t left = strlen(id); left; id += sizeof word) {
    size_t taken = left < sizeof word ? left : sizeof word;
    word = left;
    memcpy(&word, id, taken);
    hash = (hash ^ word) * UINT64_C(0x9e3779b97f4a7c15);
    hash ^= hash >> 32;
    left -= taken;
    if (taken < sizeof word) break;
  }
  return hash * UINT64_C(0xd6e8feb86659fd93);
}

static sbfi_id_entry *slot_of(const sbfi_ids *ids, const char *id, uint64_t hash) {
  size_t mask = ids->capacity - 1, index = (size_t)(hash >> 32) & mask;
  while (ids->slots[index].id && (ids->slots[index].hash != hash || strcmp(ids->slots[index].id, id) != 0))
    index = (index + 1) & mask;
  return &ids->slots[index];
}

static bool grow(sbfi_ids *ids) {
  sbfi_ids grown = *ids;
  size_t bytes;
  grown.capacity = ids->capacity ? ids->capacity * 2 : FIRST_CAPACITY;
  if (!sbfi_multiply_size(grown.capacity, sizeof *grown.slots, &bytes)) return false;
  grown.slots = sbfi_allocate(&ids->allocator, bytes);
  if (!grown.slots) return false;
  memset(grown.slots, 0, bytes);
  for (size_t i = 0; i < ids->capacity; i++)
    if (ids->slots[i].id) *slot_of(&grown, ids->slots[i].id, ids->slots[i].hash) = ids->slots[i];
  sbfi_free(&ids->allocator, ids->slots, ids->capacity * sizeof *ids->slots);
  *ids = grown;
  return true;
}

bool sbfi_ids_add(sbfi_ids *ids, sbfi_id_entry entry, const sbfi_id_entry **first) {
  *first = NULL;
  if (ids->count * 2 >= ids->capacity && !grow(ids)) return false;
  entry.hash = hash_of(ids, entry.id);
  sbfi_id_entry *slot = slot_of(ids, entry.id, entry.hash);
  if (slot->id) {
    *first = slot;
    return true;
  }
  *slot = entry;
  ids->count++;
  return true;
}

const sbfi_id_entry *sbfi_ids_find(const sbfi_ids *ids, const char *id) {
  if (!ids->count) return NULL;
  const sbfi_id_entry *slot = slot_of(ids, id, hash_of(ids, id));
  return slot->id ? slot : NULL;
}

static const sbfi_field *id_field(const sbfi_element *element) {
  for (uint32_t i = 0; i < element->field_count; i++)
    if (element->fields[i].type == SBFI_ID) return &element->fields[i];
  return NULL;
}

static const char *id_at(
    const sbf_asset *asset, const sbfi_field *collection, const sbfi_field *id, uint32_t i) {
  const char *first = sbfi_get_list(asset, collection).at;
  return sbfi_get_pointer(first + (size_t)i * collection->element->struct_size, id);
}

bool sbfi_ids_add_collections(sbfi_ids *ids, const sbf_asset *asset) {
  for (uint32_t f = 0; f < sbfi_asset_element.field_count; f++) {
    const sbfi_field *field = &sbfi_asset_element.fields[f];
    const sbfi_field *id = field->type == SBFI_MANY ? id_field(field->element) : NULL;
    uint32_t count = id ? sbfi_get_list(asset, field).count : 0;
    for (uint32_t i = 0; i < count; i++) {
      const sbfi_id_entry *first;
      sbfi_id_entry entry = {.id = id_at(asset, field, id, i), .collection = field, .index = i};
      if (!sbfi_ids_add(ids, entry, &first)) return false;
    }
  }
  return true;
}

const sbfi_field *sbfi_ref_collection(const sbfi_field *ref) {
  const sbfi_field *field = sbfi_asset_element.fields;
  while (field->offset != ref->reference.offset) field++;
  return field;
}

uint32_t sbfi_ref_count(const sbf_asset *asset, const sbfi_field *ref) {
  const sbfi_field at = {.offset = ref->reference.offset};
  return sbfi_get_list(asset, &at).count;
}

const char *sbfi_ref_id(const sbf_asset *asset, const sbfi_field *ref, int32_t value) {
  if (value < 0 || (uint32_t)value >= sbfi_ref_count(asset, ref)) return NULL;
  const sbfi_field *collection = sbfi_ref_collection(ref);
  return id_at(asset, collection, id_field(collection->element), (uint32_t)value);
}
