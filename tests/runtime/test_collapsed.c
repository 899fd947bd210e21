#include <math.h>

#include "collision_scenes.h"
#include "harness.h"

enum { CLOSING = 120, SHUT = 180, REGAINED = SHUT + 16, LANDING = SHUT + 31, END = 330 };

/* A press lowers onto a block of soft tissue to a fraction of its height, stays for a second and rises. A
 * pressed body is not collapsed: it is not put back into its rest shape, which would overlap the press, and
 * it lies still. After release it recovers its shape within a quarter of a second and jumps. Landing
 * compresses it again. */
START_TEST(bodies_pressed_flat_are_not_reset)
{
  const double height = 0.4, fraction = _i ? 0.05 : 0.3;
  scene s = scene_begin();
  lattice_box box = lattice_box_make((sbf_vec3){-0.3f, 0, -0.2f}, (sbf_vec3){0.6f, (float)height, 0.4f}, 6, 4,
      4, 1000, _i ? 2e4f : 2e5f, 0.45f);
  scene_bone(&s, (sbf_vec3){0, 0.2f, 0});
  scene_section(&s, 0, (sbf_vec3){0, 0.2f, 0}, (sbf_vec3){0.6f, (float)height, 0.4f}, 4);
  scene_embed(&s, scene_lattice(&s, 0, &box), &box);
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.damping_ratio = 0.2f;
  scene_body(&s, 0)->attributes.friction = 0.5f;
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  scene_start(&s);
  sbr_shape *press = collision_shape(collision_box(2, 0.5f, 2));
  sbr_collider_id id = collision_collider(&s, press, (sbr_double3){0, height + 0.52, 0});
  sbr_body_health h = {0};
  for (int i = 1; i <= END; i++) {
    double down = i < CLOSING ? (double)i / CLOSING : 1, gap = height + 0.02;
    gap = i <= SHUT ? gap + (fraction * height - gap) * down : gap + 0.05 * (i - SHUT);
    sbr_collider_move(s.world, id, (sbr_double3){0, gap + 0.5, 0}, (sbf_quat){0, 0, 0, 1});
    scene_ticks(&s, 1);
    h = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(h.finite);
    ck_assert_msg(h.recoveries == 0, "put back in tick %d", i);
    if (i == SHUT && !_i) ck_assert_double_lt(h.kinetic_j, 1);
    if (i >= REGAINED && i < LANDING) ck_assert(!h.inverted && fabsf(h.volume_ratio - 1) < 0.03f);
  }
  ck_assert_float_lt(h.max_strain, 0.2f);
  scene_free(&s);
  sbr_shape_destroy(press);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("collapsed");
  TCase *c = tcase_create("collapsed");
  tcase_add_loop_test(c, bodies_pressed_flat_are_not_reset, 0, 2);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
