#include "rules.h"

#define LEVEL_PATH "/sbf/soft_body[1]/level[1]"

START_TEST(test_points_at_their_sources)
{
  rules_expect(BODY(TETRA TETRA_SPRINGS), "");
  rules_expect(BODY(TETRA LEVEL("", "0 0 0 0.2 0 0 0 0.2 0 0 0 0.21", SPRINGS("", TETRA_EDGES, ""))),
      "LEVEL_POINT_MOVED " LEVEL_PATH "/positions #3");
  /* what has no place in the level cannot be elsewhere */
  rules_expect(BODY(TETRA LEVEL(
                   "", "1 1 1 2 1 1", "<new_from_old>4294967295 7</new_from_old>" SPRINGS("", "0 1", ""))),
      "");
}
END_TEST

START_TEST(test_interior_points_come_last)
{
#define INSIDE(x)                                                                                            \
  BODY(TETRA "<interior>0.05 0.05 0.05</interior>" LEVEL(                                                    \
      "", TETRA_POINTS " " x " 0.05 0.05", SPRINGS("", TETRA_EDGES " 0 4", "")))
  rules_expect(INSIDE("0.05"), "");
  rules_expect(INSIDE("0.06"), "LEVEL_POINT_MOVED " LEVEL_PATH "/positions #4");
}
END_TEST

START_TEST(test_map)
{
  rules_expect(BODY(TETRA "<interior>0 0 0</interior>" LEVEL(
                   "", TETRA_POINTS, "<new_from_old>0 1 2 3 0</new_from_old>" SPRINGS("", TETRA_EDGES, ""))),
      "LEVEL_MAP " LEVEL_PATH "/new_from_old #4");
}
END_TEST

START_TEST(test_loose_points)
{
  rules_expect(BODY(LEVEL("", TETRA_POINTS " 1 1 1 2 2 2", SPRINGS("", TETRA_EDGES, ""))),
      "POINT_LOOSE " LEVEL_PATH "/positions #4");
  rules_expect(
      BODY(LEVEL("", TETRA_POINTS " 1 1 1 2 2 2", SPRINGS("", TETRA_EDGES, "") PINS("", "4 5", ""))), "");
}
END_TEST

START_TEST(test_pieces)
{
#define PIECES(pins) BODY(LEVEL("", "0 0 0 1 0 0 5 0 0 6 0 0", SPRINGS("", "0 1 2 3", "") pins))
  rules_expect(PIECES(""), "LEVEL_PIECES " LEVEL_PATH);
  rules_expect(PIECES(PINS("", "0", "")), "LEVEL_PIECES " LEVEL_PATH);
  rules_expect(PIECES(PINS("", "0 2", "<weights>0.5</weights>")), "");
}
END_TEST

START_TEST(test_cross_springs_connect)
{
  rules_expect("<soft_body id=\"a\" name=\"A\">" LEVEL("", "0 0 0 1 0 0 5 0 0 6 0 0",
                   SPRINGS("", "0 1 2 3",
                       "")) "</soft_body>"
                            "<soft_body id=\"b\" name=\"B\">" LEVEL("", "0 1 0 1 1 0",
                                SPRINGS("", "0 1", "")) "</soft_body>"
                                                        "<cross_springs body_a=\"a\" body_b=\"b\"><ends>0 0 "
                                                        "2 1</ends></cross_springs>",
      "");
}
END_TEST

START_TEST(test_masses)
{
#define MASSES(pins)                                                                                         \
  BODY(LEVEL("", TETRA_POINTS, "<masses>1 0 1 1</masses>" SPRINGS("", TETRA_EDGES, "") pins))
  rules_expect(MASSES(""), "POINT_NO_MASS " LEVEL_PATH "/masses #1");
  rules_expect(MASSES(PINS("", "1", "")), "");
  rules_expect(MASSES(PINS("", "1", "<weights>0.9</weights>")), "POINT_NO_MASS " LEVEL_PATH "/masses #1");
}
END_TEST

START_TEST(test_order)
{
#define COARSE LEVEL("", TETRA_POINTS, SPRINGS("", "0 1 0 2 0 3", ""))
  rules_expect(BODY(TETRA_SPRINGS COARSE), "");
  rules_expect(BODY(COARSE TETRA_SPRINGS), "LEVEL_ORDER /sbf/soft_body[1]/level[2]");
  rules_expect(
      BODY(COARSE LEVEL("model=\"tetrahedra\"", TETRA_POINTS, LATTICE("0 1 2 3", "")) TETRA_SPRINGS), "");
}
END_TEST

RULES_MAIN("level_rules", test_points_at_their_sources, test_interior_points_come_last, test_map,
    test_loose_points, test_pieces, test_cross_springs_connect, test_masses, test_order)
