/* What a tick of rigid parts works with: scratch, laid out in one block. */
#ifndef SBRI_RIGID_WORK_H
#define SBRI_RIGID_WORK_H

#include "rigid/joint_frames.h"
#include "rigid/rigid_external_bodies.h"
#include "rigid/rigid_state.h"

/* A step may be halved so often, less one; and a tick has no more steps, unless the model asks for them. */
enum { SBRI_RIGID_HALVINGS = 8, SBRI_RIGID_MAX_SUBSTEPS = 64 };
/* Greatest angular frequency times step, by what pulled in the tick before: 2 is where a leapfrog ends. */
#define SBRI_RIGID_MAX_SWING 0.8f

/* How a body moves in a substep, if nothing more acts on it. */
typedef struct sbri_part_motion {
  sbr_transform from, to;      /* poses at its begin and end */
  sbf_vec3 fine_from, fine_to; /* what their places have beyond rounded numbers */
  sbf_vec3 velocity, turn;     /* m/s; rad/s, mean of the substep */
  int32_t node;                /* -1: it is not simulated */
} sbri_part_motion;

/* A unilateral row and its friction along the step from one pass to the next: at a fraction s of it the force
 * is stiff (into - s way), at least 0, and friction is P - s G, cut to its bound.
 */
typedef struct sbri_contact_search {
  double stiff, into, distance;
  double bound;                           /* N s; 0: there is no friction */
  double pull_pull, pull_grip, grip_grip; /* P.P, P.G, G.G */
  double inverse_mass;                    /* 1 / kg: the step over G */
} sbri_contact_search;

typedef struct sbri_rigid_solving {
  sbri_rigid_system system;
  sbri_part_motion *motions;   /* (body_count + 1); the last is the anchor, which does not move */
  sbr_transform *begins;       /* (body_count) poses when the tick began */
  sbf_vec3 *pulls;             /* (joint_count) N on body b: mean of the last tick, then of the last step */
  sbri_rigid_body_state *kept; /* (SBRI_RIGID_HALVINGS x body_count) before steps that may be taken again */
  sbri_ball *balls;            /* (joint_count) likewise: of the edges */
  sbri_ball_pair *pairs;       /* (joint_count) of those of the tree */
  sbri_joint_frames *joint_frames; /* (joint_count) of the edges */
  sbri_rigid_contact *contacts;    /* (rigid_contact_count) */
  uint32_t rigid_contact_count, max_contacts;
  sbri_rigid_external_body *external_bodies; /* (external_body_count) of the host's bodies that have a mass */
  uint32_t external_body_count, external_body_capacity;
  sbri_contact_search *pushes; /* (max_contacts + row_count) of the line search */
  uint32_t push_count;
  float swings;      /* (rad/s)^2, by what pulled in the tick before: sbri_rigid_swings */
  float last_step_s; /* length of the step before; 0: there is none */
  float kick_s;      /* for how long forces act in the step: from the middle of the one before to its own */
  uint32_t *order, *roots; /* of the tree's making */
  sbri_row *rows;          /* (row_count), as all that follow: the edges' share them out by joint */
  uint16_t *actives;
  double *y, *w, *t, *rhs, *g;
} sbri_rigid_solving;

/* ---- rigid_step.c ---- */

/* A tick in three parts, so that several characters can be stepped together: the beginning, which chooses the
 * number of substeps and fills `work`; a step over a fraction of the tick; the end. */
void sbri_rigid_begin(sbri_rigid_tick *tick, sbri_rigid_solving *work);
void sbri_rigid_advance(const sbri_rigid_tick *tick, sbri_rigid_solving *work, float from, float to);
void sbri_rigid_end(const sbri_rigid_tick *tick, sbri_rigid_solving *work);

/* ---- rigid_pace.c ---- */

/* Square of the angular frequency at which the joints' pulls let some body swing, (rad/s)^2. */
float sbri_rigid_swings(const sbri_rigid_tick *tick, const sbri_rigid_solving *work);
/* Whether what pulls in a step, and did not before, lets some body swing too fast for it, as a light link of
 * a chain that is suddenly taut: a leapfrog gains by that without bound. */
bool sbri_rigid_pulls_too_fast(const sbri_rigid_tick *tick, sbri_rigid_solving *work, float step_s);
/* How many steps the coming tick takes; and whether the bodies have but moved slowly in the last. */
uint32_t sbri_rigid_pace(const sbri_rigid_tick *tick, sbri_rigid_solving *work);
bool sbri_rigid_is_slow(const sbri_rigid_tick *tick, const sbri_rigid_solving *work);

/* Whether joints reckon with the arcs that bodies turn along as they go: in flight, and where something is
 * near which stops them within a step. What swings by what pulls at it, as a whip, goes by the tangents, by
 * which its steps are judged. */
static inline bool sbri_rigid_foresees(const sbri_rigid_tick *tick, const sbri_rigid_solving *work) {
  return tick->drive->flies || work->rigid_contact_count > 0;
}

/* ---- rigid_passes.c: the nodes' x, the rows and touches that act, for a step that has been made. ---- */
void sbri_rigid_iterate(const sbri_rigid_tick *tick, sbri_rigid_solving *work, float step_s);
/* The system with what acts, factored; its right-hand sides so far are pushes and touches. */
void sbri_rigid_factor(const sbri_rigid_tick *tick, sbri_rigid_solving *work);

