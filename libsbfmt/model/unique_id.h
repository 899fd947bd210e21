/* Creates unique ids for new parts. */
#ifndef SBFI_UNIQUE_ID_H
#define SBFI_UNIQUE_ID_H

#include "model/ids.h"

/* Creates an id that is not in `ids` and adds it: `prefix` and `name`, with .2, .3 and so on appended if
 * it exists. Its entry has the `index` and no collection. Allocates from `asset`; NULL if memory runs out. */
const char *sbfi_unique_id(
    sbfi_ids *ids, const char *prefix, const char *name, uint32_t index, sbf_asset *asset);

#endif
