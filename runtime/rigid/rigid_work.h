/* What a tick of rigid parts works with: scratch, laid out in one block. */
#ifndef SBRI_RIGID_WORK_H
#define SBRI_RIGID_WORK_H

#include "rigid/joint_place.h"
#include "rigid/rigid_state.h"

/* A step may be halved so often, less one. */
enum { SBRI_RIGID_HALVINGS = 4 };

/* How a body moves in a substep, if nothing more acts on it. */
typedef struct sbri_part_motion {
  sbr_transform from, to;      /* poses at its begin and end */
  sbf_vec3 fine_from, fine_to; /* what their places have beyond rounded numbers */
  sbf_vec3 velocity, turn;     /* m/s; rad/s, mean of the substep */
  int32_t node;                /* -1: it does not give way */
} sbri_part_motion;

typedef struct sbri_rigid_solving {
  sbri_rigid_system system;
  sbri_part_motion *motions;   /* (body_count + 1); the last is the anchor, which stands */
  sbr_transform *begins;       /* (body_count) poses when the tick began */
  sbf_vec3 *pulls;             /* (joint_count) N on body b, mean of the last tick */
  sbri_rigid_body_state *kept; /* (SBRI_RIGID_HALVINGS x body_count) before steps that may be taken again */
  sbri_joint_place *places;    /* (joint_count) of the edges */
  sbri_ground_touch *touches;  /* (touch_count) */
  uint32_t touch_count, touch_capacity;
  float last_step_s;       /* length of the step before; 0: there is none */
  uint32_t *order, *roots; /* of the tree's making */
  sbri_row *rows;          /* (row_count), as all that follow: the edges' share them out by joint */
  uint16_t *actives;
  double *y, *w, *t, *rhs, *g;
} sbri_rigid_solving;

/* ---- rigid_step.c ---- */

/* A tick of all that is not broken, in parts, so that characters may step along with each other: what comes
 * first, which finds out how many steps the tick needs (substeps) and fills `work`; a step over that share of
 * the tick; and what comes last. */
void sbri_rigid_begin(sbri_rigid_tick *tick, sbri_rigid_solving *work);
void sbri_rigid_advance(const sbri_rigid_tick *tick, sbri_rigid_solving *work, float from, float to);
void sbri_rigid_end(const sbri_rigid_tick *tick, sbri_rigid_solving *work);

/* ---- rigid_tree.c: the system's graph, of the bodies that give way and the joints that are whole. ---- */
void sbri_rigid_tree_make(const sbri_rigid_tick *tick, sbri_rigid_solving *work);

/* ---- joint_rows.c ---- */

/* The rows of an edge for a substep, from the bodies' motions so far. */
void sbri_joint_rows_make(const sbri_rigid_tick *tick, sbri_rigid_solving *work, uint32_t edge, float step_s);
/* Right-hand sides of the active rows, from the bodies' motions. */
void sbri_joint_rows_aim(const sbri_rigid_solving *work, sbri_edge *edge, const sbri_rigid_model *model);
/* Takes rows out that have pulled, lets those in that are broken, and gives drives that would exceed it their
 * maximum; whether anything has changed. */
bool sbri_joint_rows_judge(
    sbri_rigid_solving *work, sbri_edge *edge, const sbri_rigid_model *model, float step_s);
/* Right-hand sides for what is still off at the substep's end; returns by how much the worst is, m or rad. */
float sbri_joint_rows_correct(
    const sbri_rigid_tick *tick, sbri_rigid_solving *work, uint32_t edge, float step_s);
/* And for being thrown back by limits that were run into; whether any is. */
bool sbri_joint_rows_bounce(const sbri_rigid_solving *work, sbri_edge *edge, const sbri_rigid_model *model);

/* ---- shape_touches.c ---- */

/* Adds places that may touch shapes of the host within the tick. */
void sbri_shape_touches_find(const sbri_rigid_tick *tick, sbri_rigid_solving *work);

/* ---- ground_touch.c ---- */

/* Lists the vertices that may touch the ground within the tick, with the ground's planes. */
void sbri_ground_touches_find(const sbri_rigid_tick *tick, sbri_rigid_solving *work);
/* Their places, and what they want, for a substep that begins so long after the tick. */
void sbri_ground_touches_make(
    const sbri_rigid_tick *tick, sbri_rigid_solving *work, float since_s, float step_s);
/* Adds what acts to the nodes' d and b. */
void sbri_ground_touches_add(sbri_rigid_solving *work);
/* Notes what the bodies touch, when a substep is over. */
void sbri_ground_touches_tell(const sbri_rigid_tick *tick, const sbri_rigid_solving *work);
/* To the nodes' b what throws back those that have struck the ground, at the substep's end; whether any is.
 */
bool sbri_ground_touches_bounce(sbri_rigid_solving *work);
/* From the nodes' x: who is in contact, and who slides; whether that has changed. From stage 1 on
 * friction settles and only what lies on the ground comes in; in stage 2 touches that pull go out, nothing
 * else. */
bool sbri_ground_touches_judge(sbri_rigid_solving *work, float step_s, int stage);

/* The motion of one side of an edge. */
static inline const sbri_part_motion *sbri_side_motion(
    const sbri_rigid_solving *work, const sbri_rigid_model *model, const sbri_rigid_joint *joint, int side) {
  int32_t body = joint->bodies[side];
  return &work->motions[body >= 0 ? (uint32_t)body : model->body_count];
}

#endif
