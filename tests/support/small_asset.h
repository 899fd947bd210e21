/* A small asset that has something of every shape: nested children, parts in parts, texts, lists in records
 * and in chunks; a few kilobytes when packed, so that a test can break it at every byte. */
#ifndef TEST_SMALL_ASSET_H
#define TEST_SMALL_ASSET_H

#include "sbfmt/asset.h"

/* Two bones, a texture, a render mesh, the sections "head" and "tail" with two levels each, a gait. A failed
 * allocation ends the test program. */
sbf_asset *small_asset(void);

#endif
