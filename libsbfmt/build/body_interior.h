/* Default interior of a body, and whether its moduli are calibrated. */
#ifndef SBFI_BODY_INTERIOR_H
#define SBFI_BODY_INTERIOR_H

#include "sbfmt/build.h"

/* Automatic: for a section that the build has cut (section_level.h). */
sbf_build_interior sbfi_body_interior(const sbf_build_options *options, const sbf_soft_body *body);

/* Lattices, and springs by centroid, whose few springs have an arbitrary stiffness. */
bool sbfi_body_is_calibrated(const sbf_soft_body *body, sbf_build_interior interior);

#endif
