/* Collision filters as layers and masks. Two colliders meet if the systems of each are allowed by the other:
 * every distinct set of systems becomes a layer, which makes the rule exact. */
#include <string.h>

#include "import/physics/physics.h"

enum { LAYERS = 32 };

static bool check_list(const sbfi_physics *p, const sbfi_json *filter, const char *name) {
  const sbfi_json *list = sbfi_json_get(filter, name);
  bool good = !list || list->type == SBFI_JSON_ARRAY;
  for (uint32_t i = 0; list && good && i < list->count; i++)
    good = sbfi_json_at(list, i)->type == SBFI_JSON_STRING;
  return good ||
         sbfi_physics_fault(p, "`%s` at byte %zu of the JSON is no list of names", name, list->offset);
}

static bool has_name(const sbfi_json *list, const sbfi_json *name) {
  for (uint32_t i = 0; list && i < list->count; i++)
    if (sbfi_json_is_string(sbfi_json_at(list, i), name->text.at)) return true;
  return false;
}

/* Whether every name of a list, which may be NULL, is in the other one. */
static bool is_subset(const sbfi_json *list, const sbfi_json *of) {
  for (uint32_t i = 0; list && i < list->count; i++)
    if (!has_name(of, sbfi_json_at(list, i))) return false;
  return true;
}

static bool may_collide(const sbfi_json *filter, const sbfi_json *systems) {
  const sbfi_json *with = sbfi_json_get(filter, "collideWithSystems"),
                  *not_with = sbfi_json_get(filter, "notCollideWithSystems");
  if (!systems || !systems->count) return true;
  return with ? is_subset(systems, with) : !not_with || !is_subset(systems, not_with);
}

bool sbfi_physics_find_layers(sbfi_conversion *c, const sbfi_physics_filter **filters) {
  sbfi_physics *p = c->physics;
  const sbfi_json *sets[LAYERS] = {NULL}; /* the first is empty */
  uint32_t count = p->filters ? p->filters->count : 0, set_count = 1, set;
  sbfi_physics_filter *made = sbfi_arena_allocate(&c->scratch, (size_t)count + 1, sizeof *made);
  if (!made) return sbfi_convert_no_memory(c) == SBF_OK;
  for (uint32_t f = 0; f < count; f++) {
    const sbfi_json *filter = sbfi_json_at(p->filters, f), *own = sbfi_json_get(filter, "collisionSystems");
    if (!check_list(p, filter, "collisionSystems") || !check_list(p, filter, "collideWithSystems") ||
        !check_list(p, filter, "notCollideWithSystems"))
      return false;
    for (set = 0; set < set_count; set++)
      if (is_subset(own, sets[set]) && is_subset(sets[set], own)) break;
    if (set == LAYERS) p->losses[SBFI_LOSS_SYSTEMS]++, set--;
    if (set == set_count) sets[set_count++] = own;
    made[f].layer = 1u << set;
  }
  for (uint32_t f = 0; f < count; f++) {
    made[f].mask = UINT32_MAX;
    for (set = 0; set < set_count; set++)
      if (!may_collide(sbfi_json_at(p->filters, f), sets[set])) made[f].mask &= ~(1u << set);
  }
  *filters = made;
  return true;
}
