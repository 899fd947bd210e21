#include "gltf_order.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { UNSIGNED_BYTE = 5121, UNSIGNED_SHORT = 5123, UNSIGNED_INT = 5125, FLOAT = 5126, TRIANGLES = 4 };
static const uint32_t unused = UINT32_MAX;

/* Items of an accessor in place. */
typedef struct view {
  const uint8_t *at;
  size_t count, stride;
  json_int_t type;
} view;

static bool size_of(const json_t *object, const char *key, size_t *to) {
  const json_t *value = json_object_get(object, key);
  if (value && (!json_is_integer(value) || json_integer_value(value) < 0)) return false;
  *to = value ? (size_t)json_integer_value(value) : 0;
  return true;
}

/* Views items of `components` numbers; false if they cannot be read in place. */
static bool open_view(const gltf *g, const json_t *number, size_t components, view *to) {
  size_t view_number, buffer, first, offset, length, width;
  const json_t *accessor = json_array_get(json_object_get(g->json, "accessors"),
      json_is_integer(number) ? (size_t)json_integer_value(number) : SIZE_MAX);
  if (!accessor || json_object_get(accessor, "sparse") || !json_object_get(accessor, "bufferView"))
    return false;
  if (!size_of(accessor, "bufferView", &view_number) || !size_of(accessor, "byteOffset", &offset) ||
      !size_of(accessor, "count", &to->count))
    return false;
  const json_t *v = json_array_get(json_object_get(g->json, "bufferViews"), view_number);
  if (!v || json_object_get(v, "extensions") || !size_of(v, "buffer", &buffer) ||
      !size_of(v, "byteOffset", &first) || !size_of(v, "byteLength", &length) ||
      !size_of(v, "byteStride", &to->stride) || buffer >= g->buffer_count)
    return false;
  to->type = json_integer_value(json_object_get(accessor, "componentType"));
  width = components * (to->type == UNSIGNED_BYTE ? 1 : to->type == UNSIGNED_SHORT ? 2 : 4);
  if (!to->stride) to->stride = width;
  const bytes *from = &g->buffers[buffer];
  if (!from->at || first > from->size || length > from->size - first || offset > length || !to->count ||
      to->stride > length || (to->count - 1) > (length - offset) / to->stride ||
      (to->count - 1) * to->stride + width > length - offset)
    return false;
  to->at = from->at + first + offset;
  return true;
}

static uint32_t index_at(const view *v, size_t i) {
  const uint8_t *at = v->at + i * v->stride;
  if (v->type == UNSIGNED_BYTE) return at[0];
  return v->type == UNSIGNED_SHORT ? at[0] | (uint32_t)at[1] << 8 : gltf_word_at(at);
}

/* Fills `source` (mNumVertices): the file's number of each vertex. False if the mesh is not from this
 * primitive. */
static bool match(const gltf *g, const json_t *primitive, const struct aiMesh *mesh, uint32_t *source) {
  view indices, positions;
  const json_t *mode = json_object_get(primitive, "mode");
  if ((mode && json_integer_value(mode) != TRIANGLES) ||
      !open_view(g, json_object_get(primitive, "indices"), 1, &indices) || indices.type == FLOAT ||
      !open_view(g, json_object_get(json_object_get(primitive, "attributes"), "POSITION"), 3, &positions) ||
      positions.type != FLOAT || indices.count != 3 * (size_t)mesh->mNumFaces)
    return false;
  for (unsigned i = 0; i < mesh->mNumVertices; i++) source[i] = unused;
  for (size_t c = 0; c < indices.count; c++) {
    const struct aiFace *face = &mesh->mFaces[c / 3];
    uint32_t from = index_at(&indices, c), to = face->mNumIndices == 3 ? face->mIndices[c % 3] : unused;
    if (to >= mesh->mNumVertices || from >= positions.count || (source[to] != unused && source[to] != from) ||
        memcmp(positions.at + from * positions.stride, &mesh->mVertices[to], 3 * sizeof(float)) != 0)
      return false;
    source[to] = from;
  }
  return true;
}

