/* Rigid bodies of sections. */
#ifndef SBFI_SECTION_HULLS_H
#define SBFI_SECTION_HULLS_H

#include "base/diagnostic.h"
#include "base/progress.h"
#include "model/unique_id.h"
#include "sbfmt/asset.h"

/* Gives each section a convex hull that moves with its bone. A bone's authored rigid bodies without a hull
 * get the hull of all its sections, marked hull_derived. A bone without a rigid body gets a kinematic one
 * with the section's density, mass and inertia of the hull, and the body's id after "hull_". `asset` is under
 * construction and has only source parts; its list of rigid bodies is replaced by one that starts with the
 * authored ones. Reports flat sections. Adds the number of hulls to `*made`. False if memory runs out or
 * `progress` cancels. */
bool sbfi_section_hulls_make(sbf_asset *asset, int32_t derivation, sbfi_ids *ids, sbfi_reporter *reporter,
    uint32_t *made, sbfi_progress progress, sbfi_arena *scratch);

#endif
