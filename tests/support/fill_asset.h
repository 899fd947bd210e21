/* Assets made from the schema's tables alone: every field of every element has a value that is not its
 * default, and the structure is sound, so that they load. What they say makes no sense otherwise. */
#ifndef TEST_FILL_ASSET_H
#define TEST_FILL_ASSET_H

#include "sbfmt/asset.h"
#include "sbfmt/io.h"

typedef struct fill_options {
  uint64_t seed;                  /* the same seed gives the same asset */
  uint32_t items;                 /* in a list whose length is free; 0: 7, and never below that */
  uint32_t children;              /* of a kind; 0: 2 */
  const sbf_allocator *allocator; /* NULL: malloc */
} fill_options;

/* NULL where memory runs out. It holds required extensions: load it with fill_load_options. */
sbf_asset *fill_asset(const fill_options *options);

/* Options that know the extensions of `asset`, which must outlive them. Valid until the next call. */
sbf_load_options fill_load_options(const sbf_asset *asset);

/* Whether every field of the schema has another value than its default somewhere in the asset; if not,
 * `field` receives element.field of the first that has not. */
bool fill_is_complete(const sbf_asset *asset, char *field, size_t size);

#endif
