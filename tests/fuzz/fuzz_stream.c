/* What the program sbfmt-import sends, which may be anything: to a scene. */
#include <string.h>

#include "fuzz.h"
#include "import/scene/assimp_bridge.h"
#include "scene_check.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  sbfi_scene scene;
  sbf_diagnostic error = {0};
  uint8_t *aligned = malloc(size ? size : 1);
  FUZZ_MUST(aligned);
  if (size) memcpy(aligned, data, size);
  FUZZ_MUST(sbfi_scene_init(&scene, NULL, 1 << 26, "fuzz.fbx"));
  scene.format = "fbx";
  sbf_status status = sbfi_assimp_parse(&scene, aligned, size, NULL, &error);
  free(aligned); /* the scene keeps nothing of it */
  if (status == SBF_OK) {
    const char *broken = scene_check(&scene);
    if (broken) fprintf(stderr, "%s\n", broken);
    FUZZ_MUST(!broken);
  } else {
    FUZZ_MUST(error.code != 0 && error.message[0]);
  }
  sbfi_scene_free(&scene);
  return 0;
}
