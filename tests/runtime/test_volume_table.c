#include <math.h>

#include "harness.h"
#include "scenes.h"
#include "state/world.h"

static scene section(sbf_pressure_mode mode) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  scene_body(&s, 0)->attributes.pressure_mode = mode;
  scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
  scene_body(&s, 0)->attributes.young_modulus = 1e4f;
  scene_section(&s, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.4f, 0.3f, 0.6f}, 3);
  return s;
}

/* Minimum and maximum volume while the bone moves back and forth. */
static void shake(scene *s, double *low, double *high) {
  *low = *high = 1;
  for (int i = 0; i < 240; i++) {
    sbr_character_set_drive(s->world, s->character, i / 20 % 2 ? 3 : -3, 0, 0);
    scene_ticks(s, 1);
    sbr_body_health h = sbr_character_get_body_health(s->world, s->character, 0);
    ck_assert(h.finite);
    *low = fmin(*low, h.volume_ratio);
    *high = fmax(*high, h.volume_ratio);
  }
}

START_TEST(the_volume_is_preserved_on_request)
{
  double low, high;
  scene plain = section(SBF_PRESSURE_MODE_NONE), kept = section(SBF_PRESSURE_MODE_VOLUME);
  scene_start(&plain);
  shake(&plain, &low, &high);
  ck_assert_double_gt(high - low, 0.05);
  scene_start(&kept);
  shake(&kept, &low, &high);
  ck_assert_double_gt(low, 0.998);
  ck_assert_double_lt(high, 1.002);
  scene_free(&plain);
  scene_free(&kept);
}
END_TEST

START_TEST(keeping_it_moves_no_body)
{
  scene s = section(SBF_PRESSURE_MODE_VOLUME);
  s.model_options.free = true;
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  sbri_character *c = sbri_character_of(s.world, s.character);
  const sbri_island *island = &c->model->islands[0];
  double before[3] = {0, 0, 0}, after[3] = {0, 0, 0}, mass = 0;
  for (uint32_t i = 0; i < island->free_count; i++) {
    sbri_point *p = &sbri_positions(c)[i];
    p->y = 1 + 0.8f * (p->y - 1) + (p->y > 1); /* pressed flat, its upper half a metre higher */
    p->y -= p->y > 1.5f;
    before[0] += island->masses[i] * p->x, before[1] += island->masses[i] * p->y;
    before[2] += island->masses[i] * p->z, mass += island->masses[i];
  }
  ck_assert_double_lt(sbr_character_get_body_health(s.world, s.character, 0).volume_ratio, 0.85);
  scene_ticks(&s, 200);
  ck_assert_double_eq_tol(sbr_character_get_body_health(s.world, s.character, 0).volume_ratio, 1, 2e-3);
  sbr_double3 origin = sbr_character_get_origin(s.world, s.character);
  ck_assert_double_eq(origin.y, 0);
  for (uint32_t i = 0; i < island->free_count; i++) {
    const sbri_point *p = &sbri_positions(c)[i];
    after[0] += island->masses[i] * p->x, after[1] += island->masses[i] * p->y;
    after[2] += island->masses[i] * p->z;
  }
  for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(after[k] / mass, before[k] / mass, 2e-4);
  scene_free(&s);
}
END_TEST

/* A body compressed to a third recovers slowly: each of a substep's four steps may change a tenth of its
 * volume, and a little more as its faces grow. */
START_TEST(a_large_volume_error_is_corrected_slowly)
{
  scene s = section(SBF_PRESSURE_MODE_VOLUME);
  s.model_options.free = true;
  s.model_options.substeps = 1;
  s.world_definition.has_gravity = true;
  scene_start(&s);
  sbri_character *c = sbri_character_of(s.world, s.character);
  for (uint32_t i = 0; i < c->model->islands[0].free_count; i++) {
    sbri_point *p = &sbri_positions(c)[i];
    p->y = 1 + 0.33f * (p->y - 1);
  }
  double last = sbr_character_get_body_health(s.world, s.character, 0).volume_ratio;
  ck_assert_double_lt(last, 0.35);
  uint32_t slow = 0;
  for (int i = 0; i < 10 && last < 0.99; i++) {
    scene_ticks(&s, 1);
    double now = sbr_character_get_body_health(s.world, s.character, 0).volume_ratio;
    ck_assert_double_le(now - last, 0.55);
    slow += now < 0.9;
    last = now;
  }
  ck_assert_uint_ge(slow, 1);
  scene_free(&s);
}
END_TEST

/* A surface carried by points other than its own: the corners of a box around it. */
START_TEST(embedded_surfaces_keep_their_volume)
{
  scene s = section(SBF_PRESSURE_MODE_VOLUME);
  sbf_soft_body *body = scene_body(&s, 0);
  sbf_vec3 positions[8];
  float masses[8], stiffness[28];
  sbf_uint2 ends[28];
  uint32_t spring_count = 0, vertex_count = body->surface.positions.count;
  for (uint32_t i = 0; i < 8; i++) {
    positions[i] = (sbf_vec3){i & 1 ? 0.3f : -0.3f, 1 + (i & 2 ? 0.3f : -0.3f), i & 4 ? 0.4f : -0.4f};
    masses[i] = 1;
    for (uint32_t k = 0; k < i; k++) {
      ends[spring_count] = (sbf_uint2){{k, i}};
      stiffness[spring_count++] = 300;
    }
  }
  sbf_level *level = scene_points(&s, 0, positions, masses, 8);
  scene_springs(&s, level, ends, stiffness, spring_count);
  static const uint32_t top[] = {2, 3, 6, 7};
  scene_pin(&s, level, 0, top, 4);
  sbf_uint4 *points = sbf_asset_allocate(s.asset, vertex_count, sizeof *points);
  sbf_vec4 *weights = sbf_asset_allocate(s.asset, vertex_count, sizeof *weights);
  for (uint32_t v = 0; v < vertex_count; v++) { /* p0 and the three axes of the box */
    sbf_vec3 p = body->surface.positions.at[v];
    float x = (p.x + 0.3f) / 0.6f, y = (p.y - 0.7f) / 0.6f, z = (p.z + 0.4f) / 0.8f;
    points[v] = (sbf_uint4){{0, 1, 2, 4}};
    weights[v] = (sbf_vec4){1 - x - y - z, x, y, z};
  }
  sbf_embedding *embedding = sbf_asset_allocate(s.asset, 1, sizeof *embedding);
  sbf_embedding_init(embedding);
  embedding->points = (sbf_uint4_list){points, vertex_count};
  embedding->weights = (sbf_vec4_list){weights, vertex_count};
  level->embeddings = (sbf_embedding_list){embedding, 1};
  scene_start(&s);
  ck_assert(s.model->bodies[0].volume.is_preserved);
  ck_assert_ptr_null(s.model->bodies[0].volume.faces);
  double low, high;
  shake(&s, &low, &high);
  ck_assert_double_gt(low, 0.99);
  ck_assert_double_lt(high, 1.01);
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("volume table");
  TCase *c = tcase_create("volume table");
  tcase_add_test(c, the_volume_is_preserved_on_request);
  tcase_add_test(c, keeping_it_moves_no_body);
  tcase_add_test(c, a_large_volume_error_is_corrected_slowly);
  tcase_add_test(c, embedded_surfaces_keep_their_volume);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
