#include "model/unique_id.h"

#include <stdio.h>

#include "sbfmt/asset.h"

const char *sbfi_unique_id(
    sbfi_ids *ids, const char *prefix, const char *name, uint32_t index, sbf_asset *asset) {
  enum { NUMBER_SIZE = 12 };
  size_t size = strlen(prefix) + strlen(name) + NUMBER_SIZE;
  char *id = sbf_asset_allocate(asset, size, 1);
  if (!id) return NULL;
  snprintf(id, size, "%s%s", prefix, name);
  for (uint32_t number = 2; sbfi_ids_find(ids, id); number++)
    snprintf(id, size, "%s%s.%u", prefix, name, (unsigned)number);
  const sbfi_id_entry *taken;
  return sbfi_ids_add(ids, (sbfi_id_entry){.id = id, .index = index}, &taken) ? id : NULL;
}
