#include "soft/solvers/compression_limit.h"

#include <math.h>

#include "harness.h"
#include "scene_state.h"
#include "scenes.h"
#include "state/world.h"

static const sbf_scheme schemes[] = {SBF_SCHEME_AUTOMATIC, SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED,
    SBF_SCHEME_HEUN, SBF_SCHEME_BLOCK_DESCENT};

static scene drop(sbf_scheme scheme, float speed) {
  scene s = scene_begin();
  /* Its lowest points are a thin tip that reaches down from a thick body. */
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){0.3f, 1, 0.3f}, 2, 5, 2, 1000, 6e4f, 0.45f);
  for (uint32_t i = 0; i < box.point_count; i++) {
    sbf_vec3 *p = &box.positions[i];
    float fraction = p->y < 0.41f ? 0.15f + 2 * p->y : 1;
    p->x = 0.15f + (p->x - 0.15f) * fraction, p->z = 0.15f + (p->z - 0.15f) * fraction;
  }
  scene_lattice(&s, 0, &box);
  lattice_box_free(&box);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0.05;
  scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
  s.model_options.scheme = scheme;
  scene_start(&s);
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++) scene_velocity(&s, i)[SBRI_BLOCK] = -speed;
  return s;
}

/* Falls onto the ground as fast as from 11 m, tip first. */
START_TEST(a_blow_inverts_no_element)
{
  scene s = drop(schemes[_i], 25);
  for (int i = 0; i < 90; i++) {
    scene_ticks(&s, 1);
    sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(h.finite);
    ck_assert_msg(!h.inverted, "tick %d, strain %g", i, (double)h.max_strain);
    ck_assert_uint_eq(h.recoveries, 0);
  }
  scene_free(&s);
}
END_TEST

/* One element is compressed to a fiftieth and still compressing. It returns to the limit and stops there
 * without loss of momentum. The J of an inverted element rises. */
START_TEST(the_wall_conserves_momentum)
{
  scene s = scene_begin();
  lattice_box box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 1, 1}, 1, 1, 1, 1000, 1e5f, 0.4f);
  scene_lattice(&s, 0, &box);
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  sbri_point *x = sbri_positions(&s.world->characters[0]);
  const sbri_tetrahedron_block *block = &island->tetrahedra.blocks[0];
  for (uint32_t i = 0; i < island->free_count; i++) {
    x[i].y *= _i ? -0.3f : 0.02f;
    scene_velocity(&s, i)[SBRI_BLOCK] = _i ? 0 : -x[i].y;
  }
  double before[4] = {0}, after[4] = {0};
  sbri_island_tick t = {.model = s.model,
      .island = island,
      .solids = {.blocks = island->tetrahedra.blocks},
      .positions = x,
      .velocities = sbri_velocities(&s.world->characters[0])};
  for (int n = 0; n < 2; n++) {
    double *sums = n ? after : before;
    for (uint32_t i = 0; i < island->free_count; i++) {
      double m = island->masses[i];
      sums[0] += m * (double)scene_velocity(&s, i)[0],
          sums[1] += m * (double)scene_velocity(&s, i)[SBRI_BLOCK];
      sums[2] += m * (double)x[i].x, sums[3] += m * (double)x[i].y;
    }
    if (!n) sbri_limit_compression(&t, block, 0);
  }
  for (int k = 0; k < 4; k++) ck_assert_double_eq_tol(after[k], before[k], 1e-3);
  sbf_vec3 d1 = sbri_edge_to(&t, block->corners[0][0], block->corners[1][0]),
           d2 = sbri_edge_to(&t, block->corners[0][0], block->corners[2][0]),
           d3 = sbri_edge_to(&t, block->corners[0][0], block->corners[3][0]);
  float ratio = sbri_dot(d1, sbri_cross(d2, d3)) * block->inverse_volume[0];
  if (_i)
    ck_assert_float_gt(ratio, -0.28f);
  else
    ck_assert_float_eq_tol(ratio, SBRI_MIN_VOLUME_RATIO, 0.01f);
  lattice_box_free(&box);
  scene_free(&s);
}
END_TEST

/* The sweep skips blocks without a mark. */
START_TEST(only_marked_blocks_are_swept)
{
  scene s = scene_begin();
  lattice_box box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 1, 1}, 1, 1, 1, 1000, 1e5f, 0.4f);
  scene_lattice(&s, 0, &box);
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  sbri_point *x = sbri_positions(&s.world->characters[0]);
  for (uint32_t i = 0; i < island->free_count; i++) x[i].y *= 0.02f;
  uint8_t marks[8] = {0};
  float ratio = 0.02f, y = x[0].y;
  bool stored = true;
  ck_assert_uint_le(island->tetrahedra.block_count, 8);
  sbri_island_tick t = {.model = s.model,
      .island = island,
      .solids = {.blocks = island->tetrahedra.blocks, .compressed = marks, .min_ratio = &ratio},
      .positions = x,
      .velocities = sbri_velocities(&s.world->characters[0])};
  ck_assert(!sbri_limit_compression_sweep(&t, &stored));
  ck_assert_float_eq(x[0].y, y);
  sbri_mark_all_compressed(&t);
  ck_assert(sbri_limit_compression_sweep(&t, &stored));
  sbri_update_compression(&t);
  ck_assert_float_gt(ratio, 0.02f);
  ck_assert_uint_eq(marks[0], 1);
  lattice_box_free(&box);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("crush");
  TCase *c = tcase_create("crush");
  tcase_add_loop_test(c, a_blow_inverts_no_element, 0, 5);
  tcase_add_loop_test(c, the_wall_conserves_momentum, 0, 2);
  tcase_add_test(c, only_marked_blocks_are_swept);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
