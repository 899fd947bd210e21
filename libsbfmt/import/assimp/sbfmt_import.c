/* sbfmt-import FILE: reads FILE with assimp and writes the scene to standard output in the format of
 * import/scene/stream_format.h. It is a separate process because assimp aborts or crashes on some damaged
 * files, and the only code that uses assimp. It requests no post-processing that welds, triangulates,
 * splits or merges. */
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/version.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "declared_joints.h"
#include "decoded_files.h"
#include "gltf_file.h"
#include "gltf_order.h"
#include "import/scene/stream_format.h"
#include "node_limits.h"
#include "stream_writer.h"
#include "text_forms.h"

static void write_ai_string(const struct aiString *text) {
  size_t length = text->length < sizeof text->data ? text->length : sizeof text->data;
  write_string(text->data, length);
}

static const struct aiMetadataEntry *find_entry(const struct aiMetadata *data, const char *key) {
  for (unsigned i = 0; data && i < data->mNumProperties; i++)
    if (strcmp(data->mKeys[i].data, key) == 0) return &data->mValues[i];
  return NULL;
}

static double number_of(const struct aiMetadata *data, const char *key, double missing) {
  const struct aiMetadataEntry *entry = find_entry(data, key);
  double number;
  return entry && metadata_number(entry, &number) ? number : missing;
}

static void write_header(const struct aiScene *scene) {
  static const char *const keys[] = {
      "UpAxis", "UpAxisSign", "FrontAxis", "FrontAxisSign", "CoordAxis", "CoordAxisSign"};
  const struct aiMetadata *data = scene->mMetaData;
  const struct aiMetadataEntry *generator = find_entry(data, "SourceAsset_Generator");
  write_u32(SBFI_STREAM_MAGIC);
  write_u32(SBFI_STREAM_VERSION);
  if (generator && generator->mType == AI_AISTRING)
    write_ai_string(generator->mData);
  else
    write_string("", 0);
  write_f64(number_of(data, "UnitScaleFactor", 0));
  bool stated = find_entry(data, "UpAxis") && find_entry(data, "FrontAxis") && find_entry(data, "CoordAxis");
  for (int i = 0; i < 6; i++) write_u32(stated ? (uint32_t)(int32_t)number_of(data, keys[i], i % 2) : 0);
  write_u32(scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE ? 1 : 0);
}

static bool is_camera_or_light(const struct aiScene *scene, const struct aiNode *node) {
  for (unsigned i = 0; i < scene->mNumCameras; i++)
    if (strcmp(scene->mCameras[i]->mName.data, node->mName.data) == 0) return true;
  for (unsigned i = 0; i < scene->mNumLights; i++)
    if (strcmp(scene->mLights[i]->mName.data, node->mName.data) == 0) return true;
  return false;
}

static declared_joints joints;

/* Never freed: freeing a damaged scene could crash. Static, so that leak checkers can reach it. */
static gltf gltf_read; /* empty for other formats */
static struct aiPropertyStore *properties;
static const struct aiScene *scene_read;

/* FBX distinguishes limbs, nulls and meshes; assimp only reports whether a node is a null. */
static sbfi_stream_kind kind_of(const struct aiScene *scene, const struct aiNode *node) {
  const struct aiMetadataEntry *is_null = find_entry(node->mMetaData, "IsNull");
  if (is_camera_or_light(scene, node)) return SBFI_STREAM_NO_BONE;
  if (is_declared_joint(&joints, node)) return SBFI_STREAM_BONE;
  if (!is_null || is_null->mType != AI_BOOL) return SBFI_STREAM_PLAIN;
  return *(const bool *)is_null->mData || node->mNumMeshes ? SBFI_STREAM_NO_BONE : SBFI_STREAM_BONE;
}

static uint32_t count_nodes(const struct aiNode *node) {
  uint32_t count = 1;
  for (unsigned i = 0; i < node->mNumChildren; i++) count += count_nodes(node->mChildren[i]);
  return count;
}

