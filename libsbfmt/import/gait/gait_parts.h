/* Proposes parts of a gait for characters that do not walk. */
#ifndef SBFI_GAIT_PARTS_H
#define SBFI_GAIT_PARTS_H

#include <math.h>

#include "import/convert/conversion.h"
#include "import/gait/locomotion.h"

/* Each adds the gait of an asset that faces +Z; false if memory runs out. */
bool sbfi_propose_swim(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait);
bool sbfi_propose_fly(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait);
bool sbfi_propose_slither(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait);
bool sbfi_propose_crawl(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait);
bool sbfi_propose_roll(sbfi_conversion *c, const sbfi_rig_view *view, sbf_gait *gait);

/* Finds middle bones with points, from the nose (+Z) to the tail, along the longest path between two ends
 * of the tree. Their number is 0 if there are fewer than two. */
bool sbfi_find_backbone(
    const sbfi_rig_view *view, sbf_asset *asset, sbfi_arena *scratch, sbf_u32_list *bones);

static inline double sbfi_view_extent(const sbfi_rig_view *view, int axis) {
  return view->points.high[axis] - view->points.low[axis];
}

static inline double sbfi_view_size(const sbfi_rig_view *view) {
  return fmax(sbfi_view_extent(view, 0), fmax(sbfi_view_extent(view, 1), sbfi_view_extent(view, 2)));
}

#endif
