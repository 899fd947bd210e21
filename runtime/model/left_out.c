/* What a file asks for and this runtime does not do. */
#include "base/diagnostic.h"
#include "model/runtime_model.h"

typedef struct listing {
  void (*report)(void *user, const sbf_diagnostic *finding);
  void *user;
  uint32_t count;
} listing;

static void list(listing *l, uint32_t how_many, const char *what, const char *instead) {
  if (how_many == 0) return;
  l->count++;
  if (!l->report) return;
  sbf_diagnostic finding;
  sbfi_diagnose(
      &finding, SBF_CODE_PART_LEFT_OUT, "%s are left out, %s (%u)", what, instead, (unsigned)how_many);
  l->report(l->user, &finding);
}

typedef struct body_counts {
  uint32_t limits, yields, tears, gas, bending, media, self, beside, levels;
} body_counts;

static void count_springs(const sbf_level *level, body_counts *n) {
  bool limits = false, yields = false, tears = false, flexion = false;
  for (uint32_t i = 0; i < level->springs.count; i++) {
    const sbf_spring_set *set = &level->springs.at[i];
    limits = limits || set->strain_min > -1 || set->strain_max > 0;
    yields = yields || set->yield_strain > 0;
    tears = tears || set->tear_strain > 0;
    flexion = flexion || (set->kind == SBF_SPRING_KIND_FLEXION && set->ends.count);
  }
  n->limits += limits, n->yields += yields, n->tears += tears;
  n->bending += flexion;
}

static body_counts count_bodies(const sbr_model *model) {
  body_counts n = {0};
  for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++) {
    const sbf_soft_body *body = model->bodies[b].source;
    const sbf_attributes *is = &body->attributes;
    const sbf_level *level = model->bodies[b].level;
    body_counts own = {0};
    if (!level) continue;
    count_springs(level, &own);
    sbf_body_measures measures;
    sbf_body_measure(body, &measures);
    bool bends = measures.sheet && !own.bending && body->surface.polygon_sizes.count > 1;
    n.limits += own.limits || is->strain_min > -1 || is->strain_max > 0;
    n.yields += own.yields || is->yield_strain > 0;
    n.tears += own.tears || is->tear_strain > 0;
    n.gas += is->pressure_mode == SBF_PRESSURE_MODE_GAS;
    n.bending += bends;
    n.media += model->asset->environment.media_density > 0 && body->surface.polygon_sizes.count;
    n.self += body->collision.self;
    for (uint32_t i = 0; i < body->levels.count; i++)
      n.levels += body->levels.at[i].model != SBF_ELASTIC_MODEL_SPRINGS &&
                  body->levels.at[i].model != SBF_ELASTIC_MODEL_TETRAHEDRA;
    n.beside += level->regions != NULL || level->jiggle != NULL ||
                (level->lattice.tetrahedra.count > 0 && level->model != SBF_ELASTIC_MODEL_TETRAHEDRA);
  }
  return n;
}

uint32_t sbr_model_left_out(
    const sbr_model *model, void (*report)(void *user, const sbf_diagnostic *finding), void *user) {
  if (!model) return 0;
  listing l = {report, user, 0};
  const sbf_asset *asset = model->asset;
  body_counts n = count_bodies(model);
  list(&l, n.limits, "strain limits of bodies", "their springs stretch beyond");
  list(&l, n.yields, "yield strains of bodies", "they keep their rest shape");
  list(&l, n.tears, "tear strains of bodies", "they hold");
  list(&l, n.gas, "gases inside bodies", "they have no pressure");
  list(&l, n.bending, "bending stiffnesses of sheets without flexion springs", "they bend freely");
  list(&l, n.media, "pushes of a dense medium on bodies", "only media_friction acts");
  list(&l, n.self, "collisions of bodies with themselves", "they pass through");
  list(&l, n.levels, "levels that are neither of springs nor of tetrahedra",
      "other levels of their bodies act");
  list(&l, n.beside, "tetrahedra, regions and jiggles beside a level's own model", "only that acts");
  uint32_t dynamic = 0;
  for (uint32_t i = 0; i < asset->rigid_bodies.count; i++)
    dynamic += asset->rigid_bodies.at[i].motion == SBF_BODY_MOTION_DYNAMIC;
  list(&l, dynamic, "dynamic rigid bodies", "they follow their bones");
  list(&l, dynamic ? asset->joints.count : 0, "joints", "they hold nothing");
  list(&l, asset->environment.fields.count, "force fields", "they do not act");
  list(&l, asset->followers.count, "followers", "their bones do not lag");
  list(&l, asset->clips.count, "clips", "they are not played");
  return l.count;
}
