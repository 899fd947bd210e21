#include "soft/solvers/solid_limits.h"

#include <stdlib.h>

#include "harness.h"
#include "mechanics/solid_strain.h"
#include "scene_state.h"
#include "scenes.h"
#include "state/state.h"
#include "state/world.h"

static lattice_box box;
static scene s;
static const sbf_scheme schemes[] = {
    SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_HEUN, SBF_SCHEME_EXPLICIT_EULER};

static void begin(uint32_t along, float young_pa, bool pinned, sbf_vec3 gravity) {
  box = lattice_box_make(
      (sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, along, along / 5, along / 5, 1000, young_pa, 0.4f);
  if (pinned) lattice_box_hold(&box);
  s = scene_begin();
  scene_lattice(&s, 0, &box);
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = gravity;
}
static void end(void) {
  scene_free(&s);
  lattice_box_free(&box);
}
static sbf_attributes *attributes(void) {
  return &scene_body(&s, 0)->attributes;
}
static void sum_momenta(double sums[6]) {
  sbri_character *c = &s.world->characters[0];
  const sbri_island island = sbri_island_now(c, &s.model->islands[0]);
  for (int k = 0; k < 6; k++) sums[k] = 0;
  for (uint32_t i = 0; i < island.free_count; i++) {
    const float *v = scene_velocity(&s, i);
    const sbri_point *x = &sbri_positions(c)[i];
    double m = island.masses[i];
    sbfi_d3 p = {m * v[0], m * v[SBRI_BLOCK], m * v[2 * SBRI_BLOCK]},
            turn = sbfi_d3_cross((sbfi_d3){x->x, x->y, x->z}, p);
    const double parts[6] = {p.x, p.y, p.z, turn.x, turn.y, turn.z};
    for (int k = 0; k < 6; k++) sums[k] += parts[k];
  }
}

/* Hanging by its own weight it would stretch by half; the limit is at a tenth. */
START_TEST(strains_stay_within_their_limits)
{
  begin(5, 2e4f, true, (sbf_vec3){9.81f, 0, 0});
  attributes()->strain_max = 0.1f, attributes()->strain_min = -0.2f;
  attributes()->damping_ratio = 0.5f;
  s.model_options.scheme = schemes[_i];
  scene_start(&s);
  float max = 0;
  for (int i = 0; i < 120; i++) {
    scene_ticks(&s, 1);
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(health.finite);
    max = i > 30 && health.max_strain > max ? health.max_strain : max;
  }
  ck_assert_float_gt(max, 0.09f); /* it is at the limit */
  ck_assert_float_lt(max, 0.15f); /* a single sweep leaves a small error */
  end();
}
END_TEST

START_TEST(limits_conserve_momentum)
{
  begin(5, 2e4f, false, (sbf_vec3){0, 0, 0});
  attributes()->strain_max = 0.05f, attributes()->strain_min = -0.05f;
  s.model_options.scheme = SBF_SCHEME_SYMPLECTIC;
  scene_start(&s);
  sbri_character *c = &s.world->characters[0];
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++) {
    sbri_point *x = &sbri_positions(c)[i];
    float *v = scene_velocity(&s, i);
    x->x *= 1.1f;
    if (!(s.model->islands[0].masses[i] > 0)) continue;
    v[0] = x->x - x->y, v[SBRI_BLOCK] = 0.3f + x->x, v[2 * SBRI_BLOCK] = -0.2f;
  }
  double before[6], after[6];
  sum_momenta(before);
  scene_ticks(&s, 60);
  sum_momenta(after);
  for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(after[k], before[k], 2e-4 * fabs(before[1]));
  for (int k = 3; k < 6; k++) ck_assert_double_eq_tol(after[k], before[k], 2e-2 * fabs(before[5]));
  ck_assert_float_lt(sbr_character_get_body_health(s.world, s.character, 0).max_strain, 0.08f);
  end();
}
END_TEST

/* One heavy tetrahedron, almost at rest, is stretched and released: its plastic strain follows the exact flow
 * in every scheme. */
