#include "import/sibling_path.h"

#include "harness.h"

static void expect(const char *path, const char *name, const char *expected) {
  char to[24];
  bool good = sbfi_sibling_path(to, sizeof to, path, sbfi_span_of(name));
  ck_assert(good == (expected != NULL));
  if (good) ck_assert_str_eq(to, expected);
}

START_TEST(named_files_are_searched_beside_the_file)
{
  expect("a/b/model.obj", "m.mtl", "a/b/m.mtl");
  expect("model.obj", "m.mtl", "m.mtl");
  expect("/model.obj", "x\\m.mtl", "/x/m.mtl");
  expect("a/model.obj", "/tmp/m.mtl", "/tmp/m.mtl");
  expect("a/model.obj", "", NULL);
  expect("a/model.obj", "0123456789012345678901", NULL);
  expect("a/model.obj", "012345678901234567890", "a/012345678901234567890");
  char to[24];
  ck_assert(!sbfi_sibling_path(to, sizeof to, "a", (sbfi_span){"x\0y", 3}));
}
END_TEST

static Suite *sibling_path_suite(void) {
  Suite *suite = suite_create("sibling_path");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, named_files_are_searched_beside_the_file);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(sibling_path_suite());
}
