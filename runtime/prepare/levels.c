/* Assessment of levels. */
#include "prepare/prepare.h"

/* Error, as a fraction of the body's size, above which a level is never used.
 */
static const float USELESS_FRACTION = 0.25f;

bool sbri_level_has_stepped_model(const sbf_level *level) {
  return level->model == SBF_ELASTIC_MODEL_SPRINGS || level->model == SBF_ELASTIC_MODEL_TETRAHEDRA ||
         level->model == SBF_ELASTIC_MODEL_SHAPE_MATCHING;
}

bool sbri_level_is_stepped(const sbf_level *level) {
  return sbri_level_has_stepped_model(level) && level->positions.count > 0;
}

bool sbri_level_has_failed(const sbf_level *level, float size_m) {
  bool measured = level->simulation.motion_error > 0;
  return !measured && level->simulation.error > USELESS_FRACTION * size_m;
}

bool sbri_level_is_useful(const sbf_level *level, float size_m) {
  return sbri_level_is_stepped(level) && !sbri_level_has_failed(level, size_m);
}

static bool is_level(const sbf_soft_body *body, const sbf_level *level, uint32_t index) {
  return level && index < body->levels.count && level == &body->levels.at[index];
}

bool sbri_cross_springs_act(const sbr_model *model, const sbf_cross_springs *cross) {
  const sbri_body *a = &model->bodies[cross->body_a], *b = &model->bodies[cross->body_b];
  return is_level(a->source, a->level, cross->level_a) && is_level(b->source, b->level, cross->level_b);
}
