#include "soft/solvers/tetrahedron_forces.h"

#include <stdlib.h>

#include "harness.h"
#include "mechanics/neo_hookean.h"
#include "mechanics/static_solve.h"
#include "momentum.h"
#include "random.h"
#include "scene_state.h"
#include "scenes.h"
#include "state/state.h"
#include "state/world.h"

static lattice_box box;
static scene s;
static sbri_island_tick tick;
static sbri_point *positions, *velocities, *forces;
static uint8_t *compressed;
static const float beta = 2e-3f;

static void begin(float damping_s) {
  box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){0.6f, 0.4f, 0.4f}, 3, 2, 2, 1000, 5e4f, 0.4f);
  s = scene_begin();
  scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->attributes.stiffness_damping = damping_s;
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  positions = calloc(island->slot_count, sizeof *positions);
  velocities = calloc(island->slot_count, sizeof *velocities);
  forces = calloc(island->slot_count, sizeof *forces);
  compressed = calloc(island->tetrahedra.block_count, 1);
  ck_assert(positions && velocities && forces && compressed);
  memcpy(positions, island->rest, island->slot_count * sizeof *positions);
  tick = (sbri_island_tick){.model = s.model,
      .island = island,
      .solids = {.blocks = island->tetrahedra.blocks, .compressed = compressed},
      .positions = positions,
      .scratch = {.velocity_points = velocities, .element_forces = forces}};
}
static void end(void) {
  free(positions);
  free(velocities);
  free(forces);
  free(compressed);
  scene_free(&s);
  lattice_box_free(&box);
}

static sbfi_d3 position(const sbri_point *points, uint32_t slot) {
  return (sbfi_d3){points[slot].x, points[slot].y, points[slot].z};
}

/* Forces in double precision, by slots. */
static void expected_forces(sbfi_d3 *sums) {
  const sbri_body *body = &s.model->bodies[0];
  for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
    sbfi_tetrahedron element;
    sbfi_d3 x[4], f[4];
    ck_assert(sbri_body_tetrahedron(body, t, &element));
    for (int k = 0; k < 4; k++) x[k] = position(positions, body->slots.from_point[box.tetrahedra[t].at[k]]);
    sbfi_tetrahedron_compute_forces(&element, x, f);
    for (int k = 0; k < 4; k++) {
      sbfi_d3 *to = &sums[body->slots.from_point[box.tetrahedra[t].at[k]]];
      *to = sbfi_d3_add(*to, f[k]);
    }
  }
}

START_TEST(forces_are_those_of_the_energy)
{
  /* Shaken a little, and so that most elements are inside out. */
  begin(0);
  float shake = _i ? 0.4f : 0.03f;
  const sbri_island *island = tick.island;
  for (uint32_t i = 0; i < island->slot_count; i++) {
    positions[i].x += shake * random_scattered(3 * i);
    positions[i].y += shake * random_scattered(3 * i + 1);
    positions[i].z += shake * random_scattered(3 * i + 2);
  }
  sbfi_d3 *sums = calloc(island->slot_count, sizeof *sums);
  expected_forces(sums);
  sbri_compute_tetrahedron_forces(&tick, NULL);
  double max = 0, worst = 0;
  sbfi_d3 total = {0, 0, 0};
  for (uint32_t i = 0; i < island->slot_count; i++) {
    worst = fmax(worst, sbfi_d3_length(sbfi_d3_sub(position(forces, i), sums[i])));
    max = fmax(max, sbfi_d3_length(sums[i]));
    total = sbfi_d3_add(total, position(forces, i));
  }
  ck_assert_double_gt(max, 1);
  ck_assert_double_le(worst, 2e-5 * max);
  ck_assert_double_le(sbfi_d3_length(total), 1e-4 * max);
  free(sums);
  end();
}
END_TEST

