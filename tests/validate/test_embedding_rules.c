#include "rules.h"

#define EMBEDDED(attributes, vertices, points, weights, more)                                                \
  "<embedding " attributes ">" vertices "<points>" points "</points><weights>" weights "</weights>" more     \
  "</embedding>"
#define SKIN "render_mesh=\"r\""
#define ALL_POINTS "0 0 0 0 1 1 1 1 2 2 2 2 3 3 3 3"
#define ALL_WEIGHTS "1 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0"
#define WORN(embedding) RENDER("") BODY(TETRA LEVEL("", TETRA_POINTS, SPRINGS("", TETRA_EDGES, "") embedding))
#define PATH "/sbf/soft_body[1]/level[1]/embedding[1]"

START_TEST(test_good)
{
  rules_expect(WORN(EMBEDDED(SKIN, "", ALL_POINTS, ALL_WEIGHTS, "")), "");
  rules_expect(WORN(EMBEDDED(
                   SKIN, "<vertices>3 0 1 2</vertices>", "3 3 3 3 0 0 0 0 1 1 1 1 2 2 2 2", ALL_WEIGHTS, "")),
      "");
}
END_TEST

START_TEST(test_sums)
{
  rules_expect(WORN(EMBEDDED(SKIN, "", ALL_POINTS, "1 0 0 0 1 0 0 0 0.5 0.49995 0 0 0.5 0.4 0 0", "")),
      "EMBEDDING_SUM " PATH "/weights #3");
}
END_TEST

START_TEST(test_far_outside)
{
  const char *mesh =
      "<render_mesh id=\"r\" name=\"R\">" MESH("rendering", "0 0 0 0.2 0 0 0 0.2 0 0.4 0.4 0.4", "3 3 3 3",
          TETRA_POLYGONS) "</render_mesh>" BODY(TETRA LEVEL("", TETRA_POINTS,
          SPRINGS("", TETRA_EDGES, "")
              EMBEDDED(SKIN, "", "0 0 0 0 1 1 1 1 2 2 2 2 0 1 2 3", "1 0 0 0 1 0 0 0 1 0 0 0 -5 2 2 2", "")));
  rules_expect(mesh, "EMBEDDING_OUTSIDE " PATH "/weights #3");
}
END_TEST

START_TEST(test_bounds_of_weights)
{
#define LAST(weights)                                                                                        \
  EMBEDDED(SKIN, "", "0 0 0 0 1 1 1 1 2 2 2 2 3 2 3 3", "1 0 0 0 1 0 0 0 1 0 0 0 " weights, "")
  rules_expect(WORN(LAST("1.5 0 -0.5 0")), "");
  rules_expect(WORN(LAST("1.51 0 -0.5 -0.01")), "EMBEDDING_OUTSIDE " PATH "/weights #3");
  rules_expect(WORN(LAST("1 0 -0.51 0.51")), "EMBEDDING_OUTSIDE " PATH "/weights #3");
}
END_TEST

/* A vertex in no polygon is never seen: it jumps nowhere. */
START_TEST(test_unseen_vertices)
{
  rules_expect("<render_mesh id=\"r\" name=\"R\">" MESH("rendering", TETRA_POINTS " 9 9 9", "3 3 3 3",
                   TETRA_POLYGONS) "</render_mesh>" BODY(TETRA LEVEL("", TETRA_POINTS,
                   SPRINGS("", TETRA_EDGES, "")
                       EMBEDDED(SKIN, "", ALL_POINTS " 3 3 3 3", ALL_WEIGHTS " 1 0 0 0", ""))),
      "MESH_POINT_UNUSED /sbf/render_mesh[1]/polygon_mesh/positions #4");
}
END_TEST

START_TEST(test_wrong_embedded_positions)
{
  rules_expect(WORN(EMBEDDED(
                   SKIN, "", "0 0 0 0 1 1 1 1 2 2 2 2 3 2 3 3", "1 0 0 0 1 0 0 0 1 0 0 0 0.99 0.01 0 0", "")),
      "");
  rules_expect(
      WORN(EMBEDDED(SKIN, "", "0 0 0 0 1 1 1 1 2 2 2 2 3 2 3 3", "1 0 0 0 1 0 0 0 1 0 0 0 0.9 0.1 0 0", "")),
      "EMBEDDING_OFF " PATH "/points #3");
}
END_TEST

