/* What stands where shows there, in its colour. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "opengl_probe.h"
#include "render/painter.h"

enum { WIDTH = 96, HEIGHT = 64 };

static draw_canvas *canvas;
static draw_painter *painter;
static draw_scene *scene;
static draw_camera camera;
static uint8_t rgb[WIDTH * HEIGHT * 3];

/* The camera looks along -z at a picture 3 m wide and 2 m high about the origin. */
static void set_up(void) {
  sbf_diagnostic error = {0};
  ck_assert_msg(
      draw_canvas_open(&canvas, WIDTH, HEIGHT, DRAW_CANVAS_MOVIE, &error) == SBF_OK, "%s", error.message);
  ck_assert_msg(draw_painter_create(&painter, canvas, &error) == SBF_OK, "%s", error.message);
  ck_assert_ptr_nonnull(scene = draw_scene_create());
  camera = (draw_camera){.distance = 10, .half_height = 0.1f};
}

static void tear_down(void) {
  draw_painter_destroy(painter);
  draw_canvas_close(canvas);
  draw_scene_destroy(scene);
}

static void paint(void) {
  sbf_diagnostic error = {0};
  ck_assert_msg(draw_painter_paint(painter, scene, &camera, &error) == SBF_OK, "%s", error.message);
  ck_assert_msg(draw_canvas_read(canvas, rgb, &error) == SBF_OK, "%s", error.message);
}

/* The pixel that shows this place of the plane z = 0. */
static const uint8_t *pixel_at(float x, float y) {
  int column = (int)((x + 1.5f) / 3 * WIDTH), row = (int)((1 - y) / 2 * HEIGHT);
  return rgb + 3 * (row * WIDTH + column);
}

/* How much more of one primary there is than of the others. */
static int redness(const uint8_t *p) {
  return p[0] - (p[1] > p[2] ? p[1] : p[2]);
}
static int greenness(const uint8_t *p) {
  return p[1] - (p[0] > p[2] ? p[0] : p[2]);
}
static int blueness(const uint8_t *p) {
  return p[2] - (p[0] > p[1] ? p[0] : p[1]);
}

static void add_square(float x, float y, float z, float half, uint32_t hex, float transparency) {
  const sbf_vec3 corners[4] = {
      {x - half, y - half, z}, {x + half, y - half, z}, {x + half, y + half, z}, {x - half, y + half, z}};
  static const uint32_t triangles[6] = {0, 1, 2, 0, 2, 3};
  draw_scene_add_mesh(scene, &(draw_mesh){.positions = corners,
                                 .vertex_count = 4,
                                 .triangles = triangles,
                                 .triangle_count = 2,
                                 .colour = draw_colour_rgb(hex),
                                 .transparency = transparency});
}

START_TEST(triangle_at_its_pixels)
{
  const sbf_vec3 corners[3] = {{-1.4f, 0.1f, 0}, {-0.2f, 0.1f, 0}, {-1.4f, 0.9f, 0}};
  static const uint32_t both_sides[2][3] = {{0, 1, 2}, {0, 2, 1}};
  draw_scene_add_mesh(scene, &(draw_mesh){.positions = corners,
                                 .vertex_count = 3,
                                 .triangles = both_sides[_i],
                                 .triangle_count = 1,
                                 .colour = draw_colour_rgb(0xd02020)});
  paint();
  ck_assert_int_gt(redness(pixel_at(-1.1f, 0.3f)), 80);
  ck_assert_int_lt(redness(pixel_at(-0.4f, 0.8f)), 20); /* beyond its slanted side */
  ck_assert_int_lt(redness(pixel_at(1.1f, 0.3f)), 20);
  ck_assert_int_lt(redness(pixel_at(-1.1f, -0.3f)), 20);
}
END_TEST

START_TEST(nearer_hides_farther)
{
  add_square(0, 0, 1, 0.5f, 0x20c020, 0);
  add_square(0, 0, 0, 0.8f, 0xc02020, 0);
  paint();
  ck_assert_int_gt(greenness(pixel_at(0, 0)), 60);
  ck_assert_int_gt(redness(pixel_at(0.7f, 0)), 60);
}
END_TEST

START_TEST(xray_shows_the_inside)
{
  add_square(0, 0, 1, 0.8f, 0x20c020, _i ? DRAW_XRAY : 0);
  draw_colour red = draw_colour_rgb(0xe00000);
  draw_scene_add_line(scene, &(draw_line){{-1, 0.02f, 0.95f}, {1, 0.02f, 0.95f}, red, red, 40});
  paint();
  if (_i)
    ck_assert_int_gt(redness(pixel_at(0, 0)), 40);
  else
    ck_assert_int_gt(greenness(pixel_at(0, 0)), 60);
  ck_assert_int_gt(redness(pixel_at(0.93f, 0.02f)), 100); /* beside it, in any case */
}
END_TEST

