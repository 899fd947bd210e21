/* Runs the conversion: reads scenes, transforms them to asset space, creates an asset. */
#include "sbfmt/convert.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/file.h"
#include "base/sha256.h"
#include "import/convert/conversion.h"
#include "import/convert/convert_attachments.h"
#include "import/convert/convert_pins.h"
#include "import/convert/convert_summary.h"
#include "import/convert/convert_tets.h"
#include "import/convert/guess_moduli.h"
#include "import/convert/join_borders.h"
#include "import/convert/propose_limits.h"
#include "import/convert/propose_softness.h"
#include "import/gait/locomotion.h"
#include "import/gait/propose_gait.h"
#include "import/gait/rest_pose.h"
#include "import/paper/dialect2012.h"
#include "import/physics/physics.h"
#include "import/rigging/rigging.h"
#include "import/scene/bind_pose.h"
#include "import/vrm/vrm.h"
#include "model/options.h"

/* Matrix from file axes and unit to asset space. Options override the file. */
static sbfi_matrix matrix_to_asset(const sbfi_scene *scene, const sbf_convert_options *options) {
  sbfi_matrix m = scene->axes;
  if (scene->vrm && scene->vrm->faces_back) m.at[0][0] = m.at[2][2] = -1;
  if (options->up) {
    static const sbfi_matrix z_up = {{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}}};
    m = options->up == 'z' ? z_up : sbfi_matrix_identity();
  }
  if (options->forward) { /* keeps up, maps forward to +Z and completes with +X */
    double forward[3] = {0, 0, 0};
    forward[options->forward[strlen(options->forward) - 1] - 'x'] = options->forward[0] == '-' ? -1 : 1;
    for (int k = 0; k < 3; k++) {
      m.at[2][k] = forward[k];
      m.at[0][k] = m.at[1][(k + 1) % 3] * forward[(k + 2) % 3] - m.at[1][(k + 2) % 3] * forward[(k + 1) % 3];
    }
  }
  double unit = options->unit_m > 0 ? options->unit_m : scene->unit_m;
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 3; k++) m.at[r][k] *= unit;
  return m;
}

static sbf_status hash_file(sbfi_conversion *c, const char *path, char text[SBFI_SHA256_TEXT_SIZE]) {
  sbfi_file_content content;
  sbf_status status = sbfi_file_map(path, 0, &c->scratch.allocator, &content, c->error);
  if (status != SBF_OK) return status;
  sbfi_sha256 hash;
  uint8_t digest[SBFI_SHA256_BYTES];
  sbfi_sha256_init(&hash);
  sbfi_sha256_update(&hash, content.at, content.size);
  sbfi_sha256_finish(&hash, digest);
  sbfi_sha256_format(digest, text);
  sbfi_file_content_free(&content);
  return SBF_OK;
}

static sbf_status describe_sources(sbfi_conversion *c) {
  const sbfi_scene *scenes[2] = {c->scene, c->rig && c->rig != c->scene ? c->rig : NULL};
  sbf_source *sources = sbfi_convert_allocate(c, 2, sizeof *sources);
  if (!sources) return sbfi_convert_no_memory(c);
  uint32_t count = 0;
  for (int i = 0; i < 2 && scenes[i]; i++, count++) {
    sbf_source_init(&sources[i]);
    char hex[SBFI_SHA256_TEXT_SIZE];
    sbf_status status = hash_file(c, scenes[i]->path, hex);
    if (status != SBF_OK) return status;
    sources[i].path = sbf_asset_copy_text(c->asset, sbfi_path_name(scenes[i]->file));
    sources[i].sha256 = sbf_asset_copy_text(c->asset, hex);
    if (!sources[i].path || !sources[i].sha256) return sbfi_convert_no_memory(c);
  }
  const char *name = sources[0].path, *dot = strrchr(name, '.');
  size_t length = dot && dot != name ? (size_t)(dot - name) : strlen(name);
  char *title = sbfi_convert_allocate(c, length + 1, 1);
  if (!title) return sbfi_convert_no_memory(c);
  memcpy(title, name, length);
  c->asset->info.title = title;
  c->asset->info.tool = "sbfmt";
  c->asset->info.sources = (sbf_source_list){sources, count};
  return SBF_OK;
}