/* Writes a node and its descendants in depth-first order, numbered from *next; -1 for no parent. `source` is
 * the node's number in a glTF file, below 0 if it has none. */
static void write_nodes(
    const struct aiScene *scene, const struct aiNode *node, int32_t parent, int32_t *next, int32_t source) {
  int32_t number = (*next)++;
  write_ai_string(&node->mName);
  write_u32((uint32_t)parent);
  write_u32(kind_of(scene, node));
  write_u32((uint32_t)(source < 0 ? -1 : source));
  write_f32s(&node->mTransformation.a1, 16);
  write_limits(node->mMetaData);
  write_u32(node->mNumMeshes);
  for (unsigned i = 0; i < node->mNumMeshes; i++) write_u32(node->mMeshes[i]);
  for (unsigned i = 0; i < node->mNumChildren; i++)
    write_nodes(scene, node->mChildren[i], number, next, gltf_child(gltf_read.json, source, i));
}

static void write_polygons(const struct aiMesh *mesh) {
  uint32_t corner_count = 0;
  write_u32(mesh->mNumFaces);
  for (unsigned i = 0; i < mesh->mNumFaces; i++) {
    write_u32(mesh->mFaces[i].mNumIndices);
    corner_count += mesh->mFaces[i].mNumIndices;
  }
  write_u32(corner_count);
  for (unsigned i = 0; i < mesh->mNumFaces; i++)
    for (unsigned k = 0; k < mesh->mFaces[i].mNumIndices; k++) write_u32(mesh->mFaces[i].mIndices[k]);
}

static void write_bones(const struct aiMesh *mesh) {
  write_u32(mesh->mNumBones);
  for (unsigned i = 0; i < mesh->mNumBones; i++) {
    const struct aiBone *bone = mesh->mBones[i];
    write_ai_string(&bone->mName);
    write_f32s(&bone->mOffsetMatrix.a1, 16);
    write_u32(bone->mNumWeights);
    for (unsigned k = 0; k < bone->mNumWeights; k++) write_u32(bone->mWeights[k].mVertexId);
    for (unsigned k = 0; k < bone->mNumWeights; k++) write_f32s(&bone->mWeights[k].mWeight, 1);
  }
}

/* Ignores a shape without positions or with a different number of them. */
static bool is_shape(const struct aiMesh *mesh, const struct aiAnimMesh *shape) {
  return shape->mVertices && shape->mNumVertices == mesh->mNumVertices;
}

static void write_shapes(const struct aiMesh *mesh) {
  uint32_t count = 0;
  for (unsigned i = 0; i < mesh->mNumAnimMeshes; i++) count += is_shape(mesh, mesh->mAnimMeshes[i]);
  write_u32(count);
  for (unsigned i = 0; i < mesh->mNumAnimMeshes; i++) {
    const struct aiAnimMesh *shape = mesh->mAnimMeshes[i];
    if (!is_shape(mesh, shape)) continue;
    write_ai_string(&shape->mName);
    write_f32s(&shape->mWeight, 1);
    write_f32s(&shape->mVertices->x, 3 * (size_t)mesh->mNumVertices);
  }
}

static void write_mesh(const struct aiMesh *mesh) {
  write_ai_string(&mesh->mName);
  write_u32(mesh->mMaterialIndex);
  uint32_t vertex_count = mesh->mVertices ? mesh->mNumVertices : 0;
  write_u32(vertex_count);
  if (vertex_count) write_f32s(&mesh->mVertices->x, 3 * (size_t)vertex_count);
  bool has_normals = mesh->mNormals && vertex_count;
  write_u32(has_normals);
  if (has_normals) write_f32s(&mesh->mNormals->x, 3 * (size_t)vertex_count);
  bool has_colors = mesh->mColors[0] && vertex_count;
  write_u32(has_colors);
  if (has_colors) write_f32s(&mesh->mColors[0]->r, 4 * (size_t)vertex_count);
  uint32_t uv_set_count = 0;
  while (uv_set_count < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh->mTextureCoords[uv_set_count]) uv_set_count++;
  write_u32(uv_set_count);
  for (uint32_t set = 0; set < uv_set_count; set++)
    for (uint32_t i = 0; i < vertex_count; i++) write_f32s(&mesh->mTextureCoords[set][i].x, 2);
  write_polygons(mesh);
  write_bones(mesh);
  write_shapes(mesh);
}

