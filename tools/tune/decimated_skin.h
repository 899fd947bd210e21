/* A coarser copy of a source asset's render meshes, to try builds on.
 *
 * Vertex clustering (Rossignac, Borrel 1993): the vertices of a grid cell with the same main bone become one
 * vertex. It needs nothing but sums, so that every machine gives the same bits. */
#ifndef TUNE_DECIMATED_SKIN_H
#define TUNE_DECIMATED_SKIN_H

#include "sbfmt/asset.h"

/* Returns an asset with at most `max_vertices` vertices of render meshes, apart from one for each main bone
 * of a mesh; free it with sbf_asset_free. NULL if memory runs out. It has the skins' weights and pins, but
 * neither normals, texture coordinates, colours nor shape keys, and borrows all else from `source`, which
 * must outlive it. Time and memory: linear in the vertices and polygons. */
sbf_asset *tune_decimate_skins(const sbf_asset *source, uint32_t max_vertices);

/* Number of vertices of all render meshes. */
uint64_t tune_count_vertices(const sbf_asset *asset);

#endif
