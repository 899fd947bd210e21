/* Ids for parts that are made. */
#ifndef SBFI_UNIQUE_ID_H
#define SBFI_UNIQUE_ID_H

#include "model/ids.h"

/* An id that `ids` does not have yet, which it then has: `prefix` and `name`, or where that is taken the same
 * with .2, .3 and so on behind it. Its entry has the `index` and no collection. Memory of `asset`; NULL where
 * it runs out. */
const char *sbfi_unique_id(
    sbfi_ids *ids, const char *prefix, const char *name, uint32_t index, sbf_asset *asset);

#endif
