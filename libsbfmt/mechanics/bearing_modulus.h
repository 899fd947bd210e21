/* How stiff a thing has to be to stand. */
#ifndef SBFI_BEARING_MODULUS_H
#define SBFI_BEARING_MODULUS_H

#include "sbfmt/model.h"

/* The attributes' Young's modulus, or as much as it takes for a column as high as the surface is long to
 * strain by a twentieth at its foot under the earth's gravity, whatever the file's: source parts hang on it.
 * Rounded up to two digits; Pa. */
double sbfi_bearing_modulus(const sbf_attributes *attributes, const sbf_vec3_list *surface);

#endif
