/* Core points of a bone: the inner half of the volume around it, at any thickness. */
#ifndef SBFI_LATTICE_CORE_H
#define SBFI_LATTICE_CORE_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* Sets `thickness` (count) m: the radius of the greatest ball inside that the point lies in or near, which is
 * within half a radius (after Hildebrand and Rüegsegger, A new method for the model-independent assessment of
 * thickness, Journal of Microscopy 185, 1997, who have no such margin: here the balls' middles are none but
 * the points, whose squared distances from the surface are `depths2`, and in a coarse lattice those balls
 * fill no corner). Balls of a radius up to `min_m` do not count, nor those whose middle lies within a
 * quarter of a greater one's radius of that one's; what is in none has 0. False where memory runs out. */
bool sbfi_lattice_thickness(const sbf_vec3 *points, const double *depths2, uint32_t count, double min_m,
    float *thickness, sbfi_arena *scratch);

#endif
