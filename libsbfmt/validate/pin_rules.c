/* Pins: sets that hold something, points held once, sections that are held at all. */
#include "validate/validation.h"

static void check_sets(
    sbfi_validation *v, const sbf_pin_set_list *sets, uint32_t point_count, const char *parent) {
  uint32_t *holder =
      sbfi_arena_allocate(&v->scratch, point_count + 1u, sizeof *holder); /* set from 1; 0: none */
  if (!holder) {
    v->out_of_memory = true;
    return;
  }
  for (uint32_t s = 0; s < sets->count; s++) {
    const sbf_pin_set *set = &sets->at[s];
    sbfi_path path = sbfi_path_of("%s/pins/pin_set[%u]", parent, s + 1);
    if (set->points.count == 0)
      sbfi_found(v, SBF_CODE_PIN_SET_EMPTY, path.text, -1, "pin set '%s' holds no point", set->name);
    if (set->minimum > set->maximum)
      sbfi_found(
          v, SBF_CODE_PIN_RANGE, path.text, -1, "pin set '%s' has a minimum above its maximum", set->name);
    if (set->bone >= 0 && set->rigid_body >= 0)
      sbfi_found(
          v, SBF_CODE_PIN_TWO_FRAMES, path.text, -1, "pin set '%s' names a bone and a rigid body", set->name);
    for (uint32_t i = 0; i < set->points.count; i++) {
      uint32_t p = set->points.at[i];
      if (holder[p])
        sbfi_found(
            v, SBF_CODE_PIN_REPEATED, path.text, i, "point %u is held by set %u already", p, holder[p]);
      else
        holder[p] = s + 1;
    }
  }
}

void sbfi_check_pins(sbfi_validation *v) {
  for (uint32_t b = 0; b < v->asset->soft_bodies.count && !v->out_of_memory; b++) {
    const sbf_soft_body *body = &v->asset->soft_bodies.at[b];
    sbfi_path path = sbfi_path_of("/sbf/soft_body[%u]", b + 1);
    check_sets(v, &body->pins, body->surface.positions.count + body->interior.count, path.text);
    for (uint32_t l = 0; l < body->levels.count && !v->out_of_memory; l++) {
      sbfi_path level = sbfi_path_of("/sbf/soft_body[%u]/level[%u]", b + 1, l + 1);
      check_sets(v, &body->levels.at[l].pins, body->levels.at[l].positions.count, level.text);
      bool carried = body->levels.at[l].model == SBF_ELASTIC_MODEL_JIGGLE; /* by its bone, without pins */
      if (body->bone >= 0 && body->levels.at[l].pins.count == 0 && !carried)
        sbfi_found(v, SBF_CODE_SECTION_UNHELD, level.text, -1,
            "section '%s' has a bone and no pins: it falls off", body->name);
    }
  }
}
