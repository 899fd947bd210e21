#include "conversions.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sbfmt/validate.h"

static void note(void *user, const sbf_diagnostic *diagnostic) {
  converted *c = user;
  ck_assert_uint_gt(strlen(diagnostic->message), 10);
  if (c->note_count < CONVERTED_NOTES) c->notes[c->note_count] = *diagnostic;
  c->note_count++;
}

static void complain(void *user, const sbf_diagnostic *diagnostic) {
  (void)user;
  if (diagnostic->severity == SBF_SEVERITY_ERROR)
    fprintf(stderr, "%s at %s\n", diagnostic->message, diagnostic->path);
}

static void check_sound(const sbf_asset *asset) {
  ck_assert_uint_eq(sbf_asset_check(asset, complain, NULL, 8), 0);
  sbf_validate_options options = {.report = complain};
  sbf_validate_result result;
  ck_assert_int_eq(sbf_validate(asset, &options, &result, NULL), SBF_OK);
  ck_assert_uint_eq(result.errors, 0);
}

void converted_file(converted *c, const char *path, const sbf_convert_options *options) {
  sbf_convert_options o = options ? *options : (sbf_convert_options){0};
  sbf_diagnostic error = {0};
  *c = (converted){0};
  o.report = note;
  o.user = c;
  sbf_status status = sbf_convert(path, &o, &c->asset, &error);
  ck_assert_msg(status == SBF_OK, "%s: %s", path, error.message);
  check_sound(c->asset);
}

void converted_scene(
    converted *c, const sbfi_scene *scene, const sbfi_scene *rig, const sbf_convert_options *options) {
  sbf_convert_options o = options ? *options : (sbf_convert_options){0};
  sbf_diagnostic error = {0};
  *c = (converted){0};
  o.report = note;
  o.user = c;
  sbf_status status = sbfi_convert_scenes(scene, rig, &o, &c->asset, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
  check_sound(c->asset);
}

void converted_free(converted *c) {
  sbf_asset_free(c->asset);
  c->asset = NULL;
}

uint32_t converted_count(const converted *c, sbf_code code) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < c->note_count && i < CONVERTED_NOTES; i++)
    count += c->notes[i].code == (int32_t)code;
  return count;
}

const sbf_diagnostic *converted_note(const converted *c, sbf_code code) {
  for (uint32_t i = 0; i < c->note_count && i < CONVERTED_NOTES; i++)
    if (c->notes[i].code == (int32_t)code) return &c->notes[i];
  return NULL;
}

int32_t bone_named(const sbf_asset *a, const char *name) {
  for (uint32_t i = 0; i < a->bones.count; i++)
    if (strcmp(a->bones.at[i].name, name) == 0) return (int32_t)i;
  ck_abort_msg("no bone is named %s", name);
  return SBF_NONE;
}

const sbf_soft_body *body_named(const sbf_asset *a, const char *name) {
  for (uint32_t i = 0; i < a->soft_bodies.count; i++)
    if (strcmp(a->soft_bodies.at[i].name, name) == 0) return &a->soft_bodies.at[i];
  ck_abort_msg("no body is named %s", name);
  return NULL;
}

const sbf_render_mesh *mesh_named(const sbf_asset *a, const char *name) {
  for (uint32_t i = 0; i < a->render_meshes.count; i++)
    if (strcmp(a->render_meshes.at[i].name, name) == 0) return &a->render_meshes.at[i];
  ck_abort_msg("no render mesh is named %s", name);
  return NULL;
}

const sbf_joint *joint_named(const sbf_asset *a, const char *name) {
  for (uint32_t i = 0; i < a->joints.count; i++)
    if (strcmp(a->joints.at[i].name, name) == 0) return &a->joints.at[i];
  ck_abort_msg("no joint is named %s", name);
  return NULL;
}

void check_near(sbf_vec3 is, double x, double y, double z, double within) {
  double away = sqrt(pow((double)is.x - x, 2) + pow((double)is.y - y, 2) + pow((double)is.z - z, 2));
  ck_assert_msg(
      away <= within, "%g %g %g is not %g %g %g", (double)is.x, (double)is.y, (double)is.z, x, y, z);
}

/* --- Scenes by hand ---------------------------------------------------------------------------------- */

enum { MAX_NODES = 96, MAX_MESHES = 48, MAX_CLIPS = 4 };

static void *give(sbfi_scene *scene, size_t count, size_t size) {
  void *memory = sbfi_arena_allocate(&scene->arena, count, size);
  ck_assert_ptr_nonnull(memory);
  return memory;
}

void scene_begin(sbfi_scene *scene) {
  static const char path[] = "scene.txt";
  const char *file = harness_scratch(path);
  ck_assert(harness_write(file, "made by hand", 12));
  ck_assert(sbfi_scene_init(scene, NULL, 0, file));
  scene->format = "glb";
  scene->nodes = give(scene, MAX_NODES, sizeof *scene->nodes);
  scene->meshes = give(scene, MAX_MESHES, sizeof *scene->meshes);
  scene->clips = give(scene, MAX_CLIPS, sizeof *scene->clips);
}

