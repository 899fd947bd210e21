/* Skinning: vertices from points and frames, normals from vertices. */
#ifndef SBRI_SKIN_H
#define SBRI_SKIN_H

#include "model/delta.h"
#include "model/runtime_model.h"

/* Computes vertices of a skin, asset metres. `points` are all points of the character. `vertices` holds
 * vertex_count, padded to a multiple of eight. */
void sbri_skin_compute_vertices(const sbr_model *model, const sbri_skin *skin, const sbri_point *points,
    const sbri_delta *deltas, sbri_point *vertices);

/* Volume enclosed by the faces, m^3. */
double sbri_skin_volume(const sbri_skin *skin, const sbri_point *vertices);

#endif
