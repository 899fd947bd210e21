/* What authored parts refer to stands elsewhere once derived parts have been made anew. */
#ifndef SBFI_NEW_PLACES_H
#define SBFI_NEW_PLACES_H

#include "build/source_view.h"
#include "model/unique_id.h"

typedef enum sbfi_places_outcome {
  SBFI_PLACES_TAKEN,
  SBFI_PLACES_LOST, /* a part refers to a derived one that is not made again */
  SBFI_PLACES_NO_MEMORY
} sbfi_places_outcome;

/* Renumbers the references of `asset`, a copy of the source of `from` with new sections and rigid bodies
 * behind the authored ones: derived items of old are found again by their ids. */
sbfi_places_outcome sbfi_new_places_take(sbf_asset *asset, const sbf_asset *from, const sbfi_ids *ids,
    sbfi_lost_reference *lost, sbfi_arena *scratch);

#endif
