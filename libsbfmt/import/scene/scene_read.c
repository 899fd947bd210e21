/* Selects the reader of a file: OBJ has our own, others use assimp's process. */
#include <string.h>

#include "base/diagnostic.h"
#include "base/file.h"
#include "import/obj/obj.h"
#include "import/scene/assimp_bridge.h"
#include "import/scene/scene.h"
#include "import/vrm/vrm.h"

static bool ends_in_obj(const char *path) {
  size_t length = strlen(path);
  if (length < 4) return false;
  const char *end = path + length - 4;
  return end[0] == '.' && (end[1] | 0x20) == 'o' && (end[2] | 0x20) == 'b' && (end[3] | 0x20) == 'j';
}

/* What assimp does not pass on of a glTF file. */
static sbf_status read_gltf_extensions(
    sbfi_scene *scene, const char *path, const sbfi_scene_options *o, sbf_diagnostic *error) {
  sbfi_file_content file;
  if (strcmp(scene->format, "glb") != 0 && strcmp(scene->format, "gltf") != 0) return SBF_OK;
  sbf_status status = sbfi_file_map(path, o->input_limit_bytes, o->allocator, &file, error);
  if (status) return status;
  status = sbfi_vrm_read(scene, file.at, file.size, o->allocator, error);
  sbfi_file_content_free(&file);
  return status;
}

/* As far as addresses of this machine go. */
static size_t gibibytes(uint32_t count) {
  uint64_t bytes = (uint64_t)count << 30;
  return bytes < SIZE_MAX ? (size_t)bytes : SIZE_MAX;
}

sbf_status sbfi_scene_read(
    sbfi_scene *scene, const char *path, const sbfi_scene_options *options, sbf_diagnostic *error) {
  sbfi_scene_options o = options ? *options : (sbfi_scene_options){0};
  if (!o.input_limit_bytes) o.input_limit_bytes = gibibytes(4);
  if (!o.memory_limit_bytes) o.memory_limit_bytes = gibibytes(8);
  if (!sbfi_scene_init(scene, o.allocator, o.memory_limit_bytes, path)) {
    sbf_status status = sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory to read a scene");
    return sbfi_scene_fail(scene, error, status);
  }
  sbf_status status;
  if (ends_in_obj(path)) {
    sbfi_file_content file;
    status = sbfi_file_read(path, o.input_limit_bytes, o.allocator, &file, error);
    if (!status) {
      status = sbfi_obj_read(scene, (const char *)file.at, file.size, o.allocator, error);
      sbfi_file_content_free(&file);
    }
  } else {
    status = sbfi_assimp_read(scene, path, &o, error);
    if (!status) status = read_gltf_extensions(scene, path, &o, error);
  }
  return status ? sbfi_scene_fail(scene, error, status) : SBF_OK;
}
