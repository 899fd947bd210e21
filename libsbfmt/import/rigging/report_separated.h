#ifndef SBFI_REPORT_SEPARATED_H
#define SBFI_REPORT_SEPARATED_H

#include "import/rigging/rigging.h"

/* Reports RIG_OBJECT_APART for each object with pieces far from the rig, such as another character or
 * scenery, because every point will follow a bone. `moved` is the input in asset space. `by_surface`: the
 * input resembles the rig's meshes, so distances are measured to them, otherwise to the bones. False if
 * memory runs out. */
bool sbfi_report_separated(const sbfi_rigging *r, const sbfi_scene_surface *moved, bool by_surface);

#endif
