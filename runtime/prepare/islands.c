/* Selection of simulated bodies, their levels, and islands. */
#include "base/diagnostic.h"
#include "prepare/prepare.h"

/* The level with the wanted number, or the coarsest one. If its model is not stepped, or it was not loaded,
 * the next coarser one that is, else the next finer one. */
static const sbf_level *level_of(const sbf_soft_body *body, uint32_t wanted) {
  uint32_t count = body->levels.count, first = wanted < count ? wanted : count - 1;
  if (count == 0) return NULL;
  for (uint32_t i = first; i < count; i++)
    if (sbri_level_is_stepped(&body->levels.at[i])) return &body->levels.at[i];
  for (uint32_t i = first; i-- > 0;)
    if (sbri_level_is_stepped(&body->levels.at[i])) return &body->levels.at[i];
  return &body->levels.at[first];
}

static sbf_status check_level(const sbf_soft_body *body, const sbf_level *level, sbf_diagnostic *error) {
  if (sbri_level_has_stepped_model(level)) return SBF_OK;
  return sbfi_diagnose(error, SBF_CODE_LEVEL_NOT_SIMULATED,
      "body \"%s\": its level has the model %s, and the runtime needs a level of springs, tetrahedra or "
      "regions: build the file with --springs",
      body->id, sbf_elastic_model_name(level->model));
}

/* Level of a coarser detail level: the wanted number or the next finer one with an acceptable error, else
 * that of the first detail level. */
static const sbf_level *coarser_of(const sbr_model *model, uint32_t body, uint32_t wanted) {
  const sbri_body *first = &model->detail.base->bodies[body];
  const sbf_level_list *levels = &first->source->levels;
  if (!first->level) return NULL;
  for (uint32_t i = wanted < levels->count ? wanted + 1 : levels->count; i-- > 0;) {
    const sbf_level *level = &levels->at[i];
    if (level == first->level || sbri_level_is_useful(level, first->rest_size_m)) return level;
  }
  return first->level;
}

static uint32_t first_of(const uint32_t *joined, uint32_t body) {
  while (joined[body] != body) body = joined[body];
  return body;
}

/* Ends are points of levels by number, which loading does not check. */
static sbf_status check_ends(const sbr_model *model, const sbf_cross_springs *cross, sbf_diagnostic *error) {
  if (!sbri_cross_springs_act(model, cross)) return SBF_OK;
  const sbf_level *levels[] = {model->bodies[cross->body_a].level, model->bodies[cross->body_b].level};
  for (uint32_t i = 0; i < cross->ends.count; i++)
    for (int end = 0; end < 2; end++)
      if (cross->ends.at[i].at[end] >= levels[end]->positions.count)
        return sbfi_diagnose(error, SBF_CODE_CROSS_SPRING_POINT,
            "spring %u between \"%s\" and \"%s\" names point %u, but the level has %u points: check the file "
            "with sbfmt validate",
            i, model->bodies[cross->body_a].source->id, model->bodies[cross->body_b].source->id,
            cross->ends.at[i].at[end], levels[end]->positions.count);
  return SBF_OK;
}

/* `joined` links each body to the first of its group. */
static void join(const sbr_model *model, uint32_t *joined) {
  const sbf_asset *asset = model->asset;
  for (uint32_t i = 0; i < asset->soft_bodies.count; i++) joined[i] = i;
  for (uint32_t i = 0; i < asset->cross_springs.count; i++) {
    const sbf_cross_springs *cross = &asset->cross_springs.at[i];
    if (!sbri_cross_springs_act(model, cross)) continue;
    uint32_t a = first_of(joined, (uint32_t)cross->body_a), b = first_of(joined, (uint32_t)cross->body_b);
    joined[a > b ? a : b] = a > b ? b : a;
  }
}

static bool make_islands(sbr_model *model, const uint32_t *joined) {
  uint32_t count = model->asset->soft_bodies.count;
  model->islands = sbfi_arena_allocate(&model->arena, count, sizeof *model->islands);
  if (!model->islands) return false;
  for (uint32_t i = 0; i < count; i++) {
    if (joined[i] != i || !model->bodies[i].level) continue;
    sbri_island *island = &model->islands[model->island_count];
    uint32_t *bodies = sbfi_arena_allocate(&model->arena, count - i, sizeof *bodies);
    if (!bodies) return false;
    for (uint32_t j = i; j < count; j++) {
      if (!model->bodies[j].level || first_of(joined, j) != i) continue;
      model->bodies[j].island = model->island_count;
      bodies[island->body_count++] = j;
    }
    island->bodies = bodies;
    model->island_count++;
  }
  return true;
}

sbf_status sbri_islands_group(sbr_model *model, const sbr_model_options *options, sbf_diagnostic *error) {
  const sbf_asset *asset = model->asset;
  uint32_t count = asset->soft_bodies.count;
  if (count == 0) return SBF_OK;
  model->bodies = sbfi_arena_allocate(&model->arena, count, sizeof *model->bodies);
  uint32_t *joined = sbfi_arena_allocate(&model->arena, count, sizeof *joined);
  if (!model->bodies || !joined)
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for the model");
  for (uint32_t i = 0; i < count; i++) {
    const sbf_soft_body *source = &asset->soft_bodies.at[i];
    const sbf_level *level = model->detail.kind != SBR_DETAIL_SOFT ? NULL
                             : model->detail.base == model         ? level_of(source, options->level)
                                                                   : coarser_of(model, i, options->level);
    if (level) {
      sbf_status status = check_level(source, level, error);
      if (status != SBF_OK) return status;
    }
    model->bodies[i].source = source;
    model->bodies[i].level = level && level->positions.count ? level : NULL;
  }
  for (uint32_t i = 0; i < asset->cross_springs.count; i++) {
    sbf_status status = check_ends(model, &asset->cross_springs.at[i], error);
    if (status != SBF_OK) return status;
  }
  join(model, joined);
  if (!make_islands(model, joined))
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for the model");
  return SBF_OK;
}
