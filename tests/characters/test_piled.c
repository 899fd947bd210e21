/* Armadillos that are dropped on each other hard are not left inside each other. */
#include "harness.h"
#include "sbfmt/build.h"
#include "sbfmt/convert.h"
#include "sbrun/collision.h"
#include "skin_depth.h"

enum { MAX = 1024, TICKS = 400 };

static sbf_asset *armadillo(const char *path, float young_pa) {
  const sbf_convert_options convert = {.unit_m = 0.0666f}; /* which makes it 1 m tall */
  const sbf_build_options options = {
      .interior = SBF_BUILD_INTERIOR_TETRAHEDRA, .elements = 2750, .without_calibration = true};
  sbf_asset *read, *built;
  sbf_diagnostic error;
  ck_assert_msg(sbf_convert(path, &convert, &read, &error) == SBF_OK, "%s", error.message);
  ck_assert_msg(sbf_build(read, &options, &built, NULL, &error) == SBF_OK, "%s", error.message);
  sbf_asset_free(read);
  sbf_soft_body *body = (sbf_soft_body *)(uintptr_t)built->soft_bodies.at;
  sbf_level *level = (sbf_level *)(uintptr_t)body->levels.at;
  body->attributes.young_modulus = young_pa;
  level->lattice.young_modulus = (sbf_f32_list){NULL, 0};
  ck_assert_uint_le(body->surface.positions.count, MAX);
  return built;
}

static uint32_t check(const sbr_world *world, sbr_character_id who, sbf_vec3 at[MAX]) {
  sbr_double3 o = sbr_character_get_origin(world, who);
  uint32_t count = sbr_character_get_surface(world, who, 0, at, MAX);
  for (uint32_t i = 0; i < count; i++)
    at[i] = (sbf_vec3){at[i].x + (float)o.x, at[i].y + (float)o.y, at[i].z + (float)o.z};
  return count;
}

static double deepest(const sbf_polygon_mesh *mesh, const sbf_vec3 *in, const sbf_vec3 *at, uint32_t count) {
  double max = 0;
  for (uint32_t i = 0; i < count; i++) {
    double deep = skin_depth(mesh, in, at[i], UINT32_MAX);
    if (deep > max) max = deep;
  }
  return max;
}

/* From 20 m: no deeper at last than the thickness within which faces answer for themselves. */
START_TEST(armadillos_dropped_hard_separate)
{
  static const struct {
    float young_pa, x, heading;
  } drops[] = {
      {1e5f, 0, 0}, {5e4f, 0.1f, 2}, {3e4f, 0.1f, 2}, {2e4f, 0, 0}, {3e4f, 0.05f, 1}, {2e4f, -0.05f, 3}};
  const char *path = harness_shared("armadillo/armadillo_1k.obj");
  if (!path) return;
  sbf_asset *asset = armadillo(path, drops[_i].young_pa);
  sbf_vec3_list points = asset->soft_bodies.at[0].surface.positions;
  float low = points.at[0].y, high = low;
  for (uint32_t i = 0; i < points.count; i++) {
    low = points.at[i].y < low ? points.at[i].y : low;
    high = points.at[i].y > high ? points.at[i].y : high;
  }
  sbr_model *model;
  sbr_world *world;
  sbr_character_id who[2];
  sbr_world_definition definition = sbr_default_world_definition();
  definition.ground = sbr_ground_flat(0);
  ck_assert(sbr_model_create(asset, NULL, &model, NULL) == SBF_OK);
  ck_assert(sbr_world_create(&definition, &world, NULL) == SBF_OK);
  ck_assert(sbr_world_enable_body_contacts(world, 0, NULL) == SBF_OK);
  for (int i = 0; i < 2; i++) {
    sbr_character_definition at = sbr_default_character_definition();
    at.position.y = (double)-low;
    if (i) at.position.x = (double)drops[_i].x, at.position.y += (double)(high - low) + 20;
    if (i) at.heading = drops[_i].heading;
    ck_assert(sbr_character_create(world, model, &at, &who[i], NULL) == SBF_OK);
  }
  for (int t = 0; t < TICKS; t++) sbr_world_tick(world);
  static sbf_vec3 at[2][MAX];
  const sbf_polygon_mesh *mesh = &asset->soft_bodies.at[0].surface;
  for (int i = 0; i < 2; i++) (void)check(world, who[i], at[i]);
  double one = deepest(mesh, at[0], at[1], mesh->positions.count),
         other = deepest(mesh, at[1], at[0], mesh->positions.count);
  double inner_m = (double)asset->soft_bodies.at[0].collision.inner_thickness;
  ck_assert_double_le(one, inner_m);
  ck_assert_double_le(other, inner_m);
  sbr_world_destroy(world);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("piled");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, armadillos_dropped_hard_separate, 0, 6);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
