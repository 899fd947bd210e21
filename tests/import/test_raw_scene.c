#include "import/scene/raw_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "import/scene/assimp_bridge.h"
#include "scene_check.h"
#include "stream_builder.h"

/* Reads a copy that ends with its last byte, and puts a scene together if that goes well. */
static sbf_status take(const uint8_t *bytes, size_t size, sbf_diagnostic *error) {
  uint8_t *copy = malloc(size ? size : 1);
  if (size) memcpy(copy, bytes, size);
  sbfi_scene scene;
  ck_assert(sbfi_scene_init(&scene, NULL, 0, "test.fbx"));
  scene.format = "fbx";
  sbf_status status = sbfi_assimp_parse(&scene, copy, size, NULL, error);
  free(copy);
  if (status == SBF_OK) {
    const char *broken = scene_check(&scene);
    ck_assert_msg(!broken, "%s", broken);
  }
  sbfi_scene_free(&scene);
  return status;
}

START_TEST(everything_is_read)
{
  stream_builder s = {0};
  stream_everything(&s);
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, NULL, 0);
  sbfi_raw_scene raw;
  sbf_diagnostic error = {0};
  sbf_status status = sbfi_raw_scene_read(&raw, s.at, s.size, &scratch, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
  ck_assert(sbfi_span_is(raw.generator, "a test"));
  ck_assert_uint_eq(raw.node_count, 4);
  const sbfi_scene_limit *limits = raw.nodes[0].limits;
  ck_assert(limits[SBFI_LIMIT_TWIST].stated && limits[SBFI_LIMIT_SWING_Z].stated);
  ck_assert(!limits[SBFI_LIMIT_SWING_Y].stated);
  ck_assert_float_eq(limits[SBFI_LIMIT_TWIST].max, 0.5f);
  ck_assert_float_eq(limits[SBFI_LIMIT_SWING_Z].min, -1);
  ck_assert(sbfi_span_is(raw.nodes[2].name, "bone") && raw.nodes[2].parent == 1);
  ck_assert_double_eq(raw.nodes[2].local.at[2][3], 1);
  ck_assert_uint_eq(raw.meshes[0].polygon_sizes[0], 4);
  ck_assert_float_eq(raw.meshes[0].uvs[0][2].y, 1);
  ck_assert_uint_eq(raw.meshes[0].bones[0].vertices[1], 3);
  ck_assert_float_eq(raw.meshes[0].shapes[0].positions[2].y, 2);
  ck_assert_float_eq(raw.materials[0].values.metallic, 0.5f);
  ck_assert(raw.images[0].byte_count == 5 && memcmp(raw.images[0].bytes, "image", 5) == 0);
  float value[4];
  ck_assert_double_eq(sbfi_raw_key(&raw.clips[0].channels[0].keys[SBFI_RAW_POSITION], 3, 1, value), 10);
  ck_assert_float_eq(value[1], 2);
  sbfi_arena_free(&scratch);
  ck_assert_int_eq(take(s.at, s.size, &error), SBF_OK);
  free(s.at);
}
END_TEST

START_TEST(cut_off_at_every_byte)
{
  stream_builder s = {0};
  stream_everything(&s);
  for (size_t size = 0; size < s.size; size++) {
    sbf_diagnostic error = {0};
    ck_assert_msg(take(s.at, size, &error) == SBF_FAILED, "was read with %zu of %zu bytes", size, s.size);
    ck_assert_int_eq(error.code, SBF_CODE_IMPORT_STREAM);
  }
  free(s.at);
}
END_TEST

START_TEST(bytes_after_the_end_are_refused)
{
  stream_builder s = {0};
  sbf_diagnostic error = {0};
  stream_everything(&s);
  stream_u32(&s, 0);
  ck_assert_int_eq(take(s.at, s.size, &error), SBF_FAILED);
  free(s.at);
}
END_TEST

