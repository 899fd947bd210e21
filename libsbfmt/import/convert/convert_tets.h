/* Tetrahedra of another program to an asset: one body, its level authored. */
#ifndef SBFI_CONVERT_TETS_H
#define SBFI_CONVERT_TETS_H

#include "import/convert/conversion.h"
#include "import/tetrahedra/tet_mesh.h"

/* Fills the conversion's asset with a body whose surface is the boundary of the tetrahedra and whose one
 * level holds them as they are, and with a mesh that shows it. c->scene is not read; `name` is the body's. */
sbf_status sbfi_convert_tets(sbfi_conversion *c, const sbfi_tet_mesh *mesh, const char *name);

/* The body alone; `*new_from_old` (may be NULL) becomes the place of each point of the file among the body's
 * source points, which are the level's points, and lives as long as the conversion. */
sbf_status sbfi_convert_tet_body(sbfi_conversion *c, const sbfi_tet_mesh *mesh, const char *name,
    sbf_soft_body *body, const uint32_t **new_from_old);

#endif