static void forward_warnings(sbfi_conversion *c, const sbfi_scene *scene) {
  for (uint32_t i = 0; i < scene->warning_count; i++) sbfi_report(&c->reporter, &scene->warnings[i]);
}

/* Converts a tetrahedral mesh to one body without a rig or materials. */
static sbf_status run_tet_passes(sbfi_conversion *c, const sbfi_tet_mesh *tets) {
  sbf_status status = describe_sources(c);
  return status == SBF_OK ? sbfi_convert_tets(c, tets, c->asset->info.title) : status;
}

static sbf_status run_paper_passes(sbfi_conversion *c, const sbfi_paper_model *paper) {
  sbf_status status = describe_sources(c);
  return status == SBF_OK ? sbfi_convert_paper(c, paper, c->asset->info.title) : status;
}

/* Reports the number of merged vertices. assimp does not record which corners shared a vertex, so points
 * that the author kept separate at one position are merged too. */
static void report_joined_points(sbfi_conversion *c) {
  uint64_t vertices = 0, points = 0;
  for (uint32_t i = 0; i < c->scene->mesh_count; i++) {
    vertices += c->scene->meshes[i].vertex_count;
    points += c->scene->meshes[i].vertex_count ? c->scene->meshes[i].point_count : 0;
  }
  if (points < vertices)
    sbfi_convert_warn(c, SBF_CODE_IMPORT_POINTS_JOINED,
        "%llu vertices of the file became %llu points: vertices of an object at one position that move "
        "together "
        "were merged",
        (unsigned long long)vertices, (unsigned long long)points);
}

/* The passes of a file with its own rigid bodies: no gait, no soft parts. */
static sbf_status run_physics_passes(sbfi_conversion *c) {
  static sbf_status (*const passes[])(sbfi_conversion *) = {describe_sources, sbfi_convert_skeleton,
      sbfi_match_sections, sbfi_convert_materials, sbfi_convert_meshes, sbfi_measure_leaf_bones,
      sbfi_physics_convert, sbfi_convert_clips};
  sbf_status status = SBF_OK;
  report_joined_points(c);
  for (size_t i = 0; i < sizeof passes / sizeof *passes && status == SBF_OK; i++) status = passes[i](c);
  return status;
}

static sbf_status run_passes(sbfi_conversion *c, const sbf_convert_options *options) {
  if (c->physics && c->physics->is_simulated) return run_physics_passes(c);
  if (c->scene->mesh_count == 0 && !c->rig)
    return sbfi_diagnose(c->error, SBF_CODE_IMPORT_EMPTY,
        "%s has neither a mesh nor a skeleton: there is nothing to convert", c->scene->file);
  if (c->scene->mesh_count == 0)
    sbfi_convert_warn(c, SBF_CODE_IMPORT_NO_MESH,
        "the file has a skeleton and no mesh, so the bundle has bones only: use a mesh file as the input and "
        "this file with --rig");
  report_joined_points(c);
  if (!c->rig)
    sbfi_convert_warn(c, SBF_CODE_IMPORT_NO_RIG,
        "the file has no skeleton, so its objects become bodies without pins: add a skeleton with --rig");
  static sbf_status (*const passes[])(sbfi_conversion *) = {describe_sources, sbfi_convert_skeleton,
      sbfi_convert_humanoid, sbfi_rig_input, sbfi_convert_check_pins, sbfi_match_sections,
      sbfi_convert_materials, sbfi_join_borders, sbfi_convert_meshes, sbfi_measure_leaf_bones,
      sbfi_evaluate_gait, sbfi_report_lying, sbfi_face_ahead, sbfi_propose_gait, sbfi_report_other_skeletons,
      sbfi_stand_on_ground, sbfi_convert_springs, sbfi_convert_joints, sbfi_convert_attachments,
      sbfi_propose_limits, sbfi_convert_clips, sbfi_propose_rest_pose, sbfi_propose_softness};
  for (size_t i = 0; i < sizeof passes / sizeof *passes; i++) {
    bool of_gait = passes[i] == sbfi_evaluate_gait || passes[i] == sbfi_report_lying ||
                   passes[i] == sbfi_face_ahead || passes[i] == sbfi_propose_gait;
    if (of_gait && options->no_gait) continue;
    bool faces_ahead = options->forward || (c->rig && c->rig->vrm && c->rig->vrm->is_avatar);
    if (passes[i] == sbfi_face_ahead && faces_ahead) continue;
    sbf_status status = passes[i](c);
    if (status != SBF_OK) return status;
  }
  return SBF_OK;
}

