/* Joins polygons of an OBJ that meet without sharing points, as exporters write flat-shaded meshes. */
#ifndef SBFI_JOIN_BORDERS_H
#define SBFI_JOIN_BORDERS_H

#include "import/convert/conversion.h"

/* Before meshes, for objects that become soft bodies, which would fall apart: merges the ends of edges that
 * two polygons of an object have at one position. Skins keep their points, because weights hold them
 * together. Replaces the scene if anything was merged. */
sbf_status sbfi_join_borders(sbfi_conversion *c);

#endif
