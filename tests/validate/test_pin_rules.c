#include <stdio.h>

#include "rules.h"

#define SET "/sbf/soft_body[1]/pins/pin_set[1]"
#define PINNED(pins) ROOT_BONE SECTION(TETRA pins)

START_TEST(test_good_pins)
{ rules_expect(PINNED(PINS("bone=\"root\"", "0 1", "<weights>1 0.5</weights>")), ""); }
END_TEST

START_TEST(test_empty_and_weightless)
{
  rules_expect(PINNED("<pins><pin_set name=\"Foot\" bone=\"root\"/></pins>"), "PIN_SET_EMPTY " SET);
  rules_expect(
      PINNED(PINS("name=\"Foot\" bone=\"root\"", "0 1", "<weights>0</weights>")), "PIN_NO_WEIGHT " SET);
  rules_expect(PINNED(PINS("bone=\"root\" minimum=\"0.1\"", "0 1", "<weights>0</weights>")), "");
}
END_TEST

START_TEST(test_bounds_and_frames)
{
  rules_expect(
      PINNED(PINS("name=\"Foot\" bone=\"root\" minimum=\"0.5\" maximum=\"0.4\"", "0", "")), "PIN_RANGE " SET);
  rules_expect(ROOT_BONE "<rigid_bodies><rigid_body id=\"t\" name=\"T\" mass=\"1\"/></rigid_bodies>" SECTION(
                   TETRA PINS("name=\"Foot\" bone=\"root\" rigid_body=\"t\"", "0", "")),
      "PIN_TWO_FRAMES " SET);
}
END_TEST

START_TEST(test_repeated)
{
#define TWO_SETS(first, second)                                                                              \
  PINNED("<pins><pin_set bone=\"root\"><points>0 1</points>" first                                           \
         "</pin_set><pin_set bone=\"root\"><points>2 1</points>" second "</pin_set></pins>")
  rules_expect(PINNED(PINS("bone=\"root\"", "0 1 0", "")), "PIN_REPEATED " SET "/points #2");
  rules_expect(PINNED(PINS("bone=\"root\" maximum=\"0.5\"", "0 1 0", "")), "PIN_REPEATED " SET "/points #2");
  rules_expect(TWO_SETS("", ""), "PIN_REPEATED /sbf/soft_body[1]/pins/pin_set[2]/points #1");
  rules_expect(TWO_SETS("<weights>0.5</weights>", "<weights>0.5</weights>"), ""); /* goals act together */
}
END_TEST

START_TEST(test_offsets)
{
  const char *bone = "<skeleton><bone id=\"root\" name=\"Root\" head=\"0 1 0\" rotation=\"0 0 0.70710677 "
                     "0.70710677\" length=\"0.2\"/></skeleton>";
  char text[2048];
  /* the bone's +X points up: one metre down along it is the origin */
  const char *good = SECTION(TETRA PINS("bone=\"root\"", "0", "<offsets>-1 0 0</offsets>"));
  const char *bad = SECTION(TETRA PINS("name=\"Foot\" bone=\"root\"", "0", "<offsets>0 -1 0</offsets>"));
  snprintf(text, sizeof text, "%s%s", bone, good);
  rules_expect(text, "SECTION_FAR /sbf/soft_body[1]");
  snprintf(text, sizeof text, "%s%s", bone, bad);
  rules_expect(text, "SECTION_FAR /sbf/soft_body[1]\nPIN_OFFSET " SET "/offsets #0");
}
END_TEST

START_TEST(test_sections_are_pinned)
{
  rules_expect(ROOT_BONE SECTION(TETRA TETRA_SPRINGS), "SECTION_UNHELD /sbf/soft_body[1]/level[1]");
  rules_expect(ROOT_BONE SECTION(TETRA LEVEL("model=\"jiggle\"", TETRA_POINTS, "<jiggle/>")), "");
}
END_TEST

START_TEST(test_attachments)
{
#define HULL(points)                                                                                         \
  "<rigid_bodies><rigid_body id=\"t\" name=\"T\" mass=\"1\">" MESH(                                          \
      "collision_detection", points, "3 3 3 3", TETRA_POLYGONS) "</rigid_body></rigid_bodies>"
#define ATTACHED(rule)                                                                                       \
  BODY(TETRA "<attachments><attachment name=\"A\" rule=\"" rule "\" rigid_body=\"t\"/></attachments>")
#define PATH "/sbf/soft_body[1]/attachments/attachment[1]"
  rules_expect(HULL(TETRA_POINTS) ATTACHED("inside_hull"), "");
  rules_expect(HULL("5 0 0 5.2 0 0 5 0.2 0 5 0 0.2") ATTACHED("inside_hull"), "ATTACHMENT_EMPTY " PATH);
  rules_expect(HULL(TETRA_POINTS) ATTACHED("explicit"), "ATTACHMENT_EMPTY " PATH);
  rules_expect(
      "<rigid_bodies><rigid_body id=\"t\" name=\"T\" mass=\"1\"/></rigid_bodies>" ATTACHED("inside_hull"),
      "ATTACHMENT_NO_HULL " PATH);
}
END_TEST

RULES_MAIN("pin_rules", test_good_pins, test_empty_and_weightless, test_bounds_and_frames, test_repeated,
    test_offsets, test_sections_are_pinned, test_attachments)
