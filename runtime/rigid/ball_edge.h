/* Ball joints of the tree: they fix a point and leave every rotation free, as most joints of a ragdoll do.
 * Each is eliminated by its own three unknowns, without constraint rows; two at once, as limbs come in pairs.
 *
 * The child's inertia about the joint's point has the blocks A (linear), E (between angular and linear) and C
 * (angular). K is the compliance between the two bodies' rotations: joint damping, drives, active limits. The
 * child's angular velocity w follows from
 *   (C + K) w = m + r + K w_parent - E v,      v the velocity of the joint's point;
 * the parent gets the remaining inertia and impulse at that point (Featherstone, The calculation of robot
 * dynamics using articulated-body inertias, 1983). Everything is kept in factors of C + K, so that a light
 * link keeps its own inertia beside a heavy one's. */
#ifndef SBRI_BALL_EDGE_H
#define SBRI_BALL_EDGE_H

#include "rigid/rigid_system.h"

/* Takes the children out, whose d stay as they are, and adds what their parents feel of it. */
void sbri_balls_eliminate(sbri_ball_pair *pair);
/* Likewise of the children's b; `with_rhs`: what the edges want, else as if that were 0. */
void sbri_balls_solve_forward(sbri_ball_pair *pair, bool with_rhs);
/* The children's x from their parents'; `keep`: adds to the active rows' impulses. */
void sbri_balls_solve_back(sbri_ball_pair *pair, bool keep);
/* Adds what the last solution has done to the edges' own impulses. */
void sbri_balls_note(sbri_ball_pair *pair);

#endif
