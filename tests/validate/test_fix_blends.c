#include "rules.h"

#define CARRIER(id, levels) "<soft_body id=\"" id "\" name=\"" id "\">" TETRA levels "</soft_body>"
#define CARRIED(blends)                                                                                      \
  LEVEL("", TETRA_POINTS,                                                                                    \
      SPRINGS("", TETRA_EDGES, "") "<embedding render_mesh=\"r\"><points>0 0 0 0 1 1 1 1 2 2 2 2 3 3 3 "     \
                                   "3</points><weights>1 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0</weights>" blends     \
                                   "</embedding>")

START_TEST(test_two_bodies)
{
  sbf_asset *asset = rules_expect_fix(RENDER("") CARRIER("a", CARRIED("<blends>1 0.5 0.5 0.2</blends>"))
                                          CARRIER("b", CARRIED("")),
      "EMBEDDING_BLEND /sbf/render_mesh[1]", "");
  const float *a = asset->soft_bodies.at[0].levels.at[0].embeddings.at[0].blends.at;
  const float *b = asset->soft_bodies.at[1].levels.at[0].embeddings.at[0].blends.at;
  ck_assert(a[0] == 0.5f && b[0] == 0.5f);
  for (int i = 0; i < 4; i++) ck_assert(a[i] + b[i] > 0.99999f && a[i] + b[i] < 1.00001f);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_too_large)
{
  sbf_asset_free(rules_expect_fix(RENDER("") CARRIER("a", CARRIED("<blends>1 1 1 4</blends>")),
      "EMBEDDING_BLEND /sbf/render_mesh[1]", ""));
}
END_TEST

START_TEST(test_inconsistent_levels)
{
  const char *uneven =
      RENDER("") CARRIER("a", CARRIED("<blends>1 1 1 0.5</blends>") CARRIED("<blends>1 1 1 0.5</blends>"))
          CARRIER("b", CARRIED("<blends>0 0 0 0.2</blends>"));
  sbf_asset_free(rules_expect_fix(
      uneven, "", "EMBEDDING_BLEND /sbf/render_mesh[1]\nEMBEDDING_BLEND /sbf/render_mesh[1]"));
}
END_TEST

RULES_MAIN("fix_blends", test_two_bodies, test_too_large, test_inconsistent_levels)