static float float_of(const struct aiMaterial *material, const char *key, float missing) {
  ai_real value;
  return aiGetMaterialFloatArray(material, key, 0, 0, &value, NULL) == AI_SUCCESS ? (float)value : missing;
}

static bool color_of(const struct aiMaterial *material, const char *key, struct aiColor4D *color) {
  return aiGetMaterialColor(material, key, 0, 0, color) == AI_SUCCESS;
}

/* assimp rotates about the middle of the image with v upwards; its glTF reader compensates in the
 * translation. This restores the original values. */
static void write_uv_transform(const struct aiMaterial *material, enum aiTextureType type) {
  struct aiUVTransform in = {{0, 0}, {1, 1}, 0};
  aiGetMaterialUVTransform(material, "$tex.uvtrafo", (unsigned)type, 0, &in);
  float rotation = -in.mRotation, c = cosf(rotation), s = sinf(rotation);
  float values[] = {in.mTranslation.x - 0.5f * in.mScaling.x * (s - c + 1),
      0.5f * in.mScaling.y * (s + c - 1) + 1 - in.mScaling.y - in.mTranslation.y, rotation, in.mScaling.x,
      in.mScaling.y};
  write_f32s(values, 5);
}

static void write_image_of(
    const struct aiMaterial *material, enum aiTextureType first, enum aiTextureType second) {
  struct aiString path = {0};
  enum aiTextureType types[] = {first, second};
  int uv_set = 0, at = 0;
  for (int i = 0; i < 2 && !path.length; i++)
    if (aiGetMaterialTextureCount(material, types[i])) {
      aiGetMaterialTexture(material, types[i], 0, &path, NULL, NULL, NULL, NULL, NULL, NULL);
      at = i;
    }
  aiGetMaterialIntegerArray(material, "$tex.uvwsrc", (unsigned)types[at], 0, &uv_set, NULL);
  if (gltf_read.json) {
    percent_decode(path.data);
    path.length = (ai_uint32)strlen(path.data);
  }
  write_ai_string(&path);
  write_u32((uint32_t)uv_set);
  write_uv_transform(material, types[at]);
}

static void write_material(const struct aiMaterial *material) {
  struct aiString name = {0}, mode = {0};
  struct aiColor4D base = {0.8f, 0.8f, 0.8f, 1}, emissive = {0, 0, 0, 1};
  aiGetMaterialString(material, "?mat.name", 0, 0, &name);
  aiGetMaterialString(material, "$mat.gltf.alphaMode", 0, 0, &mode);
  bool physical = color_of(material, "$clr.base", &base);
  if (!physical) color_of(material, "$clr.diffuse", &base);
  color_of(material, "$clr.emissive", &emissive);
  /* Outside glTF exporters disagree about the meaning of 0, and an invisible character is never intended. */
  float opacity = float_of(material, "$mat.opacity", 1);
  if (!physical) base.a = opacity > 0 ? opacity : 1;
  uint32_t alpha_mode = strcmp(mode.data, "MASK") == 0    ? 1
                        : strcmp(mode.data, "BLEND") == 0 ? 2
                        : !mode.length && base.a < 1      ? 2
                                                          : 0;
  write_ai_string(&name);
  write_f32s(&base.r, 4);
  write_f32s(&emissive.r, 3);
  float rest[] = {float_of(material, "$mat.metallicFactor", 0), float_of(material, "$mat.roughnessFactor", 1),
      float_of(material, "$mat.gltf.alphaCutoff", 0.5f)};
  write_f32s(rest, 3);
  write_u32(alpha_mode);
  int two_sided = 1; /* without a statement the authoring programs draw both sides */
  aiGetMaterialIntegerArray(material, "$mat.twosided", 0, 0, &two_sided, NULL);
  write_u32(two_sided != 0);
  write_image_of(material, aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE);
  write_image_of(
      material, aiTextureType_UNKNOWN, aiTextureType_METALNESS); /* UNKNOWN: glTF's combined image */
  write_image_of(material, aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA);
}

