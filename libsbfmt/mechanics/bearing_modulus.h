/* Minimum stiffness of an object to carry its own weight. */
#ifndef SBFI_BEARING_MODULUS_H
#define SBFI_BEARING_MODULUS_H

#include "sbfmt/model.h"

/* Returns `modulus`, Pa, or the minimum modulus for which a column of the height, m, and density, kg/m^3,
 * has at most this strain at its base under the earth's gravity, whatever the file's. Rounded up to two
 * digits. */
double sbfi_modulus_to_bear(double modulus, double density, double height, double strain);

/* The same for a standing body: the height is its surface's length and the strain a twentieth. Source
 * parts depend on it. */
double sbfi_bearing_modulus(const sbf_attributes *attributes, const sbf_vec3_list *surface);

/* The same for an object that stands along +Y: at least the modulus for its most stressed cross-section,
 * such as legs under a body. Cross-sections near its ends are ignored. */
double sbfi_standing_modulus(const sbf_attributes *attributes, const sbf_polygon_mesh *surface);

#endif
