/* A simulated motion, held frame by frame, for the forms that a motion is written to. */
#ifndef MOTION_BAKE_H
#define MOTION_BAKE_H

#include "sbfmt/export.h"
#include "session.h"

/* Whether the call asks for a motion: --seconds, a script or a recording. */
bool motion_asked(const cli_call *call);

/* Simulates as SESSION_OPTIONS say, 30 frames a second unless --fps says otherwise, and keeps every frame
 * with the first. SBF_OK, else the exit status with a message printed. Free with motion_free. */
int motion_bake(cli_call *call, sbf_export_motion *motion);
void motion_free(sbf_export_motion *motion);

#endif