int32_t scene_node(
    sbfi_scene *scene, const char *name, int32_t parent, bool bone, double x, double y, double z) {
  ck_assert_uint_lt(scene->node_count, MAX_NODES);
  sbfi_scene_node *node = (sbfi_scene_node *)(uintptr_t)&scene->nodes[scene->node_count];
  *node = (sbfi_scene_node){
      .name = name, .parent = parent, .local = sbfi_matrix_identity(), .is_bone = bone, .number = SBF_NONE};
  node->local.at[0][3] = x;
  node->local.at[1][3] = y;
  node->local.at[2][3] = z;
  return (int32_t)scene->node_count++;
}

sbfi_matrix *scene_local(sbfi_scene *scene, int32_t node) {
  return &((sbfi_scene_node *)(uintptr_t)&scene->nodes[node])->local;
}

sbfi_scene_mesh *scene_box(
    sbfi_scene *scene, int32_t node, double half, double x, double y, double z, bool inside_out) {
  /* Points are numbered by x + 2 y + 4 z; the face before the first axis, then the one behind it. */
  static const uint32_t faces[6][4] = {
      {1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3}, {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
  static const sbf_vec3 outwards[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  ck_assert_uint_lt(scene->mesh_count, MAX_MESHES);
  sbfi_scene_mesh *mesh = (sbfi_scene_mesh *)(uintptr_t)&scene->meshes[scene->mesh_count++];
  sbf_vec3 *points = give(scene, 8, sizeof *points), *normals = give(scene, 6, sizeof *normals);
  uint32_t *sources = give(scene, 8, sizeof *sources), *starts = give(scene, 7, sizeof *starts);
  uint32_t *corners = give(scene, 24, sizeof *corners);
  int32_t *materials = give(scene, 6, sizeof *materials), *corner_normals = give(scene, 24, sizeof *corners);
  int32_t *corner_uvs = give(scene, 24, sizeof *corner_uvs);
  sbf_vec2 *uvs = give(scene, 8, sizeof *uvs);
  sbfi_scene_uvs *set = give(scene, 1, sizeof *set);
  for (uint32_t i = 0; i < 8; i++) {
    points[i] = (sbf_vec3){(float)(x + (i & 1 ? half : -half)), (float)(y + (i & 2 ? half : -half)),
        (float)(z + (i & 4 ? half : -half))};
    sources[i] = i;
    uvs[i] = (sbf_vec2){(float)i, 0.5f};
  }
  for (uint32_t f = 0; f < 6; f++) {
    starts[f] = 4 * f;
    materials[f] = SBF_NONE;
    float sign = inside_out ? -1 : 1;
    normals[f] = (sbf_vec3){sign * outwards[f].x, sign * outwards[f].y, sign * outwards[f].z};
    for (uint32_t k = 0; k < 4; k++) {
      corners[4 * f + k] = faces[f][inside_out ? 3 - k : k];
      corner_normals[4 * f + k] = (int32_t)f;
      corner_uvs[4 * f + k] = (int32_t)corners[4 * f + k];
    }
  }
  starts[6] = 24;
  *set = (sbfi_scene_uvs){"map", 8, uvs, corner_uvs};
  *mesh = (sbfi_scene_mesh){.name = "box",
      .node = node,
      .point_count = 8,
      .points = points,
      .point_sources = sources,
      .polygon_count = 6,
      .corner_count = 24,
      .polygon_starts = starts,
      .polygon_materials = materials,
      .corner_points = corners,
      .normals.count = 6,
      .normals.at = normals,
      .normals.corner_index = corner_normals,
      .uv_set_count = 1,
      .uv_sets = set};
  return mesh;
}

void scene_skin(sbfi_scene *scene, sbfi_scene_mesh *mesh, uint32_t joint_count, const int32_t *joints,
    const uint32_t *joint_of_point) {
  sbfi_scene_joint *made = give(scene, joint_count, sizeof *made);
  uint32_t *starts = give(scene, mesh->point_count + 1, sizeof *starts);
  uint32_t *indices = give(scene, mesh->point_count, sizeof *indices);
  float *weights = give(scene, mesh->point_count, sizeof *weights);
  scene_end(scene);
  for (uint32_t j = 0; j < joint_count; j++) {
    sbfi_matrix to_joint;
    ck_assert(sbfi_matrix_invert(&scene->nodes[joints[j]].world, &to_joint));
    made[j] = (sbfi_scene_joint){joints[j], sbfi_matrix_multiply(&to_joint, &scene->nodes[mesh->node].world)};
  }
  for (uint32_t i = 0; i < mesh->point_count; i++) {
    starts[i + 1] = i + 1;
    indices[i] = joint_of_point[i];
    weights[i] = 1;
  }
  mesh->skin.joint_count = joint_count;
  mesh->skin.joints = made;
  mesh->skin.starts = starts;
  mesh->skin.joint_index = indices;
  mesh->skin.weights = weights;
}

sbfi_scene_channel *scene_clip(sbfi_scene *scene, const char *name, float duration_s, uint32_t count) {
  ck_assert_uint_lt(scene->clip_count, MAX_CLIPS);
  sbfi_scene_clip *clip = (sbfi_scene_clip *)(uintptr_t)&scene->clips[scene->clip_count++];
  sbfi_scene_channel *channels = give(scene, count, sizeof *channels);
  *clip = (sbfi_scene_clip){name, duration_s, count, channels};
  return channels;
}

void scene_end(sbfi_scene *scene) {
  sbfi_scene_set_worlds((sbfi_scene_node *)(uintptr_t)scene->nodes, scene->node_count);
}
