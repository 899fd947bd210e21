#include "scene_of_stream.h"

#include <stdlib.h>

#include "harness.h"
#include "import/scene/assimp_bridge.h"
#include "scene_check.h"

void scene_of_stream(sbfi_scene *scene, stream_builder *s, const char *format) {
  sbf_diagnostic error = {0};
  ck_assert(sbfi_scene_init(scene, NULL, 0, "test"));
  scene->format = format;
  sbf_status status = sbfi_assimp_parse(scene, s->at, s->size, NULL, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
  free(s->at);
  const char *broken = scene_check(scene);
  ck_assert_msg(!broken, "%s", broken);
}
