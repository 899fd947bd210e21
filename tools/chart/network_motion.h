/* Reference motion of springs and tetrahedra in double precision, with a scheme that the runtime does not
 * use: errors in time are relative to it.
 *
 * Fourth order Runge-Kutta method with equal steps, from rest, on the energies of the specification (10.1,
 * 10.2) without damping, contact, limits or gas. */
#ifndef CHART_NETWORK_MOTION_H
#define CHART_NETWORK_MOTION_H

#include "chart/track.h"
#include "sbfmt/asset.h"

/* Fills `track` (created here) with the points of the finest level of the first body, one sample per tick
 * of `tick_s` divided into `steps`. False if memory runs out. */
bool chart_network_move(const sbf_asset *asset, sbf_vec3 gravity, double tick_s, uint32_t steps,
    uint32_t ticks, chart_track *track);

#endif
