/* Joints of the tree that hold a place and leave every turn free, as most of a ragdoll's do: eliminated by
 * their own three unknowns, without rows for what they hold, and two at once, as limbs come in pairs.
 *
 * With the child's inertia about the joint's place, A of speeds, E between turns and speeds, C of turns, and
 * K of what gives way between the two bodies' turns (flesh, drives, limits that press), the child turns by (C
 * + K) w = m + r + K w_parent - E v,      v the place's speed, and its parent feels at that place what is
 * left when that is put in (Featherstone, The calculation of robot dynamics using articulated-body inertias,
 * 1983). All in factors of C + K, so that a light link keeps its own inertia beside a heavy one's. */
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
