#include <string.h>

#include "harness.h"
#include "sbfmt/codes.h"
#include "scenes.h"

typedef struct heard {
  uint32_t count;
  char all[2048];
} heard;

static void hear(void *user, const sbf_diagnostic *diagnostic) {
  heard *h = user;
  h->count++;
  ck_assert_int_eq(diagnostic->code, SBF_CODE_PART_LEFT_OUT);
  ck_assert_int_eq(diagnostic->severity, SBF_SEVERITY_INFO);
  strcat(h->all, diagnostic->message);
  strcat(h->all, "\n");
}

static scene section(void) {
  scene s = scene_begin();
  scene_bone(&s, (sbf_vec3){0, 1, 0});
  scene_section(&s, 0, (sbf_vec3){0, 1, 0}, (sbf_vec3){0.4f, 0.3f, 0.6f}, 2);
  return s;
}

START_TEST(supported_features_are_not_reported)
{
  scene s = section();
  scene_body(&s, 0)->attributes.pressure_mode = SBF_PRESSURE_MODE_VOLUME;
  scene_body(&s, 0)->attributes.sag_free = true;
  scene_body(&s, 0)->collision.self = true;
  sbf_weight_map *maps = sbf_asset_allocate(s.asset, SBF_WEIGHT_PROPERTY_COUNT, sizeof *maps);
  for (int i = 0; i < SBF_WEIGHT_PROPERTY_COUNT; i++) {
    sbf_weight_map_init(&maps[i]);
    maps[i].property = (sbf_weight_property)i;
  }
  scene_body(&s, 0)->weight_maps = (sbf_weight_map_list){maps, SBF_WEIGHT_PROPERTY_COUNT};
  scene_start(&s);
  ck_assert_uint_eq(sbr_model_report_unsupported(s.model, NULL, NULL), 0);
  ck_assert_uint_eq(sbr_model_report_unsupported(NULL, NULL, NULL), 0);
  scene_free(&s);
}
END_TEST

START_TEST(unsupported_parts_are_reported)
{
  scene s = section();
  sbf_attributes *is = &scene_body(&s, 0)->attributes;
  is->strain_max = 0.5f;
  is->tear_strain = 2;
  is->pressure_mode = SBF_PRESSURE_MODE_GAS;
  is->pressure = 100;
  scene_body(&s, 0)->collision.self = true;
  scene_start(&s);
  ck_assert_uint_eq(sbr_model_report_unsupported(s.model, NULL, NULL), 0);
  scene_free(&s);
  s = section();
  scene_body(&s, 0)->collision.self = true; /* a surface without faces has no contacts */
  scene_body(&s, 0)->surface.polygon_sizes.count = scene_body(&s, 0)->surface.polygon_points.count = 0;
  scene_start(&s);
  heard h = {0, ""};
  ck_assert_uint_eq(sbr_model_report_unsupported(s.model, hear, &h), 1);
  ck_assert_uint_eq(h.count, 1);
  ck_assert_ptr_nonnull(strstr(
      h.all, "self-collisions of bodies with surface points that the level does not have are left out"));
  scene_free(&s);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("left out");
  TCase *c = tcase_create("left out");
  tcase_add_test(c, supported_features_are_not_reported);
  tcase_add_test(c, unsupported_parts_are_reported);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
