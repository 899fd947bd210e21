/* The order of a glTF file's vertices.
 *
 * From 5.3 on assimp numbers the vertices of a primitive by their first use in its triangles, and leaves out
 * those that are not used. Numbers of points (`source_points`, lists of weights) are to be the file's. */
#ifndef GLTF_ORDER_H
#define GLTF_ORDER_H

#include <assimp/scene.h>

/* Puts the vertices of each mesh back into the order that the glTF file `path` has them in; vertices that no
 * triangle uses stay left out. A mesh is found in the file by its triangles and the bits of its positions, so
 * a mesh that is already in that order stays as it is. Files of other formats, and primitives whose numbers
 * are compressed, sparse or inside of a data URI, keep the importer's order. */
void restore_gltf_order(struct aiScene *scene, const char *path);

#endif
