/* Why some schemes cannot step some bodies. */
#include "soft/solvers/scheme.h"

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
