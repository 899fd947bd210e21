/* How stiff a thing has to be to stand. */
#ifndef SBFI_BEARING_MODULUS_H
#define SBFI_BEARING_MODULUS_H

#include "sbfmt/model.h"

/* The modulus given, Pa, or as much as it takes for a column of that height, m, and density, kg/m^3, to
 * strain by no more than that at its foot under the earth's gravity, whatever the file's. Rounded up to two
 * digits. */
double sbfi_modulus_to_bear(double modulus, double density, double height, double strain);

/* The same for a body that stands: the height is its surface's length, and a twentieth the strain. Source
 * parts hang on it. */
double sbfi_bearing_modulus(const sbf_attributes *attributes, const sbf_vec3_list *surface);

/* The same for what stands on +Y: at least as much as that level of it needs that carries the most on the
 * least, legs under a body. Levels near its ends do not count. */
double sbfi_standing_modulus(const sbf_attributes *attributes, const sbf_polygon_mesh *surface);

#endif
