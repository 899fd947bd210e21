/* Checks weight maps: factors that leave mass in the body, on attributes that are set. */
#include "validate/rules/pin_states.h"
#include "validate/validation.h"

static bool some_set_yields(const sbf_soft_body *body, bool tears) {
  for (uint32_t l = 0; l < body->levels.count; l++)
    for (uint32_t s = 0; s < body->levels.at[l].springs.count; s++) {
      const sbf_spring_set *set = &body->levels.at[l].springs.at[s];
      if ((tears ? set->tear_strain : set->yield_strain) > 0) return true;
    }
  return false;
}

/* Whether the scaled attribute is 0 everywhere. A bending stiffness of 0 means that it is derived from the
 * modulus. */
static bool is_idle(const sbf_soft_body *body, sbf_weight_property property) {
  const sbf_attributes *is = &body->attributes;
  switch (property) {
  case SBF_WEIGHT_PROPERTY_MASS_DAMPING:
    return is->mass_damping == 0;
  case SBF_WEIGHT_PROPERTY_STIFFNESS_DAMPING:
    return is->stiffness_damping == 0;
  case SBF_WEIGHT_PROPERTY_FRICTION:
    return is->friction == 0;
  case SBF_WEIGHT_PROPERTY_PRESSURE:
    return is->pressure_mode == SBF_PRESSURE_MODE_NONE ||
           (is->pressure == 0 && is->pressure_mode == SBF_PRESSURE_MODE_GAS);
  case SBF_WEIGHT_PROPERTY_YIELD_STRAIN:
    return is->yield_strain == 0 && !some_set_yields(body, false);
  case SBF_WEIGHT_PROPERTY_TEAR_STRAIN:
    return is->tear_strain == 0 && !some_set_yields(body, true);
  default:
    return false;
  }
}

static void mark_pinned(const sbf_soft_body *body, uint8_t *pinned) {
  for (uint32_t s = 0; s < body->pins.count; s++)
    for (uint32_t i = 0; i < body->pins.at[s].points.count; i++)
      if (sbfi_pin_weight(&body->pins.at[s], i) >= 1) pinned[body->pins.at[s].points.at[i]] = 1;
}

static void check_density(
    sbfi_validation *v, const sbf_soft_body *body, sbf_f32_list factors, const char *path) {
  uint8_t *pinned = sbfi_scratch(v, factors.count, 1);
  if (!pinned) return;
  mark_pinned(body, pinned);
  for (uint32_t i = 0; i < factors.count; i++)
    if (factors.at[i] == 0 && !pinned[i])
      sbfi_found(v, SBF_CODE_WEIGHT_MAP_ZERO, path, i, "the density map is 0 at the free point %u of '%s'", i,
          sbfi_label(body->name, body->id));
}

static void check_modulus(
    sbfi_validation *v, const sbf_soft_body *body, sbf_f32_list factors, const char *path) {
  for (uint32_t i = 0; i < factors.count; i++)
    if (factors.at[i] > 0) return;
  if (factors.count)
    sbfi_found(v, SBF_CODE_WEIGHT_MAP_ZERO, path, -1, "the modulus map is 0 at every point of '%s'",
        sbfi_label(body->name, body->id));
}

static void check_map(
    sbfi_validation *v, const sbf_soft_body *body, const sbf_weight_map *map, const char *path) {
  sbfi_path values = sbfi_path_of("%s/values", path);
  if (map->property == SBF_WEIGHT_PROPERTY_DENSITY) check_density(v, body, map->values, values.text);
  if (map->property == SBF_WEIGHT_PROPERTY_YOUNG_MODULUS) check_modulus(v, body, map->values, values.text);
  if (is_idle(body, map->property))
    sbfi_found(v, SBF_CODE_WEIGHT_MAP_IDLE, path, -1, "a map scales the %s of '%s', which is 0",
        sbf_weight_property_name(map->property), sbfi_label(body->name, body->id));
}

void sbfi_check_weight_maps(sbfi_validation *v) {
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++)
    for (uint32_t m = 0; m < v->asset->soft_bodies.at[b].weight_maps.count && !v->out_of_memory; m++)
      check_map(v, &v->asset->soft_bodies.at[b], &v->asset->soft_bodies.at[b].weight_maps.at[m],
          sbfi_path_of("/sbf/soft_body[%u]/weight_map[%u]", b + 1, m + 1).text);
}
