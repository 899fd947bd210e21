#include "rules.h"

#define LEVEL_PATH "/sbf/soft_body[1]/level[1]"
#define ENDS LEVEL_PATH "/spring_set[1]/ends"
#define BODY_OF(points, springs) BODY(LEVEL("", points, springs))

START_TEST(test_good_springs)
{
  rules_expect(BODY_OF(TETRA_POINTS, SPRINGS("", TETRA_EDGES, "")), "");
  rules_expect(BODY_OF(TETRA_POINTS, SPRINGS("", TETRA_EDGES, "<stiffness>50</stiffness>")), "");
}
END_TEST

START_TEST(test_ends)
{
  rules_expect(BODY_OF(TETRA_POINTS, SPRINGS("", TETRA_EDGES " 2 2", "")), "SPRING_SAME_POINT " ENDS " #6");
  rules_expect(BODY_OF(TETRA_POINTS, SPRINGS("", TETRA_EDGES " 3 0", "")), "SPRING_DUPLICATE " ENDS " #6");
  rules_expect(BODY_OF(TETRA_POINTS, SPRINGS("", TETRA_EDGES, "") SPRINGS("", "2 1", "")),
      "SPRING_DUPLICATE " LEVEL_PATH "/spring_set[2]/ends #0");
}
END_TEST

START_TEST(test_lengths)
{
  rules_expect(
      BODY_OF(TETRA_POINTS " 0 0 0", SPRINGS("", TETRA_EDGES " 0 4", "")), "SPRING_NO_LENGTH " ENDS " #6");
  rules_expect(
      BODY_OF(TETRA_POINTS, SPRINGS("", TETRA_EDGES, "<rest_lengths>0.2 0.2 0 0.3 0.3 0.3</rest_lengths>")),
      "SPRING_NO_LENGTH " ENDS " #2");
  rules_expect(BODY_OF(TETRA_POINTS,
                   SPRINGS("", TETRA_EDGES, "<rest_lengths>0.11 0.39 0.2 0.3 0.3 0.3</rest_lengths>")),
      "");
  rules_expect(BODY_OF(TETRA_POINTS,
                   SPRINGS("", TETRA_EDGES, "<rest_lengths>0.09 0.41 0.2 0.3 0.3 0.3</rest_lengths>")),
      "SPRING_STRAINED " ENDS " #0\nSPRING_STRAINED " ENDS " #1");
}
END_TEST

START_TEST(test_pinned_points)
{
#define HELD(weights) BODY_OF(TETRA_POINTS, SPRINGS("", TETRA_EDGES, "") PINS("", "0 3", weights))
  rules_expect(HELD(""), "SPRING_INERT " ENDS " #2");
  rules_expect(HELD("<weights>1 0.5</weights>"), ""); /* a goal lets its point move */
}
END_TEST

START_TEST(test_stiffness)
{
  rules_expect(BODY_OF(TETRA_POINTS, SPRINGS("", TETRA_EDGES, "<stiffness>0</stiffness>")),
      "SPRING_LIMP " LEVEL_PATH "/spring_set[1]/stiffness #0");
  rules_expect(BODY_OF(TETRA_POINTS, SPRINGS("", TETRA_EDGES, "<stiffness>1 1 1 1 0 1</stiffness>")),
      "SPRING_LIMP " LEVEL_PATH "/spring_set[1]/stiffness #4");
}
END_TEST

START_TEST(test_beside_another_model)
{
#define BESIDE(attributes)                                                                                   \
  BODY(LEVEL("model=\"tetrahedra\"", TETRA_POINTS, LATTICE("0 1 2 3", "") SPRINGS(attributes, "0 1", "")))
  rules_expect(BESIDE(""), "SPRING_IDLE " LEVEL_PATH "/spring_set[1]");
  rules_expect(BESIDE("extra=\"true\""), "");
}
END_TEST

START_TEST(test_no_springs)
{ rules_expect(BODY_OF(TETRA_POINTS, ""), "LEVEL_EMPTY " LEVEL_PATH); }
END_TEST

RULES_MAIN("spring_rules", test_good_springs, test_ends, test_lengths, test_pinned_points, test_stiffness,
    test_beside_another_model, test_no_springs)
