/* Assembles a scene from an importer's output: axes and units first, then nodes, materials, meshes and
 * clips. */
#include <math.h>
#include <string.h>

#include "base/diagnostic.h"
#include "base/file.h"
#include "import/scene/assembly.h"

/* Rows: which axis of the file becomes +X, +Y and +Z. FBX states them as up, front and right ("coord"). */
static bool axes_of(const int32_t stated[6], sbfi_matrix *to) {
  static const int row_of[] = {1, 2, 0};
  sbfi_matrix m = {.at[3][3] = 1};
  for (int i = 0; i < 3; i++) {
    int32_t axis = stated[2 * i], sign = stated[2 * i + 1];
    if (axis < 0 || axis > 2 || (sign != 1 && sign != -1)) return false;
    m.at[row_of[i]][axis] = sign;
  }
  double determinant = m.at[0][0] * (m.at[1][1] * m.at[2][2] - m.at[1][2] * m.at[2][1]) -
                       m.at[0][1] * (m.at[1][0] * m.at[2][2] - m.at[1][2] * m.at[2][0]) +
                       m.at[0][2] * (m.at[1][0] * m.at[2][1] - m.at[1][1] * m.at[2][0]);
  if (determinant != 1) return false; /* a repeated axis, or a left-handed file */
  *to = m;
  return true;
}

/* glTF is in metres with +Y up; assimp converts Collada to that in its root node. */
bool sbfi_assemble_frame(sbfi_assembly *a) {
  sbfi_scene *scene = a->scene;
  const char *format = scene->format;
  if (strcmp(format, "glb") == 0 || strcmp(format, "gltf") == 0 || strcmp(format, "dae") == 0)
    scene->unit_known = scene->axes_known = true;
  if (strcmp(format, "fbx") != 0) return true;
  double factor = a->raw->unit_scale_factor;
  scene->unit_known = factor >= 1e-6 && factor <= 1e9;
  if (scene->unit_known)
    scene->unit_m = factor / 100;
  else if (!sbfi_scene_warn(scene, SBF_CODE_IMPORT_UNIT, 0,
               "the file states a unit of %g cm, which is not usable: metres are assumed", factor))
    return false;
  static const int32_t none[6];
  if (memcmp(a->raw->axes, none, sizeof none) == 0) return true;
  scene->axes_known = axes_of(a->raw->axes, &scene->axes);
  return scene->axes_known || sbfi_scene_warn(scene, SBF_CODE_IMPORT_AXES, 0,
                                  "the file's axes (up %d, front %d, right %d, signs %d %d %d) do not form a "
                                  "right-handed frame: +Y up and +Z forward are assumed",
                                  (int)a->raw->axes[0], (int)a->raw->axes[2], (int)a->raw->axes[4],
                                  (int)a->raw->axes[1], (int)a->raw->axes[3], (int)a->raw->axes[5]);
}

/* Whether assimp invented the name because the file has none: "", "<STL_BINARY>", "$dummy_node". */
static bool is_invented_name(const char *name) {
  size_t length = strlen(name);
  return length == 0 || (name[0] == '<' && name[length - 1] == '>') || strcmp(name, "$dummy_node") == 0;
}

/* Names an unnamed object after its data, or after the file. */
static bool name_objects(sbfi_assembly *a) {
  const char *file = sbfi_path_name(a->scene->file), *dot = strrchr(file, '.');
  sbfi_span stem = {file, dot && dot > file ? (size_t)(dot - file) : strlen(file)};
  for (uint32_t i = 0; i < a->scene->mesh_count; i++) {
    const sbfi_scene_mesh *mesh = &a->scene->meshes[i];
    sbfi_scene_node *node = &a->nodes[mesh->node];
    if (!is_invented_name(node->name)) continue;
    node->name = is_invented_name(mesh->name) ? sbfi_scene_string(a->scene, stem) : mesh->name;
    if (!node->name) return false;
  }
  return true;
}

/* Formats with a unit that assimp 5.2.5 drops. */
static bool report_lost_unit(sbfi_assembly *a) {
  bool lost = strcmp(a->scene->format, "3mf") == 0 || strcmp(a->scene->format, "amf") == 0;
  return !lost || sbfi_scene_warn(a->scene, SBF_CODE_IMPORT_UNIT, 0,
                      "a %s file states its unit, usually millimetres, but the importer does not pass it on: "
                      "metres are assumed; use --unit 0.001 for millimetres",
                      a->scene->format);
}

static bool check_worlds(sbfi_assembly *a) {
  for (uint32_t i = 0; i < a->scene->node_count; i++)
    for (int k = 0; k < 12; k++)
      if (!(fabs(a->nodes[i].world.at[k / 4][k % 4]) <= 1e30))
        return sbfi_assembly_refuse(a, SBF_CODE_IMPORT_NOT_FINITE,
            "the product of the transforms above node \"%s\" exceeds single precision: export the file again",
            a->nodes[i].name);
  return true;
}

static bool check_content(sbfi_assembly *a) {
  if (a->scene->mesh_count || sbfi_scene_bone_count(a->scene)) return true;
  return sbfi_assembly_refuse(
      a, SBF_CODE_IMPORT_EMPTY, "the file has neither a surface nor bones that can be read");
}

sbf_status sbfi_assemble(
    sbfi_scene *scene, const sbfi_raw_scene *raw, const sbf_allocator *allocator, sbf_diagnostic *error) {
  sbfi_assembly a = {.scene = scene, .raw = raw, .allocator = allocator, .error = error};
  sbfi_arena_init(&a.scratch, allocator, 0);
  scene->generator = sbfi_scene_string(scene, raw->generator);
  bool good = scene->generator && sbfi_assemble_frame(&a) && sbfi_assemble_nodes(&a) && check_worlds(&a) &&
              sbfi_assemble_bones(&a) && sbfi_assemble_materials(&a) && sbfi_assemble_meshes(&a) &&
              name_objects(&a) && report_lost_unit(&a) && sbfi_assemble_clips(&a) && check_content(&a);
  sbfi_name_table_free(&a.names);
  sbfi_arena_free(&a.scratch);
  if (good) return SBF_OK;
  if (a.status) return a.status;
  return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while assembling the scene");
}