/* ---- rigid_tree.c: the system's graph of simulated bodies and unbroken joints. ---- */
void sbri_rigid_tree_make(const sbri_rigid_tick *tick, sbri_rigid_solving *work);

/* ---- joint_rows.c, joint_check.c, joint_ends.c ---- */

/* The rows of an edge for a substep, from the bodies' motions so far. */
void sbri_joint_rows_make(const sbri_rigid_tick *tick, sbri_rigid_solving *work, uint32_t edge, float step_s);
/* Lists the active rows, with their right-hand sides. */
void sbri_joint_rows_set_targets(sbri_edge *edge);
/* Takes from the nodes' x how the limits' rates change. */
void sbri_joint_rows_move(sbri_rigid_solving *work, const sbri_rigid_model *model, float step_s);
/* Whether limits push in the last pass's system just where they would at what it came to. */
bool sbri_joint_rows_agree(const sbri_rigid_solving *work);
/* And back by that fraction of it. */
void sbri_joint_rows_hold_back(sbri_rigid_solving *work, float fraction);
/* Takes rows out that have pulled, lets those in that are broken, and gives drives that would exceed it their
 * maximum; whether anything has changed, which where it is coarse dry friction does not count for. */
bool sbri_joint_rows_check(
    const sbri_rigid_tick *tick, sbri_rigid_solving *work, sbri_edge *edge, float step_s);
/* Right-hand sides for what is still off at the substep's end; returns by how much the worst is, m or rad. */
float sbri_joint_rows_correct(
    const sbri_rigid_tick *tick, sbri_rigid_solving *work, uint32_t edge, float step_s);
/* And for being thrown back by limits that were run into; whether any is. */
bool sbri_joint_rows_bounce(const sbri_rigid_solving *work, sbri_edge *edge, const sbri_rigid_model *model);

/* ---- rigid_shape_contacts.c ---- */

/* Adds places that may touch shapes of the host within the tick. */
void sbri_rigid_shape_contacts_find(const sbri_rigid_tick *tick, sbri_rigid_solving *work);

/* ---- rigid_stair_contacts.c ---- */

/* Adds places of a body that may touch stairs of the ground; false where its vertices are to be looked at. */
bool sbri_rigid_stair_contacts_find(
    const sbri_rigid_tick *tick, sbri_rigid_solving *work, uint32_t body, int32_t node);

/* ---- stored_contacts.c ---- */

/* Gives the touches that were there in the tick before what they did then; and keeps that. */
void sbri_stored_contacts_apply(const sbri_rigid_tick *tick, sbri_rigid_solving *work);
void sbri_stored_contacts_save(const sbri_rigid_tick *tick, const sbri_rigid_solving *work);

/* ---- rigid_contacts.c ---- */

/* Lists the vertices that may touch the ground within the tick, with the ground's planes. */
void sbri_rigid_contacts_find(const sbri_rigid_tick *tick, sbri_rigid_solving *work);
/* Their places, and what they want, for a substep that begins so long after the tick. */
void sbri_rigid_contacts_linearise(
    const sbri_rigid_tick *tick, sbri_rigid_solving *work, float since_s, float step_s);
/* Adds what acts to the nodes' d and b. */
void sbri_rigid_contacts_add(sbri_rigid_solving *work);
/* Adds to what each has given what a solve beyond the passes, by the nodes' x, makes it give. */
void sbri_rigid_contacts_apply_impulse(sbri_rigid_solving *work);
/* Notes what the bodies touch, when a substep is over, and what the next one begins with. */
void sbri_rigid_contacts_report(const sbri_rigid_tick *tick, sbri_rigid_solving *work);
/* To the nodes' b what throws back those that have struck the ground, at the substep's end; whether any is.
 */
bool sbri_rigid_contacts_bounce(sbri_rigid_solving *work);
/* Takes from the nodes' x how the places' velocities change. */
void sbri_rigid_contacts_update_velocities(sbri_rigid_solving *work);
/* Lists the contacts and limits that may be active somewhere between the pass before and the last. */
void sbri_rigid_contacts_find_changes(sbri_rigid_solving *work);
/* By how much what they do at the velocities that the last pass came to is not what they did in its system:
 * the energy, J, by which that would move each body alone; 0 where it makes no difference. */
float sbri_rigid_contacts_error(const sbri_rigid_solving *work);
/* What they give is what the last pass had them give, where passes have ended before both are the same. */
void sbri_rigid_contacts_take_solution(sbri_rigid_solving *work);
/* Who presses, and who slides, by the last pass. */
void sbri_rigid_contacts_check(sbri_rigid_solving *work);
/* Bounds of friction from what presses by the last pass; whether that makes a difference. */
bool sbri_rigid_contacts_bound(sbri_rigid_solving *work);

/* ---- rigid_search.c ---- */

/* The best fraction of the step from the pass before to the last; 1 where the whole step is not too long.
 */
float sbri_rigid_search(const sbri_rigid_tick *tick, sbri_rigid_solving *work, float step_s);

/* The motion of one side of an edge. */
static inline const sbri_part_motion *sbri_side_motion(
    const sbri_rigid_solving *work, const sbri_rigid_model *model, const sbri_rigid_joint *joint, int side) {
  int32_t body = joint->bodies[side];
  return &work->motions[body >= 0 ? (uint32_t)body : model->body_count];
}

#endif
