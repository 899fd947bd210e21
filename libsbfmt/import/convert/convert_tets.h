/* Converts tetrahedra of another program to an asset: one body with an authored level. */
#ifndef SBFI_CONVERT_TETS_H
#define SBFI_CONVERT_TETS_H

#include "import/convert/conversion.h"
#include "import/tetrahedra/tet_mesh.h"

/* Adds a body and a render mesh to the asset. The body's surface is the boundary of the tetrahedra; its
 * only level contains them unchanged. Does not read c->scene. `name` is the body's name. */
sbf_status sbfi_convert_tets(sbfi_conversion *c, const sbfi_tet_mesh *mesh, const char *name);

/* Adds the body only. `*new_from_old` (may be NULL) maps points of the file to the body's source points,
 * which are the level's points; it lives as long as the conversion. */
sbf_status sbfi_convert_tet_body(sbfi_conversion *c, const sbfi_tet_mesh *mesh, const char *name,
    sbf_soft_body *body, const uint32_t **new_from_old);

#endif
