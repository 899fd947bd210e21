#include <stdlib.h>

#include "harness.h"
#include "mechanics/neo_hookean.h"
#include "model/runtime_model.h"
#include "scenes.h"
#include "soft/solvers/scheme.h"

static lattice_box box;

static void setup(void) {
  box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.4f, 0.6f}, 5, 2, 3, 1000, 5e4f, 0.4f);
}
static void teardown(void) {
  lattice_box_free(&box);
}

static bool is_inert(const sbri_tetrahedron_block *block, uint32_t lane) {
  return block->shear[lane] == 0;
}

typedef struct found {
  uint32_t elements, shared, inert;
  double volume;
} found;

/* Of the blocks from `begin` to `end`; `marks` holds numbers of blocks by slots. */
static found check(const sbri_island *island, uint32_t begin, uint32_t end, uint32_t *marks) {
  found f = {0};
  for (uint32_t b = begin; b < end; b++) {
    const sbri_tetrahedron_block *block = &island->tetrahedra.blocks[b];
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
      if (is_inert(block, lane)) {
        ck_assert_float_eq(block->bulk[lane], 0);
        for (int i = 0; i < 6; i++) ck_assert_float_eq(block->stiffness[i][lane], 0);
        f.inert++;
        continue;
      }
      f.elements++;
      f.volume += 1 / (6 * (double)block->inverse_volume[lane]);
      for (int k = 0; k < 4; k++) {
        uint32_t slot = block->corners[k][lane];
        ck_assert_uint_lt(slot, island->slot_count);
        if (slot >= island->free_count) continue;
        f.shared += marks[slot] == b + 1;
        marks[slot] = b + 1;
      }
    }
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) /* inactive lanes write to unused slots */
      if (is_inert(block, lane) && block->corners[0][lane] < island->free_count)
        ck_assert_uint_ne(marks[block->corners[0][lane]], b + 1);
  }
  return f;
}

/* Forces and sweeps visit each element once. In a sweep, elements of a block share no free point. */
START_TEST(blocks_contain_each_tetrahedron_once)
{
  scene s = scene_begin();
  if (_i == 0) lattice_box_hold(&box);
  scene_lattice(&s, 0, &box);
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  uint32_t full = island->tetrahedra.full_count, dense = island->tetrahedra.dense_count,
           *marks = calloc(island->slot_count, sizeof *marks);
  ck_assert_ptr_nonnull(marks);
  ck_assert_uint_eq(island->tetrahedra.count, box.tetrahedron_count);
  ck_assert_uint_eq(dense, (box.tetrahedron_count + 7) / SBRI_BLOCK);
  ck_assert_uint_le(full, dense);
  found firsts = check(island, 0, full, marks);
  found loose = check(island, full, dense, marks);
  found again = check(island, dense, island->tetrahedra.block_count, marks);
  free(marks);
  ck_assert_uint_eq(firsts.inert, 0);
  ck_assert_uint_eq(firsts.shared + again.shared, 0);
  ck_assert_uint_eq(firsts.elements + loose.elements, box.tetrahedron_count);
  ck_assert_uint_eq(loose.elements, again.elements);
  ck_assert_uint_le(loose.shared, 200); /* of 720 corners; 300 and more in the order of the lattice */
  ck_assert_double_eq_tol(firsts.volume + loose.volume, 0.24, 1e-6);
  ck_assert_double_eq_tol(again.volume, loose.volume, 1e-6);
  for (uint32_t t = 0; t < box.tetrahedron_count; t++)
    for (int k = 0; k < 4; k++) {
      uint32_t slot = s.model->bodies[0].slots.from_point[box.tetrahedra[t].at[k]];
      for (int n = 0; n < 2; n++) {
        uint32_t at = island->tetrahedra.lanes[2 * t + (uint32_t)n];
        ck_assert_uint_eq(island->tetrahedra.blocks[at / SBRI_BLOCK].corners[k][at % SBRI_BLOCK], slot);
        ck_assert(at / SBRI_BLOCK < full || (at / SBRI_BLOCK < dense) == (n == 0));
      }
    }
  scene_free(&s);
}
END_TEST

