/* Memory of characters: storage of their present detail level, and solver memory of rigid parts. */
#include <string.h>

#include "base/assert.h"
#include "state/state.h"

size_t sbri_character_storage_size(const sbr_model *model) {
  return model->layout.state_size + model->layout.scratch_size;
}

bool sbri_character_storage_create(
    const sbf_allocator *allocator, const sbr_model *model, sbri_character_storage *storage) {
  unsigned char *bytes = sbfi_allocate(allocator, sbri_character_storage_size(model));
  *storage =
      (sbri_character_storage){bytes ? model : NULL, bytes, bytes ? bytes + model->layout.state_size : NULL};
  return bytes != NULL;
}

void sbri_character_storage_free(const sbf_allocator *allocator, sbri_character_storage *storage) {
  if (storage->model) sbfi_free(allocator, storage->state, sbri_character_storage_size(storage->model));
  *storage = (sbri_character_storage){0};
}

void sbri_rigid_work_free(const sbf_allocator *allocator, sbri_character *c) {
  sbfi_free(allocator, c->rigid_work, c->model->layout.rigid.work_size);
  c->rigid_work = NULL;
}

void sbri_character_storage_swap(sbri_character *c) {
  SBF_ASSERT(c->spare.model && c->spare.state && c->spare.scratch);
  sbri_character_storage had = {c->model, c->state, c->scratch};
  c->model = c->spare.model, c->state = c->spare.state, c->scratch = c->spare.scratch;
  c->spare = had;
  c->spare_ticks = 0;
  c->sampled_at = 0;
  memset(c->state, 0, sbri_character_storage_size(c->model));
}
