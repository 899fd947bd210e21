/* Sites of a mesh: merges coincident points of one piece of surface. */
#ifndef SBFI_WEIGHT_SITES_H
#define SBFI_WEIGHT_SITES_H

#include "build/weights/weight_mesh.h"

/* Fills sites, site_of_point and site_count of a mesh whose low and scale are set. Pieces are connected if
 * they share a point, or an edge with equal positions. Pieces that only touch, such as a button with a
 * corner on a sleeve, keep separate sites. Sites are numbered by first point; points without triangles get
 * UINT32_MAX. False if memory runs out. */
bool sbfi_weight_sites_find(sbfi_weight_mesh *mesh, const sbfi_weights_input *in, sbfi_arena *arena);

#endif
