/* Avatar data of a glTF file, on a skeleton of twelve bones: what is read holds what it promises, and becomes
 * a sound character. */
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "fuzz_asset.h"
#include "import/convert/conversion.h"
#include "import/vrm/vrm.h"

enum { BONES = 12 };

static void check(const sbfi_scene *scene) {
  const sbfi_vrm *vrm = scene->vrm;
  for (uint32_t i = 0; i < vrm->spring_count; i++) {
    const sbfi_vrm_spring *s = &vrm->springs[i];
    FUZZ_MUST(s->joint_count > 0 && s->center >= SBF_NONE && s->center < BONES);
    for (uint32_t k = 0; k < s->joint_count; k++) {
      FUZZ_MUST(s->joints[k].node >= 0 && s->joints[k].node < BONES);
      FUZZ_MUST(k == 0 || s->joints[k].node > s->joints[k - 1].node);
      FUZZ_MUST(isfinite(s->joints[k].stiffness) && s->joints[k].drag_force <= 1);
    }
    for (uint32_t k = 0; k < s->collider_count; k++) FUZZ_MUST(s->colliders[k] < vrm->collider_count);
  }
  for (uint32_t i = 0; i < vrm->collider_count; i++)
    FUZZ_MUST(vrm->colliders[i].node >= SBF_NONE && vrm->colliders[i].node < BONES);
  for (int i = 0; i < SBFI_VRM_BONES; i++) FUZZ_MUST(vrm->bones[i] >= SBF_NONE && vrm->bones[i] < BONES);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const int32_t parents[BONES] = {-1, 0, 1, 2, 3, 2, 5, 6, 6, 1, 9, 0};
  sbfi_scene scene;
  sbf_diagnostic error = {0};
  FUZZ_MUST(sbfi_scene_init(&scene, NULL, 1 << 26, access("/dev/null", R_OK) == 0 ? "/dev/null" : ""));
  sbfi_scene_node *nodes = sbfi_arena_allocate(&scene.arena, BONES, sizeof *nodes);
  FUZZ_MUST(nodes);
  for (int32_t i = 0; i < BONES; i++) {
    nodes[i] = (sbfi_scene_node){
        .name = "n", .parent = parents[i], .number = i, .local = sbfi_matrix_identity(), .is_bone = i < 9};
    nodes[i].local.at[1][3] = 0.2;
    nodes[i].local.at[0][3] = i == 5 ? 0.1 : 0;
  }
  sbfi_scene_set_worlds(nodes, BONES);
  scene.format = "glb";
  scene.nodes = nodes;
  scene.node_count = BONES;
  FUZZ_MUST(sbfi_vrm_read(&scene, data, size, NULL, &error) == SBF_OK);
  if (scene.vrm) {
    check(&scene);
    sbf_asset *asset = NULL;
    sbf_convert_options options = {.no_gait = true};
    sbf_status status = sbfi_convert_scenes(&scene, &scene, &options, &asset, &error);
    if (asset)
      asset->version = SBF_FORMAT_VERSION; /* writers state the lowest version with all written parts */
    fuzz_check_load(status, asset, &error, sbf_packed_save_memory, sbf_packed_load_memory);
  }
  sbfi_scene_free(&scene);
  return 0;
}
