/* New indices of references of authored parts after derived parts were rebuilt. */
#ifndef SBFI_NEW_POSITIONS_H
#define SBFI_NEW_POSITIONS_H

#include "build/source_view.h"
#include "model/unique_id.h"

typedef enum sbfi_new_positions_outcome {
  SBFI_POSITIONS_APPLIED,
  SBFI_POSITIONS_LOST, /* a part refers to a derived one that no longer exists */
  SBFI_POSITIONS_NO_MEMORY
} sbfi_new_positions_outcome;

/* Renumbers the references of `asset`, a copy of the source of `from` with new sections and rigid bodies
 * after the authored ones: old derived items are identified by their ids. */
sbfi_new_positions_outcome sbfi_new_positions_apply(sbf_asset *asset, const sbf_asset *from,
    const sbfi_ids *ids, sbfi_lost_reference *lost, sbfi_arena *scratch);

#endif
