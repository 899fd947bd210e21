/* Owner of an asset: the arena of all its content, and a mapped file. */
#ifndef SBFI_ASSET_BOX_H
#define SBFI_ASSET_BOX_H

#include <stddef.h>
#include <string.h>

#include "base/memory.h"
#include "sbfmt/model.h"

typedef struct sbfi_asset_box {
  sbfi_arena arena;
  /* called when the asset is freed, for example to unmap a file; may be NULL */
  void (*release)(void *released);
  void *released;
  sbf_asset asset;
} sbfi_asset_box;

static inline sbfi_asset_box *sbfi_asset_box_of(const sbf_asset *asset) {
  const char *destination = (const char *)asset - offsetof(sbfi_asset_box, asset);
  sbfi_asset_box *box;
  memcpy(&box, &destination, sizeof box);
  return box;
}

#endif
