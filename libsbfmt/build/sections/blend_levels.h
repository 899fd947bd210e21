/* Smooths weights on fine surfaces by a multilevel method: coarser surfaces first. */
#ifndef SBFI_BLEND_LEVELS_H
#define SBFI_BLEND_LEVELS_H

#include "build/sections/blend_surface.h"

/* sbfi_blend_surface_relax() for surfaces of any resolution. A sweep transports weights by one triangle,
 * so a slope over a limb's thickness would need time quadratic in the triangles along it. Above some
 * 16,000 points the surface of clusters of neighbouring points is relaxed first, and its corrections are
 * transferred to the points (a cascade of multigrid's coarse corrections). Above some 262,000 points each
 * triangle contracts a limited number of times, so that the time is linear in the triangles; `*left` includes
 * those that reach the limit. */
bool sbfi_blend_levels_relax(sbfi_blend_surface *surface, uint32_t *left, sbfi_arena *arena);

#endif
