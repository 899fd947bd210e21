/* Ball joints of the tree: they fix a point and leave every rotation free, as most joints of a ragdoll do.
 * Each is eliminated by its own three unknowns, without constraint rows; two at once, since limbs come in
 * pairs.
 *
 * The child's inertia about the joint's point has the blocks A (linear), E (between angular and linear) and C
 * (angular). K is the compliance between the two bodies' rotations: joint damping, drives, active limits. The
 * child's angular velocity w follows from
 *
 *   (C + K) w = m + r + K w_parent - E v,      v the velocity of the joint's point;
 *
 * the parent gets the remaining inertia and impulse at that point (Featherstone, The calculation of robot
 * dynamics using articulated-body inertias, 1983). Everything is kept in factors of C + K, so that the
 * inertia of a light link is not lost in rounding next to a heavy one. */
#ifndef SBRI_BALL_EDGE_H
#define SBRI_BALL_EDGE_H

#include "rigid/rigid_system.h"

/* Eliminates the children and adds their articulated inertia to their parents' d. The children's d does not
 * change. */
void sbri_balls_eliminate(sbri_ball_pair *pair);
/* The same for the children's b; `with_rhs`: with the edges' right-hand sides, else with 0. */
void sbri_balls_solve_forward(sbri_ball_pair *pair, bool with_rhs);
/* Computes the children's x from their parents'; `keep`: adds to the impulses of active rows. */
void sbri_balls_solve_back(sbri_ball_pair *pair, bool keep);
/* Adds the results of the last solve to the edges' own impulses. */
void sbri_balls_add_impulses(sbri_ball_pair *pair);

#endif
