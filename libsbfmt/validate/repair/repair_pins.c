/* Removes pins without effect: duplicates, and pins on a point that another set pins rigidly. */
#include "validate/repair/repair.h"
#include "validate/rules/pin_states.h"

/* The pin of a point: its set from 1 and its index. */
typedef struct point_pin {
  uint32_t set, index;
  bool fast;
} point_pin;

static bool is_same_pin(const sbf_pin_set *set, uint32_t a, uint32_t b) {
  if (sbfi_pin_weight(set, a) != sbfi_pin_weight(set, b)) return false;
  if (set->offsets.count == 0) return true;
  sbf_vec3 one = set->offsets.at[a], other = set->offsets.at[b];
  return one.x == other.x && one.y == other.y && one.z == other.z;
}

static void repair_set(
    sbfi_repair *m, sbf_pin_set *set, uint32_t number, point_pin *point_pins, const char *parent) {
  uint32_t repeated = 0, first = 0;
  uint8_t *dropped = sbfi_repair_scratch(m, set->points.count, 1);
  if (!dropped) return;
  for (uint32_t i = 0; i < set->points.count; i++) {
    point_pin *by = &point_pins[set->points.at[i]];
    if (by->set && (by->fast || (by->set == number + 1 && is_same_pin(set, by->index, i)))) {
      dropped[i] = 1;
      if (repeated++ == 0) first = i;
    } else {
      *by = (point_pin){number + 1, i, sbfi_pin_weight(set, i) >= 1};
    }
  }
  if (repeated) {
    if (set->offsets.count) sbfi_list_drop(&set->offsets, sizeof *set->offsets.at, dropped);
    if (set->weights.count > 1) sbfi_list_drop(&set->weights, sizeof *set->weights.at, dropped);
    sbfi_list_drop(&set->points, sizeof *set->points.at, dropped);
  }
  sbfi_path path = sbfi_path_of("%s/pins/pin_set[%u]/points", parent, number + 1);
  sbfi_count_repair(m, SBF_CODE_PIN_REPEATED, repeated, path.text, first,
      "%u pin%s on points that were pinned already removed", repeated, sbfi_plural(repeated));
}

static void repair_sets(
    sbfi_repair *m, const sbf_pin_set_list *sets, uint32_t point_count, const char *parent) {
  point_pin *point_pins = sbfi_repair_scratch(m, point_count, sizeof *point_pins);
  for (uint32_t s = 0; s < sets->count && !m->out_of_memory; s++)
    repair_set(m, sbfi_writable(&sets->at[s]), s, point_pins, parent);
}

void sbfi_repair_pins(sbfi_repair *m) {
  for (uint32_t b = 0; b < m->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = &m->asset->soft_bodies.at[b];
    sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]", b + 1);
    repair_sets(m, &body->pins, body->surface.positions.count + body->interior.count, path.text);
    for (uint32_t l = 0; l < body->levels.count && !m->out_of_memory; l++) {
      sbfi_path level = sbfi_path_of("%s/level[%u]", path.text, l + 1);
      repair_sets(m, &body->levels.at[l].pins, body->levels.at[l].positions.count, level.text);
    }
  }
}
