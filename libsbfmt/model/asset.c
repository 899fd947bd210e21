/* Creates and frees assets: one arena owns everything. */
#include "sbfmt/asset.h"

#include "base/memory.h"
#include "model/asset_box.h"

sbf_asset *sbf_asset_create(const sbf_allocator *allocator) {
  sbf_allocator a = sbfi_allocator_or_default(allocator);
  sbfi_asset_box *box = sbfi_allocate(&a, sizeof *box);
  if (!box) return NULL;
  *box = (sbfi_asset_box){.release = NULL};
  sbfi_arena_init(&box->arena, &a, 0);
  sbf_asset_init(&box->asset);
  return &box->asset;
}

void sbf_asset_free(sbf_asset *asset) {
  if (!asset) return;
  sbfi_asset_box *box = sbfi_asset_box_of(asset);
  if (box->release) box->release(box->released);
  sbf_allocator allocator = box->arena.allocator;
  sbfi_arena_free(&box->arena);
  sbfi_free(&allocator, box, sizeof *box);
}

void *sbf_asset_allocate(sbf_asset *asset, size_t count, size_t size) {
  return sbfi_arena_allocate(&sbfi_asset_box_of(asset)->arena, count, size);
}

const char *sbf_asset_copy_text(sbf_asset *asset, const char *text) {
  return sbfi_arena_string(&sbfi_asset_box_of(asset)->arena, text, strlen(text));
}
