/* Edges of coarse soft bodies over edges of a host's shapes, where neither has a vertex. */
#include <math.h>

#include "collision_scenes.h"
#include "harness.h"

enum { CELLS = 3, ROW = CELLS + 1 };
static const float TOP = 0.05f;

static const uint32_t sides[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0,
    4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

/* A beam along z, 10 cm wide and high. */
static sbr_shape *beam_of(int kind) {
  static sbf_vec3 at[8];
  for (int i = 0; i < 8; i++) at[i] = (sbf_vec3){i & 1 ? TOP : -TOP, i & 2 ? TOP : -TOP, i & 4 ? 2 : -2};
  sbr_shape_definition d = collision_box(TOP, TOP, 2);
  if (kind) d.kind = kind == 1 ? SBR_SHAPE_HULL : SBR_SHAPE_MESH;
  if (kind) d.points = at, d.point_count = 8;
  if (kind == 2) d.triangles = sides, d.triangle_count = 12;
  return collision_shape(d);
}

/* Minimum height of the sheet's edges along x where they are over the beam's middle. */
static float over(const scene *s) {
  sbf_vec3 at[ROW * ROW];
  float min = 9;
  scene_read(s, 0, at, ROW * ROW);
  for (uint32_t i = 0; i < ROW * ROW; i++) {
    if (i % ROW == CELLS || at[i].x * at[i + 1].x > 0) continue;
    float fraction = at[i].x / (at[i].x - at[i + 1].x);
    min = fminf(min, at[i].y + fraction * (at[i + 1].y - at[i].y));
  }
  return min;
}

/* Four points a side, none over the beam. It hangs over the beam for a second and a half; it used to fall
 * past. */
START_TEST(a_coarse_sheet_rests_over_a_beam)
{
  scene s = scene_begin();
  s.asset->environment.gravity = (sbf_vec3){0, -9.81f, 0};
  collision_sheet(&s, 0, (sbf_vec3){0, 0.15f, 0}, 1, CELLS, false);
  scene_body(&s, 0)->attributes.friction = 0.8f;
  scene_body(&s, 0)->attributes.damping_ratio = 0.3f;
  scene_start(&s);
  sbr_shape *shape = beam_of(_i);
  collision_collider(&s, shape, (sbr_double3){0, 0, 0});
  for (int i = 0; i < 90; i++) {
    scene_ticks(&s, 1);
    ck_assert_float_ge(over(&s), TOP);
  }
  ck_assert_float_le(over(&s), TOP + 0.03f);
  scene_free(&s);
  sbr_shape_destroy(shape);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("shape_edges");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, a_coarse_sheet_rests_over_a_beam, 0, 3);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
