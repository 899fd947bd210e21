#include "rules.h"
#include "sbfmt/build.h"

START_TEST(test_stale)
{
  sbf_asset *asset = rules_load(ROOT_BONE SECTION(TETRA), false), *built;
  ck_assert_int_eq(sbf_build(asset, NULL, &built, NULL, NULL), SBF_OK);
  ck_assert_str_eq(rules_findings(built, NULL), "");
  ((sbf_bone *)(uintptr_t)built->bones.at)->length = 0.3f;
  ck_assert_str_eq(rules_findings(built, NULL), "DERIVED_STALE /sbf/derivations/derivation[1]");
  sbf_asset_free(built);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_no_claim)
{ rules_expect("<derivations><derivation id=\"d\" tool=\"by hand\"/></derivations>" BODY(TETRA), ""); }
END_TEST

RULES_MAIN("derived_rules", test_stale, test_no_claim)
