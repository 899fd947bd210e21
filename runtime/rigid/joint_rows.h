/* What rows are made of, judged by and corrected by alike. */
#ifndef SBRI_JOINT_ROWS_H
#define SBRI_JOINT_ROWS_H

#include "rigid/rigid_work.h"

/* What is off when a step begins, as of a character that is placed so, is put right no faster than this, in
 * m/s and rad/s. */
#define SBRI_CORRECTION_M_S 1.0f
#define SBRI_CORRECTION_RAD_S 4.0f

/* Tolerances to either side: of lengths, and of angles. */
static inline float sbri_clamped_rate(sbf_joint_axis axis, float rate, float max_m_s, float max_rad_s) {
  float max = sbri_axis_turns(axis) ? max_rad_s : max_m_s;
  return sbri_clamp(rate, -max, max);
}

/* How fast the row's coordinate changes as the bodies move. */
float sbri_row_speed(const sbri_rigid_solving *work, const sbri_rigid_model *model,
    const sbri_rigid_joint *joint, const sbri_row *row);
/* Of the angles that mean the same twist the one least outside of the range. */
float sbri_nearest_turn(float value, float low, float high);
/* The bound that the coordinate comes nearer to at that speed. */
void sbri_limit_choose_side(sbri_row *row, float speed, float step_s);
/* Whether it pushes then; a spring acts beyond its bound only. */
bool sbri_limit_acts(const sbri_row *row, float speed, float step_s);
/* By how much swing and twist change at most in a step where the bodies turn so against each other; of turns
 * that are no greater than those of which sbri_row has `clear`. */
float sbri_turn_reach(float turn_rad_s, float step_s);
/* A limit's row: its Jacobian, its side and its compliance. */
void sbri_limit_ready(const sbri_rigid_solving *work, const sbri_rigid_model *model, const sbri_edge *edge,
    sbri_joint_frames *joint_frames, sbri_row *row, float step_s);

#endif
