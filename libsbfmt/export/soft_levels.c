/* Selects the level of a soft body for other programs, and maps its points. */
#include "export/exporting.h"
#include "sbfmt/mechanics.h"

const sbf_level *sbfi_export_lattice(const sbf_soft_body *body) {
  for (uint32_t i = 0; i < body->levels.count; i++)
    if (body->levels.at[i].model == SBF_ELASTIC_MODEL_TETRAHEDRA &&
        body->levels.at[i].lattice.tetrahedra.count)
      return &body->levels.at[i];
  return NULL;
}

const sbf_level *sbfi_export_network(const sbf_soft_body *body) {
  for (uint32_t i = 0; i < body->levels.count; i++) {
    const sbf_level *level = &body->levels.at[i];
    if (level->model != SBF_ELASTIC_MODEL_SPRINGS) continue;
    for (uint32_t s = 0; s < level->springs.count; s++)
      if (level->springs.at[s].ends.count) return level;
  }
  return NULL;
}

uint32_t sbfi_export_index(const sbf_level *level, uint32_t point) {
  uint32_t index = point < level->new_from_old.count ? level->new_from_old.at[point] : point;
  return index < level->positions.count ? index : SBFI_NOT_IN_LEVEL;
}

bool sbfi_export_is_sheet(const sbf_soft_body *body, const sbf_level *level) {
  sbf_body_measures measures;
  sbf_body_measure(body, &measures);
  for (uint32_t i = 0; i < body->surface.positions.count; i++)
    if (sbfi_export_index(level, i) == SBFI_NOT_IN_LEVEL) return false;
  return measures.sheet && body->surface.polygon_sizes.count;
}

const sbf_level *sbfi_export_level(const sbf_soft_body *body) {
  const sbf_level *level = sbfi_export_lattice(body);
  if (level) return level;
  level = sbfi_export_network(body);
  return level && sbfi_export_is_sheet(body, level) ? level : NULL;
}

float sbfi_export_pin_weight(const sbf_pin_set *set, uint32_t k) {
  float weight = set->weights.count > 1 ? set->weights.at[k] : set->weights.count ? set->weights.at[0] : 1;
  if (weight < set->minimum) weight = set->minimum;
  return weight > set->maximum ? set->maximum : weight;
}
