/* Rolling resistance of bodies that nothing holds and that lie on the ground.
 *
 * A soft body that rolls is pressed flat anew all the time, and its damping takes a share of the work each
 * time: of its weight N, a moment up to
 *
 *     M = H 2 a / (3 pi) N
 *
 * with `a` half the width of what touches, along the way that it rolls, and H the share of the work that is
 * lost as the load comes and goes, 1 - exp(-2 pi z) at the damping ratio z (the line contact of K. L.
 * Johnson, Contact Mechanics, 1985, chapter 9). Few points of a coarse surface touch at once, so that the
 * passes of the points alone would lose far less than flesh does, and bodies would rock for long. */
#ifndef SBRI_ROLLING_H
#define SBRI_ROLLING_H

#include "model/island_tick.h"

/* Offset of the normal force as a fraction of half the contact width: H 2 / (3 pi). */
float sbri_rolling_fraction(float damping_ratio);

/* Reduces the body's angular velocity by that moment over a tick, at most to 0. Call after contacts are
 * prepared. */
void sbri_rolling_apply_resistance(const sbri_island_tick *tick, const sbri_body *body);

#endif
