/* Maps a body's source points to a level's points. */
#ifndef SBFI_LEVEL_POINTS_H
#define SBFI_LEVEL_POINTS_H

#include "sbfmt/model.h"

/* Level point of a source point; UINT32_MAX if it has none. */
static inline uint32_t sbfi_level_point(const sbf_level *level, uint32_t source_point) {
  uint32_t index = source_point;
  if (level->new_from_old.count > 0)
    index = source_point < level->new_from_old.count ? level->new_from_old.at[source_point] : UINT32_MAX;
  return index < level->positions.count ? index : UINT32_MAX;
}

/* Multiplies `values` (level->positions.count, none negative) by the body's weight maps of the property;
 * points without a source point use the mean of the map. */
void sbfi_level_weigh(
    const sbf_soft_body *body, const sbf_level *level, sbf_weight_property property, float *values);

#endif
