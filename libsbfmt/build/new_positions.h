/* What authored parts refer to stands elsewhere once derived parts have been made anew. */
#ifndef SBFI_NEW_POSITIONS_H
#define SBFI_NEW_POSITIONS_H

#include "build/source_view.h"
#include "model/unique_id.h"

typedef enum sbfi_new_positions_outcome {
  SBFI_POSITIONS_APPLIED,
  SBFI_POSITIONS_LOST, /* a part refers to a derived one that is not made again */
  SBFI_POSITIONS_NO_MEMORY
} sbfi_new_positions_outcome;

/* Renumbers the references of `asset`, a copy of the source of `from` with new sections and rigid bodies
 * behind the authored ones: derived items of old are found again by their ids. */
sbfi_new_positions_outcome sbfi_new_positions_apply(sbf_asset *asset, const sbf_asset *from,
    const sbfi_ids *ids, sbfi_lost_reference *lost, sbfi_arena *scratch);

#endif