/* Replaces every word by values that break readers: accepted scenes must keep the promises of a scene. */
START_TEST(every_word_damaged)
{
  static const uint32_t words[] = {0, 1, 3, 5, 0x7fffffff, 0x80000000, 0xffffffff, 0x7f800000, 0x7fc00000,
      0x7f7fffff, 0x00000001, 0x40000000};
  stream_builder s = {0};
  stream_everything(&s);
  uint32_t accepted = 0, refused = 0;
  for (size_t at = 0; at + 4 <= s.size; at += 4)
    for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
      uint32_t was;
      sbf_diagnostic error = {0};
      memcpy(&was, s.at + at, 4);
      memcpy(s.at + at, &words[k], 4);
      sbf_status status = take(s.at, s.size, &error);
      ck_assert(status == SBF_OK || error.code != 0);
      accepted += status == SBF_OK;
      refused += status != SBF_OK;
      memcpy(s.at + at, &was, 4);
    }
  ck_assert_uint_gt(accepted, 100);
  ck_assert_uint_gt(refused, 100);
  free(s.at);
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  stream_builder s = {0};
  stream_everything(&s);
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_scene scene;
    sbf_diagnostic error = {0};
    sbf_status status = SBF_FAILED;
    if (sbfi_scene_init(&scene, &memory.allocator, 0, "test.fbx")) {
      scene.format = "fbx";
      status = sbfi_assimp_parse(&scene, s.at, s.size, &memory.allocator, &error);
      if (status != SBF_OK) ck_assert_int_eq(error.code, SBF_CODE_OUT_OF_MEMORY);
    }
    sbfi_scene_free(&scene);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (status == SBF_OK) break;
    ck_assert_uint_lt(allowed, 1000);
  }
  free(s.at);
}
END_TEST

/* A count that the rest of the stream cannot hold is refused before anything is allocated for it. */
START_TEST(large_counts_allocate_nothing)
{
  harness_memory memory;
  harness_memory_init(&memory, 0);
  stream_builder s = {0};
  stream_header(&s);
  stream_u32(&s, 0x7fffffff);
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, &memory.allocator, 0);
  sbfi_raw_scene raw;
  sbf_diagnostic error = {0};
  ck_assert_int_eq(sbfi_raw_scene_read(&raw, s.at, s.size, &scratch, &error), SBF_FAILED);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_STREAM);
  ck_assert_uint_eq(memory.calls, 0);
  free(s.at);
}
END_TEST

START_TEST(non_finite_numbers_are_errors_of_the_file)
{
  stream_builder s = {0};
  sbf_diagnostic error = {0};
  const float bad[] = {0, 0, 0, 1, 0, NAN, 0, 1, 0};
  stream_header(&s);
  stream_u32(&s, 1);
  stream_node(&s, "n", -1, 0, 0, 0, 0);
  stream_u32(&s, 1);
  stream_u32(&s, 0);
  stream_u32(&s, 1);
  stream_triangles(&s, "torn", 0, bad, 1);
  stream_none(&s);
  stream_none(&s);
  stream_none(&s);
  stream_end(&s);
  ck_assert_int_eq(take(s.at, s.size, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_NOT_FINITE);
  ck_assert_ptr_nonnull(strstr(error.message, "item 1 of the positions of \"torn\" is infinite or NaN"));
  free(s.at);
}
END_TEST

START_TEST(an_index_beyond_the_vertices_is_an_error_of_the_file)
{
  stream_builder s = {0};
  sbf_diagnostic error = {0};
  const float corner[] = {0, 0, 0};
  stream_header(&s);
  stream_u32(&s, 1);
  stream_node(&s, "n", -1, 0, 0, 0, 0);
  stream_u32(&s, 1);
  stream_u32(&s, 0);
  stream_u32(&s, 1);
  stream_string(&s, "cut");
  stream_u32(&s, 0);
  stream_u32(&s, 1);
  stream_f32s(&s, corner, 3);
  stream_u32(&s, 0);
  stream_u32(&s, 0);
  stream_none(&s);
  stream_u32(&s, 1);
  stream_u32(&s, 3);
  stream_u32(&s, 3);
  for (uint32_t i = 0; i < 3; i++) stream_u32(&s, i);
  ck_assert_int_eq(take(s.at, s.size, &error), SBF_BAD_INPUT);
  ck_assert_int_eq(error.code, SBF_CODE_IMPORT_INDEX);
  free(s.at);
}
END_TEST

static Suite *raw_scene_suite(void) {
  Suite *suite = suite_create("raw_scene");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, everything_is_read);
  tcase_add_test(tests, cut_off_at_every_byte);
  tcase_add_test(tests, bytes_after_the_end_are_refused);
  tcase_add_test(tests, every_word_damaged);
  tcase_add_test(tests, every_allocation_may_fail);
  tcase_add_test(tests, large_counts_allocate_nothing);
  tcase_add_test(tests, non_finite_numbers_are_errors_of_the_file);
  tcase_add_test(tests, an_index_beyond_the_vertices_is_an_error_of_the_file);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(raw_scene_suite());
}
