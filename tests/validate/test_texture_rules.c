#include <stdio.h>
#include <string.h>

#include "rules.h"

#define TEXTURE(attributes, inside)                                                                          \
  "<textures><texture id=\"t\" " attributes ">" inside "</texture></textures>"
#define PATH "/sbf/textures/texture[1]"

START_TEST(test_paths)
{
  rules_expect(TEXTURE("path=\"images/../skin.png\"", ""), "");
  rules_expect(TEXTURE("path=\"./skin..png\"", ""), "");
  rules_expect(TEXTURE("path=\"/skin.png\"", ""), "TEXTURE_PATH " PATH);
  rules_expect(TEXTURE("path=\"C:/skin.png\"", ""), "TEXTURE_PATH " PATH);
  rules_expect(TEXTURE("path=\"images\\skin.png\"", ""), "TEXTURE_PATH " PATH);
  rules_expect(TEXTURE("path=\"../skin.png\"", ""), "TEXTURE_PATH " PATH);
  rules_expect(TEXTURE("path=\"a/../../skin.png\"", ""), "TEXTURE_PATH " PATH);
  rules_expect(TEXTURE("", ""), "TEXTURE_EMPTY " PATH);
}
END_TEST

START_TEST(test_bytes)
{
  rules_expect(TEXTURE("media_type=\"image/png\"", "<bytes>iVBORw0KGgo=</bytes>"), "");
  rules_expect(TEXTURE("media_type=\"image/png\"", "<bytes>iVBORw0KGgs=</bytes>"), "TEXTURE_TYPE " PATH);
  rules_expect(
      TEXTURE("media_type=\"image/jpeg\"", "<bytes>/9g=</bytes>"), "TEXTURE_TYPE " PATH); /* cut short */
  rules_expect(TEXTURE("media_type=\"image/x-own\"", "<bytes>AAEC</bytes>"), "");
}
END_TEST

START_TEST(test_files)
{
  sbf_asset *asset = rules_load(TEXTURE("path=\"test_texture_rules.png\"", ""), false);
  char folder[1024];
  const char *image = harness_scratch("test_texture_rules.png");
  snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(image, '/') - image), image);
  sbf_validate_options options = {.folder = folder};
  remove(image);
  ck_assert_str_eq(rules_findings(asset, &options), "TEXTURE_MISSING " PATH);
  ck_assert_str_eq(rules_findings(asset, NULL), ""); /* nobody said where to look */
  ck_assert(harness_write(image, "x", 1));
  ck_assert_str_eq(rules_findings(asset, &options), "");
  remove(image);
  sbf_asset_free(asset);
}
END_TEST

RULES_MAIN("texture_rules", test_paths, test_bytes, test_files)
