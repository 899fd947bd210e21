/* A simulated motion stored frame by frame, for the formats that can contain a motion. */
#ifndef MOTION_BAKE_H
#define MOTION_BAKE_H

#include "sbfmt/export.h"
#include "session.h"

/* Whether the call requests a motion: --seconds, a script or a recording. */
bool motion_asked(const cli_call *call);

/* Simulates with the options in SESSION_OPTIONS, at 30 frames per second or --fps, and stores every frame
 * including the initial one. SBF_OK, else the exit status with a message printed. Free with motion_free. */
int motion_bake(cli_call *call, sbf_export_motion *motion);
void motion_free(sbf_export_motion *motion);

#endif