/* Height 0: the bytes of an image file. Otherwise raw pixels, which no importer of a common format
 * returns. */
static void write_image(const struct aiTexture *texture) {
  size_t size = texture->mHeight == 0 && texture->pcData ? texture->mWidth : 0;
  const char *hint = texture->achFormatHint, *end = memchr(hint, 0, sizeof texture->achFormatHint);
  write_ai_string(&texture->mFilename);
  write_string(hint, end ? (size_t)(end - hint) : sizeof texture->achFormatHint);
  write_u32((uint32_t)size);
  write_bytes(texture->pcData, size);
}

static void write_vector_keys(const struct aiVectorKey *keys, unsigned count) {
  write_u32(count);
  for (unsigned i = 0; i < count; i++) {
    write_f64(keys[i].mTime);
    write_f32s(&keys[i].mValue.x, 3);
  }
}

static void write_channel(const struct aiNodeAnim *channel) {
  write_ai_string(&channel->mNodeName);
  write_vector_keys(channel->mPositionKeys, channel->mNumPositionKeys);
  write_u32(channel->mNumRotationKeys);
  for (unsigned i = 0; i < channel->mNumRotationKeys; i++) {
    const struct aiQuaternion *q = &channel->mRotationKeys[i].mValue;
    float xyzw[] = {q->x, q->y, q->z, q->w};
    write_f64(channel->mRotationKeys[i].mTime);
    write_f32s(xyzw, 4);
  }
  write_vector_keys(channel->mScalingKeys, channel->mNumScalingKeys);
}

static void write_clip(const struct aiAnimation *clip) {
  write_ai_string(&clip->mName);
  write_f64(clip->mDuration);
  write_f64(clip->mTicksPerSecond);
  write_u32(clip->mNumChannels);
  for (unsigned i = 0; i < clip->mNumChannels; i++) write_channel(clip->mChannels[i]);
}

static void write_scene(const struct aiScene *scene) {
  int32_t next = 0;
  write_header(scene);
  write_u32(count_nodes(scene->mRootNode));
  write_nodes(scene, scene->mRootNode, -1, &next, gltf_root(gltf_read.json));
  write_u32(scene->mNumMeshes);
  for (unsigned i = 0; i < scene->mNumMeshes; i++) write_mesh(scene->mMeshes[i]);
  write_u32(scene->mNumMaterials);
  for (unsigned i = 0; i < scene->mNumMaterials; i++) write_material(scene->mMaterials[i]);
  write_u32(scene->mNumTextures);
  for (unsigned i = 0; i < scene->mNumTextures; i++) write_image(scene->mTextures[i]);
  write_u32(scene->mNumAnimations);
  for (unsigned i = 0; i < scene->mNumAnimations; i++) write_clip(scene->mAnimations[i]);
  write_u32(SBFI_STREAM_END);
}

static bool ends_in(const char *path, const char *ending) {
  size_t length = strlen(path), more = strlen(ending);
  return length >= more && strcasecmp(path + length - more, ending) == 0;
}

/* Content of the file; NULL if it cannot be read. */
static char *read_whole(const char *path, size_t *size) {
  FILE *file = fopen(path, "rb");
  long length = file && fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
  char *text = length > 0 && fseek(file, 0, SEEK_SET) == 0 ? malloc((size_t)length) : NULL;
  *size = text ? fread(text, 1, (size_t)length, file) : 0;
  if (file) fclose(file);
  return text;
}

/* Reads the file with assimp, possibly after text repairs; an error status if text_forms.h rejects it. A
 * binary glTF of any name is read as one. */
