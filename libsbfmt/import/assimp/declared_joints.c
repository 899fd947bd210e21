#include "declared_joints.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "text_forms.h"

enum { DEEPEST = 512 };

typedef struct search {
  declared_joints *to;
  const struct aiNode *root;
  const json_t *json; /* of a glTF */
  const bool *is_joint;
  bool good;
} search;

static void add(search *s, const struct aiNode *node) {
  declared_joints *to = s->to;
  if (to->count == to->capacity) {
    size_t capacity = to->capacity ? 2 * to->capacity : 64;
    const struct aiNode **grown = realloc(to->nodes, capacity * sizeof(struct aiNode *));
    s->good = s->good && grown;
    if (!grown) return;
    to->nodes = grown;
    to->capacity = capacity;
  }
  to->nodes[to->count++] = node;
}

/* Matches nodes by order, because names need not be unique. */
static void walk_gltf(search *s, const struct aiNode *node, int32_t number, int depth) {
  if (depth == DEEPEST) return;
  if (number >= 0 && s->is_joint[number]) add(s, node);
  for (unsigned i = 0; i < node->mNumChildren; i++)
    walk_gltf(s, node->mChildren[i], gltf_child(s->json, number, i), depth + 1);
}

static bool find_in_gltf(const struct aiScene *scene, const json_t *json, declared_joints *to) {
  search s = {.to = to, .json = json, .good = true};
  size_t count = json_array_size(json_object_get(json, "nodes")), skin, k;
  bool *is_joint = calloc(count + 1, sizeof *is_joint);
  json_t *described, *joint;
  if (!is_joint) return false;
  json_array_foreach(json_object_get(json, "skins"), skin, described) {
    json_array_foreach(json_object_get(described, "joints"), k, joint) {
      size_t at = json_is_integer(joint) ? (size_t)json_integer_value(joint) : SIZE_MAX;
      if (at < count) is_joint[at] = true;
    }
  }
  s.is_joint = is_joint;
  walk_gltf(&s, scene->mRootNode, gltf_root(json), 0);
  free(is_joint);
  return s.good;
}

/* assimp names a node by its id. */
static void add_named(search *s, const struct aiNode *node, const char *id, size_t length) {
  if (node->mName.length == length && memcmp(node->mName.data, id, length) == 0) add(s, node);
  for (unsigned i = 0; i < node->mNumChildren; i++) add_named(s, node->mChildren[i], id, length);
}

static void add_collada(void *user, const char *id, size_t length) {
  search *s = user;
  add_named(s, s->root, id, length);
}

static bool find_in_collada(const struct aiScene *scene, const char *path, declared_joints *to) {
  search s = {.to = to, .root = scene->mRootNode, .good = true};
  bytes text = read_file(path);
  if (text.size) collada_find_joints((const char *)text.at, text.size, add_collada, &s);
  free(text.at);
  return s.good;
}

bool find_declared_joints(const struct aiScene *scene, const char *path, const gltf *g, declared_joints *to) {
  const char *dot = strrchr(path, '.');
  if (scene->mNumMeshes) return true;
  if (g->json) return find_in_gltf(scene, g->json, to);
  return !dot || strcasecmp(dot, ".dae") != 0 || find_in_collada(scene, path, to);
}

bool is_declared_joint(const declared_joints *joints, const struct aiNode *node) {
  for (size_t i = 0; i < joints->count; i++)
    if (joints->nodes[i] == node) return true;
  return false;
}
