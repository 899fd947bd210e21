/* Joints of a file without a mesh. assimp hands on joints with the meshes that they move alone, so an
 * armature in a file of its own would come as nodes of which nobody says that they are bones. */
#ifndef DECLARED_JOINTS_H
#define DECLARED_JOINTS_H

#include <assimp/scene.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct declared_joints {
  const struct aiNode **nodes;
  size_t count, capacity;
} declared_joints;

/* The nodes that the glTF or Collada file `path` declares to be joints. None where the scene has a mesh, in
 * files of other forms, and where the file declares none. False where memory runs out. */
bool find_declared_joints(const struct aiScene *scene, const char *path, declared_joints *to);

bool is_declared_joint(const declared_joints *joints, const struct aiNode *node);

#endif