/* Compacts the file's numbers to indices without gaps; unused vertices come last. */
static bool rank(uint32_t *source, unsigned count) {
  uint32_t end = 0;
  for (unsigned i = 0; i < count; i++)
    if (source[i] != unused && source[i] >= end) end = source[i] + 1;
  uint32_t *slots = malloc(((size_t)end + 1) * sizeof *slots), next = 0;
  if (!slots) return false;
  for (uint32_t s = 0; s < end; s++) slots[s] = unused;
  for (unsigned i = 0; i < count; i++)
    if (source[i] != unused) slots[source[i]] = i;
  bool once = true; /* assimp never gives two vertices one number */
  for (unsigned i = 0; i < count; i++) once = once && (source[i] == unused || slots[source[i]] == i);
  for (uint32_t s = 0; s < end; s++)
    if (slots[s] != unused) source[slots[s]] = next++;
  for (unsigned i = 0; i < count; i++)
    if (source[i] == unused) source[i] = next++;
  free(slots);
  return once;
}

static bool reorder(void *items, size_t width, const uint32_t *slots, unsigned count) {
  uint8_t *from = items, *to = from ? malloc(count * width) : NULL;
  if (!from) return true;
  if (!to) return false;
  for (unsigned i = 0; i < count; i++) memcpy(to + slots[i] * width, from + i * width, width);
  memcpy(from, to, count * width);
  free(to);
  return true;
}

static void apply(struct aiMesh *mesh, const uint32_t *slots) {
  unsigned n = mesh->mNumVertices;
  bool good = reorder(mesh->mVertices, sizeof *mesh->mVertices, slots, n) &&
              reorder(mesh->mNormals, sizeof *mesh->mNormals, slots, n) &&
              reorder(mesh->mTangents, sizeof *mesh->mTangents, slots, n) &&
              reorder(mesh->mBitangents, sizeof *mesh->mBitangents, slots, n);
  for (unsigned i = 0; good && i < AI_MAX_NUMBER_OF_TEXTURECOORDS; i++)
    good = reorder(mesh->mTextureCoords[i], sizeof *mesh->mTextureCoords[i], slots, n);
  for (unsigned i = 0; good && i < AI_MAX_NUMBER_OF_COLOR_SETS; i++)
    good = reorder(mesh->mColors[i], sizeof *mesh->mColors[i], slots, n);
  for (unsigned i = 0; good && i < mesh->mNumAnimMeshes; i++)
    if (mesh->mAnimMeshes[i]->mNumVertices == n)
      good = reorder(mesh->mAnimMeshes[i]->mVertices, sizeof *mesh->mAnimMeshes[i]->mVertices, slots, n);
  if (!good) abort(); /* a half reordered mesh is unusable: the parent reports a crash of the importer */
  for (unsigned f = 0; f < mesh->mNumFaces; f++)
    for (unsigned k = 0; k < mesh->mFaces[f].mNumIndices; k++)
      mesh->mFaces[f].mIndices[k] = slots[mesh->mFaces[f].mIndices[k]];
  for (unsigned b = 0; b < mesh->mNumBones; b++)
    for (unsigned k = 0; k < mesh->mBones[b]->mNumWeights; k++) {
      unsigned *vertex = &mesh->mBones[b]->mWeights[k].mVertexId;
      if (*vertex < n) *vertex = slots[*vertex];
    }
}

static void restore_mesh(const gltf *g, struct aiMesh *mesh) {
  uint32_t *source = mesh->mVertices ? malloc((mesh->mNumVertices + 1) * sizeof *source) : NULL;
  if (!source) return;
  size_t m, p;
  json_t *described, *primitive;
  bool found = false;
  json_array_foreach(json_object_get(g->json, "meshes"), m, described) {
    json_array_foreach(json_object_get(described, "primitives"), p, primitive) {
      if (!found && match(g, primitive, mesh, source)) found = true;
      if (found) break;
    }
    if (found) break;
  }
  if (found && rank(source, mesh->mNumVertices)) apply(mesh, source);
  free(source);
}

void restore_gltf_order(struct aiScene *scene, gltf *g) {
  if (!g->json || !gltf_load_buffers(g)) return;
  for (unsigned i = 0; i < scene->mNumMeshes; i++) restore_mesh(g, scene->mMeshes[i]);
}
