/* Evaluating skins: vertices from points and frames, normals from vertices. */
#ifndef SBRI_SKIN_H
#define SBRI_SKIN_H

#include "model/delta.h"
#include "model/runtime_model.h"

/* Vertices of a skin, in asset metres: `points` are those of the whole character. `vertices` holds
 * vertex_count, padded to a multiple of eight. */
void sbri_skin_vertices(const sbr_model *model, const sbri_skin *skin, const sbri_point *points,
    const sbri_delta *deltas, sbri_point *vertices);

/* Volume that the faces enclose, m^3. */
double sbri_skin_volume(const sbri_skin *skin, const sbri_point *vertices);

#endif