/* Red and green over blue and yellow, each a quarter; to be freed. */
static draw_image *four_colours(void) {
  static const uint8_t rows[2][2][4] = {
      {{224, 0, 0, 255}, {0, 224, 0, 255}}, {{0, 0, 224, 255}, {224, 224, 0, 255}}};
  enum { SIDE = 18 };
  draw_image *image = malloc(sizeof *image + 4 * SIDE * SIDE);
  ck_assert_ptr_nonnull(image);
  image->width = image->height = SIDE;
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      memcpy(image->rgba + 4 * (y * SIDE + x), rows[y >= SIDE / 2][x >= SIDE / 2], 4);
  return image;
}

static const sbf_vec2 whole_image[6] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};

static void add_square_with(
    float x, const draw_image *image, const sbf_vec2 *uvs, uint32_t hex, float transparency) {
  const sbf_vec3 corners[4] = {
      {x - 0.6f, -0.6f, 0}, {x + 0.6f, -0.6f, 0}, {x + 0.6f, 0.6f, 0}, {x - 0.6f, 0.6f, 0}};
  static const uint32_t triangles[6] = {0, 1, 2, 0, 2, 3};
  draw_scene_add_mesh(scene, &(draw_mesh){.positions = corners,
                                 .vertex_count = 4,
                                 .triangles = triangles,
                                 .triangle_count = 2,
                                 .colour = draw_colour_rgb(hex),
                                 .image = image,
                                 .corner_uvs = uvs,
                                 .transparency = transparency});
}

START_TEST(image_is_upright)
{
  draw_image *image = four_colours();
  add_square_with(0, image, whole_image, 0xffffff, 0);
  paint();
  ck_assert_int_gt(redness(pixel_at(-0.3f, 0.3f)), 80);
  ck_assert_int_gt(greenness(pixel_at(0.3f, 0.3f)), 80);
  ck_assert_int_gt(blueness(pixel_at(-0.3f, -0.3f)), 80);
  const uint8_t *yellow = pixel_at(0.3f, -0.3f);
  ck_assert_int_gt(yellow[0] - yellow[2], 80);
  ck_assert_int_gt(yellow[1] - yellow[2], 80);
  free(image);
}
END_TEST

/* A mesh without one between two that have: each keeps its own. */
START_TEST(images_stay_on_their_meshes)
{
  draw_image *image = four_colours(), *second = four_colours();
  for (size_t i = 0; i < 4 * (size_t)second->width * second->height; i += 4)
    memcpy(second->rgba + i, (const uint8_t[4]){0, 0, 224, 255}, 4);
  add_square_with(-0.9f, image, whole_image, 0xffffff, 0);
  add_square(0, 0, 1, 0.25f, 0xd02020, 0);
  add_square_with(0.9f, second, whole_image, 0xffffff, 0);
  for (int frame = 0; frame < 2; frame++) { /* made in the first, found in the second */
    paint();
    ck_assert_int_gt(greenness(pixel_at(-0.6f, 0.3f)), 80);
    ck_assert_int_gt(redness(pixel_at(0, 0)), 80);
    ck_assert_int_gt(blueness(pixel_at(0.9f, 0.3f)), 80);
  }
  free(image);
  free(second);
}
END_TEST

START_TEST(image_repeats_and_is_multiplied)
{
  static const sbf_vec2 next[6] = {{7, -3}, {8, -3}, {8, -2}, {7, -3}, {8, -2}, {7, -2}};
  draw_image *image = four_colours();
  add_square_with(0, image, next, 0xff0000, 0);
  paint();
  ck_assert_int_gt(redness(pixel_at(-0.3f, 0.3f)), 80);
  ck_assert_int_gt(redness(pixel_at(0.3f, -0.3f)), 80); /* of yellow red is left */
  ck_assert_int_lt(pixel_at(0.3f, 0.3f)[1], 100);       /* of green nothing */
  free(image);
}
END_TEST

START_TEST(xray_mesh_has_no_image)
{
  static uint8_t plain[sizeof rgb];
  draw_image *image = four_colours();
  add_square_with(0, NULL, NULL, 0x808080, DRAW_XRAY);
  paint();
  memcpy(plain, rgb, sizeof plain);
  draw_scene_clear(scene);
  add_square_with(0, image, whole_image, 0x808080, DRAW_XRAY);
  paint();
  ck_assert_mem_eq(plain, rgb, sizeof rgb);
  free(image);
}
END_TEST

