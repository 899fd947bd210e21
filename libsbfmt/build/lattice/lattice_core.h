/* Core points of a bone: the inner half of the volume around it, at any thickness. */
#ifndef SBFI_LATTICE_CORE_H
#define SBFI_LATTICE_CORE_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* Sets `thickness` (count) m: the radius of the greatest inner ball that contains the point or is within half
 * a radius of it; 0 if there is none. After Hildebrand and Rüegsegger, A new method for the model-independent
 * assessment of thickness, Journal of Microscopy 185, 1997, who have no such margin. It is needed here
 * because the balls' centres are only the points themselves, whose squared distances from the surface are
 * `depths2`, and in a coarse lattice such balls do not reach into corners. Ignores balls of a radius up to
 * `min_m`, and those whose centre is within a quarter of a greater ball's radius from its centre. False if
 * memory runs out. */
bool sbfi_lattice_thickness(const sbf_vec3 *points, const double *depths2, uint32_t count, double min_m,
    float *thickness, sbfi_arena *scratch);

#endif
