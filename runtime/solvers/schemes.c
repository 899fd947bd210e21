#include "solvers/scheme.h"

static const sbri_scheme *const schemes[] = {&sbri_symplectic, &sbri_position_based, &sbri_relaxation,
    &sbri_explicit_euler, &sbri_heun, &sbri_block_descent};

const char *sbri_refuse_all_but_springs(const sbr_model *model, const sbri_island *island) {
  for (uint32_t b = 0; b < island->body_count; b++)
    if (model->bodies[island->bodies[b]].level->model != SBF_ELASTIC_MODEL_SPRINGS)
      return "whose level is not of springs";
  return NULL;
}

const char *sbri_refuse_regions(const sbr_model *model, const sbri_island *island) {
  for (uint32_t b = 0; b < island->body_count; b++)
    if (model->bodies[island->bodies[b]].level->model == SBF_ELASTIC_MODEL_SHAPE_MATCHING)
      return "whose level matches shapes";
  return NULL;
}

const sbri_scheme *sbri_scheme_of(sbf_scheme word) {
  for (size_t i = 0; i < sizeof schemes / sizeof *schemes; i++)
    if (schemes[i]->word == word) return schemes[i];
  return NULL;
}

const char *sbri_scheme_names(void) {
  return "symplectic, position_based, relaxation, explicit_euler, heun, block_descent";
}
