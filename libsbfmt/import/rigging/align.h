/* Methods that align an input with a rig. Each returns false if memory runs out. */
#ifndef SBFI_ALIGN_H
#define SBFI_ALIGN_H

#include "import/rigging/rigging.h"
#include "import/rigging/similarity.h"

/* Aligns by points that the input and the rig's meshes share, at least a tenth of the input's. */
bool sbfi_align_by_points(sbfi_rigging *r, bool *found);

/* Aligns two similar surfaces by shape. `*error` is their symmetric mean distance as a fraction of the
 * rig's size. */
bool sbfi_align_by_shape(sbfi_rigging *r, double *error);

/* Median distance of the input's points from the rig's surface, as a fraction of the rig's size. */
bool sbfi_median_gap(const sbfi_rigging *r, double *median);

/* Aligns by the fraction of the bones' length inside the input. The stated transform stays if most of it
 * is inside. Warns with IMPORT_RIG_OUTSIDE, with names and distances of bones, if the best fraction is
 * below 60 %. */
sbf_status sbfi_align_by_bones(sbfi_rigging *r);

/* Minimum fraction of the bones' length that is inside the input and nearest to some of its surface; below
 * it the rig is another character's. */
static const double SBFI_MIN_BONES_INSIDE = 0.6;

/* Makes the input, in its best alignment, the asset's only mesh, for a picture of the misfit. False if
 * memory runs out. */
bool sbfi_show_misfit(const sbfi_rigging *r, const sbfi_matrix *to_asset);

/* Rotates the rig's bones about their joints, starting from the current alignment. `*found` is true if the
 * rig's mesh then matches the input; the rig, its surface and the asset's bones take that pose. */
bool sbfi_align_pose(sbfi_rigging *r, bool *found);

/* Whether the rig has neither a unit nor a mesh, as motion capture: it is scaled to the input. */
bool sbfi_rig_has_no_size(const sbfi_rigging *r);

/* After an alignment: if the rig has no size, gives it the input's unit and, if its file states no axes and
 * it does not stand upright, the input's axes. */
void sbfi_adapt_rig(sbfi_rigging *r);

/* Whether a transform agrees with `--unit`, `--up` and `--forward`. The scale is free if the rig has no
 * size. */
bool sbfi_alignment_allowed(const sbfi_rigging *r, const sbfi_matrix *m);

/* Maximum distance of two points that count as one, m; `quantum` is the resolution of the input's numbers. */
double sbfi_match_tolerance(const sbfi_rigging *r, double scale, double quantum);
double sbfi_input_quantum(const sbfi_rigging *r);

#endif
