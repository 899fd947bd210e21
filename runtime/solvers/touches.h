/* Contacts of surfaces that points carry. A push at a place x = sum w_i x_i changes the velocity there, and
 * that of each point that carries it by w_i / m_i as much, over the sum of w_i^2 / m_i: as forces on the
 * surface act.
 *
 * Places share their points, so that a push at one is felt at others. All pushes of a substep are found in
 * passes, each push being corrected by what the others have left of it, and never below nothing (projected
 * Gauss-Seidel over gathered impulses; E. Catto, Iterative Dynamics with Temporal Coherence, 2005); those of
 * the substep before are where it begins. What rests is so borne by the same pushes all the time: pushes that
 * only add up would make it hop.
 *
 * A push is answered by the sum of its row of responses instead of the diagonal, over those that push or are
 * about to: by Gershgorin's theorem no pass overshoots, and an even pressure is exact at once, so that few
 * passes do. Where the other side has a mass, or is the body itself, pushes are answered in full, one
 * after the other, in more passes. Rules of friction, restitution and depth are those of contact/contact.h.
 */
#ifndef SBRI_TOUCHES_H
#define SBRI_TOUCHES_H

#include "collide/touching.h"
#include "contact/contact.h"

/* Bounds velocities so that nothing of the body's surface goes below its planes in the substep that they are
 * for, from the present places, which are lifted where they are too deep. */
void sbri_touches_answer(
    const sbri_island_tick *t, const sbri_body *body, float *velocities, const sbri_contact_rule *rule);

/* How much of a body's contacts slides, summed over them: N s, or a count where all weigh alike. */
typedef struct sbri_sliding {
  float load, limit; /* normal impulses; and these times the coefficient of friction */
  sbf_vec3 friction; /* impulses of those that slide */
} sbri_sliding;
sbri_sliding sbri_touches_sliding(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule);

/* Planes go with what they stand for, when a substep is over. */
void sbri_touches_go_on(const sbri_island_tick *t, const sbri_body *body, float step_s);

/* What the body's places push against, when a tick is over. */
void sbri_touches_tell(const sbri_island_tick *t, const sbri_body *body, sbri_touching *touching);

/* Around a correction of places that changes velocities by as much per second (solvers/volume_keep.h): lifts
 * what that has pressed in, as sbri_contact_bound does for points. */
void sbri_touches_remember(const sbri_island_tick *t, const sbri_body *body);
void sbri_touches_bound(const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule);

#endif
