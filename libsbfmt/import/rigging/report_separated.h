#ifndef SBFI_REPORT_SEPARATED_H
#define SBFI_REPORT_SEPARATED_H

#include "import/rigging/rigging.h"

/* RIG_OBJECT_APART for each object with pieces that lie far from the rig: another character, or what lies
 * about. Bones move all points in some way. `moved` is the input in asset space; `by_surface`: its shape is
 * that of the rig's meshes, which are measured to, else to the bones. False where memory runs out. */
bool sbfi_report_separated(const sbfi_rigging *r, const sbfi_scene_surface *moved, bool by_surface);

#endif