START_TEST(damping_is_the_second_derivative_times_the_velocity)
{
  begin(beta);
  const sbri_body *body = &s.model->bodies[0];
  sbfi_d3 *sums = calloc(tick.island->slot_count, sizeof *sums);
  for (uint32_t i = 0; i < tick.island->slot_count; i++)
    velocities[i] =
        (sbri_point){random_scattered(7 * i), random_scattered(7 * i + 1), random_scattered(7 * i + 2), 0};
  for (uint32_t t = 0; t < body->elements.tetrahedron_count; t++) {
    sbfi_tetrahedron element;
    sbfi_d3 x[4], v[4], f[4];
    ck_assert(sbri_body_tetrahedron(body, t, &element));
    for (int k = 0; k < 4; k++) {
      x[k] = position(positions, body->slots.from_point[box.tetrahedra[t].at[k]]);
      v[k] = position(velocities, body->slots.from_point[box.tetrahedra[t].at[k]]);
    }
    sbfi_tetrahedron_product(&element, x, v, f);
    for (int k = 0; k < 4; k++) {
      sbfi_d3 *to = &sums[body->slots.from_point[box.tetrahedra[t].at[k]]];
      *to = sbfi_d3_sub(*to, sbfi_d3_scale(f[k], (double)beta));
    }
  }
  sbri_compute_tetrahedron_forces(&tick, NULL);
  double max = 0, worst = 0;
  for (uint32_t i = 0; i < tick.island->slot_count; i++) {
    worst = fmax(worst, sbfi_d3_length(sbfi_d3_sub(position(forces, i), sums[i])));
    max = fmax(max, sbfi_d3_length(sums[i]));
  }
  ck_assert_double_gt(max, 1);
  ck_assert_double_le(worst, 1e-4 * max);
  free(sums);
  end();
}
END_TEST

START_TEST(damping_does_not_slow_rotation)
{
  /* Deformed and spinning as a rigid body: the same forces as at rest. In any motion it takes energy. */
  begin(beta);
  uint32_t count = tick.island->slot_count;
  for (uint32_t i = 0; i < count; i++) {
    sbri_point *p = &positions[i];
    p->x *= 1.4f, p->y += 0.3f * p->x, p->z *= 0.7f;
  }
  sbri_point *still = calloc(count, sizeof *still);
  sbri_compute_tetrahedron_forces(&tick, NULL);
  memcpy(still, forces, count * sizeof *still);
  for (uint32_t i = 0; i < count; i++) {
    const sbri_point *p = &positions[i];
    velocities[i] = (sbri_point){3 * p->z - 2 * p->y, 2 * p->x - p->z, p->y - 3 * p->x, 0};
  }
  sbri_compute_tetrahedron_forces(&tick, NULL);
  double max = 0;
  for (uint32_t i = 0; i < count; i++) max = fmax(max, sbfi_d3_length(position(still, i)));
  for (uint32_t i = 0; i < count; i++)
    ck_assert_double_le(sbfi_d3_length(sbfi_d3_sub(position(forces, i), position(still, i))), 1e-4 * max);
  for (uint32_t i = 0; i < count; i++)
    velocities[i] =
        (sbri_point){random_scattered(7 * i), random_scattered(7 * i + 1), random_scattered(7 * i + 2), 0};
  sbri_compute_tetrahedron_forces(&tick, NULL);
  double power = 0;
  for (uint32_t i = 0; i < count; i++)
    power += sbfi_d3_dot(sbfi_d3_sub(position(forces, i), position(still, i)), position(velocities, i));
  ck_assert_double_lt(power, 0);
  free(still);
  end();
}
END_TEST

