/* Joints of the tree that hold a place and leave every turn free, as most of a ragdoll's do: eliminated by
 * their own three unknowns, without rows for what they hold.
 *
 * With the child's inertia about the joint's place, A of speeds, E between turns and speeds, C of turns, and
 * K of what gives way between the two bodies' turns (flesh, drives, limits that press), the child turns by (C
 * + K) w = m + r + K w_parent - E v,      v the place's speed, and its parent feels at that place what is
 * left when that is put in (Featherstone, The calculation of robot dynamics using articulated-body inertias,
 * 1983). All in factors of C + K, so that a light link keeps its own inertia beside a heavy one's. */
#ifndef SBRI_BALL_EDGE_H
#define SBRI_BALL_EDGE_H

#include "rigid/rigid_system.h"

/* Takes the child out, whose d stays as it is, and adds what its parent, NULL: none, feels of it. */
void sbri_ball_eliminate(sbri_edge *edge, const sbri_node *child, sbri_node *parent);
/* Likewise of the child's b, which it overwrites; `with_rhs`: what the edge wants, else as if that were 0. */
void sbri_ball_forward(sbri_edge *edge, sbri_node *child, sbri_node *parent, bool with_rhs);
/* The child's x from its parent's; `keep`: adds to the active rows' impulses and to the edge's own. */
void sbri_ball_back(sbri_edge *edge, sbri_node *child, const sbri_node *parent, bool keep);

#endif
