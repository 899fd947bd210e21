/* Wavefront OBJ. */
#include "fuzz.h"
#include "import/obj/obj.h"
#include "scene_check.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  sbfi_scene scene;
  sbf_diagnostic error = {0};
  FUZZ_MUST(sbfi_scene_init(&scene, NULL, 1 << 26, "fuzz.obj"));
  sbf_status status = sbfi_obj_read(&scene, (const char *)data, size, NULL, &error);
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