START_TEST(the_watched_strains_are_recorded)
{
  begin(0);
  sbri_tetrahedron_watch watch;
  sbri_watch_begin(&watch);
  sbri_compute_tetrahedron_forces(&tick, &watch);
  ck_assert_float_eq_tol(sbri_watch_stiffening(&watch), 1, 1e-4f);
  ck_assert_float_eq_tol(sbri_watch_min_ratio(&watch), 1, 1e-4f);
  /* Uniformly scaled by 1.5: cof F grows by 2.25, and lambda (J - 1) - mu beyond the mu of rest. */
  for (uint32_t i = 0; i < tick.island->slot_count; i++)
    positions[i] = (sbri_point){1.5f * positions[i].x, 1.5f * positions[i].y, 1.5f * positions[i].z, 0};
  sbfi_lame lame = sbfi_lame_of(5e4, 0.4);
  double max = lame.mu + lame.lambda;
  double expected = (lame.mu + 2.25 * 2.25 * lame.lambda + lame.lambda * 2.375 - 2 * lame.mu) / max;
  sbri_watch_begin(&watch);
  sbri_compute_tetrahedron_forces(&tick, &watch);
  ck_assert_double_eq_tol(sbri_watch_stiffening(&watch), expected, 1e-3 * expected);
  ck_assert_float_eq(sbri_watch_min_ratio(&watch), 1);
  for (uint32_t i = 0; i < tick.island->slot_count; i++) positions[i].y *= -0.5f;
  sbri_watch_begin(&watch);
  sbri_compute_tetrahedron_forces(&tick, &watch);
  ck_assert_float_eq_tol(sbri_watch_min_ratio(&watch), -0.5f * 1.5f * 1.5f * 1.5f, 1e-3f);
  end();
}
END_TEST

/* A point is pushed into its body: only blocks with one of its elements are marked, and all of those with an
 * element below half its volume. */
START_TEST(blocks_of_compressed_elements_are_marked)
{
  begin(0);
  sbri_tetrahedron_watch watch;
  const sbri_island *island = tick.island;
  uint32_t slot = s.model->bodies[0].slots.from_point[0], marked = 0;
  positions[slot].x += 0.14f, positions[slot].y += 0.14f, positions[slot].z += 0.14f;
  sbri_watch_begin(&watch);
  sbri_compute_tetrahedron_forces(&tick, &watch);
  for (uint32_t b = 0; b < island->tetrahedra.dense_count; b++) {
    const sbri_tetrahedron_block *block = &island->tetrahedra.blocks[b];
    bool any = false;
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane++) {
      sbfi_d3 x[4];
      for (int k = 0; k < 4; k++) x[k] = position(positions, block->corners[k][lane]);
      double six = sbfi_d3_dot(
          sbfi_d3_sub(x[1], x[0]), sbfi_d3_cross(sbfi_d3_sub(x[2], x[0]), sbfi_d3_sub(x[3], x[0])));
      any = any || (block->shear[lane] > 0 && six * (double)block->inverse_volume[lane] < 0.5);
    }
    ck_assert_uint_eq(compressed[b], any);
    marked += any;
  }
  ck_assert_uint_gt(marked, 0);
  ck_assert_uint_lt(marked, island->tetrahedra.dense_count);
  end();
}
END_TEST

/* ---- Bodies ---- */