START_TEST(yield_flows_as_specified)
{
  const sbf_vec3 rest[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const float masses[] = {1e6f, 1e6f, 1e6f, 1e6f};
  sbf_uint4 corners = {{0, 1, 2, 3}};
  s = scene_begin();
  sbf_level *level = scene_points(&s, 0, rest, masses, 4);
  level->model = SBF_ELASTIC_MODEL_TETRAHEDRA;
  level->lattice.tetrahedra = (sbf_uint4_list){&corners, 1};
  attributes()->young_modulus = 1e3f, attributes()->poisson_ratio = 0.3f;
  attributes()->yield_strain = 0.05f, attributes()->yield_flow = 3;
  s.world_definition.has_gravity = true;
  s.model_options.scheme = schemes[_i], s.model_options.substeps = 8;
  scene_start(&s);
  sbri_character *c = &s.world->characters[0];
  for (uint32_t i = 0; i < 4; i++) sbri_positions(c)[i].x *= 1.3f;
  sbfi_d3 edges[3] = {{1.3, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  sbfi_solid_metric metric = {{1, 1, 1, 0, 0, 0}};
  sbfi_stretches stretches;
  for (int n = 0; n < 30 * 8; n++) {
    ck_assert(sbfi_stretches_find(&metric, edges, &stretches));
    sbfi_solid_flow(&stretches, 0.05, 1 - exp(-3.0 / 60 / 8), &metric);
  }
  ck_assert(sbfi_stretches_find(&metric, edges, &stretches));
  double exact = 0;
  for (int k = 0; k < 3; k++) exact = fmax(exact, fabs(stretches.values[k] - 1));
  ck_assert_double_gt(exact, 0.06);
  ck_assert_double_lt(exact, 0.2);
  scene_ticks(&s, 30);
  ck_assert_float_eq_tol(sbr_character_get_body_health(s.world, s.character, 0).max_strain, exact, 2e-3);
  uint64_t hash = sbr_world_get_state_hash(s.world);
  sbr_character_reset(s.world, s.character);
  ck_assert_uint_ne(sbr_world_get_state_hash(s.world), hash);
  ck_assert_float_lt(sbr_character_get_body_health(s.world, s.character, 0).max_strain, 1e-5f);
  for (uint32_t i = 0; i < 4; i++)
    sbri_positions(c)[i].x *= 1.3f; /* the rest shape is the original one again */
  ck_assert_float_eq_tol(sbr_character_get_body_health(s.world, s.character, 0).max_strain, 0.3f, 1e-4f);
  scene_free(&s);
}
END_TEST

/* A bar that hangs by its weight and creeps stays longer after the weight is removed. */
START_TEST(yielded_bodies_keep_their_shape)
{
  float lengths[2];
  for (int n = 0; n < 2; n++) {
    begin(5, 1e5f, true, (sbf_vec3){9.81f, 0, 0});
    attributes()->damping_ratio = 1;
    if (n) attributes()->yield_strain = 0.01f, attributes()->yield_flow = 20;
    s.model_options.scheme = schemes[_i];
    scene_start(&s);
    scene_ticks(&s, 120);
    s.world->gravity = (sbf_vec3){0, 0, 0};
    scene_ticks(&s, 120);
    lengths[n] = scene_point(&s, 0, lattice_box_point(&box, 5, 0, 0)).x;
    sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
    ck_assert(health.finite && !health.inverted);
    ck_assert_uint_eq(health.recoveries, 0);
    end();
  }
  ck_assert_float_eq_tol(lengths[0], 1, 2e-3f);
  ck_assert_float_gt(lengths[1], 1.03f);
}
END_TEST

/* The half that a weight map strengthens does not yield. */
START_TEST(weight_maps_select_where_limits_act)
{
  begin(10, 1e5f, false, (sbf_vec3){0, 0, 0});
  attributes()->yield_strain = 0.02f, attributes()->yield_flow = 50;
  sbf_soft_body *body = scene_body(&s, 0);
  body->surface.positions = (sbf_vec3_list){box.positions, box.point_count};
  float *weights = sbf_asset_allocate(s.asset, box.point_count, sizeof *weights);
  for (uint32_t i = 0; i < box.point_count; i++) weights[i] = box.positions[i].x > 0.45f ? 100 : 1;
  sbf_weight_map *map = sbf_asset_allocate(s.asset, 1, sizeof *map);
  sbf_weight_map_init(map);
  map->property = SBF_WEIGHT_PROPERTY_YIELD_STRAIN;
  map->values = (sbf_f32_list){weights, box.point_count};
  body->weight_maps = (sbf_weight_map_list){map, 1};
  s.model_options.scheme = SBF_SCHEME_SYMPLECTIC;
  scene_start(&s);
  const sbri_island *island = &s.model->islands[0];
  float weak = 1, strong = 0;
  for (uint32_t t = 0; t < island->tetrahedra.count; t++) {
    uint32_t at = island->tetrahedra.lanes[2 * t];
    float yield = island->tetrahedra.limits[at / SBRI_BLOCK].yield[at % SBRI_BLOCK];
    weak = yield < weak ? yield : weak, strong = yield > strong ? yield : strong;
  }
  ck_assert_float_eq_tol(weak, 0.02f, 1e-6f);
  ck_assert_float_eq_tol(strong, 2, 1e-4f);
  end();
}
END_TEST

int main(void) {
  Suite *suite = suite_create("solid_limits");
  TCase *c = tcase_create("solid_limits");
  tcase_add_loop_test(c, strains_stay_within_their_limits, 0, 3);
  tcase_add_test(c, limits_conserve_momentum);
  tcase_add_loop_test(c, yield_flows_as_specified, 0, 4);
  tcase_add_loop_test(c, yielded_bodies_keep_their_shape, 0, 3);
  tcase_add_test(c, weight_maps_select_where_limits_act);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
