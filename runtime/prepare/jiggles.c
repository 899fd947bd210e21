/* Jiggles: followers that replace bodies with one pin frame. */
#include "prepare/prepare.h"

/* The frame that moves the body rigidly. */
static uint32_t parent_frame_of(const sbr_model *model, uint32_t soft_body) {
  int32_t bone = model->asset->soft_bodies.at[soft_body].bone;
  const sbri_body *body = &model->detail.base->bodies[soft_body];
  if (body->level && body->is_pinned && !body->drivers) return body->driver_frame;
  return bone >= 0 ? (uint32_t)bone : sbri_root_frame(model);
}

const sbf_level *sbri_jiggle_of(const sbr_model *model, uint32_t soft_body) {
  const sbri_body *body = &model->detail.base->bodies[soft_body];
  const sbf_level_list *levels = &body->source->levels;
  if (!body->level || !body->is_pinned || body->drivers) return NULL;
  for (uint32_t l = 0; l < levels->count; l++)
    if (levels->at[l].model == SBF_ELASTIC_MODEL_JIGGLE && levels->at[l].jiggle &&
        levels->at[l].positions.count)
      return &levels->at[l];
  return NULL;
}

bool sbri_jiggles_make(sbr_model *model) {
  uint32_t count = model->asset->soft_bodies.count;
  if (model->detail.kind != SBR_DETAIL_JIGGLE) return true;
  model->jiggles = sbfi_arena_allocate(&model->arena, (size_t)count + 1, sizeof *model->jiggles);
  if (!model->jiggles) return false;
  for (uint32_t b = 0; b < count; b++) {
    const sbf_level *level = sbri_jiggle_of(model, b);
    if (!level) continue;
    float x = 0, y = 0, z = 0, fraction = 1 / (float)level->positions.count;
    for (uint32_t i = 0; i < level->positions.count; i++)
      x += level->positions.at[i].x, y += level->positions.at[i].y, z += level->positions.at[i].z;
    model->jiggles[model->jiggle_count++] = (sbri_jiggle){.body = b,
        .parent = parent_frame_of(model, b),
        .middle = {x * fraction, y * fraction, z * fraction},
        .frequency_hz = level->jiggle->frequency,
        .damping_ratio = level->jiggle->damping_ratio,
        .response = level->jiggle->response};
  }
  return true;
}
