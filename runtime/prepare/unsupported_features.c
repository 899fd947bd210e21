/* Features of a file that this runtime does not support. */
#include "base/diagnostic.h"
#include "prepare/prepare.h"

typedef struct listing {
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user;
  uint32_t count;
} listing;

static void list(listing *l, uint32_t how_many, const char *what, const char *instead) {
  if (how_many == 0) return;
  l->count++;
  if (!l->report) return;
  sbf_diagnostic diagnostic;
  sbfi_diagnose(
      &diagnostic, SBF_CODE_PART_LEFT_OUT, "%s are left out, %s (%u)", what, instead, (unsigned)how_many);
  l->report(l->user, &diagnostic);
}

typedef struct body_counts {
  uint32_t gas, bending, media, self, beside, levels;
} body_counts;

static bool has_flexion(const sbf_level *level) {
  for (uint32_t i = 0; i < level->springs.count; i++)
    if (level->springs.at[i].kind == SBF_SPRING_KIND_FLEXION && level->springs.at[i].ends.count) return true;
  return false;
}

static body_counts count_bodies(const sbr_model *model) {
  body_counts n = {0};
  for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++) {
    const sbri_body *made = &model->bodies[b];
    const sbf_soft_body *body = made->source;
    const sbf_attributes *is = &body->attributes;
    const sbf_level *level = made->level;
    if (!level) continue;
    sbf_body_measures measures;
    sbf_body_measure(body, &measures);
    bool bends = measures.sheet && !has_flexion(level) && body->surface.polygon_sizes.count > 1;
    n.gas += is->pressure_mode == SBF_PRESSURE_MODE_GAS && is->pressure != 0 && made->gas.pressure_pa == 0;
    n.bending += bends && made->elements.hinge_count == 0;
    n.media += model->asset->environment.media_density > 0 && body->surface.polygon_sizes.count &&
               !(made->medium_kg_m3 > 0);
    n.self += body->collision.self && made->self.face_count == 0;
    for (uint32_t i = 0; i < body->levels.count; i++)
      n.levels += body->levels.at[i].model != SBF_ELASTIC_MODEL_SPRINGS &&
                  body->levels.at[i].model != SBF_ELASTIC_MODEL_TETRAHEDRA &&
                  body->levels.at[i].model != SBF_ELASTIC_MODEL_SHAPE_MATCHING;
    /* Tetrahedra of a body with regions only embed its surface. */
    bool regions = level->model == SBF_ELASTIC_MODEL_SHAPE_MATCHING;
    n.beside +=
        (level->regions != NULL && !regions) || level->jiggle != NULL ||
        (level->lattice.tetrahedra.count > 0 && level->model != SBF_ELASTIC_MODEL_TETRAHEDRA && !regions);
  }
  return n;
}

uint32_t sbr_model_report_unsupported(
    const sbr_model *model, void (*report)(void *user, const sbf_diagnostic *diagnostic), void *user) {
  if (!model) return 0;
  listing l = {report, user, 0};
  const sbf_asset *asset = model->asset;
  body_counts n = count_bodies(model);
  list(&l, n.gas, "gases in bodies with a surface that is open or follows bones", "they have no pressure");
  list(&l, n.bending, "bending stiffnesses of sheets with points that the level does not have",
      "they bend freely");
  list(&l, n.media, "forces of a dense medium on bodies that follow bones", "only media_friction acts");
  list(&l, n.self, "self-collisions of bodies with surface points that the level does not have",
      "they pass through themselves, unless the world has body contacts (sbr_world_enable_body_contacts)");
  list(&l, n.levels, "levels of a model other than springs, tetrahedra or regions",
      "other levels of their bodies are used");
  list(&l, n.beside, "tetrahedra, regions and jiggles in levels of another model", "only that acts");
  uint32_t weightless = 0;
  for (uint32_t i = 0; i < asset->rigid_bodies.count; i++)
    weightless +=
        asset->rigid_bodies.at[i].motion == SBF_BODY_MOTION_DYNAMIC && !(model->rigid.bodies[i].mass > 0);
  list(&l, weightless, "motions of dynamic rigid bodies without mass", "they follow their bones");
  return l.count;
}
