/* Finding how an input lies over a rig. Each returns false where memory runs out. */
#ifndef SBFI_ALIGN_H
#define SBFI_ALIGN_H

#include "import/rigging/rigging.h"
#include "import/rigging/similarity.h"

/* By points that the input and the rig's meshes both have, at least a tenth of the input's. */
bool sbfi_align_by_points(sbfi_rigging *r, bool *found);

/* By the shapes of two surfaces that are like each other. `*error` is the mean distance between them, as a
 * share of the rig's size, both ways. */
bool sbfi_align_by_shape(sbfi_rigging *r, double *error);

/* The distance from the rig's surface that half of the input's points exceed, as a share of the rig's size.
 */
bool sbfi_median_gap(const sbfi_rigging *r, double *median);

/* By the share of the bones' length that lies inside the input: what the files state stays where that is most
 * of it. IMPORT_RIG_OUTSIDE, which names bones and how far outside they are, where it is less than 60 %
 * anyhow. */
sbf_status sbfi_align_by_bones(sbfi_rigging *r);

/* The least share of the bones' length that lies inside the input and is nearest to some of its surface: with
 * less it is another character's rig. */
static const double SBFI_MIN_BONES_INSIDE = 0.6;

/* Makes the input, laid over the bones as it fits best, the asset's only mesh, for the picture of what does
 * not fit. False where memory runs out. */
bool sbfi_show_misfit(const sbfi_rigging *r, const sbfi_matrix *to_asset);

/* By turning the rig's bones about their joints, from the alignment that there is: `*found` where its mesh
 * then lies on the input. The rig, its surface and the asset's bones take that pose. */
bool sbfi_align_pose(sbfi_rigging *r, bool *found);

/* Whether a rig has neither a unit nor a mesh to be measured by, as motion capture: it takes the input's
 * size. */
bool sbfi_rig_has_no_size(const sbfi_rigging *r);

/* Whether a transform is what `--unit`, `--up` and `--forward` say. The scale is free where the rig has no
 * size.
 */
bool sbfi_alignment_allowed(const sbfi_rigging *r, const sbfi_matrix *m);

/* How near two points are that are taken for one, m; `quantum` is the step of the input's numbers. */
double sbfi_match_tolerance(const sbfi_rigging *r, double scale, double quantum);
double sbfi_input_quantum(const sbfi_rigging *r);

#endif
