/* Describes a soft body's levels: for `info`, the lines that a build prints and the conversion's report. */
#ifndef LEVEL_DESCRIPTION_H
#define LEVEL_DESCRIPTION_H

#include <jansson.h>

#include "sbfmt/asset.h"

/* A list of {name, model, tetrahedra, springs, error, cost, calibration}; error in m and cost in element
 * visits per control tick, null if not measured; calibration {reference_elements, factor, surface_factor,
 * residual, period_error, load_errors, twist_errors} or null. Uses only counts and numbers, so lists need
 * not be loaded. */
json_t *level_description(const sbf_soft_body *body);

/* "lattice 2: 240 tetrahedra, within 0.0012 m, ..." into `text`, truncated at `size`. */
void level_description_print(const json_t *level, char *text, size_t size);

#endif