/* Reads a scene in its bind pose, which becomes the asset's rest pose. */
static sbf_status read_scene(
    sbfi_scene *scene, const char *path, const sbfi_scene_options *options, sbf_diagnostic *error) {
  sbf_status status = sbfi_scene_read(scene, path, options, error);
  if (status != SBF_OK || sbfi_scene_apply_bind_pose(scene)) return status;
  status = sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while reading %s", path);
  return sbfi_scene_fail(scene, error, status);
}

/* Input: scenes, or tetrahedra, or a model of the 2012 dialect. In the last two cases the scene only names
 * the file. */
typedef struct readings {
  const sbfi_scene *scene, *rig;
  sbfi_physics *physics;
  const sbfi_tet_mesh *tets;
  const sbfi_paper_model *paper;
} readings;

static sbf_status convert_readings(
    const readings *from, const sbf_convert_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  const sbfi_scene *scene = from->scene, *rig = from->rig;
  sbfi_conversion c = {.scene = scene,
      .rig = rig,
      .rig_file = rig != scene ? rig : NULL,
      .physics = from->physics,
      .options = options,
      .reporter = {options->report, options->user, 0, 0},
      .error = error};
  c.to_asset = matrix_to_asset(scene, options);
  c.rig_to_asset = rig == scene || !rig ? c.to_asset : matrix_to_asset(rig, &(sbf_convert_options){0});
  sbfi_arena_init(&c.scratch, options->allocator, 0);
  sbfi_array_init(&c.ids.slots, options->allocator, sizeof(char *));
  c.asset = sbf_asset_create(options->allocator);
  sbf_status status = c.asset ? SBF_OK : sbfi_convert_no_memory(&c);
  if (status == SBF_OK && sbfi_matrix_determinant(&c.to_asset) == 0)
    status =
        sbfi_diagnose(error, SBF_CODE_BAD_CALL, "forward %s of %s is its upward axis: state another, or --up",
            options->forward ? options->forward : "", scene->file);
  if (status == SBF_OK) {
    sbfi_summarize(&c, from->tets, from->paper, options);
    forward_warnings(&c, scene);
    if (rig && rig != scene) forward_warnings(&c, rig);
    status = from->tets    ? run_tet_passes(&c, from->tets)
             : from->paper ? run_paper_passes(&c, from->paper)
                           : run_passes(&c, options);
    if (status == SBF_OK && !from->paper) {
      sbfi_check_size(&c);
      if (!options->keep_modulus) sbfi_guess_moduli(&c);
    }
  }
  sbfi_array_free(&c.ids.slots);
  sbfi_arena_free(&c.scratch);
  if (status != SBF_OK) {
    if (c.keep_misfit && options->rigging.misfit)
      *options->rigging.misfit = c.asset;
    else
      sbf_asset_free(c.asset);
    return status;
  }
  *asset = c.asset;
  return SBF_OK;
}

sbf_status sbfi_convert_scenes(const sbfi_scene *scene, const sbfi_scene *rig,
    const sbf_convert_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  return convert_readings(&(readings){.scene = scene, .rig = rig}, options, asset, error);
}

sbf_status sbfi_convert_own_scene(
    sbfi_scene *scene, const sbf_convert_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  sbfi_physics *physics;
  sbf_status status = sbfi_physics_read(&physics, scene, options->allocator, error);
  if (status != SBF_OK) return status;
  bool has_rig = sbfi_scene_bone_count(scene) || (physics && physics->is_simulated);
  const readings from = {.scene = scene, .rig = has_rig ? scene : NULL, .physics = physics};
  status = convert_readings(&from, options, asset, error);
  sbfi_physics_free(physics);
  return status;
}