START_TEST(numbers_of_a_lane)
{
  /* One tetrahedron: corners (0,0,0), (1,0,0), (0,1,0), (0,0,1); V = 1/6, and the gradients are the axes. */
  scene s = scene_begin();
  const sbf_vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  sbf_uint4 corners = {{0, 1, 2, 3}};
  sbf_level *level = scene_points(&s, 0, positions, NULL, 4);
  level->model = SBF_ELASTIC_MODEL_TETRAHEDRA;
  level->lattice.tetrahedra = (sbf_uint4_list){&corners, 1};
  scene_body(&s, 0)->attributes.young_modulus = 1000;
  scene_body(&s, 0)->attributes.poisson_ratio = 0.25f;
  scene_body(&s, 0)->attributes.density = 24;
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  const sbri_tetrahedron_block *block = &island->tetrahedra.blocks[0];
  ck_assert_uint_eq(island->tetrahedra.dense_count, 1);
  const float expected[6] = {400.0f / 6, 400.0f / 6, 400.0f / 6, 0, 0, 0}; /* mu = 400 Pa */
  for (int i = 0; i < 6; i++) ck_assert_float_eq_tol(block->stiffness[i][0], expected[i], 1e-4f);
  ck_assert_float_eq_tol(block->inverse_volume[0], 1, 1e-6f);
  ck_assert_float_eq_tol(block->bulk[0], 800.0f / 6, 1e-4f);
  ck_assert_float_eq_tol(block->shear[0], 400.0f / 6, 1e-4f);
  for (int i = 0; i < 4; i++) ck_assert_float_eq_tol(island->masses[i], 1, 1e-6f); /* a quarter each */
  ck_assert_uint_eq(sbr_model_report_unsupported(s.model, NULL, NULL), 0);
  scene_free(&s);
}
END_TEST

/* Each element's own beta, if the lattice states them; time steps go by the greatest. */
START_TEST(elements_are_damped_as_stated)
{
  scene s = scene_begin();
  sbf_level *level = scene_lattice(&s, 0, &box);
  float *stated = calloc(box.tetrahedron_count, sizeof *stated);
  ck_assert_ptr_nonnull(stated);
  for (uint32_t t = 0; t < box.tetrahedron_count; t++) stated[t] = 1e-3f * (float)(t % 7);
  level->lattice.stiffness_damping = (sbf_f32_list){stated, box.tetrahedron_count};
  scene_body(&s, 0)->attributes.stiffness_damping = 1;
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  ck_assert_double_eq_tol(island->springs.stiffness_damping_s, 6e-3, 1e-8);
  for (uint32_t t = 0; t < box.tetrahedron_count; t++)
    ck_assert_float_eq(island->tetrahedra.damping[island->tetrahedra.lanes[2 * t]], stated[t]);
  scene_free(&s);
  free(stated);
}
END_TEST

START_TEST(beside_tetrahedra_only_extra_springs_act)
{
  scene s = scene_begin();
  sbf_level *level = scene_lattice(&s, 0, &box);
  const float stiffness = 10;
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &stiffness, 1);
  scene_start(&s);
  ck_assert_uint_eq(s.model->islands[0].springs.count, 0);
  sbr_world_destroy(s.world);
  sbr_model_destroy(s.model);
  ((sbf_spring_set *)(uintptr_t)level->springs.at)->extra = true;
  scene_start(&s);
  ck_assert_uint_eq(s.model->islands[0].springs.count, 1);
  ck_assert_uint_eq(s.model->islands[0].tetrahedra.count, box.tetrahedron_count);
  scene_free(&s);
}
END_TEST

START_TEST(tetrahedra_of_a_level_of_springs_do_not_act)
{
  scene s = scene_begin();
  scene_lattice(&s, 0, &box)->model = SBF_ELASTIC_MODEL_SPRINGS;
  scene_start(&s);
  ck_assert_uint_eq(s.model->islands[0].tetrahedra.count, 0);
  ck_assert_uint_eq(sbr_model_report_unsupported(s.model, NULL, NULL), 1);
  scene_free(&s);
}
END_TEST

START_TEST(the_relaxation_scheme_is_replaced)
{
  scene s = scene_begin();
  scene_lattice(&s, 0, &box)->simulation.scheme = SBF_SCHEME_RELAXATION;
  scene_start(&s);
  ck_assert_ptr_eq(s.model->islands[0].scheme, &sbri_symplectic);
  scene_free(&s);
}
END_TEST

START_TEST(memory_may_run_out)
{
  scene s = scene_begin();
  lattice_box_hold(&box);
  scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->attributes.stiffness_damping = 1e-4f;
  scene_models_survive_want(&s);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *s = suite_create("island_tetrahedra");
  TCase *c = tcase_create("island_tetrahedra");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_loop_test(c, blocks_contain_each_tetrahedron_once, 0, 2);
  tcase_add_test(c, numbers_of_a_lane);
  tcase_add_test(c, elements_are_damped_as_stated);
  tcase_add_test(c, beside_tetrahedra_only_extra_springs_act);
  tcase_add_test(c, tetrahedra_of_a_level_of_springs_do_not_act);
  tcase_add_test(c, the_relaxation_scheme_is_replaced);
  tcase_add_test(c, memory_may_run_out);
  suite_add_tcase(s, c);
  return harness_run(s);
}
