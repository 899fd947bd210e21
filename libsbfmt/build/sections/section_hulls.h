/* The rigid bodies that sections stand for. */
#ifndef SBFI_SECTION_HULLS_H
#define SBFI_SECTION_HULLS_H

#include "base/diagnostic.h"
#include "base/progress.h"
#include "model/unique_id.h"
#include "sbfmt/asset.h"

/* Gives each section a convex hull that moves with its bone: the bone's authored rigid bodies without a hull
 * get that of all its sections, marked hull_derived; where the bone has no rigid body, a kinematic one is
 * made of the section's density, with mass and inertia of the hull and the id "hull_" and the body's. `asset`
 * is under construction and holds source parts only; its rigid bodies are replaced by a list that begins with
 * the authored ones. Flat sections are reported. `*made` counts hulls. False where memory runs out or
 * `progress` ends it. */
bool sbfi_section_hulls_make(sbf_asset *asset, int32_t derivation, sbfi_ids *ids, sbfi_reporter *reporter,
    uint32_t *made, sbfi_progress progress, sbfi_arena *scratch);

#endif