START_TEST(deep_inside_an_xray_mesh_is_dimmer)
{
  draw_colour red = draw_colour_rgb(0xe00000);
  add_square(0, 0, 1, 0.9f, 0x20c020, DRAW_XRAY);
  draw_scene_add_line(scene, &(draw_line){{-0.8f, 0.45f, 0.99f}, {0.8f, 0.45f, 0.99f}, red, red, 40});
  draw_scene_add_line(scene, &(draw_line){{-0.8f, -0.49f, 0.2f}, {0.8f, -0.49f, 0.2f}, red, red, 40});
  paint();
  ck_assert_int_gt(redness(pixel_at(0, 0.5f)), redness(pixel_at(0, -0.5f)) + 30);
}
END_TEST

START_TEST(marks_are_drawn_over_objects)
{
  draw_colour blue = draw_colour_rgb(0x0000e0);
  add_square(0, 0, 1, 0.9f, 0xc02020, _i ? DRAW_XRAY : 0);
  draw_scene_add_mark(scene, &(draw_line){{-0.6f, 0.3f, 0}, {0.2f, 0.3f, 0}, blue, blue, 30});
  draw_scene_add_ring_mark(scene, v3(0, -0.2f, 0), v3(0, 0, 1), 0.4f, 30, blue);
  paint();
  ck_assert_int_gt(blueness(pixel_at(-0.2f, 0.3f)), 100);
  ck_assert_int_gt(blueness(pixel_at(0.4f, -0.2f)), 100);
  ck_assert_int_gt(redness(pixel_at(0, -0.2f)), 30); /* inside the ring */
}
END_TEST

START_TEST(prints_lie_on_the_ground)
{
  draw_colour blue = draw_colour_rgb(0x0000e0);
  camera.pitch = 0.5f;
  draw_scene_set_floor(scene, -0.4f);
  add_square(0.8f, 0, 0.8f, 0.5f, 0xc02020, 0);
  draw_scene_add_print(scene, v3(-0.5f, -0.4f, 0), v3(0, 1, 0), 0.5f, 30, blue);
  draw_scene_add_print(scene, v3(0.5f, -0.4f, 0), v3(0, 1, 0), 0.3f, 30, blue);
  paint();
  ck_assert_int_gt(blueness(pixel_at(-1, -0.37f)), 60);
  ck_assert_int_gt(redness(pixel_at(0.8f, -0.37f)), 60); /* hidden */
}
END_TEST

START_TEST(nearer_lines_are_over_farther)
{
  draw_colour red = draw_colour_rgb(0xe00000), blue = draw_colour_rgb(0x0000e0);
  draw_scene_add_line(scene, &(draw_line){{0, -1, 1}, {0, 1, 1}, blue, blue, 60});
  draw_scene_add_line(scene, &(draw_line){{-1, 0, 0}, {1, 0, 0}, red, red, 60});
  paint();
  ck_assert_int_gt(blueness(pixel_at(0, 0)), 100);
  ck_assert_int_gt(redness(pixel_at(0.6f, 0)), 100);
}
END_TEST

START_TEST(line_behind_the_eye_is_cut)
{
  draw_colour red = draw_colour_rgb(0xe00000);
  draw_scene_add_line(scene, &(draw_line){{0, 0, 30}, {0, -0.5f, 0}, red, red, 20});
  draw_scene_add_line(scene, &(draw_line){{0.5f, 0, 30}, {0.5f, 0, 40}, red, red, 20});
  paint();
  ck_assert_int_gt(redness(pixel_at(0, -0.48f)), 60);
  ck_assert_int_lt(redness(pixel_at(0.5f, 0.5f)), 20);
}
END_TEST

START_TEST(ground_is_dark_under_objects)
{
  camera.pitch = 0.5f;
  draw_scene_set_floor(scene, -0.4f);
  draw_scene_add_sphere(scene, v3(0, -0.1f, 0), 0.3f, draw_colour_rgb(0x808080));
  paint();
  const uint8_t *beside = pixel_at(-1.2f, -0.5f), *under = pixel_at(0, -0.42f);
  ck_assert_int_gt(beside[1], under[1] + 40);
}
END_TEST