/* 1 x 0.2 x 0.2 m along x, held at x = 0, E = 1e6 Pa, nu = 0.4. */
static void begin_beam(uint32_t along, float damping_ratio, sbf_vec3 gravity) {
  box = lattice_box_make(
      (sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, along, along / 5, along / 5, 1000, 1e6f, 0.4f);
  lattice_box_hold(&box);
  s = scene_begin();
  scene_lattice(&s, 0, &box);
  scene_body(&s, 0)->attributes.damping_ratio = damping_ratio;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = gravity;
  scene_start(&s);
}
static void end_beam(void) {
  scene_free(&s);
  lattice_box_free(&box);
}
static float tip_height(void) {
  return scene_point(&s, 0, lattice_box_point(&box, box.cells[0], 0, 0)).y;
}

START_TEST(a_beam_comes_to_rest_at_its_static_deflection)
{
  begin_beam(10, 1, (sbf_vec3){0, -9.81f, 0});
  sbf_spring_network network = lattice_box_network(&box);
  double *points = calloc(3 * (size_t)box.point_count, sizeof *points);
  sbfi_static_problem problem = {.network = &network, .gravity = {0, -9.81f, 0}};
  sbfi_static_outcome outcome;
  sbfi_static_start(&network, points);
  ck_assert(sbfi_static_solve(&problem, points, &outcome, NULL) && outcome.converged);
  scene_ticks(&s, 240);
  static sbf_vec3 read[1024];
  uint32_t count = scene_read(&s, 0, read, 1024);
  ck_assert_uint_eq(count, box.point_count);
  for (uint32_t i = 0; i < count; i++) {
    ck_assert_double_eq_tol(read[i].x, points[3 * i], 2e-4);
    ck_assert_double_eq_tol(read[i].y, points[3 * i + 1], 2e-4);
    ck_assert_double_eq_tol(read[i].z, points[3 * i + 2], 2e-4);
  }
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(!health.inverted && health.finite);
  ck_assert_float_gt(health.max_strain, 0.05f);
  ck_assert_float_lt(health.max_strain, 0.6f);
  ck_assert_uint_eq(health.recoveries, 0);
  free(points);
  end_beam();
}
END_TEST

START_TEST(a_beam_oscillates_at_its_lowest_frequency)
{
  /* With a load small enough for linear strain; tests/mechanics tests the mode itself. */
  begin_beam(10, 0, (sbf_vec3){0, -0.02f, 0});
  sbf_spring_network network = lattice_box_network(&box);
  double *scratch = calloc(16 * (size_t)box.point_count, sizeof *scratch);
  double exact = 2 * 3.14159265358979 / sbf_network_lowest(&network, true, scratch), low = 0;
  free(scratch);
  /* From rest it falls and returns after a period. Its mean height over whole periods is its static height,
   * which it crosses twice in each. */
  uint32_t ticks = 400, crossings = 0;
  float heights[400];
  for (uint32_t i = 0; i < ticks; i++) {
    heights[i] = tip_height();
    low += heights[i] / (double)ticks;
    scene_ticks(&s, 1);
  }
  double first = -1, last = -1;
  for (uint32_t i = 1; i < ticks; i++) {
    if (!(heights[i - 1] < low && heights[i] >= low)) continue;
    last = ((i - 1) + (low - heights[i - 1]) / (heights[i] - heights[i - 1])) / 60;
    if (first < 0) first = last;
    crossings++;
  }
  ck_assert_uint_gt(crossings, 4);
  ck_assert_double_eq_tol((last - first) / (crossings - 1), exact, 0.01 * exact);
  end_beam();
}
END_TEST

START_TEST(energy_and_momentum_are_kept)
{
  begin(0);
  s.world_definition.has_gravity = true;
  sbr_world_destroy(s.world);
  s.world = NULL;
  sbr_model_destroy(s.model);
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  s.model_options.substeps = 8; /* always the same */
  scene_start(&s);
  sbri_character *c = &s.world->characters[0];
  const sbri_island *island = &s.model->islands[0];
  sbri_point *x = sbri_positions(c);
  for (uint32_t i = 0; i < island->free_count; i++) {
    float *at = scene_velocity(&s, i);
    if (!(island->masses[i] > 0)) continue;
    x[i].x *= 1.15f, x[i].y *= 0.9f;
    at[0] = 0.5f - x[i].y, at[SBRI_BLOCK] = x[i].x, at[2 * SBRI_BLOCK] = 0.3f * random_scattered(i);
  }
  scene_momentum sums[2];
  double energies[2] = {0};
  for (int n = 0; n < 2; n++) {
    sums[n] = scene_momentum_of(&s);
    for (int i = 0; i < 600; i++) {
      sbr_body_health h = sbr_character_get_body_health(s.world, s.character, 0);
      energies[n] += (h.kinetic_j + h.elastic_j) / 600;
      scene_ticks(&s, 1);
    }
  }
  double max = 2e-4 * fabs(sums[0].linear[0]);
  for (int k = 0; k < 3; k++) {
    ck_assert_double_eq_tol(sums[1].linear[k], sums[0].linear[k], max);
    ck_assert_double_eq_tol(sums[1].angular[k], sums[0].angular[k], max);
  }
  ck_assert_double_eq_tol(energies[1], energies[0], 2e-3 * energies[0]);
  end();
}
END_TEST

START_TEST(far_from_the_world_s_origin_as_near)
{
  sbf_vec3 tips[2];
  for (int n = 0; n < 2; n++) {
    begin_beam(5, 0.2f, (sbf_vec3){0, -9.81f, 0});
    if (n) sbr_character_teleport(s.world, s.character, (sbr_double3){1e6, 1000, -2e6}, 0);
    scene_ticks(&s, 60);
    tips[n] = scene_point(&s, 0, lattice_box_point(&box, 5, 0, 0));
    end_beam();
  }
  ck_assert_float_eq_tol(tips[1].x, tips[0].x, 1e-5f);
  ck_assert_float_eq_tol(tips[1].y, tips[0].y, 1e-5f);
  ck_assert_float_eq_tol(tips[1].z, tips[0].z, 1e-5f);
}
END_TEST

/* Flattened to a plane, mirrored, scrambled: no number becomes invalid, and after a second the shape is back,
 * by itself or by recovery. */
START_TEST(bad_starts_recover)
{
  begin(0);
  sbr_world_destroy(s.world);
  s.world = NULL;
  sbr_model_destroy(s.model);
  scene_body(&s, 0)->attributes.damping_ratio = 0.3f;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  scene_spoil(&s, (bad_start)_i);
  scene_comes_back(&s);
  end();
}
END_TEST

START_TEST(substeps_increase_as_it_stiffens)
{
  /* Much softer than its weight requires: it stretches to more than twice its length, where the substeps for
   * rest would be unstable. */
  box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, 10, 2, 2, 1000, 5e3f, 0.4f);
  lattice_box_hold(&box);
  s = scene_begin();
  scene_lattice(&s, 0, &box);
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){9.81f, 0, 0};
  scene_start(&s);
  const sbri_island_state *state = sbri_island_states(&s.world->characters[0]);
  float max_stretch = 0, max_stiffening = 1;
  for (int i = 0; i < 300; i++) {
    scene_ticks(&s, 1);
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(health.finite);
    ck_assert_uint_eq(health.recoveries, 0);
    max_stretch = health.max_strain > max_stretch ? health.max_strain : max_stretch;
    max_stiffening = state->stiffening > max_stiffening ? state->stiffening : max_stiffening;
  }
  ck_assert_float_gt(max_stretch, 1.5f);
  ck_assert_float_gt(max_stiffening, 2);
  end_beam();
}
END_TEST

