/* Work memory of a tick of rigid parts, in one block. */
#ifndef SBRI_RIGID_WORK_H
#define SBRI_RIGID_WORK_H

#include "rigid/joint_frames.h"
#include "rigid/rigid_external_bodies.h"
#include "rigid/rigid_state.h"

/* Number of times that a step may be halved, plus one; and the maximum number of steps per tick unless the
 * model sets more. */
enum { SBRI_RIGID_HALVINGS = 8, SBRI_RIGID_MAX_SUBSTEPS = 64 };
/* Maximum angular frequency times step size, by the joint forces of the previous tick: the stability limit of
 * a leapfrog is 2. */
#define SBRI_RIGID_MAX_SWING 0.8f

/* Motion of a body in a substep without further forces. */
typedef struct sbri_part_motion {
  sbr_transform from, to;      /* poses at its begin and end */
  sbf_vec3 fine_from, fine_to; /* low-order parts of their positions */
  sbf_vec3 velocity, turn;     /* m/s; rad/s, mean of the substep */
  int32_t node;                /* -1: it is not simulated */
} sbri_part_motion;

/* A unilateral row and its friction along the step from one iteration to the next. At a fraction s of the
 * step the force is max(0, stiff (into - s distance)), and friction is P - s G, clamped to its bound.
 */
typedef struct sbri_contact_search {
  double stiff, into, distance;
  double bound;                                         /* N s; 0: there is no friction */
  double start_square, start_dot_change, change_square; /* P.P, P.G, G.G */
  double inverse_mass;                                  /* 1 / kg: the step over G */
} sbri_contact_search;

typedef struct sbri_rigid_solving {
  sbri_rigid_system system;
  sbri_part_motion *motions; /* (body_count + 1); the last is the anchor, which does not move */
  sbr_transform *begins;     /* (body_count) poses when the tick began */
  sbf_vec3 *
      joint_forces; /* (joint_count) joint force on body b, N: mean of the last tick, then of the last step */
  sbri_rigid_body_state
      *kept;             /* (SBRI_RIGID_HALVINGS x body_count) states before steps that may be repeated */
  sbri_ball *balls;      /* (joint_count) of the edges */
  sbri_ball_pair *pairs; /* (joint_count) of the edges of the tree */
  sbri_joint_frames *joint_frames; /* (joint_count) of the edges */
  struct {
    sbri_rigid_contact *at;
    uint32_t count, capacity;
  } contact_list;
  struct {
    sbri_rigid_external_body *at;
    uint32_t count, capacity;
  } external_list;             /* of the host, with a mass */
  sbri_contact_search *pushes; /* (max_contacts + row_count) of the line search */
  uint32_t push_count;
  float swings;      /* (rad/s)^2, from the joint forces of the previous tick: sbri_rigid_swings */
  float last_step_s; /* length of the previous step; 0: none */
  float kick_s;      /* time for which forces act in a step: from the middle of the previous one to its own */
  uint32_t *order, *roots; /* scratch of building the tree */
  sbri_row *rows;          /* (row_count), as the arrays below; divided among the edges by joint */
  uint16_t *actives;
  struct {
    double *y, *w, *t, *rhs, *g;
  } vectors; /* of the linear system */
} sbri_rigid_solving;

/* ---- rigid_step.c ---- */

/* A tick in three parts, so that several characters can be stepped together: the beginning, which selects the
 * number of substeps and fills `work`; a step over a fraction of the tick; the end. */
void sbri_rigid_begin(sbri_rigid_tick *tick, sbri_rigid_solving *work);
void sbri_rigid_advance(const sbri_rigid_tick *tick, sbri_rigid_solving *work, float from, float to);
void sbri_rigid_end(const sbri_rigid_tick *tick, sbri_rigid_solving *work);

/* ---- rigid_step_count.c ---- */

/* Square of the maximum angular frequency of a body by the joints' forces, (rad/s)^2. */
float sbri_rigid_swings(const sbri_rigid_tick *tick, const sbri_rigid_solving *work);
/* Whether new joint forces make a body oscillate too fast for the step size, such as a light link of a chain
 * that becomes taut. A leapfrog would gain energy without bound. */
bool sbri_rigid_oscillates_too_fast(const sbri_rigid_tick *tick, sbri_rigid_solving *work, float step_s);
/* Number of steps in the coming tick; and whether all bodies moved slowly in the last one. */
uint32_t sbri_rigid_step_count(const sbri_rigid_tick *tick, sbri_rigid_solving *work);
bool sbri_rigid_is_slow(const sbri_rigid_tick *tick, const sbri_rigid_solving *work);

/* Whether joints predict the arcs of rotating bodies: in flight, and near objects that may stop them within a
 * step. Otherwise, as for a whip under tension, they use tangents, and the error controls the step size. */
static inline bool sbri_rigid_predicts_arcs(const sbri_rigid_tick *tick, const sbri_rigid_solving *work) {
  return tick->drive->is_free || work->contact_list.count > 0;
}

/* ---- rigid_passes.c: solves for the nodes' x and the active rows and contacts of a step. ---- */
void sbri_rigid_iterate(const sbri_rigid_tick *tick, sbri_rigid_solving *work, float step_s);
/* Factors the system with the active rows and contacts; the right-hand sides contain known impulses and
 * contacts. */
void sbri_rigid_factor(const sbri_rigid_tick *tick, sbri_rigid_solving *work);

