#include <stdio.h>

#include "legs.h"

#define CHAINED(bones) LEGS "<chains><chain id=\"c\"><bones>" bones "</bones></chain></chains>"
#define RETARGETED(bones)                                                                                    \
  LEGS "<retarget_chains><retarget_chain id=\"c\"><bones>" bones "</bones></retarget_chain></"               \
       "retarget_chains>"
#define FOLLOWED(inside) LEGS "<followers>" inside "</followers>"

START_TEST(test_chains)
{
  rules_expect(CHAINED("0 1 3"), ""); /* one may be left out */
  rules_expect(CHAINED("1"), "CHAIN_EMPTY /sbf/chains/chain[1]");
  rules_expect(CHAINED("1 0"), "CHAIN_BROKEN /sbf/chains/chain[1]/bones #1");
  rules_expect(CHAINED("1 2 2"), "BONE_REPEATED /sbf/chains/chain[1]/bones #2");
}
END_TEST

#define SWUNG(chains) LEGS "<chains>" chains "</chains>"
#define SPRUNG(id, bones, spring)                                                                            \
  "<chain id=\"" id "\"><bones>" bones "</bones><chain_spring " spring "/></chain>"

START_TEST(test_springs)
{
  rules_expect(SWUNG(SPRUNG("a", "1 2", "center=\"body\"") SPRUNG("b", "4", "")), ""); /* one bone swings */
  rules_expect(SWUNG(SPRUNG("a", "1 2", "center=\"left\"")), "");
  rules_expect(SWUNG("<chain id=\"a\"><chain_spring/></chain>"), "CHAIN_EMPTY /sbf/chains/chain[1]");
  rules_expect(SWUNG(SPRUNG("a", "1 2", "") SPRUNG("b", "2 3", "")),
      "CHAIN_SPRING_REPEATED /sbf/chains/chain[2]/chain_spring");
  rules_expect(
      SWUNG("<chain id=\"a\"><bones>1 2</bones></chain>" SPRUNG("b", "1 2", "")), ""); /* the spring moves */
  rules_expect(
      SWUNG(SPRUNG("a", "1 2", "center=\"right\"")), "CHAIN_CENTER /sbf/chains/chain[1]/chain_spring");
}
END_TEST

START_TEST(test_colliders)
{
  static const char *const shapes[] = {"sphere", "capsule", "plane"};
  for (int i = 0; i < 3; i++) {
    char text[1024];
    snprintf(text, sizeof text,
        "%s<chain_colliders><chain_collider id=\"c\" bone=\"body\" shape=\"%s\" normal=\"0 0 0\"/>"
        "</chain_colliders>",
        LEGS, shapes[i]);
    rules_expect(text, i < 2 ? "" : "CHAIN_COLLIDER_NORMAL /sbf/chain_colliders/chain_collider[1]");
  }
}
END_TEST

START_TEST(test_retarget_chains)
{
  rules_expect(RETARGETED("1"), "");
  rules_expect(LEGS "<retarget_chains><retarget_chain id=\"c\"/></retarget_chains>",
      "CHAIN_EMPTY /sbf/retarget_chains/retarget_chain[1]");
  rules_expect(RETARGETED("1 4"), "CHAIN_BROKEN /sbf/retarget_chains/retarget_chain[1]/bones #1");
}
END_TEST

START_TEST(test_masks)
{
  rules_expect(LEGS "<bone_masks><bone_mask id=\"m\"><bones>4 1 0</bones></bone_mask></bone_masks>", "");
  rules_expect(LEGS "<bone_masks><bone_mask id=\"m\"><bones>4 1 4</bones></bone_mask></bone_masks>",
      "BONE_REPEATED /sbf/bone_masks/bone_mask[1]/bones #2");
}
END_TEST

START_TEST(test_followers)
{
  rules_expect(
      FOLLOWED("<follower id=\"a\" bone=\"body\"/><follower id=\"b\" bone=\"body\" channel=\"position\"/>"),
      "");
  rules_expect(FOLLOWED("<follower id=\"a\" bone=\"body\"/><follower id=\"b\" bone=\"body\"/>"),
      "FOLLOWER_REPEATED /sbf/followers/follower[2]");
  rules_expect(FOLLOWED("<follower id=\"a\" bone=\"body\" channel=\"both\"/><follower id=\"b\" bone=\"body\" "
                        "channel=\"position\"/>"),
      "FOLLOWER_REPEATED /sbf/followers/follower[2]");
  rules_expect(FOLLOWED("<follower id=\"a\" bone=\"body\" frequency=\"29\"/>"), "");
  rules_expect(FOLLOWED("<follower id=\"a\" bone=\"body\" frequency=\"31\"/>"),
      "FOLLOWER_TOO_FAST /sbf/followers/follower[1]");
  rules_expect(FOLLOWED("<follower id=\"a\" bone=\"body\" damping_ratio=\"0\"/>"),
      "FOLLOWER_UNDAMPED /sbf/followers/follower[1]");
}
END_TEST

START_TEST(test_bones_of_other_chains)
{
  rules_expect(BODY(TETRA LEVEL("model=\"jiggle\"", TETRA_POINTS, "<jiggle frequency=\"99\"/>")),
      "FOLLOWER_TOO_FAST /sbf/soft_body[1]/level[1]/jiggle");
  rules_expect(LEGS IK(LEFT_IK)
                   GAIT("", LEFT_LEG "<head_turn bone=\"right\" damping_ratio=\"0\"/><tail chain=\"c\" "
                                     "frequency=\"99\"/>") "<chains><chain id=\"c\"><bones>4 "
                                                           "5</bones></chain></chains>",
      "FOLLOWER_UNDAMPED /sbf/gait[1]/head_turn\nFOLLOWER_TOO_FAST /sbf/gait[1]/tail[1]");
}
END_TEST

RULES_MAIN("chain_rules", test_chains, test_springs, test_colliders, test_retarget_chains, test_masks,
    test_followers, test_bones_of_other_chains)