static int read_scene(const char *path, const struct aiScene **scene, const struct aiPropertyStore *with) {
  static const char *const of_text[] = {".dae", ".fbx", ".ply", ".bvh", ".x", ".ase", ".stl", ".md5mesh"};
  char why[TEXT_WHY] = "", *text = NULL, *rewritten = NULL;
  size_t size = 0, rewritten_size = 0;
  for (size_t i = 0; !text && i < sizeof of_text / sizeof *of_text; i++)
    if (ends_in(path, of_text[i])) text = read_whole(path, &size);
  bool is_text = text && !memchr(text, 0, size); /* other files are binary and contain binary numbers */
  text_verdict verdict = is_text ? text_find_not_finite(text, size, why) : TEXT_AS_IT_IS;
  if (is_text && verdict == TEXT_AS_IT_IS && ends_in(path, ".dae"))
    verdict = collada_name_joints(text, size, &rewritten, &rewritten_size, why);
  free(text);
  if (*why) fprintf(stderr, "%s\n", why);
  if (verdict == TEXT_REFUSED) return SBFI_CHILD_REFUSED;
  if (verdict == TEXT_NOT_FINITE) return SBFI_CHILD_NOT_FINITE;
  if (verdict == TEXT_NO_MEMORY) return SBFI_CHILD_NO_MEMORY;
  if (gltf_read.json && !is_gltf_path(path))
    *scene = aiImportFileFromMemoryWithProperties(
        (const char *)gltf_read.file.at, (unsigned)gltf_read.file.size, 0, "glb", with);
  else
    *scene = rewritten ? aiImportFileFromMemoryWithProperties(
                             rewritten, (unsigned)rewritten_size, 0, strrchr(path, '.') + 1, with)
                       : aiImportFileExWithProperties(path, 0, gltf_read.json ? &decoded_files : NULL, with);
  free(rewritten);
  return SBFI_CHILD_DONE;
}

/* Whether assimp would return wrong vertices; reports it. */
static bool is_packed(const gltf *g) {
  const char *extension = gltf_unread_extension(g);
  if (extension)
    fprintf(stderr,
        "its meshes are compressed by %s, which is not supported: export them without compression\n",
        extension);
  return extension;
}

/* From this version on assimp renumbers the vertices of glTF. */
static bool renumbers_gltf(void) {
  unsigned major = aiGetVersionMajor(), minor = aiGetVersionMinor();
  return major > 5 || (major == 5 && minor >= 3);
}

int main(int argument_count, char **arguments) {
  if (argument_count != 2) {
    fprintf(stderr, "usage: sbfmt-import FILE: sbfmt convert runs this program; do not run it directly\n");
    return SBFI_CHILD_BAD_CALL;
  }
  bool is_gltf = is_gltf_path(arguments[1]) || begins_as_glb(arguments[1]);
  if (is_gltf && gltf_open(&gltf_read, arguments[1]) && is_packed(&gltf_read)) return SBFI_CHILD_REFUSED;
  properties = aiCreatePropertyStore();
  aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
  int status = read_scene(arguments[1], &scene_read, properties);
  if (status != SBFI_CHILD_DONE) return status;
  if (!scene_read || !scene_read->mRootNode) {
    const char *message = aiGetErrorString();
    fprintf(stderr, "%s\n", message && *message ? message : "the file is empty");
    return message && strstr(message, "bad_alloc") ? SBFI_CHILD_NO_MEMORY : SBFI_CHILD_REFUSED;
  }
  if (renumbers_gltf()) restore_gltf_order((struct aiScene *)(uintptr_t)scene_read, &gltf_read);
  if (!find_declared_joints(scene_read, arguments[1], &gltf_read, &joints)) return SBFI_CHILD_NO_MEMORY;
  write_scene(scene_read);
  return write_end() == 0 ? SBFI_CHILD_DONE : SBFI_CHILD_CANNOT_WRITE;
}
