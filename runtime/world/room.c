/* Memory of characters: as much as the rung takes that they are on, and what is rigid of them. */
#include <string.h>

#include "base/assert.h"
#include "world/state.h"

size_t sbri_room_size(const sbr_model *model) {
  return model->layout.state_size + model->layout.scratch_size;
}

bool sbri_room_make(const sbf_allocator *allocator, const sbr_model *model, sbri_room *room) {
  unsigned char *bytes = sbfi_allocate(allocator, sbri_room_size(model));
  *room = (sbri_room){bytes ? model : NULL, bytes, bytes ? bytes + model->layout.state_size : NULL};
  return bytes != NULL;
}

void sbri_room_free(const sbf_allocator *allocator, sbri_room *room) {
  if (room->model) sbfi_free(allocator, room->state, sbri_room_size(room->model));
  *room = (sbri_room){0};
}

void sbri_rigid_work_free(const sbf_allocator *allocator, sbri_character *c) {
  sbfi_free(allocator, c->rigid_work, c->model->layout.rigid_work_size);
  c->rigid_work = NULL;
}

void sbri_room_swap(sbri_character *c) {
  SBF_ASSERT(c->spare.model && c->spare.state && c->spare.scratch);
  sbri_room had = {c->model, c->state, c->scratch};
  c->model = c->spare.model, c->state = c->spare.state, c->scratch = c->spare.scratch;
  c->spare = had;
  c->spare_ticks = 0;
  c->sampled_at = 0;
  memset(c->state, 0, sbri_room_size(c->model));
}
