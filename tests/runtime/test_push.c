/* Impacts of soft bodies on each other: how deep and where they penetrate. */
#include <math.h>

#include "contact_scenes.h"
#include "harness.h"
#include "math/vec3.h"
#include "sbrun/collision.h"
#include "shapes.h"
#include "skin_depth.h"

/* A cube of soft tissue that stands on y = 0; its skin is finer than its lattice. */
enum { CELLS = 5, SQUARES = 6, MAX = 6 * SQUARES * SQUARES + 2 };
static const float SIDE = 0.3f;

typedef struct placed {
  sbf_vec3 at[MAX], middle;
} placed;

/* Two of them, the upper one so high above the other, and so far aside. */
static scene begin(
    float young_pa, float damping_ratio, double height, double aside, sbr_character_id *upper) {
  scene s = contact_scene_begin((sbf_vec3){0, -9.81f, 0});
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  scene_bodies(&s, 1);
  lattice_box box = lattice_box_make((sbf_vec3){-SIDE / 2, 0, -SIDE / 2}, (sbf_vec3){SIDE, SIDE, SIDE}, CELLS,
      CELLS, CELLS, 1000, young_pa, 0.4f);
  sbf_level *level = scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->surface = shape_cube(s.asset, SQUARES, SIDE, (sbf_vec3){0, SIDE / 2, 0});
  scene_embed(&s, level, &box);
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.damping_ratio = damping_ratio;
  scene_body(&s, 0)->attributes.friction = 0.6f;
  contact_scene_start(&s);
  *upper = contact_scene_another(&s, (sbr_double3){aside, (double)SIDE + height, 0});
  return s;
}

static placed skin_of(const scene *s, sbr_character_id who) {
  placed p = {.middle = {0, 0, 0}};
  sbr_double3 o = sbr_character_get_origin(s->world, who);
  ck_assert_uint_eq(sbr_character_get_surface(s->world, who, 0, p.at, MAX), MAX);
  for (uint32_t i = 0; i < MAX; i++) {
    p.at[i] = sbri_add(p.at[i], sbri_vec3((float)o.x, (float)o.y, (float)o.z));
    p.middle = sbri_add_scaled(p.middle, p.at[i], 1.0f / MAX);
  }
  return p;
}

static double deepest(const scene *s, const placed *a, const placed *b) {
  const sbf_polygon_mesh *mesh = &s->asset->soft_bodies.at[0].surface;
  double max = 0;
  for (uint32_t v = 0; v < MAX; v++)
    max = fmax(max,
        fmax(skin_depth(mesh, b->at, a->at[v], UINT32_MAX), skin_depth(mesh, a->at, b->at[v], UINT32_MAX)));
  return max;
}

static double aside_of(const placed *lower, const placed *upper) {
  return hypot((double)(upper->middle.x - lower->middle.x), (double)(upper->middle.z - lower->middle.z));
}

/* Contacts prevent deep penetration from the start: faces are near, and no point searches for a way out. */
START_TEST(fast_bodies_penetrate_no_deeper_than_the_face_search)
{
  double height = _i + 1, max = 0, aside = 0;
  sbr_character_id upper;
  scene s = begin(8e4f, 0.2f, height, 3e-4, &upper);
  uint32_t blow = (uint32_t)(60 * sqrt(2 * height / 9.81));
  scene_ticks(&s, blow - 2);
  for (int i = 0; i < 14; i++) {
    scene_ticks(&s, 1);
    placed a = skin_of(&s, s.character), b = skin_of(&s, upper);
    max = fmax(max, deepest(&s, &a, &b));
    aside = fmax(aside, aside_of(&a, &b));
  }
  ck_assert_double_ge(max, 0.001);
  ck_assert_double_le(max, 0.009); /* of the 0.01 that they are looked for */
  ck_assert_double_le(aside, 0.006);
  scene_free(&s);
}
END_TEST

/* Soft tissue that recovers its shape at once does not throw the upper one off. */
START_TEST(cubes_that_fall_on_each_other_stand)
{
  sbr_character_id upper;
  scene s = begin(2e5f, 1, 0.3, _i ? 3e-4 : 0, &upper);
  double max = 0, aside = 0;
  for (int i = 0; i < 240; i++) {
    scene_ticks(&s, 1);
    if (i < 10 || (i > 40 && i % 8)) continue;
    placed a = skin_of(&s, s.character), b = skin_of(&s, upper);
    max = fmax(max, deepest(&s, &a, &b));
    aside = fmax(aside, aside_of(&a, &b));
  }
  placed a = skin_of(&s, s.character), b = skin_of(&s, upper);
  ck_assert_double_le(max, 0.004);
  ck_assert_double_le(aside, 0.008);
  ck_assert_double_ge((double)(b.middle.y - a.middle.y), 0.29);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("push");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, fast_bodies_penetrate_no_deeper_than_the_face_search, 0, 2);
  tcase_add_loop_test(tests, cubes_that_fall_on_each_other_stand, 0, 2);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
