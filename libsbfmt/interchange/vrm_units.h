/* Numbers of VRM's spring bones in SI units.
 *
 * VRM's numbers act once a frame: the end of a bone keeps 1 - dragForce of its last displacement and moves by
 * (stiffness x direction + gravityPower x gravityDir) x the frame's time. Avatars are made for frames of
 * 1/60 s. In those, a velocity that decays at the rate drag, v' = a - drag v, does the same with
 *
 *   drag = -60 ln(1 - dragForce),   a = (stiffness x direction + gravityPower x gravityDir) drag / dragForce
 *
 * and a = 60 (...) for dragForce 0. At F frames a second a VRM viewer has F in place of 60: its springs are
 * weaker and its drag is smaller the slower it draws. */
#ifndef SBFI_VRM_UNITS_H
#define SBFI_VRM_UNITS_H

/* Rate in 1/s for a dragForce from 0 to 1, and the inverse. A dragForce of 1 keeps nothing: its rate would be
 * infinite, and is that of 0.999999. */
double sbfi_vrm_drag(double drag_force);
double sbfi_vrm_drag_force(double drag);

/* Acceleration, m/s^2, for a stiffness or gravityPower of 1 beside that drag (1/s). */
double sbfi_vrm_acceleration(double drag);

#endif