START_TEST(a_snapshot_stores_the_whole_state)
{
  begin_beam(5, 0.2f, (sbf_vec3){0, -9.81f, 0});
  scene_ticks(&s, 20);
  size_t size = sbr_world_get_snapshot_size(s.world);
  void *bytes = malloc(size);
  ck_assert_int_eq(sbr_world_save_snapshot(s.world, bytes, size), SBF_OK);
  scene_ticks(&s, 30);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  ck_assert_int_eq(sbr_world_restore_snapshot(s.world, bytes, size), SBF_OK);
  scene_ticks(&s, 30);
  ck_assert_uint_eq(sbr_world_get_state_hash(s.world), hash);
  free(bytes);
  end_beam();
}
END_TEST

int main(void) {
  Suite *suite = suite_create("tetrahedron_forces");
  TCase *c = tcase_create("tetrahedron_forces");
  tcase_add_loop_test(c, forces_are_those_of_the_energy, 0, 2);
  tcase_add_test(c, damping_is_the_second_derivative_times_the_velocity);
  tcase_add_test(c, damping_does_not_slow_rotation);
  tcase_add_test(c, the_watched_strains_are_recorded);
  tcase_add_test(c, blocks_of_compressed_elements_are_marked);
  tcase_add_test(c, a_beam_comes_to_rest_at_its_static_deflection);
  tcase_add_test(c, a_beam_oscillates_at_its_lowest_frequency);
  tcase_add_test(c, energy_and_momentum_are_kept);
  tcase_add_test(c, far_from_the_world_s_origin_as_near);
  tcase_add_loop_test(c, bad_starts_recover, 0, 3);
  tcase_add_test(c, substeps_increase_as_it_stiffens);
  tcase_add_test(c, a_snapshot_stores_the_whole_state);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
