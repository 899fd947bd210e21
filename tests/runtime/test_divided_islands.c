/* Large islands, whose work is divided among tasks. */
#include <stdlib.h>

#include "collision_scenes.h"
#include "harness.h"
#include "host_threads.h"
#include "scene_state.h"
#include "soft/soft.h"
#include "state/world.h"

enum { TICKS = 4 };

typedef enum kind { FALLING, HELD, YIELDING, TEARING, SHEET, STEPPED_BY_SWEEPS, KINDS } kind;

/* 29,478 tetrahedra: enough for two parts. It has a surface that may touch itself and the ground. */
static void make_block(scene *s, kind which) {
  sbf_attributes *attributes = &scene_body(s, 0)->attributes;
  lattice_box box =
      lattice_box_make((sbf_vec3){-0.5f, 0, -0.5f}, (sbf_vec3){1, 1, 1}, 17, 17, 17, 1000, 2e4f, 0.3f);
  scene_bone(s, (sbf_vec3){0, 0.5f, 0});
  scene_section(s, 0, (sbf_vec3){0, 0.5f, 0}, (sbf_vec3){1, 1, 1}, 4);
  if (which == HELD) lattice_box_hold(&box);
  scene_embed(s, scene_lattice(s, 0, &box), &box);
  lattice_box_free(&box);
  attributes->damping_ratio = 0.1f;
  attributes->stiffness_damping = which == FALLING ? 1e-3f : 0;
  scene_body(s, 0)->collision.self = which == FALLING;
  if (which == YIELDING) attributes->yield_strain = 0.01f, attributes->yield_flow = 20;
  if (which == TEARING) attributes->tear_strain = 0.05f;
  if (which == STEPPED_BY_SWEEPS) s->model_options.scheme = SBF_SCHEME_POSITION_BASED;
}

static scene begin(kind which, sbr_tasks tasks) {
  scene s = scene_begin();
  if (which == SHEET) {
    collision_sheet(&s, 0, (sbf_vec3){0, 0.02f, 0}, 1, 80, false);
    scene_body(&s, 0)->collision.self = true;
    scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
  } else {
    make_block(&s, which);
  }
  s.world_definition.ground = sbr_ground_slope(10);
  s.world_definition.tasks = tasks;
  s.character_definition.position = (sbr_double3){0, 0.1, 0};
  scene_start(&s);
  return s;
}

/* Steps the model in a world of its own. */
static uint64_t hash_after_ticks(scene *s, kind which, sbr_tasks tasks) {
  sbr_world_destroy(s->world);
  s->world_definition.tasks = tasks;
  ck_assert(sbr_world_create(&s->world_definition, &s->world, NULL) == SBF_OK);
  ck_assert(
      sbr_character_create(s->world, s->model, &s->character_definition, &s->character, NULL) == SBF_OK);
  for (uint32_t i = 0; i < s->model->islands[0].free_count; i++)
    scene_velocity(s, i)[0] = 0.5f, scene_velocity(s, i)[SBRI_BLOCK] = which == HELD ? 1 : -2;
  scene_ticks(s, TICKS);
  return sbr_world_get_state_hash(s->world);
}

START_TEST(any_number_of_threads_gives_the_same_bits)
{
  scene s = begin((kind)_i, (sbr_tasks){NULL, NULL});
  uint64_t expected = hash_after_ticks(&s, (kind)_i, (sbr_tasks){NULL, NULL});
  for (int threads = 1; threads <= 8; threads = threads == 3 ? 8 : threads + 1)
    ck_assert_uint_eq(hash_after_ticks(&s, (kind)_i, (sbr_tasks){run_on_threads, &threads}), expected);
  if (_i == TEARING) ck_assert_uint_gt(sbr_character_get_body_health(s.world, s.character, 0).torn, 0);
  scene_free(&s);
}
END_TEST

/* ---- Divided islands ---- */

/* One thread that counts the batches of more than one task. */
static void run_and_count(void *user, sbr_task *task, void *context, uint32_t count) {
  *(uint32_t *)user += count > 1;
  for (uint32_t i = 0; i < count; i++) task(context, i);
}

static uint32_t batches_of_a_tick(kind which) {
  uint32_t batches = 0;
  scene s = begin(which, (sbr_tasks){run_and_count, &batches});
  scene_ticks(&s, 1);
  batches = 0;
  scene_ticks(&s, 1);
  scene_free(&s);
  return batches;
}

/* Two batches or more in each substep. Points that split change the elements, so bodies
 * that tear are stepped by one task; sweeps are too. */
START_TEST(tasks_divide_explicit_substeps_of_large_islands)
{
  ck_assert_uint_gt(batches_of_a_tick(FALLING), 3);
  ck_assert_uint_gt(batches_of_a_tick(HELD), 3);
  ck_assert_uint_gt(batches_of_a_tick(YIELDING), 3);
  ck_assert_uint_gt(batches_of_a_tick(SHEET), 3);
  ck_assert_uint_le(batches_of_a_tick(TEARING), 2);
  ck_assert_uint_le(batches_of_a_tick(STEPPED_BY_SWEEPS), 2);
}
END_TEST

/* Every element is in one part, and each corner's force goes to its slot or to an entry of that slot. */
START_TEST(parts_have_each_force_once)
{
  scene s = begin(FALLING, (sbr_tasks){NULL, NULL});
  const sbri_island *island = &s.model->islands[0];
  const sbri_force_parts *parts = island->tetrahedra.parts;
  ck_assert_ptr_nonnull(parts);
  ck_assert_uint_eq(parts->count, 2);
  ck_assert_uint_eq(parts->begins[0], 0);
  ck_assert_uint_eq(parts->begins[parts->count], island->tetrahedra.dense_count);
  uint32_t *slots = calloc(parts->entry_count, sizeof *slots), entries = 0;
  uint32_t *owners = calloc(island->slot_count, sizeof *owners);
  ck_assert(slots && owners);
  for (uint32_t i = 0; i < parts->shared_count; i++)
    for (uint32_t e = parts->entry_begins[i]; e < parts->entry_begins[i + 1]; e++)
      slots[e] = parts->shared_slots[i];
  for (uint32_t p = 0; p < parts->count; p++)
    for (uint32_t b = parts->begins[p]; b < parts->begins[p + 1]; b++)
      for (uint32_t i = 0; i < 4 * SBRI_BLOCK; i++) {
        uint32_t slot = island->tetrahedra.blocks[b].corners[i / SBRI_BLOCK][i % SBRI_BLOCK];
        uint32_t row = parts->rows_of[b],
                 target = row == UINT32_MAX ? slot : parts->rows[row].at[i / SBRI_BLOCK][i % SBRI_BLOCK];
        if (target < parts->first_entry) {
          ck_assert_uint_eq(target, slot);
          ck_assert(owners[slot] == 0 || owners[slot] == p + 1);
          owners[slot] = p + 1;
        } else {
          ck_assert_uint_eq(slots[target - parts->first_entry], slot);
          slots[target - parts->first_entry] = UINT32_MAX; /* taken */
          entries++;
        }
      }
  ck_assert_uint_eq(entries, parts->entry_count);
  ck_assert_uint_lt(entries, island->tetrahedra.count); /* a layer of points between the parts */
  free(slots), free(owners);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("divided_islands");
  TCase *c = tcase_create("divided_islands");
  tcase_set_timeout(c, 120);
  tcase_add_loop_test(c, any_number_of_threads_gives_the_same_bits, 0, KINDS);
  tcase_add_test(c, tasks_divide_explicit_substeps_of_large_islands);
  tcase_add_test(c, parts_have_each_force_once);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
