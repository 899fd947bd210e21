/* Real characters under one skin: each joint bent by 60 degrees, the skin that sections carry beside linear
 * blend skinning. Figures are printed with SBFMT_TELL in the environment. */
#include "skin_bend.h"

#include <stdio.h>
#include <stdlib.h>

#include "conversions.h"
#include "promises.h"
#include "sbfmt/build.h"

static const struct {
  const char *file;
  uint32_t sections, seams_min;
} characters[] = {{"fox/fox.glb", 15, 200}, {"greenman/greenman.glb", 6, 100}, {"spider/spider.glb", 20, 500},
    {"snake/snake.glb", 10, 300}, {"kenney-fbx/kenney_character.fbx", 20, 500},
    {"walk-dae/walk.dae", 18, 2000}};
enum { CHARACTER_COUNT = sizeof characters / sizeof *characters };

static void report_progress(const char *file, const skin_bend *r) {
  printf("%s: rest %.2g, off LBS %.2g, crack %.2g; %u seam triangles in %u poses: stretch %.3g (LBS %.3g), "
         "above twice %u (%u); flips %u (%u), more in %u poses\n",
      file, r->rest_error, r->lbs_distance, r->crack, r->seam_count, r->poses, r->seam_stretch,
      r->lbs_stretch, r->stretched, r->lbs_stretched, r->flips, r->lbs_flips, r->worse_poses);
}

static void check(const char *name, const char *path, uint32_t sections, uint32_t seams_min) {
  converted c;
  const char *const all[] = {"*"};
  converted_file(&c, path, &(sbf_convert_options){.softness.soft = all, .softness.soft_count = 1});
  sbf_asset *built;
  sbf_build_report report;
  ck_assert_int_eq(sbf_build(c.asset, NULL, &built, &report, NULL), SBF_OK);
  ck_assert_promises_kept(built);
  ck_assert_uint_ge(report.sections, sections);
  for (uint32_t m = 0; m < built->render_meshes.count; m++) {
    skin_bend r;
    if (!built->render_meshes.at[m].skin) continue;
    skin_bend_measure(built, m, 1.0471975511965976, &r);
    if (getenv("SBFMT_TELL")) report_progress(name, &r);
    ck_assert_double_le(r.rest_error, 1e-6);
    ck_assert_double_le(r.crack, 1e-6);
    ck_assert_uint_eq(r.worse_poses, 0);
    ck_assert_uint_ge(r.seam_count, seams_min);
    ck_assert_double_le(r.seam_stretch, 2);
  }
  sbf_asset_free(built);
  converted_free(&c);
}

START_TEST(a_bend_of_each_joint)
{
  const char *path = harness_shared(characters[_i].file);
  if (path) check(characters[_i].file, path, characters[_i].sections, characters[_i].seams_min);
}
END_TEST

START_TEST(the_example_character)
{ check("calf.glb", harness_source("examples/calf/calf.glb"), 20, 2000); }
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("skin_bend");
  TCase *c = tcase_create("characters");
  tcase_add_test(c, the_example_character);
  tcase_add_loop_test(c, a_bend_of_each_joint, 0, CHARACTER_COUNT);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
