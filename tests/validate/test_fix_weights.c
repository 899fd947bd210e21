#include "rules.h"

#define SKINNED(weights)                                                                                     \
  ROOT_BONE RENDER(                                                                                          \
      "<skin><influence_counts>1 1 1 1</influence_counts><bones>0 0 0 0</bones><weights>" weights            \
      "</weights></skin>")
#define TWO_BONES "<skeleton>" BONE("one", "0 0 0", "") BONE("two", "0 0 0.1", "parent=\"one\"") "</skeleton>"

START_TEST(test_skins)
{
  sbf_asset *asset = rules_expect_fix(
      TWO_BONES RENDER("<skin><influence_counts>2 2 1 2</influence_counts><bones>0 1 0 1 0 0 1</bones>"
                       "<weights>3 1 0.5 0.5 0.25 1.0005 -0.0005</weights></skin>"),
      "SKIN_SUM /sbf/render_mesh[1]/skin/weights #0", "");
  const float *weights = asset->render_meshes.at[0].skin->weights.at;
  ck_assert(weights[0] == 0.75f && weights[1] == 0.25f && weights[2] == 0.5f && weights[4] == 1 &&
            weights[5] == 1 && weights[6] == 0);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_skins_without_weights)
{ sbf_asset_free(rules_expect_fix(SKINNED("1 0 1 1"), "", "SKIN_SUM /sbf/render_mesh[1]/skin/weights #1")); }
END_TEST

START_TEST(test_pins)
{
  sbf_asset *asset = rules_expect_fix(BODY(TETRA PINS("", "0 1 2", "<weights>7 0.5 1.01</weights>")),
      "VALUE_OUT_OF_RANGE /sbf/soft_body[1]/pins/pin_set[1]/weights #0", "");
  const float *weights = asset->soft_bodies.at[0].pins.at[0].weights.at;
  ck_assert(weights[0] == 1 && weights[1] == 0.5f && weights[2] == 1);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_embeddings)
{
#define EMBEDDED(last)                                                                                       \
  RENDER("")                                                                                                 \
  BODY(TETRA LEVEL("", TETRA_POINTS,                                                                         \
      SPRINGS("", TETRA_EDGES, "") "<embedding render_mesh=\"r\"><points>0 0 0 0 1 1 1 1 2 2 2 2 " last      \
                                   "</weights></embedding>"))
#define WEIGHTS "</points><weights>1 0 0 0 1 0 0 0 1 0 0 0 "
  sbf_asset *asset = rules_expect_fix(EMBEDDED("3 0 1 2" WEIGHTS "0.5 0 0 0"),
      "EMBEDDING_SUM /sbf/soft_body[1]/level[1]/embedding[1]/weights #3", "");
  ck_assert(asset->soft_bodies.at[0].levels.at[0].embeddings.at[0].weights.at[3].x == 1);
  sbf_asset_free(asset);
  /* divided by their sum these would move the vertex: their meaning is unknown */
  sbf_asset_free(rules_expect_fix(EMBEDDED("3 0 1 2" WEIGHTS "0.5 0 0.2 0"), "",
      "EMBEDDING_SUM /sbf/soft_body[1]/level[1]/embedding[1]/weights #3"));
}
END_TEST

RULES_MAIN("fix_weights", test_skins, test_skins_without_weights, test_pins, test_embeddings)
