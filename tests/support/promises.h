/* Checks the promises of a loaded asset (sbfmt/packed.h), for tests and fuzz targets. */
#ifndef TEST_PROMISES_H
#define TEST_PROMISES_H

#include "sbfmt/asset.h"

/* What is broken first, in words (valid until the next call); NULL where every promise holds: the library's
 * own structural check finds nothing, and neither does a second one, which shares none of its scans:
 *   - a list is NULL exactly where it is empty, and has a length its rule allows; indices are in range;
 *   - numbers are finite and in their ranges, enums known, bools false or true;
 *   - texts are there and UTF-8, ids neither empty nor twice;
 *   - references name things that exist, and earlier ones where they must: bones stand after their parents;
 *   - tetrahedra span a positive volume, polygons have three corners or more and use up their list. */
const char *promise_broken(const sbf_asset *asset);

/* Ends the test where a promise is broken. */
#define ck_assert_promises_kept(asset)                                                                       \
  do {                                                                                                       \
    const char *promise_found = promise_broken(asset);                                                       \
    ck_assert_msg(!promise_found, "broken promise: %s", promise_found);                                      \
  } while (0)

#endif
