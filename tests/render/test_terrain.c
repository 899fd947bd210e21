#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "render/draw_scene_data.h"

static float stairs(void *user, float x, float z) {
  (void)user, (void)x;
  return z < 0.37f ? 0 : 0.15f * floorf((z - 0.37f) / 0.4f + 1);
}

static float hills(void *user, float x, float z) {
  (void)user;
  return 0.3f * sinf(x) * cosf(0.7f * z);
}

START_TEST(vertices_lie_on_the_ground)
{
  draw_scene *scene = draw_scene_create();
  draw_scene_set_terrain(scene, hills, NULL, 3, -2, 10);
  const sbf_vec3 *at = scene->ground.positions.at;
  box3 box = box3_empty();
  ck_assert_uint_gt(scene->ground.positions.count, 1000);
  for (size_t i = 0; i < scene->ground.positions.count; i++) {
    ck_assert_float_eq(at[i].y, hills(NULL, at[i].x, at[i].z));
    box3_add(&box, at[i]);
  }
  ck_assert(box.min.x <= -7 && box.max.x >= 13 && box.min.z <= -12 && box.max.z >= 8);
  const sbf_vec3 *normals = scene->ground.normals.at;
  for (size_t i = 0; i < scene->ground.normals.count; i++) ck_assert_float_gt(normals[i].y, 0.5f);
  draw_scene_destroy(scene);
}
END_TEST

/* Every corner is shaded as tread or as riser, none as something between. */
START_TEST(stairs_stay_sharp)
{
  draw_scene *scene = draw_scene_create();
  int treads = 0, risers = 0;
  draw_scene_set_terrain(scene, stairs, NULL, 0, 1, 3);
  const sbf_vec3 *normals = scene->ground.normals.at, *at = scene->ground.positions.at;
  for (size_t i = 0; i < scene->ground.normals.count; i++) {
    if (fabsf(at[i].z - 1) > 2) continue; /* the grid is fine enough for the steps this near */
    treads += normals[i].y > 0.99f;
    risers += normals[i].z < -0.99f;
    ck_assert_msg(normals[i].y > 0.99f || normals[i].z < -0.99f, "normal %g %g %g at z = %g", normals[i].x,
        normals[i].y, normals[i].z, at[i].z);
  }
  ck_assert_int_gt(treads, 100);
  ck_assert_int_gt(risers, 100);
  draw_scene_destroy(scene);
}
END_TEST

/* Nearby vertices keep their positions when the centre moves: otherwise the ground would appear to move. */
START_TEST(grid_lines_keep_their_positions)
{
  draw_scene *scene = draw_scene_create();
  float cell = 4.0f / 168;
  for (int step = 0; step < 5; step++) {
    draw_scene_set_terrain(scene, hills, NULL, 0.013f * (float)step, 0, 4);
    const sbf_vec3 *at = scene->ground.positions.at;
    for (size_t i = 0; i < scene->ground.positions.count; i++)
      ck_assert_float_le(fabsf(at[i].x / cell - roundf(at[i].x / cell)), 2e-3f);
  }
  draw_scene_destroy(scene);
}
END_TEST

START_TEST(invalid_terrain_draws_nothing)
{
  draw_scene *scene = draw_scene_create();
  draw_scene_set_terrain(scene, hills, NULL, NAN, 0, 4);
  draw_scene_set_terrain(scene, hills, NULL, 0, 0, 0);
  ck_assert_uint_eq(scene->ground.indices.count, 0);
  draw_scene_destroy(scene);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("terrain");
  TCase *tests = tcase_create("terrain");
  tcase_add_test(tests, vertices_lie_on_the_ground);
  tcase_add_test(tests, stairs_stay_sharp);
  tcase_add_test(tests, grid_lines_keep_their_positions);
  tcase_add_test(tests, invalid_terrain_draws_nothing);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