/* Converts a file without a scene: tetrahedra or the 2012 dialect. */
static sbf_status convert_other_file(const char *input, bool is_paper, const sbf_convert_options *options,
    sbf_asset **asset, sbf_diagnostic *error) {
  sbfi_scene scene;
  sbfi_tet_mesh tets;
  sbfi_paper_model paper;
  readings from = {.scene = &scene};
  if (options->rig)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "%s %s and cannot use a rig: %s", input,
        is_paper ? "has its own skeleton" : "has only tetrahedra",
        is_paper ? "leave out --rig"
                 : "convert the surface as OBJ or PLY with --rig, so that the build makes the tetrahedra, or "
                   "leave out --rig for a body without bones");
  if (!sbfi_scene_init(&scene, options->allocator, 0, input))
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while reading %s", input);
  sbf_status status = is_paper
                          ? sbfi_paper_read(&paper, input, options->allocator, error)
                          : sbfi_tet_mesh_read(&tets, input, options->allocator, (uint64_t)4 << 30, error);
  if (status == SBF_OK) {
    if (is_paper)
      from.paper = &paper;
    else
      from.tets = &tets;
    status = convert_readings(&from, options, asset, error);
    if (is_paper)
      sbfi_paper_free(&paper);
    else
      sbfi_tet_mesh_free(&tets);
  }
  sbfi_scene_free(&scene);
  return status;
}

sbf_status sbf_convert(
    const char *input, const sbf_convert_options *options, sbf_asset **asset, sbf_diagnostic *error) {
  sbf_convert_options taken = {0};
  sbf_diagnostic unseen;
  if (!error) error = &unseen;
  *asset = NULL;
  if (!sbfi_options_copy(&taken, sizeof taken, options))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbf_convert_options has a size that no version of the library had: initialize it with the defaults");
  options = &taken;
  if (options->unit_m < 0 || !isfinite(options->unit_m) || (options->up && !strchr("yz", options->up)))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "unit must be above 0 and up must be y or z");
  const char *forward = options->forward ? options->forward + (options->forward[0] == '-') : "x";
  if (strcmp(forward, "x") != 0 && strcmp(forward, "y") != 0 && strcmp(forward, "z") != 0)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "forward must be one of x, -x, y, -y, z and -z");
  if (options->gait && sbfi_locomotion_named(options->gait) == SBFI_LOCOMOTION_KINDS)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "gait must be one of walk, swim, fly, slither, crawl, roll and none, not '%s'", options->gait);
  if ((unsigned)options->limits > SBF_CONVERT_LIMITS_REPTILE)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "the options have an unknown kind of limits");
  if (!(options->pinning.goal_minimum >= 0 && options->pinning.goal_minimum <= 1 &&
          options->pinning.goal_maximum >= 0 && options->pinning.goal_maximum <= 1 &&
          options->pinning.goal_stiffness >= 0 && options->pinning.goal_stiffness <= FLT_MAX))
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "the minimum and maximum of goals must be from 0 to 1, and their stiffness at least 0");

  bool is_paper = sbfi_paper_supports(input);
  if (is_paper || sbfi_tet_mesh_supports(input))
    return convert_other_file(input, is_paper, options, asset, error);
  sbfi_scene_options reading = {.allocator = options->allocator, .helper_path = options->import_helper};
  sbfi_scene scene, rig_scene;
  sbf_status status = read_scene(&scene, input, &reading, error);
  if (status != SBF_OK) return status;
  if (options->rig) {
    status = read_scene(&rig_scene, options->rig, &reading, error);
    if (status == SBF_OK && sbfi_scene_bone_count(&rig_scene) == 0)
      status = sbfi_diagnose(error, SBF_CODE_IMPORT_NO_BONES,
          "the rig file %s has no skeleton: use a file with bones", options->rig);
    if (status == SBF_OK && sbfi_physics_is_named(&scene, options->allocator))
      sbfi_scene_warn(&scene, SBF_CODE_IMPORT_IGNORED, 0,
          "the file's rigid bodies and joints are left out, because the rig is another file: leave out --rig "
          "to keep them");
    if (status == SBF_OK) status = sbfi_convert_scenes(&scene, &rig_scene, options, asset, error);
  } else {
    status = sbfi_convert_own_scene(&scene, options, asset, error);
    if (status != SBF_OK && !error->file[0]) sbfi_copy_text(error->file, sizeof error->file, scene.file);
  }
  if (options->rig) sbfi_scene_free(&rig_scene);
  sbfi_scene_free(&scene);
  return status;
}
