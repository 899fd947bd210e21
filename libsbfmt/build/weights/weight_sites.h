/* Sites of a mesh: its points joined where they are in one place and in one piece of surface. */
#ifndef SBFI_WEIGHT_SITES_H
#define SBFI_WEIGHT_SITES_H

#include "build/weights/weight_mesh.h"

/* Fills sites, site_of_point and site_count of a mesh whose low and scale are set. Pieces of surface are one
 * where they share a point, or an edge: the same two places. Pieces that only touch, such as a button with a
 * corner on a sleeve, keep sites of their own. Sites are numbered by first point; points in no triangle get
 * UINT32_MAX. False where memory runs out. */
bool sbfi_weight_sites_find(sbfi_weight_mesh *mesh, const sbfi_weights_input *in, sbfi_arena *arena);

#endif
