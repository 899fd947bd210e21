/* What a body is filled with, where it is left to the build, and whether that is calibrated. */
#ifndef SBFI_BODY_INTERIOR_H
#define SBFI_BODY_INTERIOR_H

#include "sbfmt/build.h"

/* Automatic: of a section that the build cut (section_level.h). */
sbf_build_interior sbfi_body_interior(const sbf_build_options *options, const sbf_soft_body *body);

/* Lattices and springs by centroid, which hold as much of a section as their few springs happen to. */
bool sbfi_body_is_calibrated(const sbf_soft_body *body, sbf_build_interior interior);

#endif
