#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "render/draw_scene_data.h"

static const sbf_vec3 corners[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static const uint32_t triangles[6] = {0, 1, 2, 0, 2, 3};
static const draw_mesh square = {
    .positions = corners, .vertex_count = 4, .triangles = triangles, .triangle_count = 2};

static draw_scene *scene;

static void set_up(void) {
  ck_assert_ptr_nonnull(scene = draw_scene_create());
}
static void tear_down(void) {
  draw_scene_destroy(scene);
}

static sbf_vec3 normal_at(size_t i) {
  return ((const sbf_vec3 *)scene->normals.at)[i];
}

START_TEST(notes_start_at_the_top)
{
  static const draw_camera camera = {.distance = 1, .half_height = 1};
  static const draw_colour red = {255, 0, 0, 255};
  draw_scene_add_note(scene, "it's 1,5 %", &red);
  size_t one = scene->overlay.lines.count;
  ck_assert_uint_gt(one, 10);
  draw_scene_add_note(scene, "it's 1,5 %", NULL);
  ck_assert_uint_lt(scene->overlay.lines.count - one, one);
  draw_scene_arrange_overlay(scene, &camera, 1440, 1440);
  const draw_line *lines = scene->painted.overlay.at;
  for (size_t i = 0; i < scene->painted.overlay.count; i++) {
    ck_assert_float_gt(lines[i].from.y, i < one ? 0.92f : 0.85f);
    ck_assert_float_lt(lines[i].from.y, i < one ? 1 : 0.92f);
    ck_assert_float_lt(lines[i].from.x, -0.69f);
  }
}
END_TEST

START_TEST(index_out_of_range_is_left_out)
{
  static const uint32_t wrong[6] = {0, 1, 2, 0, 2, 4};
  static const sbf_uint2 ends[3] = {{{0, 1}}, {{1, 4}}, {{2, 3}}};
  draw_mesh mesh = square;
  mesh.triangles = wrong;
  draw_scene_add_mesh(scene, &mesh);
  mesh.flat = true;
  draw_scene_add_mesh(scene, &mesh);
  ck_assert_uint_eq(scene->indices.count, 6);
  draw_scene_add_lines(scene, corners, 4, ends, NULL, 3, draw_colour_rgb(0), 1);
  ck_assert_uint_eq(scene->lines.count, 2);
  const uint32_t *indices = scene->indices.at;
  for (int i = 0; i < 6; i++) ck_assert_uint_lt(indices[i], scene->positions.count);
}
END_TEST

/* Each corner has its own place in an image, also behind a triangle that is left out; shaded as without one.
 */
START_TEST(corners_keep_their_uvs)
{
  static const uint32_t three[9] = {0, 1, 2, 0, 9, 1, 0, 2, 3};
  const draw_transform transform = {{0, sqrtf(0.5f), 0, sqrtf(0.5f)}, {10, 0, 0}};
  const draw_image image = {1, 1};
  sbf_vec2 uvs[9];
  for (int i = 0; i < 9; i++) uvs[i] = (sbf_vec2){(float)i, 0.5f};
  draw_mesh mesh = square;
  mesh.triangles = three;
  mesh.triangle_count = 3;
  mesh.transform = &transform;
  mesh.image = &image;
  mesh.corner_uvs = uvs;
  draw_scene_add_mesh(scene, &square);
  draw_scene_add_mesh(scene, &mesh);
  ck_assert_uint_eq(scene->positions.count, 10);
  ck_assert_uint_eq(scene->uvs.count, 10);
  ck_assert_uint_eq(scene->parts.count, 2);
  static const float wanted[10] = {0, 0, 0, 0, 0, 1, 2, 6, 7, 8};
  for (int i = 0; i < 10; i++) ck_assert_float_eq(((const sbf_vec2 *)scene->uvs.at)[i].x, wanted[i]);
  for (size_t i = 4; i < 10; i++) ck_assert_float_eq_tol(normal_at(i).x, 1, 1e-5f);
  ck_assert_float_eq_tol(((const sbf_vec3 *)scene->positions.at)[5].z, -1, 1e-5f);
}
END_TEST

/* Triangles that meet along a hard edge have normals of their own there, one left out or not. */
START_TEST(corners_keep_their_normals)
{
  static const uint32_t three[9] = {0, 1, 2, 0, 9, 1, 0, 2, 3};
  static const sbf_vec3 smooth[4] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  const draw_transform transform = {{0, sqrtf(0.5f), 0, sqrtf(0.5f)}, {0, 0, 0}};
  sbf_vec3 normals[9];
  for (int i = 0; i < 9; i++) normals[i] = i < 3 ? v3(0, 1, 0) : v3(0, 0, 1);
  draw_mesh mesh = square;
  mesh.triangles = three;
  mesh.triangle_count = 3;
  mesh.normals = smooth;
  mesh.corner_normals = normals;
  mesh.transform = &transform;
  draw_scene_add_mesh(scene, &mesh);
  ck_assert_uint_eq(scene->positions.count, 6);
  for (size_t i = 0; i < 6; i++) {
    ck_assert_float_eq_tol(normal_at(i).y, i < 3 ? 1 : 0, 1e-5f);
    ck_assert_float_eq_tol(normal_at(i).x, i < 3 ? 0 : 1, 1e-5f);
  }
}
END_TEST

START_TEST(placed_mesh_is_turned_and_moved)
{
  /* A quarter turn about +Y takes +Z to +X. */
  const draw_transform transform = {{0, sqrtf(0.5f), 0, sqrtf(0.5f)}, {10, 0, 0}};
  draw_mesh mesh = square;
  mesh.transform = &transform;
  mesh.flat = _i == 1;
  draw_scene_add_mesh(scene, &mesh);
  ck_assert_float_eq_tol(normal_at(0).x, 1, 1e-5f);
  box3 bounds = draw_scene_bounds(scene);
  ck_assert_float_eq_tol(bounds.min.x, 10, 1e-5f);
  ck_assert_float_eq_tol(bounds.min.z, -1, 1e-5f);
  ck_assert_float_eq_tol(bounds.max.y, 1, 1e-5f);
}
END_TEST

START_TEST(far_lines_are_drawn_first)
{
  static const float depths[] = {3, -2, 7, 0, 5, -9, 1};
  enum { COUNT = 7 };
  for (int i = 0; i < COUNT; i++) draw_scene_add_dot(scene, v3(0, 0, depths[i]), 1, draw_colour_rgb(0));
  draw_scene_sort(scene, v3(0, 0, 20), v3(0, 0, 1));
  const draw_line *sorted = scene->painted.sorted_lines.at;
  ck_assert_uint_eq(scene->painted.sorted_lines.count, COUNT);
  for (int i = 1; i < COUNT; i++) ck_assert_float_ge(sorted[i].from.z, sorted[i - 1].from.z);
}
END_TEST

START_TEST(far_transparent_meshes_are_drawn_first)
{
  static const float depths[] = {1, 4, -3};
  for (int i = 0; i < 3; i++) {
    const draw_transform transform = {{0, 0, 0, 1}, {0, 0, depths[i]}};
    draw_mesh mesh = square;
    mesh.transform = &transform;
    mesh.transparency = 0.5f;
    draw_scene_add_mesh(scene, &mesh);
    draw_scene_add_mesh(scene, &square);
  }
  draw_scene_sort(scene, v3(0, 0, 20), v3(0, 0, 1));
  const uint32_t *order = scene->painted.sorted_parts.at;
  const draw_scene_part *parts = scene->parts.at;
  ck_assert_uint_eq(scene->painted.sorted_parts.count, 3);
  ck_assert_float_eq(parts[order[0]].middle.z, -3);
  ck_assert_float_eq(parts[order[2]].middle.z, 4);
}
END_TEST

START_TEST(transparent_sections_are_drawn_as_one_skin)
{
  draw_mesh section = square;
  section.transparency = DRAW_XRAY;
  draw_scene_add_mesh(scene, &section);
  draw_scene_add_mesh(scene, &section);
  ck_assert_uint_eq(scene->parts.count, 1);
  section.no_shadow = true; /* as hulls are: each is to be seen through the next */
  draw_scene_add_mesh(scene, &section);
  draw_scene_add_mesh(scene, &section);
  ck_assert_uint_eq(scene->parts.count, 3);
}
END_TEST

START_TEST(solid_meshes_of_one_material_are_one_part)
{
  draw_scene_add_mesh(scene, &square);
  draw_scene_add_mesh(scene, &square);
  draw_scene_add_sphere(scene, v3(0, 0, 0), 1, draw_colour_rgb(0));
  ck_assert_uint_eq(scene->parts.count, 1);
}
END_TEST

START_TEST(marks_are_framed_but_not_rings)
{
  draw_colour black = draw_colour_rgb(0);
  draw_camera plain, with_ring, with_mark;
  draw_scene_add_sphere(scene, v3(0, 0, 0), 1, black);
  draw_scene_frame(scene, &plain, 1, 0, 0);
  draw_scene_add_ring_mark(scene, v3(9, 0, 0), v3(0, 1, 0), 1, 3, black);
  draw_scene_frame(scene, &with_ring, 1, 0, 0);
  draw_scene_add_mark(scene, &(draw_line){{0, 0, 0}, {9, 0, 0}, black, black, 3});
  draw_scene_frame(scene, &with_mark, 1, 0, 0);
  ck_assert_float_eq(with_ring.distance, plain.distance);
  ck_assert_float_gt(with_mark.distance, 3 * plain.distance);
  ck_assert_float_gt(with_mark.subject.x, 3);
}
END_TEST

START_TEST(steady_frames_allocate_nothing)
{
  const void *positions[4] = {NULL};
  for (int frame = 0; frame < 4; frame++) {
    draw_scene_clear(scene);
    for (int i = 0; i < 50; i++) draw_scene_add_mesh(scene, &square);
    for (int i = 0; i < 500; i++) draw_scene_add_dot(scene, v3(0, 0, (float)i), 1, draw_colour_rgb(0));
    draw_scene_set_floor(scene, 0);
    draw_scene_sort(scene, v3(0, 0, 20), v3(0, 0, 1));
    const void *now[4] = {
        scene->positions.at, scene->indices.at, scene->lines.at, scene->painted.sorted_lines.at};
    for (int k = 0; k < 4; k++) {
      if (frame) ck_assert_ptr_eq(now[k], positions[k]);
      positions[k] = now[k];
    }
  }
}
END_TEST

START_TEST(hull_shows_its_edges_but_not_its_cuts)
{
  static const sbf_vec3 cube[8] = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  static const uint32_t facets[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
      0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  draw_scene_add_hull(scene, cube, 8, facets, 12, NULL, draw_colour_of_hull());
  ck_assert_uint_eq(scene->lines.count, 12);
}
END_TEST

START_TEST(bone_without_length_is_nothing)
{
  draw_scene_add_bone(scene, v3(1, 1, 1), v3(1, 1, 1), draw_colour_of_bone());
  draw_scene_add_bone(scene, v3(NAN, 1, 1), v3(1, 1, 1), draw_colour_of_bone());
  ck_assert_uint_eq(scene->indices.count, 0);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("draw_scene");
  TCase *tests = tcase_create("draw_scene");
  tcase_add_checked_fixture(tests, set_up, tear_down);
  tcase_add_test(tests, index_out_of_range_is_left_out);
  tcase_add_test(tests, notes_start_at_the_top);
  tcase_add_test(tests, corners_keep_their_uvs);
  tcase_add_test(tests, corners_keep_their_normals);
  tcase_add_loop_test(tests, placed_mesh_is_turned_and_moved, 0, 2);
  tcase_add_test(tests, far_lines_are_drawn_first);
  tcase_add_test(tests, far_transparent_meshes_are_drawn_first);
  tcase_add_test(tests, transparent_sections_are_drawn_as_one_skin);
  tcase_add_test(tests, solid_meshes_of_one_material_are_one_part);
  tcase_add_test(tests, marks_are_framed_but_not_rings);
  tcase_add_test(tests, steady_frames_allocate_nothing);
  tcase_add_test(tests, hull_shows_its_edges_but_not_its_cuts);
  tcase_add_test(tests, bone_without_length_is_nothing);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
