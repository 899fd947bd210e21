/* The order of a glTF file's vertices, with an importer that numbers them by first use as assimp does
 * from 5.3 on. */
#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "import/assimp/gltf_order.h"

static const char *const files[] = {"examples/pup/pup.glb", "examples/lizard/lizard.glb"};

static void renumber(struct aiMesh *mesh) {
  unsigned n = mesh->mNumVertices, next = 0;
  unsigned *slots = malloc(n * sizeof *slots);
  struct aiVector3D *moved = malloc(n * sizeof *moved);
  for (unsigned i = 0; i < n; i++) slots[i] = n;
  for (unsigned f = 0; f < mesh->mNumFaces; f++)
    for (unsigned k = 0; k < mesh->mFaces[f].mNumIndices; k++) {
      unsigned *at = &mesh->mFaces[f].mIndices[k];
      if (slots[*at] == n) slots[*at] = next++;
      *at = slots[*at];
    }
  struct aiVector3D *lists[] = {mesh->mVertices, mesh->mNormals, mesh->mTextureCoords[0]};
  for (int l = 0; l < 3; l++) {
    if (!lists[l]) continue;
    for (unsigned i = 0; i < n; i++)
      if (slots[i] < n) moved[slots[i]] = lists[l][i];
    memcpy(lists[l], moved, next * sizeof *moved);
  }
  for (unsigned b = 0; b < mesh->mNumBones; b++) {
    struct aiBone *bone = mesh->mBones[b];
    unsigned kept = 0;
    for (unsigned k = 0; k < bone->mNumWeights; k++)
      if (slots[bone->mWeights[k].mVertexId] < n) {
        bone->mWeights[kept] = bone->mWeights[k];
        bone->mWeights[kept++].mVertexId = slots[bone->mWeights[k].mVertexId];
      }
    bone->mNumWeights = kept;
  }
  mesh->mNumVertices = next;
  free(slots);
  free(moved);
}

static float weight_of(const struct aiBone *bone, unsigned vertex) {
  for (unsigned k = 0; k < bone->mNumWeights; k++)
    if (bone->mWeights[k].mVertexId == vertex) return bone->mWeights[k].mWeight;
  return 0;
}

static void assert_same(const struct aiMesh *mesh, const struct aiMesh *file) {
  ck_assert_uint_eq(mesh->mNumVertices, file->mNumVertices);
  size_t size = mesh->mNumVertices * sizeof *mesh->mVertices;
  ck_assert_mem_eq(mesh->mVertices, file->mVertices, size);
  if (file->mNormals) ck_assert_mem_eq(mesh->mNormals, file->mNormals, size);
  if (file->mTextureCoords[0]) ck_assert_mem_eq(mesh->mTextureCoords[0], file->mTextureCoords[0], size);
  for (unsigned f = 0; f < file->mNumFaces; f++)
    ck_assert_mem_eq(mesh->mFaces[f].mIndices, file->mFaces[f].mIndices, 3 * sizeof(unsigned));
  for (unsigned b = 0; b < file->mNumBones; b++)
    for (unsigned i = 0; i < mesh->mNumVertices; i += 7)
      ck_assert(weight_of(mesh->mBones[b], i) == weight_of(file->mBones[b], i));
}

static void restore(struct aiScene *scene, const char *path) {
  gltf g;
  gltf_open(&g, path);
  restore_gltf_order(scene, &g);
  gltf_close(&g);
}

/* Changed in place, as only the importer hands out a scene. */
static struct aiScene *read(const char *path) {
  const struct aiScene *scene = aiImportFile(path, 0);
  ck_assert_ptr_nonnull(scene);
  return (struct aiScene *)(uintptr_t)scene;
}

START_TEST(vertices_get_the_files_order)
{
  const char *path = harness_source(files[_i]);
  struct aiScene *file = read(path), *scene = read(path);
  restore(file, path); /* where assimp has renumbered it already */
  bool changed = false;
  for (unsigned m = 0; m < scene->mNumMeshes; m++) {
    renumber(scene->mMeshes[m]);
    changed = changed || memcmp(scene->mMeshes[m]->mVertices, file->mMeshes[m]->mVertices,
                             scene->mMeshes[m]->mNumVertices * sizeof(struct aiVector3D)) != 0;
  }
  ck_assert(changed);
  restore(scene, path);
  for (unsigned m = 0; m < scene->mNumMeshes; m++) assert_same(scene->mMeshes[m], file->mMeshes[m]);
  aiReleaseImport(scene);
  aiReleaseImport(file);
}
END_TEST

START_TEST(a_file_cut_anywhere_changes_nothing)
{
  size_t size;
  const char *path = harness_source(files[1]), *cut = harness_scratch("cut.glb");
  char *content = harness_read(path, &size);
  struct aiScene *file = read(path), *scene = read(path);
  restore(file, path);
  restore(scene, path);
  for (size_t kept = 0; kept < size; kept += kept < 4000 ? 37 : size / 20) {
    ck_assert(harness_write(cut, content, kept));
    restore(scene, cut);
  }
  restore(scene, "nothing/there.glb");
  for (unsigned m = 0; m < scene->mNumMeshes; m++) assert_same(scene->mMeshes[m], file->mMeshes[m]);
  aiReleaseImport(scene);
  aiReleaseImport(file);
  free(content);
}
END_TEST

/* The importer opens a file only once. */
START_TEST(an_opened_file_is_not_read_again)
{
  size_t size;
  const char *path = harness_source(files[0]), *copy = harness_scratch("opened.glb");
  char *content = harness_read(path, &size);
  struct aiScene *file = read(path), *scene = read(path);
  restore(file, path);
  for (unsigned m = 0; m < scene->mNumMeshes; m++) renumber(scene->mMeshes[m]);
  gltf g;
  ck_assert(harness_write(copy, content, size) && gltf_open(&g, copy));
  ck_assert_int_eq(remove(copy), 0);
  restore_gltf_order(scene, &g);
  gltf_close(&g);
  for (unsigned m = 0; m < scene->mNumMeshes; m++) assert_same(scene->mMeshes[m], file->mMeshes[m]);
  aiReleaseImport(scene);
  aiReleaseImport(file);
  free(content);
}
END_TEST

int main(void) {
  Suite *s = suite_create("gltf_order");
  TCase *c = tcase_create("order");
  tcase_add_loop_test(c, vertices_get_the_files_order, 0, sizeof files / sizeof *files);
  tcase_add_test(c, a_file_cut_anywhere_changes_nothing);
  tcase_add_test(c, an_opened_file_is_not_read_again);
  suite_add_tcase(s, c);
  return harness_run(s);
}
