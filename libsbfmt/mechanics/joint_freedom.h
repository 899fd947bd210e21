/* Which coordinates of a joint (spec 8.3) its kind locks at 0, and which it leaves free. */
#ifndef SBFI_JOINT_FREEDOM_H
#define SBFI_JOINT_FREEDOM_H

#include "sbfmt/model.h"

/* Bits 1 << sbf_joint_axis of the six coordinates linear_x .. swing_z that are locked at 0. */
unsigned sbfi_joint_is_locked(sbf_joint_kind kind);

/* Whether the kind leaves the coordinate free, possibly through another: `swing` by swing_y, `distance` by
 * any linear one. */
bool sbfi_joint_is_free(sbf_joint_kind kind, sbf_joint_axis axis);

#endif
