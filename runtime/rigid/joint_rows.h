/* Shared parts of making, checking and correcting constraint rows. */
#ifndef SBRI_JOINT_ROWS_H
#define SBRI_JOINT_ROWS_H

#include "rigid/rigid_work.h"

/* Maximum rates at which an error at the beginning of a step, such as after placement, is corrected, in m/s
 * and rad/s. */
#define SBRI_CORRECTION_M_S 1.0f
#define SBRI_CORRECTION_RAD_S 4.0f

/* Clamps a rate: of a length, or of an angle. */
static inline float sbri_clamped_rate(sbf_joint_axis axis, float rate, float max_m_s, float max_rad_s) {
  float max = sbri_axis_is_angular(axis) ? max_rad_s : max_m_s;
  return sbri_clamp(rate, -max, max);
}

/* Rate of the row's coordinate at the bodies' present velocities. */
float sbri_row_speed(const sbri_rigid_solving *work, const sbri_rigid_model *model,
    const sbri_rigid_joint *joint, const sbri_row *row);
/* The equivalent twist angle that is least outside the range. */
float sbri_nearest_twist(float value, float low, float high);
/* Selects the bound that the coordinate approaches at that speed. */
void sbri_limit_choose_side(sbri_row *row, float speed, float step_s);
/* Whether the limit acts at that speed; a spring acts beyond its bound only. */
bool sbri_limit_acts(const sbri_row *row, float speed, float step_s);
/* Maximum change of swing and twist in a step at this relative angular speed; valid within the range of
 * sbri_row.clear. */
float sbri_max_rotation_change(float turn_rad_s, float step_s);
/* Initialises a limit's row: its Jacobian, its side and its compliance. */
void sbri_limit_ready(const sbri_rigid_solving *work, const sbri_rigid_model *model, const sbri_edge *edge,
    sbri_joint_frames *joint_frames, sbri_row *row, float step_s);

#endif
