/* The render meshes of an asset in the forms that other programs read, to compare with: no more than the
 * comparison needs. Quads and n-gons are cut into fans of triangles for GLB and kept for OBJ. */
#ifndef BENCH_PEER_FILES_H
#define BENCH_PEER_FILES_H

#include "sbfmt/asset.h"

/* Positions, normals, first texture coordinates, indices of 16 bits where they fit, and where a mesh has a
 * skin the four heaviest joints of each vertex with their weights. One mesh and one node each. */
void write_glb(const char *path, const sbf_asset *asset);
/* The shortest digits that give the same numbers back: an OBJ with as much in it as the asset has. */
void write_obj(const char *path, const sbf_asset *asset);

size_t file_size_of(const char *path);

#endif
