/* How springs and tetrahedra move, in double precision and by another scheme than any of the runtime's: what
 * errors in time are measured against.
 *
 * Runge and Kutta's method of fourth order with equal steps, on the energies of the specification
 * (10.1, 10.2) without damping, contact, limits or gas, from rest. */
#ifndef CHART_NETWORK_MOTION_H
#define CHART_NETWORK_MOTION_H

#include "chart/track.h"
#include "sbfmt/asset.h"

/* Fills `track` (made by the callee) with the points of the finest level of the first body, a sample a tick
 * of `tick_s` divided into `steps`. False where memory runs out. */
bool chart_network_move(const sbf_asset *asset, sbf_vec3 gravity, double tick_s, uint32_t steps,
    uint32_t ticks, chart_track *track);

#endif
