#include "import/scene/assembly.h"

#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "import/scene/assimp_bridge.h"
#include "scene_of_stream.h"

/* Two triangles of a unit square in the plane z, with a corner of their own each. */
#define SQUARE(x, y, z)                                                                                      \
  { x, y, z, x + 1, y, z, x + 1, y + 1, z, x, y, z, x + 1, y + 1, z, x, y + 1, z }

/* A node "n" with the meshes 0 to count - 1. */
static void one_node(stream_builder *s, uint32_t count) {
  stream_header(s);
  stream_u32(s, 1);
  stream_node(s, "n", -1, SBFI_STREAM_PLAIN, 0, 0, 0);
  stream_u32(s, count);
  for (uint32_t i = 0; i < count; i++) stream_u32(s, i);
}

/* What follows the meshes where there is nothing more. */
static void finish(stream_builder *s) {
  for (int i = 0; i < 3; i++) stream_none(s);
  stream_end(s);
}

START_TEST(corners_at_one_position_are_one_point)
{
  static const float square[] = SQUARE(0, 0, 0);
  stream_builder s = {0};
  one_node(&s, 1);
  stream_u32(&s, 1);
  stream_triangles(&s, "square", 0, square, 2);
  finish(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "glb");
  const sbfi_scene_mesh *m = &scene.meshes[0];
  ck_assert_uint_eq(m->point_count, 4);
  ck_assert_uint_eq(m->vertex_count, 6);
  static const uint32_t points[] = {0, 1, 2, 0, 2, 3};
  ck_assert_int_eq(memcmp(m->vertex_points, points, sizeof points), 0);
  ck_assert_int_eq(memcmp(m->corner_points, points, sizeof points), 0);
  ck_assert_int_eq(m->polygon_materials[0], SBF_NONE);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(zeros_are_equal_and_the_last_bit_differs)
{
  static const float torn[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, -0.0f, 0, 0, 1.0000001f, 0, 0, 0, 1, -0.0f};
  stream_builder s = {0};
  one_node(&s, 1);
  stream_u32(&s, 1);
  stream_triangles(&s, "torn", 0, torn, 2);
  finish(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "glb");
  ck_assert_uint_eq(scene.meshes[0].point_count, 4);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(parts_of_a_node_become_one_mesh)
{
  static const float left[] = SQUARE(0, 0, 0), right[] = SQUARE(1, 0, 0);
  stream_builder s = {0};
  one_node(&s, 2);
  stream_u32(&s, 2);
  stream_triangles(&s, "body-0", 2, left, 2);
  stream_triangles(&s, "body-1", 0, right, 2);
  stream_u32(&s, 3);
  stream_material(&s, "red", "");
  stream_material(&s, "unused", "unused.png");
  stream_material(&s, "blue", "folder\\blue.png");
  stream_none(&s);
  stream_none(&s);
  stream_end(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "glb");
  ck_assert_uint_eq(scene.mesh_count, 1);
  const sbfi_scene_mesh *m = &scene.meshes[0];
  ck_assert_str_eq(m->name, "body");
  ck_assert_uint_eq(m->point_count, 6);
  ck_assert_uint_eq(scene.material_count, 2);
  ck_assert_str_eq(scene.materials[m->polygon_materials[0]].name, "blue");
  ck_assert_str_eq(scene.materials[m->polygon_materials[2]].name, "red");
  ck_assert_uint_eq(scene.image_count, 1);
  ck_assert_str_eq(
      scene.images[scene.materials[m->polygon_materials[0]].base_color_image].path, "folder/blue.png");
  sbfi_scene_free(&scene);
}
END_TEST

/* Two sections that touch stay apart, and one mesh under two nodes becomes two. */
START_TEST(nodes_are_never_welded)
{
  static const float square[] = SQUARE(0, 0, 0);
  stream_builder s = {0};
  stream_header(&s);
  stream_u32(&s, 2);
  for (int i = 0; i < 2; i++) {
    stream_node(&s, i ? "b" : "a", -1, SBFI_STREAM_PLAIN, 0, 0, 0);
    stream_u32(&s, 1);
    stream_u32(&s, 0);
  }
  stream_u32(&s, 1);
  stream_triangles(&s, "square", 0, square, 2);
  finish(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "glb");
  ck_assert_uint_eq(scene.mesh_count, 2);
  ck_assert_uint_eq(scene.meshes[0].point_count, 4);
  ck_assert_uint_eq(scene.meshes[1].point_count, 4);
  ck_assert_int_eq(scene.meshes[1].node, 1);
  sbfi_scene_free(&scene);
}
END_TEST

/* A mesh of points and lines beside a quad and a pentagon. */
START_TEST(polygons_keep_their_sides_and_lines_are_left_out)
{
  static const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5f, 2, 0};
  static const uint32_t sizes[] = {2, 4, 1, 5}, corners[] = {0, 1, 0, 1, 2, 3, 4, 0, 1, 2, 4, 3};
  stream_builder s = {0};
  one_node(&s, 1);
  stream_u32(&s, 1);
  stream_string(&s, "house");
  stream_u32(&s, 0);
  stream_u32(&s, 5);
  stream_f32s(&s, positions, 15);
  stream_u32(&s, 0);
  stream_u32(&s, 0);
  stream_none(&s);
  stream_u32(&s, 4);
  stream_bytes(&s, sizes, sizeof sizes);
  stream_u32(&s, 12);
  stream_bytes(&s, corners, sizeof corners);
  stream_none(&s);
  stream_none(&s);
  finish(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "dae");
  const sbfi_scene_mesh *m = &scene.meshes[0];
  ck_assert_uint_eq(m->polygon_count, 2);
  ck_assert_uint_eq(m->polygon_starts[1], 4);
  ck_assert_uint_eq(m->polygon_starts[2], 9);
  ck_assert_uint_eq(m->corner_points[7], 4);
  ck_assert_uint_eq(scene.warning_count, 1);
  ck_assert_int_eq(scene.warnings[0].code, SBF_CODE_IMPORT_IGNORED);
  sbfi_scene_free(&scene);
}
END_TEST

static void put_bone(
    stream_builder *s, const char *name, uint32_t count, const uint32_t *vertices, const float *weights) {
  stream_string(s, name);
  stream_translation(s, 0, 0, 0);
  stream_u32(s, count);
  stream_bytes(s, vertices, count * sizeof *vertices);
  stream_f32s(s, weights, count);
}

/* The head of a mesh of 3 * count vertices up to its bones. */
static void put_triangles_head(stream_builder *s, const float *positions, uint32_t count) {
  stream_triangles(s, "skinned", 0, positions, count);
  s->size -= 8; /* the empty lists of bones and shapes */
}

/* Vertices 0 and 3, and 2 and 4, lie at one place; 0 and 3 move differently. */
START_TEST(points_that_move_differently_stay_separate)
{
  static const float square[] = SQUARE(0, 0, 0);
  static const uint32_t upper[] = {0, 2, 4, 4}, lower[] = {3, 2, 4, 1};
  static const float upper_weights[] = {1, 0.5f, 0.25f, 0.25f}, lower_weights[] = {1, 0.5f, 0.5f, 0};
  stream_builder s = {0};
  stream_header(&s);
  stream_u32(&s, 4);
  stream_node(&s, "n", -1, SBFI_STREAM_PLAIN, 0, 0, 0);
  stream_u32(&s, 1);
  stream_u32(&s, 0);
  stream_node(&s, "lower", -1, SBFI_STREAM_PLAIN, 0, 0, 0);
  stream_none(&s);
  stream_node(&s, "upper", 1, SBFI_STREAM_PLAIN, 0, 1, 0);
  stream_none(&s);
  stream_node(&s, "tip", 2, SBFI_STREAM_PLAIN, 0, 1, 0);
  stream_none(&s);
  stream_u32(&s, 1);
  put_triangles_head(&s, square, 2);
  stream_u32(&s, 3);
  put_bone(&s, "upper", 4, upper, upper_weights);
  put_bone(&s, "lower", 4, lower, lower_weights);
  put_bone(&s, "nobody", 4, lower, lower_weights);
  stream_none(&s);
  finish(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "glb");
  const sbfi_scene_mesh *m = &scene.meshes[0];
  ck_assert_uint_eq(m->point_count, 5);
  ck_assert_uint_eq(m->vertex_points[2], m->vertex_points[4]);
  ck_assert_uint_ne(m->vertex_points[0], m->vertex_points[3]);
  ck_assert_uint_eq(m->skin.joint_count, 2);
  ck_assert_int_eq(m->skin.joints[0].node, 2);
  ck_assert_uint_eq(m->skin.starts[1] - m->skin.starts[0], 1);
  ck_assert_uint_eq(m->skin.starts[2] - m->skin.starts[1], 0); /* its only weight is 0 */
  ck_assert_uint_eq(m->skin.starts[3] - m->skin.starts[2], 2);
  ck_assert_uint_eq(sbfi_scene_bone_count(&scene), 2);
  ck_assert_uint_eq(scene.warning_count, 1); /* no node is named nobody: it is a group of the points */
  ck_assert_uint_eq(m->group_count, 1);
  ck_assert_str_eq(m->groups[0].name, "nobody");
  ck_assert_float_eq(m->groups[0].weights[m->vertex_points[3]], 1);
  ck_assert_float_eq(m->groups[0].weights[m->vertex_points[2]], 0.5f);
  ck_assert_float_eq(m->groups[0].weights[m->vertex_points[0]], 0);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(points_of_different_shape_keys_stay_separate)
{
  static const float square[] = SQUARE(0, 0, 0);
  float moved[18];
  memcpy(moved, square, sizeof moved);
  moved[3 * 3 + 2] = 1; /* vertex 3, which lies on vertex 0 */
  stream_builder s = {0};
  one_node(&s, 1);
  stream_u32(&s, 1);
  put_triangles_head(&s, square, 2);
  stream_none(&s);
  stream_u32(&s, 1);
  stream_string(&s, "open");
  stream_f32(&s, 0.25f);
  stream_f32s(&s, moved, 18);
  finish(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "glb");
  const sbfi_scene_mesh *m = &scene.meshes[0];
  ck_assert_uint_eq(m->point_count, 5);
  ck_assert_uint_eq(m->shape_count, 1);
  ck_assert_str_eq(m->shapes[0].name, "open");
  ck_assert_float_eq(m->shapes[0].weight, 0.25f);
  ck_assert_float_eq(m->shapes[0].delta[m->vertex_points[3]].z, 1);
  ck_assert_float_eq(m->shapes[0].delta[m->vertex_points[0]].z, 0);
  sbfi_scene_free(&scene);
}
END_TEST

/* The bone "Head" and the section "Head": a skin and a clip mean the bone, whichever comes first. */
START_TEST(a_name_means_the_bone)
{
  static const float square[] = SQUARE(0, 0, 0);
  static const uint32_t vertices[] = {0, 1};
  static const float weights[] = {1, 1};
  stream_builder s = {0};
  stream_header(&s);
  stream_u32(&s, 3);
  stream_node(&s, "Head", -1, SBFI_STREAM_PLAIN, 0, 0, 0);
  stream_u32(&s, 1);
  stream_u32(&s, 0);
  stream_node(&s, "Head", -1, SBFI_STREAM_PLAIN, 0, 0, 0);
  stream_none(&s);
  stream_node(&s, "Head", 1, SBFI_STREAM_PLAIN, 0, 0, 0);
  stream_none(&s);
  stream_u32(&s, 1);
  put_triangles_head(&s, square, 2);
  stream_u32(&s, 1);
  put_bone(&s, "Head", 2, vertices, weights);
  stream_none(&s);
  stream_none(&s);
  stream_none(&s);
  stream_u32(&s, 1);
  stream_string(&s, "nod");
  stream_f64(&s, 1);
  stream_f64(&s, 1);
  stream_u32(&s, 1);
  stream_string(&s, "Head");
  stream_u32(&s, 1);
  stream_f64(&s, 0);
  stream_f32s(&s, square, 3);
  stream_none(&s);
  stream_none(&s);
  stream_end(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "glb");
  ck_assert_int_eq(scene.meshes[0].skin.joints[0].node, 1);
  ck_assert_int_eq(scene.clips[0].channels[0].node, 1);
  ck_assert_uint_eq(scene.warning_count, 1); /* of the two without a mesh it could be either */
  ck_assert_int_eq(scene.warnings[0].code, SBF_CODE_IMPORT_NAME_AMBIGUOUS);
  sbfi_scene_free(&scene);
}
END_TEST

static void bones_of(const char *format, sbfi_scene *scene) {
  static const float square[] = SQUARE(0, 0, 0);
  static const uint32_t vertices[] = {0, 1};
  static const float weights[] = {1, 1};
  stream_builder s = {0};
  stream_header(&s);
  stream_u32(&s, 8);
  static const struct {
    const char *name;
    int32_t parent;
    sbfi_stream_kind kind;
  } nodes[] = {{"root", -1, SBFI_STREAM_PLAIN}, {"skin", 0, SBFI_STREAM_PLAIN},
      {"armature", 0, SBFI_STREAM_NO_BONE}, {"hips", 2, SBFI_STREAM_PLAIN}, {"left", 3, SBFI_STREAM_PLAIN},
      {"right", 3, SBFI_STREAM_PLAIN}, {"right_end", 5, SBFI_STREAM_PLAIN}, {"lamp", 5, SBFI_STREAM_NO_BONE}};
  for (uint32_t i = 0; i < 8; i++) {
    stream_node(&s, nodes[i].name, nodes[i].parent, nodes[i].kind, 0, 0, 0);
    stream_u32(&s, i == 1);
    if (i == 1) stream_u32(&s, 0);
  }
  stream_u32(&s, 1);
  put_triangles_head(&s, square, 2);
  stream_u32(&s, 2);
  put_bone(&s, "left", 2, vertices, weights);
  put_bone(&s, "right", 2, vertices, weights);
  stream_none(&s);
  finish(&s);
  scene_of_stream(scene, &s, format);
}

START_TEST(joints_are_the_bones_of_a_gltf)
{
  sbfi_scene scene;
  bones_of("glb", &scene);
  ck_assert_uint_eq(sbfi_scene_bone_count(&scene), 2);
  ck_assert(scene.nodes[6].is_end && !scene.nodes[6].is_bone);
  ck_assert(scene.unit_known && scene.axes_known && scene.unit_m == 1);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(other_formats_find_bones_by_joints_and_their_children)
{
  sbfi_scene scene;
  bones_of("md5mesh", &scene);
  static const bool expected[] = {false, false, false, true, true, true, true, false};
  for (int i = 0; i < 8; i++) ck_assert_msg(scene.nodes[i].is_bone == expected[i], "%s", scene.nodes[i].name);
  ck_assert(!scene.unit_known && !scene.axes_known);
  sbfi_scene_free(&scene);
}
END_TEST

START_TEST(pivot_helpers_are_merged_into_their_node)
{
  static const float square[] = SQUARE(0, 0, 0);
  stream_builder s = {0};
  stream_header(&s);
  stream_u32(&s, 5);
  stream_node(&s, "root", -1, SBFI_STREAM_PLAIN, 1, 0, 0);
  stream_none(&s);
  stream_node(&s, "b_$AssimpFbx$_Translation", 0, SBFI_STREAM_PLAIN, 0, 2, 0);
  stream_none(&s);
  stream_node(&s, "b_$AssimpFbx$_RotationPivot", 1, SBFI_STREAM_PLAIN, 0, 0, 3);
  stream_none(&s);
  stream_node(&s, "b", 2, SBFI_STREAM_BONE, 0, 0, 4);
  stream_none(&s);
  stream_node(&s, "section", 2, SBFI_STREAM_NO_BONE, 5, 0, 0);
  stream_u32(&s, 1);
  stream_u32(&s, 0);
  stream_u32(&s, 1);
  stream_triangles(&s, "square", 0, square, 2);
  finish(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "fbx");
  ck_assert_uint_eq(scene.node_count, 3);
  ck_assert_str_eq(scene.nodes[1].name, "b");
  ck_assert_int_eq(scene.nodes[1].parent, 0);
  ck_assert_double_eq(scene.nodes[1].local.at[1][3], 2);
  ck_assert_double_eq(scene.nodes[1].local.at[2][3], 7);
  ck_assert_double_eq(scene.nodes[1].world.at[0][3], 1);
  ck_assert_double_eq(scene.nodes[2].local.at[0][3], 5);
  ck_assert_double_eq(scene.nodes[2].local.at[2][3], 3);
  ck_assert(scene.nodes[1].is_bone && !scene.nodes[2].is_bone);
  sbfi_scene_free(&scene);
}
END_TEST

/* Unit and axes as a Z-up FBX in inches states them. */
START_TEST(unit_and_axes_of_an_fbx)
{
  static const float square[] = SQUARE(0, 0, 0);
  static const int32_t z_up[] = {2, 1, 1, -1, 0, 1}, twice[] = {1, 1, 1, 1, 0, 1},
                       left_handed[] = {1, 1, 2, 1, 0, -1};
  const int32_t *axes[] = {z_up, twice, left_handed};
  for (int i = 0; i < 3; i++) {
    stream_builder s = {0};
    one_node(&s, 1);
    double inch = 2.54;
    memcpy(s.at + 20, &inch, 8); /* after two words, and the generator of two words and one more */
    memcpy(s.at + 28, axes[i], 24);
    stream_u32(&s, 1);
    stream_triangles(&s, "square", 0, square, 2);
    finish(&s);
    sbfi_scene scene;
    scene_of_stream(&scene, &s, "fbx");
    ck_assert(scene.unit_known);
    ck_assert_double_eq(scene.unit_m, 0.0254);
    ck_assert(scene.axes_known == (i == 0));
    ck_assert_uint_eq(scene.warning_count, i == 0 ? 0 : 1);
    ck_assert_double_eq(scene.axes.at[1][2], i == 0 ? 1 : 0);
    ck_assert_double_eq(scene.axes.at[2][1], i == 0 ? -1 : 0);
    sbfi_scene_free(&scene);
  }
}
END_TEST

START_TEST(embedded_images_are_imported)
{
  static const float square[] = SQUARE(0, 0, 0);
  const char *names[] = {"*0", "C:\\textures\\skin.png", "*1", "*7"};
  for (int i = 0; i < 4; i++) {
    stream_builder s = {0};
    one_node(&s, 1);
    stream_u32(&s, 1);
    stream_triangles(&s, "square", 0, square, 2);
    stream_u32(&s, 1);
    stream_material(&s, "m", names[i]);
    stream_u32(&s, 2);
    stream_string(&s, "textures/skin.png");
    stream_string(&s, "png");
    stream_u32(&s, 3);
    stream_bytes(&s, "abc", 3);
    stream_string(&s, "bare pixels");
    stream_string(&s, "");
    stream_u32(&s, 0);
    stream_none(&s);
    stream_end(&s);
    sbfi_scene scene;
    scene_of_stream(&scene, &s, "fbx");
    if (i < 2) {
      ck_assert_uint_eq(scene.image_count, 1);
      ck_assert_uint_eq(scene.images[0].byte_count, 3);
      ck_assert_str_eq(scene.images[0].extension, "png");
    } else {
      ck_assert_uint_eq(scene.image_count, i == 2 ? 0 : 1);
    }
    sbfi_scene_free(&scene);
  }
}
END_TEST

static sbf_status answer(stream_builder *s, const char *format, sbf_diagnostic *error) {
  sbfi_scene scene;
  ck_assert(sbfi_scene_init(&scene, NULL, 0, "test"));
  scene.format = format;
  sbf_status status = sbfi_assimp_parse(&scene, s->at, s->size, NULL, error);
  sbfi_scene_free(&scene);
  free(s->at);
  return status;
}

START_TEST(generated_meshes_are_left_out)
{
  static const float square[] = SQUARE(0, 0, 0);
  sbf_diagnostic error = {0};
  stream_builder s = {0};
  one_node(&s, 1);
  memcpy(s.at + 52, &(uint32_t){1}, 4); /* incomplete */
  stream_u32(&s, 1);
  stream_triangles(&s, "invented", 0, square, 2);
  finish(&s);
  ck_assert_int_eq(answer(&s, "dae", &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_EMPTY);

  stream_builder bvh = {0};
  one_node(&bvh, 1);
  stream_u32(&bvh, 1);
  stream_triangles(&bvh, "invented", 0, square, 2);
  finish(&bvh);
  sbfi_scene scene;
  scene_of_stream(&scene, &bvh, "bvh");
  ck_assert_uint_eq(scene.mesh_count, 0);
  ck_assert_int_eq(scene.warnings[0].code, SBF_CODE_IMPORT_MESH_INVENTED);
  sbfi_scene_free(&scene);
}
END_TEST

/* Scales of 1e30 in a chain: finite each, their product is not. */
START_TEST(transforms_that_overflow_are_refused)
{
  sbf_diagnostic error = {0};
  stream_builder s = {0};
  stream_header(&s);
  stream_u32(&s, 20);
  for (int32_t i = 0; i < 20; i++) {
    const float rows[] = {1e30f, 0, 0, 0, 0, 1e30f, 0, 0, 0, 0, 1e30f, 0, 0, 0, 0, 1};
    stream_string(&s, "n");
    stream_u32(&s, (uint32_t)(i - 1));
    stream_u32(&s, SBFI_STREAM_BONE);
    stream_u32(&s, UINT32_MAX);
    stream_f32s(&s, rows, 16);
    stream_u32(&s, 0);
    stream_none(&s);
  }
  stream_none(&s);
  finish(&s);
  ck_assert_int_eq(answer(&s, "fbx", &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_NOT_FINITE);
}
END_TEST

/* Limits go with their node past a folded helper; one that bounds nothing is left out with a word. */
START_TEST(limits_are_kept_where_they_bound_something)
{
  static const float square[] = SQUARE(0, 0, 0), bounds[] = {-0.5f, 0.25f, 1, -1, 0, 0};
  stream_builder s = {0};
  stream_header(&s);
  stream_u32(&s, 2);
  stream_node(&s, "root", -1, SBFI_STREAM_PLAIN, 0, 0, 0);
  stream_u32(&s, 1);
  stream_u32(&s, 0);
  stream_limited_node(&s, "arm", 0, 7, bounds, 6);
  stream_none(&s);
  stream_u32(&s, 1);
  stream_triangles(&s, "square", 0, square, 2);
  finish(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "glb");
  const sbfi_scene_limit *limits = scene.nodes[1].limits;
  ck_assert(!scene.nodes[0].limits[0].stated);
  ck_assert(limits[SBFI_LIMIT_TWIST].stated && !limits[SBFI_LIMIT_SWING_Y].stated);
  ck_assert(limits[SBFI_LIMIT_TWIST].min == -0.5f && limits[SBFI_LIMIT_TWIST].max == 0.25f);
  ck_assert(limits[SBFI_LIMIT_SWING_Z].stated && limits[SBFI_LIMIT_SWING_Z].max == 0);
  ck_assert_uint_eq(scene.warning_count, 1);
  ck_assert_int_eq(scene.warnings[0].code, SBF_CODE_IMPORT_IGNORED);
  ck_assert_ptr_nonnull(strstr(scene.warnings[0].message, "arm"));
  sbfi_scene_free(&scene);
}
END_TEST

static Suite *assembly_suite(void) {
  Suite *suite = suite_create("assembly");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, corners_at_one_position_are_one_point);
  tcase_add_test(tests, limits_are_kept_where_they_bound_something);
  tcase_add_test(tests, zeros_are_equal_and_the_last_bit_differs);
  tcase_add_test(tests, parts_of_a_node_become_one_mesh);
  tcase_add_test(tests, nodes_are_never_welded);
  tcase_add_test(tests, polygons_keep_their_sides_and_lines_are_left_out);
  tcase_add_test(tests, points_that_move_differently_stay_separate);
  tcase_add_test(tests, points_of_different_shape_keys_stay_separate);
  tcase_add_test(tests, a_name_means_the_bone);
  tcase_add_test(tests, joints_are_the_bones_of_a_gltf);
  tcase_add_test(tests, other_formats_find_bones_by_joints_and_their_children);
  tcase_add_test(tests, pivot_helpers_are_merged_into_their_node);
  tcase_add_test(tests, unit_and_axes_of_an_fbx);
  tcase_add_test(tests, embedded_images_are_imported);
  tcase_add_test(tests, generated_meshes_are_left_out);
  tcase_add_test(tests, transforms_that_overflow_are_refused);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(assembly_suite());
}
