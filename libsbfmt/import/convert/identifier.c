/* Creates unique ids from names, with characters that a file allows. */
#include <stdio.h>
#include <string.h>

#include "import/convert/conversion.h"

static uint64_t hash_text(const char *text) {
  uint64_t hash = 1469598103934665603u; /* FNV-1a */
  for (; *text; text++) hash = (hash ^ (unsigned char)*text) * 1099511628211u;
  return hash;
}

/* Slot of `id`, or the free slot where it belongs. */
static const char **find_slot(sbfi_id_set *set, const char *id) {
  const char **slots = set->slots.at;
  size_t mask = set->slots.count - 1;
  for (size_t i = (size_t)hash_text(id) & mask;; i = (i + 1) & mask)
    if (!slots[i] || strcmp(slots[i], id) == 0) return &slots[i];
}

static bool grow(sbfi_id_set *set) {
  sbfi_id_set larger = {.used = set->used};
  sbfi_array_init(&larger.slots, &set->slots.allocator, sizeof(char *));
  if (!sbfi_array_push(&larger.slots, set->slots.count ? set->slots.count * 2 : 64)) return false;
  const char **slots = set->slots.at;
  for (size_t i = 0; i < set->slots.count; i++)
    if (slots[i]) *find_slot(&larger, slots[i]) = slots[i];
  sbfi_array_free(&set->slots);
  *set = larger;
  return true;
}

/* Ensures capacity for one more id. */
static bool reserve(sbfi_id_set *set) {
  return 2 * (size_t)(set->used + 1) <= set->slots.count || grow(set);
}

bool sbfi_claim_id(sbfi_conversion *c, const char *id) {
  if (!reserve(&c->ids)) return false;
  const char **slot = find_slot(&c->ids, id);
  c->ids.used += *slot == NULL;
  *slot = id;
  return true;
}

const char *sbfi_new_id(sbfi_conversion *c, const char *kind, const char *name) {
  sbfi_id_set *set = &c->ids;
  if (!reserve(set)) return NULL;
  size_t size = strlen(kind) + strlen(name) + 16;
  char *id = sbfi_convert_allocate(c, size, 1);
  if (!id) return NULL;
  int length = snprintf(id, size, "%s.%s", kind, *name ? name : "unnamed");
  for (char *at = id; *at; at++)
    if ((unsigned char)*at <= ' ') *at = '_';
  const char **slot = find_slot(set, id);
  for (unsigned number = 2; *slot; number++) {
    snprintf(id + length, size - (size_t)length, "~%u", number);
    slot = find_slot(set, id);
  }
  *slot = id;
  set->used++;
  return id;
}
