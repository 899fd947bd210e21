#include "tune/tuned_levels.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fault.h"

static const char ID[] = "tune";

/* Writes into a separate asset, so that the copy for the caller has no unused memory. */
typedef struct writer {
  const sbf_asset *base;
  const tune_level *levels;
  uint32_t count;
  const char *machine;
  sbf_asset *memory;
  uint32_t derivation;
  sbr_model *models[TUNE_MAX_MESHES];
} writer;

/* Replaces the settings of an earlier tuning. */
static bool write_derivation(writer *w, const char *settings, sbf_asset *view) {
  const sbf_derivation_list *were = &w->base->derivations;
  sbf_derivation *list = sbf_asset_allocate(w->memory, (size_t)were->count + 1, sizeof *list);
  uint32_t at = 0, from = 0;
  if (!list) return false;
  for (uint32_t b = 0; b < w->base->soft_bodies.count; b++) {
    const sbf_level_list *levels = &w->base->soft_bodies.at[b].levels;
    if (levels->count && levels->at[0].derived != SBF_NONE) from = (uint32_t)levels->at[0].derived;
  }
  memcpy(list, were->at, were->count * sizeof *list);
  while (at < were->count && strcmp(list[at].id, ID) != 0) at++;
  list[at] = list[from < were->count ? from : 0];
  list[at].id = ID;
  list[at].settings = sbf_asset_copy_text(w->memory, settings);
  w->derivation = at;
  view->derivations = (sbf_derivation_list){list, at == were->count ? at + 1 : were->count};
  return list[at].settings != NULL;
}

/* Marks the level and its content as derived by this tuning. */
static bool mark(const writer *w, sbf_level *level) {
  int32_t by = (int32_t)w->derivation;
  sbf_pin_set *pins = sbf_asset_allocate(w->memory, (size_t)level->pins.count + 1, sizeof *pins);
  sbf_spring_set *springs = sbf_asset_allocate(w->memory, (size_t)level->springs.count + 1, sizeof *springs);
  sbf_embedding *embeddings =
      sbf_asset_allocate(w->memory, (size_t)level->embeddings.count + 1, sizeof *embeddings);
  if (!pins || !springs || !embeddings) return false;
  level->derived = by;
  for (uint32_t i = 0; i < level->pins.count; i++) {
    pins[i] = level->pins.at[i];
    if (pins[i].derived != SBF_NONE) pins[i].derived = by;
  }
  for (uint32_t i = 0; i < level->springs.count; i++) {
    springs[i] = level->springs.at[i];
    if (springs[i].derived != SBF_NONE) springs[i].derived = by;
  }
  for (uint32_t i = 0; i < level->embeddings.count; i++) {
    embeddings[i] = level->embeddings.at[i];
    if (embeddings[i].derived != SBF_NONE) embeddings[i].derived = by;
  }
  level->pins.at = pins;
  level->springs.at = springs;
  level->embeddings.at = embeddings;
  return true;
}

/* Distributes the time of the whole character by the cost of each body. */
static bool state_time(const writer *w, sbf_level *level, double us) {
  sbf_measured *measured = sbf_asset_allocate(w->memory, 1, sizeof *measured);
  if (!measured) return false;
  sbf_measured_init(measured);
  measured->machine = w->machine;
  measured->microseconds = (float)us;
  level->simulation.measured = (sbf_measured_list){measured, 1};
  return true;
}

static bool write_level(const writer *w, uint32_t body, uint32_t number, sbf_level *level) {
  const tune_level *from = &w->levels[number];
  const tune_trial *trial = from->trial;
  double cost = chart_body_visits(w->models[number], from->mesh->asset, body, &trial->setting);
  double fraction = trial->element_visits > 0 ? cost / trial->element_visits : 0;
  char name[64];
  *level = from->mesh->asset->soft_bodies.at[body].levels.at[0];
  snprintf(name, sizeof name, number ? "tuned %u" : "tuned", (unsigned)number);
  level->name = sbf_asset_copy_text(w->memory, name);
  if (trial->setting.scheme != SBF_SCHEME_AUTOMATIC) {
    level->simulation.scheme = trial->setting.scheme;
    level->simulation.substeps = trial->setting.substeps;
  }
  level->simulation.motion_error = (float)trial->promised.max_m;
  level->simulation.motion_error_rms = (float)trial->promised.rms_m;
  level->simulation.cost = isfinite(cost) ? (float)cost : 0;
  return level->name && mark(w, level) && state_time(w, level, fraction * trial->us.median);
}

static bool write_body(const writer *w, uint32_t number, sbf_soft_body *body) {
  const sbf_level_list were = body->levels;
  sbf_level *levels = sbf_asset_allocate(w->memory, (size_t)w->count + were.count + 1, sizeof *levels);
  uint32_t count = 0;
  if (!levels) return false;
  for (uint32_t l = 0; l < w->count; l++)
    if (!write_level(w, number, l, &levels[count++])) return false;
  for (uint32_t l = 0; l < were.count; l++)
    if (were.at[l].model == SBF_ELASTIC_MODEL_JIGGLE) levels[count++] = were.at[l];
  body->levels = (sbf_level_list){levels, count};
  return true;
}

static sbf_status make_models(writer *w, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  for (uint32_t l = 0; status == SBF_OK && l < w->count; l++) {
    const chart_setting *setting = &w->levels[l].trial->setting;
    sbr_model_options options = sbr_default_model_options();
    options.scheme = setting->scheme;
    options.substeps = setting->substeps;
    status = sbr_model_create(w->levels[l].mesh->asset, &options, &w->models[l], error);
  }
  return status;
}

static bool write_all(writer *w, const char *settings, sbf_asset **made) {
  sbf_asset view = *w->base;
  uint32_t count = w->base->soft_bodies.count;
  sbf_soft_body *bodies = sbf_asset_allocate(w->memory, (size_t)count + 1, sizeof *bodies);
  if (!bodies || !write_derivation(w, settings, &view)) return false;
  for (uint32_t b = 0; b < count; b++) {
    bodies[b] = w->base->soft_bodies.at[b];
    bool authored = !bodies[b].levels.count || bodies[b].levels.at[0].derived == SBF_NONE;
    if (!authored && !write_body(w, b, &bodies[b])) return false;
  }
  view.soft_bodies.at = bodies;
  *made = sbf_asset_clone(&view, NULL);
  return *made != NULL;
}

sbf_status tune_levels_write(const sbf_asset *base, const tune_level *levels, uint32_t count,
    const char *settings, const char *machine, sbf_asset **made, sbf_diagnostic *error) {
  writer w = {.base = base, .levels = levels, .count = count, .machine = machine};
  *made = NULL;
  w.memory = sbf_asset_create(NULL);
  sbf_status status = w.memory ? make_models(&w, error)
                               : fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for levels");
  if (status == SBF_OK && !write_all(&w, settings, made))
    status = fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for levels");
  for (uint32_t l = 0; l < count; l++) sbr_model_destroy(w.models[l]);
  sbf_asset_free(w.memory);
  return status;
}
