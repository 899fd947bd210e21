#include <math.h>
#include <stdlib.h>

#include "harness.h"
#include "import/scene/stream_format.h"
#include "scene_of_stream.h"

START_TEST(motion_of_helpers_becomes_keys_of_the_node)
{
  stream_builder s = {0};
  stream_everything(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "fbx");
  ck_assert_uint_eq(scene.node_count, 3);
  ck_assert_uint_eq(scene.clip_count, 1);
  const sbfi_scene_clip *clip = &scene.clips[0];
  ck_assert_float_eq(clip->duration_s, 1);
  ck_assert_uint_eq(clip->channel_count, 1);
  const sbfi_scene_channel *c = &clip->channels[0];
  ck_assert_str_eq(scene.nodes[c->node].name, "bone");
  /* Helper keys at 0 s and 1 s, the bone's own rotation key at 0.5 s. */
  ck_assert_uint_eq(c->position_count, 3);
  ck_assert_float_eq(c->position_times[1], 0.5f);
  ck_assert_float_eq_tol(c->positions[1].y, 1.5f, 1e-6f);
  ck_assert_float_eq_tol(c->positions[2].y, 2, 1e-6f);
  ck_assert_float_eq_tol(c->positions[2].z, 1, 1e-6f);
  ck_assert_uint_eq(c->rotation_count, 1);
  ck_assert_float_eq_tol(fabsf(c->rotations[0].y), 1, 1e-6f);
  ck_assert_uint_eq(c->scale_count, 1);
  sbfi_scene_free(&scene);
}
END_TEST

static void put_position_keys(stream_builder *s, const double *times, uint32_t count) {
  stream_u32(s, count);
  for (uint32_t i = 0; i < count; i++) {
    const float at[] = {(float)i, 0, 0};
    stream_f64(s, times[i]);
    stream_f32s(s, at, 3);
  }
}

START_TEST(keys_ascend_and_begin_at_zero)
{
  static const double times[] = {-10, 0, 0, 10, 5, 20};
  stream_builder s = {0};
  stream_header(&s);
  stream_u32(&s, 1);
  stream_node(&s, "b", -1, SBFI_STREAM_BONE, 0, 0, 0);
  stream_none(&s);
  stream_none(&s);
  stream_none(&s);
  stream_none(&s);
  stream_u32(&s, 1);
  stream_string(&s, "clip");
  stream_f64(&s, 20);
  stream_f64(&s, 10);
  stream_u32(&s, 2);
  stream_string(&s, "b");
  put_position_keys(&s, times, 6);
  stream_none(&s);
  stream_none(&s);
  stream_string(&s, "nobody");
  stream_none(&s);
  stream_none(&s);
  stream_none(&s);
  stream_end(&s);
  sbfi_scene scene;
  scene_of_stream(&scene, &s, "dae");
  const sbfi_scene_channel *c = &scene.clips[0].channels[0];
  ck_assert_uint_eq(scene.clips[0].channel_count, 1);
  static const float expected[] = {0, 1, 2, 3};
  ck_assert_uint_eq(c->position_count, 4);
  for (int i = 0; i < 4; i++) ck_assert_float_eq(c->position_times[i], expected[i]);
  ck_assert_float_eq(c->positions[3].x, 5);
  ck_assert_float_eq(scene.clips[0].duration_s, 3);
  ck_assert_uint_eq(scene.warning_count, 2); /* a key out of order, a channel of no node */
  sbfi_scene_free(&scene);
}
END_TEST

static Suite *assemble_clips_suite(void) {
  Suite *suite = suite_create("assemble_clips");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, motion_of_helpers_becomes_keys_of_the_node);
  tcase_add_test(tests, keys_ascend_and_begin_at_zero);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(assemble_clips_suite());
}
