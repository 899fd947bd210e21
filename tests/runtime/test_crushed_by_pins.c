/* A soft body between two that are pinned to bones. Nothing stops the bones, so in the end the body has no
 * space left. It then overlaps the others, and no point becomes fast. */
#include <math.h>

#include "contact_scenes.h"
#include "harness.h"
#include "shapes.h"

static const float SIDE = 0.2f, PI = 3.14159265f;
static const double GAP = 0.02;

typedef struct squeeze {
  float pinned_pa, loose_pa; /* Young's moduli */
  float speed;               /* m/s of each bone */
  double aside, up;          /* m, of one of the pinned cubes */
  uint32_t cells;            /* along each edge of the pinned cubes */
} squeeze;

/* Without overlaps the first two exceed 40 m/s, and the third is put back into its rest shape. */
static const squeeze squeezes[] = {
    {1e6f, 3e3f, 0.5f, 0.05, 0.01, 4},
    {4e5f, 8e3f, 1.5f, 0.03, 0.06, 2},
    {8e5f, 16e3f, 0.6f, 0.1, 0.04, 4},
};
enum { SQUEEZES = sizeof squeezes / sizeof *squeezes };

/* A cube on y = 0. */
static void add_cube(scene *s, float young_pa, uint32_t cells, bool is_pinned) {
  lattice_box box = lattice_box_make((sbf_vec3){-SIDE / 2, 0, -SIDE / 2}, (sbf_vec3){SIDE, SIDE, SIDE}, cells,
      cells, cells, 1000, young_pa, 0.4f);
  for (uint32_t x = 0; is_pinned && x <= cells; x++)
    for (uint32_t y = 0; y <= cells; y++) box.masses[lattice_box_point(&box, x, y, 0)] = 0;
  sbf_level *level = scene_lattice(s, 0, &box);
  if (is_pinned) ((sbf_pin_set *)(uintptr_t)level->pins.at)->bone = 0;
  scene_body(s, 0)->surface = shape_cube(s->asset, 2 * cells, SIDE, (sbf_vec3){0, SIDE / 2, 0});
  scene_embed(s, level, &box);
  lattice_box_free(&box);
  scene_body(s, 0)->attributes.damping_ratio = 0.1f;
  scene_body(s, 0)->attributes.friction = 0.5f;
}

START_TEST(bodies_crushed_by_bones_do_not_burst)
{
  const squeeze *q = &squeezes[_i];
  scene s = contact_scene_begin((sbf_vec3){0, -9.81f, 0}),
        loose = contact_scene_begin((sbf_vec3){0, -9.81f, 0});
  scene_bodies(&s, 1), scene_bodies(&loose, 1);
  scene_bone(&s, (sbf_vec3){0, SIDE / 2, 0});
  add_cube(&s, q->pinned_pa, q->cells, true);
  add_cube(&loose, q->loose_pa, 3, false);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position = (sbr_double3){q->aside, q->up, -(double)SIDE - GAP};
  contact_scene_start(&s);
  sbr_character_definition d = s.character_definition;
  sbr_character_id other, crushed;
  d.position = (sbr_double3){0, 0, (double)SIDE + GAP}, d.heading = PI;
  ck_assert(sbr_character_create(s.world, s.model, &d, &other, NULL) == SBF_OK);
  ck_assert(sbr_model_create(loose.asset, &loose.model_options, &loose.model, NULL) == SBF_OK);
  d.position = (sbr_double3){0, 0, 0};
  ck_assert(sbr_character_create(s.world, loose.model, &d, &crushed, NULL) == SBF_OK);
  double fastest = 0;
  for (int i = 0; i < 240; i++) {
    float speed = (float)i * q->speed / 60 < 2 * SIDE ? q->speed : 0;
    sbr_character_set_drive(s.world, s.character, speed, 0, 0);
    sbr_character_set_drive(s.world, other, speed, 0, 0);
    sbr_world_tick(s.world);
    fastest = fmax(fastest, contact_scene_fastest(&s, crushed));
  }
  ck_assert_double_lt(fastest, 12);
  ck_assert_uint_eq(sbr_character_get_body_health(s.world, crushed, 0).recoveries, 0);
  scene_free(&s);
  sbr_model_destroy(loose.model);
  sbf_asset_free(loose.asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("crushed_by_pins");
  TCase *c = tcase_create("crushed_by_pins");
  tcase_add_loop_test(c, bodies_crushed_by_bones_do_not_burst, 0, SQUEEZES);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
