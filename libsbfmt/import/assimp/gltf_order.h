/* Restores the vertex order of a glTF file.
 *
 * From version 5.3 on assimp numbers the vertices of a primitive by their first use in its triangles, and
 * drops unused ones. Indices of points (`source_points`, lists of weights) must be those of the file. */
#ifndef GLTF_ORDER_H
#define GLTF_ORDER_H

#include <assimp/scene.h>

#include "gltf_file.h"

/* Reorders the vertices of each mesh as in the glTF file; vertices without triangles stay dropped.
 * Finds a mesh in the file by its triangles and exact positions, so a mesh in file order does not change.
 * A file that is not glTF, and primitives with compressed or sparse numbers or in a data URI, keep the
 * importer's order. */
void restore_gltf_order(struct aiScene *scene, gltf *g);

#endif
