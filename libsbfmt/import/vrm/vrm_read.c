/* Finds the avatar data of a glTF file: which version of VRM, its humanoid bones, its springs. */
#include <string.h>

#include "base/diagnostic.h"
#include "gltf/glb_file.h"
#include "import/vrm/vrm_reader.h"

/* Scene nodes by their numbers in the file. */
static bool find_nodes(sbfi_vrm_reader *r) {
  const sbfi_scene *scene = r->scene;
  r->number_count = sbfi_vrm_count(sbfi_json_get(r->root, "nodes"));
  r->node_of_number = sbfi_arena_allocate(&r->scratch, (size_t)r->number_count + 1, sizeof(int32_t));
  r->spring_of_node = sbfi_arena_allocate(&r->scratch, (size_t)scene->node_count + 1, sizeof(int32_t));
  if (!r->node_of_number || !r->spring_of_node) return false;
  for (uint32_t i = 0; i < r->number_count; i++) r->node_of_number[i] = SBF_NONE;
  for (uint32_t i = 0; i < scene->node_count; i++) {
    int32_t number = scene->nodes[i].number;
    r->spring_of_node[i] = SBF_NONE;
    if (number >= 0 && (uint32_t)number < r->number_count) r->node_of_number[number] = (int32_t)i;
  }
  return true;
}

/* Index of a bone by its name in either version: "upperLeg" after a side, "hips" without. */
static int bone_named(const char *name) {
  static const char *const middle[] = {"hips", "spine", "chest", "upperChest", "neck", "head"};
  static const char *const sided[] = {
      "UpperLeg", "LowerLeg", "Foot", "Toes", "Shoulder", "UpperArm", "LowerArm", "Hand"};
  for (int i = 0; i < SBFI_VRM_LEFT; i++)
    if (strcmp(name, middle[i]) == 0) return i;
  for (int i = 0; i < SBFI_VRM_RIGHT - SBFI_VRM_LEFT; i++) {
    if (strncmp(name, "left", 4) == 0 && strcmp(name + 4, sided[i]) == 0) return SBFI_VRM_LEFT + i;
    if (strncmp(name, "right", 5) == 0 && strcmp(name + 5, sided[i]) == 0) return SBFI_VRM_RIGHT + i;
  }
  return -1;
}

static void set_bone(sbfi_vrm_reader *r, const char *name, const sbfi_json *described) {
  int bone = bone_named(name);
  if (bone < 0) return;
  r->vrm->bones[bone] = sbfi_vrm_node(r, sbfi_json_get(described, "node"));
  if (r->vrm->bones[bone] == SBF_NONE)
    sbfi_vrm_warn(r, "the humanoid bone %s is a node that the scene does not have: it is left out", name);
}

/* VRM 1.0 has an object by name, VRM 0.x a list. */
static void read_humanoid(sbfi_vrm_reader *r, const sbfi_json *extension) {
  const sbfi_json *bones = sbfi_json_get(sbfi_json_get(extension, "humanoid"), "humanBones");
  for (uint32_t i = 0; bones && i < bones->count; i++) {
    if (bones->type == SBFI_JSON_OBJECT) set_bone(r, bones->names[i].at, &bones->items[i]);
    if (bones->type != SBFI_JSON_ARRAY) continue;
    const sbfi_json *name = sbfi_json_get(&bones->items[i], "bone");
    if (name && name->type == SBFI_JSON_STRING) set_bone(r, name->text.at, &bones->items[i]);
  }
}

static void mark(sbfi_scene_node *nodes, const uint8_t *has_mesh, int32_t node) {
  if (node == SBF_NONE || has_mesh[node]) return;
  nodes[node].is_bone = true;
  nodes[node].is_end = false;
}

