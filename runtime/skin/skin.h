/* Evaluating skins: vertices from points and frames, normals from vertices. */
#ifndef SBRI_SKIN_H
#define SBRI_SKIN_H

#include "core/state.h"

/* Vertices of a skin, in asset metres: `points` are those of the whole character. `vertices` holds
 * vertex_count, padded to a multiple of eight. */
void sbri_skin_vertices(const sbr_model *model, const sbri_skin *skin, const sbri_point *points,
    const sbr_transform *deltas, sbri_point *vertices);

/* Volume that the faces enclose, m^3. */
double sbri_skin_volume(const sbri_skin *skin, const sbri_point *vertices);

/* Volume within a body's surface as `points` of its character lie; uses scratch of the body's own island, so
 * that tasks may call it side by side. */
double sbri_surface_volume(const sbri_character *c, const sbri_body *body, const sbri_point *points);

/* Fills in rest_volume_m3 of all bodies; false where memory runs out. */
bool sbri_rest_volumes_find(sbr_model *model);

#endif
