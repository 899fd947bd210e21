/* What a soft body's levels are worth: for `info`, the lines that a build prints and the conversion's report.
 */
#ifndef LEVEL_DESCRIPTION_H
#define LEVEL_DESCRIPTION_H

#include <jansson.h>

#include "sbfmt/asset.h"

/* A list of {name, model, tetrahedra, springs, error, cost, calibration}; error in m and cost in visits of
 * elements a control tick, null where not measured; calibration {reference_elements, factor, surface_factor,
 * residual, period_error, load_errors, twist_errors} or null. By counts and numbers alone, so that no list
 * need have been read. */
json_t *level_description(const sbf_soft_body *body);

/* "lattice 2: 240 tetrahedra, within 0.0012 m, ..." into `text`, cut off at `size`. */
void level_description_print(const json_t *level, char *text, size_t size);

#endif
