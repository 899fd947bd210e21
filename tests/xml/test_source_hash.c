#include "xml/source_hash.h"

#include <stdio.h>
#include <string.h>

#include "xml_samples.h"

typedef struct hash {
  char text[SBFI_SHA256_TEXT_SIZE];
} hash;

static hash hash_of(const char *inside, bool (*keep)(void *user, const sbfi_element_path *child)) {
  hash h;
  sbf_diagnostic error;
  sbf_asset *asset = samples_load(samples_document(inside), &error);
  ck_assert_msg(asset != NULL, "%s", error.message);
  ck_assert_int_eq(sbfi_source_hash(asset, keep, NULL, h.text, &error), SBF_OK);
  sbf_asset_free(asset);
  return h;
}

static const char plain[] = "<soft_body id='a'><interior>1 2 3</interior></soft_body>";

START_TEST(test_it_is_the_hash_of_the_canonical_text)
{
  static const char text[] = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                             "<sbf version=\"1.0\">\n"
                             "  <soft_body id=\"a\">\n"
                             "    <interior>1 2 3</interior>\n"
                             "  </soft_body>\n"
                             "</sbf>\n";
  uint8_t digest[SBFI_SHA256_BYTES];
  hash expected;
  sbfi_sha256 sha;
  sbfi_sha256_init(&sha);
  sbfi_sha256_update(&sha, text, sizeof text - 1);
  sbfi_sha256_finish(&sha, digest);
  sbfi_sha256_format(digest, expected.text);
  ck_assert_str_eq(hash_of(plain, NULL).text, expected.text);
}
END_TEST

START_TEST(test_derived_parts_do_not_change_it)
{
  hash h = hash_of(plain, NULL);
  ck_assert_str_eq(
      h.text, hash_of("<derivations><derivation id='d'/></derivations>"
                      "<soft_body id='a'><interior>1 2 3</interior><level derived='d'/></soft_body>"
                      "<rigid_bodies><rigid_body id='r' derived='d'/></rigid_bodies>",
                  NULL)
                  .text);
}
END_TEST

START_TEST(test_source_parts_change_it)
{
  hash h = hash_of(plain, NULL);
  ck_assert_str_ne(h.text, hash_of("<soft_body id='a'><interior>1 2 4</interior></soft_body>", NULL).text);
  ck_assert_str_ne(
      h.text, hash_of("<soft_body id='a'><interior>1 2 3</interior><level/></soft_body>", NULL).text);
}
END_TEST

static bool keep_no_clips(void *user, const sbfi_element_path *child) {
  (void)user;
  return strcmp(child->element->name, "clip") != 0;
}

START_TEST(test_parts_that_are_not_read)
{
  char with_clip[512];
  snprintf(with_clip, sizeof with_clip, "%s<clips><clip id='c'/></clips>", plain);
  ck_assert_str_ne(hash_of(plain, NULL).text, hash_of(with_clip, NULL).text);
  ck_assert_str_eq(hash_of(plain, NULL).text, hash_of(with_clip, keep_no_clips).text);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("source_hash");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_it_is_the_hash_of_the_canonical_text);
  tcase_add_test(all, test_derived_parts_do_not_change_it);
  tcase_add_test(all, test_source_parts_change_it);
  tcase_add_test(all, test_parts_that_are_not_read);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}