/* Also of solid objects, which cast shadows on themselves. */
START_TEST(same_scene_same_picture)
{
  static uint8_t first[sizeof rgb];
  draw_scene_set_floor(scene, -0.5f);
  add_square(0.2f, 0.1f, 0, 0.4f, 0x3050c0, _i ? DRAW_XRAY : 0);
  draw_scene_add_sphere(scene, v3(-0.6f, 0.2f, 0), 0.3f, draw_colour_rgb(0x808080));
  draw_scene_add_bone(scene, v3(-0.5f, -0.3f, 0), v3(0.4f, 0.4f, 0), draw_colour_of_bone());
  draw_scene_add_ring_mark(scene, v3(0, -0.49f, 0), v3(0, 1, 0), 0.4f, 2, draw_colour_of_target());
  draw_scene_add_legend(scene, "structural", draw_colour_rgb(0x1060c0));
  paint();
  for (size_t i = 0; i < sizeof rgb; i++) first[i] = rgb[i];
  paint();
  ck_assert_mem_eq(first, rgb, sizeof rgb);
}
END_TEST

/* The bright line along an edge is of what is turned from the eye, not of a facet that faces it, whatever its
 * smooth normals say: a coarse body is not pale where its normals lean away. */
START_TEST(facets_that_face_the_eye_are_no_edges)
{
  static const sbf_vec3 corners[4] = {{-1, -0.8f, 0}, {1, -0.8f, 0}, {1, 0.8f, 0}, {-1, 0.8f, 0}};
  static const uint32_t triangles[6] = {0, 1, 2, 0, 2, 3};
  const float s = _i ? 1 : -1;
  const sbf_vec3 normals[4] = {{0, 0, 1}, {s, 0, 0}, {s, 0, 0}, {0, 0, 1}};
  draw_scene_add_mesh(scene, &(draw_mesh){.positions = corners,
                                 .normals = normals,
                                 .vertex_count = 4,
                                 .triangles = triangles,
                                 .triangle_count = 2,
                                 .colour = draw_colour_rgb(0x20a020)});
  paint();
  const uint8_t *there = pixel_at(0.95f, 0);
  ck_assert_int_gt(greenness(there), 30);
  ck_assert_int_lt(there[0], 80);
}
END_TEST

START_TEST(non_finite_values_are_ignored)
{
  const sbf_vec3 corners[4] = {{NAN, 0, 0}, {INFINITY, 1, 0}, {-1, 0, 0}, {1, 0, 0}};
  static const uint32_t triangles[6] = {0, 1, 2, 1, 2, 3};
  draw_colour red = draw_colour_rgb(0xe00000);
  draw_scene_set_floor(scene, -0.5f);
  draw_scene_add_mesh(scene, &(draw_mesh){.positions = corners,
                                 .vertex_count = 4,
                                 .triangles = triangles,
                                 .triangle_count = 2,
                                 .transparency = 0.5f});
  draw_scene_add_line(scene, &(draw_line){corners[0], corners[1], red, red, 2});
  draw_scene_add_line(scene, &(draw_line){{-1, 0.7f, 0}, {1, 0.7f, 0}, red, red, 60});
  paint();
  ck_assert_int_gt(redness(pixel_at(0, 0.7f)), 100);
}
END_TEST

START_TEST(empty_scene_is_a_backdrop)
{
  paint();
  ck_assert_int_gt(rgb[0], 100);
  ck_assert_int_lt(redness(rgb), 20);
}
END_TEST

int main(void) {
  opengl_probe();
  Suite *suite = suite_create("painter");
  TCase *tests = tcase_create("painter");
  tcase_add_checked_fixture(tests, opengl_needed, NULL);
  tcase_add_checked_fixture(tests, set_up, tear_down);
  tcase_add_loop_test(tests, triangle_at_its_pixels, 0, 2);
  tcase_add_test(tests, nearer_hides_farther);
  tcase_add_loop_test(tests, xray_shows_the_inside, 0, 2);
  tcase_add_test(tests, image_is_upright);
  tcase_add_test(tests, images_stay_on_their_meshes);
  tcase_add_test(tests, image_repeats_and_is_multiplied);
  tcase_add_test(tests, xray_mesh_has_no_image);
  tcase_add_test(tests, deep_inside_an_xray_mesh_is_dimmer);
  tcase_add_loop_test(tests, marks_are_drawn_over_objects, 0, 2);
  tcase_add_test(tests, prints_lie_on_the_ground);
  tcase_add_test(tests, nearer_lines_are_over_farther);
  tcase_add_test(tests, line_behind_the_eye_is_cut);
  tcase_add_test(tests, ground_is_dark_under_objects);
  tcase_add_loop_test(tests, same_scene_same_picture, 0, 2);
  tcase_add_loop_test(tests, facets_that_face_the_eye_are_no_edges, 0, 2);
  tcase_add_test(tests, non_finite_values_are_ignored);
  tcase_add_test(tests, empty_scene_is_a_backdrop);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