/* ---- rigid_tree.c: the graph of simulated bodies and unbroken joints. ---- */
void sbri_rigid_tree_make(const sbri_rigid_tick *tick, sbri_rigid_solving *work);

/* ---- joint_rows.c, joint_check.c, joint_ends.c ---- */

/* Makes the rows of an edge for a substep, from the bodies' predicted motions. */
void sbri_joint_rows_make(const sbri_rigid_tick *tick, sbri_rigid_solving *work, uint32_t edge, float step_s);
/* Lists the active rows, with their right-hand sides. */
void sbri_joint_rows_set_targets(sbri_edge *edge);
/* Computes the rate changes of the limits from the nodes' x. */
void sbri_joint_rows_move(sbri_rigid_solving *work, const sbri_rigid_model *model, float step_s);
/* Whether the active limits of the last iteration agree with its result. */
bool sbri_joint_rows_agree(const sbri_rigid_solving *work);
/* Reduces the changes of the last iteration to that fraction. */
void sbri_joint_rows_scale_back(sbri_rigid_solving *work, float fraction);
/* Removes rows that pull, adds violated ones, and gives drives beyond their maximum that maximum. Returns
 * whether anything has changed; with `coarse`, dry friction does not count. */
bool sbri_joint_rows_check(
    const sbri_rigid_tick *tick, sbri_rigid_solving *work, sbri_edge *edge, float step_s);
/* Sets right-hand sides for the errors at the end of the substep; returns the largest error, m or rad. */
float sbri_joint_rows_correct(
    const sbri_rigid_tick *tick, sbri_rigid_solving *work, uint32_t edge, float step_s);
/* Sets right-hand sides for restitution at limits; returns whether there is any. */
bool sbri_joint_rows_bounce(const sbri_rigid_solving *work, sbri_edge *edge, const sbri_rigid_model *model);

/* ---- rigid_shape_contacts.c ---- */

/* Adds possible contacts with host shapes within the tick. */
void sbri_rigid_shape_contacts_find(const sbri_rigid_tick *tick, sbri_rigid_solving *work);

/* ---- rigid_stair_contacts.c ---- */

/* Adds possible contacts of a body with built-in stairs; returns false if its vertices must be checked
 * instead. */
bool sbri_rigid_stair_contacts_find(
    const sbri_rigid_tick *tick, sbri_rigid_solving *work, uint32_t body, int32_t node);

/* ---- stored_contacts.c ---- */

/* Restores the impulses of contacts of the previous tick; and stores the present ones. */
void sbri_stored_contacts_apply(const sbri_rigid_tick *tick, sbri_rigid_solving *work);
void sbri_stored_contacts_save(const sbri_rigid_tick *tick, const sbri_rigid_solving *work);

/* ---- rigid_contacts.c ---- */

/* Lists vertices that may touch the ground within the tick, with the ground's planes. */
void sbri_rigid_contacts_find(const sbri_rigid_tick *tick, sbri_rigid_solving *work);
/* Prepares the contacts for a substep that begins `since_s` after the tick. */
void sbri_rigid_contacts_linearise(
    const sbri_rigid_tick *tick, sbri_rigid_solving *work, float since_s, float step_s);
/* Adds active contacts to the nodes' d and b. */
void sbri_rigid_contacts_add(sbri_rigid_solving *work);
/* After a solve beyond the iterations: adds its changes by the nodes' x to the contact impulses. */
void sbri_rigid_contacts_apply_impulse(sbri_rigid_solving *work);
/* At the end of a substep: reports contacts, and stores the initial values of the next substep. */
void sbri_rigid_contacts_report(const sbri_rigid_tick *tick, sbri_rigid_solving *work);
/* Adds restitution at the end of a substep to the nodes' b; returns whether there is any. */
bool sbri_rigid_contacts_bounce(sbri_rigid_solving *work);
/* Computes the velocity changes of the contact points from the nodes' x. */
void sbri_rigid_contacts_update_velocities(sbri_rigid_solving *work);
/* Lists the contacts and limits that may be active somewhere between the previous iteration and the last. */
void sbri_rigid_contacts_find_changes(sbri_rigid_solving *work);
/* Difference between contact impulses at the velocities of the last iteration and their linearisation, as the
 * energy, J, by which it would move each body alone; 0 if negligible. */
float sbri_rigid_contacts_error(const sbri_rigid_solving *work);
/* Keeps the impulses of the last iteration if iterations end before they are consistent. */
void sbri_rigid_contacts_store_solution(sbri_rigid_solving *work);
/* Updates active and sliding contacts after an iteration. */
void sbri_rigid_contacts_check(sbri_rigid_solving *work);
/* Updates the bounds of friction from the normal forces of the last iteration; returns whether that changes
 * the result. */
bool sbri_rigid_contacts_bound(sbri_rigid_solving *work);

/* ---- rigid_search.c ---- */

/* Best fraction of the step from the previous iteration to the last; 1 if the whole step is not too long. */
float sbri_rigid_search(const sbri_rigid_tick *tick, sbri_rigid_solving *work, float step_s);

/* The motion of one side of an edge. */
static inline const sbri_part_motion *sbri_side_motion(
    const sbri_rigid_solving *work, const sbri_rigid_model *model, const sbri_rigid_joint *joint, int side) {
  int32_t body = joint->bodies[side];
  return &work->motions[body >= 0 ? (uint32_t)body : model->body_count];
}

#endif
