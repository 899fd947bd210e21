/* The description of a bundle that `sbfmt info` prints. */
#ifndef BUNDLE_DESCRIPTION_H
#define BUNDLE_DESCRIPTION_H

#include <jansson.h>

#include "sbfmt/mechanics.h"

/* A new object with the keys of `info --format json`; `bytes` is the file's size. */
json_t *bundle_description(const sbf_asset *asset, const sbf_asset_measures *measures, uint64_t bytes);

#endif
