/* Texts of the format, the rules applied to them, and their findings. */
#ifndef TEST_RULES_H
#define TEST_RULES_H

#include "harness.h"
#include "sbfmt/io.h"
#include "sbfmt/validate.h"

/* Loads a document of the current version around `inside` and applies all rules. `expected` is what they
 * report, a finding a line, as `CODE path` or `CODE path #index`; "" where nothing is wrong. */
void rules_expect(const char *inside, const char *expected);

/* Such a document, loaded; a failure ends the test. With `repairable` as sbf_fix may be given it. */
sbf_asset *rules_load(const char *inside, bool repairable);

/* What the rules report, in the form above. Valid until the next call. */
const char *rules_findings(const sbf_asset *asset, const sbf_validate_options *options);

/* Mends a document: `repaired` is what that reports, `left` what the rules report of the result, which is
 * returned for a closer look. */
sbf_asset *rules_expect_fix(const char *inside, const char *repaired, const char *left);

/* A suite of tests in one case. */
Suite *rules_suite(const char *name, const TTest *const *tests, size_t count);
#define RULES_MAIN(name, ...)                                                                                \
  int main(void) {                                                                                           \
    const TTest *const tests[] = {__VA_ARGS__};                                                              \
    return harness_run(rules_suite(name, tests, sizeof tests / sizeof *tests));                              \
  }

/* Pieces of documents. The tetrahedron has its right angle at the origin and sides of 0.2 m. */
#define TETRA_POINTS "0 0 0 0.2 0 0 0 0.2 0 0 0 0.2"
#define TETRA_POLYGONS "0 2 1 0 1 3 0 3 2 1 2 3"
#define MESH(target, points, sizes, polygons)                                                                \
  "<polygon_mesh target=\"" target "\"><positions>" points "</positions><polygon_sizes>" sizes               \
  "</polygon_sizes><polygon_points>" polygons "</polygon_points></polygon_mesh>"
#define SURFACE(points, sizes, polygons) MESH("surface", points, sizes, polygons)
#define TETRA SURFACE(TETRA_POINTS, "3 3 3 3", TETRA_POLYGONS)
#define BODY(inside) "<soft_body id=\"b\" name=\"B\">" inside "</soft_body>"
#define SECTION(inside) "<soft_body id=\"b\" name=\"B\" bone=\"root\">" inside "</soft_body>"
#define LEVEL(attributes, points, inside)                                                                    \
  "<level " attributes "><positions>" points "</positions>" inside "</level>"
#define SPRINGS(attributes, ends, inside)                                                                    \
  "<spring_set kind=\"structural\" " attributes "><ends>" ends "</ends>" inside "</spring_set>"
#define TETRA_EDGES "0 1 0 2 0 3 1 2 1 3 2 3"
#define TETRA_SPRINGS LEVEL("", TETRA_POINTS, SPRINGS("", TETRA_EDGES, ""))
#define LATTICE(tetrahedra, inside)                                                                          \
  "<tetrahedron_mesh target=\"volume\"><tetrahedra>" tetrahedra "</tetrahedra>" inside "</tetrahedron_mesh>"
#define PINS(attributes, points, inside)                                                                     \
  "<pins><pin_set " attributes "><points>" points "</points>" inside "</pin_set></pins>"
#define BONE(id, head, more) "<bone id=\"" id "\" name=\"" id "\" head=\"" head "\" " more "/>"
#define ROOT_BONE "<skeleton>" BONE("root", "0 0 0", "length=\"0.2\"") "</skeleton>"
#define RENDER(inside)                                                                                       \
  "<render_mesh id=\"r\" name=\"R\">" MESH("rendering", TETRA_POINTS, "3 3 3 3", TETRA_POLYGONS) inside      \
      "</render_mesh>"

#endif
