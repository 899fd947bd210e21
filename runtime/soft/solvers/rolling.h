/* Rolling resistance of loose bodies on the ground.
 *
 * A rolling soft body is flattened continuously, and its damping dissipates a fraction of that work. With its
 * weight N this is a moment of up to
 *
 *     M = H 2 a / (3 pi) N
 *
 * with `a` half the width of the contact along the rolling direction, and H the fraction of the work that a
 * load cycle dissipates, 1 - exp(-2 pi z) at the damping ratio z (the line contact of K. L. Johnson, Contact
 * Mechanics, 1985, chapter 9). A coarse surface has few points in contact at once, so the points alone would
 * dissipate far less than a fine one, and bodies would rock for long. */
#ifndef SBRI_ROLLING_H
#define SBRI_ROLLING_H

#include "model/island_tick.h"

/* Offset of the normal force as a fraction of half the contact width: H 2 / (3 pi). */
float sbri_rolling_fraction(float damping_ratio);

/* Reduces the body's angular velocity by that moment over a tick, at most to 0. Call after contacts are
 * prepared. */
void sbri_rolling_apply_resistance(const sbri_island_tick *tick, const sbri_body *body);

#endif