START_TEST(test_vertices)
{
  rules_expect(WORN(EMBEDDED(SKIN, "<vertices>0 1</vertices>", ALL_POINTS, ALL_WEIGHTS, "")),
      "EMBEDDING_LENGTH " PATH);
  rules_expect(WORN(EMBEDDED(SKIN, "<vertices>0 1 2 9</vertices>", ALL_POINTS, ALL_WEIGHTS, "")),
      "EMBEDDING_VERTEX " PATH "/vertices #3\nEMBEDDING_MISSING /sbf/render_mesh[1]");
  rules_expect(
      WORN(EMBEDDED(SKIN, "", ALL_POINTS " 3 3 3 3", ALL_WEIGHTS " 1 0 0 0", "")), "EMBEDDING_VERTEX " PATH);
  rules_expect(WORN(EMBEDDED(SKIN, "<vertices>0 1 2 3 3</vertices>", ALL_POINTS " 3 3 3 3",
                   ALL_WEIGHTS " 1 0 0 0", "<blends>1 1 1 0.5 0.5</blends>")),
      "EMBEDDING_REPEATED " PATH "/vertices #4");
}
END_TEST

START_TEST(test_blends)
{
  rules_expect(WORN(EMBEDDED(SKIN, "", ALL_POINTS, ALL_WEIGHTS, "<blends>1 1 1 0.9995</blends>")), "");
  rules_expect(WORN(EMBEDDED(SKIN, "", ALL_POINTS, ALL_WEIGHTS, "<blends>1 1 1 0.998</blends>")),
      "EMBEDDING_BLEND /sbf/render_mesh[1]");
  rules_expect(WORN(EMBEDDED(SKIN, "", ALL_POINTS, ALL_WEIGHTS, "<blends>1 1 1 0.9</blends>")),
      "EMBEDDING_BLEND /sbf/render_mesh[1]");
  rules_expect(WORN(EMBEDDED(SKIN, "", ALL_POINTS, ALL_WEIGHTS, "<blends>1 1 1 0</blends>")),
      "EMBEDDING_MISSING /sbf/render_mesh[1]");
}
END_TEST

START_TEST(test_two_bodies_blend)
{
#define SHARE(id, blends)                                                                                    \
  "<soft_body id=\"" id "\" name=\"" id "\">" TETRA LEVEL("", TETRA_POINTS,                                  \
      SPRINGS("", TETRA_EDGES, "") EMBEDDED(SKIN, "", ALL_POINTS, ALL_WEIGHTS, blends)) "</soft_body>"
  rules_expect(
      RENDER("") SHARE("a", "<blends>0.25 1 0.5 0</blends>") SHARE("b", "<blends>0.75 0 0.5 1</blends>"), "");
  rules_expect(RENDER("") SHARE("a", "") SHARE("b", ""), "EMBEDDING_BLEND /sbf/render_mesh[1]");
}
END_TEST

START_TEST(test_own_surface)
{
  rules_expect(BODY(TETRA LEVEL("", TETRA_POINTS,
                   SPRINGS("", TETRA_EDGES, "") EMBEDDED("", "", ALL_POINTS, ALL_WEIGHTS, ""))),
      "");
  rules_expect(
      BODY(TETRA LEVEL("", TETRA_POINTS,
          SPRINGS("", TETRA_EDGES, "") EMBEDDED("", "", "0 0 0 0 1 1 1 1 3 3 3 3 2 2 2 2", ALL_WEIGHTS, ""))),
      "EMBEDDING_OFF " PATH "/points #2");
}
END_TEST

RULES_MAIN("embedding_rules", test_good, test_sums, test_far_outside, test_bounds_of_weights,
    test_unseen_vertices, test_wrong_embedded_positions, test_vertices, test_blends, test_two_bodies_blend,
    test_own_surface)
