/* Finds joints in a file without meshes. assimp only returns joints together with the meshes that they
 * move, so it returns an armature file as nodes that are not marked as bones. */
#ifndef DECLARED_JOINTS_H
#define DECLARED_JOINTS_H

#include <assimp/scene.h>
#include <stdbool.h>
#include <stddef.h>

#include "gltf_file.h"

typedef struct declared_joints {
  const struct aiNode **nodes;
  size_t count, capacity;
} declared_joints;

/* Nodes that the file `path` declares as joints: a glTF, read into `g`, or a Collada file. None if the scene
 * has a mesh, for other formats, or if the file declares none. False if memory runs out. */
bool find_declared_joints(const struct aiScene *scene, const char *path, const gltf *g, declared_joints *to);

bool is_declared_joint(const declared_joints *joints, const struct aiNode *node);

#endif
