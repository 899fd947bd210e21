/* The specification's own samples, every part of the format among them, live: on each level and detail level,
 * with all rigid parts let go, thrown about, torn and read, nothing reads out of bounds (sanitizers watch)
 * and no number is lost. */
#include <stdio.h>

#include "harness.h"
#include "sbfmt/io.h"
#include "sbrun/collision.h"
#include "sbrun/detail.h"
#include "sbrun/rigid.h"
#include "sbrun/soft_body.h"

static const char *const samples[] = {"everything", "jelly", "minimal"};
enum { SAMPLES = 3, LEVELS = 5, POINTS = 4096 };

static bool is_finite(sbf_vec3 v) {
  float sum = v.x + v.y + v.z;
  return sum - sum == 0;
}

static void read_all(
    const sbf_asset *asset, const sbr_model *model, const sbr_world *world, sbr_character_id character) {
  static sbf_vec3 points[POINTS], normals[POINTS];
  static sbf_vec4 tangents[POINTS];
  static sbr_tetrahedron_state tetrahedra[256];
  static sbr_spring_state springs[256];
  static uint8_t torn[POINTS];
  static uint32_t vertices[POINTS];
  sbr_pin_reaction pins[8];
  for (uint32_t m = 0; m < asset->render_meshes.count; m++)
    for (uint32_t l = 0; l <= asset->render_meshes.at[m].levels.count; l++) {
      sbr_model_get_level_vertices(model, m, l, vertices, POINTS);
      sbr_character_get_torn_polygons(world, character, m, l, torn, POINTS);
      sbr_character_get_level_corner_normals(world, character, m, l, normals, POINTS);
      uint32_t count =
          sbr_character_get_level_skin(world, character, m, l, points, normals, tangents, POINTS);
      for (uint32_t i = 0; i < count && i < POINTS && l == 0; i++) ck_assert(is_finite(points[i]));
    }
  for (uint32_t b = 0; b < asset->soft_bodies.count; b++) {
    ck_assert(sbr_character_get_body_health(world, character, b).finite ||
              asset->soft_bodies.at[b].levels.count == 0);
    sbr_character_get_surface(world, character, b, points, POINTS);
    uint32_t count = sbr_character_get_points(world, character, b, points, POINTS);
    for (uint32_t i = 0; i < count && i < POINTS; i++) ck_assert(is_finite(points[i]));
    sbr_character_get_tetrahedra(world, character, b, tetrahedra, 256);
    sbr_character_get_springs(world, character, b, springs, 256);
    sbr_character_get_pin_reactions(world, character, b, pins, 8);
  }
}

/* What a host may do in a frame. */
static void disturb(const sbf_asset *asset, sbr_world *world, sbr_character_id character, int frame) {
  if (frame == 5) sbr_character_set_drive(world, character, 1, 0.2f, 0.5f);
  if (frame == 20) sbr_character_set_rigid_mode(world, character, -1, SBR_RIGID_PASSIVE);
  for (uint32_t b = 0; b < asset->soft_bodies.count && frame == 30; b++)
    (void)sbr_character_apply_soft_impulse(world, character, b, SBR_WHOLE_BODY, (sbf_vec3){30, 60, 0}, NULL);
  if (frame == 45) sbr_character_teleport(world, character, (sbr_double3){100, 2, 3}, 1);
  if (frame == 50) sbr_character_reset(world, character);
}

START_TEST(samples_live)
{
  const char *name = samples[_i / (2 * LEVELS)];
  char path[80];
  snprintf(path, sizeof path, "spec/samples/valid/%s.sbf", name);
  sbf_asset *asset;
  sbf_diagnostic error;
  ck_assert_msg(sbf_load_file(harness_source(path), NULL, &asset, &error) == SBF_OK, "%s", error.message);
  sbr_model_options options = sbr_default_model_options();
  options.level = (uint32_t)(_i / 2 % LEVELS);
  options.detail_levels = _i % 2 == 0;
  options.free = _i % 2 != 0;
  sbr_model *model;
  ck_assert_msg(sbr_model_create(asset, &options, &model, &error) == SBF_OK, "%s: %s", name, error.message);
  sbr_world_definition world_is = sbr_default_world_definition();
  sbr_character_definition character_is = sbr_default_character_definition();
  sbr_world *world;
  sbr_character_id character;
  ck_assert_int_eq(sbr_world_create(&world_is, &world, &error), SBF_OK);
  ck_assert_int_eq(sbr_world_enable_body_contacts(world, 0, &error), SBF_OK);
  ck_assert_int_eq(sbr_character_create(world, model, &character_is, &character, &error), SBF_OK);
  for (int frame = 0; frame < 60; frame++) {
    disturb(asset, world, character, frame);
    if (options.detail_levels && frame % 10 == 9)
      sbr_character_set_detail_level(world, character, (uint32_t)frame / 10);
    sbr_world_tick(world);
    read_all(asset, model, world, character);
  }
  sbr_world_destroy(world);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("sample_files");
  TCase *c = tcase_create("sample_files");
  tcase_add_loop_test(c, samples_live, 0, SAMPLES * LEVELS * 2);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
