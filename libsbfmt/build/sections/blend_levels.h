/* Smooth weights on fine surfaces: solved on coarser ones first. */
#ifndef SBFI_BLEND_LEVELS_H
#define SBFI_BLEND_LEVELS_H

#include "build/sections/blend_surface.h"

/* sbfi_blend_surface_relax() for surfaces of any fineness. A sweep carries weights over one triangle, so that
 * a slope as long as a limb is thick would take the square of the triangles along it. Above some 16,000
 * points the surface of clusters of neighbouring points is relaxed first, and its corrections are handed to
 * the points (a cascade of multigrid's coarse corrections). */
bool sbfi_blend_levels_relax(sbfi_blend_surface *surface, uint32_t *left, sbfi_arena *arena);

#endif