/* Whether the last joint of a spring only marks the tip of the one before, along its +Y. */
static bool is_tip(const sbfi_scene *scene, const sbfi_vrm_spring *spring) {
  if (spring->has_tail) return false;
  int32_t node = spring->joints[spring->joint_count - 1].node;
  const sbfi_scene_node *end = &scene->nodes[node];
  double x = end->local.at[0][3], y = end->local.at[1][3], z = end->local.at[2][3];
  return end->is_end && !end->is_bone && end->parent == spring->joints[spring->joint_count - 2].node &&
         y > 0 && x * x + z * z <= 1e-6 * y * y;
}

/* Springs move nodes that need not be joints of a skin. A node with a mesh stays what it is. */
static bool mark_bones(sbfi_vrm_reader *r) {
  const sbfi_scene *scene = r->scene;
  const sbfi_vrm *vrm = r->vrm;
  sbfi_scene_node *nodes = (sbfi_scene_node *)(uintptr_t)scene->nodes; /* of the arena, being made */
  uint8_t *has_mesh = sbfi_arena_allocate(&r->scratch, (size_t)scene->node_count + 1, 1);
  if (!has_mesh) return false;
  for (uint32_t i = 0; i < scene->mesh_count; i++) has_mesh[scene->meshes[i].node] = 1;
  for (uint32_t i = 0; i < vrm->collider_count; i++) mark(nodes, has_mesh, vrm->colliders[i].node);
  for (int i = 0; i < SBFI_VRM_BONES; i++) mark(nodes, has_mesh, vrm->bones[i]);
  for (uint32_t i = 0; i < vrm->spring_count; i++) {
    mark(nodes, has_mesh, vrm->springs[i].center);
    uint32_t count = vrm->springs[i].joint_count - is_tip(scene, &vrm->springs[i]);
    for (uint32_t k = 0; k < count; k++) mark(nodes, has_mesh, vrm->springs[i].joints[k].node);
  }
  return true;
}

static bool read_extensions(sbfi_vrm_reader *r) {
  const sbfi_json *extensions = sbfi_json_get(r->root, "extensions");
  const sbfi_json *avatar = sbfi_json_get(extensions, "VRMC_vrm"), *old = sbfi_json_get(extensions, "VRM");
  const sbfi_json *springs = sbfi_json_get(extensions, "VRMC_springBone");
  if (!avatar && !old && !springs) return true;
  r->vrm = sbfi_vrm_allocate(r, 1, sizeof *r->vrm);
  if (!r->vrm || !find_nodes(r)) return false;
  for (int i = 0; i < SBFI_VRM_BONES; i++) r->vrm->bones[i] = SBF_NONE;
  r->vrm->is_avatar = avatar || old;
  r->vrm->faces_back = !avatar && old;
  read_humanoid(r, avatar ? avatar : old);
  if (springs)
    sbfi_vrm_read_springs(r, springs);
  else
    sbfi_vrm_read_old_springs(r, old);
  r->scene->vrm = r->vrm;
  return !r->no_memory && mark_bones(r);
}

sbf_status sbfi_vrm_read(sbfi_scene *scene, const uint8_t *bytes, size_t size, const sbf_allocator *allocator,
    sbf_diagnostic *error) {
  sbfi_vrm_reader r = {.scene = scene};
  sbfi_glb_file file;
  sbf_diagnostic unseen;
  sbfi_arena_init(&r.scratch, allocator, 0);
  sbf_status status =
      sbfi_glb_is_begun(bytes, size)
          ? sbfi_glb_file_read(&file, bytes, size, &r.scratch, &unseen)
          : sbfi_glb_file_parse(&file, (const char *)bytes, size, NULL, 0, &r.scratch, &unseen);
  bool good = true;
  r.root = status == SBF_OK ? file.root : NULL;
  if (status == SBF_OK) good = read_extensions(&r);
  sbfi_arena_free(&r.scratch);
  if (good && (status == SBF_OK || unseen.code != SBF_CODE_OUT_OF_MEMORY)) return SBF_OK;
  return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while reading a VRM file");
}
